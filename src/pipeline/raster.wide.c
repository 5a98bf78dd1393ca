/* Stage 5 of 7: raster. In: the triangles of a tile, in order. Out: covered fragments that pass the early depth test,
 * in the queue. Works on 4x4 windows: 16 pixels in the order of tile memory (blocks of 2x2), LOM_LANES at a time.
 *
 * Invariant: the weights l of a pixel are fl(fl(E) * fl(1 / area)) of the exact integers E and area, whatever path the
 * triangle took: float and int32 where those are exact, else double, which holds every edge function exactly. */
#include "pipeline/packet.h"

#include <lom/lanes_mathematics.h>

enum {
    PARTS = 16 / LOM_LANES,
    AHEAD = 8 /* triangles: half of them lie in another core's cache, some hundred cycles away */
};

/* Pixel offsets within a window of the lanes of a part. */
LOM_INLINE lom_int lane_x(int part)
{
    lom_int k = lom_lane_index() + part * LOM_LANES;
    return (k & 1) + ((k >> 2) & 1) * 2;
}

LOM_INLINE lom_int lane_y(int part)
{
    lom_int k = lom_lane_index() + part * LOM_LANES;
    return ((k >> 1) & 1) + (k >> 3) * 2;
}

/* Index in tile memory of pixel (x, y) of the tile, both even. */
LOM_INLINE int memory_index(const struct lom_tile *tile, int x, int y)
{
    return y * tile->edge + x * 2;
}

/* d / w of the three vertices, scaled by a power of two so that the largest is in 1..2: no product with a weight
 * overflows, and none that could decide alone vanishes. */
static void scale_distances(const struct lom_chunk *chunk, const lom_triangle *t, int offset, float d[3])
{
    double product[3], largest = 0, scale;
    for (int k = 0; k < 3; k++) {
        const float *row = chunk->rows + t->row[k];
        product[k] = (double)row[offset] * row[ROW_HEADER - 1]; /* exact */
        double size = product[k] < 0 ? -product[k] : product[k];
        largest = size > largest ? size : largest;
    }
    uint64_t bits;
    memcpy(&bits, &largest, sizeof bits);
    bits = (UINT64_C(2046) - (bits >> 52)) << 52; /* 2^-exponent */
    memcpy(&scale, &bits, sizeof scale);
    for (int k = 0; k < 3; k++)
        d[k] = (float)(product[k] * scale);
}

/* Where a triangle crosses a user clip distance the sign of sum(l d / w) decides; it is odd in d, so d and -d share the
 * pixels exactly. Where the sum is 0 the sign of its gradient decides, as the top-left rule does for edges; the steps
 * of the edge functions add up to 0. */
static lom_mask test_distances(const struct lom_tile *tile, const lom_triangle *t, const lom_float l[3])
{
    lom_mask inside = lom_splat_int(-1);
    double x1 = t->step_x1, y1 = t->step_y1, x2 = t->step_x2, y2 = t->step_y2;
    for (uint32_t clip = t->state >> TRIANGLE_CLIP; clip != 0; clip &= clip - 1) {
        float d[3];
        scale_distances(tile->chunk, t, tile->draw->distance_offset + __builtin_ctz(clip), d);
        lom_float sum = l[0] * d[0] + l[1] * d[1] + l[2] * d[2];
        double gx = -(x1 + x2) * d[0] + x1 * d[1] + x2 * d[2], gy = -(y1 + y2) * d[0] + y1 * d[1] + y2 * d[2];
        bool keeps_zero = gx > 0 || (gx == 0 && gy >= 0);
        inside &= keeps_zero ? sum >= 0.0f : sum > 0.0f;
    }
    return inside;
}

/* The depth of a triangle: at vertex 0, its differences at the other two, and its range. */
struct depth_plane {
    float at, by1, by2, low, high;
};

