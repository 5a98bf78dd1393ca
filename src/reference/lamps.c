/* Lamps. In: a lamp at a moment, a place. Out: what of its colours comes there (docs/lighting.md). */
#include "base/numbers.h"
#include "reference/reference.h"

/* 1 up to the last quarter of the reach, from there to 0. */
static double fade(double reach, double distance)
{
    const double t = unit_interval(4 * (1 - distance / reach));
    return t * t * (3 - 2 * t);
}

/* The cone's edge is where rounding of single precision puts it: a hundred-millionth outside. */
static double cone(const lom_lamp *lamp, double cosine)
{
    const double edge = lom_double_cos(lamp->cutoff) - 0x1p-24, full = lom_double_cos(lamp->cutoff - lamp->softness);
    if (!(cosine > edge))
        return 0;
    const double begun = lamp->softness == 0 ? 1 : unit_interval((cosine - edge) / lom_larger(full - edge, 0x1p-22));
    return begun * lom_double_pow(lom_larger(cosine, 0), lamp->exponent);
}

double lom_lamp_share_at(const struct lom_placed_lamp *lamp, lom_vec3 place, lom_vec3 *to_lamp, double *distance)
{
    const double *k = lamp->lamp->attenuation;
    *distance = 1e300;
    *to_lamp = scaled(lamp->direction, -1);
    if (lamp->lamp->kind == LOM_LAMP_INFINITE)
        return 1;
    const lom_vec3 way = difference(lamp->position, place);
    *distance = length(way);
    *to_lamp = unit(way);
    if (*distance >= lamp->reach)
        return 0;
    double share = fade(lamp->reach, *distance) / lom_larger(k[0] + *distance * (k[1] + *distance * k[2]), 1e-6);
    if (lamp->lamp->kind == LOM_LAMP_SPOT)
        share *= cone(lamp->lamp, -dot(*to_lamp, lamp->direction));
    return share;
}
