/* Meshes as a whole: making, freeing, bounds, transformation. In: lengths, matrices. Out: meshes whose arrays have the
 * stated lengths. Compiled for speed. */
#include <lom/geometry.h>

/* The sum, or SIZE_MAX. */
static size_t add_up(size_t a, size_t b, size_t c)
{
    size_t sum = a + b < a ? SIZE_MAX : a + b;
    return sum + c < sum ? SIZE_MAX : sum + c;
}

lom_mesh *lom_create_mesh_of(const lom_mesh_counts *counts, lom_error *error)
{
    const size_t vertices = counts->vertices, materials = counts->materials;
    const size_t indices = add_up(counts->indices, counts->line_indices, counts->points);
    const size_t parts = add_up(counts->parts, counts->line_parts, counts->point_parts);
    if (vertices > UINT32_MAX || indices > UINT32_MAX || parts > INT32_MAX || materials > INT32_MAX) {
        lom_fail(error, LOM_ERROR_LIMIT, "A mesh of %zu vertices and %zu indices does not fit 32-bit indices.",
                 vertices, indices);
        return NULL;
    }
    lom_mesh *mesh = lom_allocate(1, sizeof *mesh, error);
    if (mesh == NULL)
        return NULL;
    mesh->vertices = lom_allocate(vertices, sizeof *mesh->vertices, error);
    mesh->indices = lom_allocate(indices, sizeof *mesh->indices, error);
    mesh->parts = lom_allocate(parts, sizeof *mesh->parts, error);
    mesh->materials = lom_allocate(materials, sizeof *mesh->materials, error);
    if (mesh->vertices == NULL || mesh->indices == NULL || mesh->parts == NULL || mesh->materials == NULL) {
        lom_free_mesh(mesh);
        return NULL;
    }
    mesh->vertex_count = vertices;
    mesh->index_count = counts->indices;
    mesh->line_index_count = counts->line_indices;
    mesh->point_count = counts->points;
    mesh->part_count = counts->parts;
    mesh->line_part_count = counts->line_parts;
    mesh->point_part_count = counts->point_parts;
    mesh->material_count = materials;
    mesh->source_triangles = counts->indices / 3;
    return mesh;
}

lom_mesh *lom_create_mesh(size_t vertices, size_t indices, size_t parts, size_t materials, lom_error *error)
{
    return lom_create_mesh_of(
        &(lom_mesh_counts){ .vertices = vertices, .indices = indices, .parts = parts, .materials = materials }, error);
}

size_t lom_mesh_parts(const lom_mesh *mesh)
{
    return mesh->part_count + mesh->line_part_count + mesh->point_part_count;
}

void lom_free_mesh(lom_mesh *mesh)
{
    if (mesh == NULL)
        return;
    lom_release(mesh->vertices);
    lom_release(mesh->indices);
    lom_release(mesh->parts);
    lom_release(mesh->materials);
    lom_release(mesh);
}

lom_box lom_mesh_bounds(const lom_mesh *mesh)
{
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = __builtin_inf();
        high[i] = -__builtin_inf();
    }
    for (size_t k = 0; k < mesh->vertex_count; k++)
        for (int i = 0; i < 3; i++) {
            double x = mesh->vertices[k].position[i];
            low[i] = x < low[i] ? x : low[i];
            high[i] = x > high[i] ? x : high[i];
        }
    return (lom_box){ { low[0], low[1], low[2] }, { high[0], high[1], high[2] } };
}

static void store(float target[3], lom_vec3 v)
{
    target[0] = (float)v.x;
    target[1] = (float)v.y;
    target[2] = (float)v.z;
}

static double determinant3(const lom_mat4 *m)
{
    lom_vec3 x = { m->m[0][0], m->m[0][1], m->m[0][2] }, y = { m->m[1][0], m->m[1][1], m->m[1][2] };
    return lom_vec3_dot(lom_vec3_cross(x, y), (lom_vec3){ m->m[2][0], m->m[2][1], m->m[2][2] });
}

bool lom_transform_mesh(lom_mesh *mesh, const lom_mat4 *matrix, lom_error *error)
{
    lom_float_state state;
    lom_mat4 normal_matrix;
    lom_enter_float_state(&state);
    bool regular = lom_normal_matrix(matrix, &normal_matrix);
    for (size_t k = 0; regular && k < mesh->vertex_count; k++) {
        lom_mesh_vertex *vertex = &mesh->vertices[k];
        lom_vec3 p = { vertex->position[0], vertex->position[1], vertex->position[2] };
        lom_vec3 n = { vertex->normal[0], vertex->normal[1], vertex->normal[2] };
        store(vertex->position, lom_transform_point(matrix, p));
        store(vertex->normal, lom_vec3_normalize(lom_transform_direction(&normal_matrix, n)));
    }
    bool mirrored = regular && determinant3(matrix) < 0;
    for (size_t k = 0; mirrored && k + 2 < mesh->index_count; k += 3) {
        uint32_t index = mesh->indices[k + 1];
        mesh->indices[k + 1] = mesh->indices[k + 2];
        mesh->indices[k + 2] = index;
    }
    lom_leave_float_state(&state);
    return regular || lom_fail(error, LOM_ERROR_USAGE, "A mesh cannot be transformed by a singular matrix.");
}
