/* Proves, by name (docs/numerics.md, V), what marching makes of extremes: steps that end in the rounding of places,
 * media that hold nothing or everything, boxes and rays of any scale, light that is neither lost nor made. */
#include "check.h"
#include "media.h"

/* As many steps as there may be: each rounds the transmittance once, by half an ulp of 1 at most. */
static void v1_least_steps_add_up(void)
{
    enum { STEPS = 65536 };
    lom_medium *medium = medium_along_x(8, one), *curved = medium_along_x(256, exponential);
    lom_medium_rays rays = rays_along_x(0, 1);
    for (int i = 0; i < 4; i++) {
        double depth = 0.1 * lom_double_exp(2 * i);
        lom_medium_desc desc = plain(medium, depth, 1e-30);
        lom_medium_result seen = march(&rays, &desc);
        double want = lom_double_exp(-depth);
        CHECK(magnitude((double)seen.transmittance[0] - want) <= (STEPS / 2 + 8) * 0x1p-24, "depth %g: %.9g for %.9g",
              depth, seen.transmittance[0], want);
        CHECK(magnitude((double)seen.sun[0] - (1 - want)) <= (STEPS / 2 + 8) * 0x1p-24, "depth %g: %.9g", depth,
              seen.sun[0]);
    }
    /* the midpoint rule with 10^6 steps: a sum of n floats is off by at most n / 2 ulp of it */
    lom_medium_desc desc = plain(curved, 1, 1);
    lom_float depth;
    rays = rays_along_x(0.125, 0.875);
    LOM_WIDE(lom_medium_depth)(&depth, &rays, &desc, 1000000);
    double want = (lom_double_exp(-3 * 0.125) - lom_double_exp(-3 * 0.875)) / 3;
    CHECK(magnitude((double)depth[0] / want - 1) < 1e6 * 0x1p-25, "%.9g for %.9g", depth[0], want);
    lom_free_medium(medium);
    lom_free_medium(curved);
}

/* 2^24 m away places are 2 m apart: steps of 1 m that end where they began are over nonetheless, and count nothing. */
static void v1_steps_lost_in_rounding_do_not_stall(void)
{
    lom_medium *medium = medium_along_x(8, one);
    lom_medium_desc desc = plain(medium, 0.05, 1);
    lom_medium_rays rays = rays_along_x(0x1p24, 0x1p24 + 64);
    rays.start.x = lom_splat(-0x1p24f / 64);
    rays.along.x = lom_splat(1.0f / 64);
    for (int shift = 1; shift <= 3; shift++) {
        lom_march_count count = { 0 };
        lom_medium_result seen;
        rays.shift = lom_splat((float)shift / 3);
        LOM_WIDE(lom_march_medium)(&seen, &rays, &desc, &count);
        CHECK(count.walked <= 66 && magnitude((double)seen.transmittance[0] - lom_double_exp(-3.2)) < 1e-5,
              "%llu steps, %.9g", (unsigned long long)count.walked, seen.transmittance[0]);
    }
    lom_free_medium(medium);
}

/* No extinction: nothing is taken and nothing sent, exactly, as where there is no density. */
static void v4_no_extinction_is_clear(void)
{
    uint32_t state = 3;
    lom_image *image = blobs(&state, 24);
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_medium_desc desc = plain(medium, 0, 0.01);
    for (int i = 0; i < 20; i++) {
        lom_medium_rays rays = random_rays(&state, 0.1);
        lom_medium_result seen = march(&rays, &desc);
        for (int k = 0; k < LOM_LANES; k++)
            CHECK(seen.transmittance[k] == 1 && seen.sun[k] == 0 && seen.sky[k] == 0 && seen.ground[k] == 0 &&
                      seen.distance[k] == 0,
                  "%g %g", seen.transmittance[k], seen.sun[k]);
    }
    lom_free_medium(medium);
    lom_free_image(image);
}

