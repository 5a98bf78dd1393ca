/* Stages 5 and 6 of 7 for sprites and points. In: those of a tile, in order. Out: their fragments, shaded, on to the output
 * stage: a window's part at a time, without the queue, since what all fragments of a sprite share is found once for it.
 *
 * Invariant: s and t at a pixel are fl(fl(dx ds/dx) + fl(dy ds/dy)) of its exact distance to the middle, whatever tile
 * or part of a window it lies in. What a point covers follows from that distance itself. */
#include "pipeline/mark_edges.h"
#include "pipeline/record.h"
#include "pipeline/sample_depth.h"
#include "pipeline/sample_tests.h"

enum { AHEAD = 4 };

/* What is covered: -1 <= s, t < 1; s^2 + t^2 < 1; -half <= dx, dy < half; the last two together. */
enum shape { PARALLELOGRAM, DISC, SQUARE, ROUND_POINT };

static enum shape shape_of(const struct lom_draw *draw)
{
    if (draw->drawn == LOM_POINTS)
        return draw->desc.shader->round ? ROUND_POINT : SQUARE;
    return draw->desc.shader->round ? DISC : PARALLELOGRAM;
}

/* A sprite over one tile. */
struct sprite {
    lom_triangle record;
    enum shape shape;
    float half; /* of a point's side */
    struct lom_bounds bounds;
    float x, y;               /* of the centre of the tile's first pixel, from the middle; pixels, exact */
    lom_float x_away[PARTS];  /* of the lanes of the strip's first window */
    lom_float down[PARTS][2]; /* along a strip of windows: what its rows add to s and t */
    lom_float y_away[PARTS];  /* and how far they lie */
    struct lom_varyings in;
    lom_int place; /* of shading, where pixels have several samples */
};

/* The guard band keeps the difference below 2^24 units. */
static float centre(int pixel, int origin, int32_t middle)
{
    return (float)((pixel - origin) * SUBPIXELS + SUBPIXELS / 2 - middle) * (1.0f / SUBPIXELS);
}

static void begin_sprite(const struct lom_tile *tile, const lom_primitive *p, struct sprite *sprite)
{
    const lom_shader *shader = tile->draw->desc.shader;
    const float *row = tile->chunk->rows + p->row[0];
    const lom_triangle *t = &sprite->record;
    lom_varyings *in = &sprite->in;
    int32_t middle[2];
    in->levels = NULL;
    memcpy(middle, row, sizeof middle);
    lom_find_sprite(tile->chunk, p, &sprite->record);
    sprite->shape = shape_of(tile->draw);
    sprite->half = row[tile->draw->axis_offset];
    sprite->bounds = lom_bounds_of(p);
    sprite->x = centre(tile->x, tile->draw->desc.viewport.x, middle[0]);
    sprite->y = centre(tile->y, tile->draw->desc.viewport.y, middle[1]);
    for (int part = 0; part < PARTS; part++)
        sprite->x_away[part] = lom_to_float(lane_x(part)) + sprite->x;
    for (uint32_t reads = shader->reads & ((UINT32_C(1) << shader->varyings) - 1); reads != 0; reads &= reads - 1) {
        int v = __builtin_ctz(reads);
        in->varying[v] = lom_splat(row[ROW_HEADER + v]);
    }
    for (uint32_t slopes = shader->differentiates; slopes != 0; slopes &= slopes - 1) /* of points */
        in->delta[0][__builtin_ctz(slopes)] = in->delta[1][__builtin_ctz(slopes)] = (lom_float){ 0 };
    in->z = lom_splat(t->depth[0]);
    in->w = 1.0f / lom_splat(row[3]);
    in->front = lom_splat_int(-1);
    in->dx[0] = lom_splat(t->step_x1);
    in->dy[0] = lom_splat(t->step_y1);
    in->dx[1] = lom_splat(t->step_x2);
    in->dy[1] = lom_splat(t->step_y2);
}

/* Distances to a point's middle are exact: multiples of 1/256 below 2^16. */
LOM_INLINE lom_mask cover_shape(const struct sprite *sprite, lom_float right, lom_float down, lom_float s, lom_float t)
{
    const float half = sprite->half;
    switch (sprite->shape) {
    case PARALLELOGRAM:
        return (s >= -1.0f) & (s < 1.0f) & (t >= -1.0f) & (t < 1.0f);
    case DISC:
        return s * s + t * t < 1.0f;
    case SQUARE:
        return (right >= -half) & (right < half) & (down >= -half) & (down < half);
    case ROUND_POINT:
        return (right >= -half) & (right < half) & (down >= -half) & (down < half) & (s * s + t * t < 1.0f);
    }
    return (lom_mask){ 0 };
}

static void begin_strip(struct sprite *sprite, int y)
{
    for (int part = 0; part < PARTS; part++) {
        lom_float y_away = lom_to_float(lane_y(part)) + (sprite->y + (float)y);
        sprite->y_away[part] = y_away;
        sprite->down[part][0] = y_away * sprite->record.step_y1;
        sprite->down[part][1] = y_away * sprite->record.step_y2;
    }
}

