/* Haze: air between the eye and a surface, for the shaders of every model layer.
 *
 * The air's extinction is density below the height `base` and falls as density exp(-(y - base) / height) above it. With
 * G the antiderivative of that profile over y, the optical depth of a straight path of length d from y0 to y1 is
 * d (G(y1) - G(y0)) / (y1 - y0) (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006 course). In a mirrored
 * view, whose eye lies below the mirror at height m, the path really runs from the eye above it down to m and up again:
 * the integral is G(y1) - G(m) + G(2 m - y0) - G(m), so only the constant that stands for G(y0) differs. The paths of
 * parallel rays start at heights of their own. */
#ifndef LOM_SHADING_HAZE_H
#define LOM_SHADING_HAZE_H

#include "shading/eye.h"
#include "shading/light.h"

struct lom_haze_uniform {
    float density[3];     /* extinction a metre, red, green, blue; all 0: no haze */
    float color[3];       /* light that the air scatters towards the eye where nothing is seen through it */
    float glow[3];        /* what is added to it towards the sun */
    float glow_exponent;  /* on the cosine to the sun */
    float base;           /* metres over the eye */
    float inverse_height; /* 1 / m; 0: the same at every height */
    float height;         /* metres */
    float start;          /* G at the eye, or what stands for it in a mirrored view */
    float mirror;         /* m, metres over the eye */
    bool mirrored;
    bool on, gray; /* gray: one density for all colours */
};

/* G(y) / 1 m, y over the eye: y - base below the base, height (1 - exp(-(y - base) / height)) above. */
LOM_INLINE lom_float lom_haze_integral(const struct lom_haze_uniform *haze, lom_float y)
{
    lom_float above = lom_max(y - haze->base, (lom_float){ 0 }), below = lom_min(y - haze->base, (lom_float){ 0 });
    return below + haze->height * (1.0f - lom_fade(-above * haze->inverse_height));
}

/* The mean of the profile over the path from the eye to a surface that much higher. Where the path is nearly level the
 * quotient loses its digits, and the profile at the middle is within (rise / height)^2 / 24 of the mean. */
LOM_INLINE lom_float lom_haze_mean(const struct lom_haze_uniform *haze, lom_float rise)
{
    if (haze->inverse_height == 0)
        return lom_splat(1.0f);
    lom_mask level = lom_abs(rise) < haze->height * 0x1p-9f;
    lom_float quotient = (lom_haze_integral(haze, rise) - haze->start) / lom_select(level, lom_splat(1.0f), rise);
    lom_float middle = lom_max(0.5f * rise - haze->base, (lom_float){ 0 });
    return lom_select(level, lom_fade(-middle * haze->inverse_height), quotient);
}

/* The same where paths of parallel rays, that much higher at their ends, end at the height y over the eye. */
LOM_INLINE lom_float lom_haze_mean_below(const struct lom_haze_uniform *haze, lom_float y, lom_float rise)
{
    if (haze->inverse_height == 0)
        return lom_splat(1.0f);
    lom_float from = y - rise, start;
    if (haze->mirrored)
        start = 2.0f * lom_haze_integral(haze, lom_splat(haze->mirror)) -
                lom_haze_integral(haze, 2.0f * haze->mirror - from);
    else
        start = lom_haze_integral(haze, from);
    lom_mask level = lom_abs(rise) < haze->height * 0x1p-9f;
    lom_float quotient = (lom_haze_integral(haze, y) - start) / lom_select(level, lom_splat(1.0f), rise);
    lom_float middle = lom_max(y - 0.5f * rise - haze->base, (lom_float){ 0 });
    return lom_select(level, lom_fade(-middle * haze->inverse_height), quotient);
}

/* A colour at an offset, the end of a path from the eye, as it sees it: color T + air (1 - T), T = exp(-optical
 * depth). */
LOM_INLINE lom_float3 lom_apply_haze(const struct lom_haze_uniform *haze, const struct lom_eye_uniform *eye,
                                     const float to_light[3], lom_float3 offset, lom_float3 color)
{
    if (!haze->on)
        return color;
    lom_float3 path = lom_eye_path(eye, offset);
    lom_float length = lom_sqrt(lom_dot3(path, path));
    lom_float mean = eye->parallel ? lom_haze_mean_below(haze, offset.y, path.y) : lom_haze_mean(haze, path.y);
    lom_float amount = length * mean;
    lom_float3 clear;
    clear.x = lom_fade(-amount * haze->density[0]);
    clear.y = haze->gray ? clear.x : lom_fade(-amount * haze->density[1]);
    clear.z = haze->gray ? clear.x : lom_fade(-amount * haze->density[2]);
    lom_float3 air = lom_uniform3(haze->color);
    if (haze->glow[0] != 0 || haze->glow[1] != 0 || haze->glow[2] != 0) {
        lom_float cosine = lom_dot3(path, lom_uniform3(to_light)) / lom_max(length, lom_splat(1e-30f));
        lom_float towards = lom_clamp(cosine, lom_splat(1e-6f), lom_splat(1.0f));
        air = lom_add3(air, lom_scale3(lom_uniform3(haze->glow), lom_pow(towards, lom_splat(haze->glow_exponent))));
    }
    LOM_NAME_AS(haze_clear, clear);
    LOM_NAME_AS(haze_light, lom_mul3(air, lom_sub3(lom_splat3(1, 1, 1), clear)));
    return lom_add3(air, lom_mul3(lom_sub3(color, air), clear));
}

#endif
