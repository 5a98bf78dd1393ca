/* Edge functions of any triangle over one tile, exact in 64 bits. */
#ifndef LOM_PIPELINE_EDGES_H
#define LOM_PIPELINE_EDGES_H

#include "pipeline/packet.h"

/* Edge functions over one tile in 64 bits: value at the tile's first pixel, steps a pixel right and down. */
struct lom_edges {
    int64_t start[3], dx[3], dy[3], area;
};

LOM_INLINE struct lom_edges lom_find_edges(const struct lom_tile *tile, const lom_triangle *t)
{
    struct lom_edges e;
    int32_t v[3][2];
    for (int k = 0; k < 3; k++)
        memcpy(v[k], tile->chunk->rows + t->primitive.row[k], sizeof v[k]);
    int64_t px = ((int64_t)(tile->x - tile->draw->desc.viewport.x) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    int64_t py = ((int64_t)(tile->y - tile->draw->desc.viewport.y) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    e.dx[1] = lom_int64_of(t->step_x1);
    e.dy[1] = lom_int64_of(t->step_y1);
    e.dx[2] = lom_int64_of(t->step_x2);
    e.dy[2] = lom_int64_of(t->step_y2);
    e.dx[0] = -(e.dx[1] + e.dx[2]);
    e.dy[0] = -(e.dy[1] + e.dy[2]);
    for (int i = 0; i < 3; i++) {
        const int32_t *on = v[i == 2 ? 0 : i + 1];
        e.start[i] = e.dy[i] / SUBPIXELS * (py - on[1]) + e.dx[i] / SUBPIXELS * (px - on[0]);
    }
    e.area = e.start[0] + e.start[1] + e.start[2];
    return e;
}

#endif
