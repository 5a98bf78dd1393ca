/* Uniforms of the sky's shaders. */
#ifndef LOM_SKY_SKY_UNIFORMS_H
#define LOM_SKY_SKY_UNIFORMS_H

#include "shading/gradient.h"

struct lom_sky_uniforms {
    float direction[3][3]; /* of the ray through a point of the screen: rows x, y, z of (ndc x, ndc y, 1) */
    float color[3];        /* factor on the box, or the colour itself */
    const lom_texture *box;
    struct lom_gradient_uniform gradient;
};

struct lom_sun_uniforms {
    struct lom_matrix_uniform clip_from_direction; /* of a way, without a place */
    float corner[4][3];                            /* ways to the corners: lower left, lower right, upper left, ... */
    float color[3];
    const lom_texture *picture;
};

extern const lom_shader lom_sky_box_shader, lom_sky_color_shader, lom_sky_gradient_shader, lom_sun_shader;

#endif
