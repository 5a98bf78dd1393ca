/* Stages 6 and 7 of 7 where pixels have several samples, as far as they differ. In: a packet whose varyings are found. Out:
 * its colours in the samples that it covers.
 *
 * Invariant: each sample ends as if the packets were drawn into it alone. A block of 2x2 pixels has one colour a
 * pixel as long as every fragment that comes to it covers all samples of its pixel: what is written then is the same in all. */
#include "pipeline/blend_bytes.h"
#include "pipeline/record.h"
#include "pipeline/sample_tests.h"

/* Four samples side by side. */
typedef int32_t row __attribute__((vector_size(16), aligned(4), may_alias));

LOM_INLINE int count_samples(const struct lom_tile *tile)
{
    return tile->pass->samples;
}

LOM_INLINE int count_pixels(const struct lom_tile *tile)
{
    return tile->edge * tile->edge;
}

/* ---- the shader ---- */

/* The window position of the place of shading: that of the centre, and an exact sixteenth. */
static void move_position(const struct lom_tile *tile, lom_int place, lom_varyings *in)
{
    int32_t x[LOM_MAX_SAMPLES + 1] = { 0 }, y[LOM_MAX_SAMPLES + 1] = { 0 };
    for (int s = 0; s < count_samples(tile); s++) {
        x[s + 1] = tile->pass->offset[s].x;
        y[s + 1] = tile->pass->offset[s].y;
    }
    in->x += lom_to_float(lom_gather_int(x, place)) * (1.0f / 16);
    in->y += lom_to_float(lom_gather_int(y, place)) * (1.0f / 16);
}

/* The samples that a fragment of this alpha may be written to. */
static lom_int cover_by_alpha(const struct lom_tile *tile, lom_float alpha)
{
    const lom_float number = lom_select(alpha == alpha, alpha, (lom_float){ 0 });
    lom_int count = lom_bounded_to_int(lom_saturate(number) * (float)count_samples(tile) + 0.5f);
    return (lom_splat_int(1) << count) - 1;
}

void LOM_WIDE(lom_run_sampled)(struct lom_tile *tile, const struct lom_packet *packet, lom_varyings *in)
{
    const struct lom_draw *draw = tile->draw;
    const lom_shader *shader = draw->desc.shader;
    lom_fragment out;
    if (shader->reads_position && count_samples(tile) > 1)
        move_position(tile, packet->place, in);
    if (shader->reads_depth) {
        lom_int sample = count_samples(tile) > 1 ? lom_max_int(packet->place - 1, (lom_int){ 0 }) : (lom_int){ 0 };
        lom_int at = lom_load_int(packet->places.pixel) * tile->pass->sample_pitch + sample;
        in->target_depth = lom_depth_of_units(tile->pass, lom_gather(tile->depth, at));
    }
    in->covered = packet->covered;
    out.depth = packet->depth;
    out.discard = (lom_mask){ 0 };
    shader->fragment[draw->variant](&out, in, tile->uniforms);
    LOM_RECORD_HOOK(lom_record_shaded, tile, in, &out);
    tile->packets++;
    lom_mask mask = shader->discards ? in->covered & ~out.discard : in->covered;
    if (count_samples(tile) > 1) {
        LOM_WIDE(lom_write_samples)(tile, packet, &mask, packet->triangles == 1, &out);
        return;
    }
    if (draw->desc.alpha_to_coverage)
        mask &= cover_by_alpha(tile, out.color[0].w) != 0;
    if (draw->full_tests)
        LOM_WIDE(lom_write_tested)(tile, packet, &mask, &out);
    else
        LOM_WIDE(lom_write_in_order)(tile, &packet->places, &mask, packet->triangles == 1, &out);
}

/* ---- samples ---- */

/* Where sample 0 of each lane lies among samples that are side by side. */
static struct lom_places find_apart(const struct lom_tile *tile, const struct lom_packet *packet)
{
    struct lom_places places = { .block = false };
    lom_store_int(places.pixel, lom_load_int(packet->places.pixel) * tile->pass->sample_pitch);
    return places;
}

static lom_mask test_depth(struct lom_tile *tile, int32_t *memory, const struct lom_places *places, lom_mask mask,
                           lom_float z)
{
    lom_float units = lom_depth_units(tile->pass, z);
    mask &= lom_compare_depth(tile->draw->compare, units, lom_as_float(lom_load_places(memory, tile, places)));
    if (tile->draw->depth_write)
        lom_store_places(memory, tile, places, mask, lom_as_int(units));
    return mask;
}

