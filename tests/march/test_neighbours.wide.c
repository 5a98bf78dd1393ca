/* Proves that a ray does not see the others of its packet: what each of several gives is, bit for bit, what a packet of copies
 * of it gives, in media that are thin and full side by side, with noise that eats all of a density of 1, from near and from so
 * far away that places are rounded to cells. */
#include "check.h"

#include "base/numbers.h"
#include "media.h"

enum { SIDE = 64 };

/* Voxels that are empty, thin and full at random: of eighths of the box, or one by one and few. */
static lom_medium *spotted(uint32_t *state, bool coarse)
{
    lom_image *image = lom_create_image(SIDE, SIDE, SIDE, LOM_FORMAT_R8, NULL);
    uint8_t kind[8 * 8 * 8];
    for (size_t i = 0; i < sizeof kind; i++)
        kind[i] = (uint8_t)(uniform(state, 0, 1) < 0.4 ? 255 : uniform(state, 0, 255));
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++)
                if (coarse)
                    *(uint8_t *)lom_image_pixel(image, x, y, z) = kind[(z / 8 * 8 + y / 8) * 8 + x / 8];
                else if (uniform(state, 0, 1) < 0.1 / SIDE)
                    *(uint8_t *)lom_image_pixel(image, x, y, z) = 255;
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_free_image(image);
    return medium;
}

/* Noise of which a half is 1. */
static lom_detail *half_full(void)
{
    lom_image *image = lom_create_image(4, 4, 4, LOM_FORMAT_R8, NULL);
    for (int i = 0; i < 64; i++)
        *(uint8_t *)lom_image_pixel(image, i % 4, i / 4 % 4, i / 16) = i % 4 < 2 ? 255 : 40;
    lom_detail *detail = lom_create_detail(image, NULL);
    lom_free_image(image);
    return detail;
}

/* Rays a cell or two apart from `away` boxes before the box towards places in it. */
static lom_medium_rays rays_from(uint32_t *state, double away)
{
    lom_medium_rays rays = rays_along_x(0, 1);
    const double to_y = uniform(state, 0.1, 0.9), to_z = uniform(state, 0.1, 0.9);
    rays.start.x = lom_splat((float)-away);
    for (int i = 0; i < LOM_LANES; i++) {
        const double x = away + 0.5, y = to_y - 0.5 + uniform(state, -2, 2) / SIDE, z = to_z - 0.5;
        const double length = lom_double_sqrt(x * x + y * y + z * z);
        rays.along.x[i] = (float)(x / length);
        rays.along.y[i] = (float)(y / length);
        rays.along.z[i] = (float)(z / length);
        rays.shift[i] = (float)uniform(state, 0.01, 1);
    }
    LOM_WIDE(lom_cross_box)(&rays);
    return rays;
}

static lom_medium_rays alone(const lom_medium_rays *rays, int i)
{
    return (lom_medium_rays){
        .start = lom_splat3(rays->start.x[i], rays->start.y[i], rays->start.z[i]),
        .along = lom_splat3(rays->along.x[i], rays->along.y[i], rays->along.z[i]),
        .enter = lom_splat(rays->enter[i]),
        .leave = lom_splat(rays->leave[i]),
        .shift = lom_splat(rays->shift[i]),
        .phase = lom_splat(rays->phase[i]),
        .active = lom_splat_int(rays->active[i]),
    };
}

static bool is_same(lom_float a, lom_float b, int i)
{
    const float x = a[i], y = b[i];
    return memcmp(&x, &y, sizeof x) == 0;
}

static void check_rays(const lom_medium_rays *rays, const lom_medium_desc *desc, double away)
{
    const lom_medium_result together = march(rays, desc);
    lom_float depth, own_depth;
    LOM_WIDE(lom_medium_depth)(&depth, rays, desc, 200);
    for (int i = 0; i < LOM_LANES; i++) {
        const lom_medium_rays ray = alone(rays, i);
        const lom_medium_result own = march(&ray, desc);
        LOM_WIDE(lom_medium_depth)(&own_depth, &ray, desc, 200);
        CHECK(is_same(together.sun, own.sun, i) && is_same(together.transmittance, own.transmittance, i) &&
                  is_same(together.distance, own.distance, i),
              "from %g boxes away, step %g: %.9g and %.9g of the light, not %.9g and %.9g", away, (double)desc->step,
              (double)together.sun[i], (double)together.transmittance[i], (double)own.sun[i],
              (double)own.transmittance[i]);
        CHECK(is_same(depth, own_depth, i), "from %g boxes away: a depth of %.9g, not %.9g", away, (double)depth[i],
              (double)own_depth[i]);
    }
}

static void noise_that_eats_all(void)
{
    uint32_t state = 1;
    lom_medium *medium = spotted(&state, true);
    lom_detail *detail = half_full();
    lom_medium_desc desc = plain(medium, 3, 0.05);
    desc.detail = detail;
    desc.detail_strength = 1;
    desc.detail_near = 10;
    desc.detail_far = 20;
    for (int k = 0; k < 3; k++)
        desc.detail_scale[k] = 3;
    for (int i = 0; i < 200; i++) {
        const lom_medium_rays rays = random_rays(&state, i % 2 == 0 ? 0.1 : 1);
        desc.filtering = i % 3 == 0 ? LOM_FILTERING_FIXED : LOM_FILTERING_FLOAT;
        check_rays(&rays, &desc, 0);
    }
    lom_free_detail(detail);
    lom_free_medium(medium);
}

static void eyes_that_are_far(void)
{
    uint32_t state = 2;
    lom_medium *medium = spotted(&state, false);
    static const double far[] = { 1, 100, 5000, 30000, 70000, 200000, 1e7 };
    for (size_t k = 0; k < sizeof far / sizeof far[0]; k++)
        for (int i = 0; i < 300; i++) {
            const lom_medium_rays rays = rays_from(&state, far[k]);
            const lom_medium_desc desc = plain(medium, 50, uniform(&state, 0.3, 2.5) / SIDE);
            check_rays(&rays, &desc, far[k]);
        }
    lom_free_medium(medium);
}

int main(int argc, char **argv)
{
    RUN(noise_that_eats_all);
    RUN(eyes_that_are_far);
    return check_result();
}
