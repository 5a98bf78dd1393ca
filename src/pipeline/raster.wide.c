/* Stage 5 of 7: raster. In: the triangles of a tile, in order. Out: covered fragments that pass the early depth test,
 * in the queue. Works on 4x4 windows: 16 pixels in the order of tile memory (blocks of 2x2), LOM_LANES at a time.
 *
 * Invariant: the weights l of a pixel are fl(fl(E) * fl(1 / area)) of the exact integers E and area, whatever path the
 * triangle took: int32 where that is exact, else double, which holds every edge function exactly. */
#include "pipeline/packet.h"

#include <lom/lanes_mathematics.h>

enum { PARTS = 16 / LOM_LANES };

/* Edge functions of the ordered triangle over one tile: value at the tile's first pixel, steps a pixel right and down.
 */
struct edges {
    int64_t start[3], dx[3], dy[3], area;
    int bias[3]; /* -1 where the edge's own points are outside (top-left rule) */
};

static struct edges find_edges(const struct lom_tile *tile, const lom_triangle *t)
{
    struct edges e;
    int64_t px = ((int64_t)(tile->x - tile->pass->viewport.x) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    int64_t py = ((int64_t)(tile->y - tile->pass->viewport.y) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    for (int i = 0; i < 3; i++) {
        int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        int64_t ex = (int64_t)(t->x[b] - t->x[a]) * t->sign, ey = (int64_t)(t->y[b] - t->y[a]) * t->sign;
        e.start[i] = ex * (py - t->y[a]) - ey * (px - t->x[a]);
        e.dx[i] = -ey * SUBPIXELS;
        e.dy[i] = ex * SUBPIXELS;
        e.bias[i] = ey < 0 || (ey == 0 && ex > 0) ? 0 : -1;
    }
    e.area = e.start[0] + e.start[1] + e.start[2];
    return e;
}

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
static void scale_distances(const lom_triangle *t, size_t offset, float d[3])
{
    double product[3], largest = 0, scale;
    for (int k = 0; k < 3; k++) {
        product[k] = (double)t->row[k][offset] * t->row[k][3]; /* exact */
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
 * pixels exactly. Where the sum is 0 the sign of its gradient decides, as the top-left rule does for edges. */
static lom_mask test_distances(const struct lom_tile *tile, const lom_triangle *t, const lom_float l[3])
{
    lom_mask inside = lom_splat_int(-1);
    for (int i = 0; t->clip >> i != 0; i++) {
        if (!(t->clip >> i & 1))
            continue;
        float d[3];
        scale_distances(t, (size_t)(tile->draw->distance_offset + i), d);
        lom_float sum = l[0] * d[0] + l[1] * d[1] + l[2] * d[2];
        double gx = 0, gy = 0;
        for (int k = 0; k < 3; k++) {
            int a = k == 2 ? 0 : k + 1, b = k == 0 ? 2 : k - 1;
            gx -= (double)(t->y[b] - t->y[a]) * t->sign * d[k];
            gy += (double)(t->x[b] - t->x[a]) * t->sign * d[k];
        }
        bool keeps_zero = gx > 0 || (gx == 0 && gy >= 0);
        inside &= keeps_zero ? sum >= 0.0f : sum > 0.0f;
    }
    return inside;
}

LOM_INLINE lom_float interpolate_depth(const lom_triangle *t, const lom_float l[3])
{
    float z1 = t->depth[0] + t->depth[1], z2 = t->depth[0] + t->depth[2];
    float low = t->depth[0] < z1 ? t->depth[0] : z1, high = t->depth[0] < z1 ? z1 : t->depth[0];
    lom_float z = t->depth[0] + l[1] * t->depth[1] + l[2] * t->depth[2];
    return lom_clamp(z, lom_splat(low < z2 ? low : z2), lom_splat(high < z2 ? z2 : high));
}

/* The depth with the draw's bias, rounded once to what the attachment holds. Not inlined: few draws have one. */
static __attribute__((noinline)) void offset_depth(const struct lom_tile *tile, const lom_triangle *t, lom_float *z)
{
    double scale = tile->pass->depth_scale;
    lom_double one = lom_splat_double(1), sum = lom_widen(*z) + lom_depth_offset(tile->pass, tile->draw, t);
    sum = lom_select_double(sum > 0.0, lom_select_double(sum < 1.0, sum, one), one - 1.0);
    if (scale != 0)
        sum = ((sum * scale + LOM_NEAREST) - LOM_NEAREST) / scale;
    *z = lom_narrow(sum);
}

/* Adds the lanes of covered to the queue; shades a packet when it is full. */
static void enqueue(struct lom_tile *tile, const lom_triangle *t, const int32_t *pixel, lom_mask taken,
                    lom_mask covered, const lom_float l[3], lom_float z)
{
    struct lom_queue *q = &tile->queue;
    int first = q->count;
    lom_int place = lom_load_int(pixel);
    bool whole = first == 0 && lom_all(taken);
    for (int i = 0; i < 3; i++)
        lom_compress(q->l[i] + first, taken, l[i]);
    lom_compress(q->depth + first, taken, z);
    lom_compress((float *)q->pixel + first, taken, lom_as_float(place));
    lom_compress((float *)q->covered + first, taken, lom_as_float(covered));
    int count = __builtin_popcount(lom_bits(taken));
    for (int i = 0; i < LOM_LANES; i++)
        q->triangle[first + i] = t;
    q->count += count;
    if (q->count < LOM_LANES)
        return;
    q->block = whole;
    LOM_WIDE(lom_shade_packet)(tile, LOM_LANES);
}

/* A draw whose shader reads nothing has one colour: it goes straight to the output stage. */
static void write_constant(struct lom_tile *tile, const int32_t *pixel, lom_mask covered)
{
    struct lom_places places = { .block = true };
    lom_float4 color[LOM_MAX_COLORS];
    if (tile->constant_draw != tile->draw)
        LOM_WIDE(lom_find_constant)(tile);
    memcpy(places.pixel, pixel, sizeof places.pixel);
    if (tile->pass->colors == 1 && tile->pass->color[0].kind == COLOR_UNORM8 && !tile->draw->blends &&
        tile->draw->desc.shader->colors >= 1) {
        lom_store_places(tile->color[0], tile, &places, covered, lom_splat_int((int32_t)tile->constant_bytes));
        return;
    }
    for (int i = 0; i < tile->pass->colors; i++)
        color[i] = (lom_float4){ lom_splat(tile->constant[i][0]), lom_splat(tile->constant[i][1]),
                                 lom_splat(tile->constant[i][2]), lom_splat(tile->constant[i][3]) };
    LOM_WIDE(lom_write_packet)(tile, &places, &covered, color);
}

/* One part of a window: clip distances, early depth, and on to the queue. */
static void emit(struct lom_tile *tile, const lom_triangle *t, int base, int part, lom_mask covered,
                 const lom_float l[3])
{
    const struct lom_draw *draw = tile->draw;
    lom_float z = { 0 };
    int32_t pixel[LOM_LANES];
    if (t->clip != 0)
        covered &= test_distances(tile, t, l);
    lom_store_int(pixel, lom_load_int(tile->offset + part * LOM_LANES) + base);
    if (tile->depth != NULL || draw->desc.shader->reads_position)
        z = interpolate_depth(t, l);
    if (draw->biased) {
        lom_float plain = z;
        offset_depth(tile, t, &plain);
        z = plain;
    }
    if (tile->depth != NULL && !draw->late_depth && (draw->compare != LOM_COMPARE_ALWAYS || draw->depth_write)) {
        int32_t *memory = (int32_t *)tile->depth + pixel[0];
        lom_float stored = lom_as_float(lom_load_block(memory, tile));
        lom_float units = lom_depth_units(tile->pass, z);
        covered &= lom_compare_depth(draw->compare, units, stored);
        if (draw->depth_write && lom_any(covered))
            lom_store_block(memory, tile, lom_as_int(lom_select(covered, units, stored)));
    }
    uint32_t bits = lom_bits(covered);
    if (bits == 0)
        return;
    tile->fragments += (uint64_t)__builtin_popcount(bits);
    if (draw->desc.shader->fragment[draw->variant] == NULL)
        return;
    if (draw->constant) {
        write_constant(tile, pixel, covered);
        return;
    }
    lom_mask taken = covered;
    if (draw->desc.shader->quads) {
        bits = (bits | bits >> 1 | bits >> 2 | bits >> 3) & 0x1111;
        taken = lom_mask_of_bits(bits * 15);
    }
    enqueue(tile, t, pixel, taken, covered, l, z);
}

/* Lanes of the window at (x, y) of the tile that the triangle's pixel bounds allow. */
static lom_mask inside_bounds(const struct lom_tile *tile, const lom_triangle *t, int x, int y, int part)
{
    lom_int px = lane_x(part) + (tile->x + x), py = lane_y(part) + (tile->y + y);
    return (px >= t->left) & (px <= t->right) & (py >= t->top) & (py <= t->bottom);
}

/* The edge functions at a window, as int32 lanes. */
LOM_INLINE lom_int edge_lanes(const struct edges *e, int i, int x, int y, int part)
{
    int32_t dx = (int32_t)e->dx[i], dy = (int32_t)e->dy[i];
    lom_int lx = lane_x(part), ly = lane_y(part);
    lom_int offset = (-(lx & 1) & dx) + (-(lx >> 1) & (dx * 2)) + (-(ly & 1) & dy) + (-(ly >> 1) & (dy * 2));
    return offset + ((int32_t)e->start[i] + dx * x + dy * y);
}

static void raster_window(struct lom_tile *tile, const lom_triangle *t)
{
    struct edges e = find_edges(tile, t);
    int x = (t->left & ~1) - tile->x, y = (t->top & ~1) - tile->y;
    int base = memory_index(tile, x, y);
    for (int part = 0; part < PARTS; part++) {
        uint32_t bits = (uint32_t)t->mask >> (part * LOM_LANES) & (uint32_t)((UINT64_C(1) << LOM_LANES) - 1);
        if (bits == 0)
            continue;
        lom_int e1 = edge_lanes(&e, 1, x, y, part), e2 = edge_lanes(&e, 2, x, y, part);
        lom_int e0 = (int32_t)e.area - e1 - e2;
        lom_float l[3] = { lom_to_float(e0) * t->inverse_area, lom_to_float(e1) * t->inverse_area,
                           lom_to_float(e2) * t->inverse_area };
        emit(tile, t, base, part, lom_mask_of_bits(bits), l);
    }
}

/* Windows aligned to 4 pixels that the triangle's bounds touch, within the tile. */
struct window_range {
    int x0, y0, x1, y1;
};

static struct window_range windows_of(const struct lom_tile *tile, const lom_triangle *t)
{
    int last = tile->edge - 1;
    int left = t->left - tile->x, top = t->top - tile->y, right = t->right - tile->x, bottom = t->bottom - tile->y;
    return (struct window_range){ (left < 0 ? 0 : left) & ~3, (top < 0 ? 0 : top) & ~3, right > last ? last : right,
                                  bottom > last ? last : bottom };
}

static void raster_small(struct lom_tile *tile, const lom_triangle *t)
{
    struct edges e = find_edges(tile, t);
    struct window_range r = windows_of(tile, t);
    for (int y = r.y0; y <= r.y1; y += 4)
        for (int x = r.x0; x <= r.x1; x += 4)
            for (int part = 0; part < PARTS; part++) {
                lom_int e0 = edge_lanes(&e, 0, x, y, part), e1 = edge_lanes(&e, 1, x, y, part),
                        e2 = edge_lanes(&e, 2, x, y, part);
                lom_mask covered = ((e0 + e.bias[0]) | (e1 + e.bias[1]) | (e2 + e.bias[2])) >= 0;
                if (t->cut)
                    covered &= inside_bounds(tile, t, x, y, part);
                if (!lom_any(covered))
                    continue;
                lom_float l[3] = { lom_to_float(e0) * t->inverse_area, lom_to_float(e1) * t->inverse_area,
                                   lom_to_float(e2) * t->inverse_area };
                emit(tile, t, memory_index(tile, x, y), part, covered, l);
            }
}

/* An edge of a large triangle over one tile in units of 256: (E + bias) >> 8 steps by exact integers, since E steps by
 * multiples of 256, and has the sign of E + bias. */
struct tile_edge {
    int32_t start, dx, dy;
};

typedef enum { EDGE_CROSSES, EDGE_INSIDE, EDGE_OUTSIDE } edge_class;

static edge_class reduce_edge(const struct edges *e, int i, int edge, struct tile_edge *k)
{
    int64_t start = (e->start[i] + e->bias[i]) >> SUBPIXEL_BITS, dx = e->dx[i] >> SUBPIXEL_BITS,
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

static void emit_large(struct lom_tile *tile, const lom_triangle *t, const struct edges *e, int x, int y, int part,
                       lom_mask covered)
{
    lom_float l[3] = { { 0 } };
    lom_double px = lom_to_double(lane_x(part) + x), py = lom_to_double(lane_y(part) + y);
    if (t->clip != 0 || tile->depth != NULL || !tile->draw->constant) {
        lom_double e1 = px * (double)e->dx[1] + py * (double)e->dy[1] + (double)e->start[1];
        lom_double e2 = px * (double)e->dx[2] + py * (double)e->dy[2] + (double)e->start[2];
        lom_double e0 = (double)e->area - e1 - e2;
        l[0] = __builtin_convertvector(e0, lom_float) * t->inverse_area;
        l[1] = __builtin_convertvector(e1, lom_float) * t->inverse_area;
        l[2] = __builtin_convertvector(e2, lom_float) * t->inverse_area;
    }
    emit(tile, t, memory_index(tile, x, y), part, covered, l);
}

static lom_mask cover_large(const struct tile_edge k[3], int x, int y, int part)
{
    lom_int inside = { 0 };
    for (int i = 0; i < 3; i++)
        inside |= lane_x(part) * k[i].dx + lane_y(part) * k[i].dy + (k[i].start + k[i].dx * x + k[i].dy * y);
    return inside >= 0;
}

static void raster_large(struct lom_tile *tile, const lom_triangle *t)
{
    struct edges e = find_edges(tile, t);
    struct window_range r = windows_of(tile, t);
    struct tile_edge k[3];
    bool partial = t->cut;
    for (int i = 0; i < 3; i++) {
        edge_class class = reduce_edge(&e, i, tile->edge, &k[i]);
        if (class == EDGE_OUTSIDE)
            return;
        partial |= class == EDGE_CROSSES;
    }
    for (int y = r.y0; y <= r.y1; y += 4)
        for (int x = r.x0; x <= r.x1; x += 4)
            for (int part = 0; part < PARTS; part++) {
                lom_mask covered = lom_splat_int(-1);
                if (partial)
                    covered = cover_large(k, x, y, part);
                if (t->cut)
                    covered &= inside_bounds(tile, t, x, y, part);
                if (lom_any(covered))
                    emit_large(tile, t, &e, x, y, part, covered);
            }
}

void LOM_WIDE(lom_flush)(struct lom_tile *tile)
{
    tile->queue.block = false;
    if (tile->queue.count > 0)
        LOM_WIDE(lom_shade_packet)(tile, tile->queue.count);
}

void LOM_WIDE(lom_raster)(struct lom_tile *tile, const struct lom_chunk *chunk, const uint32_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const lom_triangle *t = &chunk->triangles[list[i]];
        switch ((lom_triangle_kind)t->kind) {
        case TRIANGLE_WINDOW:
            raster_window(tile, t);
            break;
        case TRIANGLE_SMALL:
            raster_small(tile, t);
            break;
        case TRIANGLE_LARGE:
            raster_large(tile, t);
            break;
        }
    }
}
