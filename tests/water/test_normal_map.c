/* The made normal map holds unit normals that point up on the whole, has the slope it was asked for, and repeats; the
 * flow map is the formula of its definition for every byte. */
#include "check.h"

#include <lom/water.h>

static void normals_are_unit_and_up(void)
{
    lom_image *m = lom_make_normal_map(&(lom_normal_map_desc){ .size = 256, .seed = 3, .roughness = 0.3 }, NULL);
    CHECK(m != NULL, "no map");
    double mean[3] = { 0 }, slope = 0;
    for (int i = 0; m != NULL && i < 256 * 256; i++) {
        double n[3], square = 0;
        for (int k = 0; k < 3; k++) {
            n[k] = m->pixels[3 * i + k] / 255.0 * 2 - 1;
            mean[k] += n[k] / (256 * 256);
            square += n[k] * n[k];
        }
        CHECK(square > 0.97 && square < 1.03 && n[2] > 0, "normal %d is %g long", i, square);
        slope += (n[0] * n[0] + n[1] * n[1]) / (n[2] * n[2]) / (256 * 256);
    }
    CHECK(mean[0] * mean[0] < 1e-4 && mean[1] * mean[1] < 1e-4, "the water leans: %g %g", mean[0], mean[1]);
    CHECK(slope > 0.08 && slope < 0.10, "mean squared slope %g instead of 0.09", slope);
    lom_free_image(m);
}

/* Slopes of a periodic surface sum to 0 along every line around the torus; rounding allows half a step a pixel. */
static void surface_repeats(void)
{
    lom_image *m = lom_make_normal_map(&(lom_normal_map_desc){ .size = 256, .seed = 4, .roughness = 0.2 }, NULL);
    for (int y = 0; m != NULL && y < 256; y++) {
        double across = 0, down = 0;
        for (int x = 0; x < 256; x++) {
            const uint8_t *p = lom_image_pixel(m, x, y, 0), *q = lom_image_pixel(m, y, x, 0);
            across += (p[0] / 127.5 - 1) / (p[2] / 127.5 - 1);
            down += (q[1] / 127.5 - 1) / (q[2] / 127.5 - 1);
        }
        CHECK(across * across < 1 && down * down < 1, "line %d rises by %g and %g", y, across, down);
    }
    lom_free_image(m);
}

static void flow_map_is_its_formula(void)
{
    lom_image *all = lom_create_image(256, 1, 1, LOM_FORMAT_RGB8, NULL);
    CHECK(all != NULL, "no image");
    if (all == NULL)
        return;
    for (int i = 0; i < 3 * 256; i++)
        all->pixels[i] = (uint8_t)(i % 3 == 0 ? i / 3 : i % 3 == 1 ? 255 - i / 3 : i / 6);
    lom_image *flow = lom_make_flow_map(all, NULL);
    for (int i = 0; flow != NULL && i < 3 * 256; i++) {
        double t = ((1 - all->pixels[i] / 255.0) - 0.2) / 0.6;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        double value = 255 * t * t * (3 - 2 * t);
        CHECK(flow->pixels[i] - value <= 0.5 + 1e-9 && value - flow->pixels[i] <= 0.5 + 1e-9, "%d gives %d, not %g",
              all->pixels[i], flow->pixels[i], value);
    }
    lom_free_image(flow);
    lom_free_image(all);
}

int main(int argc, char **argv)
{
    RUN(normals_are_unit_and_up);
    RUN(surface_repeats);
    RUN(flow_map_is_its_formula);
    return check_result();
}
