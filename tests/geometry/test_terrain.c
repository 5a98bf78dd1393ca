/* Terrain: positions and heights against the formula, normals against an oracle that adds up the faces of the mesh, and
 * the height function against the triangles of the mesh. */
#include "check.h"

#include <lom/geometry.h>

#include <time.h>

static lom_image *make_map(int width, int height, lom_format format)
{
    lom_image *map = lom_create_image(width, height, 1, format, NULL);
    for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++) {
            uint8_t *pixel = lom_image_pixel(map, i, j, 0);
            uint64_t bits = lom_random_bits(9, (uint64_t)(j * width + i));
            float value = (float)(bits >> 40) * 0x1p-24f;
            if (format == LOM_FORMAT_R32F)
                memcpy(pixel, &value, sizeof value);
            else
                memcpy(pixel, &bits, lom_format_size(format));
        }
    return map;
}

/* Written apart from the library's: the value of a pixel by its format. */
static double gray(const lom_image *map, int i, int j)
{
    const uint8_t *p = lom_image_pixel(map, i, j, 0);
    uint16_t word;
    float value;
    memcpy(&word, p, map->format == LOM_FORMAT_R16 || map->format == LOM_FORMAT_RG16 ? sizeof word : 0);
    memcpy(&value, p, map->format == LOM_FORMAT_R32F ? sizeof value : 0);
    switch (map->format) {
    case LOM_FORMAT_R16:
    case LOM_FORMAT_RG16:
        return word / 65535.0;
    case LOM_FORMAT_R32F:
        return value;
    case LOM_FORMAT_RGB8:
    case LOM_FORMAT_RGBA8:
        return (p[0] * 65536.0 + p[1] * 256.0 + p[2]) / 16777216.0;
    default:
        return p[0] / 255.0;
    }
}

static const lom_format formats[] = { LOM_FORMAT_R8,   LOM_FORMAT_RG8,   LOM_FORMAT_R16, LOM_FORMAT_RG16,
                                      LOM_FORMAT_RGB8, LOM_FORMAT_RGBA8, LOM_FORMAT_R32F };

static void positions(void)
{
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        lom_image *map = make_map(7, 5, formats[f]);
        lom_error error = { 0 };
        lom_mesh *mesh = lom_make_terrain(map, 12, 8, 3, -1, &error);
        CHECK(mesh != NULL, "%s", error.text);
        if (mesh == NULL)
            continue;
        CHECK(mesh->vertex_count == 35 && mesh->index_count == 6 * 24 && mesh->source_triangles == 48);
        CHECK(mesh->part_count == 1 && mesh->parts[0].index_count == 144 && mesh->parts[0].material == -1);
        for (int j = 0; j < 5; j++)
            for (int i = 0; i < 7; i++) {
                const lom_mesh_vertex *v = &mesh->vertices[j * 7 + i];
                CHECK(v->position[0] == (float)(-6 + 2 * i) && v->position[2] == (float)(-4 + 2 * j), "%d,%d", i, j);
                CHECK(v->position[1] == (float)(gray(map, i, j) * 3 - 1), "format %zu: %d,%d", f, i, j);
                CHECK(v->uv[0] == (float)(i / 6.0) && v->uv[1] == (float)(j / 4.0) && v->color[3] == 1);
            }
        const uint32_t first[6] = { 0, 7, 1, 1, 7, 8 };
        CHECK(memcmp(mesh->indices, first, sizeof first) == 0, "split a,c,b and b,c,d");
        lom_free_mesh(mesh);
        lom_free_image(map);
    }
}

static lom_vec3 corner(const lom_mesh *mesh, size_t index)
{
    const float *p = mesh->vertices[mesh->indices[index]].position;
    return (lom_vec3){ p[0], p[1], p[2] };
}

