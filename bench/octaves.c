/* The light that models say clouds send, against random paths, along rays through clouds. In: nothing. Out: a table,
 * bench/results/cloud-octaves.md. Invariant: optical depths are exact, so that what differs is the model of scattering
 * alone; the paths' own noise is taken out of the errors. */
#include "base/numbers.h"

#include <lom/reference.h>

#include <stdio.h>
#include <stdlib.h>

enum { RAYS = 200, PATHS = 32, STEPS = 160, OCTAVES = 4, MODELS = 2 };

/* A cloud and a sun. */
static const struct subject {
    const char *kind;
    double height, width, extinction; /* metres, 1/m */
    double elevation;                 /* degrees */
    lom_reference_phase phase;
} subjects[] = {
    { "cumulus_humilis", 400, 900, 0.04, 20, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
    { "cumulus_humilis", 400, 900, 0.01, 60, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
    { "cumulus_mediocris", 900, 1200, 0.05, 10, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
    { "cumulus_mediocris", 900, 1200, 0.05, 42, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
    { "cumulus_mediocris", 900, 1200, 0.05, 75, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
    { "cumulus_mediocris", 900, 1200, 0.0125, 42, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
    { "cumulus_mediocris", 900, 1200, 0.05, 42, { LOM_PHASE_HENYEY_GREENSTEIN, 0.85, 0, 0 } },
    { "cumulus_mediocris", 900, 1200, 0.05, 42, { LOM_PHASE_ISOTROPIC, 0, 0, 0 } },
    { "cumulus_congestus", 3000, 2500, 0.05, 42, { LOM_PHASE_DUAL, 0.8, -0.3, 0.35 } },
};
enum { SUBJECTS = sizeof subjects / sizeof subjects[0] };

/* Octave k weighs weight[k], is attenuated by attenuation^k, its phase function's mean cosines are narrowed by narrowing^k.
 * The sky's share: of both sides together, or of each alone. */
static const struct model {
    double weight[OCTAVES], attenuation, narrowing;
    bool shared;
} models[MODELS] = { { { 0.62, 0.31, 0.155, 0.0775 }, 0.5, 0.5, false }, { { 0.25, 0.2, 0.1, 0.05 }, 0.25, 0, true } };

/* The sun is red, the sky green, the ground blue: one path tells all three. */
static lom_vec3 surroundings(const void *context, lom_vec3 direction)
{
    (void)context;
    return direction.y > 0 ? (lom_vec3){ 0, 1, 0 } : (lom_vec3){ 0, 0, 1 };
}

static double phase_of(const struct subject *s, double cosine, double narrowed)
{
    lom_reference_phase phase = s->phase;
    phase.forward *= narrowed;
    phase.backward *= narrowed;
    return 4 * lom_pi * lom_phase_density(&phase, cosine);
}

struct ray {
    lom_vec3 from, along;
    double far;
};

struct cloud {
    const struct subject *subject;
    lom_reference_volume *volume;
    lom_vec3 half, to_sun;
};

static double depth_towards(const struct cloud *c, lom_vec3 from, lom_vec3 along)
{
    return lom_volume_optical_depth(c->volume, from, along, 0, __builtin_inf());
}

/* A model's sun and sky along a ray. */
static void evaluate(const struct cloud *c, const struct ray *ray, double sun[MODELS], double sky[MODELS])
{
    const lom_vec3 up = { 0, 1, 0 }, down = { 0, -1, 0 };
    const double step = ray->far / STEPS, cosine = lom_vec3_dot(ray->along, c->to_sun);
    double left = 1;
    for (int m = 0; m < MODELS; m++)
        sun[m] = sky[m] = 0;
    for (int i = 0; i < STEPS && left > 0.002; i++) {
        const lom_vec3 at = lom_vec3_add(ray->from, lom_vec3_scale(ray->along, (i + 0.5) * step));
        const double depth = lom_volume_optical_depth(c->volume, ray->from, ray->along, i * step, (i + 1) * step);
        const double share = -left * lom_double_expm1(-depth);
        left -= share;
        if (share < 1e-5)
            continue;
        const double lit = depth_towards(c, at, c->to_sun), above = depth_towards(c, at, up),
                     below = depth_towards(c, at, down);
        for (int m = 0; m < MODELS; m++) {
            double thinned = 1, narrowed = 1;
            for (int k = 0; k < OCTAVES; k++) {
                sun[m] += share * models[m].weight[k] * phase_of(c->subject, cosine, narrowed) *
                          lom_double_exp(-lit * thinned);
                thinned *= models[m].attenuation;
                narrowed *= models[m].narrowing;
            }
            sky[m] += share * (models[m].shared ? (1 + 0.1125 * below) / (2 + 0.1125 * (above + below))
                                                : 1 / (1 + 0.1125 * above));
        }
    }
}

static bool aim(const struct cloud *c, uint64_t key, struct ray *ray)
{
    const double turn = lom_two_pi * lom_random_uniform(key, 0), rise = 1.5 * lom_random_uniform(key, 1) - 0.6;
    const double level = lom_double_sqrt(1 - 0.5 * rise * rise), reach = 4 * lom_vec3_length(c->half);
    ray->along = lom_vec3_normalize((lom_vec3){ level * lom_double_cos(turn), rise, level * lom_double_sin(turn) });
    const lom_vec3 at = { c->half.x * (2 * lom_random_uniform(key, 2) - 1),
                          c->half.y * (2 * lom_random_uniform(key, 3) - 1),
                          c->half.z * (2 * lom_random_uniform(key, 4) - 1) };
    ray->from = lom_vec3_subtract(at, lom_vec3_scale(ray->along, reach / 2));
    ray->far = reach;
    return lom_volume_optical_depth(c->volume, ray->from, ray->along, 0, reach) > 0.05;
}

/* Means of the paths and of the models, and the models' root mean square errors. */
static void compare(const struct cloud *c, uint64_t key)
{
    double paths[3] = { 0 }, mean[MODELS][2] = { { 0 } }, square[MODELS][2] = { { 0 } }, noise[2] = { 0 };
    const lom_reference_light light = { .to_sun = c->to_sun, .sun = { lom_pi, 0, 0 }, .surroundings = surroundings };
    int count = 0;
    for (uint64_t i = 0; count < RAYS; i++) {
        struct ray ray;
        lom_volume_light found;
        double sun[MODELS], sky[MODELS];
        if (!aim(c, lom_hash_bytes(key, &i, sizeof i), &ray))
            continue;
        const lom_volume_rays rays = { ray.from, ray.along, __builtin_inf(), PATHS, 4096, key + i };
        if (!lom_trace_volume(c->volume, &light, &rays, &found, NULL))
            continue;
        evaluate(c, &ray, sun, sky);
        for (int k = 0; k < 3; k++)
            paths[k] += found.scattered[k] / RAYS;
        for (int k = 0; k < 2; k++)
            noise[k] += found.error[k] * found.error[k] / RAYS;
        for (int m = 0; m < MODELS; m++) {
            mean[m][0] += sun[m] / RAYS;
            mean[m][1] += sky[m] / RAYS;
            square[m][0] += (sun[m] - found.scattered[0]) * (sun[m] - found.scattered[0]) / RAYS;
            square[m][1] += (sky[m] - found.scattered[1]) * (sky[m] - found.scattered[1]) / RAYS;
        }
        count++;
    }
    printf("| %s | %g | %g | %.2f |", c->subject->kind, c->subject->extinction, c->subject->elevation, paths[0]);
    for (int k = 0; k < 2; k++) {
        for (int m = 0; m < MODELS; m++) {
            const double error = square[m][k] - noise[k];
            printf(" %.2f, %.2f |", mean[m][k], error > 0 ? lom_double_sqrt(error) : 0);
        }
        if (k == 0)
            printf(" %.2f |", paths[1]);
    }
    printf("\n");
    fflush(stdout);
}

int main(void)
{
    printf("| cloud | extinction, 1/m | sun, degrees | sun by paths | before | now | sky by paths | before | now |\n"
           "|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < SUBJECTS; i++) {
        const struct subject *s = &subjects[i];
        const double elevation = s->elevation * lom_pi / 180;
        struct cloud c = { .subject = s,
                           .half = { s->width / 2, s->height / 2, s->width / 2 },
                           .to_sun = { lom_double_cos(elevation), lom_double_sin(elevation), 0 } };
        lom_image *density = lom_make_cloud(&(lom_cloud_desc){ s->kind, 64, 64, 64, 1 }, NULL);
        c.volume = lom_create_reference_volume(&(lom_reference_volume_desc){ .density = density,
                                                                             .low = lom_vec3_scale(c.half, -1),
                                                                             .high = c.half,
                                                                             .extinction = s->extinction,
                                                                             .albedo = { 1, 1, 1 },
                                                                             .phase = s->phase },
                                               NULL);
        if (c.volume == NULL)
            return 2;
        compare(&c, (uint64_t)i + 1);
        lom_free_reference_volume(c.volume);
        lom_free_image(density);
    }
    return 0;
}
