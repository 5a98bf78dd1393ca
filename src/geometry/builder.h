/* A mesh that grows: what the builder collects and what finishing it needs. */
#ifndef LOM_GEOMETRY_BUILDER_H
#define LOM_GEOMETRY_BUILDER_H

#include "materials.h"

struct builder_triangle {
    uint32_t corner[3];
    int32_t material;
};

struct lom_mesh_builder {
    lom_error error;           /* the first failure; nothing is appended after it */
    lom_mesh_vertex *vertices; /* a normal of 0, 0, 0 is to be computed */
    struct builder_triangle *triangles;
    size_t vertex_count, vertex_capacity, triangle_count, triangle_capacity;
    struct lom_materials materials;
    int material;
    float color[4];
    lom_mat4 transform, normal_transform;
    bool mirrored;
};

/* The normals of all corners, three for each triangle, as lom_finish_mesh describes them. NULL on failure. */
float (*lom_corner_normals(const struct lom_mesh_builder *builder, double crease, lom_error *error))[3];

#endif
