/* What the base vertex of a call makes of its indices. */
#ifndef LOM_PIPELINE_BASE_VERTEX_H
#define LOM_PIPELINE_BASE_VERTEX_H

#include "pipeline/stages.h"

/* The numbers of the vertices that indices between these name; false where not all of them are there. */
static inline bool lom_move_vertices(const lom_draw_desc *desc, int32_t base_vertex, uint32_t *low, uint32_t *high)
{
    const int64_t from = (int64_t)*low + base_vertex, to = (int64_t)*high + base_vertex;
    *low = (uint32_t)from;
    *high = (uint32_t)to;
    return from >= 0 && to < (int64_t)desc->vertex_count;
}

/* The index that names a vertex. */
static inline uint32_t lom_index_of(uint32_t vertex, int32_t base_vertex)
{
    return vertex - (uint32_t)base_vertex;
}

#endif
