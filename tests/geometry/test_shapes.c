/* Shapes and the builder: closed surfaces (every edge has its opposite), Euler's formula, volumes, formulas of the
 * torus, normals by crease against a plain oracle. */
#include "check.h"

#include "geometry/model.h"

#include <lom/geometry.h>

static const double PI = 3.14159265358979323846;

static lom_vec3 vector(const float *p)
{
    return (lom_vec3){ p[0], p[1], p[2] };
}

static lom_vec3 corner(const lom_mesh *mesh, size_t index)
{
    return vector(mesh->vertices[mesh->indices[index]].position);
}

/* Volume by the divergence theorem: positive when the triangles face outwards. */
static double volume(const lom_mesh *mesh)
{
    double sum = 0;
    for (size_t k = 0; k < mesh->index_count; k += 3)
        sum += lom_vec3_dot(corner(mesh, k), lom_vec3_cross(corner(mesh, k + 1), corner(mesh, k + 2))) / 6;
    return sum;
}

static int compare_positions(const void *a, const void *b)
{
    const float *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p[i] != q[i])
            return p[i] < q[i] ? -1 : 1;
    return 0;
}

static int compare_numbers(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Vertices - edges + faces of the surface with equal positions as one; -99 when an edge is not shared by exactly two
 * triangles that run along it in opposite directions. */
static int euler(const lom_mesh *mesh)
{
    size_t n = mesh->vertex_count, edges = mesh->index_count, places = 0, i = 0, j = 0;
    float(*sorted)[3] = malloc(n * sizeof *sorted);
    uint64_t *there = malloc(edges * sizeof *there), *back = malloc(edges * sizeof *back);
    for (size_t k = 0; k < n; k++)
        for (int axis = 0; axis < 3; axis++)
            sorted[k][axis] = mesh->vertices[k].position[axis] + 0.f;
    qsort(sorted, n, sizeof *sorted, compare_positions);
    for (size_t k = 0; k < n; k++)
        if (k == 0 || compare_positions(sorted[k], sorted[places - 1]) != 0)
            memmove(sorted[places++], sorted[k], sizeof *sorted);
    for (size_t k = 0; k < edges; k++) {
        size_t next = k % 3 == 2 ? k - 2 : k + 1;
        const float *p = mesh->vertices[mesh->indices[k]].position, *q = mesh->vertices[mesh->indices[next]].position;
        uint64_t from = (uint64_t)((float(*)[3])bsearch(p, sorted, places, sizeof *sorted, compare_positions) - sorted);
        uint64_t to = (uint64_t)((float(*)[3])bsearch(q, sorted, places, sizeof *sorted, compare_positions) - sorted);
        there[k] = from << 32 | to;
        back[k] = to << 32 | from;
    }
    qsort(there, edges, sizeof *there, compare_numbers);
    qsort(back, edges, sizeof *back, compare_numbers);
    bool closed = memcmp(there, back, edges * sizeof *there) == 0;
    for (i = 0, j = 1; j < edges; i++, j++)
        closed = closed && there[i] != there[j];
    free(sorted);
    free(there);
    free(back);
    return closed ? (int)places - (int)edges / 2 + (int)edges / 3 : -99;
}

/* Normals of unit length that point to the side the triangles face; no triangle without area; one part. */
static void check_shape(const char *name, const lom_mesh *mesh, int characteristic, double expected, double tolerance)
{
    CHECK(mesh != NULL, "%s", name);
    if (mesh == NULL)
        return;
    for (size_t k = 0; k < mesh->index_count; k++) {
        size_t first = k - k % 3;
        lom_vec3 a = corner(mesh, first), n = vector(mesh->vertices[mesh->indices[k]].normal);
        lom_vec3 face = lom_vec3_cross(lom_vec3_subtract(corner(mesh, first + 1), a),
                                       lom_vec3_subtract(corner(mesh, first + 2), a));
        CHECK(lom_vec3_length(face) > 1e-9, "%s: triangle %zu has no area", name, k / 3);
        CHECK(lom_vec3_dot(n, lom_vec3_normalize(face)) > .3, "%s: corner %zu", name, k);
        CHECK(__builtin_fabs(lom_vec3_length(n) - 1) < 1e-6, "%s", name);
    }
    CHECK(mesh->part_count == 1 && mesh->parts[0].index_count == mesh->index_count && mesh->parts[0].material == -1);
    CHECK(mesh->source_triangles == mesh->index_count / 3);
    CHECK(euler(mesh) == characteristic, "%s: %d", name, euler(mesh));
    CHECK(__builtin_fabs(volume(mesh) - expected) < tolerance * expected, "%s: volume %g, expected %g", name,
          volume(mesh), expected);
}

static void closed_shapes(void)
{
    lom_mesh *mesh = lom_make_box((lom_vec3){ 2, 3, 4 }, NULL);
    check_shape("box", mesh, 2, 24, 1e-6);
    CHECK(mesh->vertex_count == 24);
    lom_box bounds = lom_mesh_bounds(mesh);
    CHECK(bounds.low.x == -1 && bounds.low.y == -1.5 && bounds.low.z == -2 && bounds.high.x == 1 &&
          bounds.high.y == 1.5 && bounds.high.z == 2);
    lom_free_mesh(mesh);
    mesh = lom_make_sphere(2, 64, 32, NULL);
    check_shape("sphere", mesh, 2, 4. / 3 * PI * 8, .01);
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        lom_vec3 p = vector(mesh->vertices[k].position), n = vector(mesh->vertices[k].normal);
        CHECK(lom_vec3_length(lom_vec3_subtract(p, lom_vec3_scale(n, 2))) < 1e-6);
    }
    lom_free_mesh(mesh);
    mesh = lom_make_sphere(1, 3, 2, NULL);
    check_shape("least sphere", mesh, 2, 3 * .75 * 1.7320508075688772 / 4 * 2 / 3. * 1.3333333333333333, 1e-6);
    lom_free_mesh(mesh);
    mesh = lom_make_torus(1, .4, 80, 50, NULL);
    check_shape("torus", mesh, 0, 2 * PI * PI * .16, .01);
    lom_free_mesh(mesh);
    mesh = lom_make_cylinder(2, 2, 3, 64, NULL);
    check_shape("cylinder", mesh, 2, PI * 4 * 3, .01);
    lom_free_mesh(mesh);
    mesh = lom_make_cylinder(2, 1, 3, 64, NULL);
    check_shape("frustum", mesh, 2, PI * 7, .01);
    lom_free_mesh(mesh);
    mesh = lom_make_cylinder(2, 0, 3, 64, NULL);
    check_shape("cone", mesh, 2, PI * 4, .01);
    lom_free_mesh(mesh);
    mesh = lom_make_cylinder(0, 2, 3, 64, NULL);
    check_shape("cone upside down", mesh, 2, PI * 4, .01);
    lom_free_mesh(mesh);
}

