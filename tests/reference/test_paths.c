/* Proves the paths through volumes: phase functions and what is drawn from them, the furnace, the slab in closed forms,
 * bounds, emptiness, and that every number belongs to its key (V4, V5, V10 to V13, V16 to V18). */
#include "check.h"
#include "volumes.h"

static const double PI = 3.141592653589793, INFINITE = __builtin_inf();

static bool near(double a, double b, double tolerance)
{
    return __builtin_fabs(a - b) <= tolerance;
}

/* ---- phase functions ---- */

static lom_reference_phase henyey_greenstein(double g)
{
    return (lom_reference_phase){ .kind = LOM_PHASE_HENYEY_GREENSTEIN, .forward = g };
}

/* The integrals of p and of p c over the sphere, c = cos: 2 pi sums over c = 1 - 2 s^3, midpoints, which are dense
 * where forward lobes are narrow; turned round for backward ones. */
static void integrate(const lom_reference_phase *phase, double *whole, double *mean)
{
    enum { STEPS = 20000 };
    *whole = *mean = 0;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < STEPS; i++) {
            double s = (i + 0.5) / STEPS, c = side * (1 - s * s * s), width = 3 * s * s / STEPS;
            *whole += 2 * PI * lom_phase_density(phase, c) * width;
            *mean += 2 * PI * lom_phase_density(phase, c) * c * width;
        }
}

static void v16_phases_integrate_to_one_with_their_mean_cosine(void)
{
    const double g[] = { 0, 0.5, -0.5, 0.9, -0.9, 0.99, -0.99, 1e-9 };
    double whole, mean;
    for (int i = 0; i < 8; i++) {
        lom_reference_phase phase = henyey_greenstein(g[i]);
        integrate(&phase, &whole, &mean);
        CHECK(near(whole, 1, 1e-5) && near(mean, g[i], 1e-5), "g = %g: %g, %g", g[i], whole, mean);
    }
    const lom_reference_phase isotropic = { .kind = LOM_PHASE_ISOTROPIC }, rayleigh = { .kind = LOM_PHASE_RAYLEIGH },
                              dual = { .kind = LOM_PHASE_DUAL, .forward = 0.8, .backward = -0.3, .blend = 0.25 };
    integrate(&isotropic, &whole, &mean);
    CHECK(near(whole, 1, 1e-8) && near(mean, 0, 1e-8));
    integrate(&rayleigh, &whole, &mean);
    CHECK(near(whole, 1, 1e-8) && near(mean, 0, 1e-8));
    CHECK(near(lom_phase_density(&rayleigh, 1) / lom_phase_density(&rayleigh, 0), 2, 1e-15));
    integrate(&dual, &whole, &mean);
    CHECK(near(whole, 1, 1e-5) && near(mean, 0.75 * 0.8 - 0.25 * 0.3, 1e-5));
    const lom_reference_phase needle = henyey_greenstein(1), cut = henyey_greenstein(0.999);
    CHECK(lom_phase_density(&needle, 1) == lom_phase_density(&cut, 1)); /* and no infinity */
    CHECK(lom_phase_density(&needle, 1) > lom_phase_density(&needle, -1));
}

/* Mean and mean square of drawn cosines against the density's own moments. */
static void v16_drawn_cosines_follow_their_density(void)
{
    const lom_reference_phase phases[] = {
        { .kind = LOM_PHASE_ISOTROPIC }, { .kind = LOM_PHASE_RAYLEIGH }, henyey_greenstein(0.85),
        henyey_greenstein(-0.4),         henyey_greenstein(0),           { LOM_PHASE_DUAL, 0.7, -0.5, 0.3 }
    };
    enum { DRAWN = 200 };
    for (int k = 0; k < 6; k++) {
        double mean = 0, square = 0, expected_mean = 0, expected_square = 0;
        for (int i = 0; i < DRAWN; i++)
            for (int j = 0; j < DRAWN; j++) {
                double c = lom_phase_cosine(&phases[k], (i + 0.5) / DRAWN, (j + 0.5) / DRAWN);
                CHECK(c >= -1 && c <= 1);
                mean += c / (DRAWN * DRAWN);
                square += c * c / (DRAWN * DRAWN);
            }
        for (int i = 0; i < 20000; i++) {
            double c = (i + 0.5) / 10000 - 1, p = 2 * PI * lom_phase_density(&phases[k], c) / 10000;
            expected_mean += p * c;
            expected_square += p * c * c;
        }
        CHECK(near(mean, expected_mean, 1e-3) && near(square, expected_square, 1e-3), "phase %d: %g, %g", k, mean,
              expected_mean);
    }
}

/* ---- light ---- */

static lom_vec3 white(const void *context, lom_vec3 direction)
{
    (void)context, (void)direction;
    return (lom_vec3){ 1, 1, 1 };
}

static double lump(double x, double y, double z)
{
    double r = (x - .5) * (x - .5) + (y - .5) * (y - .5) + (z - .5) * (z - .5);
    return lom_double_exp(-12 * r);
}

