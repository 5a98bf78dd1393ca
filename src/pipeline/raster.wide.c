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
    int left = (int)(t->first & 0xfffe) - tile->x, top = (int)(t->first >> 16 & 0xfffe) - tile->y;
    struct part at = { t, number, memory_index(tile, left, top), 0, find_depth(t) };
    for (; at.part < PARTS; at.part++) {
        uint32_t bits = (t->state & 0xffff) >> at.part * LOM_LANES & ((1u << LOM_LANES) - 1);
        if (bits == 0)
            continue;
        lom_float x = lom_to_float(lane_x(at.part)), y = lom_to_float(lane_y(at.part));
        lom_float e1 = x * t->step_x1 + y * t->step_y1 + (float)t->small.start[0];
        lom_float e2 = x * t->step_x2 + y * t->step_y2 + (float)t->small.start[1];
        lom_float l[3] = { ((float)t->small.area - e1 - e2) * t->inverse_area, e1 * t->inverse_area,
                           e2 * t->inverse_area };
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
        e[i].start = t->small.start[i - 1] - e[i].dx * x - e[i].dy * y;
    }
    e[0].dx = -(e[1].dx + e[2].dx);
    e[0].dy = -(e[1].dy + e[2].dy);
    e[0].start = t->small.area - e[1].start - e[2].start;
    for (int i = 0; i < 3; i++)
        e[i].bias = bias_of(e[i].dx, e[i].dy);
}

