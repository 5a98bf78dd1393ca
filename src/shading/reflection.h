/* Models of reflection, a row each: what a surface makes of the cosine to a light, and its highlight. Each is a function
 * of unit vectors, with 0 where the light is behind the surface. In a vertex shader they are per vertex, in a fragment
 * shader per fragment. */
#ifndef LOM_SHADING_REFLECTION_H
#define LOM_SHADING_REFLECTION_H

#include "shading/view_uniform.h"

struct lom_reflection_model {
    lom_float (*diffuse)(const struct lom_reflection_uniform *r, lom_float cosine);
    lom_float (*highlight)(lom_float3 normal, lom_float3 to_light, lom_float3 to_eye, lom_float exponent);
};

/* max(N.L, 0) */
static lom_float lambert_diffuse(const struct lom_reflection_uniform *r, lom_float cosine)
{
    (void)r;
    return lom_max(cosine, (lom_float){ 0 });
}

/* The tone of the highest threshold that N.L reaches; 0 below the first and behind the surface. */
static lom_float toon_diffuse(const struct lom_reflection_uniform *r, lom_float cosine)
{
    lom_float tone = { 0 };
    for (int i = 0; i < LOM_TONES; i++)
        tone = lom_select((cosine >= r->threshold[i]) & (cosine > 0.0f), lom_splat(r->tone[i]), tone);
    return tone;
}

/* max(N.H, 0)^exponent, H halfway between the light and the eye (Blinn 1977). */
static lom_float blinn_highlight(lom_float3 normal, lom_float3 to_light, lom_float3 to_eye, lom_float exponent)
{
    lom_float cosine = lom_dot3(normal, lom_normalize3(lom_add3(to_light, to_eye)));
    lom_mask shines = (lom_dot3(normal, to_light) > 0.0f) & (cosine > 0.0f);
    if (!lom_any(shines))
        return (lom_float){ 0 };
    return lom_select(shines, lom_pow(lom_max(cosine, (lom_float){ 0 }), exponent), (lom_float){ 0 });
}

/* A spot with an edge: where Phong's highlight is at least a half. */
static lom_float toon_highlight(lom_float3 normal, lom_float3 to_light, lom_float3 to_eye, lom_float exponent)
{
    lom_float phong = lom_phong_highlight(normal, to_light, to_eye, exponent);
    return lom_select(phong >= 0.5f, lom_splat(1.0f), (lom_float){ 0 });
}

static const struct lom_reflection_model lom_reflection_models[] = {
    [LOM_MODEL_PHONG] = { lambert_diffuse, lom_phong_highlight },
    [LOM_MODEL_BLINN_PHONG] = { lambert_diffuse, blinn_highlight },
    [LOM_MODEL_TOON] = { toon_diffuse, toon_highlight },
};

#endif
