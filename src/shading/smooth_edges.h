/* The shader of lom_smooth_edges (lom/pipeline.h): a square over the picture. */
#ifndef LOM_SHADING_SMOOTH_EDGES_H
#define LOM_SHADING_SMOOTH_EDGES_H

#include <lom/pipeline.h>

/* Depths jump where they differ by more than this part of the nearer one, and by more than so many slopes. */
#define LOM_EDGE_GAP    (1.0f / 64)
#define LOM_EDGE_SLOPES 2.0f

struct lom_smooth_uniforms {
    float origin[2]; /* the frame's pixel that (0, 0) of the textures is */
    const lom_texture *color, *edges, *depth;
};

extern const lom_shader lom_smooth_shader;

#endif