LOM_INLINE struct depth_plane find_depth(const lom_triangle *t)
{
    float z0 = t->depth[0], z1 = z0 + t->depth[1], z2 = z0 + t->depth[2];
    float low = z0 < z1 ? z0 : z1, high = z0 > z1 ? z0 : z1;
    return (struct depth_plane){ z0, t->depth[1], t->depth[2], low < z2 ? low : z2, high > z2 ? high : z2 };
}

LOM_INLINE lom_float interpolate_depth(const struct depth_plane *p, const lom_float l[3])
{
    return lom_clamp(p->at + l[1] * p->by1 + l[2] * p->by2, lom_splat(p->low), lom_splat(p->high));
}

/* The depth with the draw's bias, rounded once to what the attachment holds. Not inlined: few draws have one. */
static __attribute__((noinline)) void offset_depth(const struct lom_tile *tile, const lom_triangle *t, lom_float *z)
{
    double scale = tile->pass->depth_scale;
    lom_double one = lom_splat_double(1), sum = lom_widen(*z) + lom_depth_offset(tile->pass, tile->chunk, t);
    sum = lom_select_double(sum > 0.0, lom_select_double(sum < 1.0, sum, one), one - 1.0);
    if (scale != 0)
        sum = ((sum * scale + LOM_NEAREST) - LOM_NEAREST) / scale;
    *z = lom_narrow(sum);
}

/* Early depth test and write of a part; the lanes that pass. */
LOM_INLINE lom_mask test_depth(struct lom_tile *tile, int place, lom_mask covered, lom_float z)
{
    const struct lom_draw *draw = tile->draw;
    int32_t *memory = (int32_t *)tile->depth + place;
    lom_float stored = lom_as_float(lom_load_block(memory, tile));
    lom_float units = lom_depth_units(tile->pass, z);
    lom_mask passed = covered & lom_compare_depth(draw->compare, units, stored);
    if (draw->depth_write)
        lom_store_block(memory, tile, lom_as_int(lom_select(passed, units, stored)));
    return passed;
}

/* A part of a window: which triangle, which number it has in the chunk, where the window begins in tile memory. */
struct part {
    const lom_triangle *triangle;
    int32_t number;
    int base, part;
    struct depth_plane depth;
};

/* One part of a window: clip distances, early depth, and on to the fragment stage. */
LOM_INLINE void emit(struct lom_tile *tile, struct part at, lom_mask covered, const lom_float l[3], bool alone)
{
    const struct lom_draw *draw = tile->draw;
    const lom_triangle *t = at.triangle;
    lom_float z = { 0 };
    if (t->state >> TRIANGLE_CLIP != 0)
        covered &= test_distances(tile, t, l);
    if (tile->depth != NULL || draw->queues_depth)
        z = interpolate_depth(&at.depth, l);
    if (draw->biased) {
        lom_float moved = z;
        offset_depth(tile, t, &moved);
        z = moved;
    }
    if (tile->tests_early)
        covered = test_depth(tile, at.base + tile->offset[at.part * LOM_LANES], covered, z);
    uint32_t bits = lom_bits(covered);
    if (bits == 0)
        return;
    tile->fragments += (uint64_t)__builtin_popcount(bits);
    if (draw->desc.shader->fragment[draw->variant] == NULL)
        return;
    struct lom_fragments f;
    f.number = at.number;
    f.base = at.base;
    f.part = at.part;
    f.covered = covered;
    f.depth = z;
    for (int k = 0; k < 3; k++)
        f.l[k] = l[k];
    LOM_WIDE(lom_deliver)(tile, &f, alone);
}

