/* Simple shapes around the origin. In: sizes in metres and resolutions. Out: meshes with exact normals and uv,
 * counter-clockwise from outside; where a shape closes, its two ends have the same bits. */
#include "base/numbers.h"

#include <lom/geometry.h>

enum { RESOLUTION_LIMIT = 4096 };

static bool positive(double x)
{
    return x > 0 && x <= 0x1.fffffep+127;
}

/* False and a message for sizes or resolutions out of range. */
static bool check_shape(bool sizes_good, int columns, int least_columns, int rows, int least_rows, lom_error *error)
{
    if (!sizes_good)
        return lom_fail(error, LOM_ERROR_USAGE, "The sizes of a shape are finite and above 0.");
    if (columns < least_columns || rows < least_rows || columns > RESOLUTION_LIMIT || rows > RESOLUTION_LIMIT)
        return lom_fail(error, LOM_ERROR_USAGE, "A shape of %d x %d cells: at least %d x %d, at most %d.", columns,
                        rows, least_columns, least_rows, RESOLUTION_LIMIT);
    return true;
}

static lom_vec3 circle(int i, int count)
{
    double angle = lom_two_pi * (i % count) / count;
    return (lom_vec3){ lom_double_cos(angle), 0, lom_double_sin(angle) };
}

static lom_mesh_vertex make_vertex(lom_vec3 position, lom_vec3 normal, double u, double v)
{
    return (lom_mesh_vertex){ .position = { (float)position.x, (float)position.y, (float)position.z },
                              .normal = { (float)normal.x, (float)normal.y, (float)normal.z },
                              .uv = { (float)u, (float)v },
                              .color = { 1, 1, 1, 1 } };
}

static uint32_t *put_triangle(uint32_t *index, uint32_t a, uint32_t b, uint32_t c)
{
    index[0] = a;
    index[1] = b;
    index[2] = c;
    return index + 3;
}

static lom_mesh *create_shape(size_t vertices, size_t triangles, lom_error *error)
{
    lom_mesh *mesh = lom_create_mesh(vertices, 3 * triangles, 1, 0, error);
    if (mesh != NULL)
        mesh->parts[0] = (lom_mesh_part){ 0, (uint32_t)mesh->index_count, -1 };
    return mesh;
}

/* ---- grids ---- */

/* Rows of columns + 1 vertices; a quad a = (i, j), b, c below a, d is cut into a,c,b and b,c,d. */
static lom_mesh *create_grid(int columns, int rows, lom_error *error)
{
    lom_mesh *mesh =
        create_shape(((size_t)columns + 1) * ((size_t)rows + 1), 2 * (size_t)columns * (size_t)rows, error);
    uint32_t *index = mesh == NULL ? NULL : mesh->indices;
    for (uint32_t j = 0; mesh != NULL && j < (uint32_t)rows; j++)
        for (uint32_t i = 0; i < (uint32_t)columns; i++) {
            uint32_t a = j * ((uint32_t)columns + 1) + i, c = a + (uint32_t)columns + 1;
            index = put_triangle(index, a, c, a + 1);
            index = put_triangle(index, a + 1, c, c + 1);
        }
    return mesh;
}

