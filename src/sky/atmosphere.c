/* The clear sky. In: where the sun stands and how hazy it is; out: radiance by direction. Single scattering (Nishita et
 * al. 1993) along rays from sea level; because heights decide everything, the light arriving at a point of a ray
 * depends on its height alone, and a table over the ray's elevation holds all integrals (coefficients: Bruneton, Neyret
 * 2008). Invariant: what is scattered out of the sun's light is never more than that light. */
#include "base/numbers.h"
#include "sky/atmosphere.h"

#include "geometry/noise.h"

static const double planet = 6360e3, top = 6420e3;                    /* radii, metres */
static const double air_scattering[3] = { 5.8e-6, 13.5e-6, 33.1e-6 }; /* 1/m at 680, 550, 440 nm, at sea level */
static const double haze_scattering = 4.0e-6, air_height = 8000, haze_height = 1200; /* 1/m; scale heights, m */
static const double ozone_absorption[3] = { 0.650e-6, 1.881e-6, 0.085e-6 };

typedef struct densities {
    double air, haze, ozone;
} densities;

static densities densities_at(double height)
{
    double h = height > 0 ? height : 0;
    double layer = 1.0 - (h > 25e3 ? h - 25e3 : 25e3 - h) / 15e3;
    return (densities){ lom_double_exp(-h / air_height), lom_double_exp(-h / haze_height), layer > 0 ? layer : 0 };
}

/* From radius r in a direction whose cosine to the zenith is c: how far to the top of the atmosphere. */
static double distance_to_top(double r, double c)
{
    double inside = r * r * (c * c - 1) + top * top;
    return lom_double_sqrt(inside > 0 ? inside : 0) - r * c;
}

static densities optical_depth(double r, double c)
{
    enum { STEPS = 24 };
    densities sum = { 0 };
    double length = distance_to_top(r, c) / STEPS;
    for (int i = 0; i < STEPS; i++) {
        double t = (i + 0.5) * length;
        densities d = densities_at(lom_double_sqrt(r * r + t * t + 2 * r * t * c) - planet);
        sum.air += d.air * length;
        sum.haze += d.haze * length;
        sum.ozone += d.ozone * length;
    }
    return sum;
}

static void transmittance(densities depth, double haziness, double part[3])
{
    for (int k = 0; k < 3; k++)
        part[k] = lom_double_exp(-(air_scattering[k] * depth.air + 1.1 * haziness * haze_scattering * depth.haze +
                                   ozone_absorption[k] * depth.ozone));
}

static void integrate(lom_atmosphere *a, int row, double haziness)
{
    enum { STEPS = 32 };
    double sine = (double)row * row / ((double)LOM_SKY_STEPS * LOM_SKY_STEPS);
    double length = distance_to_top(planet + 500, sine);
    densities seen = { 0 };
    for (int i = 0; i < STEPS; i++) {
        double from = length * i * i / (STEPS * STEPS), to = length * (i + 1) * (i + 1) / (STEPS * STEPS);
        double r0 = planet + 500, t = 0.5 * (from + to), step = to - from;
        double r = lom_double_sqrt(r0 * r0 + t * t + 2 * r0 * t * sine);
        densities d = densities_at(r - planet);
        densities sun = optical_depth(r, a->sun.y);
        densities half = { seen.air + 0.5 * d.air * step, seen.haze + 0.5 * d.haze * step,
                           seen.ozone + 0.5 * d.ozone * step };
        densities both = { half.air + sun.air, half.haze + sun.haze, half.ozone + sun.ozone };
        double arriving[3], view[3];
        transmittance(both, haziness, arriving);
        transmittance(half, haziness, view);
        for (int k = 0; k < 3; k++) {
            a->air[row][k] += arriving[k] * air_scattering[k] * d.air * step;
            a->haze[row][k] += arriving[k] * haziness * haze_scattering * d.haze * step;
            a->around[row][k] += view[k] * (air_scattering[k] * d.air + haziness * haze_scattering * d.haze) * step;
        }
        seen.air += d.air * step;
        seen.haze += d.haze * step;
        seen.ozone += d.ozone * step;
    }
}

void lom_fill_atmosphere(lom_atmosphere *atmosphere, lom_vec3 sun, double haziness)
{
    *atmosphere = (lom_atmosphere){ .sun = sun };
    for (int row = 0; row <= LOM_SKY_STEPS; row++)
        integrate(atmosphere, row, haziness);
    transmittance(optical_depth(planet + 3000, sun.y), haziness, atmosphere->sunlight);
}

static double look_up(const double table[LOM_SKY_STEPS + 1][3], double place, int k)
{
    int row = place < LOM_SKY_STEPS - 1 ? lom_int_of(place) : LOM_SKY_STEPS - 1;
    return lom_mix_double(table[row][k], table[row + 1][k], place - row);
}

void lom_atmosphere_at(const lom_atmosphere *atmosphere, lom_vec3 direction, double radiance[3])
{
    const double g = 0.78; /* Henyey and Greenstein's asymmetry of haze */
    const lom_vec3 sun = atmosphere->sun;
    double cosine = lom_clamp_double(direction.x * sun.x + direction.y * sun.y + direction.z * sun.z, -1, 1);
    double air_phase = 3.0 / (16.0 * lom_pi) * (1.0 + cosine * cosine);
    double base = 1.0 + g * g - 2.0 * g * cosine;
    double haze_phase = (1.0 - g * g) / (4.0 * lom_pi * base * lom_double_sqrt(base));
    double sine = lom_clamp_double(direction.y, 0, 1);
    double place = LOM_SKY_STEPS * lom_double_sqrt(sine);
    for (int k = 0; k < 3; k++) {
        double many = 0.045 * atmosphere->sunlight[k] * lom_smooth_step(-0.1, 0.5, sun.y + 0.1);
        radiance[k] = air_phase * look_up(atmosphere->air, place, k) +
                      haze_phase * look_up(atmosphere->haze, place, k) + many * look_up(atmosphere->around, place, k);
    }
}
