/* Phase functions. In: a kind and a cosine, or random numbers. Out: densities over the sphere, and cosines drawn from
 * them by inversion. */
#include "base/numbers.h"
#include "reference/vectors.h"

#include <lom/reference.h>

static const double FOUR_PI = 12.566370614359172;

static double bounded(double g)
{
    return lom_smaller(lom_larger(g, -0.999), 0.999);
}

static double henyey_greenstein(double g, double cosine)
{
    double distance = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (FOUR_PI * distance * lom_double_sqrt(distance));
}

double lom_phase_density(const lom_reference_phase *phase, double cosine)
{
    switch (phase->kind) {
    case LOM_PHASE_RAYLEIGH:
        return 0.75 * (1 + cosine * cosine) / FOUR_PI;
    case LOM_PHASE_HENYEY_GREENSTEIN:
        return henyey_greenstein(bounded(phase->forward), cosine);
    case LOM_PHASE_DUAL:
        return (1 - phase->blend) * henyey_greenstein(bounded(phase->forward), cosine) +
               phase->blend * henyey_greenstein(bounded(phase->backward), cosine);
    default:
        return 1 / FOUR_PI;
    }
}

/* Its distribution function inverted: cosine = (1 + g^2 - ((1 - g^2) / (1 - g + 2 g u))^2) / 2 g. */
static double draw_henyey_greenstein(double g, double u)
{
    if (__builtin_fabs(g) < 1e-6)
        return 2 * u - 1;
    double root = (1 - g * g) / (1 - g + 2 * g * u);
    return lom_smaller(lom_larger((1 + g * g - root * root) / (2 * g), -1), 1);
}

/* The root of c^3 + 3 c = 8 u - 4 by Cardano: a - 1/a with a^3 = q + sqrt(q^2 + 1), q = 4 u - 2. */
static double draw_rayleigh(double u)
{
    double q = 4 * u - 2, a = lom_double_cbrt(q + lom_double_sqrt(q * q + 1));
    return lom_smaller(lom_larger(a - 1 / a, -1), 1);
}

double lom_phase_cosine(const lom_reference_phase *phase, double uniform, double choice)
{
    switch (phase->kind) {
    case LOM_PHASE_RAYLEIGH:
        return draw_rayleigh(uniform);
    case LOM_PHASE_HENYEY_GREENSTEIN:
        return draw_henyey_greenstein(bounded(phase->forward), uniform);
    case LOM_PHASE_DUAL:
        return draw_henyey_greenstein(bounded(choice < phase->blend ? phase->backward : phase->forward), uniform);
    default:
        return 2 * uniform - 1;
    }
}
