/* Proves: over the sphere phase functions are 1 on average and have the mean cosine they are named for; lanes
 * follow the reference's functions in double; the sharpest ones are finite. */
#include "check.h"
#include "cloud/phase.h"

#include <lom/reference.h>

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

static lom_float phase_of(const lom_reference_phase *p, lom_float mu)
{
    return lom_phase((int)p->kind, (float)p->forward, (float)p->backward, (float)p->blend, mu);
}

/* Means over the sphere of the function and of the function times the cosine: over c = 1 - 2 s^3 from either end,
 * midpoints, which are dense where lobes are narrow. */
static void find_means(const lom_reference_phase *p, double *whole, double *mean)
{
    enum { STEPS = 4096 };
    *whole = *mean = 0;
    for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i < STEPS; i += LOM_LANES) {
            float cosine[LOM_LANES], value[LOM_LANES];
            double width[LOM_LANES];
            for (int lane = 0; lane < LOM_LANES; lane++) {
                double s = (i + lane + 0.5) / STEPS;
                cosine[lane] = (float)(side * (1 - s * s * s));
                width[lane] = 3 * s * s / STEPS / 2;
            }
            lom_store(value, phase_of(p, lom_load(cosine)));
            for (int lane = 0; lane < LOM_LANES; lane++) {
                *whole += (double)value[lane] * width[lane];
                *mean += (double)value[lane] * (double)cosine[lane] * width[lane];
            }
        }
}

static void v16_phases_average_to_one_with_their_mean_cosine(void)
{
    static const double g[] = { 0, 0.5, -0.5, 0.9, -0.9, 0.99, -0.99 };
    double whole, mean;
    for (int i = 0; i < 7; i++) {
        const lom_reference_phase p = { .kind = LOM_PHASE_HENYEY_GREENSTEIN, .forward = g[i] };
        find_means(&p, &whole, &mean);
        double bound =
            i < 5 ? 1e-4 : 1.5e-4; /* at 0.99 the peak's 1 + g^2 - 2 g mu is 1e-4, a difference of floats near 1 */
        CHECK(magnitude(whole - 1) < bound && magnitude(mean - g[i]) < bound, "g = %g: %.6f, %.6f", g[i], whole, mean);
    }
    const lom_reference_phase isotropic = { .kind = LOM_PHASE_ISOTROPIC }, rayleigh = { .kind = LOM_PHASE_RAYLEIGH };
    find_means(&isotropic, &whole, &mean);
    CHECK(magnitude(whole - 1) < 1e-6 && magnitude(mean) < 1e-6, "isotropic: %.7f, %.7f", whole, mean);
    find_means(&rayleigh, &whole, &mean);
    CHECK(magnitude(whole - 1) < 1e-6 && magnitude(mean) < 1e-6, "Rayleigh: %.7f, %.7f", whole, mean);
    const lom_reference_phase dual = { .kind = LOM_PHASE_DUAL, .forward = 0.8, .backward = -0.3, .blend = 0.35 };
    find_means(&dual, &whole, &mean);
    CHECK(magnitude(whole - 1) < 1e-4 && magnitude(mean - (0.65 * 0.8 - 0.35 * 0.3)) < 1e-4, "dual: %.6f, %.6f", whole,
          mean);
}

/* Against the density per solid angle in double, times 4 pi. Near the peak of the sharpest lobe 1 + g^2 - 2 g mu is
 * 1e-4, a difference of floats near 1: 2^-23 of it is 1.2e-3. */
static void v16_lanes_follow_the_reference(void)
{
    static const lom_reference_phase phases[] = { { .kind = LOM_PHASE_ISOTROPIC },
                                                  { .kind = LOM_PHASE_RAYLEIGH },
                                                  { .kind = LOM_PHASE_HENYEY_GREENSTEIN, .forward = 0.8 },
                                                  { .kind = LOM_PHASE_HENYEY_GREENSTEIN, .forward = -0.6 },
                                                  { .kind = LOM_PHASE_HENYEY_GREENSTEIN, .forward = 0.99 },
                                                  { LOM_PHASE_DUAL, 0.7, -0.5, 0.3 } };
    for (size_t i = 0; i < sizeof phases / sizeof *phases; i++)
        for (int step = 0; step <= 2000; step++) {
            double mu = step / 1000.0 - 1, want = 12.566370614359172 * lom_phase_density(&phases[i], (float)mu);
            double got = (double)phase_of(&phases[i], lom_splat((float)mu))[0];
            CHECK(magnitude(got / want - 1) < (i == 4 ? 3e-3 : 1e-5), "phase %zu, cosine %g: %.7g for %.7g", i, mu, got,
                  want);
        }
    /* forward means that light goes on in its way */
    CHECK(phase_of(&phases[2], lom_splat(1.0f))[0] > 40 && phase_of(&phases[2], lom_splat(-1.0f))[0] < 0.1f, "sign");
}

static void v16_needles_are_finite(void)
{
    static const float g[] = { 0.999f, -0.999f, 0.9999999f, 1, -1 };
    for (int i = 0; i < 5; i++)
        for (int step = -4; step <= 4; step++) {
            float value = lom_phase_henyey_greenstein(lom_splat((float)step / 4), g[i])[0];
            CHECK(value >= 0 && value < 1e7f, "g = %g, cosine %d / 4: %g", g[i], step, value);
        }
}

int main(int argc, char **argv)
{
    RUN(v16_phases_average_to_one_with_their_mean_cosine);
    RUN(v16_lanes_follow_the_reference);
    RUN(v16_needles_are_finite);
    return check_result();
}