/* The tests after the shader: the samples that pass. */
static lom_int test_late(struct lom_tile *tile, const struct lom_packet *packet, lom_int samples, lom_float depth)
{
    const struct lom_draw *draw = tile->draw;
    const struct lom_places places = find_apart(tile, packet);
    lom_int passed = { 0 };
    lom_mask front, failed;
    if (draw->full_tests)
        LOM_WIDE(lom_find_front)(tile, packet, &front);
    for (int s = 0; s < count_samples(tile); s++) {
        lom_mask mask = (samples & 1 << s) != 0;
        if (!lom_any(mask))
            continue;
        lom_float z =
            draw->desc.shader->writes_depth ? depth : lom_load(packet->sample_depth + packet->depth_pitch * (size_t)s);
        z = lom_saturate(lom_select(z == z, z, (lom_float){ 0 }));
        if (draw->full_tests)
            LOM_WIDE(lom_test_sample)(tile, &places, s, &mask, &z, &front, &failed);
        else
            mask = test_depth(tile, (int32_t *)(void *)tile->depth + s, &places, mask, z);
        passed |= mask & 1 << s;
    }
    return passed;
}

/* A block's colour goes to all its samples. */
static __attribute__((noinline)) void divide_block(struct lom_tile *tile, int i, int32_t block)
{
    const size_t pixels = (size_t)count_pixels(tile), pitch = (size_t)tile->pass->sample_pitch,
                 first = 4 * (size_t)block;
    const uint32_t *image = (const uint32_t *)tile->color[i] + first;
    uint32_t *samples = tile->sample_color[i];
    tile->several[i][block] = 1;
    if (tile->pass->color[i].kind == COLOR_FLOAT) {
        for (size_t s = 0; s < 4 * (size_t)count_samples(tile); s++)
            memcpy(samples + s * pixels + first, image + (s & 3) * pixels, 4 * sizeof *image);
        return;
    }
    row *to = (row *)(void *)(samples + first * pitch);
    for (size_t k = 0; k < 4; k++)
        for (size_t s = 0; s < pitch; s += 4)
            *to++ = (int32_t)image[k] - (row){ 0 };
}

/* The blocks of these lanes are divided from now on, in every attachment. */
static void divide_blocks(struct lom_tile *tile, const int32_t *pixel, uint32_t lanes)
{
    for (; lanes != 0; lanes &= lanes - 1) {
        int32_t block = pixel[__builtin_ctz(lanes)] >> 2;
        for (int i = 0; i < tile->pass->colors; i++)
            if (!tile->several[i][block])
                divide_block(tile, i, block);
    }
}

/* Which lanes lie in blocks that are undivided in all attachments, after those that a lane covers in part are divided. */
static lom_mask find_whole(struct lom_tile *tile, const struct lom_packet *packet, lom_mask mask, lom_int samples)
{
    const int32_t *pixel = packet->places.pixel;
    uint32_t bits = lom_bits(mask), whole = bits;
    divide_blocks(tile, pixel, lom_bits(mask & (samples != (1 << count_samples(tile)) - 1)));
    for (int i = 0; i < tile->pass->colors; i++)
        for (uint32_t left = bits; left != 0; left &= left - 1) {
            int lane = __builtin_ctz(left);
            whole &= ~((uint32_t)tile->several[i][pixel[lane] >> 2] << lane);
        }
    if (tile->pass->colors > 1) /* a block may be whole in one attachment and not in another */
        divide_blocks(tile, pixel, bits & ~whole);
    return lom_mask_of_bits(whole);
}

/* Whether the draw stores 8-bit codes as they are, in the only colour attachment: then they are found once. */
LOM_INLINE bool stores_codes(const struct lom_tile *tile)
{
    const struct lom_draw *draw = tile->draw;
    return tile->pass->colors == 1 && tile->pass->color[0].kind != COLOR_FLOAT && !draw->blends &&
           draw->desc.shader->colors >= 1;
}

/* What the output stage stores for the lanes, one after the other. */
LOM_INLINE void find_codes(struct lom_tile *tile, const lom_float4 *color, int32_t code[LOM_LANES])
{
    struct lom_places places = { .block = LOM_LANES < 16 }; /* those of 16 lanes are two runs */
    lom_mask all = lom_splat_int(-1);
    void *images = tile->color[0];
    if (tile->draw->output == OUTPUT_BYTES) {
        lom_store_int(code, join(quantise(color)));
        return;
    }
    lom_store_int(places.pixel, lom_lane_index());
    tile->color[0] = code;
    LOM_WIDE(lom_write_packet)(tile, &places, &all, color);
    tile->color[0] = images;
}

/* A code to those of four samples whose bits are set: stored under a mask, or joined with what is there. */
#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES
LOM_INLINE void store_row(row *to, int32_t code, uint32_t samples)
{
    _mm_mask_storeu_epi32(to, (__mmask8)samples, _mm_set1_epi32(code));
}
#else
static const row row_masks[16] = { { 0, 0, 0, 0 },   { -1, 0, 0, 0 },   { 0, -1, 0, 0 },   { -1, -1, 0, 0 },
                                   { 0, 0, -1, 0 },  { -1, 0, -1, 0 },  { 0, -1, -1, 0 },  { -1, -1, -1, 0 },
                                   { 0, 0, 0, -1 },  { -1, 0, 0, -1 },  { 0, -1, 0, -1 },  { -1, -1, 0, -1 },
                                   { 0, 0, -1, -1 }, { -1, 0, -1, -1 }, { 0, -1, -1, -1 }, { -1, -1, -1, -1 } };

