/* A flat cloud: four textures in one picture. In: a size and a seed. Out: gray and opacity. Invariant: the border is
 * clear. */
#include <lom/cloud.h>

#include "base/own_float_state.h"
#include "geometry/noise.h"

/* Perlin noise of 32, 64, 128 and 256 cells a side, each of half the weight, in [-1, 1]. */
static double four_octaves(const lom_noise *noise, double x, double y)
{
    double sum = 0, weight = 8;
    for (int cells = 32; cells <= 256; cells *= 2, weight /= 2)
        sum += weight / 15 * lom_noise2(noise, x * cells / 8, y * cells / 8, 256);
    return sum;
}

lom_image *lom_make_cloud_picture(int size, uint64_t seed, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (size < 8 || size > 1024) {
        lom_fail(error, LOM_ERROR_USAGE, "A flat cloud has 8 to 1024 pixels a side, not %d.", size);
        return NULL;
    }
    lom_image *picture = lom_create_image(size, size, 1, LOM_FORMAT_RGBA8, error);
    lom_noise noise, detail;
    lom_seed_noise(&noise, seed);
    lom_seed_noise(&detail, seed + 1);
    for (int y = 0; picture != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double s = (x + 0.5) / size, t = (y + 0.5) / size, u = 2 * s - 1, v = 2 * t - 1;
            v = v > 0.45 ? 0.45 + (v - 0.45) * 2.1 : v * 1.1; /* the base is flatter than the top */
            double shape = 1 - lom_double_sqrt(u * u + v * v) + 0.75 * four_octaves(&noise, s, t);
            double eaten = 0.22 * (0.5 + 0.5 * four_octaves(&detail, 3 * s, 3 * t));
            double opacity = lom_smooth_step(0.08, 0.5, shape - eaten) * lom_smooth_step(1, 0.85, u * u + v * v);
            double gray =
                lom_clamp_double(0.98 - 0.42 * lom_smooth_step(0.3, 0.85, t) + 0.12 * four_octaves(&noise, t, s), 0, 1);
            uint8_t *to = lom_image_pixel(picture, x, y, 0);
            to[0] = to[1] = to[2] = lom_unorm8_of_double(gray);
            to[3] = lom_unorm8_of_double(opacity);
        }
    return picture;
}

lom_image *lom_make_cloud_noise(int size, uint64_t seed, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (size < 8 || size > 1024) {
        lom_fail(error, LOM_ERROR_USAGE, "Noise of clouds has 8 to 1024 pixels a side, not %d.", size);
        return NULL;
    }
    lom_image *picture = lom_create_image(size, size, 1, LOM_FORMAT_R8, error);
    lom_noise noise;
    lom_seed_noise(&noise, seed);
    for (int y = 0; picture != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double sum = 0, weight = 8;
            for (int cells = 4; cells <= 32; cells *= 2, weight /= 2)
                sum += weight / 15 * lom_noise2(&noise, (x + 0.5) / size * cells, (y + 0.5) / size * cells, cells);
            picture->pixels[(size_t)y * (size_t)size + (size_t)x] =
                lom_unorm8_of_double(lom_clamp_double((1 + 3 * sum) / 2.5, 0, 1));
        }
    return picture;
}

lom_image *lom_make_cloud_puff(int size, uint64_t seed, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (size < 8 || size > 1024) {
        lom_fail(error, LOM_ERROR_USAGE, "A puff of cloud has 8 to 1024 pixels a side, not %d.", size);
        return NULL;
    }
    lom_image *picture = lom_create_image(size, size, 1, LOM_FORMAT_RGBA8, error);
    lom_noise noise;
    lom_seed_noise(&noise, seed);
    for (int y = 0; picture != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double s = (x + 0.5) / size, t = (y + 0.5) / size, u = 2 * s - 1, v = 2 * t - 1;
            double within = lom_clamp_double(1 - u * u - v * v, 0, 1);
            double grain = lom_clamp_double(1 + 0.9 * four_octaves(&noise, s, t), 0, 2);
            uint8_t *to = lom_image_pixel(picture, x, y, 0);
            to[0] = to[1] = to[2] = 255;
            to[3] = lom_unorm8_of_double(lom_clamp_double(within * within * grain, 0, 1));
        }
    return picture;
}
