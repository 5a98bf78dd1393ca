/* Stage 5 of 7: raster. In: the triangles of a tile, in order. Out: covered fragments that pass the early depth test,
 * in the queue. Works on 4x4 windows: 16 pixels in the order of tile memory (blocks of 2x2), LOM_LANES at a time.
 *
 * Invariant: the weights l of a pixel are fl(fl(E) * fl(1 / area)) of the exact integers E and area, whatever path the
 * triangle took: float and int32 where those are exact, else double, which holds every edge function exactly. */
#include "pipeline/window.h"

enum { AHEAD = 8 }; /* triangles: half of them lie in another core's cache, some hundred cycles away */

/* Edge functions of a triangle that fits a window are below 2^24: exact in float. */
static void raster_window(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    int left = (int)(t->primitive.first & 0xfffe) - tile->x, top = (int)(t->primitive.first >> 16 & 0xfffe) - tile->y;
    struct part at = { t, number, memory_index(tile, left, top), 0, find_depth(t) };
    for (; at.part < PARTS; at.part++) {
        uint32_t bits = (t->primitive.state & 0xffff) >> at.part * LOM_LANES & ((1u << LOM_LANES) - 1);
        if (bits == 0)
            continue;
        lom_float x = lom_to_float(lane_x(at.part)), y = lom_to_float(lane_y(at.part));
        lom_float e1 = x * t->step_x1 + y * t->step_y1 + (float)t->start[0];
        lom_float e2 = x * t->step_x2 + y * t->step_y2 + (float)t->start[1];
        lom_float l[3] = { ((float)t->area - e1 - e2) * t->inverse_area, e1 * t->inverse_area, e2 * t->inverse_area };
        lom_mask covered = lom_mask_of_bits(bits);
        LOM_WIDE(lom_emit)(tile, &at, &covered, l, false);
    }
}

/* An edge function with its values in int32: at a window's first pixel, and its steps. */
struct small_edge {
    int32_t start, dx, dy;
    int bias;
};

/* Its values at a window's pixels, less that at the tile's first pixel. */
LOM_INLINE lom_int small_lanes(const struct small_edge *e, int part)
{
    lom_int x = lane_x(part), y = lane_y(part);
    return (-(x & 1) & e->dx) + (-(x >> 1) & (e->dx * 2)) + (-(y & 1) & e->dy) + (-(y >> 1) & (e->dy * 2));
}

static void find_small_edges(const struct lom_tile *tile, const lom_triangle *t, const struct lom_bounds *b,
                             struct small_edge e[3])
{
    int x = (b->left & ~1) - tile->x, y = (b->top & ~1) - tile->y; /* where the starts are valid */
    for (int i = 1; i < 3; i++) {
        e[i].dx = lom_int_of(i == 1 ? t->step_x1 : t->step_x2);
        e[i].dy = lom_int_of(i == 1 ? t->step_y1 : t->step_y2);
        e[i].start = t->start[i - 1] - e[i].dx * x - e[i].dy * y;
    }
    e[0].dx = -(e[1].dx + e[2].dx);
    e[0].dy = -(e[1].dy + e[2].dy);
    e[0].start = t->area - e[1].start - e[2].start;
    for (int i = 0; i < 3; i++)
        e[i].bias = bias_of(e[i].dx, e[i].dy);
}

static void raster_small(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    struct lom_bounds b = lom_bounds_of(&t->primitive);
    struct window_range r = windows_of(tile, &b);
    struct small_edge e[3];
    bool cut = t->primitive.state >> TRIANGLE_CUT & 1;
    find_small_edges(tile, t, &b, e);
    struct part at = { t, number, 0, 0, find_depth(t) };
    for (; at.part < PARTS; at.part++) {
        lom_int lanes[3];
        for (int i = 0; i < 3; i++)
            lanes[i] = small_lanes(&e[i], at.part) + e[i].start;
        for (int y = r.y0; y <= r.y1; y += 4)
            for (int x = r.x0; x <= r.x1; x += 4) {
                lom_int e0 = lanes[0] + (e[0].dx * x + e[0].dy * y), e1 = lanes[1] + (e[1].dx * x + e[1].dy * y),
                        e2 = lanes[2] + (e[2].dx * x + e[2].dy * y);
                lom_mask covered = ((e0 + e[0].bias) | (e1 + e[1].bias) | (e2 + e[2].bias)) >= 0;
                if (cut)
                    covered &= inside_bounds(tile, &b, x, y, at.part);
                if (!lom_any(covered))
                    continue;
                at.base = memory_index(tile, x, y);
                lom_float l[3] = { lom_to_float(e0) * t->inverse_area, lom_to_float(e1) * t->inverse_area,
                                   lom_to_float(e2) * t->inverse_area };
                LOM_WIDE(lom_emit)(tile, &at, &covered, l, false);
            }
    }
}

/* Whether a fragment that fails the depth test now fails it after its shader, too: the shader leaves its depth as it is, and
 * what the draw's own fragments write until then does not let it pass. */
