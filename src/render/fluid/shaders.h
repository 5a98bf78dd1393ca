/* The shaders of liquids in a frame and their uniforms: the scene behind them copied, how far rays go through them, and
 * their light; and how much of it they take, as the light sees them. */
#ifndef LOM_RENDER_FLUID_SHADERS_H
#define LOM_RENDER_FLUID_SHADERS_H

#include "shading/view_uniform.h"
#include "water/surface.h"

struct lom_fluid_uniforms {
    struct lom_view_uniform view;
    struct lom_sky_uniform sky;
    struct lom_material_uniform body; /* what its own matter sends back, where none of the light comes through */
    float shift[3];                   /* of the mesh: its places less the eye */
    float side;                       /* of lengths: 1 of what turns its back, -1 of what faces the eye */
    int origin[2];                    /* the picture's pixel that is the first of its textures */
    int first[2], last[2];            /* pixels of the picture that are drawn */
    float size[2];                    /* of the picture, pixels */
    float reach;                      /* pixels that a bent ray may be off */
    float eta, absorption[3], shininess;
    bool sky_is_behind;               /* where the picture has nothing */
    const lom_texture *color, *depth; /* of the scene, to be copied */
    const lom_texture *scene;         /* the copy: light, and the reach of what sends it */
    const lom_texture *length;        /* metres of liquid along rays */
};

struct lom_fluid_caster_uniforms {
    struct lom_matrix_uniform clip_from_mesh;
    bool parallel;
    float along[4];      /* as of lom_fluid_light, of the mesh's places */
    float shift[3];      /* else: of the mesh's places less the light's */
    float extinction[3]; /* 1/m; of what faces the light the negative */
};

extern const lom_shader lom_fluid_copy_shader, lom_fluid_length_shader, lom_fluid_shader, lom_fluid_caster_shader;

#endif
