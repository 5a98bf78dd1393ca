/* The shaders of wires and their uniforms: lines of one colour, and the surfaces that hide them. */
#ifndef LOM_RENDER_WIRES_SHADERS_H
#define LOM_RENDER_WIRES_SHADERS_H

#include <lom/pipeline.h>

struct lom_wire_uniforms {
    struct lom_matrix_uniform clip_from_model;
    float color[3]; /* linear */
};

extern const lom_shader lom_wire_shader, lom_wire_surface_shader; /* the latter: depth alone */

#endif
