/* Optics in double: the twin that the lanes are tested against, and the optical properties of named waters. In:
 * cosines, directions, names; out: reflectance, refracted rays, coefficients. */
#include "water/optics.h"

#include <lom/water.h>

#include <string.h>

double lom_fresnel_schlick_double(double cosine, double eta)
{
    double root = (eta - 1) / (eta + 1), r = root * root, x = 1 - cosine;
    return r + (1 - r) * x * x * x * x * x;
}

double lom_fresnel_exact_double(double cosine, double eta)
{
    double sine = eta * lom_double_sqrt((1 - cosine) * (1 + cosine));
    if (!(sine < 1))
        return 1;
    double t = lom_double_sqrt((1 - sine) * (1 + sine));
    double s = (eta * cosine - t) / (eta * cosine + t), p = (cosine - eta * t) / (cosine + eta * t);
    return 0.5 * (s * s + p * p);
}

bool lom_refract_double(lom_vec3 d, lom_vec3 n, double eta, lom_vec3 *refracted)
{
    double cosine = -lom_vec3_dot(d, n);
    lom_vec3 side = cosine < 0 ? lom_vec3_scale(n, -1) : n;
    double ratio = cosine < 0 ? 1 / eta : eta, c = cosine < 0 ? -cosine : cosine;
    double square = 1 - ratio * ratio * (1 - c * c);
    *refracted = d;
    if (!(square >= 0))
        return false;
    *refracted = lom_vec3_add(lom_vec3_scale(d, ratio), lom_vec3_scale(side, ratio * c - lom_double_sqrt(square)));
    return true;
}

/* ---- named waters ---- */

struct water_optics {
    double absorption[3]; /* at 650, 550 and 475 nm, 1/m */
    double particles;     /* light that particles scatter back, 1/m at 550 nm, falling as 1/wavelength; ours */
};

static const struct water_optics waters[LOM_WATER_TYPE_COUNT] = {
    [LOM_WATER_PURE] = { { 0.340, 0.0565, 0.0114 }, 0 }, [LOM_WATER_I] = { { 0.36, 0.063, 0.018 }, 0.0002 },
    [LOM_WATER_IA] = { { 0.37, 0.067, 0.025 }, 0.0005 }, [LOM_WATER_IB] = { { 0.375, 0.072, 0.033 }, 0.001 },
    [LOM_WATER_II] = { { 0.40, 0.089, 0.062 }, 0.003 },  [LOM_WATER_III] = { { 0.445, 0.12, 0.116 }, 0.006 },
    [LOM_WATER_1C] = { { 0.45, 0.12, 0.17 }, 0.008 },    [LOM_WATER_3C] = { { 0.46, 0.19, 0.29 }, 0.014 },
    [LOM_WATER_5C] = { { 0.54, 0.30, 0.43 }, 0.025 },    [LOM_WATER_7C] = { { 0.63, 0.46, 0.71 }, 0.045 },
};

void lom_water_type_optics(lom_water_type type, double absorption[3], double scatter[3])
{
    static const double wavelength[3] = { 650, 550, 475 };
    const struct water_optics *water = &waters[type < LOM_WATER_TYPE_COUNT ? type : LOM_WATER_II];
    for (int i = 0; i < 3; i++) {
        double molecules = 0.5 * 0.00288 * lom_double_pow(wavelength[i] / 500, -4.32);
        double back = molecules + water->particles * 550 / wavelength[i];
        absorption[i] = water->absorption[i];
        scatter[i] = 0.33 * back / water->absorption[i];
    }
}
