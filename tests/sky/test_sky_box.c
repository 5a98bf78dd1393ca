/* The six faces of a made sky meet: pixels on both sides of each of the twelve edges differ no more than neighbours
 * inside a face do and the sun stands where it was asked to stand. */
#include "check.h"

#include <lom/sky.h>

enum { SIZE = 128 };

static const lom_sky_box_desc desc = {
    .size = SIZE, .sun_azimuth = 1.1, .sun_elevation = 0.5, .haziness = 0.8, .cloudiness = 0.7, .seed = 2
};

/* The face and the pixel that direction d looks at, by OpenGL's table (major axis, sc, tc). */
static const uint8_t *look(lom_image *faces[6], const double d[3])
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (d[i] * d[i] > d[axis] * d[axis])
            axis = i;
    int face = axis * 2 + (d[axis] < 0);
    double m = d[axis] < 0 ? -d[axis] : d[axis];
    const double s[6] = { -d[2], d[2], d[0], d[0], d[0], -d[0] }, t[6] = { -d[1], -d[1], d[2], -d[2], -d[1], -d[1] };
    int x = (int)((s[face] / m + 1) * 0.5 * SIZE), y = (int)((t[face] / m + 1) * 0.5 * SIZE);
    return lom_image_pixel(faces[face], x < SIZE ? x : SIZE - 1, y < SIZE ? y : SIZE - 1, 0);
}

static double difference(const uint8_t *a, const uint8_t *b)
{
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += a[k] < b[k] ? b[k] - a[k] : a[k] - b[k];
    return sum / 3;
}

static void faces_meet(void)
{
    lom_image *faces[6];
    lom_error error = { 0 };
    CHECK(lom_make_sky_box(&desc, faces, &error), "%s", error.text);
    for (int edge = 0; edge < 12; edge++) { /* the edge where axes a and b are +-1 */
        int a = edge / 4, b = (a + 1) % 3, c = (a + 2) % 3;
        double across = 0, inside = 0;
        for (int i = 0; i < SIZE; i++) {
            double d[3], in[3], out[3];
            d[c] = (2 * i + 1.0) / SIZE - 1;
            d[a] = edge & 1 ? 1 : -1;
            d[b] = edge & 2 ? 1 : -1;
            memcpy(in, d, sizeof d);
            memcpy(out, d, sizeof d);
            in[a] *= 1 - 1.0 / SIZE;
            out[b] *= 1 - 1.0 / SIZE;
            const uint8_t *p = look(faces, in), *q = look(faces, out);
            across += difference(p, q) / SIZE;
            in[a] *= 1 - 2.0 / SIZE;
            inside += difference(p, look(faces, in)) / SIZE;
        }
        CHECK(across < 1.5 * inside + 1.0, "edge %d: %g across, %g inside", edge, across, inside);
    }
    for (int i = 0; i < 6; i++)
        lom_free_image(faces[i]);
}

static void sun_stands_in_its_place(void)
{
    lom_image *faces[6];
    lom_error error = { 0 };
    CHECK(lom_make_sky_box(&desc, faces, &error), "%s", error.text);
    double c = lom_double_cos(desc.sun_elevation);
    double sun[3] = { lom_double_sin(desc.sun_azimuth) * c, lom_double_sin(desc.sun_elevation),
                      -lom_double_cos(desc.sun_azimuth) * c };
    const uint8_t *there = look(faces, sun);
    CHECK(there[0] > 240 && there[1] > 235 && there[2] > 220, "%d %d %d", there[0], there[1], there[2]);
    double away[3] = { -sun[0], sun[1] + 0.6, -sun[2] };
    const uint8_t *blue = look(faces, away);
    CHECK(blue[2] >= blue[0], "the sky away from the sun is %d %d %d", blue[0], blue[1], blue[2]);
    for (int i = 0; i < 6; i++)
        lom_free_image(faces[i]);
}

static void the_cube_has_the_six_faces(void)
{
    lom_image *faces[6];
    lom_error error = { 0 };
    lom_image *cube = lom_make_sky_cube(&desc, &error);
    CHECK(lom_make_sky_box(&desc, faces, &error) && cube != NULL, "%s", error.text);
    CHECK(cube->slices == LOM_SLICES_CUBE && cube->width == SIZE && cube->height == SIZE && cube->depth == 6,
          "%d x %d x %d", cube->width, cube->height, cube->depth);
    for (int i = 0; i < 6; i++) {
        CHECK(memcmp(lom_image_pixel(cube, 0, 0, i), faces[i]->pixels, lom_image_size(faces[i])) == 0, "face %d", i);
        lom_free_image(faces[i]);
    }
    lom_free_image(cube);
}

static void wrong_sizes_are_refused(void)
{
    lom_error refused = { 0 };
    CHECK(lom_make_sky_cube(&(lom_sky_box_desc){ .size = 7 }, &refused) == NULL && refused.code == LOM_ERROR_USAGE);
    lom_image *faces[6];
    lom_error error = { 0 };
    CHECK(!lom_make_sky_box(&(lom_sky_box_desc){ .size = -1 }, faces, &error), "made");
    CHECK(error.code == LOM_ERROR_USAGE && faces[0] == NULL && faces[5] == NULL, "%s", error.text);
}

int main(int argc, char **argv)
{
    RUN(faces_meet);
    RUN(sun_stands_in_its_place);
    RUN(the_cube_has_the_six_faces);
    RUN(wrong_sizes_are_refused);
    return check_result();
}