static void raster_small(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    struct lom_bounds b = lom_bounds_of(t);
    struct window_range r = windows_of(tile, &b);
    struct small_edge e[3];
    bool cut = t->state >> TRIANGLE_CUT & 1;
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

/* ---- small triangles to the list ---- */

/* The codes of the pixels of a 2x2 block whose bits are set, less that of its first. */
#define CODE(k) ((k) | ((k)&1) << CODE_X | ((k) >> 1) << CODE_Y)
static const int32_t block_codes[16][4] = {
    { 0 },
    { CODE(0) },
    { CODE(1) },
    { CODE(0), CODE(1) },
    { CODE(2) },
    { CODE(0), CODE(2) },
    { CODE(1), CODE(2) },
    { CODE(0), CODE(1), CODE(2) },
    { CODE(3) },
    { CODE(0), CODE(3) },
    { CODE(1), CODE(3) },
    { CODE(0), CODE(1), CODE(3) },
    { CODE(2), CODE(3) },
    { CODE(0), CODE(2), CODE(3) },
    { CODE(1), CODE(2), CODE(3) },
    { CODE(0), CODE(1), CODE(2), CODE(3) },
};

static const uint8_t block_counts[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };

/* Adds the pixels of a part of a window whose lanes are set; `codes` are those of all its pixels. Without a branch: one
 * that depends on a mask is guessed wrong too often. */
LOM_INLINE void list_part(struct lom_list *list, lom_mask covered, lom_int codes)
{
    int32_t *to = list->code + list->count;
    uint32_t bits = lom_bits(covered);
    if (LOM_LANES > 4) {
        lom_compress((float *)to, covered, lom_as_float(codes));
        list->count += (int)lom_count_bits(bits);
        return;
    }
    /* A block, and the baseline has neither a permutation to compress by nor a count of bits. */
    lom_store_int(to, lom_load_int(block_codes[bits]) + codes[0]);
    list->count += block_counts[bits];
}

/* The code of pixel (x, y) of the tile, both even, of the list's next triangle. */
LOM_INLINE int32_t code_of(const struct lom_tile *tile, int x, int y)
{
    uint32_t next = (uint32_t)tile->list.triangles << CODE_TRIANGLE;
    return (int32_t)(next + (uint32_t)(memory_index(tile, x, y) + (x << CODE_X) + (y << CODE_Y)));
}

LOM_INLINE lom_int window_codes(const struct lom_tile *tile, int part)
{
    return lom_load_int(tile->offset + part * LOM_LANES) + (lane_x(part) << CODE_X) + (lane_y(part) << CODE_Y);
}

static void list_window(struct lom_tile *tile, const lom_triangle *t)
{
    int left = (int)(t->first & 0xfffe) - tile->x, top = (int)(t->first >> 16 & 0xfffe) - tile->y;
    int32_t code = code_of(tile, left, top);
    for (int part = 0; part < PARTS; part++) {
        uint32_t bits = (t->state & 0xffff) >> part * LOM_LANES & ((1u << LOM_LANES) - 1);
        list_part(&tile->list, lom_mask_of_bits(bits), window_codes(tile, part) + code);
    }
}

/* The same windows as raster_small; the third edge is what the other two leave of the area. The biases of the top-left
 * rule are part of all of them. False, and nothing done, where they are many: those are mostly packets by themselves. */
static bool list_small(struct lom_tile *tile, const lom_triangle *t)
{
    struct lom_bounds b = lom_bounds_of(t);
    struct window_range r = windows_of(tile, &b);
    struct small_edge e[3];
    bool cut = t->state >> TRIANGLE_CUT & 1;
    if (((r.x1 - r.x0) / 4 + 1) * ((r.y1 - r.y0) / 4 + 1) > LIST_WINDOWS)
        return false;
    find_small_edges(tile, t, &b, e);
    lom_int whole = lom_splat_int(t->small.area + e[0].bias + e[1].bias + e[2].bias);
    lom_int lanes1[PARTS], lanes2[PARTS], codes[PARTS];
    for (int part = 0; part < PARTS; part++) {
        lanes1[part] = small_lanes(&e[1], part) + (e[1].start + e[1].bias);
        lanes2[part] = small_lanes(&e[2], part) + (e[2].start + e[2].bias);
        codes[part] = window_codes(tile, part);
    }
    for (int y = r.y0; y <= r.y1; y += 4)
        for (int x = r.x0; x <= r.x1; x += 4) {
            int32_t start1 = e[1].dx * x + e[1].dy * y, start2 = e[2].dx * x + e[2].dy * y, code = code_of(tile, x, y);
            for (int part = 0; part < PARTS; part++) {
                lom_int e1 = lanes1[part] + start1, e2 = lanes2[part] + start2;
                lom_mask covered = (e1 | e2 | (whole - e1 - e2)) >= 0;
                if (cut)
                    covered &= inside_bounds(tile, &b, x, y, part);
                list_part(&tile->list, covered, codes[part] + code);
            }
        }
    return true;
}

/* Whether the fragments of the draw's small triangles can be computed together, from their records alone. */
static bool packs(const struct lom_draw *draw)
{
    return !draw->constant && !draw->biased && !draw->desc.shader->quads;
}

/* False where the triangle has to be drawn by itself. */
static bool list_triangle(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    struct lom_list *list = &tile->list;
    lom_triangle_kind kind = lom_kind_of(t);
    int before = list->count;
    if (t->state >> TRIANGLE_CLIP != 0 || kind == TRIANGLE_LARGE || (kind == TRIANGLE_SMALL && !list_small(tile, t)))
        return false;
    if (kind == TRIANGLE_WINDOW)
        list_window(tile, t);
    list->row[list->triangles] = number * (int32_t)(sizeof *t / sizeof(float));
    list->triangles += list->count > before;
    if (list->count >= LIST_SIZE || list->triangles == LIST_TRIANGLES)
        LOM_WIDE(lom_drain_list)(tile);
    return true;
}

static void raster_alone(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    switch (lom_kind_of(t)) {
    case TRIANGLE_WINDOW:
        raster_window(tile, t, number);
        break;
    case TRIANGLE_SMALL:
        raster_small(tile, t, number);
        break;
    case TRIANGLE_LARGE:
        LOM_WIDE(lom_raster_large)(tile, t, number);
        break;
    case TRIANGLE_SPRITE: /* never here */
        break;
    }
}

void LOM_WIDE(lom_raster)(struct lom_tile *tile, const struct lom_chunk *chunk, const uint32_t *list, size_t count)
{
    const struct lom_draw *draw = chunk->draw;
    bool together = packs(draw) && !tile->pass->one_by_one;
    if (tile->chunk != chunk)
        LOM_WIDE(lom_flush)(tile);
    tile->chunk = chunk;
    tile->tests_early =
        tile->depth != NULL && !draw->late_depth && (draw->compare != LOM_COMPARE_ALWAYS || draw->depth_write);
    size_t folded = tile->is_whole ? LOM_WIDE(lom_fold)(tile, list, count) : 0;
    if (tile->is_whole && folded < count)
        lom_load_whole_tile(tile);
    if (draw->desc.topology == LOM_SPRITES) {
        LOM_WIDE(lom_raster_sprites)(tile, list, count);
        return;
    }
    for (size_t i = folded; i < count; i++) {
        const lom_triangle *t = &chunk->triangles[list[i]];
        __builtin_prefetch(&chunk->triangles[list[i + AHEAD < count ? i + AHEAD : count - 1]]);
        if (together && list_triangle(tile, t, (int32_t)list[i]))
            continue;
        LOM_WIDE(lom_drain_list)(tile);
        raster_alone(tile, t, (int32_t)list[i]);
    }
    LOM_WIDE(lom_drain_list)(tile);
}