static bool rejects_early(const struct lom_tile *tile, const struct lom_draw *draw)
{
    bool stays = !draw->depth_write || (draw->compare != LOM_COMPARE_NOT_EQUAL && draw->compare != LOM_COMPARE_ALWAYS);
    return tile->depth != NULL && draw->late_depth && !draw->desc.shader->writes_depth && stays &&
           !tile->pass->one_by_one && !draw->desc.per_sample && !draw->full_tests;
}

static void raster_alone(struct lom_tile *tile, int32_t number)
{
    lom_triangle found;
    const lom_triangle *t = &found;
    lom_find_triangle(tile->chunk, &tile->chunk->primitives[number], &found);
    if (tile->pass->samples > 1) {
        LOM_WIDE(lom_raster_sampled)(tile, t, number);
        return;
    }
    switch (lom_kind_of(&t->primitive)) {
    case TRIANGLE_WINDOW:
        raster_window(tile, t, number);
        break;
    case TRIANGLE_SMALL:
        raster_small(tile, t, number);
        break;
    case TRIANGLE_LARGE:
        LOM_WIDE(lom_raster_large)(tile, t, number);
        break;
    case TRIANGLE_NONE: /* never here */
        break;
    }
}

/* Sprites, points and lines. */
static void raster_others(struct lom_tile *tile, const uint32_t *list, size_t count)
{
    if (tile->draw->lines)
        LOM_WIDE(lom_raster_lines)(tile, list, count);
    else if (tile->pass->samples > 1)
        LOM_WIDE(lom_raster_sprite_samples)(tile, list, count);
    else
        LOM_WIDE(lom_raster_sprites)(tile, list, count);
}

static void add_to_list(struct lom_tile *tile, uint32_t number)
{
    struct lom_list *list = &tile->list;
    list->number[list->triangles++] = number;
    if (list->triangles == LIST_TRIANGLES)
        LOM_WIDE(lom_drain_list)(tile, false);
}

/* The triangles of a chunk that has none but those that go to the list: their records are not looked at here. */
static void list_all(struct lom_tile *tile, const uint32_t *from, size_t count)
{
    struct lom_list *list = &tile->list;
    while (count > 0) {
        size_t room = LIST_TRIANGLES - (size_t)list->triangles, some = count < room ? count : room;
        for (size_t i = 0; i < some; i++) {
            __builtin_prefetch(&tile->chunk->primitives[from[i]]);
            list->number[(size_t)list->triangles + i] = from[i];
        }
        list->triangles += (int)some;
        if (list->triangles == LIST_TRIANGLES)
            LOM_WIDE(lom_drain_list)(tile, false);
        from += some;
        count -= some;
    }
}

void LOM_WIDE(lom_turn_to_call)(struct lom_tile *tile, uint32_t number)
{
    const struct lom_chunk *chunk = tile->chunk;
    size_t part = number * chunk->part_count / chunk->triangle_count; /* near it: calls have about as many primitives */
    while (part > 0 && chunk->parts[part - 1].end > number)
        part--;
    while (chunk->parts[part].end <= number)
        part++;
    tile->uniforms = lom_uniforms_of_part(tile->pass, chunk, part);
    tile->call_end = chunk->parts[part].end;
}

void LOM_WIDE(lom_raster)(struct lom_tile *tile, const struct lom_chunk *chunk, const uint32_t *list, size_t count)
{
    const struct lom_draw *draw = chunk->draw;
    bool together = draw->packs && !tile->pass->one_by_one;
    if (tile->chunk != chunk)
        LOM_WIDE(lom_flush)(tile);
    tile->chunk = chunk;
    tile->uniforms = chunk->uniforms;
    tile->call_end = chunk->parts == NULL ? UINT32_MAX : 0;
    tile->facet.primitive = NULL;
    tile->tests_early = tile->depth != NULL && !draw->late_depth && !draw->full_tests &&
                        (draw->compare != LOM_COMPARE_ALWAYS || draw->depth_write);
    tile->tests_all = draw->full_tests && !draw->late_depth;
    tile->rejects_early = rejects_early(tile, draw);
    size_t folded = tile->is_whole ? LOM_WIDE(lom_fold)(tile, list, count) : 0;
    if (tile->is_whole && folded < count)
        lom_load_whole_tile(tile);
    if (draw->sprites || draw->lines) {
        raster_others(tile, list, count);
        return;
    }
    if (together && chunk->all_listed)
        list_all(tile, list + folded, count - folded);
    for (size_t i = folded; i < count && !(together && chunk->all_listed); i++) {
        __builtin_prefetch(&chunk->primitives[list[i + AHEAD < count ? i + AHEAD : count - 1]]);
        if (together && (chunk->primitives[list[i]].state >> TRIANGLE_LISTED & 1) != 0) {
            add_to_list(tile, list[i]);
            continue;
        }
        LOM_WIDE(lom_drain_list)(tile, true);
        if (list[i] >= tile->call_end) {
            LOM_WIDE(lom_flush)(tile); /* the queue's fragments are of one call */
            LOM_WIDE(lom_turn_to_call)(tile, list[i]);
        }
        raster_alone(tile, (int32_t)list[i]);
    }
    LOM_WIDE(lom_drain_list)(tile, true);
}
