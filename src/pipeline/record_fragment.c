/* The stages of a tile, recorded: a fragment from its coverage to what it leaves in the tile's memory. In: what those
 * stages hold, over 4 lanes. Out: the fragments of watched pixels. This file is compiled once: 4 lanes by pointer are the
 * same in every variant of 4. */
#include "pipeline/packet.h"
#include "pipeline/record.h"
#include "pipeline/tally.h"
#include "pipeline/window.h"

static struct record_worker *worker_of(const struct lom_tile *tile)
{
    return &tile->pass->recorder->worker[tile - tile->pass->device->worker_tiles];
}

/* Whether a fragment of the packet at hand is watched. */
static bool is_watched(const struct lom_tile *tile)
{
    return tile->pass->recorder != NULL && worker_of(tile)->watches;
}

/* The frame's pixel at a place in tile memory: blocks of 2x2, edge / 2 of them a row. */
static void find_pixel(const struct lom_tile *tile, int place, int *x, int *y)
{
    int block = place >> 2, half = tile->edge / 2;
    *x = tile->x + block % half * 2 + (place & 1);
    *y = tile->y + block / half * 2 + (place >> 1 & 1);
}

/* The fragments of a triangle at a place, one for each watch, as with lom_record_next. */
static struct record_raw *next_raw(const struct lom_tile *tile, int place, int32_t triangle, size_t *next)
{
    int x, y;
    struct record_pixel *pixel;
    find_pixel(tile, place, &x, &y);
    while ((pixel = lom_record_next(tile->pass->recorder, x, y, next)) != NULL)
        for (struct record_raw *raw = pixel->raw; raw != NULL; raw = raw->next)
            if (raw->chunk == tile->chunk && raw->triangle == triangle)
                return raw;
    return NULL;
}

/* Depth in attachment units as the attachment will hold it. */
static float stored_depth(const struct lom_pass *pass, float units)
{
    return pass->depth_scale == 0 ? units : units / (float)pass->depth_scale;
}

static int place_of(const struct lom_tile *tile, const struct part *at, int lane)
{
    return at->base + tile->offset[at->part * LOM_LANES + lane];
}

/* Whether a part of a window, a block of 2x2 pixels, holds none that is watched. */
static bool is_beside(const struct lom_tile *tile, const struct part *at)
{
    int x, y;
    if (tile->pass->recorder == NULL)
        return true;
    const struct lom_bounds *b = &tile->pass->recorder->bounds;
    find_pixel(tile, place_of(tile, at, 0), &x, &y);
    return x > b->right || x + 1 < b->left || y > b->bottom || y + 1 < b->top;
}

void lom_record_covered(struct lom_tile *tile, const struct part *at, const lom_mask *covered, const lom_mask *inside,
                        const lom_float l[3], const lom_float *z)
{
    if (tile->pass->tallier != NULL)
        lom_tally_inside(tile, inside);
    if (is_beside(tile, at))
        return;
    lom_float units = tile->depth != NULL ? lom_depth_units(tile->pass, *z) : *z;
    for (int i = 0; i < LOM_LANES; i++) {
        int x, y, place = place_of(tile, at, i);
        size_t next = 0;
        struct record_pixel *pixel;
        find_pixel(tile, place, &x, &y);
        while ((*covered)[i] != 0 && (pixel = lom_record_next(tile->pass->recorder, x, y, &next)) != NULL) {
            struct record_raw *raw = lom_record_allocate(&pixel->memory, sizeof *raw);
            if (raw == NULL)
                return;
            *raw = (struct record_raw){ .chunk = tile->chunk, .triangle = at->number, .next = pixel->raw };
            pixel->raw = raw;
            lom_fragment_record *f = &raw->fragment;
            for (int k = 0; k < 3; k++)
                f->l[k] = l[k][i];
            f->inside_distances = (*inside)[i] != 0;
            f->z = (*z)[i];
            f->depth_passed = f->inside_distances;
            if (tile->depth != NULL) {
                f->depth = stored_depth(tile->pass, units[i]);
                f->depth_before = stored_depth(tile->pass, tile->depth[place]);
            }
        }
    }
}

void lom_record_tested(struct lom_tile *tile, const struct part *at, const lom_mask *passed)
{
    if (tile->pass->tallier != NULL)
        lom_tally_tested(tile, place_of(tile, at, 0), passed);
    if ((!tile->tests_early && !tile->tests_all) || is_beside(tile, at))
        return;
    for (int i = 0; i < LOM_LANES; i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((raw = next_raw(tile, place_of(tile, at, i), at->number, &next)) != NULL) {
            raw->fragment.depth_tested = raw->fragment.inside_distances && !raw->fragment.stencil_failed;
            raw->fragment.depth_passed = (*passed)[i] != 0;
            raw->fragment.depth_written = raw->fragment.depth_passed && tile->draw->depth_write;
        }
    }
}

