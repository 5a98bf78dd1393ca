/* What liquids take of a light that goes through them, straight on (no ray is bent): maps of their optical depths as the
 * light sees them, and how near to it the nearest of them is (shadow_map.wide.c). A place behind that has lost what the
 * whole way through them takes by Beer and Lambert, of each colour its part.
 *
 * Invariant: a place before which no texel of the kernel has a liquid keeps all its light, bit for bit. */
#ifndef LOM_SHADING_LIQUID_SHADOW_H
#define LOM_SHADING_LIQUID_SHADOW_H

#include <lom/texture.h>

/* The sun's. */
struct lom_liquid_map_uniform {
    const lom_texture *map; /* optical depths of red, green and blue; depth, 0 where there is none. NULL: none falls */
    float s[4], t[4], depth[4]; /* rows: texture coordinates and depth of an offset (x, y, z, 1) */
    float size;                 /* texels a side */
    float offset; /* metres that a place is moved along its normal, so that a liquid does not shade itself */
};

/* The share of the sunlight of each colour that liquids let through to places less the eye. normal: unit, towards the
 * side that is lit; 0 where the place is of nothing that casts. */
void LOM_WIDE(lom_liquid_light)(const struct lom_liquid_map_uniform *liquid, const lom_float3 *offset,
                                const lom_float3 *normal, lom_float3 *share);

struct lom_lamp_shadow_uniform;
/* The same of a lamp's light, for places less the eye of the frame, in lanes that it comes to. */
void LOM_WIDE(lom_liquid_lamp)(const struct lom_lamp_shadow_uniform *shadow, const lom_float3 *place,
                               const lom_float3 *normal, lom_float3 *share);

/* The brightness of what is left of white light. */
LOM_INLINE lom_float lom_liquid_brightness(lom_float3 share)
{
    return 0.2126f * share.x + 0.7152f * share.y + 0.0722f * share.z;
}

#endif
