/* Proves, against closed forms and by name (docs/numerics.md, V): marching a medium is exact where it is uniform,
 * converges at the designed order elsewhere, keeps its bounds, starts anywhere, and skips empty space without changing
 * a byte. */
#include "check.h"
#include "media.h"

/* V13, V3: alpha of a slab is 1 - exp(-t) for thin, thick and opaque ones, whatever the step and its shift. */
static void v2_v3_v13_slab_is_exact(void)
{
    static const double depths[] = { 1e-8, 1e-6, 1e-3, 0.1, 1, 7, 40, 1e6 };
    lom_medium *medium = medium_along_x(8, one);
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++)
        for (int steps = 1; steps <= 1000; steps = steps * 5 + 2)
            for (int shift = 1; shift <= 4; shift++) {
                lom_medium_desc desc = plain(medium, depths[i], 1.0 / steps);
                lom_medium_rays rays = rays_along_x(0, 1);
                rays.shift = lom_splat((float)shift / 4);
                lom_medium_result seen = march(&rays, &desc);
                double want = -lom_double_expm1(-depths[i]), got = 1 - (double)seen.transmittance[0];
                double bound = (8 + 0.5 * steps) * 0x1p-24;
                CHECK(magnitude(got - want) <= bound, "depth %g, %d steps: %.9g for %.9g", depths[i], steps, got, want);
                /* V2: by what is summed a thin slab keeps its relative precision */
                CHECK(magnitude((double)seen.sun[0] / want - 1) < (8 + steps) * 0x1p-23, "depth %g: %.9g", depths[i],
                      seen.sun[0]);
            }
    lom_free_medium(medium);
}

/* V14: one segment against two halves. */
static void v14_split_changes_nothing(void)
{
    lom_medium *medium = medium_along_x(8, one);
    for (int i = 0; i < 40; i++) {
        double cut = 0.025 * i, depth = 0.2 * i;
        lom_medium_desc desc = plain(medium, depth, 1);
        lom_medium_rays whole = rays_along_x(0, 1), first = rays_along_x(0, cut), second = rays_along_x(cut, 1);
        double a = (double)march(&whole, &desc).transmittance[0];
        double b = (double)march(&first, &desc).transmittance[0] * (double)march(&second, &desc).transmittance[0];
        CHECK(magnitude(a - b) <= 4 * 0x1p-24, "cut %g: %.9g %.9g", cut, a, b);
    }
    lom_free_medium(medium);
}

/* Octave k alone, of a sun that is exp(-T / 64) everywhere, is lit by exp(-T / 4^k), of all eight; the phase weighs the
 * first one alone. */
static void octaves_are_powers_of_the_sun(void)
{
    lom_medium *medium = medium_along_x(4, one);
    lom_image *density = lom_create_image(2, 2, 2, LOM_FORMAT_R8, NULL);
    const float same[256] = { 0 };
    lom_light_grid *grid = lom_create_light_grid(density, 1, same, NULL);
    const int32_t word = 0x7fff0000 | 52429; /* a share of 0.8 */
    for (int i = 0; i < 27; i++)
        grid->light[i] = word;
    for (int k = 0; k < LOM_MAX_OCTAVES; k++) {
        lom_medium_desc desc = plain(medium, 1, 0.1);
        lom_medium_rays rays = rays_along_x(0, 1);
        desc.light = grid;
        desc.octaves = k + 1;
        desc.weight[0] = k == 0;
        desc.weight[k] = 1;
        rays.phase = lom_splat(3.0f);
        lom_medium_result seen = march(&rays, &desc);
        double s = 52429 / 65535.0, lit = k < 4 ? s : lom_double_pow(s, 1.0 / (1 << 2 * (k - 3)));
        for (int doubled = 2 * k; doubled < 6; doubled++)
            lit *= lit;
        double want = -lom_double_expm1(-1) * lit * (k == 0 ? 3 : 1);
        CHECK(magnitude((double)seen.sun[0] - want) < 1e-5, "octave %d: %g, not %g", k, (double)seen.sun[0], want);
    }
    lom_free_light_grid(grid);
    lom_free_image(density);
    lom_free_medium(medium);
}