/* As the peers define it: 401 x 251 vertices, 200 000 triangles, the quads' order. */
static void torus_formula(void)
{
    lom_mesh *mesh = lom_make_torus(1, .4, 400, 250, NULL);
    CHECK(mesh->vertex_count == 401 * 251 && mesh->index_count == 600000);
    const uint32_t first[6] = { 0, 401, 1, 1, 401, 402 };
    CHECK(memcmp(mesh->indices, first, sizeof first) == 0);
    for (int j = 0; j <= 250; j++)
        for (int i = 0; i <= 400; i++) {
            double a = 2 * PI * i / 400, b = 2 * PI * j / 250, ca = lom_double_cos(a), sa = lom_double_sin(a);
            double cb = lom_double_cos(b), sb = lom_double_sin(b);
            const lom_mesh_vertex *v = &mesh->vertices[j * 401 + i];
            lom_vec3 p = { (1 + .4 * cb) * ca, .4 * sb, (1 + .4 * cb) * sa }, n = { cb * ca, sb, cb * sa };
            CHECK(lom_vec3_length(lom_vec3_subtract(vector(v->position), p)) < 2e-7, "%d, %d", i, j);
            CHECK(lom_vec3_length(lom_vec3_subtract(vector(v->normal), n)) < 2e-7, "%d, %d", i, j);
            CHECK(v->uv[0] == (float)(i / 400.) && v->uv[1] == (float)(j / 250.));
        }
    lom_free_mesh(mesh);
}

