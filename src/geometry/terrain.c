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

/* The triangles of each quad between two rows of heights: 0 is a, c, b and 1 is b, c, d. Their slopes, then their unit
 * normals, a row a component; and what the rows of vertices above and below them need. */
struct faces {
    double *of[2][3];
    bool is_steep; /* so that squares of slopes overflow */
};

/* Two rows of heights and two of faces are enough at a time, and what rows of vertices have in common. */
struct rows {
    double *memory, *heights[2], *across, *normal[3];
    struct faces faces[2];
    lom_mesh_vertex *vertices;
};

static bool make_rows(struct rows *rows, int width, lom_error *error)
{
    const size_t pitch = (size_t)width;
    rows->vertices = lom_allocate(pitch, sizeof *rows->vertices, error);
    double *next = rows->memory = lom_allocate(18 * pitch, sizeof *next, error);
    if (rows->vertices == NULL || next == NULL)
        return false;
    for (int i = 0; i < 2; i++, next += pitch)
        rows->heights[i] = next;
    for (int i = 0; i < 12; i++, next += pitch)
        rows->faces[i / 6].of[i / 3 % 2][i % 3] = next;
    for (int i = 0; i < 3; i++, next += pitch)
        rows->normal[i] = next;
    rows->across = next;
    for (int i = 0; i < width; i++)
        rows->across[i] = (double)i / (width - 1);
    return true;
}

static void free_rows(struct rows *rows)
{
    lom_release(rows->vertices);
    lom_release(rows->memory);
}

/* Unit vectors, where no square overflows or vanishes. */
static void normalize_all(double *restrict x, double *restrict y, double *restrict z, int count)
{
    for (int i = 0; i < count; i++) {
        const double length = __builtin_sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        x[i] /= length;
        y[i] /= length;
        z[i] /= length;
    }
}

static void normalize_steep(double *x, double *y, double *z, int count)
{
    for (int i = 0; i < count; i++) {
        const lom_vec3 unit = lom_vec3_normalize((lom_vec3){ x[i], y[i], z[i] });
        x[i] = unit.x;
        y[i] = unit.y;
        z[i] = unit.z;
    }
}

/* With a = (0, y, 0), b = (dx, y + p, 0) and c = (0, y + q, dz), cross(c - a, b - a) = dx dz (-p/dx, 1, -q/dz). */
static void find_faces(const struct terrain *terrain, const double *restrict upper, const double *restrict lower,
                       struct faces *faces)
{
    const int quads = terrain->map->width - 1;
    const double across = quads / terrain->width, along = (terrain->map->height - 1) / terrain->length;
    const double steep = 0x1p400;
    double *restrict x0 = faces->of[0][0], *restrict y0 = faces->of[0][1], *restrict z0 = faces->of[0][2];
    double *restrict x1 = faces->of[1][0], *restrict y1 = faces->of[1][1], *restrict z1 = faces->of[1][2];
    for (int i = 0; i < quads; i++) {
        const double a = upper[i], b = upper[i + 1], c = lower[i], d = lower[i + 1];
        x0[i] = (a - b) * across;
        z0[i] = (a - c) * along;
        x1[i] = (c - d) * across;
        z1[i] = (b - d) * along;
        y0[i] = y1[i] = 1;
    }
    faces->is_steep = false;
    for (int i = 0; i < quads; i++)
        faces->is_steep |= !(__builtin_fabs(x0[i]) < steep && __builtin_fabs(z0[i]) < steep &&
                             __builtin_fabs(x1[i]) < steep && __builtin_fabs(z1[i]) < steep);
    for (int side = 0; side < 2; side++)
        (faces->is_steep ? normalize_steep : normalize_all)(faces->of[side][0], faces->of[side][1], faces->of[side][2],
                                                            quads);
}

/* Adds of one row of quads the triangles that touch each vertex of its lower row, or of its upper: of the quad before a
 * vertex, then of the one behind it. */
static void add_above(double *restrict sum, const double *restrict first, const double *restrict second, int quads)
{
    sum[0] = sum[0] + first[0] + second[0];
    for (int i = 1; i < quads; i++)
        sum[i] = sum[i] + second[i - 1] + first[i] + second[i];
    sum[quads] += second[quads - 1];
}

static void add_below(double *restrict sum, const double *restrict first, const double *restrict second, int quads)
{
    sum[0] += first[0];
    for (int i = 1; i < quads; i++)
        sum[i] = sum[i] + first[i - 1] + second[i - 1] + first[i];
    sum[quads] = sum[quads] + first[quads - 1] + second[quads - 1];
}

/* The normals of a row of vertices; NULL: there are no quads above, or below. */
static void find_normals(struct rows *rows, const struct faces *above, const struct faces *below, int quads)
{
    for (int k = 0; k < 3; k++) {
        memset(rows->normal[k], 0, ((size_t)quads + 1) * sizeof(double));
        if (above != NULL)
            add_above(rows->normal[k], above->of[0][k], above->of[1][k], quads);
        if (below != NULL)
            add_below(rows->normal[k], below->of[0][k], below->of[1][k], quads);
    }
    const bool is_steep = (above != NULL && above->is_steep) || (below != NULL && below->is_steep);
    (is_steep ? normalize_steep : normalize_all)(rows->normal[0], rows->normal[1], rows->normal[2], quads + 1);
}

static void fill_row(const struct terrain *terrain, int j, const double *heights, const struct rows *rows)
{
    const int columns = terrain->map->width - 1;
    const double v = (double)j / (terrain->map->height - 1);
    for (int i = 0; i <= columns; i++) {
        const double u = rows->across[i];
        rows->vertices[i] = (lom_mesh_vertex){
            .position = { (float)((u - .5) * terrain->width), (float)heights[i], (float)((v - .5) * terrain->length) },
            .normal = { (float)rows->normal[0][i], (float)rows->normal[1][i], (float)rows->normal[2][i] },
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

static bool visit_rows(const struct terrain *terrain, struct rows *rows, int first, int end, lom_terrain_row *visit,
                       void *context, lom_error *error)
{
    const int count = terrain->map->height, from = first > 0 ? first - 1 : 0;
    bool good = read_row(terrain, from, rows->heights[from & 1], error);
    for (int j = from; good && j < end; j++) {
        double *here = rows->heights[j & 1], *next = rows->heights[~j & 1];
        struct faces *below = &rows->faces[j & 1], *above = &rows->faces[~j & 1];
        good = j + 1 == count || read_row(terrain, j + 1, next, error);
        if (good && j + 1 < count)
            find_faces(terrain, here, next, below);
        if (!good || j < first)
            continue;
        find_normals(rows, j > 0 ? above : NULL, j + 1 < count ? below : NULL, terrain->map->width - 1);
        fill_row(terrain, j, here, rows);
        visit(context, j, rows->vertices);
    }
    return good;
}

bool lom_visit_terrain_rows(const lom_image *map, const double size[2], double height, double base, int first, int end,
                            lom_terrain_row *visit, void *context, lom_error *error)
{
    struct terrain terrain = { map, size[0], size[1], height, base };
    struct rows rows = { .memory = NULL };
    if (!check_terrain(&terrain, error))
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool good = make_rows(&rows, map->width, error) && visit_rows(&terrain, &rows, first, end, visit, context, error);
    free_rows(&rows);
    lom_leave_float_state(&state);
    return good;
}

bool lom_visit_terrain(const lom_image *map, double width, double length, double height, double base,
                       lom_terrain_row *visit, void *context, lom_error *error)
{
    return lom_visit_terrain_rows(map, (double[]){ width, length }, height, base, 0, map->height, visit, context,
                                  error);
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
