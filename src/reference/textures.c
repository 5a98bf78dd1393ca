/* Textures in double. In: pictures. Out: filtered colours in linear light. Bilinear at the finest level alone: areas
 * are averaged by the samples of a pixel. */
#include "reference/textures.h"

#include <string.h>

/* IEC 61966-2-1 */
static double decode_srgb(double x)
{
    return x <= 0.04045 ? x / 12.92 : lom_double_pow((x + 0.055) / 1.055, 2.4);
}

void lom_set_picture(struct lom_picture *picture, const lom_image *image, bool srgb)
{
    picture->image = image;
    for (int code = 0; code < 256; code++)
        picture->decoded[code] = srgb ? decode_srgb(code / 255.0) : code / 255.0;
}

static lom_vec3 texel(const struct lom_picture *picture, int x, int y, int z)
{
    const void *pixel = lom_image_pixel(picture->image, x, y, z);
    if (picture->image->format == LOM_FORMAT_RGBA16) {
        uint16_t code[3];
        memcpy(code, pixel, sizeof code);
        return (lom_vec3){ code[0] / 65535.0, code[1] / 65535.0, code[2] / 65535.0 };
    }
    const uint8_t *code = pixel;
    return (lom_vec3){ picture->decoded[code[0]], picture->decoded[code[1]], picture->decoded[code[2]] };
}

static double alpha_of(const struct lom_picture *picture, int x, int y)
{
    const void *pixel = lom_image_pixel(picture->image, x, y, 0);
    uint16_t code[4];
    if (picture->image->format != LOM_FORMAT_RGBA16)
        return ((const uint8_t *)pixel)[3] / 255.0;
    memcpy(code, pixel, sizeof code);
    return code[3] / 65535.0;
}

double lom_mean_brightness(const struct lom_picture *picture)
{
    double sum = 0;
    for (int y = 0; y < picture->image->height; y++)
        for (int x = 0; x < picture->image->width; x++) {
            lom_vec3 color = texel(picture, x, y, 0);
            sum += 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
        }
    return sum / ((double)picture->image->width * picture->image->height);
}

static lom_vec3 bilinear(const lom_vec3 corner[4], double u, double v)
{
    lom_vec3 upper = along(corner[0], difference(corner[1], corner[0]), u);
    lom_vec3 lower = along(corner[2], difference(corner[3], corner[2]), u);
    return along(upper, difference(lower, upper), v);
}

/* The texel below position s of a repeated axis, and the place between it and the next. */
static int find_texel(double s, int size, double *fraction)
{
    double place = s - lom_double_floor(s);
    place = (place < 1 ? place : 0) * size - 0.5;
    double whole = lom_double_floor(place);
    *fraction = place - whole;
    return whole < 0 ? size - 1 : lom_int_of(whole);
}

/* The four texels around a place, and where it lies between them. */
struct around {
    int x[2], y[2];
    double u, v;
};

static struct around find_around(const struct lom_picture *picture, double s, double t)
{
    struct around a;
    int width = picture->image->width, height = picture->image->height;
    a.x[0] = find_texel(s, width, &a.u);
    a.y[0] = find_texel(t, height, &a.v);
    a.x[1] = a.x[0] + 1 < width ? a.x[0] + 1 : 0;
    a.y[1] = a.y[0] + 1 < height ? a.y[0] + 1 : 0;
    return a;
}

lom_vec3 lom_sample_picture(const struct lom_picture *picture, double s, double t)
{
    const struct around a = find_around(picture, s, t);
    const lom_vec3 corner[4] = { texel(picture, a.x[0], a.y[0], 0), texel(picture, a.x[1], a.y[0], 0),
                                 texel(picture, a.x[0], a.y[1], 0), texel(picture, a.x[1], a.y[1], 0) };
    return bilinear(corner, a.u, a.v);
}

