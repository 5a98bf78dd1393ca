/* Proves clouds whose shapes change: a closed form of the time that is a field itself at whole phases, comes round, and
 * keeps mean and variance between; clouds swell about their own detail and never beyond 0.95. And the flat cloud: clear
 * at its border, opaque in its middle, gray, another with another seed. */
#include "check.h"

#include "cloud/cloud_draw.h"
#include <lom/cloud.h>

#include <math.h>

enum { VOXELS = LOM_DETAIL_SIZE * LOM_DETAIL_SIZE * LOM_DETAIL_SIZE, CLOUDS = 3 };

static lom_clouds params = { .evolve = 60, .swell = 0.5 };
static lom_cloud clouds[CLOUDS];
static struct lom_cloud_set *set;

static void load_set(void)
{
    lom_error error = { 0 };
    for (int i = 0; i < CLOUDS; i++)
        clouds[i] = (lom_cloud){ .kind = "cumulus_humilis",
                                 .voxels = { 8, 8, 8 },
                                 .size = { 100, 100, 100 },
                                 .density = 1,
                                 .extinction = 0.03,
                                 .detail = 0.35,
                                 .detail_size = 50,
                                 .visible = true };
    const struct lom_cloud_quality quality = { .error = 0.05, .stop = 0.004, .light_scale = 0.5, .octaves = 4 };
    CHECK(lom_load_cloud_set(clouds, CLOUDS, &params, &quality, NULL, NULL, &set, &error) && set->count == CLOUDS, "%s",
          error.text);
}

static void phases(void)
{
    const lom_clouds still = { .evolve = 0 }, moving = { .evolve = 10 };
    CHECK(lom_cloud_phase_at(&still, 123) == 0, "what does not change");
    for (int n = -7; n <= 7; n++)
        CHECK(lom_cloud_phase_at(&moving, 10.0 * n) == n, "%d: %g", n, lom_cloud_phase_at(&moving, 10.0 * n));
    double before = -1e9;
    for (double time = -20; time < 20; time += 0.013) {
        double phase = lom_cloud_phase_at(&moving, time);
        CHECK(phase <= time / 10 && phase > time / 10 - 1.0 / 256 - 1e-12 && phase >= before, "%g: %g", time, phase);
        before = phase;
    }
}

/* The noise of the set at a time, voxel by voxel: the lowest corner of each cell. */
static void noise_at(double time, uint8_t *voxels)
{
    lom_error error = { 0 };
    CHECK(lom_evolve_clouds(set, time, &error), "%s", error.text);
    for (int i = 0; i < VOXELS; i++)
        voxels[i] = (uint8_t)((uint32_t)set->detail->corners[2 * i] & 255);
}

static void moments(const uint8_t *voxels, double *mean, double *variance)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < VOXELS; i++) {
        sum += voxels[i];
        squares += (double)voxels[i] * voxels[i];
    }
    *mean = sum / VOXELS;
    *variance = squares / VOXELS - *mean * *mean;
}

/* At n crossfades it is field n modulo LOM_DETAIL_FIELDS and nothing else, also before 0. */
static void whole_phases_are_fields(void)
{
    static uint8_t voxels[VOXELS];
    for (int n = -4; n <= 5; n++) {
        noise_at(params.evolve * n, voxels);
        int field = ((n % LOM_DETAIL_FIELDS) + LOM_DETAIL_FIELDS) % LOM_DETAIL_FIELDS;
        CHECK(memcmp(voxels, set->fields[field]->pixels, VOXELS) == 0, "phase %d is not field %d", n, field);
    }
}

static void mean_and_variance_are_kept(void)
{
    static uint8_t voxels[VOXELS];
    double mean, variance, mean_ab[2], variance_ab[2];
    for (int i = 0; i < 2; i++)
        moments(set->fields[i]->pixels, &mean_ab[i], &variance_ab[i]);
    for (int i = 1; i < 8; i++) {
        double angle = acos(-1) / 2 * i / 8, c = cos(angle), s = sin(angle);
        noise_at(params.evolve * i / 8, voxels);
        moments(voxels, &mean, &variance);
        /* independent fields: their covariance is small, rounding adds 1/12 and clipping takes a little */
        double expected = variance_ab[0] * c * c + variance_ab[1] * s * s;
        CHECK(fabs(mean - mean_ab[0]) < 0.6, "phase %d of 8: mean %g, not %g", i, mean, mean_ab[0]);
        CHECK(fabs(variance - expected) < 0.1 * expected, "phase %d of 8: variance %g, not %g", i, variance, expected);
        CHECK(memcmp(voxels, set->fields[0]->pixels, VOXELS) != 0, "nothing changed");
    }
}