/* The furnace: under a sky and over a ground of one radiance a medium that absorbs nothing sends as much as it hides, at
 * any depth; and what comes from the sky alone is linear in the optical depth between the two, where the grid tells it. */
static void surroundings_have_shares_of_one(void)
{
    lom_medium *medium = medium_along_x(4, one);
    lom_image *density = lom_create_image(2, 2, 2, LOM_FORMAT_R8, NULL);
    const float same[256] = { 0 };
    lom_light_grid *grid = lom_create_light_grid(density, 1, same, NULL);
    for (int depth = 0; depth <= 40; depth += 8) {
        const double above = 255 / (1 + 0.1125 * depth), below = 255 / (1 + 0.1125 * (40 - depth));
        const uint32_t word = (uint32_t)lom_count_of(above + 0.5, 255) << 16 | (uint32_t)lom_count_of(below + 0.5, 255)
                                                                                   << 24;
        for (int i = 0; i < 27; i++)
            memcpy(&grid->light[i], &word, sizeof word);
        for (int fixed = 0; fixed < 2; fixed++) {
            lom_medium_desc desc = plain(medium, 1, 0.1);
            lom_medium_rays rays = rays_along_x(0, 1);
            desc.light = grid;
            desc.filtering = fixed ? LOM_FILTERING_FIXED : LOM_FILTERING_FLOAT;
            lom_medium_result seen = march(&rays, &desc);
            double hidden = -lom_double_expm1(-1), sky = (1 + 0.1125 * (40 - depth)) / (2 + 0.1125 * 40);
            CHECK(magnitude((double)(seen.sky[0] + seen.ground[0]) - hidden) < 1e-5, "depth %d: %g of %g", depth,
                  (double)(seen.sky[0] + seen.ground[0]), hidden);
            CHECK(magnitude((double)seen.sky[0] - hidden * sky) < 0.004, "depth %d: %g, not %g", depth,
                  (double)seen.sky[0], hidden * sky);
        }
    }
    lom_free_light_grid(grid);
    lom_free_image(density);
    lom_free_medium(medium);
}

static void images_that_are_no_media_are_refused(void)
{
    static const struct {
        int width, height, depth;
        lom_format format;
        bool medium, detail;
    } cases[] = { { 4, 4, 4, LOM_FORMAT_R8, true, true },
                  { 4, 4, 4, LOM_FORMAT_R16, true, false },
                  { 4, 4, 4, LOM_FORMAT_RGB8, false, false },
                  { 3, 3, 3, LOM_FORMAT_R8, true, false },
                  { 4, 4, 2, LOM_FORMAT_R8, true, false },
                  { LOM_MAX_VOLUME + 1, 1, 1, LOM_FORMAT_R8, false, false },
                  { 1, 1, LOM_MAX_VOLUME + 1, LOM_FORMAT_R8, false, false } };
    const float same[256] = { 0 };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_create_image(cases[i].width, cases[i].height, cases[i].depth, cases[i].format, NULL);
        lom_medium *medium = lom_create_medium(image, &error);
        CHECK((medium != NULL) == cases[i].medium && (medium != NULL || error.text[0] != 0), "medium %zu: %s", i,
              error.text);
        error = (lom_error){ 0 };
        lom_detail *detail = lom_create_detail(image, &error);
        CHECK((detail != NULL) == cases[i].detail && (detail != NULL || error.code == LOM_ERROR_USAGE), "noise %zu: %s",
              i, error.text);
        error = (lom_error){ 0 };
        if (i < 2 || i > 4) { /* colours have no density to average */
            lom_light_grid *grid = lom_create_light_grid(image, 0.5, same, &error);
            CHECK((grid != NULL) == cases[i].medium && (grid != NULL || error.code == LOM_ERROR_USAGE), "grid %zu: %s",
                  i, error.text);
            lom_free_light_grid(grid);
        }
        lom_free_detail(detail);
        lom_free_medium(medium);
        lom_free_image(image);
    }
    CHECK(lom_create_medium(NULL, NULL) == NULL && lom_create_detail(NULL, NULL) == NULL &&
              lom_create_light_grid(NULL, 1, same, NULL) == NULL,
          "no image");
}

