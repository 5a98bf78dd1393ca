/* Proves the reference's textures: texels at their centres, means between them, wraps, sRGB and 16 bits by closed
 * forms; a cube without seams: what it shows is that of a field of directions, it turns with its axes, an edge is the
 * mean of two faces and a corner of three. */
#include "check.h"

#include "reference/textures.h"

#include <math.h>

static const uint8_t codes[2][3][3] = { { { 0, 10, 20 }, { 100, 120, 255 }, { 7, 7, 7 } },
                                        { { 255, 0, 1 }, { 60, 61, 62 }, { 200, 150, 100 } } };

static double decode(int code)
{
    double x = code / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

static bool near(lom_vec3 got, double x, double y, double z, double tolerance)
{
    return fabs(got.x - x) <= tolerance && fabs(got.y - y) <= tolerance && fabs(got.z - z) <= tolerance;
}

/* The picture of these codes; *image is what it is of. */
static struct lom_picture small_picture(bool srgb, lom_image **image)
{
    struct lom_picture picture;
    lom_image *rgb = lom_create_image(3, 2, 1, LOM_FORMAT_RGB8, NULL);
    memcpy(rgb->pixels, codes, sizeof codes);
    *image = lom_convert_image(rgb, LOM_FORMAT_RGBA8, NULL);
    lom_free_image(rgb);
    lom_set_picture(&picture, *image, srgb);
    return picture;
}

static void texels_at_their_centres(void)
{
    for (int srgb = 0; srgb < 2; srgb++) {
        lom_image *image;
        struct lom_picture picture = small_picture(srgb, &image);
        double brightness = 0;
        for (int y = 0; y < 2; y++)
            for (int x = 0; x < 3; x++) {
                const uint8_t *c = codes[y][x];
                double color[3];
                for (int i = 0; i < 3; i++)
                    color[i] = srgb ? decode(c[i]) : c[i] / 255.0;
                for (int turn = -2; turn <= 2; turn++) {
                    lom_vec3 got = lom_sample_picture(&picture, (x + 0.5) / 3 + turn, (y + 0.5) / 2 - turn);
                    CHECK(near(got, color[0], color[1], color[2], 1e-12), "%d,%d srgb %d turn %d: %g %g %g", x, y, srgb,
                          turn, got.x, got.y, got.z);
                }
                brightness += (0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]) / 6;
            }
        CHECK(fabs(lom_mean_brightness(&picture) - brightness) < 1e-12, "%g %g", lom_mean_brightness(&picture),
              brightness);
        lom_free_image(image);
    }
}

/* Red of the first row is 0, 100, 7; between columns, across the seam, and at the corner of four texels. */
static void means_between_texels(void)
{
    lom_image *image;
    struct lom_picture picture = small_picture(false, &image);
    CHECK(fabs(lom_sample_picture(&picture, 1.0 / 3, 0.25).x - 50 / 255.0) < 1e-12, "first and second");
    CHECK(fabs(lom_sample_picture(&picture, 0.5 / 3 + 0.75 / 3, 0.25).x - 75 / 255.0) < 1e-12, "three quarters");
    CHECK(fabs(lom_sample_picture(&picture, 0, 0.25).x - 3.5 / 255) < 1e-12, "last and first, over the seam");
    CHECK(fabs(lom_sample_picture(&picture, 2.0 / 3, 0.5).x - (100 + 7 + 60 + 200) / 4.0 / 255) < 1e-12, "four");
    CHECK(fabs(lom_sample_picture(&picture, 2.0 / 3, 0).x - (100 + 7 + 60 + 200) / 4.0 / 255) < 1e-12,
          "bottom and top");
    lom_free_image(image);
}

static void sixteen_bits(void)
{
    lom_image *image = lom_create_image(1, 1, 1, LOM_FORMAT_RGBA16, NULL);
    const uint16_t code[4] = { 1, 40000, 65535, 65535 };
    memcpy(image->pixels, code, sizeof code);
    struct lom_picture picture;
    lom_set_picture(&picture, image, false);
    CHECK(near(lom_sample_picture(&picture, 0.3, 0.9), 1 / 65535.0, 40000 / 65535.0, 1, 1e-15),
          "its numbers, by 65535");
    lom_free_image(image);
}