static void flat_shapes(void)
{
    lom_mesh *mesh = lom_make_grid(6, 4, 3, 2, NULL), *quad = lom_make_quad(100, 100, NULL);
    CHECK(mesh->vertex_count == 12 && mesh->index_count == 36 && quad->vertex_count == 4 && quad->index_count == 6);
    for (size_t k = 0; k < 12; k++) {
        const lom_mesh_vertex *v = &mesh->vertices[k];
        CHECK(v->position[0] == -3 + 2 * (float)(k % 4) && v->position[2] == -2 + 2 * (float)(k / 4) &&
              v->position[1] == 0 && v->normal[1] == 1 && v->color[0] == 1);
    }
    CHECK(quad->vertices[0].position[0] == -50 && quad->vertices[0].position[2] == -50 && quad->vertices[0].uv[1] == 0);
    lom_vec3 a = corner(quad, 0),
             n = lom_vec3_cross(lom_vec3_subtract(corner(quad, 1), a), lom_vec3_subtract(corner(quad, 2), a));
    CHECK(n.y == 10000 && n.x == 0 && n.z == 0);
    lom_free_mesh(mesh);
    lom_free_mesh(quad);
}

static void refusals(void)
{
    double nan = __builtin_nan(""), inf = __builtin_inf();
    const double bad[] = { 0, -1, nan, inf, 1e39 };
    for (int i = 0; i < 5; i++) {
        double x = bad[i];
        CHECK(lom_make_box((lom_vec3){ 1, x, 1 }, NULL) == NULL && lom_make_quad(x, 1, NULL) == NULL, "case %d", i);
        CHECK(lom_make_grid(1, x, 1, 1, NULL) == NULL && lom_make_sphere(x, 9, 9, NULL) == NULL, "case %d", i);
        CHECK(lom_make_torus(1, x, 9, 9, NULL) == NULL && lom_make_cylinder(1, 1, x, 9, NULL) == NULL, "case %d", i);
    }
    lom_error error = { 0 };
    CHECK(lom_make_cylinder(0, 0, 1, 9, NULL) == NULL && lom_make_cylinder(1, -1, 1, 9, NULL) == NULL);
    CHECK(lom_make_sphere(1, 2, 9, NULL) == NULL && lom_make_sphere(1, 3, 1, NULL) == NULL);
    CHECK(lom_make_grid(1, 1, 0, 1, NULL) == NULL && lom_make_torus(1, .5, 3, 2, NULL) == NULL);
    CHECK(lom_make_grid(1, 1, 1 << 30, 1 << 30, &error) == NULL && error.code == LOM_ERROR_USAGE);
}

/* ---- transformation ---- */

static void transformation(void)
{
    lom_mesh *mesh = lom_make_torus(1, .4, 30, 20, NULL);
    lom_mat4 m = lom_model_matrix((lom_vec3){ 3, -2, 1 }, (lom_vec3){ .3, 1, -2 }, (lom_vec3){ 2, -1, .5 });
    CHECK(lom_transform_mesh(mesh, &m, NULL));
    double size = volume(mesh);
    for (size_t k = 0; k < mesh->index_count; k += 3) {
        lom_vec3 a = corner(mesh, k);
        lom_vec3 face =
            lom_vec3_cross(lom_vec3_subtract(corner(mesh, k + 1), a), lom_vec3_subtract(corner(mesh, k + 2), a));
        CHECK(lom_vec3_dot(face, vector(mesh->vertices[mesh->indices[k]].normal)) > 0, "mirrored and still outside");
    }
    CHECK(size > 2 * PI * PI * .16 * .9 && size < 2 * PI * PI * .16, "%g", size);
    lom_mat4 flat = lom_scaling((lom_vec3){ 1, 0, 1 });
    float before = mesh->vertices[5].position[1];
    lom_error error = { 0 };
    CHECK(!lom_transform_mesh(mesh, &flat, &error) && error.code == LOM_ERROR_USAGE);
    CHECK(mesh->vertices[5].position[1] == before);
    lom_free_mesh(mesh);
    lom_mesh *none = lom_create_mesh(0, 0, 0, 0, NULL);
    lom_box bounds = lom_mesh_bounds(none);
    CHECK(bounds.low.x > bounds.high.x);
    lom_free_mesh(none);
}

/* ---- the builder ---- */

