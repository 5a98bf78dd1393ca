/* What the tests of OBJ share: a triangle's vertices, decoding that must succeed, meshes that are the same. */
#ifndef LOM_TESTS_OBJ_H
#define LOM_TESTS_OBJ_H

#include "check.h"

#include <lom/geometry.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static inline lom_mesh *decode(const char *text)
{
    lom_error error = { 0 };
    lom_mesh *mesh = lom_decode_obj(text, strlen(text), "a.obj", &error);
    CHECK(mesh != NULL, "%s", error.text);
    return mesh;
}

static inline bool same_mesh(const lom_mesh *a, const lom_mesh *b)
{
    if (a->vertex_count != b->vertex_count || a->index_count != b->index_count || a->part_count != b->part_count ||
        a->material_count != b->material_count || a->line_index_count != b->line_index_count ||
        a->point_count != b->point_count || a->line_part_count != b->line_part_count ||
        a->point_part_count != b->point_part_count)
        return false;
    size_t indices = a->index_count + a->line_index_count + a->point_count;
    return memcmp(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices) == 0 &&
           memcmp(a->indices, b->indices, indices * sizeof *a->indices) == 0 &&
           memcmp(a->parts, b->parts, lom_mesh_parts(a) * sizeof *a->parts) == 0 &&
           memcmp(a->materials, b->materials, a->material_count * sizeof *a->materials) == 0;
}

#endif
