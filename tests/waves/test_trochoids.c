/* Proves of trochoids that programs make: one wave is Gerstner's in closed form, the report says how steep they are and
 * how many were held back, no crest loops however steep they were asked to be, normals are those of the surface,
 * places far from the origin and late keep their phase, and the pipeline's waves are these. */
#include "check.h"

#include "waves/wave_lanes.h"

#include <lom/water.h>

static const double turn = 6.283185307179586;

static lom_water_waves waves_of(double height, double steepness, int count)
{
    return (lom_water_waves){ .kind = LOM_WAVES_GERSTNER,
                              .seed = 7,
                              .direction = 0.4,
                              .height = height,
                              .length = { 20, 0.7 },
                              .count = count,
                              .steepness = steepness,
                              .spread = 0.5 };
}

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

/* With across = amplitude = a a particle moves on a circle of radius a; the surface is 1 + (k a)^2 - 2 k a cos t long
 * to the square, and a piece of water keeps 1 - k a cos t of its length. */
static void one_wave_is_gerstners(void)
{
    lom_trochoid wave = { .direction = { 0.6, 0.8 }, .number = 0.5, .rate = 2, .amplitude = 1.5, .across = 1.5 };
    for (int i = 0; i < 100; i++) {
        double x = 0.7 * i - 30, z = 11 - 0.3 * i, time = 0.13 * i, t = 0.5 * (0.6 * x + 0.8 * z) - 2 * time;
        lom_trochoid_point p = lom_trochoids_at(&wave, 1, x, z, time);
        double dx = p.place[0] - x, dz = p.place[2] - z, c = lom_double_cos(t), s = lom_double_sin(t);
        CHECK(magnitude(dx * dx + p.place[1] * p.place[1] + dz * dz - 1.5 * 1.5) < 1e-12, "no circle at %d", i);
        CHECK(magnitude(p.place[1] - 1.5 * c) < 1e-12 && magnitude(dx + 0.6 * 1.5 * s) < 1e-12, "place at %d", i);
        CHECK(magnitude(p.jacobian - (1 - 0.75 * c)) < 1e-12, "Jacobian %g at %d", p.jacobian, i);
        double length = lom_double_sqrt(1 + 0.75 * 0.75 - 1.5 * c);
        CHECK(magnitude(p.normal[1] - (1 - 0.75 * c) / length) < 1e-12, "normal %g at %d", p.normal[1], i);
        CHECK(magnitude(p.normal[0] - 0.6 * 0.75 * s / length) < 1e-12, "normal's x %g at %d", p.normal[0], i);
    }
}

/* Differences of places along x and z span the plane that the normal stands on. */
static void normals_stand_on_the_surface(void)
{
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_water_waves waves = waves_of(0.8, 0.7, 12);
    int count = lom_make_trochoids(&waves, trochoids, NULL, NULL);
    double step = 1e-5;
    for (int i = 0; i < 200; i++) {
        double x = 0.37 * i - 20, z = 11 - 0.21 * i;
        lom_trochoid_point p = lom_trochoids_at(trochoids, count, x, z, 3.5);
        lom_trochoid_point e = lom_trochoids_at(trochoids, count, x + step, z, 3.5);
        lom_trochoid_point s = lom_trochoids_at(trochoids, count, x, z + step, 3.5);
        double along_x = 0, along_z = 0, square = 0;
        for (int k = 0; k < 3; k++) {
            along_x += p.normal[k] * (e.place[k] - p.place[k]) / step;
            along_z += p.normal[k] * (s.place[k] - p.place[k]) / step;
            square += p.normal[k] * p.normal[k];
        }
        CHECK(magnitude(along_x) < 1e-4 && magnitude(along_z) < 1e-4, "%g and %g at %d", along_x, along_z, i);
        CHECK(magnitude(square - 1) < 1e-14 && p.normal[1] >= 0, "normal of square %g", square);
    }
}

/* W1: steepness beyond the cusp is held back, and the report says from what to what. */
static void w1_steepness_is_limited_and_reported(void)
{
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_trochoid_report report;
    lom_water_waves gentle = waves_of(0.3, 0.5, 8), absurd = waves_of(100, 1, 21);
    int count = lom_make_trochoids(&gentle, trochoids, &report, NULL);
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += trochoids[i].amplitude * trochoids[i].number / 2;
    CHECK(count == 8 && report.limited == 0 && report.steepness == report.asked, "%d of gentle waves", report.limited);
    CHECK(magnitude(report.steepness - sum) < 1e-12, "steepness %g is not %g", report.steepness, sum);
    count = lom_make_trochoids(&absurd, trochoids, &report, NULL);
    CHECK(report.limited == 21 && magnitude(report.steepness - 1) < 1e-12, "%d limited to %g", report.limited,
          report.steepness);
    CHECK(report.asked > 10, "asked for %g", report.asked);
    double least = 1;
    for (int i = 0; i < 100000; i++) {
        lom_trochoid_point p = lom_trochoids_at(trochoids, count, 400 * lom_random_uniform(3, 2 * (uint64_t)i),
                                                400 * lom_random_uniform(3, 2 * (uint64_t)i + 1), 1);
        least = p.jacobian < least ? p.jacobian : least;
    }
    CHECK(least >= 0, "a loop: Jacobian %g", least);
}