/* The colour of an empty volume is exactly 0 and so is its opacity: over any background the picture keeps its bits. */
static void v5_empty_volume(void)
{
    lom_image *image = lom_create_image(9, 5, 7, LOM_FORMAT_RGBA8, NULL);
    for (int i = 0; i < 9 * 5 * 7; i++)
        memset(image->pixels + 4 * i, 255, 3);
    lom_volume *volume = lom_create_volume(image, NULL);
    lom_march_desc desc = { .volume = volume, .steps = 300, .absorption = 1, .shade = 0.5f, .opaque = 2 };
    lom_march_rays rays = { lom_splat3(-0.1f, 0.3f, 0.2f), lom_splat3(0.004f, 0.001f, 0.002f), ALL };
    for (int walk = 0; walk < 2; walk++) {
        static const lom_float4 nothing_at_all;
        lom_float4 seen;
        desc.walk = walk;
        LOM_WIDE(lom_march_volume)(&seen, &rays, &desc, NULL);
        CHECK(memcmp(&seen, &nothing_at_all, sizeof seen) == 0, "%g %g", seen.x[0], seen.w[0]);
    }
    lom_free_volume(volume);
    lom_free_image(image);
}

/* Through a box whose units are `scale` times as long, with as much less in them: the same depth. */
static void check_scale(double scale)
{
    lom_medium *medium = medium_along_x(8, one);
    lom_medium_desc desc = plain(medium, 2 / scale, scale / 32);
    lom_medium_rays rays = { .start = lom_splat3(-1, 0.5f, 0.5f), .along = lom_splat3((float)(1 / scale), 0, 0) };
    rays.active = ALL;
    rays.shift = rays.phase = lom_splat(1.0f);
    LOM_WIDE(lom_cross_box)(&rays);
    lom_medium_result seen = march(&rays, &desc);
    CHECK(lom_any(rays.active) && magnitude((double)rays.enter[0] / scale - 1) < 1e-6 &&
              magnitude((double)rays.leave[0] / scale - 2) < 2e-6,
          "scale %g: %g to %g", scale, rays.enter[0], rays.leave[0]);
    CHECK(magnitude((double)seen.transmittance[0] - lom_double_exp(-2)) < 4e-6, "scale %g: %.9g", scale,
          seen.transmittance[0]);
    lom_free_medium(medium);
}

/* Directions of any length; a component that is denormal is one that is 0, also on the face itself, where 0 times its
 * inverse would be NaN; no direction is no ray. */
static void v8_directions_of_any_length(void)
{
    static const double scales[] = { 1e-30, 1e-3, 1, 1e3, 1e30 };
    for (int i = 0; i < 5; i++)
        check_scale(scales[i]);
    static const float tiny[] = { 0, -0.0f, 1e-40f, -1e-40f, 1e-45f };
    for (int i = 0; i < 5; i++)
        for (int face = 0; face < 2; face++) {
            lom_medium_rays rays = { .start = lom_splat3((float)face, 0.5f, -1),
                                     .along = lom_splat3(tiny[i], 0, 1),
                                     .active = ALL };
            LOM_WIDE(lom_cross_box)(&rays);
            CHECK(lom_any(rays.active) == !face, "%g on face %d", tiny[i], face);
            CHECK(face || (rays.enter[0] == 1 && rays.leave[0] == 2), "%g: %g to %g", tiny[i], rays.enter[0],
                  rays.leave[0]);
            rays = (lom_medium_rays){ .start = lom_splat3(0.5f, 0.5f, 0.5f),
                                      .along = lom_splat3(tiny[i], tiny[4 - i], tiny[i]),
                                      .active = ALL };
            LOM_WIDE(lom_cross_box)(&rays);
            CHECK(!lom_any(rays.active), "a ray that goes nowhere");
        }
}