/* Any time alone is that time in a run; the same phase again is no work. */
static void any_time_alone(void)
{
    static uint8_t alone[VOXELS], again[VOXELS];
    noise_at(77.7, alone);
    const lom_detail *detail = set->detail;
    noise_at(77.71, again);
    CHECK(set->detail == detail, "made again for the same phase");
    for (double time = 0; time < 77; time += 11)
        noise_at(time, again);
    noise_at(77.7, again);
    CHECK(memcmp(alone, again, VOXELS) == 0, "another way gave another noise");
}

static void clouds_swell(void)
{
    static uint8_t voxels[VOXELS];
    double low[CLOUDS] = { 9, 9, 9 }, high[CLOUDS] = { 0 };
    bool apart = false;
    for (int i = 0; i < 64; i++) { /* two crossfades are one breath */
        noise_at(params.evolve * i / 32, voxels);
        for (int k = 0; k < CLOUDS; k++) {
            double detail = set->clouds[k].detail;
            low[k] = fmin(low[k], detail);
            high[k] = fmax(high[k], detail);
        }
        apart |= set->clouds[0].detail != set->clouds[1].detail;
    }
    for (int k = 0; k < CLOUDS; k++)
        CHECK(fabs(low[k] - 0.175) < 0.002 && fabs(high[k] - 0.525) < 0.002, "cloud %d from %g to %g", k, low[k],
              high[k]);
    CHECK(apart, "all clouds breathe together");
    clouds[0].detail = 0.9;
    for (int i = 0; i < 64; i++) {
        noise_at(params.evolve * i / 32, voxels);
        CHECK(set->clouds[0].detail <= 0.95, "%g", set->clouds[0].detail);
    }
    clouds[0].detail = 0.35;
}

static void what_does_not_evolve_stays(void)
{
    static uint8_t voxels[VOXELS], after[VOXELS];
    noise_at(params.evolve / 2, voxels);
    double evolve = params.evolve;
    params.evolve = 0;
    noise_at(12345, after);
    params.evolve = evolve;
    CHECK(memcmp(voxels, after, VOXELS) == 0, "changed");
}

/* ---- the flat cloud ---- */

static void flat_cloud(void)
{
    enum { SIDE = 64 };
    lom_image *one = lom_make_cloud_picture(SIDE, 1, NULL), *same = lom_make_cloud_picture(SIDE, 1, NULL);
    lom_image *other = lom_make_cloud_picture(SIDE, 2, NULL);
    CHECK(lom_hash_image(one) == lom_hash_image(same) && lom_hash_image(one) != lom_hash_image(other), "seeds");
    double inside = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const uint8_t *p = lom_image_pixel(one, x, y, 0);
            CHECK(p[0] == p[1] && p[1] == p[2], "%d,%d is not gray", x, y);
            if (x == 0 || y == 0 || x == SIDE - 1 || y == SIDE - 1)
                CHECK(p[3] == 0, "the border at %d,%d has opacity %d", x, y, p[3]);
            if (abs(2 * x - SIDE) < SIDE / 4 && y > SIDE / 3 && y < SIDE / 2)
                inside += p[3] / 255.0 / (SIDE / 4 - 1) / (SIDE / 2 - SIDE / 3 - 1);
        }
    CHECK(inside > 0.7 && inside <= 1.001, "mean opacity in the middle %g", inside);
    lom_free_image(one);
    lom_free_image(same);
    lom_free_image(other);
    for (int i = 0; i < 2; i++) {
        lom_error error = { 0 };
        CHECK(lom_make_cloud_picture(i ? 7 : 1025, 1, &error) == NULL && error.code == LOM_ERROR_USAGE, "%s",
              error.text);
    }
}

int main(int argc, char **argv)
{
    load_set();
    if (set == NULL)
        return 1;
    RUN(phases);
    RUN(whole_phases_are_fields);
    RUN(mean_and_variance_are_kept);
    RUN(any_time_alone);
    RUN(clouds_swell);
    RUN(what_does_not_evolve_stays);
    RUN(flat_cloud);
    lom_free_cloud_set(set);
    return check_result();
}
