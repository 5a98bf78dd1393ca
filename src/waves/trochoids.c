/* Waves of kind "gerstner": trochoids from the water's parameters. In: direction, lengths, height, steepness, a time;
 * out: wave vectors, phases and amplitudes. Invariant: no loops, and a phase that is exact to three roundings of its turns. */
#include "base/numbers.h"
#include "waves/wave_field.h"
#include "waves/wave_trains.h"

#include "base/own_float_state.h"

#include <stdio.h>

static const double gravity = 9.80665;

static double wave_length(const lom_water_waves *waves, int i)
{
    double place = (i + lom_random_uniform((uint64_t)waves->seed, 3 * (uint64_t)i)) / waves->count;
    return waves->length[0] * lom_double_pow(waves->length[1] / waves->length[0], place);
}

/* Equal slopes of all waves: a = c length, with half the sum of a^2 equal to the variance (height / 4)^2. */
static double amplitude_factor(const lom_water_waves *waves, const double *length)
{
    double sum = 0;
    for (int i = 0; i < waves->count; i++)
        sum += length[i] * length[i] / 2;
    return waves->height / 4 / lom_double_sqrt(sum);
}

static lom_trochoid choose_wave(const lom_water_waves *waves, int i, double length, double factor)
{
    uint64_t key = (uint64_t)waves->seed;
    double normal[2];
    lom_random_normal(key, 3 * (uint64_t)i + 1, normal);
    double angle = waves->direction + waves->spread * normal[0];
    lom_trochoid t = { .direction = { lom_double_cos(angle), lom_double_sin(angle) },
                       .number = lom_two_pi / length,
                       .rate = lom_double_sqrt(gravity * (lom_two_pi / length)),
                       .phase = lom_random_uniform(key, 3 * (uint64_t)i + 2),
                       .amplitude = factor * length };
    double bound = 1 / (waves->count * t.number);
    t.across = waves->steepness * (t.amplitude < bound ? t.amplitude : bound);
    return t;
}

static bool is_within(double x, double low, double high)
{
    return x >= low && x <= high;
}

static bool check_trochoids(const lom_water_waves *w, lom_error *error)
{
    if (w->count < 1 || w->count > LOM_MAX_WAVES)
        return lom_fail(error, LOM_ERROR_USAGE, "%d waves were asked for; there are 1 to %d.", w->count, LOM_MAX_WAVES);
    if (!is_within(w->length[1], 1e-3, w->length[0]) || !is_within(w->length[0], 1e-3, 1e5))
        return lom_fail(error, LOM_ERROR_USAGE,
                        "The lengths of waves go from 0.001 to 100000 metres, the longest first.");
    if (!is_within(w->height, 0, 100) || !is_within(w->steepness, 0, 1))
        return lom_fail(error, LOM_ERROR_USAGE, "Waves are 0 to 100 metres high and their steepness is 0 to 1.");
    if (!is_within(w->direction, -1e6, 1e6) || !is_within(w->spread, 0, 10))
        return lom_fail(error, LOM_ERROR_USAGE, "The direction of waves is a finite angle, their spread 0 to 10.");
    return true;
}

static int make_trochoids(const lom_water_waves *waves, lom_trochoid *out, lom_trochoid_report *report)
{
    int count = waves->height > 0 ? waves->count : 0;
    double length[LOM_MAX_WAVES];
    for (int i = 0; i < count; i++)
        length[i] = wave_length(waves, i);
    double factor = count > 0 ? amplitude_factor(waves, length) : 0;
    *report = (lom_trochoid_report){ .asked = 0 };
    for (int i = 0; i < count; i++) {
        out[i] = choose_wave(waves, i, length[i], factor);
        report->asked += waves->steepness * out[i].amplitude * out[i].number;
        report->steepness += out[i].across * out[i].number;
        report->limited += out[i].across < waves->steepness * out[i].amplitude;
    }
    return count;
}

int lom_make_trochoids(const lom_water_waves *waves, lom_trochoid out[LOM_MAX_WAVES], lom_trochoid_report *report,
                       lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_trochoid_report unread;
    if (!check_trochoids(waves, error))
        return -1;
    return make_trochoids(waves, out, report != NULL ? report : &unread);
}

/* Without whole turns, so that what follows is a small angle: both products are rounded in turns, 2^-53 of them, which
 * for waves of 8 m is below 1e-6 rad at 1e9 s. */
double lom_trochoid_phase(const lom_trochoid *t, double x, double z, double time)
{
    double turns = t->phase - t->rate * time / lom_two_pi;
    turns -= lom_double_floor(turns + 0.5);
    double along = t->number * (t->direction[0] * x + t->direction[1] * z) / lom_two_pi;
    return (turns + (along - lom_double_floor(along + 0.5))) * lom_two_pi;
}

lom_trochoid_point lom_trochoids_at(const lom_trochoid *trochoids, int count, double x, double z, double time)
{
    lom_trochoid_point p = { .place = { x, 0, z } };
    double sx = 0, sz = 0, xx = 0, zz = 0, xz = 0;
    for (int i = 0; i < count; i++) {
        const lom_trochoid *t = &trochoids[i];
        double phase = lom_trochoid_phase(t, x, z, time), s = lom_double_sin(phase), c = lom_double_cos(phase);
        double dx = t->direction[0], dz = t->direction[1], slope = t->number * t->amplitude * s;
        double narrowing = t->number * t->across * c;
        p.place[0] -= t->across * dx * s;
        p.place[1] += t->amplitude * c;
        p.place[2] -= t->across * dz * s;
        sx -= dx * slope;
        sz -= dz * slope;
        xx -= dx * dx * narrowing;
        zz -= dz * dz * narrowing;
        xz -= dx * dz * narrowing;
    }
    p.jacobian = (1 + xx) * (1 + zz) - xz * xz;
    /* The cross product of the tangents (xz, sz, 1 + zz) and (1 + xx, sx, xz). */
    double n[3] = { sz * xz - (1 + zz) * sx, p.jacobian, sx * xz - (1 + xx) * sz };
    double length = lom_double_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        p.normal[k] = length > 0 ? n[k] / length : k == 1;
    return p;
}

