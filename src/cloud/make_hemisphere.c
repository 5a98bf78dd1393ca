/* The reference work's clouds (docs/clouds.md, Making): a ball of radius 1/2.5 about the middle, its radius shortened
 * by noise, cut at y = 0.4 with noise; the altocumulus is that times Perlin noise. In: a seed. Out: densities.
 * Invariant: the longest side of a volume that is no cube is 1, and the ball stays round in its middle. */
#include "cloud/cloud_kinds.h"

#include "geometry/noise.h"

/* Five octaves, their absolute value; the lattice's cell is a quarter of the longest side (ours: none was published).
 */
static double perlin(const lom_noise *noise, const double p[3])
{
    static const double cells = 4;
    double sum = 0, frequency = cells, amplitude = 1;
    for (int i = 0; i < 5; i++) {
        sum += amplitude * lom_noise3(noise, p[0] * frequency, p[1] * frequency, p[2] * frequency, 256);
        frequency *= 2;
        amplitude /= 2;
    }
    return sum < 0 ? -sum : sum;
}

bool lom_make_hemisphere(lom_image *volume, int variety, uint64_t seed, lom_error *error)
{
    (void)error;
    const int size[3] = { volume->width, volume->height, volume->depth };
    int longest = size[0] > size[1] ? size[0] : size[1];
    longest = size[2] > longest ? size[2] : longest;
    lom_noise noise;
    lom_seed_noise(&noise, seed);
    uint64_t voxel = 0;
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++, voxel++) {
                const int at[3] = { x, y, z };
                double p[3], square = 0;
                for (int i = 0; i < 3; i++) {
                    p[i] = (at[i] + 0.5) / longest;
                    double from_middle = p[i] - 0.5 * size[i] / longest;
                    square += from_middle * from_middle;
                }
                double rim = 1 / (2.5 * 2.5) - lom_random_uniform(seed, 2 * voxel) * 0.1;
                double base = (0.5 * size[1] / longest - 0.1) - lom_random_uniform(seed, 2 * voxel + 1) * 0.04;
                if (square < rim && p[1] > base)
                    lom_store_density(volume, x, y, z, variety == 0 ? 1 : perlin(&noise, p));
            }
    return true;
}
