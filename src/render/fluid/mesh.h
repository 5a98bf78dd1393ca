/* The surface of a liquid as a draw has it. */
#ifndef LOM_RENDER_FLUID_MESH_H
#define LOM_RENDER_FLUID_MESH_H

#include <lom/geometry.h>
#include <lom/pipeline.h>

/* Places are attribute 0, less the basin's low corner; normals attribute 1. */
void lom_set_fluid_mesh(lom_draw_desc *draw, const lom_mesh *mesh);

#endif
