/* What the tests of media share: media along x by formula, rays along x, a plain march. */
#ifndef LOM_TESTS_MARCH_MEDIA_H
#define LOM_TESTS_MARCH_MEDIA_H

#include <lom/transfer.h>

#define ALL lom_splat_int(-1)

static inline double uniform(uint32_t *state, double low, double high)
{
    return low + (high - low) * lom_random_uniform(77, (*state)++);
}

/* A medium of n voxels along x whose density is given. */
static inline lom_medium *medium_along_x(int n, double (*density)(double x))
{
    lom_image *image = lom_create_image(n, 1, 1, LOM_FORMAT_R32F, NULL);
    for (int i = 0; i < n; i++)
        ((float *)image->pixels)[i] = (float)density((i + 0.5) / n);
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_free_image(image);
    return medium;
}

static inline double one(double x)
{
    (void)x;
    return 1;
}

static inline double nothing(double x)
{
    (void)x;
    return 0;
}

static inline double ramp(double x)
{
    return x;
}

static inline double exponential(double x)
{
    return lom_double_exp(-3 * x);
}

static inline lom_medium_rays rays_along_x(double enter, double leave)
{
    lom_medium_rays rays = { .start = lom_splat3(0, 0.5f, 0.5f),
                             .along = lom_splat3(1, 0, 0),
                             .enter = lom_splat((float)enter),
                             .leave = lom_splat((float)leave),
                             .shift = lom_splat(1.0f),
                             .active = ALL };
    rays.phase = lom_splat(1.0f);
    return rays;
}

static inline lom_medium_desc plain(const lom_medium *medium, double extinction, double step)
{
    return (lom_medium_desc){ .medium = medium,
                              .extinction = (float)extinction,
                              .step = (float)step,
                              .most_steps = 65536,
                              .octaves = 1,
                              .weight = { 1 } };
}

static inline lom_medium_result march(const lom_medium_rays *rays, const lom_medium_desc *desc)
{
    lom_medium_result result;
    LOM_WIDE(lom_march_medium)(&result, rays, desc, NULL);
    return result;
}

static inline double magnitude(double x)
{
    return x < 0 ? -x : x;
}

static inline lom_image *blobs(uint32_t *state, int size)
{
    lom_image *image = lom_create_image(size, size, size, LOM_FORMAT_R16, NULL);
    for (int b = 0; b < 3; b++) {
        int c[3], r = 2 + (int)uniform(state, 0, size / 6.0);
        for (int k = 0; k < 3; k++)
            c[k] = (int)uniform(state, 0, size);
        for (int z = 0; z < size; z++)
            for (int y = 0; y < size; y++)
                for (int x = 0; x < size; x++)
                    if ((x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]) + (z - c[2]) * (z - c[2]) < r * r)
                        *(uint16_t *)lom_image_pixel(image, x, y, z) = (uint16_t)uniform(state, 0, 65536);
    }
    return image;
}

/* A ray a lane, near each other or not, from anywhere, around the box. */
static inline lom_medium_rays random_rays(uint32_t *state, double width)
{
    lom_medium_rays rays = rays_along_x(0, 1);
    float at[3][LOM_LANES], along[3][LOM_LANES], shift[LOM_LANES];
    for (int k = 0; k < 3; k++) {
        double from = uniform(state, -0.5, 1.5), way = uniform(state, -1, 1);
        for (int i = 0; i < LOM_LANES; i++) {
            at[k][i] = (float)(from + width * uniform(state, -1, 1));
            along[k][i] = (float)(way + width * uniform(state, -1, 1));
            shift[i] = (float)uniform(state, 0.01, 1);
        }
    }
    rays.start = (lom_float3){ lom_load(at[0]), lom_load(at[1]), lom_load(at[2]) };
    rays.along = (lom_float3){ lom_load(along[0]), lom_load(along[1]), lom_load(along[2]) };
    rays.shift = lom_load(shift);
    LOM_WIDE(lom_cross_box)(&rays);
    return rays;
}

#endif
