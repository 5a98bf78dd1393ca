/* Terrain from a height map. In: gray, float or 24-bit RGB pixels. Out: a grid mesh, and the height of its triangles at
 * any place. Heights and normals are computed in double and rounded once to float; both functions use the same heights
 * and the same diagonal. Compiled for speed. */
#include "geometry/terrain.h"

#include <string.h>

enum { PIXEL_LIMIT = 1 << 26 };

struct terrain {
    const lom_image *map;
    double width, length, height, base;
};

struct terrain_mesh {
    lom_mesh *mesh;
    size_t width; /* vertices of a row */
};

/* ---- heights ---- */

static double gray_8(const uint8_t *pixel)
{
    return pixel[0] / 255.;
}

static double gray_16(const uint8_t *pixel)
{
    uint16_t value;
    memcpy(&value, pixel, sizeof value);
    return value / 65535.;
}

static double gray_float(const uint8_t *pixel)
{
    float value;
    memcpy(&value, pixel, sizeof value);
    return (double)value;
}

static double gray_24(const uint8_t *pixel)
{
    return ((uint32_t)pixel[0] << 16 | (uint32_t)pixel[1] << 8 | pixel[2]) * 0x1p-24;
}

typedef double gray_function(const uint8_t *pixel);

static const struct {
    lom_format format;
    gray_function *gray;
} formats[] = {
    { LOM_FORMAT_R8, gray_8 },       { LOM_FORMAT_RG8, gray_8 },       { LOM_FORMAT_R16, gray_16 },
    { LOM_FORMAT_RG16, gray_16 },    { LOM_FORMAT_RGB8, gray_24 },     { LOM_FORMAT_RGBA8, gray_24 },
    { LOM_FORMAT_R32F, gray_float }, { LOM_FORMAT_RG32F, gray_float },
};

static gray_function *find_gray(lom_format format)
{
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (formats[i].format == format)
            return formats[i].gray;
    return NULL;
}

static double height_at(const struct terrain *terrain, gray_function *gray, int i, int j)
{
    return gray(lom_image_pixel(terrain->map, i, j, 0)) * terrain->height + terrain->base;
}

static bool finite_number(double x)
{
    return __builtin_fabs(x) < __builtin_inf();
}

static bool check_terrain(const struct terrain *terrain, lom_error *error)
{
    const lom_image *map = terrain->map;
    if (map->width < 2 || map->height < 2 || map->depth != 1)
        return lom_fail(error, LOM_ERROR_USAGE, "A height map of %d x %d pixels: terrain needs 2 x 2.", map->width,
                        map->height);
    if ((int64_t)map->width * map->height > PIXEL_LIMIT)
        return lom_fail(error, LOM_ERROR_LIMIT, "A height map of %d x %d pixels: the limit is %d pixels.", map->width,
                        map->height, PIXEL_LIMIT);
    if (find_gray(map->format) == NULL)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "A height map is 8- or 16-bit gray, 32-bit float gray or 24-bit RGB, with or without alpha.");
    if (!(terrain->width > 0 && terrain->length > 0) || !finite_number(terrain->width) ||
        !finite_number(terrain->length) || !finite_number(terrain->height) || !finite_number(terrain->base))
        return lom_fail(error, LOM_ERROR_USAGE, "The width and length of terrain are above 0, and its height finite.");
    return true;
}

/* ---- the mesh ---- */

/* The heights of row j. False when one does not fit a float. */
static bool read_row(const struct terrain *terrain, int j, double *heights, lom_error *error)
{
    gray_function *gray = find_gray(terrain->map->format);
    for (int i = 0; i < terrain->map->width; i++) {
        heights[i] = height_at(terrain, gray, i, j);
        if (!(__builtin_fabs(heights[i]) <= 0x1.fffffep+127))
            return lom_fail(error, LOM_ERROR_INPUT, "The height at pixel (%d, %d) of the map is not finite.", i, j);
    }
    return true;
}

