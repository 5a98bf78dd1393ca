/* Which corner of a triangle is its first vertex: that of the least place in the index buffer, but for a fan's centre
 * (lom_provoking). In: the places of its corners, in the order in which they turn. Invariant: they turn as before. */
#ifndef LOM_PIPELINE_PROVOKING_H
#define LOM_PIPELINE_PROVOKING_H

#include <lom/pipeline.h>

/* The first vertex of triangle t becomes the last of its corners; they turn as before. */
static inline void lom_provoke_first(lom_topology topology, size_t t, size_t place[3])
{
    const size_t corner[3] = { place[0], place[1], place[2] };
    const int first = topology == LOM_TRIANGLE_FAN ? 1 : topology == LOM_TRIANGLE_STRIP ? (int)(t & 1) : 0;
    for (int k = 0; k < 3; k++)
        place[k] = corner[(first + 1 + k) % 3];
}

#endif