/* With draw->full_tests. */
static __attribute__((noinline)) void test_part(struct lom_tile *tile, const struct sprite *sprite, int base, int part,
                                                lom_mask *covered)
{
    const struct part at = { .triangle = &sprite->record, .number = -1, .base = base, .part = part };
    LOM_WIDE(lom_test_part)(tile, &at, covered, &sprite->in.z);
}

static __attribute__((noinline)) void write_tested(struct lom_tile *tile, const struct lom_places *places,
                                                   const lom_mask *mask, const lom_fragment *out)
{
    const struct lom_packet packet = { .places = *places, .triangles = 1 };
    LOM_WIDE(lom_write_tested)(tile, &packet, mask, out);
}

static void shade(struct lom_tile *tile, struct sprite *sprite, int x, int y, int part, int place)
{
    const struct lom_draw *draw = tile->draw;
    const lom_shader *shader = draw->desc.shader;
    lom_varyings *in = &sprite->in;
    struct lom_places places;
    lom_fragment out;
    places.block = true;
    places.pixel[0] = place;
    if (shader->reads_position) {
        in->x = lom_to_float(lane_x(part) + (tile->x + x)) + 0.5f;
        in->y = lom_to_float(lane_y(part) + (tile->y + y)) + 0.5f;
    }
    if (shader->reads_depth)
        in->target_depth =
            lom_depth_of_units(tile->pass, lom_as_float(lom_load_block((const int32_t *)tile->depth + place, tile)));
    out.depth = in->z;
    out.discard = (lom_mask){ 0 };
    LOM_RECORD_HOOK(lom_record_sprite, tile, place, &in->covered);
    shader->fragment[draw->variant](&out, in, tile->uniforms);
    LOM_RECORD_HOOK(lom_record_sprite_shaded, tile, &out);
    tile->packets++;
    if (draw->marks_edges)
        LOM_WIDE(lom_mark_no_edges)(tile);
    lom_mask mask = shader->discards ? in->covered & ~out.discard : in->covered;
    if (draw->desc.alpha_to_coverage)
        mask &= out.color[0].w >= 0.5f;
    if (draw->late_depth && draw->full_tests)
        write_tested(tile, &places, &mask, &out);
    else if (draw->late_depth)
        LOM_WIDE(lom_write_in_order)(tile, &places, &mask, true, &out);
    else if (draw->output == OUTPUT_FLOATS_MULTIPLIED)
        lom_lay_over(tile, &places, mask, out.color);
    else
        LOM_WIDE(lom_write_packet)(tile, &places, &mask, out.color);
}

/* The window at (x, y) of the tile. */
static void raster_window(struct lom_tile *tile, struct sprite *sprite, int x, int y, bool shades)
{
    const lom_triangle *t = &sprite->record;
    bool cut = t->primitive.state >> TRIANGLE_CUT & 1;
    for (int part = 0; part < PARTS; part++) {
        lom_float x_away = sprite->x_away[part] + (float)x;
        lom_float p = x_away * t->step_x1 + sprite->down[part][0], q = x_away * t->step_x2 + sprite->down[part][1];
        lom_mask covered = cover_shape(sprite, x_away, sprite->y_away[part], p, q);
        int place = memory_index(tile, x, y) + tile->offset[part * LOM_LANES];
        if (cut)
            covered &= inside_bounds(tile, &sprite->bounds, x, y, part);
        LOM_RECORD_HOOK(lom_record_sprite_covered, tile, &covered);
        if (tile->tests_early && lom_any(covered))
            covered = lom_test_depth(tile, place, covered, sprite->in.z);
        else if (tile->tests_all)
            test_part(tile, sprite, memory_index(tile, x, y), part, &covered);
        LOM_RECORD_HOOK(lom_record_sprite_tested, tile, place, &covered);
        if (!lom_any(covered))
            continue;
        tile->fragments += lom_count(covered);
        sprite->in.covered = covered;
        sprite->in.st[0] = p;
        sprite->in.st[1] = q;
        if (shades)
            shade(tile, sprite, x, y, part, place);
    }
}

void LOM_WIDE(lom_raster_sprites)(struct lom_tile *tile, const uint32_t *list, size_t count)
{
    const lom_primitive *primitives = tile->chunk->primitives;
    const lom_shader *shader = tile->draw->desc.shader;
    bool shades = shader->fragment[tile->draw->variant] != NULL;
    struct sprite sprite;
    LOM_RECORD_HOOK(lom_record_sprites, tile);
    for (size_t i = 0; i < count; i++) {
        const lom_primitive *ahead = &primitives[list[i + AHEAD < count ? i + AHEAD : count - 1]];
        __builtin_prefetch(ahead);
        begin_sprite(tile, &primitives[list[i]], &sprite);
        struct window_range r = windows_of(tile, &sprite.bounds);
        for (int y = r.y0; y <= r.y1; y += 4) {
            begin_strip(&sprite, y);
            for (int x = r.x0; x <= r.x1; x += 4)
                raster_window(tile, &sprite, x, y, shades);
        }
    }
}

