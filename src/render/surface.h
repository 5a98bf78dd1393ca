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
    float fade;      /* 1 / metres below the level over which they appear */
    float lod_scale; /* texels of the map a pixel covers, per metre of distance */
};

/* How near to the sun entities reach, seen from it. */
struct lom_shadow_map_uniform {
    const lom_texture *map;     /* depth, 0 where there is none; NULL: no shadows */
    float s[4], t[4], depth[4]; /* rows: texture coordinates and depth of an offset (x, y, z, 1) */
    float size, texel;          /* texels a side, and 1 / size */
    float offset;               /* metres that a place is moved along its normal, so that it does not shade itself */
};

enum { LOM_ENTITY_SHADOWS = 2 };

/* What every surface of a pass shares. Offsets are places less the eye. */
struct lom_view_uniform {
    struct lom_matrix_uniform clip_from_offset;
    struct lom_light_uniform light;
    struct lom_haze_uniform haze;
    float plane[4]; /* clip distance 0 is plane . (offset, 1); (0, 0, 0, 1) keeps everything */
    struct lom_caustics_uniform caustics;
    struct lom_shadow_map_uniform entity_shadow[LOM_ENTITY_SHADOWS];
};

struct lom_entity_uniforms {
    struct lom_view_uniform view;
    struct lom_matrix_uniform clip_from_model, offset_from_model, normal_from_model; /* multiplied in double */
    struct lom_material_uniform material;
};

struct lom_caster_uniforms {
    struct lom_matrix_uniform clip_from_model;
};

enum { LOM_MAX_TERRAIN_LAYERS = 8 };

/* The sides from which a map is laid on: a map's coordinates run along z and down, x and z, x and down. */
enum { LOM_SIDE_X, LOM_SIDE_ABOVE, LOM_SIDE_Z, LOM_SIDES };

/* A map laid over the terrain: its coordinates on a side are offset * scale + shift; the shifts are less whole
 * repetitions. */
struct lom_laid_uniform {
    const lom_texture *map; /* NULL: none */
    float scale[LOM_SIDES][2], shift[LOM_SIDES][2];
};

struct lom_layer_uniform {
    struct lom_laid_uniform laid;
    float from_height, to_height; /* metres over the eye */
    float from_slope, to_slope;   /* radians */
    float blend, slope_blend;     /* above 0 */
    float grain;                  /* how far the brightness below moves its weight, over the mean of that brightness */
    float grain_offset;           /* grain, where the brightness is the mean */
    bool triplanar;               /* laid on from three sides instead of from above */
};

struct lom_terrain_uniforms {
    struct lom_view_uniform view;
    struct lom_material_uniform material;     /* without its texture */
    float eye[3], eye_rest[3];                /* from the middle of the terrain's base, and what its rounding left */
    const lom_texture *surface;               /* normal and visible share of the sky, at the vertices */
    float surface_scale[2], surface_shift[2]; /* its coordinates are (x, z) surface_scale + surface_shift */
    struct lom_laid_uniform base, detail, normals;
    int layer_count;
    struct lom_layer_uniform layer[LOM_MAX_TERRAIN_LAYERS];
};

/* Indexed by lom_shading. */
const lom_shader *lom_entity_shader(int shading);
const lom_shader *lom_terrain_shader(int shading);
extern const lom_shader lom_caster_shader; /* depth alone */

#endif
