/* The shaders of wires and their uniforms: lines of one colour, and the surfaces that hide them. */
#ifndef LOM_RENDER_WIRES_SHADERS_H
#define LOM_RENDER_WIRES_SHADERS_H

#include "render/ground/shaders.h"

struct lom_wire_uniforms {
    struct lom_matrix_uniform clip_from_model;
    float color[3]; /* linear */
};

extern const lom_shader lom_wire_shader, lom_wire_surface_shader; /* the latter: depth alone */

/* Of terrain that tessellation cuts: what cuts it sees the first member. */
struct lom_cut_wire_uniforms {
    struct lom_terrain_uniforms terrain;
    float color[3];
};

extern const lom_shader lom_cut_wire_shader, lom_cut_wire_surface_shader;
extern const lom_geometry
    lom_triangle_edges; /* the three edges of each triangle, from the smaller position to the greater:
                                                 two triangles draw an edge that they share at the same pixels */

#endif