static lom_volume_light trace(const lom_reference_volume *v, const lom_reference_light *light, lom_vec3 origin,
                              lom_vec3 direction, int paths, int events)
{
    lom_volume_light out = { .cut = true };
    lom_volume_rays rays = { origin, direction, INFINITE, paths, events, 77 };
    CHECK(v != NULL && lom_trace_volume(v, light, &rays, &out, NULL));
    return out;
}

/* In surroundings of radiance 1 a medium that only scatters is invisible, whatever its phase. */
static void v12_furnace(void)
{
    const lom_reference_phase phases[] = { { .kind = LOM_PHASE_ISOTROPIC }, henyey_greenstein(0.8) };
    const lom_reference_light furnace = { .to_sun = { 0, 1, 0 }, .surroundings = white };
    for (int i = 0; i < 2; i++) {
        lom_reference_volume *v = make_volume(&(struct volume_of){ .size = { 16, 16, 16 },
                                                                   .high = { 1, 1, 1 },
                                                                   .extinction = 8,
                                                                   .albedo = 1,
                                                                   .phase = phases[i],
                                                                   .at = lump });
        lom_volume_light seen = trace(v, &furnace, (lom_vec3){ 0.4, 0.5, -1 }, (lom_vec3){ 0.1, 0, 1 }, 20000, 65536);
        CHECK(near(seen.scattered[0] + seen.transmittance, 1, 0.01) && !seen.cut, "%g",
              seen.scattered[0] + seen.transmittance);
        lom_volume_light once = trace(v, &furnace, (lom_vec3){ 0.4, 0.5, -1 }, (lom_vec3){ 0.1, 0, 1 }, 5000, 1);
        CHECK(once.scattered[0] + once.transmittance < 0.95 && once.cut); /* single scattering loses light */
        lom_free_reference_volume(v);
    }
}

/* A layer without end (200 times as wide as thick), depth tau, sun and view at cosines mu0 and mu on the same side:
 * light scattered once is w E p mu0 / (mu + mu0) (1 - exp(-tau (1/mu + 1/mu0))) (S. Chandrasekhar, Radiative Transfer,
 * 1960). */
static void v13_a_slab_scatters_once_by_its_closed_form(void)
{
    const double taus[] = { 0.1, 1, 10 };
    const lom_reference_phase phase = henyey_greenstein(0.4);
    for (int i = 0; i < 3; i++) {
        lom_reference_volume *v = make_volume(&(struct volume_of){ .size = { 1, 4, 1 },
                                                                   .low = { -200, 0, -200 },
                                                                   .high = { 200, 1, 200 },
                                                                   .extinction = taus[i],
                                                                   .albedo = 0.9,
                                                                   .phase = phase });
        double mu = 0.8, mu0 = 0.6;
        lom_reference_light sun = { .to_sun = { 0.8, mu0, 0 }, .sun = { 3, 3, 3 } };
        lom_vec3 d = { 0.6, -mu, 0 };
        lom_volume_light seen = trace(v, &sun, (lom_vec3){ 0, 2, 0 }, d, 20000, 1);
        double p = lom_phase_density(&phase, dot(d, sun.to_sun));
        double expected = 0.9 * 3 * p * mu0 / (mu + mu0) * -lom_double_expm1(-taus[i] * (1 / mu + 1 / mu0));
        CHECK(near(seen.scattered[1], expected, 4 * seen.error[1]) && seen.error[1] < 0.03 * expected,
              "depth %g: %g +- %g, not %g", taus[i], seen.scattered[1], seen.error[1], expected);
        CHECK(near(seen.transmittance, lom_double_exp(-taus[i] / mu), 1e-15));
        lom_free_reference_volume(v);
    }
}

/* Beer and Lambert once more: in the furnace each path that has met the medium brings 1, so their mean counts them. */
static void delta_tracking_meets_as_often_as_the_depth_says(void)
{
    const lom_reference_light furnace = { .to_sun = { 0, 1, 0 }, .surroundings = white };
    lom_reference_volume *v = make_volume(
        &(struct volume_of){ .size = { 12, 12, 12 }, .high = { 1, 1, 1 }, .extinction = 3, .albedo = 1, .at = lump });
    lom_volume_light seen = trace(v, &furnace, (lom_vec3){ 0.3, 0.6, -1 }, (lom_vec3){ 0.2, -0.1, 1 }, 40000, 65536);
    CHECK(near(seen.scattered[2], 1 - seen.transmittance, 4 * seen.error[2]), "%g +- %g, not %g", seen.scattered[2],
          seen.error[2], 1 - seen.transmittance);
    double chance = 1 - seen.transmittance;
    CHECK(near(seen.error[2], lom_double_sqrt(chance * (1 - chance) / 39999), 1e-4));
    lom_free_reference_volume(v);
}

