/* Puts meshes together. In: vertices, triangles, materials, other meshes, one by one. Out: a mesh with one part for
 * each material. Every triangle names vertices that exist, every position is finite; after a failure nothing changes.
 */
#include "builder.h"
#include "base/reserve.h"

#include <string.h>

lom_mesh_builder *lom_create_mesh_builder(lom_error *error)
{
    lom_mesh_builder *builder = lom_allocate(1, sizeof *builder, error);
    if (builder == NULL)
        return NULL;
    builder->material = -1;
    lom_builder_color(builder, 1, 1, 1, 1);
    lom_builder_transform(builder, NULL);
    return builder;
}

void lom_free_mesh_builder(lom_mesh_builder *builder)
{
    if (builder == NULL)
        return;
    lom_release(builder->vertices);
    lom_release(builder->triangles);
    lom_free_materials(&builder->materials);
    lom_release(builder);
}

static bool usable(const lom_mesh_builder *builder)
{
    return builder != NULL && builder->error.code == LOM_OK;
}

/* ---- state ---- */

static int find_material(lom_mesh_builder *builder, const lom_material *material)
{
    size_t length = strnlen(material->name, sizeof material->name);
    if (length == 0 || length == sizeof material->name) {
        lom_fail(&builder->error, LOM_ERROR_USAGE, "A material's name has 1 to %zu bytes.", sizeof material->name - 1);
        return -1;
    }
    int number = lom_find_material(&builder->materials, material->name, length, &builder->error);
    if (number >= 0 && !builder->materials.entries[number].defined) {
        builder->materials.entries[number].material = *material;
        builder->materials.entries[number].defined = true;
    }
    return number;
}

int lom_builder_material(lom_mesh_builder *builder, const lom_material *material)
{
    if (!usable(builder))
        return -1;
    builder->material = material == NULL ? -1 : find_material(builder, material);
    return builder->material;
}

void lom_builder_color(lom_mesh_builder *builder, double red, double green, double blue, double alpha)
{
    if (!usable(builder))
        return;
    builder->color[0] = (float)red;
    builder->color[1] = (float)green;
    builder->color[2] = (float)blue;
    builder->color[3] = (float)alpha;
}

void lom_builder_transform(lom_mesh_builder *builder, const lom_mat4 *matrix)
{
    if (!usable(builder))
        return;
    lom_float_state state;
    lom_enter_float_state(&state);
    builder->transform = matrix == NULL ? lom_identity() : *matrix;
    if (!lom_normal_matrix(&builder->transform, &builder->normal_transform))
        lom_fail(&builder->error, LOM_ERROR_USAGE, "A mesh cannot be transformed by a singular matrix.");
    const double(*m)[4] = (const double(*)[4])builder->transform.m;
    lom_vec3 x = { m[0][0], m[0][1], m[0][2] }, y = { m[1][0], m[1][1], m[1][2] }, z = { m[2][0], m[2][1], m[2][2] };
    builder->mirrored = lom_vec3_dot(lom_vec3_cross(x, y), z) < 0;
    lom_leave_float_state(&state);
}

/* ---- pieces ---- */

static bool finite_vector(lom_vec3 v)
{
    const double limit = 0x1.fffffep+127;
    return __builtin_fabs(v.x) <= limit && __builtin_fabs(v.y) <= limit && __builtin_fabs(v.z) <= limit;
}

/* Appends a vertex as it is; its number. */
static uint32_t append_vertex(lom_mesh_builder *builder, const lom_mesh_vertex *vertex)
{
    if (builder->vertex_count == UINT32_MAX) {
        lom_fail(&builder->error, LOM_ERROR_LIMIT, "A mesh of more than 2^32 - 1 vertices.");
        return 0;
    }
    if (!lom_reserve(&builder->vertices, &builder->vertex_capacity, builder->vertex_count + 1,
                     sizeof *builder->vertices, &builder->error))
        return 0;
    builder->vertices[builder->vertex_count] = *vertex;
    return (uint32_t)builder->vertex_count++;
}