/* Lanes of the window at (x, y) of the tile that the triangle's pixel bounds allow. */
static lom_mask inside_bounds(const struct lom_tile *tile, const struct lom_bounds *b, int x, int y, int part)
{
    lom_int px = lane_x(part) + (tile->x + x), py = lane_y(part) + (tile->y + y);
    return (px >= b->left) & (px <= b->right) & (py >= b->top) & (py <= b->bottom);
}

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
        lom_float e1 = x * t->step_x1 + y * t->step_y1 + t->window.start[0];
        lom_float e2 = x * t->step_x2 + y * t->step_y2 + t->window.start[1];
        lom_float l[3] = { (t->window.area - e1 - e2) * t->inverse_area, e1 * t->inverse_area, e2 * t->inverse_area };
        emit(tile, at, lom_mask_of_bits(bits), l, false);
    }
}

/* Windows aligned to 4 pixels that the triangle's bounds touch, within the tile. */
struct window_range {
    int x0, y0, x1, y1;
};

static struct window_range windows_of(const struct lom_tile *tile, const struct lom_bounds *b)
{
    int last = tile->edge - 1;
    int left = b->left - tile->x, top = b->top - tile->y, right = b->right - tile->x, bottom = b->bottom - tile->y;
    return (struct window_range){ (left < 0 ? 0 : left) & ~3, (top < 0 ? 0 : top) & ~3, right > last ? last : right,
                                  bottom > last ? last : bottom };
}

/* The top-left rule by an edge's steps (dx = -256 ey, dy = 256 ex): -1 where the edge's own points are outside. */
LOM_INLINE int bias_of(int64_t dx, int64_t dy)
{
    return dx > 0 || (dx == 0 && dy > 0) ? 0 : -1;
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
    int x = (b->left & ~3) - tile->x, y = (b->top & ~3) - tile->y; /* where the starts are valid */
    for (int i = 1; i < 3; i++) {
        e[i].dx = (int32_t)(i == 1 ? t->step_x1 : t->step_x2);
        e[i].dy = (int32_t)(i == 1 ? t->step_y1 : t->step_y2);
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
                emit(tile, at, covered, l, false);
            }
    }
}

/* ---- large triangles ---- */

/* Edge functions over one tile in 64 bits: value at the tile's first pixel, steps a pixel right and down. */
struct edges {
    int64_t start[3], dx[3], dy[3], area;
};