static void v4_v11_bounds(void)
{
    const lom_reference_light both = { .to_sun = { 0, 1, 0 }, .sun = { 0, 0, 0 }, .surroundings = white };
    const double albedos[] = { 0, 0.5, 1 };
    double last = -1;
    for (int i = 0; i < 3; i++) {
        lom_reference_volume *v = make_volume(&(struct volume_of){
            .size = { 8, 8, 8 }, .high = { 1, 1, 1 }, .extinction = 20, .albedo = albedos[i], .at = lump });
        lom_volume_light seen = trace(v, &both, (lom_vec3){ 0.5, 0.5, -1 }, (lom_vec3){ 0, 0, 1 }, 4000, 65536);
        CHECK(seen.transmittance >= 0 && seen.transmittance <= 1);
        CHECK(seen.scattered[0] > last && seen.scattered[0] <= 1 + 1e-12, "%g", seen.scattered[0]);
        CHECK(i > 0 || seen.scattered[0] == 0);
        last = seen.scattered[0];
        lom_free_reference_volume(v);
    }
}

static double nothing(double x, double y, double z)
{
    (void)x, (void)y, (void)z;
    return 0;
}

static void v5_an_empty_volume_changes_no_bit(void)
{
    const lom_reference_light furnace = { .to_sun = { 0, 1, 0 }, .sun = { 9, 9, 9 }, .surroundings = white };
    lom_reference_volume *empty = make_volume(
        &(struct volume_of){ .size = { 4, 4, 4 }, .high = { 1, 1, 1 }, .extinction = 5, .albedo = 1, .at = nothing });
    lom_reference_volume *clear =
        make_volume(&(struct volume_of){ .size = { 4, 4, 4 }, .high = { 1, 1, 1 }, .extinction = 0, .albedo = 1 });
    const lom_reference_volume *both[] = { empty, clear };
    for (int i = 0; i < 2; i++) {
        lom_volume_light seen = trace(both[i], &furnace, (lom_vec3){ 0.5, 0.5, 0.5 }, (lom_vec3){ 1, 2, 3 }, 100, 10);
        CHECK(seen.scattered[0] == 0 && seen.transmittance == 1 && !seen.cut);
    }
    lom_free_reference_volume(empty);
    lom_free_reference_volume(clear);
}

/* A medium so dense that a step is lost in the rounding of its place ends, and says so. */
static void v1_v17_lost_steps_are_flagged(void)
{
    uint8_t voxels[2] = { 255, 0 };
    lom_image image = { .width = 2, .height = 1, .depth = 1, .format = LOM_FORMAT_R8, .pixels = voxels };
    const lom_reference_light dark = { .to_sun = { 0, 1, 0 } };
    lom_reference_volume *v = lom_create_reference_volume(
        &(lom_reference_volume_desc){
            .density = &image, .high = { 2, 1, 1 }, .extinction = 1e30, .albedo = { 1, 1, 1 } },
        NULL);
    lom_volume_light seen = trace(v, &dark, (lom_vec3){ 1.75, 0.5, -9 }, (lom_vec3){ 0, 0, 1 }, 1, 4);
    CHECK(seen.cut && seen.scattered[0] == 0 && seen.transmittance == 1); /* it lies where the density is 0 */
    lom_free_reference_volume(v);
}

static void v18_the_same_key_gives_the_same_light(void)
{
    const lom_reference_light sun = { .to_sun = { 0, 1, 0 }, .sun = { 1, 2, 3 }, .surroundings = white };
    lom_reference_volume *v = make_volume(
        &(struct volume_of){ .size = { 8, 8, 8 }, .high = { 1, 1, 1 }, .extinction = 9, .albedo = 0.99, .at = lump });
    lom_volume_rays rays = { { 0.5, 0.5, -1 }, { 0, 0, 1 }, INFINITE, 50, 100, 5 };
    lom_volume_light a, b, other;
    CHECK(lom_trace_volume(v, &sun, &rays, &a, NULL) && lom_trace_volume(v, &sun, &rays, &b, NULL));
    rays.key = 6;
    CHECK(lom_trace_volume(v, &sun, &rays, &other, NULL));
    CHECK(memcmp(a.scattered, b.scattered, sizeof a.scattered) == 0);
    CHECK(a.scattered[0] != other.scattered[0] && a.transmittance == other.transmittance);
    rays.far = 0; /* everything is behind */
    CHECK(lom_trace_volume(v, &sun, &rays, &other, NULL) && other.transmittance == 1 && other.scattered[0] == 0);
    lom_free_reference_volume(v);
}

int main(int argc, char **argv)
{
    RUN(v16_phases_integrate_to_one_with_their_mean_cosine);
    RUN(v16_drawn_cosines_follow_their_density);
    RUN(v12_furnace);
    RUN(v13_a_slab_scatters_once_by_its_closed_form);
    RUN(delta_tracking_meets_as_often_as_the_depth_says);
    RUN(v4_v11_bounds);
    RUN(v5_an_empty_volume_changes_no_bit);
    RUN(v1_v17_lost_steps_are_flagged);
    RUN(v18_the_same_key_gives_the_same_light);
    return check_result();
}