void lom_record_stencil(struct lom_tile *tile, const struct part *at, const lom_mask *failed)
{
    for (int i = 0; i < LOM_LANES && !is_beside(tile, at); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((*failed)[i] != 0 && (raw = next_raw(tile, place_of(tile, at, i), at->number, &next)) != NULL)
            raw->fragment.stencil_failed = true;
    }
}

/* The fragments of lane i of the packet at hand. */
static struct record_raw *next_of_lane(const struct lom_tile *tile, int i, size_t *next)
{
    const struct lom_packet *packet = worker_of(tile)->packet;
    if (packet->covered[i] == 0)
        return NULL;
    return next_raw(tile, packet->places.pixel[i], packet->triangle[packet->which[i]], next);
}

void lom_record_sprites(struct lom_tile *tile)
{
    if (tile->pass->recorder != NULL)
        worker_of(tile)->watches = false;
    lom_open_notes(NULL);
}

void lom_record_sprite_covered(struct lom_tile *tile, const lom_mask *covered)
{
    if (tile->pass->tallier != NULL)
        lom_tally_inside(tile, covered);
}

void lom_record_sprite_tested(struct lom_tile *tile, int place, const lom_mask *passed)
{
    if (tile->pass->tallier != NULL)
        lom_tally_tested(tile, place, passed);
}

void lom_record_sprite(struct lom_tile *tile, int place, const lom_mask *covered)
{
    if (tile->pass->tallier != NULL)
        lom_tally_sprite(tile, place, covered);
}

void lom_record_sprite_shaded(struct lom_tile *tile, const lom_fragment *out)
{
    if (tile->pass->tallier != NULL)
        lom_tally_shaded(tile, NULL, out);
}

void lom_record_packet(struct lom_tile *tile, const struct lom_packet *packet)
{
    if (tile->pass->tallier != NULL)
        lom_tally_packet(tile, packet);
    if (tile->pass->recorder == NULL)
        return;
    struct record_worker *worker = worker_of(tile);
    worker->packet = packet;
    worker->watches = false;
    for (int i = 0; i < LOM_LANES; i++) {
        size_t next = 0;
        worker->watches |= next_of_lane(tile, i, &next) != NULL;
    }
    lom_open_notes(worker->watches ? &worker->notes : NULL);
}

void lom_record_weights(struct lom_tile *tile, const lom_float *b1, const lom_float *b2)
{
    for (int i = 0; i < LOM_LANES && is_watched(tile); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((raw = next_of_lane(tile, i, &next)) != NULL) {
            raw->fragment.b[1] = (*b1)[i];
            raw->fragment.b[2] = (*b2)[i];
            raw->fragment.b[0] = 1 - raw->fragment.b[1] - raw->fragment.b[2];
        }
    }
}

static void copy_inputs(const lom_shader *shader, const lom_varyings *in, int lane, lom_fragment_record *f)
{
    for (int v = 0; v < shader->varyings; v++) {
        if (shader->reads >> v & 1)
            f->varying[v] = in->varying[v][lane];
        if (shader->differentiates >> v & 1) {
            f->dx[v] = lom_dx(in, v)[lane];
            f->dy[v] = lom_dy(in, v)[lane];
        }
    }
}

/* Pixel and memory of a fragment, for its notes. */
static struct record_memory *memory_at(const struct lom_tile *tile, int place, size_t next)
{
    int x, y;
    find_pixel(tile, place, &x, &y);
    next--; /* of the watch that gave the fragment */
    return &lom_record_next(tile->pass->recorder, x, y, &next)->memory;
}

void lom_record_shaded(struct lom_tile *tile, const lom_varyings *in, const lom_fragment *out)
{
    if (tile->pass->tallier != NULL)
        lom_tally_shaded(tile, in, out);
    if (tile->pass->recorder == NULL)
        return;
    struct record_worker *worker = worker_of(tile);
    const lom_shader *shader = tile->draw->desc.shader;
    lom_open_notes(NULL);
    for (int i = 0; i < LOM_LANES && worker->watches; i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((raw = next_of_lane(tile, i, &next)) != NULL) {
            lom_fragment_record *f = &raw->fragment;
            f->shaded = true;
            f->discarded = shader->discards && out->discard[i] != 0;
            copy_inputs(shader, in, i, f);
            for (int c = 0; c < shader->colors; c++) {
                const float color[4] = { out->color[c].x[i], out->color[c].y[i], out->color[c].z[i],
                                         out->color[c].w[i] };
                memcpy(f->color[c], color, sizeof color);
            }
            f->notes = lom_record_notes(memory_at(tile, worker->packet->places.pixel[i], next), &worker->notes, i);
        }
    }
}