/* V15: forwards or backwards, the same comes through. */
static void v15_order_reversed(void)
{
    lom_medium *medium = medium_along_x(64, exponential);
    lom_medium_desc desc = plain(medium, 5, 0.01);
    lom_medium_rays there = rays_along_x(0, 1), back = there;
    back.start = lom_splat3(1, 0.5f, 0.5f);
    back.along = lom_splat3(-1, 0, 0);
    double a = (double)march(&there, &desc).transmittance[0], b = (double)march(&back, &desc).transmittance[0];
    CHECK(magnitude(a - b) < 1e-5, "%.9g %.9g", a, b);
    lom_free_medium(medium);
}

/* V13: midpoint is exact on a linear ramp, of order 2 on an exponential one; samples at the left end of each step (a
 * shift of the ray by half a step) are of order 1. The ramp is read inside the outermost voxels' centres. */
static void v13_order_of_convergence(void)
{
    enum { N = 512 };
    lom_medium *linear = medium_along_x(N, ramp), *curved = medium_along_x(N, exponential);
    lom_medium_rays rays = rays_along_x(0.125, 0.875);
    lom_medium_desc desc = plain(linear, 4, 0.75 / 16);
    double want = lom_double_exp(-4 * (0.875 * 0.875 - 0.125 * 0.125) / 2);
    CHECK(magnitude((double)march(&rays, &desc).transmittance[0] - want) < 2e-6, "linear ramp");
    double depth = 4 * (lom_double_exp(-3 * 0.125) - lom_double_exp(-3 * 0.875)) / 3, error[2][2];
    for (int left = 0; left < 2; left++)
        for (int fine = 0; fine < 2; fine++) {
            double step = 0.75 / (fine ? 12 : 6);
            rays = rays_along_x(0.125, 0.875);
            rays.start.x = lom_splat(left ? (float)(-0.5 * step) : 0.0f); /* the middle of a step reads its left end */
            desc = plain(curved, 4, step);
            error[left][fine] = magnitude(-lom_double_log((double)march(&rays, &desc).transmittance[0]) - depth);
        }
    for (int left = 0; left < 2; left++) {
        double order = lom_double_log2(error[left][0] / error[left][1]);
        CHECK(magnitude(order - (left ? 1 : 2)) < 0.1, "%s: order %.3f (%g, %g)", left ? "left" : "midpoint", order,
              error[left][0], error[left][1]);
    }
    lom_free_medium(linear);
    lom_free_medium(curved);
}

/* V5: where there is nothing the result is exactly nothing, and the colour behind keeps every bit. */
static void v5_empty_medium(void)
{
    lom_medium *medium = medium_along_x(16, nothing);
    lom_medium_desc desc = plain(medium, 50, 0.001);
    lom_medium_rays rays = rays_along_x(0, 1);
    lom_medium_result seen = march(&rays, &desc);
    CHECK(seen.transmittance[0] == 1.0f && seen.sun[0] == 0 && seen.sky[0] == 0 && seen.distance[0] == 0, "%g",
          seen.transmittance[0]);
    lom_free_medium(medium);
}