/* ---- several samples a pixel ---- */

/* s and t at a place of the pixels of a part, which lies so far from their centres; the lanes that are inside. */
LOM_INLINE lom_mask cover_place(const struct sprite *sprite, int x, int y, int part,
                                struct lom_sample_offset from_centre, lom_float st[2])
{
    const lom_triangle *t = &sprite->record;
    lom_float right = lom_to_float(lane_x(part)) + (sprite->x + (float)x + (float)from_centre.x * (1.0f / 16));
    lom_float down = lom_to_float(lane_y(part)) + (sprite->y + (float)y + (float)from_centre.y * (1.0f / 16));
    lom_float p = st[0] = right * t->step_x1 + down * t->step_y1, q = st[1] = right * t->step_x2 + down * t->step_y2;
    return cover_shape(sprite, right, down, p, q);
}

/* A packet of the sprite: the lanes of these samples, shaded at a place. */
static void shade_samples(struct lom_tile *tile, struct sprite *sprite, int x, int y, struct lom_packet *packet,
                          int part)
{
    lom_varyings *in = &sprite->in;
    packet->covered = packet->samples != 0;
    if (!lom_any(packet->covered))
        return;
    tile->fragments += lom_count(packet->covered);
    if (tile->draw->desc.shader->fragment[tile->draw->variant] == NULL)
        return;
    packet->depth = in->z;
    packet->triangles = 1;
    packet->sample_depth = (const float *)&in->z; /* one for all samples */
    packet->depth_pitch = 0;
    packet->places.block = true;
    in->x = lom_to_float(lane_x(part) + (tile->x + x)) + 0.5f;
    in->y = lom_to_float(lane_y(part) + (tile->y + y)) + 0.5f;
    LOM_WIDE(lom_run_sampled)(tile, packet, in);
}

/* The samples of a part that are covered and pass the early depth test; s and t of each. */
static void cover_samples(struct lom_tile *tile, struct sprite *sprite, int x, int y, int part, lom_int pixel,
                          lom_mask covered[LOM_MAX_SAMPLES], lom_float st[LOM_MAX_SAMPLES][2])
{
    const bool cut = sprite->record.primitive.state >> TRIANGLE_CUT & 1;
    lom_mask allowed = cut ? inside_bounds(tile, &sprite->bounds, x, y, part) : lom_splat_int(-1), placed;
    lom_float depth[LOM_MAX_SAMPLES];
    placed = cover_place(sprite, x, y, part, (struct lom_sample_offset){ 0, 0 }, sprite->in.st) & allowed;
    sprite->place = (lom_int){ 0 };
    for (int s = 0; s < tile->pass->samples; s++) {
        covered[s] = cover_place(sprite, x, y, part, tile->pass->offset[s], st[s]) & allowed;
        lom_mask here = covered[s] & ~placed;
        for (int k = 0; k < 2; k++)
            sprite->in.st[k] = lom_select(here, st[s][k], sprite->in.st[k]);
        sprite->place = lom_select_int(here, lom_splat_int(s + 1), sprite->place);
        placed |= covered[s];
        depth[s] = sprite->in.z;
    }
    if (tile->tests_early)
        lom_test_sample_depths(tile, pixel, covered, depth);
    else if (tile->tests_all)
        LOM_WIDE(lom_test_samples)(tile, &pixel, true, covered, depth);
}

static void raster_sampled_part(struct lom_tile *tile, struct sprite *sprite, int x, int y, int part)
{
    const lom_int pixel = lom_load_int(tile->offset + part * LOM_LANES) + memory_index(tile, x, y);
    lom_mask covered[LOM_MAX_SAMPLES];
    lom_float st[LOM_MAX_SAMPLES][2];
    struct lom_packet packet = { .samples = { 0 } };
    lom_store_int(packet.places.pixel, pixel);
    cover_samples(tile, sprite, x, y, part, pixel, covered, st);
    packet.place = sprite->place;
    for (int s = 0; s < tile->pass->samples; s++) {
        packet.samples |= covered[s] & 1 << s;
        if (!tile->draw->desc.per_sample)
            continue;
        memcpy(sprite->in.st, st[s], sizeof st[s]);
        packet.place = lom_splat_int(s + 1);
        shade_samples(tile, sprite, x, y, &packet, part);
        packet.samples = (lom_int){ 0 };
    }
    shade_samples(tile, sprite, x, y, &packet, part);
}

void LOM_WIDE(lom_raster_sprite_samples)(struct lom_tile *tile, const uint32_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct sprite sprite;
        begin_sprite(tile, &tile->chunk->primitives[list[i]], &sprite);
        struct window_range r = windows_of(tile, &sprite.bounds);
        for (int y = r.y0; y <= r.y1; y += 4)
            for (int x = r.x0; x <= r.x1; x += 4)
                for (int part = 0; part < PARTS; part++)
                    raster_sampled_part(tile, &sprite, x, y, part);
    }
}