/* ---- cubes ---- */

enum { SIDE = 24 };

/* OpenGL's table: the direction of (s, t) in -1..1 of each face, s to the right, t down. */
static lom_vec3 direction_of(int face, double s, double t)
{
    const lom_vec3 table[6] = {
        { 1, -t, -s }, { -1, -t, s }, { s, 1, t }, { s, -1, -t }, { s, -t, 1 }, { -s, -t, -1 }
    };
    return table[face];
}

typedef void face_texel(uint8_t *to, int face, int x, int y);

/* A smooth field of directions, in steps. */
static void smooth_texel(uint8_t *to, int face, int x, int y)
{
    lom_vec3 d = direction_of(face, (2 * x + 1.0) / SIDE - 1, (2 * y + 1.0) / SIDE - 1);
    double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    to[0] = (uint8_t)lrint(127.5 + 127 * d.x / length);
    to[1] = (uint8_t)lrint(127.5 + 127 * d.y / length);
    to[2] = (uint8_t)lrint(127.5 + 127 * d.z / length);
}

static void plain_texel(uint8_t *to, int face, int x, int y)
{
    (void)x;
    (void)y;
    to[0] = (uint8_t)(40 * face);
    to[1] = (uint8_t)(face * face);
    to[2] = (uint8_t)(255 - face);
}

/* A cube of six formulas; *faces is what it is of. */
static struct lom_picture make_cube(face_texel *texel, lom_image **faces)
{
    struct lom_picture cube;
    *faces = lom_create_image(SIDE, SIDE, 6, LOM_FORMAT_RGBA8, NULL);
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                texel(lom_image_pixel(*faces, x, y, face), face, x, y);
    lom_set_picture(&cube, *faces, false);
    return cube;
}

static void cube_shows_a_field(void)
{
    lom_image *faces;
    struct lom_picture cube = make_cube(smooth_texel, &faces);
    double worst = 0;
    for (uint64_t i = 0; i < 20000; i++) {
        double normal[4];
        lom_random_normal(1, 2 * i, normal);
        lom_random_normal(1, 2 * i + 1, normal + 2);
        double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        lom_vec3 got = lom_sample_cube_picture(&cube, (lom_vec3){ normal[0], normal[1], normal[2] });
        for (int c = 0; c < 3; c++) {
            double value = c == 0 ? got.x : c == 1 ? got.y : got.z;
            worst = fmax(worst, fabs(255 * value - 127.5 - 127 * normal[c] / length));
        }
    }
    /* half a step of rounding, and what bilinear filtering of a texel of 1/12 makes of the field's curvature */
    CHECK(worst < 1.5, "%g steps of 255", worst);
    lom_free_image(faces);
}

static void edges_and_corners(void)
{
    lom_image *faces;
    struct lom_picture cube = make_cube(plain_texel, &faces);
    for (int i = 0; i < 27; i++) {
        int d[3] = { i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1 }, count = 0;
        double sum[3] = { 0 };
        for (int axis = 0; axis < 3; axis++) {
            if (d[axis] == 0)
                continue;
            uint8_t texel[3];
            plain_texel(texel, 2 * axis + (d[axis] < 0), 0, 0);
            for (int c = 0; c < 3; c++)
                sum[c] += texel[c] / 255.0;
            count++;
        }
        if (count == 0)
            continue;
        lom_vec3 got = lom_sample_cube_picture(&cube, (lom_vec3){ 3.0 * d[0], 3.0 * d[1], 3.0 * d[2] });
        CHECK(near(got, sum[0] / count, sum[1] / count, sum[2] / count, 1e-9), "%d %d %d: %g %g %g", d[0], d[1], d[2],
              got.x, got.y, got.z);
    }
    lom_free_image(faces);
}

int main(int argc, char **argv)
{
    RUN(texels_at_their_centres);
    RUN(means_between_texels);
    RUN(sixteen_bits);
    RUN(cube_shows_a_field);
    RUN(edges_and_corners);
    return check_result();
}
