/* The shaders of terrain and their uniforms: one for each shading frequency, flat (a normal a face), Gouraud (light at
 * the vertices) and Phong (light at each fragment). */
#ifndef LOM_RENDER_GROUND_SHADERS_H
#define LOM_RENDER_GROUND_SHADERS_H

#include "render/ground/ground.h"
#include "shading/view_uniform.h"

#include <lom/stages.h>

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

/* How patches are cut (patches.c). Places are over the terrain's base: column * step + corner and so on. */
struct lom_cut_uniform {
    const float *heights; /* columns + 1 a row */
    int columns, rows;    /* quads of the map */
    float step[2], corner[2];
    float eye[3];  /* of the frame, whichever pass is drawn */
    float scale;   /* an error of a metre at a distance of one, in errors that are allowed */
    bool parallel; /* at whatever distance */
};

struct lom_terrain_uniforms {
    struct lom_view_uniform view;
    struct lom_material_uniform material;   /* without its texture */
    float eye[3], eye_rest[3];              /* from the middle of the terrain's base, and what its rounding left */
    const lom_texture *vertex_texture;      /* normal and visible share of the sky, at the vertices */
    float vertex_scale[2], vertex_shift[2]; /* its coordinates are (x, z) vertex_scale + vertex_shift */
    struct lom_laid_uniform base, detail, normals;
    struct lom_laid_uniform composed; /* all layers from above, or none */
    float composed_level;             /* its level of detail from which on it stands for the layers */
    int layer_count;
    struct lom_layer_uniform layer[LOM_MAX_TERRAIN_LAYERS];
    struct lom_cut_uniform cut; /* of patches */
};

extern const lom_shader lom_terrain_phong, lom_terrain_gouraud, lom_terrain_flat;
extern const lom_shader lom_terrain_albedo; /* the colour alone, without light */

/* What is told of the terrain to a pass that sees it from this place. */
struct lom_terrain_uniforms lom_terrain_uniforms_of(const lom_renderer *renderer, const struct lom_view_uniform *view,
                                                    lom_vec3 place);

/* The same of patches, and what cuts them; the second one lights the vertices, for Gouraud. */
extern const lom_shader lom_terrain_cut_phong, lom_terrain_cut_gouraud, lom_terrain_cut_flat;
extern const lom_tessellation lom_terrain_patches, lom_terrain_lit_patches;

/* Wires of patches: what cuts them sees the first member. */
struct lom_cut_wire_uniforms {
    struct lom_terrain_uniforms terrain;
    float color[3];
};

extern const lom_shader lom_cut_wire_shader, lom_cut_wire_surface_shader;
extern const lom_geometry
    lom_triangle_edges; /* the three edges of each triangle, from the smaller position to the greater:
                                                 two triangles draw an edge that they share at the same pixels */

#endif
