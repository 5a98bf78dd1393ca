/* Uniforms of the sky's shaders. */
#ifndef LOM_SKY_UNIFORMS_H
#define LOM_SKY_UNIFORMS_H

#include "pipeline/uniforms.h"

struct lom_sky_uniforms {
    float direction[3][3]; /* of the ray through a point of the screen: rows x, y, z of (ndc x, ndc y, 1) */
    float color[3];        /* factor on the box, or the colour itself */
    const lom_texture *box;
};

extern const lom_shader lom_sky_box_shader, lom_sky_color_shader;

#endif
