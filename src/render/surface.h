/* Uniforms of the surfaces that a scene is built of: entities and terrain. Each has a shader for each shading
 * frequency: flat (a normal a face), Gouraud (light at the vertices) and Phong (light at each fragment). */
#ifndef LOM_RENDER_SURFACE_H
#define LOM_RENDER_SURFACE_H

#include "shading/haze.h"

struct lom_material_uniform {
    float ambient[3], diffuse[3], specular[3], shininess;
    const lom_texture *texture; /* multiplies ambient and diffuse; NULL: white */
};

/* The sunlight that waves focus on what is below the level: a map over x and z. */
struct lom_caustics_uniform {
    const lom_texture *map; /* NULL: none */
    float corner[2], scale; /* s = (x - corner[0]) scale */
    float level, strength;
    float lod_scale; /* texels of the map a pixel covers, per metre of distance */
};

/* How near to the sun entities reach, seen from it. */
struct lom_shadow_map_uniform {
    const lom_texture *map;     /* depth, 0 where there is none; NULL: no shadows */
    float s[4], t[4], depth[4]; /* rows: texture coordinates and depth of a place (x, y, z, 1) */
    float size, texel;          /* texels a side, and 1 / size */
    float offset;               /* metres that a place is moved along its normal, so that it does not shade itself */
};

enum { LOM_ENTITY_SHADOWS = 2 };

/* What every surface of a pass shares. */
struct lom_view_uniform {
    struct lom_matrix_uniform clip_from_world;
    struct lom_light_uniform light;
    struct lom_haze_uniform haze;
    float eye[3];
    float plane[4]; /* clip distance 0 is plane . (world, 1); (0, 0, 0, 1) keeps everything */
    struct lom_caustics_uniform caustics;
    struct lom_shadow_map_uniform entity_shadow[LOM_ENTITY_SHADOWS];
};

struct lom_entity_uniforms {
    struct lom_view_uniform view;
    struct lom_matrix_uniform world_from_model, normal_from_model;
    struct lom_material_uniform material;
};

struct lom_caster_uniforms {
    struct lom_matrix_uniform clip_from_world, world_from_model;
};

enum { LOM_MAX_TERRAIN_LAYERS = 8 };

struct lom_layer_uniform {
    const lom_texture *map;
    float scale[2];               /* repetitions a metre along x and z */
    float from_height, to_height; /* metres */
    float from_slope, to_slope;   /* radians */
    float blend, slope_blend;     /* above 0 */
    float grain;                  /* how far the brightness below moves its weight, over the mean of that brightness */
    float grain_offset;           /* grain, where the brightness is the mean */
    bool triplanar;               /* laid on from three sides instead of from above */
};

struct lom_terrain_uniforms {
    struct lom_view_uniform view;
    struct lom_material_uniform material;
    const lom_texture *surface; /* normal and visible share of the sky, at the vertices */
    float surface_scale[2];     /* its coordinates are 0.5 + (x, z) * surface_scale */
    float scale[2];             /* of the base texture */
    float detail_scale[2];      /* of the detail and normal maps */
    const lom_texture *detail_map, *normal_map;
    int layer_count;
    struct lom_layer_uniform layer[LOM_MAX_TERRAIN_LAYERS];
};

/* Indexed by lom_shading. */
const lom_shader *lom_entity_shader(int shading);
const lom_shader *lom_terrain_shader(int shading);
extern const lom_shader lom_caster_shader; /* depth alone */

#endif