static uint32_t add_vertex(lom_mesh_builder *builder, lom_vec3 position, lom_vec3 normal, double u, double v)
{
    lom_vec3 p = lom_transform_point(&builder->transform, position);
    lom_vec3 n = lom_vec3_normalize(lom_transform_direction(&builder->normal_transform, normal));
    if (!finite_vector(p) || !finite_vector((lom_vec3){ u, v, 0 })) {
        lom_fail(&builder->error, LOM_ERROR_USAGE, "Vertex %zu of a mesh has a number that is not finite.",
                 builder->vertex_count);
        return 0;
    }
    lom_mesh_vertex vertex = { .position = { (float)p.x, (float)p.y, (float)p.z },
                               .normal = { (float)n.x, (float)n.y, (float)n.z },
                               .uv = { (float)u, (float)v } };
    memcpy(vertex.color, builder->color, sizeof vertex.color);
    return append_vertex(builder, &vertex);
}

uint32_t lom_builder_vertex_normal(lom_mesh_builder *builder, lom_vec3 position, lom_vec3 normal, double u, double v)
{
    if (!usable(builder))
        return 0;
    lom_float_state state;
    lom_enter_float_state(&state);
    uint32_t number = add_vertex(builder, position, normal, u, v);
    lom_leave_float_state(&state);
    return number;
}

uint32_t lom_builder_vertex(lom_mesh_builder *builder, lom_vec3 position, double u, double v)
{
    return lom_builder_vertex_normal(builder, position, (lom_vec3){ 0, 0, 0 }, u, v);
}

static void append_triangle(lom_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c, int material)
{
    if (a >= builder->vertex_count || b >= builder->vertex_count || c >= builder->vertex_count) {
        lom_fail(&builder->error, LOM_ERROR_USAGE, "A triangle names a vertex that the mesh does not have.");
        return;
    }
    if (builder->triangle_count == UINT32_MAX / 3) {
        lom_fail(&builder->error, LOM_ERROR_LIMIT, "A mesh of more than 2^32 - 1 indices.");
        return;
    }
    if (!lom_reserve(&builder->triangles, &builder->triangle_capacity, builder->triangle_count + 1,
                     sizeof *builder->triangles, &builder->error))
        return;
    builder->triangles[builder->triangle_count++] =
        (struct builder_triangle){ { a, builder->mirrored ? c : b, builder->mirrored ? b : c }, material };
}

void lom_builder_triangle(lom_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c)
{
    if (usable(builder))
        append_triangle(builder, a, b, c, builder->material);
}

void lom_builder_quad(lom_mesh_builder *builder, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    lom_builder_triangle(builder, a, b, c);
    lom_builder_triangle(builder, a, c, d);
}

/* ---- whole meshes ---- */

static void append_vertices(lom_mesh_builder *builder, const lom_mesh *mesh)
{
    for (size_t k = 0; k < mesh->vertex_count && usable(builder); k++) {
        const lom_mesh_vertex *source = &mesh->vertices[k];
        lom_vec3 p = { source->position[0], source->position[1], source->position[2] };
        lom_vec3 n = { source->normal[0], source->normal[1], source->normal[2] };
        uint32_t number = add_vertex(builder, p, n, source->uv[0], source->uv[1]);
        for (int i = 0; i < 4 && usable(builder); i++)
            builder->vertices[number].color[i] *= source->color[i];
    }
}

void lom_builder_mesh(lom_mesh_builder *builder, const lom_mesh *mesh)
{
    if (!usable(builder))
        return;
    lom_float_state state;
    lom_enter_float_state(&state);
    size_t first = builder->vertex_count;
    append_vertices(builder, mesh);
    for (size_t k = 0; k < mesh->part_count && usable(builder); k++) {
        const lom_mesh_part *part = &mesh->parts[k];
        int material =
            part->material < 0 ? builder->material : find_material(builder, &mesh->materials[part->material]);
        for (uint32_t i = 0; i + 2 < part->index_count && usable(builder); i += 3) {
            const uint32_t *corner = mesh->indices + part->first_index + i;
            append_triangle(builder, (uint32_t)(first + corner[0]), (uint32_t)(first + corner[1]),
                            (uint32_t)(first + corner[2]), material);
        }
    }
    lom_leave_float_state(&state);
}