/* The eight corners of a cube, each used by three faces. */
static void build_cube(lom_mesh_builder *builder)
{
    uint32_t v[8];
    for (int i = 0; i < 8; i++)
        v[i] = lom_builder_vertex(builder, (lom_vec3){ i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1 }, 0, 0);
    const int faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                              { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    for (int f = 0; f < 6; f++)
        lom_builder_quad(builder, v[faces[f][0]], v[faces[f][1]], v[faces[f][2]], v[faces[f][3]]);
}

/* Every corner's normal by looking at all triangles. */
static void check_crease(const lom_mesh *mesh, double crease)
{
    for (size_t k = 0; k < mesh->index_count; k++) {
        lom_vec3 own = { 0, 0, 0 }, sum = { 0, 0, 0 }, p = corner(mesh, k);
        for (int pass = 0; pass < 2; pass++)
            for (size_t t = 0; t < mesh->index_count; t += 3) {
                lom_vec3 a = corner(mesh, t), b = corner(mesh, t + 1), c = corner(mesh, t + 2);
                lom_vec3 n = lom_vec3_normalize(lom_vec3_cross(lom_vec3_subtract(b, a), lom_vec3_subtract(c, a)));
                bool at = compare_positions(mesh->vertices[mesh->indices[k]].position,
                                            mesh->vertices[mesh->indices[t]].position) == 0;
                at = at || lom_vec3_length(lom_vec3_subtract(b, p)) == 0 ||
                     lom_vec3_length(lom_vec3_subtract(c, p)) == 0;
                if (pass == 0 && t == k - k % 3)
                    own = n;
                if (pass == 1 && at &&
                    lom_double_acos(lom_vec3_dot(own, n) > 1 ? 1 : lom_vec3_dot(own, n)) <= crease + 1e-4)
                    sum = lom_vec3_add(sum, n);
            }
        lom_vec3 n = vector(mesh->vertices[mesh->indices[k]].normal);
        CHECK(lom_vec3_length(lom_vec3_subtract(n, lom_vec3_normalize(sum))) < 1e-6, "corner %zu, crease %g", k,
              crease);
    }
}

static void creases(void)
{
    const double angles[] = { 0, .5, 1.5, 1.6, 4 };
    for (int i = 0; i < 5; i++) {
        lom_mesh_builder *builder = lom_create_mesh_builder(NULL);
        build_cube(builder);
        lom_mesh *cube = lom_finish_mesh(builder, angles[i], NULL);
        CHECK(cube->vertex_count == (i < 3 ? 24 : 8), "crease %g: %zu vertices", angles[i], cube->vertex_count);
        check_shape("cube", cube, 2, 8, 1e-6);
        check_crease(cube, angles[i]);
        uint32_t seen = 0; /* numbered by first use */
        for (size_t k = 0; k < cube->index_count; k++) {
            CHECK(cube->indices[k] <= seen);
            seen += cube->indices[k] == seen;
        }
        lom_free_mesh(cube);
        builder = lom_create_mesh_builder(NULL);
        for (int k = 0; k < 120; k++) { /* crumpled triangles that meet in shared places, each with its own vertices */
            uint32_t v[3];
            for (uint64_t c = 0; c < 3; c++) {
                uint64_t bits = lom_random_bits(8, 3 * (uint64_t)k + c) % 14;
                v[c] = lom_builder_vertex(
                    builder,
                    (lom_vec3){ lom_random_uniform(1, bits), lom_random_uniform(2, bits), lom_random_uniform(3, bits) },
                    0, 0);
            }
            lom_builder_triangle(builder, v[0], v[1], v[2]);
        }
        lom_mesh *crumpled = lom_finish_mesh(builder, angles[i], NULL);
        int flat = 0;
        for (size_t k = 0; k < crumpled->index_count; k += 3)
            flat += crumpled->indices[k] == crumpled->indices[k + 1];
        CHECK(crumpled->index_count == 360 && flat == 0);
        lom_free_mesh(crumpled);
    }
    lom_mesh_builder *builder =
        lom_create_mesh_builder(NULL); /* a curved strip with its own vertices for each triangle */
    for (int i = 0; i < 40; i++) {
        lom_vec3 p[4];
        for (int k = 0; k < 4; k++)
            p[k] = (lom_vec3){ (double)(i + k % 2), lom_double_sin((i + k % 2) * 1.3), k / 2 };
        uint32_t a = lom_builder_vertex(builder, p[0], 0, 0), b = lom_builder_vertex(builder, p[1], 0, 0);
        uint32_t c = lom_builder_vertex(builder, p[2], 0, 0), d = lom_builder_vertex(builder, p[3], 0, 0);
        lom_builder_quad(builder, a, c, d, b);
    }
    lom_mesh *strip = lom_finish_mesh(builder, .9, NULL);
    check_crease(strip, .9);
    lom_free_mesh(strip);
}

static void assembly(void)
{
    lom_error error = { 0 };
    lom_mesh *box = lom_make_box((lom_vec3){ 2, 2, 2 }, NULL);
    lom_mesh_builder *builder = lom_create_mesh_builder(&error);
    lom_material red = lom_default_material("red"), blue = lom_default_material("blue");
    red.diffuse[1] = red.diffuse[2] = 0;
    int first = lom_builder_material(builder, &red);
    lom_builder_color(builder, .5, 1, 1, 1);
    lom_mat4 left = lom_model_matrix((lom_vec3){ -5, 0, 0 }, (lom_vec3){ 0, 1, 0 }, (lom_vec3){ -1, 2, 1 });
    lom_builder_transform(builder, &left);
    lom_builder_mesh(builder, box);
    lom_builder_transform(builder, NULL);
    CHECK(lom_builder_material(builder, &blue) == first + 1);
    build_cube(builder);
    CHECK(lom_builder_material(builder, &red) == first);
    build_cube(builder);
    lom_builder_vertex(builder, (lom_vec3){ 99, 0, 0 }, 0, 0); /* not used: dropped */
    lom_mesh *mesh = lom_finish_mesh(builder, 0, &error);
    CHECK(mesh != NULL, "%s", error.text);
    CHECK(mesh->part_count == 2 && mesh->material_count == 2 && mesh->vertex_count == 72, "%zu", mesh->vertex_count);
    CHECK(mesh->parts[0].material == 0 && mesh->parts[0].index_count == 72 && mesh->parts[1].first_index == 72 &&
          mesh->parts[1].material == 1 && mesh->materials[0].diffuse[1] == 0);
    CHECK(__builtin_fabs(volume(mesh) - (16 + 8 + 8)) < 1e-5, "%g", volume(mesh));
    CHECK(mesh->vertices[0].color[0] == .5f && lom_mesh_bounds(mesh).high.x == 1);
    /* a mesh in a mesh: materials are found by name */
    builder = lom_create_mesh_builder(&error);
    lom_builder_material(builder, &blue);
    lom_builder_mesh(builder, mesh);
    lom_builder_mesh(builder, box);
    lom_mesh *whole = lom_finish_mesh(builder, 0, &error);
    CHECK(whole != NULL && whole->part_count == 2 && whole->material_count == 2 && whole->parts[1].index_count == 72,
          "%s", error.text);
    CHECK(strcmp(whole->materials[0].name, "blue") == 0 && whole->parts[0].material == 1);
    lom_free_mesh(whole);
    lom_free_mesh(mesh);
    lom_free_mesh(box);
}

/* Where a triangle has no area, nor has any about it, up is its normal. */
static void triangles_without_area_face_up(void)
{
    lom_mesh_builder *builder = lom_create_mesh_builder(NULL);
    for (int k = 0; k < 3; k++)
        lom_builder_vertex(builder, (lom_vec3){ k, 2 * k, 0 }, 0, 0);
    lom_builder_triangle(builder, 0, 1, 2);
    lom_mesh *mesh = lom_finish_mesh(builder, 1, NULL);
    for (size_t k = 0; mesh != NULL && k < mesh->vertex_count; k++)
        CHECK(mesh->vertices[k].normal[0] == 0 && mesh->vertices[k].normal[1] == 1 && mesh->vertices[k].normal[2] == 0,
              "vertex %zu", k);
    lom_free_mesh(mesh);
}

/* Tubes that end in a disc or a tip are closed, and have the volume of their truncated pyramids. */
static void tubes_are_closed(void)
{
    static const double radii[3][3] = { { 1, 1, 1 }, { 1, 1, 0 }, { 0.5, 1, 0 } };
    for (int i = 0; i < 3; i++) {
        lom_mesh_builder *builder = lom_create_mesh_builder(NULL);
        lom_model_ring rings[3];
        for (int k = 0; k < 3; k++)
            rings[k] = (lom_model_ring){ .center = { 0, 3.0 * k, 0 }, .radius = radii[i][k] };
        lom_model_tube(builder, rings, 3, 16, (lom_model_map){ .u0 = 0, .u1 = 1, .metres = 1 });
        lom_mesh *tube = lom_finish_mesh(builder, 0.5, NULL);
        double area = 8 * lom_double_sin(PI / 8), thirds = 0; /* of the polygon of 16 corners */
        for (int k = 0; k < 2; k++)
            thirds += radii[i][k] * radii[i][k] + radii[i][k] * radii[i][k + 1] + radii[i][k + 1] * radii[i][k + 1];
        check_shape("tube", tube, 2, area * 3 * thirds / 3, 1e-5);
        lom_free_mesh(tube);
    }
}

static void failures(void)
{
    for (int i = 0; i < 6; i++) {
        lom_error error = { 0 };
        lom_mesh_builder *builder = lom_create_mesh_builder(&error);
        lom_mat4 flat = lom_scaling((lom_vec3){ 1, 1, 0 });
        lom_material unnamed = lom_default_material("");
        build_cube(builder);
        if (i == 0)
            lom_builder_vertex(builder, (lom_vec3){ 0, __builtin_nan(""), 0 }, 0, 0);
        if (i == 1)
            lom_builder_triangle(builder, 0, 1, 8);
        if (i == 2)
            lom_builder_transform(builder, &flat);
        if (i == 3)
            lom_builder_material(builder, &unnamed);
        if (i == 4)
            lom_builder_vertex(builder, (lom_vec3){ 1e39, 0, 0 }, 0, 0);
        build_cube(builder);
        lom_mesh *mesh = lom_finish_mesh(builder, 1, &error);
        CHECK((mesh == NULL) == (i < 5) && (error.code == LOM_ERROR_USAGE) == (i < 5), "case %d: %s", i, error.text);
        lom_free_mesh(mesh);
    }
    const size_t most = (size_t)UINT32_MAX + 1;
    lom_error large = { 0 };
    CHECK(lom_create_mesh(most, 3, 1, 0, &large) == NULL && large.code == LOM_ERROR_LIMIT, "%s", large.text);
    CHECK(lom_create_mesh(3, most, 1, 0, NULL) == NULL, "more than 2^32 indices");
    lom_builder_vertex(NULL, (lom_vec3){ 0, 0, 0 }, 0, 0);
    lom_builder_triangle(NULL, 0, 0, 0);
    lom_builder_transform(NULL, NULL);
    lom_builder_color(NULL, 0, 0, 0, 0);
    lom_error error = { 0 };
    CHECK(lom_builder_material(NULL, NULL) == -1 && lom_finish_mesh(NULL, 0, &error) == NULL && error.code != LOM_OK);
    lom_free_mesh_builder(NULL);
    lom_free_mesh(NULL);
    lom_mesh *empty = lom_finish_mesh(lom_create_mesh_builder(NULL), 0, NULL);
    CHECK(empty != NULL && empty->index_count == 0 && empty->part_count == 0);
    lom_free_mesh(empty);
}

/* Euler: V - E + F = 2 of closed shapes, 0 of a torus, 1 of a disc, where vertices at one place are one. */
static void edges_are_listed_once(void)
{
    lom_error error = { 0 };
    const struct {
        lom_mesh *mesh;
        size_t edges;
    } cases[] = { { lom_make_box((lom_vec3){ 1, 2, 3 }, &error), 18 },      /* 12, and a diagonal a face */
                  { lom_make_quad(2, 2, &error), 5 },                       /* 4 - 5 + 2 = 1 */
                  { lom_make_grid(3, 2, 3, 2, &error), 3 * 3 + 2 * 4 + 6 }, /* rows, columns, diagonals */
                  { lom_make_torus(3, 1, 8, 5, &error), 8 * 5 * 3 } };      /* V - E + 2 V = 0 but for rounding */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t count = 0;
        uint32_t *edges = lom_mesh_edges(cases[i].mesh, &count, &error);
        CHECK(edges != NULL && (i == 3 ? count >= 2 * cases[i].edges : count == 2 * cases[i].edges), "case %zu: %zu", i,
              count / 2);
        for (size_t a = 0; a < count; a += 2)
            for (size_t b = a + 2; b < count; b += 2)
                CHECK(edges[a] != edges[b] || edges[a + 1] != edges[b + 1], "case %zu: edge %zu is edge %zu", i, a, b);
        for (size_t a = 0; a < count; a += 2)
            CHECK(edges[a] < edges[a + 1], "case %zu: edge %zu", i, a);
        lom_release(edges);
        lom_free_mesh(cases[i].mesh);
    }
    lom_mesh *none = lom_create_mesh(3, 0, 0, 0, &error);
    size_t count = 9;
    uint32_t *edges = lom_mesh_edges(none, &count, &error);
    CHECK(edges != NULL && count == 0);
    lom_release(edges);
    lom_free_mesh(none);
}

int main(int argc, char **argv)
{
    RUN(closed_shapes);
    RUN(torus_formula);
    RUN(flat_shapes);
    RUN(refusals);
    RUN(transformation);
    RUN(creases);
    RUN(assembly);
    RUN(triangles_without_area_face_up);
    RUN(tubes_are_closed);
    RUN(failures);
    RUN(edges_are_listed_once);
    return check_result();
}