/* Where all crests meet, waves of steepness 1 that run one way stand at a cusp: the Jacobian is 0 there and the normal
 * is still one. */
static void w1_all_crests_together_touch_a_cusp(void)
{
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_water_waves waves = waves_of(100, 1, 16);
    waves.spread = 0;
    int count = lom_make_trochoids(&waves, trochoids, NULL, NULL);
    for (int i = 0; i < count; i++)
        trochoids[i].phase = 0;
    lom_trochoid_point p = lom_trochoids_at(trochoids, count, 0, 0, 0);
    double square = p.normal[0] * p.normal[0] + p.normal[1] * p.normal[1] + p.normal[2] * p.normal[2];
    CHECK(magnitude(p.jacobian) < 1e-12, "Jacobian %g", p.jacobian);
    CHECK(magnitude(square - 1) < 1e-14, "normal of square %g", square);
}

/* W4: a wave of 8 m is the same 1 250 000 lengths away; and after 10^6 of its periods. */
static void w4_far_away_and_late_the_phase_holds(void)
{
    lom_trochoid wave = { .direction = { 1, 0 }, .number = turn / 8, .amplitude = 1, .across = 0.5 };
    wave.rate = turn / 2;
    for (int i = 0; i < 64; i++) {
        double x = 0.125 * i;
        lom_trochoid_point near = lom_trochoids_at(&wave, 1, x, 0, 0);
        lom_trochoid_point far = lom_trochoids_at(&wave, 1, x + 1e7, 0, 0);
        lom_trochoid_point late = lom_trochoids_at(&wave, 1, x, 0, 2e6);
        CHECK(magnitude(far.place[1] - near.place[1]) < 1e-7, "%g far away", far.place[1] - near.place[1]);
        CHECK(magnitude(late.place[1] - near.place[1]) < 1e-7, "%g late", late.place[1] - near.place[1]);
        CHECK(magnitude(far.jacobian - near.jacobian) < 1e-7, "Jacobian off by %g", far.jacobian - near.jacobian);
    }
}

static void the_pipelines_waves_are_these(void)
{
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_water_params water = { .waves = waves_of(0.8, 0.7, 12) };
    struct lom_waves_uniform uniform;
    memset(&uniform, 0, sizeof uniform);
    int count = lom_make_trochoids(&water.waves, trochoids, NULL, NULL);
    lom_fill_trochoids(&uniform, &water.waves, &water.foam, (double[2]){ 0, 0 }, 0);
    CHECK(uniform.trochoid_count == count, "%d waves of %d", uniform.trochoid_count, count);
    for (int i = 0; i < count; i++) {
        const struct lom_trochoid_uniform *u = &uniform.trochoid[i];
        CHECK(u->amplitude == (float)trochoids[i].amplitude, "amplitude of %d", i);
        CHECK(u->kx == (float)(trochoids[i].direction[0] * trochoids[i].number), "wave vector of %d", i);
    }
}

/* W2: no height is no wave; what is no wave at all is refused. */
static void w2_no_height_is_calm_and_bad_waves_are_refused(void)
{
    lom_trochoid trochoids[LOM_MAX_WAVES] = { { .number = 5 } };
    lom_water_waves calm = waves_of(0, 1, 8), bad[9];
    CHECK(lom_make_trochoids(&calm, trochoids, NULL, NULL) == 0, "waves of no height");
    lom_trochoid_point p = lom_trochoids_at(trochoids, 0, 3, 4, 5);
    CHECK(p.place[0] == 3 && p.place[1] == 0 && p.place[2] == 4 && p.normal[1] == 1 && p.jacobian == 1, "not calm");
    for (int i = 0; i < 9; i++)
        bad[i] = waves_of(1, 1, 8);
    bad[0].height = __builtin_nan("");
    bad[1].height = -1;
    bad[2].length[1] = 0;
    bad[3].length[0] = 0.5; /* shorter than the shortest */
    bad[4].steepness = 1.5;
    bad[5].count = 1000000;
    bad[6].count = 0;
    bad[7].direction = __builtin_inf();
    bad[8].spread = __builtin_nan("");
    for (int i = 0; i < 9; i++) {
        lom_error error = { 0 };
        CHECK(lom_make_trochoids(&bad[i], trochoids, NULL, &error) == -1 && strlen(error.text) > 20, "case %d", i);
        CHECK(trochoids[0].number == 5, "case %d is written", i);
    }
}

int main(int argc, char **argv)
{
    RUN(one_wave_is_gerstners);
    RUN(normals_stand_on_the_surface);
    RUN(w1_steepness_is_limited_and_reported);
    RUN(w1_all_crests_together_touch_a_cusp);
    RUN(w4_far_away_and_late_the_phase_holds);
    RUN(the_pipelines_waves_are_these);
    RUN(w2_no_height_is_calm_and_bad_waves_are_refused);
    return check_result();
}
