/* The peers' meshes and cameras. In: formulas of bench/peers/README.md; out: interleaved float vertices, 32-bit
 * indices, float matrices. Invariant: float arithmetic in the order of the peers' harness; only sine, cosine and
 * tangent are taken in double and rounded once, where the harness uses its C library's float ones. */
#include "peer_meshes.h"

void lom_peer_free_mesh(lom_peer_mesh *mesh)
{
    lom_release(mesh->vertices);
    lom_release(mesh->indices);
    lom_free_clusters(mesh->clusters);
    *mesh = (lom_peer_mesh){ 0 };
}

bool lom_peer_allocate_mesh(lom_peer_mesh *mesh, size_t vertices, size_t indices, lom_error *error)
{
    *mesh = (lom_peer_mesh){ .vertex_count = vertices, .index_count = indices };
    mesh->vertices = lom_allocate(vertices, sizeof *mesh->vertices, error);
    mesh->indices = mesh->vertices != NULL ? lom_allocate(indices, sizeof *mesh->indices, error) : NULL;
    return mesh->indices != NULL;
}

/* A grid of columns x rows vertices, each quad cut into a c b and b c d. */
static bool allocate_grid(lom_peer_mesh *mesh, uint32_t columns, uint32_t rows, lom_error *error)
{
    if (!lom_peer_allocate_mesh(mesh, (size_t)columns * rows, (size_t)6 * (columns - 1) * (rows - 1), error))
        return false;
    uint32_t *next = mesh->indices;
    for (uint32_t j = 0; j + 1 < rows; j++)
        for (uint32_t i = 0; i + 1 < columns; i++) {
            uint32_t a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
            const uint32_t quad[6] = { a, c, b, b, c, d };
            for (int k = 0; k < 6; k++)
                next[k] = quad[k];
            next += 6;
        }
    return true;
}

static float sine(float x)
{
    return (float)lom_double_sin((double)x);
}

static float cosine(float x)
{
    return (float)lom_double_cos((double)x);
}

bool lom_peer_torus(lom_peer_mesh *mesh, lom_error *error)
{
    enum { U = 400, V = 250 };
    if (!allocate_grid(mesh, U + 1, V + 1, error))
        return false;
    for (int j = 0; j <= V; j++)
        for (int i = 0; i <= U; i++) {
            float a = 6.28318530718f * (float)i / U, b = 6.28318530718f * (float)j / V;
            float ca = cosine(a), sa = sine(a), cb = cosine(b), sb = sine(b);
            mesh->vertices[j * (U + 1) + i] = (lom_peer_vertex){
                .position = { (1 + 0.4f * cb) * ca, 0.4f * sb, (1 + 0.4f * cb) * sa },
                .normal = { cb * ca, sb, cb * sa },
                .uv = { (float)i / U, (float)j / V },
            };
        }
    return true;
}

float lom_peer_terrain_height(float x, float z)
{
    return 5.0f * sine(0.06f * x + 0.5f) * cosine(0.05f * z) + 2.5f * sine(0.17f * x + 0.11f * z) +
           1.2f * sine(0.31f * z - 0.23f * x + 1.0f) + 0.3f * sine(0.9f * x) * sine(0.8f * z) - 1.5f;
}

bool lom_peer_terrain(lom_peer_mesh *mesh, lom_error *error)
{
    enum { N = 512 };
    const float e = 0.1f;
    if (!allocate_grid(mesh, N, N, error))
        return false;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            float x = -50 + 100.0f * (float)i / (N - 1), z = -50 + 100.0f * (float)j / (N - 1);
            float dx = (lom_peer_terrain_height(x + e, z) - lom_peer_terrain_height(x - e, z)) / (2 * e);
            float dz = (lom_peer_terrain_height(x, z + e) - lom_peer_terrain_height(x, z - e)) / (2 * e);
            float inverse = 1 / __builtin_sqrtf(dx * dx + dz * dz + 1);
            mesh->vertices[j * N + i] = (lom_peer_vertex){
                .position = { x, lom_peer_terrain_height(x, z), z },
                .normal = { -dx * inverse, inverse, -dz * inverse },
                .uv = { (float)i / (N - 1), (float)j / (N - 1) },
            };
        }
    const lom_attribute positions = { .data = mesh->vertices,
                                      .size = mesh->vertex_count * sizeof *mesh->vertices,
                                      .stride = sizeof *mesh->vertices,
                                      .kind = LOM_ATTRIBUTE_FLOAT3 };
    mesh->clusters = lom_create_clusters(&positions, mesh->indices, mesh->index_count, error);
    return mesh->clusters != NULL;
}

