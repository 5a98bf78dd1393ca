/* Light on its way through water, over lanes. In: how far, from which depth, and how steeply down. Out: what is left of the
 * light that went in, and what the water adds. */
#ifndef LOM_WATER_WATER_COLUMN_H
#define LOM_WATER_WATER_COLUMN_H

#include "water/surface.h"

#include <lom/lanes_mathematics.h>

/* As long as no ray of a scene is. */
static const float endless = 0x1p100f;

/* What `length` metres of water along d, from `depth` metres below the surface on, leave of the light that enters them,
 * and what they add to it: each metre takes a share a, and adds source a e^(-a slant depth there), the sunlight that
 * reaches it; `sun` of it is there at `depth`. */
struct lom_crossed {
    lom_float left, added;
};

/* The exponent of what is left. */
LOM_INLINE lom_float lom_water_fall(float a, float slant, lom_float length, lom_float depth, lom_float down)
{
    lom_float bed = lom_max(depth + down * length, (lom_float){ 0 });
    return -a * (length + slant * bed);
}

/* Where all lanes look far, as over water without a bed, both exponentials are known: from 105 on lom_expm1(-x) is -1, and
 * from 87 on lom_fade(-x) is 0. */
LOM_INLINE lom_float lom_water_left(lom_float fall)
{
    lom_float left = { 0 };
    if (!lom_all(fall <= -87.0f))
        left = lom_fade(fall);
    return left;
}

LOM_INLINE lom_float lom_water_added(float a, float source, float slant, lom_float sun, lom_float length,
                                     lom_float down)
{
    lom_float rate = 1.0f + slant * down, exponent = a * length * rate, inner = 1.0f / rate;
    if (!lom_all(exponent >= 105.0f))
        inner = lom_select(lom_abs(exponent) > 1e-4f, -lom_expm1(-exponent) / rate, a * length);
    return source * sun * inner;
}

LOM_INLINE struct lom_crossed lom_through_water(float a, float source, float slant, lom_float sun, lom_float length,
                                                lom_float depth, lom_float down)
{
    return (struct lom_crossed){ lom_water_left(lom_water_fall(a, slant, length, depth, down)),
                                 lom_water_added(a, source, slant, sun, length, down) };
}

/* From the surface down, when `beyond` went in at the other end. */
LOM_INLINE lom_float3 lom_cross_water(const struct lom_medium_uniform *m, lom_float3 beyond, lom_float length,
                                      lom_float down)
{
    lom_float l = lom_min(length, lom_splat(endless)), sun = lom_splat(1.0f);
    struct lom_crossed c[3];
    for (int i = 0; i < 3; i++)
        c[i] = lom_through_water(m->absorption[i], m->source[i], m->slant, sun, l, (lom_float){ 0 }, down);
    return (lom_float3){ beyond.x * c[0].left + c[0].added, beyond.y * c[1].left + c[1].added,
                         beyond.z * c[2].left + c[2].added };
}

#endif
