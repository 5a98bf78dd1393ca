/* Packets of vertices from and to the rows that stages hand to one another (lom/stages.h). */
#ifndef LOM_PIPELINE_STAGE_ROWS_H
#define LOM_PIPELINE_STAGE_ROWS_H

#include "pipeline/expand.h"

/* Vertex row[i] in lane i. */
LOM_INLINE void load_vertex(const struct lom_draw *draw, const float *rows, lom_int row, lom_vertex *vertex)
{
    lom_int at = row * draw->stage_pitch;
    int varyings = draw->desc.shader->varyings;
    const float *rest = rows + LOM_ROW_VARYINGS;
    vertex->position = lom_gather_rows(rows, at);
    vertex->point_size = lom_gather_rows(rows + LOM_ROW_SIZE, at).x;
    for (int i = 0; i < varyings; i += 4) {
        lom_float4 four = lom_gather_rows(rest + i, at);
        vertex->varying[i] = four.x;
        vertex->varying[i + 1] = four.y;
        vertex->varying[i + 2] = four.z;
        vertex->varying[i + 3] = four.w;
    }
    rest += (varyings + 3) & ~3;
    for (int i = 0; i < draw->distances; i += 4) {
        lom_float4 four = lom_gather_rows(rest + i, at);
        vertex->distance[i] = four.x;
        vertex->distance[i + 1] = four.y;
        vertex->distance[i + 2] = four.z;
        vertex->distance[i + 3] = four.w;
    }
}

/* As many rows as there are lanes, one after the other. */
LOM_INLINE void store_vertex(const struct lom_draw *draw, float *rows, const lom_vertex *vertex)
{
    lom_primitive_stream to = { .rows = rows,
                                .pitch = draw->stage_pitch,
                                .most = 1,
                                .varyings = draw->desc.shader->varyings,
                                .distances = draw->distances,
                                .alive = lom_splat_int(-1) };
    lom_emit_vertex(&to, vertex, to.alive);
}

/* first, first + 1 ..., the last of `count` repeated. */
LOM_INLINE lom_int lanes_from(size_t first, size_t count)
{
    size_t left = count - first;
    int32_t last = left < LOM_LANES ? (int32_t)left - 1 : LOM_LANES - 1;
    return lom_min_int(lom_lane_index(), lom_splat_int(last)) + (int32_t)first;
}

#endif
