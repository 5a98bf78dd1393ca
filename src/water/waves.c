/* Trochoids from the water's parameters. In: direction, lengths, height, steepness, a time; out: wave vectors, phases
 * and amplitudes. Invariant: no loops, and a phase that is exact to 1e-6 at any time. */
#include "water/waves.h"

static const double turn = 6.283185307179586, gravity = 9.80665;

struct wave {
    double length, angle, phase, number;
};

static struct wave choose_wave(const lom_water_waves *waves, int i)
{
    uint64_t key = (uint64_t)waves->seed;
    double normal[2], place = (i + lom_random_uniform(key, 3 * (uint64_t)i)) / waves->count;
    lom_random_normal(key, 3 * (uint64_t)i + 1, normal);
    struct wave w = { .length = waves->length[0] * lom_double_pow(waves->length[1] / waves->length[0], place),
                      .angle = waves->direction + waves->spread * normal[0],
                      .phase = lom_random_uniform(key, 3 * (uint64_t)i + 2) };
    w.number = turn / w.length;
    return w;
}

/* Equal slopes of all waves: a = c length, with half the sum of a^2 equal to the variance (height / 4)^2. */
static double amplitude_factor(const lom_water_waves *waves)
{
    double sum = 0;
    for (int i = 0; i < waves->count; i++) {
        double length = choose_wave(waves, i).length;
        sum += length * length / 2;
    }
    return waves->height / 4 / lom_double_sqrt(sum);
}

void lom_fill_trochoids(struct lom_waves_uniform *out, const lom_water_params *water, double time)
{
    const lom_water_waves *waves = &water->waves;
    double high = 0, reach = 0;
    out->level = (float)water->level;
    out->trochoid_count = waves->kind == LOM_WAVES_GERSTNER && waves->height > 0 ? waves->count : 0;
    double factor = out->trochoid_count > 0 ? amplitude_factor(waves) : 0;
    for (int i = 0; i < out->trochoid_count; i++) {
        struct wave w = choose_wave(waves, i);
        double amplitude = factor * w.length, bound = 1 / (waves->count * w.number);
        double across = waves->steepness * (amplitude < bound ? amplitude : bound);
        double rate = lom_double_sqrt(gravity * w.number), turns = w.phase - rate * time / turn;
        double x = lom_double_cos(w.angle), z = lom_double_sin(w.angle);
        turns -= lom_double_floor(turns + 0.5);
        out->trochoid[i] = (struct lom_trochoid_uniform){ .kx = (float)(x * w.number),
                                                          .kz = (float)(z * w.number),
                                                          .phase = (float)(turns * turn),
                                                          .amplitude = (float)amplitude,
                                                          .across_x = (float)(x * across),
                                                          .across_z = (float)(z * across),
                                                          .rate = (float)rate };
        high += amplitude;
        reach += across;
    }
    bool breaks = out->trochoid_count > 0 && water->foam.amount > 0;
    out->foam_threshold = breaks ? (float)water->foam.threshold : 0;
    out->foam_window = (float)water->foam.window;
    out->highest = (float)(high * 1.0001);
    out->lowest = -out->highest;
    out->reach = (float)(reach * 1.0001);
}

double lom_trochoid_height(const struct lom_waves_uniform *waves, double x, double z)
{
    double rest_x = x, rest_z = z, height = 0;
    for (int step = 0; step < 12; step++) {
        double dx = 0, dz = 0;
        height = 0;
        for (int i = 0; i < waves->trochoid_count; i++) {
            const struct lom_trochoid_uniform *t = &waves->trochoid[i];
            double angle = (double)t->kx * rest_x + (double)t->kz * rest_z + (double)t->phase;
            dx -= t->across_x * lom_double_sin(angle);
            dz -= t->across_z * lom_double_sin(angle);
            height += t->amplitude * lom_double_cos(angle);
        }
        rest_x = x - dx;
        rest_z = z - dz;
    }
    return height;
}

void lom_fill_flow_phases(struct lom_flow_uniform *flow, double speed, double tile, double time)
{
    double period = speed > 0 ? tile / (3 * speed) : 1, weight[2];
    for (int i = 0; i < 2; i++) {
        double cycles = time / period + 0.5 * i, whole = lom_double_floor(cycles), share = cycles - whole;
        double jump[2] = { 0.381966 * whole + 0.5 * i, 0.618034 * whole };
        weight[i] = share < 0.5 ? 2 * share : 2 - 2 * share;
        flow->drift[i] = (float)(speed * period * (share - 0.5));
        for (int k = 0; k < 2; k++)
            flow->jump[i][k] = (float)(jump[k] - lom_double_floor(jump[k]));
    }
    double norm = lom_double_sqrt(weight[0] * weight[0] + weight[1] * weight[1]);
    flow->weight[0] = (float)(weight[0] / norm);
    flow->weight[1] = (float)(weight[1] / norm);
}
