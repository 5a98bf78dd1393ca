/* Clouds of particles (docs/clouds.md, Making): each has a centre, a radius and a density, and adds it with a
 * falloff: Gaussian (puffs, Harris 2003, 3.1), or Wyvill, McPheeters and Wyvill 1986's polynomial, which is 0 from
 * the radius on with a slope of 0. In: a seed. Out: densities. Invariant: particles lie so that their radius stays
 * inside the volume. */
#include "base/numbers.h"
#include "cloud/cloud_kinds.h"

enum { PARTICLES = 48 };

struct particle {
    double center[3], radius, density; /* in units of the longest side */
};

/* A heap: wide below, narrow above; the radius shrinks towards the rim and the top. */
static struct particle particle_of(uint64_t seed, uint64_t i, const double extent[3])
{
    double u[6];
    for (int k = 0; k < 6; k++)
        u[k] = lom_random_uniform(seed, 6 * i + (uint64_t)k);
    double angle = u[0] * lom_two_pi, along = lom_double_sqrt(u[1]), height = u[2] * u[2];
    double shortest = extent[0] < extent[1] ? extent[0] : extent[1];
    shortest = extent[2] < shortest ? extent[2] : shortest;
    double reach = 1 - 0.65 * height;
    struct particle p = { .radius =
                              shortest * (0.14 + 0.16 * u[3]) * (1.15 - 0.6 * along * along) * (1.1 - 0.4 * height),
                          .density = 0.5 + 0.5 * u[4] };
    p.center[0] = extent[0] / 2 + (extent[0] / 2 - p.radius) * reach * along * lom_double_cos(angle);
    p.center[2] = extent[2] / 2 + (extent[2] / 2 - p.radius) * reach * along * lom_double_sin(angle);
    p.center[1] = p.radius + (extent[1] - 2 * p.radius) * height * (1 - 0.5 * along);
    return p;
}

/* exp(-4.5 r^2): a standard deviation of a third of the radius, cut at the radius where 1 % is left. */
static double gaussian(double square)
{
    return square < 1 ? lom_double_exp(-4.5 * square) : 0;
}

/* C(r) = -4/9 r^6 + 17/9 r^4 - 22/9 r^2 + 1 */
static double wyvill(double square)
{
    return square < 1 ? ((-4 * square + 17) * square - 22) * square / 9 + 1 : 0;
}

static int voxel_of(double at, int longest, int size)
{
    double voxel = lom_double_floor(at * longest);
    return voxel > 0 ? voxel < size - 1 ? lom_int_of(voxel) : size - 1 : 0;
}

static void add_particle(double *sum, const lom_image *volume, int longest, const struct particle *p, int variety)
{
    const int size[3] = { volume->width, volume->height, volume->depth };
    int low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = voxel_of(p->center[i] - p->radius, longest, size[i]);
        high[i] = voxel_of(p->center[i] + p->radius, longest, size[i]);
    }
    for (int z = low[2]; z <= high[2]; z++)
        for (int y = low[1]; y <= high[1]; y++)
            for (int x = low[0]; x <= high[0]; x++) {
                double dx = (x + 0.5) / longest - p->center[0], dy = (y + 0.5) / longest - p->center[1];
                double dz = (z + 0.5) / longest - p->center[2];
                double square = (dx * dx + dy * dy + dz * dz) / (p->radius * p->radius);
                size_t at = ((size_t)z * (size_t)size[1] + (size_t)y) * (size_t)size[0] + (size_t)x;
                sum[at] += p->density * (variety == 0 ? gaussian(square) : wyvill(square));
            }
}

bool lom_make_particles(lom_image *volume, int variety, uint64_t seed, lom_error *error)
{
    const int size[3] = { volume->width, volume->height, volume->depth };
    int longest = size[0] > size[1] ? size[0] : size[1];
    longest = size[2] > longest ? size[2] : longest;
    const double extent[3] = { (double)size[0] / longest, (double)size[1] / longest, (double)size[2] / longest };
    double *sum = lom_allocate(lom_image_size(volume) / sizeof(uint16_t), sizeof *sum, error);
    if (sum == NULL)
        return false;
    for (uint64_t i = 0; i < PARTICLES; i++) {
        struct particle p = particle_of(seed, i, extent);
        add_particle(sum, volume, longest, &p, variety);
    }
    size_t at = 0;
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++)
                lom_store_density(volume, x, y, z, sum[at++]);
    lom_release(sum);
    return true;
}