static void normals(void)
{
    lom_image *map = make_map(33, 21, LOM_FORMAT_R32F);
    lom_mesh *mesh = lom_make_terrain(map, 32, 20, 2, 0, NULL);
    lom_vec3 sums[33 * 21] = { { 0, 0, 0 } };
    for (size_t k = 0; k < mesh->index_count; k += 3) {
        lom_vec3 a = corner(mesh, k), b = corner(mesh, k + 1), c = corner(mesh, k + 2);
        lom_vec3 n = lom_vec3_cross(lom_vec3_subtract(b, a), lom_vec3_subtract(c, a));
        CHECK(n.y > 0, "triangles face up");
        n = lom_vec3_normalize(n);
        for (size_t i = 0; i < 3; i++)
            sums[mesh->indices[k + i]] = lom_vec3_add(sums[mesh->indices[k + i]], n);
    }
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        lom_vec3 n = lom_vec3_normalize(sums[k]);
        const float *m = mesh->vertices[k].normal;
        double d = lom_vec3_length(lom_vec3_subtract(n, (lom_vec3){ m[0], m[1], m[2] }));
        CHECK(d < 1e-6, "vertex %zu: %g", k, d);
    }
    lom_free_mesh(mesh);
    lom_free_image(map);
    map = lom_create_image(9, 9, 1, LOM_FORMAT_R32F, NULL);
    for (int k = 0; k < 81; k++) { /* y = x / 2 - z / 4 */
        float y = (float)(k % 9) * .5f - (float)(k / 9) * .25f;
        memcpy(map->pixels + 4 * k, &y, sizeof y);
    }
    mesh = lom_make_terrain(map, 8, 8, 1, 0, NULL);
    lom_vec3 plane = lom_vec3_normalize((lom_vec3){ -.5, 1, .25 });
    for (int k = 0; k < 81; k++)
        CHECK(__builtin_fabs(mesh->vertices[k].normal[0] - plane.x) < 1e-7 &&
                  __builtin_fabs(mesh->vertices[k].normal[1] - plane.y) < 1e-7 &&
                  __builtin_fabs(mesh->vertices[k].normal[2] - plane.z) < 1e-7,
              "a plane, vertex %d", k);
    lom_free_mesh(mesh);
    lom_free_image(map);
}

static double edge(lom_vec3 a, lom_vec3 b, double x, double z)
{
    return (b.x - a.x) * (z - a.z) - (b.z - a.z) * (x - a.x);
}

/* The height of the mesh at (x, z) by looking through all its triangles. */
static double find_height(const lom_mesh *mesh, double x, double z)
{
    for (size_t k = 0; k < mesh->index_count; k += 3) {
        lom_vec3 a = corner(mesh, k), b = corner(mesh, k + 1), c = corner(mesh, k + 2);
        double u = edge(b, c, x, z), v = edge(c, a, x, z), w = edge(a, b, x, z);
        if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))
            return (a.y * u + b.y * v + c.y * w) / (u + v + w);
    }
    return -1e9;
}

static void heights(void)
{
    lom_image *map = make_map(9, 6, LOM_FORMAT_R32F);
    lom_mesh *mesh = lom_make_terrain(map, 16, 10, 5, 2, NULL);
    for (uint64_t k = 0; k < 4000; k++) {
        double x = lom_random_uniform(1, k) * 16 - 8, z = lom_random_uniform(2, k) * 10 - 5;
        double height = lom_terrain_height(map, 16, 10, 5, 2, x, z), expected = find_height(mesh, x, z);
        CHECK(__builtin_fabs(height - expected) < 1e-6, "(%g, %g): %g, the mesh has %g", x, z, height, expected);
    }
    for (int j = 0; j < 6; j++)
        for (int i = 0; i < 9; i++) {
            double y = gray(map, i, j) * 5 + 2;
            CHECK(lom_terrain_height(map, 16, 10, 5, 2, -8 + 2 * i, -5 + 2 * j) == y, "exact at pixel %d, %d", i, j);
        }
    double low = gray(map, 0, 0) * 5 + 2, high = gray(map, 8, 5) * 5 + 2, inf = __builtin_inf();
    CHECK(lom_terrain_height(map, 16, 10, 5, 2, -100, -inf) == low &&
          lom_terrain_height(map, 16, 10, 5, 2, inf, 99) == high);
    CHECK(lom_terrain_height(map, 16, 10, 5, 2, __builtin_nan(""), __builtin_nan("")) == low, "defined for NaN");
    lom_free_mesh(mesh);
    lom_free_image(map);
}

