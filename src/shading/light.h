/* Light for the shaders of every model layer: what a directional light is, how much of it reaches a place, and what a
 * surface sends back of it (Phong 1975).
 *
 * Invariant: a place of the world is an offset in shaders: the place less the eye, or less an origin near it. Uniforms
 * that turn offsets into anything else are formed in double, so that a float never holds a place itself. */
#ifndef LOM_SHADING_LIGHT_H
#define LOM_SHADING_LIGHT_H

#include "shading/matrix.h"

#include <lom/notes.h>

/* One directional light, Phong. */
struct lom_light_uniform {
    float to_light[3]; /* unit length */
    float color[3];
    float ambient[3]; /* from the sky, on what faces up */
    float ground[3];  /* ambient light on what faces down */
    /* what clouds let through, by where the light that passes a place meets a plane; NULL: all of it */
    const lom_texture *shadow;
    float shadow_s[4], shadow_t[4]; /* rows: texture coordinates of an offset (x, y, z, 1) */
    float shadow_strength;
    /* up to which height over the terrain's base it keeps the light off, over x and z; NULL: nowhere */
    const lom_texture *ground_shadow;
    float ground_scale[2], ground_shift[2]; /* its coordinates are (x, z) ground_scale + ground_shift */
    float ground_height;                    /* of the offsets' origin over the base, metres */
    float ground_sharpness;                 /* 1 / metres from dark to light */
    const struct lom_lamps_uniform *lamps;  /* beside it (shading/lamp.h); NULL: none */
    float lamp_shift[3];                    /* of the offsets' origin from the lamps': the eye of the frame */
};

/* The share of the light that passes terrain: all above the shadow's height, none so far below it as the edge is high.
 */
LOM_INLINE lom_float lom_ground_light(const struct lom_light_uniform *light, lom_float3 offset)
{
    if (light->ground_shadow == NULL)
        return lom_splat(1.0f);
    lom_float height = lom_sample(light->ground_shadow, offset.x * light->ground_scale[0] + light->ground_shift[0],
                                  offset.z * light->ground_scale[1] + light->ground_shift[1], (lom_float){ 0 })
                           .x;
    return lom_saturate(1.0f + (offset.y + light->ground_height - height) * light->ground_sharpness);
}

/* The share of the light that clouds and terrain let through to a place. */
LOM_INLINE lom_float lom_light_share(const struct lom_light_uniform *light, lom_float3 offset)
{
    lom_float share = lom_ground_light(light, offset);
    if (light->shadow == NULL)
        return share;
    lom_float through = lom_sample(light->shadow, lom_transform_row(light->shadow_s, offset),
                                   lom_transform_row(light->shadow_t, offset), (lom_float){ 0 })
                            .x;
    return share * (1.0f - light->shadow_strength * (1.0f - through));
}

/* Phong's specular term max(R.E, 0)^exponent of a light, R its reflection; 0 where the light is behind the surface and
 * where R.E is not above 0, for an exponent of 0 too. */
LOM_INLINE lom_float lom_phong_highlight(lom_float3 normal, lom_float3 to_light, lom_float3 to_eye, lom_float exponent)
{
    lom_float facing = lom_dot3(normal, to_light);
    lom_float3 reflected = lom_sub3(lom_scale3(normal, 2.0f * facing), to_light);
    lom_float cosine = lom_max(lom_dot3(reflected, to_eye), (lom_float){ 0 });
    lom_mask shines = (facing > 0.0f) & (cosine > 0.0f);
    if (!lom_any(shines))
        return (lom_float){ 0 };
    return lom_select(shines, lom_pow(cosine, exponent), (lom_float){ 0 });
}

/* The same of the directional light. */
LOM_INLINE lom_float lom_phong_specular(const struct lom_light_uniform *light, lom_float3 normal, lom_float3 to_eye,
                                        float shininess)
{
    return lom_phong_highlight(normal, lom_uniform3(light->to_light), to_eye, lom_splat(shininess));
}

/* max(N.L, 0) */
LOM_INLINE lom_float lom_lambert(const struct lom_light_uniform *light, lom_float3 normal)
{
    return lom_max(lom_dot3(normal, lom_uniform3(light->to_light)), (lom_float){ 0 });
}

#endif
