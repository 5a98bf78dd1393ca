/* Water with waves while it is drawn: what its passes share. */
#ifndef LOM_RENDER_WATER_SEA_H
#define LOM_RENDER_WATER_SEA_H

#include "render/water/passes.h"

struct sea {
    struct lom_surface_uniforms uniforms;
    lom_mat4 clip_from_offset; /* places less the eye, as everything here */
    double level, quad[4];
};

/* sea_uniforms.c: all of it but the pictures of the scene and the mesh, which are zeros. */
void lom_look_at_sea(struct sea *sea, const struct frame *f);
/* sea_pictures.c: what the surface reflects and what is behind it, where that is more than sky and water. */
bool lom_draw_sea_pictures(struct sea *sea, struct frame *f, lom_error *error);

#endif
