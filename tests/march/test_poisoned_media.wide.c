/* A cloud's voxels may be any floats: a medium made of infinities, NaN, denormals and huge densities is, byte for byte, the
 * one of the densities 0 and 1 that they stand for, and so is its light; so a march through it takes as many steps. To
 * make it, and to march with an extinction, a phase or weights that are such, takes at most 2.5 times as long as with
 * clean ones (the criterion of Embree's tests): processor time of this thread, in turn, the least of each. */
#include "check.h"
#include "media.h"
#include "processor_time.h"

#include "march/cells.h"

#include <float.h>
#include <math.h>

enum { SIDE = 40, VOXELS = SIDE * SIDE * SIDE, ROUNDS = 9 };
static const double most = 2.5;

static const struct poison {
    const char *name;
    float value, meant;
} poisons[] = {
    { "NaN", NAN, 0 },      { "infinity", INFINITY, 1 }, { "-infinity", -INFINITY, 0 }, { "denormals", 1e-41f, 0 },
    { "-1e30", -1e30f, 0 }, { "1e30", 1e30f, 1 },        { "FLT_MAX", FLT_MAX, 1 },
};
enum { POISONS = sizeof poisons / sizeof *poisons };

/* Noise, and one voxel of `every` of this density. */
static lom_image *voxels_with(float value, int every)
{
    lom_image *image = lom_create_image(SIDE, SIDE, SIDE, LOM_FORMAT_R32F, NULL);
    float *at = (float *)(void *)image->pixels;
    for (int i = 0; i < VOXELS; i++)
        at[i] = i % every == 0 ? value : (float)lom_random_uniform(5, (uint64_t)i);
    return image;
}

static lom_light_grid *light_of(const lom_image *image)
{
    float eroded[256];
    for (int i = 0; i < 256; i++)
        eroded[i] = (float)i / 255;
    lom_light_grid *grid = lom_create_light_grid(image, 0.5, eroded, NULL);
    const lom_light_desc light = {
        .size = { 100, 100, 100 }, .extinction = 0.05f, .to_light = { 0.48f, 0.64f, 0.6f }, .forward = 0.5f
    };
    CHECK(grid != NULL && lom_sweep_sun(grid, &light, NULL), "no light");
    lom_sweep_sky(grid, light.size, light.extinction);
    return grid;
}

static void check_same(const lom_image *bad, const lom_image *clean, const char *name, int every)
{
    lom_medium *medium[2] = { lom_create_medium(bad, NULL), lom_create_medium(clean, NULL) };
    lom_light_grid *grid[2] = { light_of(bad), light_of(clean) };
    const size_t words = cell_index(SIDE, SIDE, 0, 0, SIDE), cells = cell_index(SIDE, SIDE, 0, 0, SIDE + 1);
    const size_t lit = cell_index(grid[0]->width, grid[0]->height, 0, 0, grid[0]->depth + 1);
    CHECK(memcmp(medium[0]->density, medium[1]->density, words * sizeof *medium[0]->density) == 0,
          "%s in every %dth voxel: densities", name, every);
    CHECK(memcmp(medium[0]->emptiness, medium[1]->emptiness, cells) == 0, "%s in every %dth voxel: emptiness", name,
          every);
    CHECK(medium[0]->bend == medium[1]->bend, "%s in every %dth voxel: steps", name, every);
    CHECK(memcmp(grid[0]->light, grid[1]->light, lit * sizeof *grid[0]->light) == 0, "%s in every %dth voxel: light",
          name, every);
    for (int i = 0; i < 2; i++) {
        lom_free_medium(medium[i]);
        lom_free_light_grid(grid[i]);
    }
}

static void any_voxels_are_those_of_0_to_1(void)
{
    static const int every[] = { 1, 3, 17 };
    for (int p = 0; p < POISONS; p++)
        for (int e = 0; e < 3; e++) {
            lom_image *bad = voxels_with(poisons[p].value, every[e]);
            lom_image *clean = voxels_with(poisons[p].meant, every[e]);
            check_same(bad, clean, poisons[p].name, every[e]);
            lom_free_image(bad);
            lom_free_image(clean);
        }
}

static double time_to_make(const lom_image *image)
{
    const double start = processor_seconds();
    lom_free_medium(lom_create_medium(image, NULL));
    lom_free_light_grid(light_of(image));
    return processor_seconds() - start;
}