/* Boxes of 1e-30 m and of 1e30 m; one 10^7 of its sides away, where floats are 1 apart; one that the ray grazes. */
static void v9_boxes_of_any_scale(void)
{
    check_scale(1e-30);
    check_scale(1e30);
    lom_medium *medium = medium_along_x(8, one);
    lom_medium_desc desc = plain(medium, 2, 0.01);
    lom_medium_rays rays = { .start = lom_splat3(-1e7f, 0.5f, 0.5f), .along = lom_splat3(1, 0, 0) };
    rays.active = ALL;
    rays.shift = rays.phase = lom_splat(1.0f);
    LOM_WIDE(lom_cross_box)(&rays);
    lom_medium_result seen = march(&rays, &desc);
    CHECK(rays.enter[0] == 1e7f && rays.leave[0] == 1e7f + 1, "%.9g to %.9g", rays.enter[0], rays.leave[0]);
    CHECK(magnitude((double)seen.transmittance[0] - lom_double_exp(-2)) < 1e-6, "%.9g", seen.transmittance[0]);
    rays = (lom_medium_rays){ .start = lom_splat3(-1, 0, 0.5f), .along = lom_splat3(1, 1, 0), .active = ALL };
    LOM_WIDE(lom_cross_box)(&rays); /* through an edge alone */
    CHECK(!lom_any(rays.active), "%g to %g", rays.enter[0], rays.leave[0]);
    lom_free_medium(medium);
}

/* Whatever the extinction, the step and the light: opacity within [0, 1], and no more light than where all is bright.
 */
static void v11_opacity_and_colour_are_bounded(void)
{
    static const double extinctions[] = { 1e-30, 1e-3, 1, 50, 1e6, 1e30, 3e38 };
    uint32_t state = 21;
    lom_image *image = blobs(&state, 32);
    float same[256];
    for (int i = 0; i < 256; i++)
        same[i] = (float)i / 255;
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_light_grid *grid = lom_create_light_grid(image, 0.5, same, NULL);
    lom_light_desc sun = { .size = { 1, 1, 1 }, .extinction = 20, .to_light = { 0.6f, 0.8f, 0 } };
    lom_sweep_sun(grid, &sun, NULL);
    lom_sweep_sky(grid, sun.size, 20);
    for (int i = 0; i < 140; i++) {
        lom_medium_rays rays = random_rays(&state, 0.2);
        lom_medium_desc desc = plain(medium, extinctions[i % 7], uniform(&state, 1e-3, 0.3));
        desc.light = i % 2 != 0 ? grid : NULL;
        lom_medium_result seen = march(&rays, &desc);
        for (int k = 0; k < LOM_LANES; k++) {
            CHECK(seen.transmittance[k] >= 0 && seen.transmittance[k] <= 1, "%g", seen.transmittance[k]);
            CHECK(seen.sun[k] >= 0 && seen.sky[k] >= 0 && seen.ground[k] >= 0, "%g", seen.sun[k]);
            float most = 1 - seen.transmittance[k] + 1e-5f;
            CHECK(seen.sun[k] <= most && seen.sky[k] <= most && seen.ground[k] <= most, "%g %g above %g", seen.sun[k],
                  seen.sky[k], most);
        }
    }
    lom_free_light_grid(grid);
    lom_free_medium(medium);
    lom_free_image(image);
}

/* Under a sky and over a ground of radiance 1, what a medium takes it sends: it is not there to be seen, whatever its grid
 * of light says of the two. */