static struct edges find_edges(const struct lom_tile *tile, const lom_triangle *t)
{
    struct edges e;
    int32_t v[3][2];
    for (int k = 0; k < 3; k++)
        memcpy(v[k], tile->chunk->rows + t->row[k], sizeof v[k]);
    int64_t px = ((int64_t)(tile->x - tile->pass->viewport.x) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    int64_t py = ((int64_t)(tile->y - tile->pass->viewport.y) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    e.dx[1] = (int64_t)t->step_x1;
    e.dy[1] = (int64_t)t->step_y1;
    e.dx[2] = (int64_t)t->step_x2;
    e.dy[2] = (int64_t)t->step_y2;
    e.dx[0] = -(e.dx[1] + e.dx[2]);
    e.dy[0] = -(e.dy[1] + e.dy[2]);
    for (int i = 0; i < 3; i++) {
        const int32_t *on = v[i == 2 ? 0 : i + 1];
        e.start[i] = e.dy[i] / SUBPIXELS * (py - on[1]) + e.dx[i] / SUBPIXELS * (px - on[0]);
    }
    e.area = e.start[0] + e.start[1] + e.start[2];
    return e;
}

/* An edge of a large triangle over one tile in units of 256: (E + bias) >> 8 steps by exact integers, since E steps by
 * multiples of 256, and has the sign of E + bias. */
struct tile_edge {
    int32_t start, dx, dy;
};

typedef enum { EDGE_CROSSES, EDGE_INSIDE, EDGE_OUTSIDE } edge_class;

static edge_class reduce_edge(const struct edges *e, int i, int edge, struct tile_edge *k)
{
    int bias = bias_of(e->dx[i], e->dy[i]);
    int64_t start = (e->start[i] + bias) >> SUBPIXEL_BITS, dx = e->dx[i] >> SUBPIXEL_BITS,
            dy = e->dy[i] >> SUBPIXEL_BITS, span = edge - 1;
    int64_t low = start + (dx < 0 ? dx * span : 0) + (dy < 0 ? dy * span : 0);
    int64_t high = start + (dx > 0 ? dx * span : 0) + (dy > 0 ? dy * span : 0);
    *k = (struct tile_edge){ 0, 0, 0 };
    if (high < 0)
        return EDGE_OUTSIDE;
    if (low >= 0)
        return EDGE_INSIDE;
    *k = (struct tile_edge){ (int32_t)start, (int32_t)dx, (int32_t)dy };
    return EDGE_CROSSES;
}

/* A large triangle over one tile. */
struct large {
    const lom_triangle *triangle;
    struct lom_bounds bounds;
    struct depth_plane depth;
    struct edges edges;
    struct tile_edge k[3];
    lom_double offset[2][PARTS]; /* edge functions 1 and 2 of a window's pixels less that of its first, exact */
    bool needs_weights;
    bool fills; /* whole windows can be filled with the draw's constant colour */
    bool cut;
};

/* What of a strip of windows is covered, a bit a window: wholly, or perhaps in part. */
struct strip {
    uint32_t full, some;
};

static struct strip classify_strip(const struct lom_tile *tile, const struct large *g, int y)
{
    struct strip strip = { 0, 0 };
    for (int part = 0; part < PARTS; part++) {
        lom_int x = (lom_lane_index() + part * LOM_LANES) * 4;
        lom_int low = { 0 }, high = { 0 };
        for (int i = 0; i < 3; i++) {
            const struct tile_edge *k = &g->k[i];
            int32_t dx = 3 * k->dx, dy = 3 * k->dy;
            lom_int first = x * k->dx + (k->start + k->dy * y);
            low |= first + ((dx < 0 ? dx : 0) + (dy < 0 ? dy : 0));
            high |= first + ((dx > 0 ? dx : 0) + (dy > 0 ? dy : 0));
        }
        lom_mask full = low >= 0, some = high >= 0;
        if (g->cut) {
            lom_int px = x + tile->x;
            int py = tile->y + y;
            full &= (px >= g->bounds.left) & (px + 3 <= g->bounds.right);
            if (py < g->bounds.top || py + 3 > g->bounds.bottom)
                full = (lom_mask){ 0 };
        }
        strip.full |= lom_bits(full) << part * LOM_LANES;
        strip.some |= lom_bits(some) << part * LOM_LANES;
    }
    return strip;
}

LOM_INLINE lom_mask cover_large(const struct tile_edge k[3], int x, int y, int part)
{
    lom_int inside = { 0 };
    for (int i = 0; i < 3; i++)
        inside |= lane_x(part) * k[i].dx + lane_y(part) * k[i].dy + (k[i].start + k[i].dx * x + k[i].dy * y);
    return inside >= 0;
}

/* The window at (x, y) of the tile. */
static void raster_large_window(struct lom_tile *tile, const struct large *g, int32_t number, int x, int y, bool full)
{
    const struct edges *e = &g->edges;
    struct part at = { g->triangle, number, memory_index(tile, x, y), 0, g->depth };
    double start1 = (double)(e->start[1] + e->dx[1] * x + e->dy[1] * y);
    double start2 = (double)(e->start[2] + e->dx[2] * x + e->dy[2] * y), area = (double)e->area;
    for (; at.part < PARTS; at.part++) {
        lom_mask covered = lom_splat_int(-1);
        lom_float l[3] = { { 0 }, { 0 }, { 0 } };
        if (!full) {
            covered = cover_large(g->k, x, y, at.part);
            if (g->cut)
                covered &= inside_bounds(tile, &g->bounds, x, y, at.part);
            if (!lom_any(covered))
                continue;
        }
        if (g->needs_weights) {
            lom_double e1 = g->offset[0][at.part] + start1, e2 = g->offset[1][at.part] + start2;
            l[0] = __builtin_convertvector(area - e1 - e2, lom_float) * g->triangle->inverse_area;
            l[1] = __builtin_convertvector(e1, lom_float) * g->triangle->inverse_area;
            l[2] = __builtin_convertvector(e2, lom_float) * g->triangle->inverse_area;
        }
        emit(tile, at, covered, l, true);
    }
}

/* False when the triangle does not touch the tile. */
static bool find_large(const struct lom_tile *tile, const lom_triangle *t, struct large *g)
{
    const struct lom_draw *draw = tile->draw;
    g->triangle = t;
    g->bounds = lom_bounds_of(t);
    g->depth = find_depth(t);
    g->cut = t->state >> TRIANGLE_CUT & 1;
    g->edges = find_edges(tile, t);
    for (int i = 0; i < 3; i++)
        if (reduce_edge(&g->edges, i, tile->edge, &g->k[i]) == EDGE_OUTSIDE)
            return false;
    g->needs_weights = t->state >> TRIANGLE_CLIP != 0 || tile->depth != NULL || !draw->constant;
    g->fills = draw->constant && !tile->tests_early && t->state >> TRIANGLE_CLIP == 0 && LOM_WIDE(lom_can_fill)(tile);
    for (int part = 0; part < PARTS && g->needs_weights; part++) {
        lom_double x = lom_to_double(lane_x(part)), y = lom_to_double(lane_y(part));
        g->offset[0][part] = x * (double)g->edges.dx[1] + y * (double)g->edges.dy[1];
        g->offset[1][part] = x * (double)g->edges.dx[2] + y * (double)g->edges.dy[2];
    }
    return true;
}

static void raster_large(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    struct large g;
    if (!find_large(tile, t, &g))
        return;
    if (tile->queue.count > 0 && !tile->draw->constant)
        LOM_WIDE(lom_flush)(tile);
    struct window_range r = windows_of(tile, &g.bounds);
    uint32_t columns = (UINT32_C(2) << (r.x1 >> 2)) - (UINT32_C(1) << (r.x0 >> 2));
    for (int y = r.y0; y <= r.y1; y += 4) {
        struct strip strip = classify_strip(tile, &g, y);
        for (uint32_t left = strip.some & columns; left != 0;) {
            int first = __builtin_ctz(left);
            int run = __builtin_ctz(~(strip.full & columns) >> first);
            if (run > 1 && g.fills) {
                LOM_WIDE(lom_fill_windows)(tile, memory_index(tile, first * 4, y), run);
                left &= ~(((UINT32_C(1) << run) - 1) << first);
                continue;
            }
            raster_large_window(tile, &g, number, first * 4, y, run > 0);
            left &= left - 1;
        }
    }
}

void LOM_WIDE(lom_raster)(struct lom_tile *tile, const struct lom_chunk *chunk, const uint32_t *list, size_t count)
{
    const struct lom_draw *draw = chunk->draw;
    if (tile->chunk != chunk)
        LOM_WIDE(lom_flush)(tile);
    tile->chunk = chunk;
    tile->tests_early =
        tile->depth != NULL && !draw->late_depth && (draw->compare != LOM_COMPARE_ALWAYS || draw->depth_write);
    if (draw->constant && tile->constant_draw != draw && draw->desc.shader->fragment[draw->variant] != NULL)
        LOM_WIDE(lom_find_constant)(tile);
    for (size_t i = 0; i < count; i++) {
        const lom_triangle *t = &chunk->triangles[list[i]];
        __builtin_prefetch(&chunk->triangles[list[i + AHEAD < count ? i + AHEAD : count - 1]]);
        switch (lom_kind_of(t)) {
        case TRIANGLE_WINDOW:
            raster_window(tile, t, (int32_t)list[i]);
            break;
        case TRIANGLE_SMALL:
            raster_small(tile, t, (int32_t)list[i]);
            break;
        case TRIANGLE_LARGE:
            raster_large(tile, t, (int32_t)list[i]);
            break;
        }
    }
}
