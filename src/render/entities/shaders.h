/* The shaders of entities and their uniforms: one for each shading frequency, flat (a normal a face), Gouraud (light at
 * the vertices) and Phong (light at each fragment). */
#ifndef LOM_RENDER_ENTITIES_SHADERS_H
#define LOM_RENDER_ENTITIES_SHADERS_H

#include "shading/view_uniform.h"

#include <lom/stages.h>

struct lom_entity_uniforms {
    struct lom_view_uniform view;
    struct lom_matrix_uniform clip_from_model, offset_from_model, normal_from_model; /* multiplied in double */
    struct lom_material_uniform material;
    float point_size; /* pixels */
    bool cuts;        /* the texture's alpha is the colour's */
};

/* Of what is cut out by its texture's alpha. */
struct lom_cut_caster_uniforms {
    struct lom_matrix_uniform clip_from_model;
    const lom_texture *texture;
};

struct lom_caster_uniforms {
    struct lom_matrix_uniform clip_from_model;
};

struct lom_normal_uniforms {
    struct lom_matrix_uniform clip_from_offset, offset_from_model, normal_from_model;
    float plane[4]; /* as of lom_view_uniform */
    float length;   /* metres */
};

extern const lom_shader lom_entity_phong, lom_entity_gouraud, lom_entity_flat;
extern const lom_shader lom_entity_bumped;                 /* lom_entity_phong with the material's normal map */
extern const lom_shader lom_entity_point, lom_entity_disc; /* of points, with light at each of them */
extern const lom_shader lom_caster_shader;                 /* depth alone */
extern const lom_shader lom_cut_caster_shader;             /* the same where alpha is 1/2 or more */
/* What is transparent: both sides of a face, over what is behind it (its light is multiplied by its opacity). */
extern const lom_shader lom_transparent_phong, lom_transparent_gouraud, lom_transparent_flat, lom_transparent_bumped;

extern const lom_shader lom_normal_shader; /* the normals of vertices, with lom_normal_lines */
extern const lom_geometry lom_normal_lines;

#endif
