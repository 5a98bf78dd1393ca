/* Volumes that a formula is, for transfer functions. In: nothing. Out: densities. Invariant: no noise; a seed changes
 * nothing. */
#include "base/numbers.h"
#include "cloud/cloud_kinds.h"

/* 1 - r, of the distance r from the middle in parts of half a side. */
static double ball(const double p[3])
{
    return lom_larger(1 - lom_double_sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), 0);
}

/* S. Marschner, R. Lobb, An evaluation of reconstruction filters for volume rendering (1994), 3, with its constants: of
 * the radius across the y axis a cosine whose frequency falls from the middle, plus a slow sine of the height. */
static double ripples(const double p[3])
{
    static const double frequency = 6, share = 0.25;
    double radius = lom_double_sqrt(p[0] * p[0] + p[2] * p[2]);
    double rings = lom_double_cos(lom_two_pi * frequency * lom_double_cos(lom_two_pi / 4 * radius));
    return (1 - lom_double_sin(lom_two_pi / 4 * p[1]) + share * (1 + rings)) / (2 * (1 + share));
}

bool lom_make_formula(lom_image *volume, int variety, uint64_t seed, lom_error *error)
{
    (void)seed;
    (void)error;
    double (*const formula)(const double p[3]) = variety == 0 ? ball : ripples;
    for (int z = 0; z < volume->depth; z++)
        for (int y = 0; y < volume->height; y++)
            for (int x = 0; x < volume->width; x++) {
                const double p[3] = { (2 * x + 1.0) / volume->width - 1, (2 * y + 1.0) / volume->height - 1,
                                      (2 * z + 1.0) / volume->depth - 1 };
                lom_store_density(volume, x, y, z, formula(p));
            }
    return true;
}