static void refusals(void)
{
    lom_image *map = make_map(4, 4, LOM_FORMAT_R32F), *thin = make_map(1, 9, LOM_FORMAT_R8);
    lom_image *color = make_map(4, 4, LOM_FORMAT_RGB16), *sizes = make_map(2, 2, LOM_FORMAT_R8);
    double nan = __builtin_nan(""), inf = __builtin_inf();
    const double bad[][4] = { { 0, 1, 1, 0 },   { 1, -1, 1, 0 },  { nan, 1, 1, 0 },
                              { 1, inf, 1, 0 }, { 1, 1, inf, 0 }, { 1, 1, 1, nan } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        lom_error error = { 0 };
        CHECK(lom_make_terrain(map, bad[i][0], bad[i][1], bad[i][2], bad[i][3], &error) == NULL &&
              error.code != LOM_OK);
        CHECK(lom_terrain_height(map, bad[i][0], bad[i][1], bad[i][2], bad[i][3], 0, 0) == 0);
    }
    CHECK(lom_make_terrain(thin, 1, 1, 1, 0, NULL) == NULL && lom_make_terrain(color, 1, 1, 1, 0, NULL) == NULL);
    int width = sizes->width;
    sizes->width = sizes->height = 32768; /* refused before anything is allocated or read */
    lom_error error = { 0 };
    CHECK(lom_make_terrain(sizes, 1, 1, 1, 0, &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s", error.text);
    sizes->width = sizes->height = width;
    float poison = __builtin_nanf("");
    memcpy(lom_image_pixel(map, 2, 1, 0), &poison, sizeof poison);
    error = (lom_error){ 0 };
    CHECK(lom_make_terrain(map, 1, 1, 1, 0, &error) == NULL && strstr(error.text, "(2, 1)") != NULL, "%s", error.text);
    lom_free_image(map);
    lom_free_image(thin);
    lom_free_image(color);
    lom_free_image(sizes);
}

/* Well under a second, also on a loaded machine: processor time. */
/* Every coast that has a name is made, another from another seed, with land and water; what has none is refused. */
static void coasts_by_name(void)
{
    size_t count = 0;
    for (; lom_coast_name(count) != NULL; count++) {
        const char *name = lom_coast_name(count);
        lom_error error = { 0 };
        lom_image *map = lom_make_coast(name, 33, 1, &error), *other = lom_make_coast(name, 33, 2, &error);
        CHECK(map != NULL && other != NULL && map->format == LOM_FORMAT_R16, "%s: %s", name, error.text);
        if (map == NULL || other == NULL)
            return;
        const uint16_t *heights = (const uint16_t *)(const void *)map->pixels;
        uint16_t low = 65535, high = 0;
        for (int i = 0; i < 33 * 33; i++) {
            low = heights[i] < low ? heights[i] : low;
            high = heights[i] > high ? heights[i] : high;
        }
        CHECK(high > low + 3000, "%s is flat: %d to %d", name, low, high);
        CHECK(memcmp(map->pixels, other->pixels, lom_image_size(map)) != 0, "%s does not follow its seed", name);
        lom_free_image(map);
        lom_free_image(other);
    }
    CHECK(count >= 4, "%zu coasts", count);
    static const struct {
        const char *name;
        int size;
    } bad[] = { { "coast", 33 }, { "", 33 }, { "cove", 1 }, { "cove", -5 }, { "cove", 4097 } };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        lom_error error = { 0 };
        CHECK(lom_make_coast(bad[i].name, bad[i].size, 1, &error) == NULL && error.code == LOM_ERROR_USAGE,
              "case %zu: %s", i, error.text);
    }
    static const lom_albedo_desc pictures[] = { { .name = "gras", .size = 64 },
                                                { .name = "grass", .size = 63 },
                                                { .name = "grass", .size = 4097 },
                                                { .size = 64 } };
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++) {
        lom_error error = { 0 };
        CHECK(lom_make_albedo(&pictures[i], &error) == NULL && error.code == LOM_ERROR_USAGE, "picture %zu: %s", i,
              error.text);
    }
}

static void speed(void)
{
    lom_image *map = make_map(1024, 1024, LOM_FORMAT_R16);
    clock_t start = clock();
    lom_mesh *mesh = lom_make_terrain(map, 1000, 1000, 100, 0, NULL);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    printf("  1024 x 1024 in %.3f s\n", seconds);
    CHECK(mesh != NULL && mesh->index_count == 6 * 1023 * 1023 && seconds < 5);
    lom_free_mesh(mesh);
    lom_free_image(map);
}

int main(int argc, char **argv)
{
    RUN(positions);
    RUN(normals);
    RUN(heights);
    RUN(refusals);
    RUN(coasts_by_name);
    RUN(speed);
    return check_result();
}