/* The unit normals of the two triangles of each quad between two rows of heights. With a = (0, y, 0), b = (dx, y + p,
 * 0) and c = (0, y + q, dz), cross(c - a, b - a) = dx dz (-p/dx, 1, -q/dz). */
static void row_normals(const struct terrain *terrain, const double *upper, const double *lower, lom_vec3 (*normals)[2])
{
    double across = (terrain->map->width - 1) / terrain->width, along = (terrain->map->height - 1) / terrain->length;
    for (int i = 0; i + 1 < terrain->map->width; i++) {
        double a = upper[i], b = upper[i + 1], c = lower[i], d = lower[i + 1];
        normals[i][0] = lom_vec3_normalize((lom_vec3){ (a - b) * across, 1, (a - c) * along });
        normals[i][1] = lom_vec3_normalize((lom_vec3){ (c - d) * across, 1, (b - d) * along });
    }
}

static void add(lom_vec3 *sum, const lom_vec3 *normal)
{
    sum->x += normal->x;
    sum->y += normal->y;
    sum->z += normal->z;
}

/* Adds the triangles of one row of quads that touch vertex i of its upper (side 0) or lower (side 1) row of vertices:
 * the first triangle of a quad is a, c, b and the second b, c, d. */
static void add_normals(lom_vec3 *sum, const lom_vec3 (*normals)[2], int quads, int i, int side)
{
    if (i > 0) { /* as b, or as d */
        if (side == 0)
            add(sum, &normals[i - 1][0]);
        add(sum, &normals[i - 1][1]);
    }
    if (i < quads) { /* as a, or as c */
        add(sum, &normals[i][0]);
        if (side == 1)
            add(sum, &normals[i][1]);
    }
}

static void fill_row(const struct terrain *terrain, int j, const double *heights, const lom_vec3 (*above)[2],
                     const lom_vec3 (*below)[2], lom_mesh_vertex *row)
{
    int columns = terrain->map->width - 1, rows = terrain->map->height - 1;
    for (int i = 0; i <= columns; i++) {
        double u = (double)i / columns, v = (double)j / rows;
        lom_vec3 sum = { 0, 0, 0 };
        if (j > 0)
            add_normals(&sum, above, columns, i, 1);
        if (j < rows)
            add_normals(&sum, below, columns, i, 0);
        sum = lom_vec3_normalize(sum);
        row[i] = (lom_mesh_vertex){
            .position = { (float)((u - .5) * terrain->width), (float)heights[i], (float)((v - .5) * terrain->length) },
            .normal = { (float)sum.x, (float)sum.y, (float)sum.z },
            .uv = { (float)u, (float)v },
            .color = { 1, 1, 1, 1 },
        };
    }
}

static void fill_indices(int width, int height, uint32_t *index)
{
    for (int j = 0; j + 1 < height; j++)
        for (int i = 0; i + 1 < width; i++) {
            uint32_t a = (uint32_t)j * (uint32_t)width + (uint32_t)i, b = a + 1, c = a + (uint32_t)width, d = c + 1;
            const uint32_t quad[6] = { a, c, b, b, c, d };
            memcpy(index, quad, sizeof quad);
            index += 6;
        }
}

/* Two rows of heights and two rows of face normals are enough at a time. */
static bool visit_rows(const struct terrain *terrain, lom_terrain_row *visit, void *context, lom_error *error)
{
    size_t width = (size_t)terrain->map->width;
    int rows = terrain->map->height;
    lom_mesh_vertex *row = lom_allocate(width, sizeof *row, error);
    double *heights = lom_allocate(2 * width, sizeof *heights, error);
    lom_vec3(*normals)[2] = lom_allocate(2 * width, sizeof *normals, error);
    bool good = row != NULL && heights != NULL && normals != NULL && read_row(terrain, 0, heights, error);
    for (int j = 0; good && j < rows; j++) {
        double *here = heights + (j & 1) * width, *next = heights + (~j & 1) * width;
        lom_vec3(*below)[2] = normals + (j & 1) * width, (*above)[2] = normals + (~j & 1) * width;
        good = j + 1 == rows || read_row(terrain, j + 1, next, error);
        if (good && j + 1 < rows)
            row_normals(terrain, here, next, below);
        if (good) {
            fill_row(terrain, j, here, (const lom_vec3(*)[2])above, (const lom_vec3(*)[2])below, row);
            visit(context, j, row);
        }
    }
    lom_release(row);
    lom_release(heights);
    lom_release(normals);
    return good;
}