static void skipping_changes_no_byte(void)
{
    uint32_t state = 1;
    lom_march_count count = { 0 };
    for (int round = 0; round < 12; round++) {
        lom_image *image = blobs(&state, 10 + 8 * round);
        lom_medium *medium = lom_create_medium(image, NULL);
        lom_medium_desc desc = plain(medium, uniform(&state, 0, 40), uniform(&state, 0.003, 0.05));
        desc.stop = 0.01f;
        desc.filtering = round % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED;
        for (int i = 0; i < 60; i++) {
            lom_medium_rays rays = random_rays(&state, i % 3 == 0 ? 0.3 : 0.01);
            lom_medium_result walked, skipped;
            desc.walk = true;
            LOM_WIDE(lom_march_medium)(&walked, &rays, &desc, NULL);
            desc.walk = false;
            LOM_WIDE(lom_march_medium)(&skipped, &rays, &desc, &count);
            CHECK(memcmp(&walked, &skipped, sizeof walked) == 0, "round %d, rays %d", round, i);
            lom_float depth, without;
            desc.walk = true;
            LOM_WIDE(lom_medium_depth)(&depth, &rays, &desc, 40 + i);
            desc.walk = false;
            LOM_WIDE(lom_medium_depth)(&without, &rays, &desc, 40 + i);
            CHECK(memcmp(&depth, &without, sizeof depth) == 0, "depth: round %d, rays %d", round, i);
        }
        lom_free_medium(medium);
        lom_free_image(image);
    }
    CHECK(count.sampled * 2 < count.walked, "%llu of %llu", (unsigned long long)count.sampled,
          (unsigned long long)count.walked);
}

/* Thin clouds and noise that eats into them, near, far and between: what it surely eats is not sampled. */
static void what_noise_surely_eats_changes_no_byte(void)
{
    uint32_t state = 3;
    lom_image *noise = lom_create_image(16, 16, 16, LOM_FORMAT_R8, NULL);
    for (int i = 0; i < 16 * 16 * 16; i++) /* nothing in half of its cubes */
        noise->pixels[i] = ((i >> 2) + (i >> 6) + (i >> 10)) % 2 ? 0 : (uint8_t)uniform(&state, 100, 256);
    lom_detail *detail = lom_create_detail(noise, NULL);
    for (int round = 0; round < 12; round++) {
        lom_image *image = blobs(&state, 40);
        uint16_t *voxels = (uint16_t *)(void *)image->pixels;
        const double strength = round == 11 ? 1 : uniform(&state, 0.1, 0.6), eaten = strength * (double)detail->mean;
        const double most = 65535 * eaten * uniform(&state, 0.9, 1.1);
        for (int i = 0; i < 40 * 40 * 40; i++) /* nearly as much in all of a blob as is eaten, or anything */
            if (voxels[i] != 0 && round % 3 != 0)
                voxels[i] = (uint16_t)lom_count_of(most * uniform(&state, 0.97, 1), 65535);
        lom_medium *medium = lom_create_medium(image, NULL);
        lom_medium_desc desc = plain(medium, 40, uniform(&state, 0.003, 0.05));
        desc.filtering = round % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED;
        desc.detail = detail;
        desc.detail_strength = (float)strength;
        for (int k = 0; k < 3; k++)
            desc.detail_scale[k] = (float)uniform(&state, 1, 9);
        for (int i = 0; i < 60; i++) {
            lom_medium_rays rays = random_rays(&state, i % 3 == 0 ? 0.3 : 0.01);
            desc.detail_near = (float)uniform(&state, -1, 1);
            desc.detail_far = desc.detail_near + (float)uniform(&state, -0.2, 1.5);
            lom_medium_result seen[2];
            lom_float depth[2];
            for (int skip = 0; skip < 2; skip++) {
                desc.walk = !skip;
                LOM_WIDE(lom_march_medium)(&seen[skip], &rays, &desc, NULL);
                LOM_WIDE(lom_medium_depth)(&depth[skip], &rays, &desc, 40 + i);
            }
            CHECK(memcmp(&seen[0], &seen[1], sizeof seen[0]) == 0, "round %d, rays %d", round, i);
            CHECK(memcmp(&depth[0], &depth[1], sizeof depth[0]) == 0, "depth: round %d, rays %d", round, i);
        }
        lom_free_medium(medium);
        lom_free_image(image);
    }
    lom_free_detail(detail);
    lom_free_image(noise);
}