/* The derivatives of the displacement are the sum of -b k cos t times (d d^T), d the wave's direction: of its eigenvalues, whose
 * amounts add up to at most s = the sum of b k, the Jacobian (1 + l) (1 + m) is at least 1 - s. No foam is looked for where
 * floats cannot round that to the threshold. */
static bool may_break(const lom_water_foam *foam, double steepness)
{
    return foam->amount > 0 && foam->threshold > 1 - steepness - 1e-3;
}

void lom_fill_trochoids(struct lom_waves_uniform *out, const lom_water_waves *waves, const lom_water_foam *foam,
                        const double origin[2], double time)
{
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_trochoid_report report;
    double high = 0, reach = 0, longest = 0;
    out->trochoid_count = waves->kind == LOM_WAVES_GERSTNER ? make_trochoids(waves, trochoids, &report) : 0;
    for (int i = 0; i < out->trochoid_count; i++) {
        const lom_trochoid *t = &trochoids[i];
        double x = t->direction[0], z = t->direction[1];
        out->trochoid[i] =
            (struct lom_trochoid_uniform){ .kx = (float)(x * t->number),
                                           .kz = (float)(z * t->number),
                                           .phase = (float)lom_trochoid_phase(t, origin[0], origin[1], time),
                                           .amplitude = (float)t->amplitude,
                                           .across_x = (float)(x * t->across),
                                           .across_z = (float)(z * t->across) };
        for (int m = 0; m < LOM_FOAM_MOMENTS; m++) {
            double turn = t->rate * foam->window * m / LOM_FOAM_MOMENTS;
            out->trochoid[i].turn[m][0] = (float)lom_double_cos(turn);
            out->trochoid[i].turn[m][1] = (float)lom_double_sin(turn);
        }
        high += t->amplitude;
        reach += t->across;
        longest = t->number * longest < lom_two_pi ? lom_two_pi / t->number : longest;
    }
    out->period = (float)(LOM_WAVES_A_PERIOD * longest);
    bool breaks = out->trochoid_count > 0 && may_break(foam, report.steepness);
    out->foam_threshold = breaks ? (float)foam->threshold : 0;
    out->foam_window = (float)foam->window;
    out->highest = (float)(high * 1.0001);
    out->lowest = -out->highest;
    out->reach = (float)(reach * 1.0001);
}

double lom_trochoid_height(const struct lom_waves_uniform *waves, double x, double z)
{
    enum { STEPS = 12 }; /* to the place at rest that waves bring there; of the last one the height counts */
    double rest_x = x, rest_z = z, height = 0;
    for (int step = 0; step < STEPS; step++) {
        double dx = 0, dz = 0;
        for (int i = 0; i < waves->trochoid_count; i++) {
            const struct lom_trochoid_uniform *t = &waves->trochoid[i];
            double angle = (double)t->kx * rest_x + (double)t->kz * rest_z + (double)t->phase;
            const double s = lom_double_sin(angle);
            dx -= t->across_x * s;
            dz -= t->across_z * s;
            if (step + 1 == STEPS)
                height += t->amplitude * lom_double_cos(angle);
        }
        rest_x = x - dx;
        rest_z = z - dz;
    }
    return height;
}

/* ---- as a kind of waves ---- */

struct state {
    const struct lom_wave_site *site;
};

static bool exists(const struct lom_wave_source *source)
{
    return source->site->waves->kind == LOM_WAVES_GERSTNER;
}

static bool load(void *state, const struct lom_wave_source *source, lom_error *error)
{
    (void)error;
    *(struct state *)state = (struct state){ source->site };
    return true;
}

static void bound(const void *state, struct lom_waves_uniform *out, double time)
{
    const struct lom_wave_site *site = ((const struct state *)state)->site;
    const double from_middle[2] = { out->origin[0] - site->middle[0], out->origin[2] - site->middle[1] };
    lom_fill_trochoids(out, site->waves, site->foam, from_middle, time);
}

static double height(const void *state, const struct lom_waves_uniform *waves, double x, double z)
{
    (void)state;
    return lom_trochoid_height(waves, x - waves->origin[0], z - waves->origin[2]);
}

static void report(const void *state, const struct lom_wave_moment *moment, struct lom_wave_report *out)
{
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_trochoid_report steep;
    int count = make_trochoids(((const struct state *)state)->site->waves, trochoids, &steep);
    out->says = count > 0;
    out->runs = moment->why == NULL;
    if (moment->why != NULL)
        snprintf(out->text, sizeof out->text, "%s", moment->why);
    else if (steep.limited > 0)
        snprintf(out->text, sizeof out->text,
                 "%d trochoids; their steepness is %.3f, not %.3f: %d are held back, so that none can loop", count,
                 steep.steepness, steep.asked, steep.limited);
    else
        snprintf(out->text, sizeof out->text, "%d trochoids; their steepness is %.3f, and crests would loop above 1",
                 count, steep.steepness);
}

const struct lom_wave_kind lom_trochoid_waves = { .step = "waves",
                                                  .size = sizeof(struct state),
                                                  .exists = exists,
                                                  .load = load,
                                                  .bound = bound,
                                                  .height = height,
                                                  .stage = LOM_WAVES_AT_DRAWING,
                                                  .report = report };
