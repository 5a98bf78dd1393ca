/* Uniforms that what is opaque in a scene shares: what it is made of, and what a pass sees it by. */
#ifndef LOM_SHADING_VIEW_UNIFORM_H
#define LOM_SHADING_VIEW_UNIFORM_H

#include "shading/haze.h"
#include "shading/sun_shadow.h"

struct lom_material_uniform {
    float ambient[3], diffuse[3], specular[3], shininess;
    const lom_texture *texture; /* multiplies ambient and diffuse; NULL: white */
    float emissive[3];
    bool emits;
    const lom_texture *emissive_map, *specular_map, *gloss_map, *normal_map; /* likewise; NULL: none */
    float opacity;
    const lom_texture *opacity_map; /* multiplies opacity; NULL: 1 */
    bool opacity_is_in_alpha;       /* of that, not in its red */
};

/* How surfaces reflect (shading/reflection.h): a model, and the thresholds and tones of the toon model. */
enum { LOM_MODEL_PHONG, LOM_MODEL_BLINN_PHONG, LOM_MODEL_TOON };
enum { LOM_TONES = 3 };
struct lom_reflection_uniform {
    int model;
    float threshold[LOM_TONES], tone[LOM_TONES];
};

/* The sunlight that waves focus on what is below the level: a map over x and z. */
struct lom_caustics_uniform {
    const lom_texture *map; /* NULL: none */
    float corner[2], scale; /* s = (x - corner[0]) scale */
    float level, strength;
    float fade;      /* 1 / metres below the level over which they appear */
    float lod_scale; /* texels of the map a pixel covers, per metre of distance; of parallel rays at any */
};

/* What every draw of opaque things in a pass shares. Offsets are places less the eye. */
struct lom_view_uniform {
    struct lom_matrix_uniform clip_from_offset;
    struct lom_eye_uniform eye;
    struct lom_light_uniform light;
    struct lom_haze_uniform haze;
    struct lom_reflection_uniform reflection;
    float plane[4]; /* clip distance 0 is plane . (offset, 1); (0, 0, 0, 1) keeps everything */
    struct lom_caustics_uniform caustics;
    struct lom_sun_shadow_uniform entity_shadow;
};

#endif