static double thin(double x)
{
    (void)x;
    return 0.06;
}

/* Noise whose mean eats all of a medium: far away, where it is its mean, no step is sampled; near by each is. */
static void what_noise_surely_eats_is_not_sampled(void)
{
    lom_medium *medium = medium_along_x(8, thin);
    lom_image *noise = lom_create_image(4, 4, 4, LOM_FORMAT_R8, NULL);
    memset(noise->pixels, 127, 64);
    lom_detail *detail = lom_create_detail(noise, NULL);
    for (int near = 0; near < 2; near++) {
        lom_medium_desc desc = plain(medium, 1, 0.01);
        lom_medium_rays rays = rays_along_x(0, 1);
        lom_march_count count = { 0 };
        lom_medium_result seen;
        desc.detail = detail;
        desc.detail_strength = 0.4f;
        desc.detail_near = near ? 2.0f : -2.0f;
        desc.detail_far = desc.detail_near + 1;
        LOM_WIDE(lom_march_medium)(&seen, &rays, &desc, &count);
        CHECK(seen.transmittance[0] == 1 && (count.sampled != 0) == near, "%d: %llu sampled", near,
              (unsigned long long)count.sampled);
    }
    lom_free_detail(detail);
    lom_free_image(noise);
    lom_free_medium(medium);
}

/* Whether a processor is said to gather faster than it loads. */
static void gathers_change_no_byte(void)
{
    uint32_t state = 5;
    float as_it_is[256];
    for (int i = 0; i < 256; i++)
        as_it_is[i] = (float)i / 255;
    for (int round = 0; round < 6; round++) {
        lom_image *image = blobs(&state, 12 + 9 * round);
        lom_medium *medium = lom_create_medium(image, NULL);
        lom_light_grid *light = lom_create_light_grid(image, 0.5, as_it_is, NULL);
        lom_medium_desc desc = plain(medium, uniform(&state, 0, 40), uniform(&state, 0.003, 0.05));
        desc.light = light;
        desc.filtering = round % 2 == 0 ? LOM_FILTERING_FLOAT : LOM_FILTERING_FIXED;
        for (int i = 0; i < 40; i++) {
            lom_medium_rays rays = random_rays(&state, i % 3 == 0 ? 0.3 : 0.01);
            lom_medium_result seen[2];
            lom_float depth[2];
            for (int k = 0; k < 2; k++) {
                medium->gathers = k == 1;
                LOM_WIDE(lom_march_medium)(&seen[k], &rays, &desc, NULL);
                LOM_WIDE(lom_medium_depth)(&depth[k], &rays, &desc, 40 + i);
            }
            CHECK(memcmp(&seen[0], &seen[1], sizeof seen[0]) == 0, "round %d, rays %d", round, i);
            CHECK(memcmp(&depth[0], &depth[1], sizeof depth[0]) == 0, "depth: round %d, rays %d", round, i);
        }
        lom_free_light_grid(light);
        lom_free_medium(medium);
        lom_free_image(image);
    }
}

/* V10: ending a ray early changes what it brings by at most `stop` times the largest radiance, which is 1 here. V11:
 * shares stay in [0, 1]. */
