/* Makes the mesh of a builder. In: its triangles and a crease angle. Out: a mesh whose triangles are grouped by
 * material and whose vertices (builder vertex and normal) are numbered by first use. */
#include "base/pass_error.h"
#include "base/range.h"
#include "builder.h"

#include <string.h>

struct finish {
    lom_mesh_builder *builder;
    float (*normals)[3];  /* of the corners */
    uint32_t *order;      /* of the triangles: grouped by material */
    uint32_t *first_copy; /* of each builder vertex, + 1 */
    uint32_t *next_copy;  /* of each new vertex, + 1: a list for each builder vertex */
    uint32_t *source;     /* builder vertex of each new vertex */
    uint32_t *corner_of;  /* the corner that made each new vertex: it has the normal */
    uint32_t *indices;    /* new vertex of each corner, in the new order */
    size_t vertex_count;
    lom_mesh_part *parts;
    size_t part_count;
};

static bool reserve(struct finish *finish, lom_error *error)
{
    const lom_mesh_builder *builder = finish->builder;
    size_t corners = 3 * builder->triangle_count;
    finish->order = lom_allocate(builder->triangle_count, sizeof *finish->order, error);
    finish->first_copy = lom_allocate(builder->vertex_count, sizeof *finish->first_copy, error);
    finish->next_copy = lom_allocate(corners, sizeof *finish->next_copy, error);
    finish->source = lom_allocate(corners, sizeof *finish->source, error);
    finish->corner_of = lom_allocate(corners, sizeof *finish->corner_of, error);
    finish->indices = lom_allocate(corners, sizeof *finish->indices, error);
    finish->parts = lom_allocate(builder->materials.count + 1, sizeof *finish->parts, error);
    return finish->order != NULL && finish->first_copy != NULL && finish->next_copy != NULL && finish->source != NULL &&
           finish->corner_of != NULL && finish->indices != NULL && finish->parts != NULL;
}

/* A stable counting sort; parts in the order in which their materials are used first. */
static bool group(struct finish *finish, lom_error *error)
{
    const lom_mesh_builder *builder = finish->builder;
    uint32_t *part_of = lom_allocate(builder->materials.count + 1, sizeof *part_of, error); /* of material + 1; + 1 */
    if (part_of == NULL)
        return false;
    for (size_t k = 0; k < builder->triangle_count; k++) {
        int material = builder->triangles[k].material;
        if (part_of[material + 1] == 0) {
            finish->parts[finish->part_count].material = material;
            part_of[material + 1] = (uint32_t)++finish->part_count;
        }
        finish->parts[part_of[material + 1] - 1].index_count += 3;
    }
    for (size_t p = 1; p < finish->part_count; p++)
        finish->parts[p].first_index = finish->parts[p - 1].first_index + finish->parts[p - 1].index_count;
    for (size_t p = 0; p < finish->part_count; p++)
        finish->parts[p].index_count = 0;
    for (size_t k = 0; k < builder->triangle_count; k++) {
        lom_mesh_part *part = &finish->parts[part_of[builder->triangles[k].material + 1] - 1];
        finish->order[(part->first_index + part->index_count) / 3] = (uint32_t)k;
        part->index_count += 3;
    }
    lom_release(part_of);
    return true;
}

/* The new vertex of a corner: a copy of its builder vertex that has the corner's normal. */
static uint32_t find_copy(struct finish *finish, uint32_t vertex, uint32_t corner)
{
    for (uint32_t copy = finish->first_copy[vertex]; copy != 0; copy = finish->next_copy[copy - 1]) {
        const float *a = finish->normals[finish->corner_of[copy - 1]], *b = finish->normals[corner];
        if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2])
            return copy - 1;
    }
    uint32_t copy = (uint32_t)finish->vertex_count++;
    finish->next_copy[copy] = finish->first_copy[vertex];
    finish->first_copy[vertex] = copy + 1;
    finish->source[copy] = vertex;
    finish->corner_of[copy] = corner;
    return copy;
}

static void number_vertices(struct finish *finish)
{
    const lom_mesh_builder *builder = finish->builder;
    for (size_t k = 0; k < builder->triangle_count; k++)
        for (uint32_t i = 0; i < 3; i++) {
            uint32_t triangle = finish->order[k];
            finish->indices[3 * k + i] = find_copy(finish, builder->triangles[triangle].corner[i], 3 * triangle + i);
        }
}

static lom_mesh *make_mesh(const struct finish *finish, lom_error *error)
{
    const lom_mesh_builder *builder = finish->builder;
    size_t corners = 3 * builder->triangle_count;
    lom_mesh *mesh =
        lom_create_mesh(finish->vertex_count, corners, finish->part_count, builder->materials.count, error);
    if (mesh == NULL)
        return NULL;
    for (size_t k = 0; k < finish->vertex_count; k++) {
        mesh->vertices[k] = builder->vertices[finish->source[k]];
        memcpy(mesh->vertices[k].normal, finish->normals[finish->corner_of[k]], sizeof mesh->vertices[k].normal);
    }
    memcpy(mesh->indices, finish->indices, corners * sizeof *mesh->indices);
    memcpy(mesh->parts, finish->parts, finish->part_count * sizeof *mesh->parts);
    for (size_t k = 0; k < builder->materials.count; k++)
        mesh->materials[k] = builder->materials.entries[k].material;
    return mesh;
}

static lom_mesh *finish_builder(lom_mesh_builder *builder, double crease, lom_error *error)
{
    struct finish finish = { .builder = builder };
    lom_mesh *mesh = NULL;
    finish.normals = lom_corner_normals(builder, crease, error);
    if (finish.normals != NULL && reserve(&finish, error) && group(&finish, error)) {
        number_vertices(&finish);
        mesh = make_mesh(&finish, error);
    }
    lom_release(finish.normals);
    lom_release(finish.order);
    lom_release(finish.first_copy);
    lom_release(finish.next_copy);
    lom_release(finish.source);
    lom_release(finish.corner_of);
    lom_release(finish.indices);
    lom_release(finish.parts);
    return mesh;
}

lom_mesh *lom_finish_mesh(lom_mesh_builder *builder, double crease, lom_error *error)
{
    if (builder == NULL) {
        lom_fail(error, LOM_ERROR_MEMORY, "There is no mesh builder.");
        return NULL;
    }
    lom_mesh *mesh = NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    if (lom_pass_error(&builder->error, error) && lom_check_range(crease, 0, 1000, error, "The crease of a mesh"))
        mesh = finish_builder(builder, crease, error);
    lom_leave_float_state(&state);
    lom_free_mesh_builder(builder);
    return mesh;
}
