/* Windows of 4x4 pixels, in the order of tile memory (blocks of 2x2), LOM_LANES pixels at a time: what the parts of the
 * raster stage share. */
#ifndef LOM_PIPELINE_WINDOW_H
#define LOM_PIPELINE_WINDOW_H

#include "pipeline/packet.h"

enum { PARTS = 16 / LOM_LANES }; /* of a window */

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

/* A part of a window: which triangle, which number it has in the chunk, where the window begins in tile memory. */
struct part {
    const lom_triangle *triangle;
    int32_t number;
    int base, part;
    struct depth_plane depth;
};

/* Lanes of the window at (x, y) of the tile that the triangle's pixel bounds allow. */
LOM_INLINE lom_mask inside_bounds(const struct lom_tile *tile, const struct lom_bounds *b, int x, int y, int part)
{
    lom_int px = lane_x(part) + (tile->x + x), py = lane_y(part) + (tile->y + y);
    return (px >= b->left) & (px <= b->right) & (py >= b->top) & (py <= b->bottom);
}

/* Windows aligned to 4 pixels that the triangle's bounds touch, within the tile. */
struct window_range {
    int x0, y0, x1, y1;
};

LOM_INLINE struct window_range windows_of(const struct lom_tile *tile, const struct lom_bounds *b)
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

/* A part that is covered wholly is a packet by itself; nothing of an earlier triangle waits in the queue. */
void LOM_WIDE(lom_shade_part)(struct lom_tile *tile, const struct part *at, const lom_float l[3],
                              const lom_float *depth);
/* Packets that are parts of whole windows of triangle `number`: where they begin in tile memory, and weights. */
struct lom_windows {
    int32_t number;
    int count, base[WINDOWS_PACKETS];
    lom_float l[WINDOWS_PACKETS][3];
};
/* The same for all of these; depth is 0. */
void LOM_WIDE(lom_shade_windows)(struct lom_tile *tile, const struct lom_windows *windows);
/* The output stage for them, opaque or blended, of different pixels: of the tile's fragments (tile.h). */
void LOM_WIDE(lom_write_windows)(struct lom_tile *tile, const struct lom_windows *windows);
/* A part of a window on its way out of the raster stage: clip distances, depth and its early test, then on to the
 * fragment stage (early.wide.c). */
void LOM_WIDE(lom_emit)(struct lom_tile *tile, const struct part *at, const lom_mask *covered, const lom_float l[3],
                        bool alone);
/* d / w of a triangle's three vertices, d the clip distance at `offset` of their rows, scaled by a power of two so that the
 * largest is in 1..2. */
void LOM_WIDE(lom_scale_distances)(const struct lom_chunk *chunk, const lom_primitive *p, int offset, float d[3]);
/* Leaves the lanes inside the clip distances that change sign in the triangle; gives depths the draw's bias. */
void LOM_WIDE(lom_test_distances)(const struct lom_tile *tile, const lom_triangle *t, const lom_float l[3],
                                  lom_mask *inside);
void LOM_WIDE(lom_offset_depth)(const struct lom_tile *tile, const lom_triangle *t, lom_float *z);
/* A triangle in a pass of several samples (raster_samples.wide.c). */
void LOM_WIDE(lom_raster_sampled)(struct lom_tile *tile, const lom_triangle *t, int32_t number);
/* Large triangles (raster_large.wide.c). */
void LOM_WIDE(lom_raster_large)(struct lom_tile *tile, const lom_triangle *t, int32_t number);
/* Draws the first triangles of a list into a tile that is one colour, as long as it stays one; returns how many. */
size_t LOM_WIDE(lom_fold)(struct lom_tile *tile, const uint32_t *list, size_t count);

#endif
