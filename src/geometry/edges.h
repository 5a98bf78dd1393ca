/* The edges of triangles, each once. */
#ifndef LOM_GEOMETRY_EDGES_H
#define LOM_GEOMETRY_EDGES_H

#include <lom/geometry.h>

/* Of `count` indices, three a triangle: two indices an edge, in the order of first mention, the smaller
 * one first. same: a vertex for each vertex that counts as the same one; NULL: each is its own. *edge_count: indices. NULL
 * on failure; freed with lom_release. */
uint32_t *lom_list_edges(const uint32_t *indices, size_t count, const uint32_t *same, size_t *edge_count,
                         lom_error *error);

#endif