static void they_take_no_longer_to_make(void)
{
    for (int p = 0; p < POISONS; p++) {
        lom_image *image[2] = { voxels_with(0.5f, 2), voxels_with(poisons[p].value, 2) };
        double least[2] = { INFINITY, INFINITY };
        for (int i = 0; i < 2 * ROUNDS; i++)
            least[i % 2] = fmin(least[i % 2], time_to_make(image[i % 2]));
        CHECK(least[1] <= most * least[0], "%s: %g times as long", poisons[p].name, least[1] / least[0]);
        printf("  %-10s in every 2nd voxel, made: %.2f\n", poisons[p].name, least[1] / least[0]);
        lom_free_image(image[0]);
        lom_free_image(image[1]);
    }
}

/* ---- what a march is told ---- */

struct march {
    lom_medium_desc desc;
    float phase;
    uint64_t sampled;
};

static double time_to_march(struct march *m)
{
    enum { RAYS = 200 };
    uint32_t state = 3;
    lom_march_count count = { 0 };
    lom_medium_result result;
    const double start = processor_seconds();
    for (int i = 0; i < RAYS; i++) {
        lom_medium_rays rays = random_rays(&state, 0.02);
        rays.phase = lom_splat(m->phase);
        LOM_WIDE(lom_march_medium)(&result, &rays, &m->desc, &count);
    }
    m->sampled = count.sampled;
    return processor_seconds() - start;
}

/* A ray through it is stopped by nothing, which is the longest that a clean one may be. */
static void compare_marches(struct march *clean, struct march *bad, const char *what, const char *name)
{
    double least[2] = { INFINITY, INFINITY };
    for (int i = 0; i < 2 * ROUNDS; i++)
        least[i % 2] = fmin(least[i % 2], time_to_march(i % 2 == 0 ? clean : bad));
    CHECK(bad->sampled <= clean->sampled, "%s as %s: %llu samples, not %llu", name, what,
          (unsigned long long)bad->sampled, (unsigned long long)clean->sampled);
    CHECK(least[1] <= most * least[0], "%s as %s: %g times as long", name, what, least[1] / least[0]);
    printf("  %-10s as %-10s %.2f of the samples, %.2f of the time\n", name, what,
           (double)bad->sampled / (double)clean->sampled, least[1] / least[0]);
}

static void numbers_of_a_march(void)
{
    lom_image *image = voxels_with(0, 2);
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_light_grid *light = light_of(image);
    struct march clean = { .desc = plain(medium, 1e-3, 0.01), .phase = 0.5f };
    clean.desc.light = light;
    clean.desc.octaves = 4;
    for (int i = 0; i < 4; i++)
        clean.desc.weight[i] = 0.25f;
    for (int p = 0; p < POISONS; p++) {
        struct march extinction = clean, phase = clean, weight = clean;
        extinction.desc.extinction = poisons[p].value;
        phase.phase = poisons[p].value;
        weight.desc.weight[1] = poisons[p].value;
        if (poisons[p].value >= 0)
            compare_marches(&clean, &extinction, "extinction", poisons[p].name);
        compare_marches(&clean, &phase, "a phase", poisons[p].name);
        compare_marches(&clean, &weight, "a weight", poisons[p].name);
    }
    lom_free_light_grid(light);
    lom_free_medium(medium);
    lom_free_image(image);
}

static void an_extinction_of_denormals_is_none(void)
{
    lom_image *image = voxels_with(0.5f, 2);
    lom_medium *medium = lom_create_medium(image, NULL);
    lom_medium_desc none = plain(medium, 0, 0.01), denormal = none;
    denormal.extinction = 1e-41f;
    uint32_t state = 5;
    for (int i = 0; i < 20; i++) {
        const lom_medium_rays rays = random_rays(&state, 0.02);
        lom_medium_result result[2];
        lom_float depth[2];
        LOM_WIDE(lom_march_medium)(&result[0], &rays, &none, NULL);
        LOM_WIDE(lom_march_medium)(&result[1], &rays, &denormal, NULL);
        CHECK(memcmp(&result[0], &result[1], sizeof result[0]) == 0, "what ray %d brings", i);
        LOM_WIDE(lom_medium_depth)(&depth[0], &rays, &none, 8);
        LOM_WIDE(lom_medium_depth)(&depth[1], &rays, &denormal, 8);
        CHECK(memcmp(&depth[0], &depth[1], sizeof depth[0]) == 0, "how deep ray %d is", i);
    }
    lom_free_medium(medium);
    lom_free_image(image);
}

int main(int argc, char **argv)
{
    RUN(an_extinction_of_denormals_is_none);
    RUN(any_voxels_are_those_of_0_to_1);
    RUN(they_take_no_longer_to_make);
    RUN(numbers_of_a_march);
    return check_result();
}