static void v10_early_stop_keeps_its_bound(void)
{
    static const float stops[] = { 0.1f, 0.01f, 0.001f };
    uint32_t state = 9;
    for (int round = 0; round < 10; round++) {
        lom_image *image = blobs(&state, 40);
        lom_medium *medium = lom_create_medium(image, NULL);
        lom_medium_desc desc = plain(medium, uniform(&state, 1, 60), 0.01);
        for (int i = 0; i < 60; i++) {
            lom_medium_rays rays = random_rays(&state, 0.1);
            desc.stop = 0;
            lom_medium_result full = march(&rays, &desc), cut;
            desc.stop = stops[i % 3];
            cut = march(&rays, &desc);
            for (int k = 0; k < LOM_LANES; k++) {
                CHECK(full.sun[k] - cut.sun[k] <= desc.stop && cut.sun[k] <= full.sun[k], "%g against %g", cut.sun[k],
                      full.sun[k]);
                CHECK(full.transmittance[k] >= 0 && full.transmittance[k] <= 1 && full.sun[k] <= 1.00001f, "%g %g",
                      full.transmittance[k], full.sun[k]);
            }
        }
        lom_free_medium(medium);
        lom_free_image(image);
    }
}

/* The step of lom_medium_step keeps its bound on any ray and with any shift: against a hundred times finer steps. */
static void step_keeps_its_error_bound(void)
{
    uint32_t state = 5;
    const float size[3] = { 1, 1, 1 };
    for (int round = 0; round < 8; round++) {
        lom_image *image = blobs(&state, 24);
        lom_medium *medium = lom_create_medium(image, NULL);
        double error = round % 2 ? 0.05 : 0.01, worst = 0;
        lom_medium_desc desc = plain(medium, 1e-3, lom_medium_step(medium, size, (float)error));
        for (int i = 0; i < 40; i++) {
            lom_medium_rays rays = random_rays(&state, 0.2);
            lom_float square = lom_dot3(rays.along, rays.along), unit = 1.0f / lom_sqrt(square);
            rays.along = lom_scale3(rays.along, unit);
            rays.active = ALL;
            LOM_WIDE(lom_cross_box)(&rays);
            lom_float exact;
            LOM_WIDE(lom_medium_depth)(&exact, &rays, &desc, 4000);
            lom_medium_result seen = march(&rays, &desc);
            for (int k = 0; k < LOM_LANES; k++) {
                if (!rays.active[k])
                    continue;
                /* in a thin medium what is seen of the sun is the optical depth, up to its square */
                double length = (double)(rays.leave[k] - rays.enter[k]);
                double off = magnitude((double)seen.sun[k] - (double)exact[k]) / 1e-3;
                CHECK(off <= error * length + 1e-3, "off by %g over %g", off, length);
                worst = off > worst ? off : worst;
            }
        }
        CHECK(worst > 1e-5, "nothing was compared");
        lom_free_medium(medium);
        lom_free_image(image);
    }
}

/* V6, V7, V8: a camera inside, on a face, an edge, a corner, beyond; rays parallel to faces; directions of any length.
 */
static void v6_v7_boxes_are_entered_once(void)
{
    static const struct {
        float start[3], along[3], enter, leave; /* leave 0: missed */
    } cases[] = {
        { { 0.5f, 0.5f, 0.5f }, { 1, 0, 0 }, 0, 0.5f },
        { { 0, 0.5f, 0.5f }, { 1, 0, 0 }, 0, 1 },
        { { 1, 0.5f, 0.5f }, { 1, 0, 0 }, 0, 0 },
        { { 1, 0.5f, 0.5f }, { -1, 0, 0 }, 0, 1 },
        { { 0, 0, 0 }, { 1, 1, 1 }, 0, 1 },
        { { 1, 1, 1 }, { -1, -1, -1 }, 0, 1 },
        { { 0, 0, 0.5f }, { 0, 0, 1 }, 0, 0.5f },
        { { 1, 0.5f, 0.5f }, { 0, 1, 0 }, 0, 0 },
        { { 0, 0.5f, 0.5f }, { 0, 1, 0 }, 0, 0.5f },
        { { -1, 0.5f, 0.5f }, { 1, 0, 0 }, 1, 2 },
        { { -1, 0.5f, 0.5f }, { -1, 0, 0 }, 0, 0 },
        { { -1, 2, 0.5f }, { 1, 0, 0 }, 0, 0 },
        { { 0.5f, 0.5f, -4 }, { 0, -0.0f, 2 }, 2, 2.5f },
        { { 0.5f, 0.5f, 0.5f }, { 0, 0, 1e-3f }, 0, 500 },
        { { 0.5f, 0.5f, 0.5f }, { 1e-40f, 0, 1 }, 0, 0.5f },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_medium_rays rays = { .start = lom_splat3(cases[i].start[0], cases[i].start[1], cases[i].start[2]),
                                 .along = lom_splat3(cases[i].along[0], cases[i].along[1], cases[i].along[2]),
                                 .active = ALL };
        LOM_WIDE(lom_cross_box)(&rays);
        bool hit = cases[i].leave > 0;
        CHECK(lom_any(rays.active) == hit, "case %zu", i);
        CHECK(!hit || (magnitude((double)rays.enter[0] - (double)cases[i].enter) < 1e-6 &&
                       magnitude((double)rays.leave[0] / (double)cases[i].leave - 1) < 1e-6),
              "case %zu: %g to %g", i, rays.enter[0], rays.leave[0]);
    }
}