lom_mesh *lom_make_grid(double width, double length, int columns, int rows, lom_error *error)
{
    if (!check_shape(positive(width) && positive(length), columns, 1, rows, 1, error))
        return NULL;
    lom_mesh *mesh = create_grid(columns, rows, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_mesh_vertex *vertex = mesh == NULL ? NULL : mesh->vertices;
    for (int j = 0; mesh != NULL && j <= rows; j++)
        for (int i = 0; i <= columns; i++) {
            double u = (double)i / columns, v = (double)j / rows;
            *vertex++ = make_vertex((lom_vec3){ (u - .5) * width, 0, (v - .5) * length }, (lom_vec3){ 0, 1, 0 }, u, v);
        }
    lom_leave_float_state(&state);
    return mesh;
}

lom_mesh *lom_make_quad(double width, double length, lom_error *error)
{
    return lom_make_grid(width, length, 1, 1, error);
}

lom_mesh *lom_make_torus(double major, double minor, int columns, int rows, lom_error *error)
{
    if (!check_shape(positive(major) && positive(minor), columns, 3, rows, 3, error))
        return NULL;
    lom_mesh *mesh = create_grid(columns, rows, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    for (int i = 0; mesh != NULL && i <= columns; i++) {
        lom_vec3 around = circle(i, columns);
        for (int j = 0; j <= rows; j++) {
            lom_vec3 tube = circle(j, rows);
            lom_vec3 normal = { tube.x * around.x, tube.z, tube.x * around.z };
            double radius = major + minor * tube.x;
            mesh->vertices[(size_t)j * ((size_t)columns + 1) + (size_t)i] =
                make_vertex((lom_vec3){ radius * around.x, minor * tube.z, radius * around.z }, normal,
                            (double)i / columns, (double)j / rows);
        }
    }
    lom_leave_float_state(&state);
    return mesh;
}

/* ---- the sphere ---- */

/* Row j has slices vertices at the poles (one for each triangle, its u in the middle) and slices + 1 between. */
static uint32_t sphere_row(int slices, int stacks, int j)
{
    uint32_t last = (uint32_t)slices + (uint32_t)(stacks - 1) * ((uint32_t)slices + 1);
    return j == 0 ? 0 : j == stacks ? last : (uint32_t)slices + (uint32_t)(j - 1) * ((uint32_t)slices + 1);
}

static void fill_sphere_indices(lom_mesh *mesh, int slices, int stacks)
{
    uint32_t *index = mesh->indices;
    for (int j = 0; j < stacks; j++)
        for (uint32_t i = 0; i < (uint32_t)slices; i++) {
            uint32_t a = sphere_row(slices, stacks, j) + i, c = sphere_row(slices, stacks, j + 1) + i;
            if (j > 0)
                index = put_triangle(index, a, c, a + 1);
            if (j + 1 < stacks)
                index = put_triangle(index, j > 0 ? a + 1 : a, c, c + 1);
        }
}

lom_mesh *lom_make_sphere(double radius, int slices, int stacks, lom_error *error)
{
    if (!check_shape(positive(radius), slices, 3, stacks, 2, error))
        return NULL;
    size_t vertices = sphere_row(slices, stacks, stacks) + (size_t)slices;
    lom_mesh *mesh = create_shape(vertices, 2 * (size_t)slices * (size_t)(stacks - 1), error);
    if (mesh == NULL)
        return NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    for (int j = 0; j <= stacks; j++) {
        bool pole = j == 0 || j == stacks;
        lom_vec3 down = circle(j, 2 * stacks); /* x: cosine, z: sine of the angle from the north pole */
        for (int i = 0; i < slices + !pole; i++) {
            lom_vec3 around = circle(i, slices);
            lom_vec3 normal = { down.z * around.x, down.x, -down.z * around.z };
            if (pole)
                normal = (lom_vec3){ 0, j == 0 ? 1 : -1, 0 };
            mesh->vertices[sphere_row(slices, stacks, j) + (uint32_t)i] =
                make_vertex(lom_vec3_scale(normal, radius), normal, (i + (pole ? .5 : 0)) / slices, (double)j / stacks);
        }
    }
    lom_leave_float_state(&state);
    fill_sphere_indices(mesh, slices, stacks);
    return mesh;
}

/* ---- box and cylinder ---- */

/* Outward normal and the direction that is up in the face's picture; the right is up x normal. */
static const lom_vec3 box_faces[6][2] = {
    { { 1, 0, 0 }, { 0, 1, 0 } },  { { -1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 0 }, { 0, 0, -1 } },
    { { 0, -1, 0 }, { 0, 0, 1 } }, { { 0, 0, 1 }, { 0, 1, 0 } },  { { 0, 0, -1 }, { 0, 1, 0 } },
};

lom_mesh *lom_make_box(lom_vec3 size, lom_error *error)
{
    if (!check_shape(positive(size.x) && positive(size.y) && positive(size.z), 1, 1, 1, 1, error))
        return NULL;
    lom_mesh *mesh = create_shape(24, 12, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    for (uint32_t face = 0; mesh != NULL && face < 6; face++) {
        lom_vec3 normal = box_faces[face][0], up = box_faces[face][1], right = lom_vec3_cross(up, normal);
        for (uint32_t k = 0; k < 4; k++) {
            double u = k % 2, v = k / 2;
            lom_vec3 p =
                lom_vec3_add(normal, lom_vec3_add(lom_vec3_scale(right, 2 * u - 1), lom_vec3_scale(up, 1 - 2 * v)));
            p = (lom_vec3){ p.x * size.x / 2, p.y * size.y / 2, p.z * size.z / 2 };
            mesh->vertices[4 * face + k] = make_vertex(p, normal, u, v);
        }
        uint32_t a = 4 * face;
        put_triangle(put_triangle(mesh->indices + 6 * face, a, a + 2, a + 1), a + 1, a + 2, a + 3);
    }
    lom_leave_float_state(&state);
    return mesh;
}

/* A vertex of the wall at fraction u of the way around, in direction out; its normal points along towards. */
static uint32_t wall_vertex(lom_mesh_builder *builder, const double radii[2], double height, int row, lom_vec3 out,
                            lom_vec3 towards, double u)
{
    lom_vec3 position = { radii[row] * out.x, row == 0 ? height : 0, -radii[row] * out.z };
    lom_vec3 normal = { height * towards.x, radii[1] - radii[0], -height * towards.z };
    return lom_builder_vertex_normal(builder, position, normal, u, row);
}

/* Row 0 is the top. An apex has a vertex for each triangle, so that its normal is that of the triangle's middle. */
static void build_wall(lom_mesh_builder *builder, const double radii[2], double height, int slices)
{
    lom_vec3 out = circle(0, slices);
    uint32_t left[2] = { 0, 0 }, right[2];
    for (int row = 0; row < 2; row++)
        if (radii[row] > 0)
            left[row] = wall_vertex(builder, radii, height, row, out, out, 0);
    for (int i = 0; i < slices; i++) {
        lom_vec3 middle = circle(2 * i + 1, 2 * slices);
        out = circle(i + 1, slices);
        for (int row = 0; row < 2; row++) {
            if (radii[row] > 0)
                right[row] = wall_vertex(builder, radii, height, row, out, out, (i + 1.) / slices);
            else
                left[row] = right[row] = wall_vertex(builder, radii, height, row, middle, middle, (i + .5) / slices);
        }
        if (radii[0] > 0)
            lom_builder_triangle(builder, left[0], left[1], right[0]);
        if (radii[1] > 0)
            lom_builder_triangle(builder, right[0], left[1], right[1]);
        left[0] = right[0];
        left[1] = right[1];
    }
}

static void build_cap(lom_mesh_builder *builder, double radius, double y, double up, int slices)
{
    lom_vec3 normal = { 0, up, 0 };
    uint32_t center = lom_builder_vertex_normal(builder, (lom_vec3){ 0, y, 0 }, normal, .5, .5), first = 0,
             previous = 0;
    for (int i = 0; i <= slices; i++) {
        lom_vec3 out = circle(i, slices);
        uint32_t next = first;
        if (i < slices)
            next = lom_builder_vertex_normal(builder, (lom_vec3){ radius * out.x, y, -radius * out.z }, normal,
                                             .5 + .5 * out.x, .5 - .5 * up * out.z);
        if (i == 0)
            first = next;
        else
            lom_builder_triangle(builder, center, up > 0 ? previous : next, up > 0 ? next : previous);
        previous = next;
    }
}

lom_mesh *lom_make_cylinder(double bottom, double top, double height, int slices, lom_error *error)
{
    bool sizes = (positive(bottom) && (positive(top) || top == 0)) || (positive(top) && bottom == 0);
    if (!check_shape(sizes && positive(height), slices, 3, 1, 1, error))
        return NULL;
    lom_mesh_builder *builder = lom_create_mesh_builder(error);
    lom_float_state state;
    lom_enter_float_state(&state);
    build_wall(builder, (const double[2]){ top, bottom }, height, slices);
    if (top > 0)
        build_cap(builder, top, height, 1, slices);
    if (bottom > 0)
        build_cap(builder, bottom, 0, -1, slices);
    lom_leave_float_state(&state);
    return lom_finish_mesh(builder, 0, error);
}
