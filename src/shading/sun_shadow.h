/* The shadow that entities throw in the sunlight (L. Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978): maps
 * of how near to the sun they reach. */
#ifndef LOM_SHADING_SUN_SHADOW_H
#define LOM_SHADING_SUN_SHADOW_H

#include "shading/liquid_shadow.h"
#include "shading/near_blocks.h"

/* Blocks of a map, texels: what a shader looks at about a place is less than one of them away. */
enum { LOM_SHADOW_BLOCK = 8 };

/* How near to the sun entities reach, seen from it. */
struct lom_shadow_map_uniform {
    const lom_texture *map;       /* depth, 0 where there is none */
    struct lom_near_uniform near; /* how near to the sun anything reaches about a place */
    float s[4], t[4], depth[4];   /* rows: texture coordinates and depth of an offset (x, y, z, 1) */
    float size, texel;            /* texels a side, and 1 / size */
    float offset;                 /* metres that a place is moved along its normal, so that it does not shade itself */
};

/* Those of a frame that show something: each a part of the entities; or cascades of the view, of which a place takes the
 * first that holds it, and at its border some of the next. */
enum { LOM_ENTITY_SHADOWS = 4 };
struct lom_sun_shadow_uniform {
    int count;
    bool cascaded;
    struct lom_shadow_map_uniform map[LOM_ENTITY_SHADOWS];
    struct lom_liquid_map_uniform liquid; /* what liquids take of it */
};

/* The share of the sunlight that entities let through to places less the eye, in [0, 1] (shadow_map.wide.c). normal: unit,
 * towards the side that is lit; 0 where the place is of nothing that casts. */
void LOM_WIDE(lom_entity_light)(const struct lom_sun_shadow_uniform *sun, const lom_float3 *offset,
                                const lom_float3 *normal, lom_float *share);

/* The share of the sunlight that comes to the places of water, where `open` of it would without entities and liquids;
 * what comes through these counts by its brightness. */
LOM_INLINE lom_float lom_open_water_share(const struct lom_sun_shadow_uniform *sun, lom_float3 offset, lom_float open)
{
    if ((sun->count == 0 && sun->liquid.map == NULL) || !lom_any(open > 0.0f))
        return open;
    const lom_float3 none = { { 0 }, { 0 }, { 0 } };
    if (sun->count != 0) {
        lom_float share;
        LOM_WIDE(lom_entity_light)(sun, &offset, &none, &share);
        open = open * share;
    }
    if (sun->liquid.map != NULL) {
        lom_float3 through;
        LOM_WIDE(lom_liquid_light)(&sun->liquid, &offset, &none, &through);
        open = open * lom_liquid_brightness(through);
    }
    return open;
}

#endif