static void v12_furnace(void)
{
    uint32_t state = 5;
    lom_image *image = blobs(&state, 40);
    float same[256];
    for (int i = 0; i < 256; i++)
        same[i] = (float)i / 255;
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_light_grid *grid = lom_create_light_grid(image, 1, same, NULL);
    const float size[3] = { 1, 1, 1 };
    lom_sweep_sky(grid, size, 30);
    double moved = 0;
    for (int i = 0; i < 60; i++) {
        lom_medium_rays rays = random_rays(&state, 0.2);
        lom_medium_desc desc = plain(medium, 30, 0.01);
        lom_medium_result all = march(&rays, &desc), once;
        desc.light = grid;
        once = march(&rays, &desc);
        for (int k = 0; k < LOM_LANES; k++) {
            double whole = (double)all.sky[k] + (double)all.ground[k] + (double)all.transmittance[k];
            double part = (double)once.sky[k] + (double)once.ground[k] + (double)once.transmittance[k];
            CHECK(magnitude(whole - 1) < 300 * 0x1p-24, "%.9g", whole);
            CHECK(magnitude(part - 1) < 300 * 0x1p-24, "%.9g with a grid", part);
            double apart = (double)once.sky[k] - (double)all.sky[k];
            moved = magnitude(apart) > moved ? magnitude(apart) : moved;
        }
    }
    CHECK(moved > 0.05, "the grid tells the sky from the ground: %g", moved);
    lom_free_light_grid(grid);
    lom_free_medium(medium);
    lom_free_image(image);
}

/* A layer 100 times as wide as thick, depth tau, sun and view at cosines mu0 and mu on the same side: of the beam,
 * light scattered once is p mu0 / (mu + mu0) (1 - exp(-tau (1/mu + 1/mu0))) (S. Chandrasekhar, Radiative Transfer,
 * 1960); here the phase p is 1. */
static void v13_a_slab_scatters_once_by_its_closed_form(void)
{
    enum { ACROSS = 33, TALL = 256 };
    static const double cosines[][2] = { { 1, 1 }, { 0.8, 0.6 }, { 0.6, 0.9 } }; /* mu, mu0 */
    lom_image *image = lom_create_image(ACROSS, TALL, ACROSS, LOM_FORMAT_R8, NULL);
    memset(image->pixels, 255, lom_image_size(image));
    float same[256];
    for (int i = 0; i < 256; i++)
        same[i] = (float)i / 255;
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_light_grid *grid = lom_create_light_grid(image, 1, same, NULL);
    for (int i = 0; i < 9; i++) {
        double tau = i / 3 == 0 ? 0.1 : i / 3 == 1 ? 1 : 6, mu = cosines[i % 3][0], mu0 = cosines[i % 3][1];
        lom_light_desc sun = { .size = { 100, 1, 100 },
                               .extinction = (float)tau,
                               .to_light = { (float)lom_double_sqrt(1 - mu0 * mu0), (float)mu0, 0 } };
        lom_sweep_sun(grid, &sun, NULL);
        lom_medium_desc desc = plain(medium, tau, 1e-3);
        desc.light = grid;
        lom_medium_rays rays = rays_along_x(0, 1 / mu);
        rays.start = lom_splat3(0.5f, 1, 0.5f);
        rays.along = lom_splat3((float)(lom_double_sqrt(1 - mu * mu) / 100), (float)-mu, 0);
        lom_medium_result seen = march(&rays, &desc);
        double want = -lom_double_expm1(-tau * (1 / mu + 1 / mu0)) * mu0 / (mu + mu0);
        CHECK(magnitude((double)seen.sun[0] / want - 1) < 1e-3, "depth %g, cosines %g %g: %.6g for %.6g", tau, mu, mu0,
              seen.sun[0], want);
    }
    lom_free_light_grid(grid);
    lom_free_medium(medium);
    lom_free_image(image);
}

int main(int argc, char **argv)
{
    RUN(v1_least_steps_add_up);
    RUN(v1_steps_lost_in_rounding_do_not_stall);
    RUN(v4_no_extinction_is_clear);
    RUN(v5_empty_volume);
    RUN(v8_directions_of_any_length);
    RUN(v9_boxes_of_any_scale);
    RUN(v11_opacity_and_colour_are_bounded);
    RUN(v12_furnace);
    RUN(v13_a_slab_scatters_once_by_its_closed_form);
    return check_result();
}