/* V17: a ray longer than the greatest number of steps takes longer ones, to its end. V1: no stall for the shortest
 * steps. */
static void v17_step_cap_covers_the_ray(void)
{
    lom_medium *medium = medium_along_x(8, one);
    lom_medium_desc desc = plain(medium, 2, 1e-9);
    desc.most_steps = 100;
    lom_medium_rays rays = rays_along_x(0, 1);
    lom_march_count count = { 0 };
    lom_medium_result seen;
    LOM_WIDE(lom_march_medium)(&seen, &rays, &desc, &count);
    CHECK(count.sampled <= 101 && magnitude((double)seen.transmittance[0] - lom_double_exp(-2)) < 1e-5, "%llu %g",
          (unsigned long long)count.sampled, seen.transmittance[0]);
    lom_free_medium(medium);
}

/* V19: full density is full from 8 bits, 16 bits and floats; negative floats and those above 1 are clamped. */
static void v19_full_voxels(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8, LOM_FORMAT_R16, LOM_FORMAT_R32F };
    for (int f = 0; f < 3; f++)
        for (int negative = 0; negative < 2; negative++) {
            lom_image *image = lom_create_image(3, 3, 3, formats[f], NULL);
            for (int i = 0; i < 27; i++) {
                if (f == 2)
                    ((float *)image->pixels)[i] = negative ? -3.0f : 7.0f;
                else
                    memset(image->pixels + (f + 1) * i, negative ? 0 : 255, (size_t)f + 1);
            }
            lom_medium *medium = lom_create_medium(image, NULL);
            lom_float density = lom_sample_medium(medium, lom_find_in_cells(3, 3, 3, lom_splat3(0.4f, 0.7f, 0.99f)));
            CHECK(magnitude((double)density[0] - !negative) < 1e-6, "format %d: %g", f, density[0]);
            lom_free_medium(medium);
            lom_free_image(image);
        }
}

int main(int argc, char **argv)
{
    RUN(v2_v3_v13_slab_is_exact);
    RUN(v14_split_changes_nothing);
    RUN(octaves_are_powers_of_the_sun);
    RUN(surroundings_have_shares_of_one);
    RUN(images_that_are_no_media_are_refused);
    RUN(v15_order_reversed);
    RUN(v13_order_of_convergence);
    RUN(v5_empty_medium);
    RUN(skipping_changes_no_byte);
    RUN(what_noise_surely_eats_changes_no_byte);
    RUN(what_noise_surely_eats_is_not_sampled);
    RUN(gathers_change_no_byte);
    RUN(v10_early_stop_keeps_its_bound);
    RUN(step_keeps_its_error_bound);
    RUN(v6_v7_boxes_are_entered_once);
    RUN(v17_step_cap_covers_the_ray);
    RUN(v19_full_voxels);
    return check_result();
}
