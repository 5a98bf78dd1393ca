/* What the tests of fluids ask of one: sums over its particles, and how it is run. */
#ifndef LOM_TESTS_FLUID_STATE_H
#define LOM_TESTS_FLUID_STATE_H

#include "check.h"

#include <lom/fluid.h>

static const double earth = 9.80665;

static inline lom_fluid *make_fluid(const lom_fluid_desc *desc)
{
    lom_error error = { 0 };
    lom_fluid *fluid = lom_create_fluid(desc, &error);
    if (fluid == NULL) {
        printf("  %s\n", error.text);
        exit(1);
    }
    return fluid;
}

static inline void run_fluid(lom_fluid *fluid, int steps)
{
    lom_error error = { 0 };
    for (int i = 0; i < steps; i++)
        if (!lom_step_fluid(fluid, NULL, &error)) {
            printf("  %s\n", error.text);
            exit(1);
        }
}

/* Means over particles. */
struct fluid_sums {
    double position[3], velocity[3], temperature;
    double kinetic, height_energy; /* m^2/s^2, under earth's gravity */
    double high[3], fastest;
};

static inline struct fluid_sums sum_fluid(const lom_fluid *fluid)
{
    struct fluid_sums s = { .high = { -1e9, -1e9, -1e9 } };
    const size_t count = lom_view_fluid(fluid).particles;
    for (size_t i = 0; i < count; i++) {
        const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
        double square = 0;
        for (int axis = 0; axis < 3; axis++) {
            s.position[axis] += p.position[axis] / (double)count;
            s.velocity[axis] += p.velocity[axis] / (double)count;
            s.high[axis] = p.position[axis] > s.high[axis] ? p.position[axis] : s.high[axis];
            square += p.velocity[axis] * p.velocity[axis];
        }
        s.temperature += p.temperature / (double)count;
        s.kinetic += square / 2 / (double)count;
        s.height_energy += earth * p.position[1] / (double)count;
        s.fastest = square > s.fastest * s.fastest ? lom_double_sqrt(square) : s.fastest;
    }
    return s;
}

static inline double magnitude(double x)
{
    return x < 0 ? -x : x;
}

#endif