bool lom_visit_terrain(const lom_image *map, double width, double length, double height, double base,
                       lom_terrain_row *visit, void *context, lom_error *error)
{
    struct terrain terrain = { map, width, length, height, base };
    if (!check_terrain(&terrain, error))
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool good = visit_rows(&terrain, visit, context, error);
    lom_leave_float_state(&state);
    return good;
}

bool lom_read_terrain_heights(const lom_image *map, const double size[2], double height, float *heights,
                              lom_error *error)
{
    struct terrain terrain = { map, size[0], size[1], height, 0 };
    double *row = check_terrain(&terrain, error) ? lom_allocate((size_t)map->width, sizeof *row, error) : NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool good = row != NULL;
    for (int j = 0; good && j < map->height; j++) {
        good = read_row(&terrain, j, row, error);
        for (int i = 0; good && i < map->width; i++)
            *heights++ = (float)row[i];
    }
    lom_leave_float_state(&state);
    lom_release(row);
    return good;
}

static void copy_row(void *context, int row, const lom_mesh_vertex *vertices)
{
    const struct terrain_mesh *target = context;
    memcpy(target->mesh->vertices + (size_t)row * target->width, vertices, target->width * sizeof *vertices);
}

lom_mesh *lom_make_terrain(const lom_image *map, double width, double length, double height, double base,
                           lom_error *error)
{
    struct terrain terrain = { map, width, length, height, base };
    if (!check_terrain(&terrain, error))
        return NULL;
    size_t columns = (size_t)map->width, rows = (size_t)map->height;
    lom_mesh *mesh = lom_create_mesh(columns * rows, 6 * (columns - 1) * (rows - 1), 1, 0, error);
    if (mesh == NULL)
        return NULL;
    if (!lom_visit_terrain(map, width, length, height, base, copy_row, &(struct terrain_mesh){ mesh, columns },
                           error)) {
        lom_free_mesh(mesh);
        return NULL;
    }
    fill_indices(map->width, map->height, mesh->indices);
    mesh->parts[0] = (lom_mesh_part){ 0, (uint32_t)mesh->index_count, -1 };
    return mesh;
}

/* ---- heights between the pixels ---- */

/* A position along one axis of the grid: the cell and the place in it, 0..1; outside, the border. NaN: the start. */
static int find_cell(double x, double size, int pixels, double *fraction)
{
    double t = (x / size + .5) * (pixels - 1);
    t = t > 0 ? t : 0;
    t = t < pixels - 1 ? t : pixels - 1;
    int cell = lom_int_of(t);
    cell = cell < pixels - 2 ? cell : pixels - 2;
    *fraction = t - cell;
    return cell;
}

double lom_terrain_height(const lom_image *map, double width, double length, double height, double base, double x,
                          double z)
{
    struct terrain terrain = { map, width, length, height, base };
    lom_error refused = { 0 };
    if (!check_terrain(&terrain, &refused))
        return 0;
    double s, t;
    int i = find_cell(x, width, map->width, &s), j = find_cell(z, length, map->height, &t);
    gray_function *gray = find_gray(map->format);
    double b = height_at(&terrain, gray, i + 1, j), c = height_at(&terrain, gray, i, j + 1);
    if (s + t <= 1) {
        double a = height_at(&terrain, gray, i, j);
        return a + s * (b - a) + t * (c - a);
    }
    double d = height_at(&terrain, gray, i + 1, j + 1);
    return d + (1 - s) * (c - d) + (1 - t) * (b - d);
}
