/* Stages 5 and 7 of 7 for draws with a stencil or a query: the tests of a sample. In: covered fragments. Out: those that
 * pass, counted; tile memory as the tests leave it.
 *
 * Invariant: OpenGL 4.6, 17.3.3 to 17.3.5, for one sample after the other; the depth test is that of packet.h. */
#include "pipeline/sample_tests.h"
#include "pipeline/record.h"

/* What an operation makes of codes, 0..255. */
static lom_int operate(lom_stencil_operation operation, lom_int stored, int32_t reference)
{
    const lom_int zero = { 0 }, most = lom_splat_int(255);
    switch (operation) {
    case LOM_STENCIL_ZERO:
        return zero;
    case LOM_STENCIL_REPLACE:
        return lom_splat_int(reference);
    case LOM_STENCIL_INCREMENT:
        return lom_min_int(stored + 1, most);
    case LOM_STENCIL_DECREMENT:
        return lom_max_int(stored - 1, zero);
    case LOM_STENCIL_INVERT:
        return stored ^ 255;
    case LOM_STENCIL_INCREMENT_WRAP:
        return (stored + 1) & 255;
    case LOM_STENCIL_DECREMENT_WRAP:
        return (stored - 1) & 255;
    default:
        return stored;
    }
}

static lom_mask compare(const lom_stencil_face *face, lom_int stored)
{
    const int32_t read = ~face->read_off & 255;
    const lom_float reference = lom_splat((float)(face->reference & read));
    return lom_compare_depth(face->compare, reference, lom_to_float(stored & read));
}

/* What is stored where the test passed or not; deep: the depth test passes. */
static lom_int change(const lom_stencil_face *face, lom_int stored, lom_mask passed, lom_mask deep)
{
    lom_int both = operate(face->pass, stored, face->reference);
    lom_int shallow = operate(face->depth_fail, stored, face->reference);
    lom_int failed = operate(face->fail, stored, face->reference);
    lom_int result = lom_select_int(passed, lom_select_int(deep, both, shallow), failed);
    return (result & (~face->write_off & 255)) | (stored & face->write_off);
}

/* The lanes that pass the stencil test, which is done. */
static lom_mask test_stencil(struct lom_tile *tile, const struct lom_places *places, int sample, lom_mask covered,
                             lom_mask deep, lom_mask front)
{
    const lom_stencil *stencil = &tile->draw->desc.stencil;
    int32_t *codes = tile->stencil + sample;
    lom_int stored = lom_load_places(codes, tile, places);
    lom_mask passed = compare(&stencil->front, stored);
    lom_int result = change(&stencil->front, stored, passed, deep);
    if (stencil->two_sided) {
        lom_mask back = compare(&stencil->back, stored);
        result = lom_select_int(front, result, change(&stencil->back, stored, back, deep));
        passed = (passed & front) | (back & ~front);
    }
    lom_store_places(codes, tile, places, covered, result);
    return passed;
}

void LOM_WIDE(lom_test_sample)(struct lom_tile *tile, const struct lom_places *places, int sample, lom_mask *covered,
                               const lom_float *depth, const lom_mask *front, lom_mask *failed)
{
    const struct lom_draw *draw = tile->draw;
    int32_t *depths = tile->depth != NULL ? (int32_t *)(void *)tile->depth + sample : NULL;
    const lom_float units = lom_depth_units(tile->pass, *depth);
    lom_mask deep = lom_splat_int(-1), passed = *covered;
    if (depths != NULL)
        deep = lom_compare_depth(draw->compare, units, lom_as_float(lom_load_places(depths, tile, places)));
    if (draw->desc.stencil.enabled)
        passed &= test_stencil(tile, places, sample, *covered, deep, *front);
    *failed = *covered & ~passed;
    passed &= deep;
    if (draw->depth_write)
        lom_store_places(depths, tile, places, passed, lom_as_int(units));
    if (draw->desc.query != NULL)
        tile->counted[draw->counter] += lom_count(passed);
    *covered = passed;
}

void LOM_WIDE(lom_test_part)(struct lom_tile *tile, const struct part *at, lom_mask *covered, const lom_float *depth)
{
    const struct lom_places places = { .pixel = { at->base + tile->offset[at->part * LOM_LANES] }, .block = true };
    const lom_mask front = lom_splat_int(-(int)lom_faces_front(tile->draw, &at->triangle->primitive));
    lom_mask failed;
    LOM_WIDE(lom_test_sample)(tile, &places, 0, covered, depth, &front, &failed);
    LOM_RECORD_HOOK(lom_record_stencil, tile, at, &failed);
}

void LOM_WIDE(lom_test_samples)(struct lom_tile *tile, const lom_int *pixel, bool front, lom_mask *covered,
                                const lom_float *depth)
{
    struct lom_places places = { .block = false };
    lom_mask failed;
    const lom_mask side = lom_splat_int(-(int)front);
    lom_store_int(places.pixel, *pixel * tile->pass->sample_pitch);
    for (int s = 0; s < tile->pass->samples; s++)
        LOM_WIDE(lom_test_sample)(tile, &places, s, &covered[s], &depth[s], &side, &failed);
}

/* ---- after the shader ---- */

void LOM_WIDE(lom_find_front)(const struct lom_tile *tile, const struct lom_packet *packet, lom_mask *front)
{
    int32_t faces[LOM_LANES] = { 0 };
    *front = lom_splat_int(-1);
    if (tile->draw->sprites || tile->draw->lines)
        return;
    for (int i = 0; i < packet->triangles; i++)
        faces[i] = -(int32_t)lom_faces_front(tile->draw, &tile->chunk->primitives[packet->triangle[i]]);
    *front = packet->triangles == 1 ? lom_splat_int(faces[0]) : lom_gather_int(faces, packet->which);
}

void LOM_WIDE(lom_write_tested)(struct lom_tile *tile, const struct lom_packet *packet, const lom_mask *shaded,
                                const lom_fragment *out)
{
    const lom_float number = lom_saturate(lom_select(out->depth == out->depth, out->depth, (lom_float){ 0 }));
    lom_mask mask = *shaded, front, failed;
    LOM_WIDE(lom_find_front)(tile, packet, &front);
    while (lom_any(mask)) {
        lom_mask round = packet->triangles == 1 ? mask : lom_first_at_pixels(tile, packet->places.pixel, mask);
        mask &= ~round;
        LOM_RECORD_HOOK(lom_record_late_begins, tile, &number, &round);
        LOM_WIDE(lom_test_sample)(tile, &packet->places, 0, &round, &number, &front, &failed);
        LOM_RECORD_HOOK(lom_record_late_ends, tile, &round, &failed);
        LOM_RECORD_HOOK(lom_record_write_begins, tile, &packet->places, &round);
        LOM_WIDE(lom_write_packet)(tile, &packet->places, &round, out->color);
        LOM_RECORD_HOOK(lom_record_write_ends, tile, &packet->places, &round, out->color);
    }
}