LOM_INLINE void store_row(row *to, int32_t code, uint32_t samples)
{
    *to = ((code - (row){ 0 }) & row_masks[samples]) | (*to & ~row_masks[samples]);
}
#endif

/* Of `pitch` words a pixel; a lane without samples leaves all as it is. */
LOM_INLINE void store_rows(struct lom_tile *tile, const int32_t *pixel, const int32_t *covered, const int32_t *code,
                           size_t pitch)
{
    const uint32_t every = (1u << count_samples(tile)) - 1;
    int32_t *image = tile->color[0], *divided = tile->sample_color[0];
    const uint8_t *several = tile->several[0];
    for (int i = 0; i < LOM_LANES; i++) {
        uint32_t left = (uint32_t)covered[i];
        const uint32_t at = (uint32_t)pixel[i];
        if (!several[at >> 2]) {
            if (left == every)
                image[at] = code[i];
            if (left == every || left == 0)
                continue;
            divide_block(tile, 0, (int32_t)(at >> 2));
        }
        row *to = (row *)(void *)(divided + at * pitch);
        for (size_t k = 0; k < pitch; k += 4, left >>= 4, to++)
            store_row(to, code[i], left & 15);
    }
}

static void store_codes(struct lom_tile *tile, const struct lom_packet *packet, lom_int samples,
                        const lom_float4 *color)
{
    int32_t code[LOM_LANES], covered[LOM_LANES];
    find_codes(tile, color, code);
    lom_store_int(covered, samples);
    if (tile->pass->sample_pitch == 4)
        store_rows(tile, packet->places.pixel, covered, code, 4);
    else
        store_rows(tile, packet->places.pixel, covered, code, (size_t)tile->pass->sample_pitch);
}

/* Colours of an attachment to the samples of divided blocks. */
static void write_divided(struct lom_tile *tile, const struct lom_packet *packet, lom_int samples,
                          const lom_float4 *color, int i)
{
    void *image = tile->color[i];
    const bool floats = tile->pass->color[i].kind == COLOR_FLOAT;
    const struct lom_places places = floats ? packet->places : find_apart(tile, packet);
    const size_t step = floats ? lom_image_bytes(tile->pass, i) : sizeof(uint32_t);
    for (int s = 0; s < count_samples(tile); s++) {
        lom_mask covered = (samples & 1 << s) != 0;
        tile->color[i] = (uint8_t *)tile->sample_color[i] + (size_t)s * step;
        if (lom_any(covered))
            LOM_WIDE(lom_write_color)(tile, &places, &covered, color, i);
    }
    tile->color[i] = image;
}

/* Colours of lanes to samples: those of whole blocks once. */
static void write(struct lom_tile *tile, const struct lom_packet *packet, lom_int samples, const lom_float4 *color)
{
    if (stores_codes(tile)) {
        store_codes(tile, packet, samples, color);
        return;
    }
    lom_mask mask = samples != 0, whole = find_whole(tile, packet, mask, samples);
    if (lom_any(whole))
        LOM_WIDE(lom_write_packet)(tile, &packet->places, &whole, color);
    samples &= ~whole;
    for (int i = 0; i < tile->pass->colors && i < tile->draw->desc.shader->colors && lom_any(samples != 0); i++)
        write_divided(tile, packet, samples, &color[i], i);
}

void LOM_WIDE(lom_write_samples)(struct lom_tile *tile, const struct lom_packet *packet, const lom_mask *shaded,
                                 bool apart, const lom_fragment *out)
{
    const struct lom_draw *draw = tile->draw;
    bool late = draw->late_depth && (tile->depth != NULL || draw->full_tests),
         rounds = (late || draw->blends) && !apart;
    lom_int samples = packet->samples & *shaded;
    if (!late && !draw->desc.alpha_to_coverage && stores_codes(tile)) {
        store_codes(tile, packet, samples, out->color);
        return;
    }
    if (draw->desc.alpha_to_coverage)
        samples &= cover_by_alpha(tile, out->color[0].w);
    lom_mask mask = samples != 0;
    while (lom_any(mask)) {
        lom_mask round = rounds ? lom_first_at_pixels(tile, packet->places.pixel, mask) : mask;
        lom_int now = samples & round;
        mask &= ~round;
        if (late)
            now = test_late(tile, packet, now, out->depth);
        if (lom_any(now != 0))
            write(tile, packet, now, out->color);
    }
}