bool lom_peer_cube(lom_peer_mesh *mesh, lom_error *error)
{
    static const uint8_t indices[36] = { 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                         2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6 };
    if (!lom_peer_allocate_mesh(mesh, 8, 36, error))
        return false;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            mesh->vertices[i].position[k] = i >> k & 1 ? 1 : -1;
    for (int i = 0; i < 36; i++)
        mesh->indices[i] = indices[i];
    return true;
}

bool lom_peer_water(lom_peer_mesh *mesh, lom_error *error)
{
    if (!allocate_grid(mesh, 2, 2, error))
        return false;
    for (int i = 0; i < 4; i++) {
        float s = (float)(i & 1), t = (float)(i >> 1);
        mesh->vertices[i] = (lom_peer_vertex){ { -50 + 100 * s, 0, -50 + 100 * t }, { 0, 1, 0 }, { s, t } };
    }
    return true;
}

static lom_peer_matrix multiply(const lom_peer_matrix *a, const lom_peer_matrix *b)
{
    lom_peer_matrix product;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++)
                sum += a->m[k * 4 + row] * b->m[column * 4 + k];
            product.m[column * 4 + row] = sum;
        }
    return product;
}

static lom_peer_matrix look_at(const float eye[3], const float target[3])
{
    float f[3] = { target[0] - eye[0], target[1] - eye[1], target[2] - eye[2] };
    float length = __builtin_sqrtf(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    for (int i = 0; i < 3; i++)
        f[i] /= length;
    float s[3] = { -f[2], 0, f[0] }; /* f x (0, 1, 0) */
    length = __builtin_sqrtf(s[0] * s[0] + s[2] * s[2]);
    s[0] /= length;
    s[2] /= length;
    float u[3] = { s[1] * f[2] - s[2] * f[1], s[2] * f[0] - s[0] * f[2], s[0] * f[1] - s[1] * f[0] };
    lom_peer_matrix view = { { s[0], u[0], -f[0], 0, s[1], u[1], -f[1], 0, s[2], u[2], -f[2], 0, 0, 0, 0, 1 } };
    view.m[12] = -(s[0] * eye[0] + s[1] * eye[1] + s[2] * eye[2]);
    view.m[13] = -(u[0] * eye[0] + u[1] * eye[1] + u[2] * eye[2]);
    view.m[14] = f[0] * eye[0] + f[1] * eye[1] + f[2] * eye[2];
    return view;
}

lom_peer_matrix lom_peer_view(const float eye[3], const float target[3], float field_of_view, float aspect,
                              float near_plane, float far_plane)
{
    float t = 1.0f / (float)lom_double_tan((double)(field_of_view * 3.14159265358979f / 360.0f));
    lom_peer_matrix projection = { { [0] = t / aspect,
                                     [5] = t,
                                     [10] = (far_plane + near_plane) / (near_plane - far_plane),
                                     [11] = -1,
                                     [14] = 2 * far_plane * near_plane / (near_plane - far_plane) } };
    lom_peer_matrix view = look_at(eye, target);
    return multiply(&projection, &view);
}

lom_peer_matrix lom_peer_mirror(const lom_peer_matrix *view)
{
    lom_peer_matrix mirror = { { [0] = 1, [5] = -1, [10] = 1, [15] = 1 } };
    return multiply(view, &mirror);
}