void lom_record_late(struct lom_tile *tile, const lom_float *units, const lom_float *stored, const lom_mask *tested,
                     const lom_mask *passed)
{
    for (int i = 0; i < LOM_LANES && is_watched(tile); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((*tested)[i] != 0 && (raw = next_of_lane(tile, i, &next)) != NULL) {
            lom_fragment_record *f = &raw->fragment;
            f->depth_tested = true;
            f->depth_passed = (*passed)[i] != 0;
            f->depth = stored_depth(tile->pass, (*units)[i]);
            f->depth_before = stored_depth(tile->pass, (*stored)[i]);
            f->depth_written = f->depth_passed && tile->draw->depth_write;
        }
    }
}

void lom_record_late_begins(struct lom_tile *tile, const lom_float *depth, const lom_mask *tested)
{
    const lom_float units = lom_depth_units(tile->pass, *depth);
    for (int i = 0; i < LOM_LANES && tile->depth != NULL && is_watched(tile); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((*tested)[i] != 0 && (raw = next_of_lane(tile, i, &next)) != NULL) {
            raw->fragment.depth_tested = true;
            raw->fragment.depth_passed = false; /* unless it does */
            raw->fragment.depth = stored_depth(tile->pass, units[i]);
            raw->fragment.depth_before =
                stored_depth(tile->pass, tile->depth[worker_of(tile)->packet->places.pixel[i]]);
        }
    }
}

void lom_record_late_ends(struct lom_tile *tile, const lom_mask *passed, const lom_mask *failed)
{
    for (int i = 0; i < LOM_LANES && is_watched(tile); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while (((*passed)[i] | (*failed)[i]) != 0 && (raw = next_of_lane(tile, i, &next)) != NULL) {
            lom_fragment_record *f = &raw->fragment;
            f->stencil_failed = (*failed)[i] != 0;
            f->depth_tested &= !f->stencil_failed;
            f->depth_passed = (*passed)[i] != 0;
            f->depth_written = f->depth_passed && tile->draw->depth_write;
        }
    }
}

static void read_target(const struct lom_tile *tile, int target, int place, float value[4])
{
    size_t plane = (size_t)tile->edge * (size_t)tile->edge;
    const float *floats = tile->color[target];
    for (size_t c = 0; c < 4; c++)
        value[c] = tile->pass->color[target].kind == COLOR_FLOAT
                       ? floats[c * plane + (size_t)place]
                       : (float)(((const uint32_t *)tile->color[target])[place] >> 8 * c & 255);
}

static int count_written(const struct lom_tile *tile)
{
    int outputs = tile->draw->desc.shader->colors;
    int targets = tile->pass->edges != 0 ? tile->pass->edges : tile->pass->colors;
    return outputs < targets ? outputs : targets;
}

void lom_record_write_begins(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask)
{
    for (int i = 0; i < LOM_LANES && is_watched(tile); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((*mask)[i] != 0 && (raw = next_of_lane(tile, i, &next)) != NULL)
            for (int c = 0; c < count_written(tile); c++)
                read_target(tile, c, places->pixel[i], raw->fragment.write[c].before);
    }
}

/* A channel as it goes into the blend: of 8-bit unorm the code, of sRGB clamped, of floats as it is. */
static float source_of(lom_color_kind kind, float x)
{
    float bounded = x > 0 ? x < 1 ? x : 1 : 0;
    return kind == COLOR_UNORM8 ? (float)lom_unorm_of(x, 255) : kind == COLOR_SRGB8 ? bounded : x;
}

void lom_record_write_ends(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask,
                           const lom_float4 *color)
{
    if (tile->pass->tallier != NULL)
        lom_tally_written(tile, places, mask);
    for (int i = 0; i < LOM_LANES && is_watched(tile); i++) {
        size_t next = 0;
        struct record_raw *raw;
        while ((*mask)[i] != 0 && (raw = next_of_lane(tile, i, &next)) != NULL)
            for (int t = 0; t < count_written(tile); t++) {
                const float source[4] = { color[t].x[i], color[t].y[i], color[t].z[i], color[t].w[i] };
                lom_write_record *write = &raw->fragment.write[t];
                write->written = true;
                for (int c = 0; c < 4; c++)
                    write->source[c] = source_of(tile->pass->color[t].kind, source[c]);
                read_target(tile, t, places->pixel[i], write->after);
            }
    }
}
