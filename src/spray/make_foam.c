/* The pattern of foam. In: a seed; out: a gray picture that repeats without a seam: films of bubbles, drawn out into
 * webs, whose values are spread evenly over 0..255, so that a threshold of c leaves a share 1 - c of it. */
#include "spray/make_foam.h"
#include "geometry/noise.h"

#include <string.h>

/* Walls between cells of two sizes, bent by noise. */
static double web(const lom_noise *noise, double x, double y)
{
    lom_octaves few = { .count = 3, .period = 4, .gain = 0.5 };
    double bend = 0.06 * lom_fractal2(noise, x * 4, y * 4, few), sway = 0.06 * lom_fractal2(noise, y * 4, x * 4, few);
    double value = 0, cells = 5, share = 0.42;
    for (int i = 0; i < 3; i++, cells *= 2.6, share *= 0.75) {
        int count = lom_int_of(cells + 0.5);
        lom_cell c = lom_cellular2(noise, (x + bend) * count + 64, (y + sway) * count + 64, count, count);
        value += share * (1 - lom_smooth_step(0, 0.5, c.second - c.nearest));
    }
    return value + 0.35 * lom_fractal2(noise, x * 4, y * 4, few);
}

/* Replaces each value by the share of values below it. */
static void spread_evenly(const float *value, uint8_t *out, size_t count)
{
    enum { BINS = 4096 };
    size_t below[BINS + 1] = { 0 };
    for (size_t i = 0; i < count; i++)
        below[1 + lom_int_of(lom_clamp_double(value[i] * 0.4 + 0.3, 0, 0.9999) * BINS)]++;
    for (int b = 0; b < BINS; b++)
        below[b + 1] += below[b];
    for (size_t i = 0; i < count; i++) {
        size_t bin = lom_count_of(lom_clamp_double(value[i] * 0.4 + 0.3, 0, 0.9999) * BINS, BINS - 1);
        out[i] = (uint8_t)((below[bin] + below[bin + 1]) * 255 / (2 * count));
    }
}

lom_image *lom_make_foam(int size, uint64_t seed, lom_error *error)
{
    lom_noise noise;
    size_t count = (size_t)size * (size_t)size;
    lom_image *image = lom_create_image(size, size, 1, LOM_FORMAT_R8, error);
    float *value = lom_allocate(count, sizeof *value, error);
    if (image != NULL && value != NULL) {
        lom_seed_noise(&noise, seed);
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++)
                value[y * size + x] = (float)web(&noise, (double)x / size, (double)y / size);
        spread_evenly(value, image->pixels, count);
    } else {
        lom_free_image(image);
        image = NULL;
    }
    lom_release(value);
    return image;
}
