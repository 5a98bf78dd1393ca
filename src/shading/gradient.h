/* A sky without pictures, for the shaders of every model layer: from the horizon's colour to the zenith's, haze low
 * down, and a glow towards the sun. With y the sine of a direction's elevation (0 below the horizon): color =
 * mix(horizon, zenith, 1 - (1 - y)^3), then mixed with haze by (1 - y / haze_height)^2 below haze_height, and glow (0.3
 * c^4 + 0.7 c^32) added, c the cosine to the sun where it is above 0. Polynomials alone, so that every lane, and the
 * reference in double, computes the same function. */
#ifndef LOM_SHADING_GRADIENT_H
#define LOM_SHADING_GRADIENT_H

#include "shading/light.h"

struct lom_gradient_uniform {
    bool on;
    float zenith[3], horizon[3], haze[3], glow[3];
    float inverse_haze; /* 1 / haze_height */
    float to_light[3];
};

/* The radiance from a direction of unit length. */
LOM_INLINE lom_float3 lom_sky_gradient(const struct lom_gradient_uniform *sky, lom_float3 d)
{
    lom_float y = lom_saturate(d.y), under = 1.0f - y;
    lom_float low = lom_saturate(1.0f - y * sky->inverse_haze);
    lom_float3 color = lom_mix3(lom_uniform3(sky->horizon), lom_uniform3(sky->zenith), 1.0f - under * under * under);
    color = lom_mix3(color, lom_uniform3(sky->haze), low * low);
    lom_float c = lom_saturate(lom_dot3(d, lom_uniform3(sky->to_light)));
    lom_float c2 = c * c, c4 = c2 * c2, c8 = c4 * c4, c32 = c8 * c8 * (c8 * c8);
    return lom_add3(color, lom_scale3(lom_uniform3(sky->glow), 0.3f * c4 + 0.7f * c32));
}

#endif