double lom_sample_picture_alpha(const struct lom_picture *picture, double s, double t)
{
    const struct around a = find_around(picture, s, t);
    double upper = (1 - a.u) * alpha_of(picture, a.x[0], a.y[0]) + a.u * alpha_of(picture, a.x[1], a.y[0]);
    double lower = (1 - a.u) * alpha_of(picture, a.x[0], a.y[1]) + a.u * alpha_of(picture, a.x[1], a.y[1]);
    return (1 - a.v) * upper + a.v * lower;
}

/* ---- cubes ---- */

/* Where a direction meets the cube: its face and s, t in -1..1 on it. */
static int find_face(lom_vec3 d, double *s, double *t)
{
    double x = __builtin_fabs(d.x), y = __builtin_fabs(d.y), z = __builtin_fabs(d.z);
    if (x >= y && x >= z) {
        *s = (d.x < 0 ? d.z : -d.z) / x;
        *t = -d.y / x;
        return d.x < 0;
    }
    if (y >= z) {
        *s = d.x / y;
        *t = (d.y < 0 ? -d.z : d.z) / y;
        return 2 + (d.y < 0);
    }
    *s = (d.z < 0 ? -d.x : d.x) / z;
    *t = -d.y / z;
    return 4 + (d.z < 0);
}

/* The direction of (s, t) of a face: the inverse. */
static lom_vec3 direction_of(int face, double s, double t)
{
    switch (face) {
    case 0:
        return (lom_vec3){ 1, -t, -s };
    case 1:
        return (lom_vec3){ -1, -t, s };
    case 2:
        return (lom_vec3){ s, 1, t };
    case 3:
        return (lom_vec3){ s, -1, -t };
    case 4:
        return (lom_vec3){ s, -t, 1 };
    default:
        return (lom_vec3){ -s, -t, -1 };
    }
}

static int nearest_texel(double s, int size)
{
    int i = lom_int_of(lom_double_floor((s + 1) / 2 * size));
    return i < 0 ? 0 : i < size ? i : size - 1;
}

/* The texel (x, y) of a face, one of which may be one step outside: then the one across that edge, found by looking a
 * little beyond it (less than a texel's width sideways at any size, since the step is far below a texel). */
static lom_vec3 texel_over_edge(const struct lom_picture *cube, int face, int x, int y)
{
    int size = cube->image->width;
    bool out_s = x < 0 || x >= size, out_t = y < 0 || y >= size;
    if (!out_s && !out_t)
        return texel(cube, x, y, face);
    double beyond = 1 + 1e-7, s = (2 * x + 1.0) / size - 1, t = (2 * y + 1.0) / size - 1;
    s = out_s ? (x < 0 ? -beyond : beyond) : s;
    t = out_t ? (y < 0 ? -beyond : beyond) : t;
    int other = find_face(direction_of(face, s, t), &s, &t);
    return texel(cube, nearest_texel(s, size), nearest_texel(t, size), other);
}

static lom_vec3 texel_around(const struct lom_picture *cube, int face, int x, int y)
{
    int size = cube->image->width;
    if ((x >= 0 && x < size) || (y >= 0 && y < size))
        return texel_over_edge(cube, face, x, y);
    int inner_x = x < 0 ? 0 : size - 1, inner_y = y < 0 ? 0 : size - 1;
    lom_vec3 total = sum(texel_over_edge(cube, face, inner_x, inner_y),
                         sum(texel_over_edge(cube, face, x, inner_y), texel_over_edge(cube, face, inner_x, y)));
    return scaled(total, 1 / 3.0);
}

lom_vec3 lom_sample_cube_picture(const struct lom_picture *cube, lom_vec3 direction)
{
    double s, t;
    int face = find_face(direction, &s, &t), size = cube->image->width;
    double u = (s + 1) / 2 * size - 0.5, v = (t + 1) / 2 * size - 0.5;
    double left = lom_double_floor(u), upper = lom_double_floor(v);
    int x = lom_int_of(left), y = lom_int_of(upper);
    const lom_vec3 corner[4] = { texel_around(cube, face, x, y), texel_around(cube, face, x + 1, y),
                                 texel_around(cube, face, x, y + 1), texel_around(cube, face, x + 1, y + 1) };
    return bilinear(corner, u - left, v - upper);
}
