/* Air that scatters. In: a way through it. Out: what is left of the light at its end, and the light that the air adds:
 * T light + air (1 - T), T = exp(-optical depth). The extinction is density below the height `base` and density
 * exp(-(y - base) / height) above it, whose integral along a straight way is closed (C. Wenzel, "Real-time atmospheric
 * effects in games", SIGGRAPH 2006 course). */
#include "base/numbers.h"
#include "reference/reference.h"

/* The antiderivative of the profile over y. */
static double integral(const lom_haze *haze, double y)
{
    double above = y - haze->base;
    return above <= 0 ? above : -haze->height * lom_double_expm1(-above / haze->height);
}

/* The mean of the profile between two heights. Where they are close the quotient loses its digits, and the profile in
 * the middle is within (rise / height)^2 / 24 of the mean. */
static double mean_profile(const lom_haze *haze, double from, double to)
{
    if (!(haze->height > 0))
        return 1;
    if (__builtin_fabs(to - from) < 1e-4 * haze->height)
        return lom_double_exp(-lom_larger((from + to) / 2 - haze->base, 0) / haze->height);
    return (integral(haze, to) - integral(haze, from)) / (to - from);
}

lom_vec3 lom_light_through_haze(const lom_reference *reference, const struct lom_ray *ray, double far, lom_vec3 light)
{
    const lom_haze *haze = &reference->scene->haze;
    if (!haze->present || !(far < 1e300))
        return light;
    double way = far * mean_profile(haze, ray->origin.y, ray->origin.y + far * ray->direction.y);
    double cosine = lom_larger(dot(ray->direction, reference->to_light), 0);
    double glow = cosine > 0 ? lom_double_exp(haze->glow_exponent * lom_double_log(cosine)) : 0;
    double *channel[3] = { &light.x, &light.y, &light.z };
    for (int i = 0; i < 3; i++) {
        double clear = lom_double_exp(-way * haze->density[i]), air = haze->color[i] + haze->glow[i] * glow;
        *channel[i] = air + (*channel[i] - air) * clear;
    }
    return light;
}
