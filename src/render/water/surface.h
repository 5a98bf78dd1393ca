/* Water with waves while it is drawn: what its passes share. */
#ifndef LOM_RENDER_WATER_SURFACE_H
#define LOM_RENDER_WATER_SURFACE_H

#include "render/water/passes.h"

struct surface {
    struct lom_surface_uniforms uniforms;
    lom_mat4 clip_from_offset; /* places less the eye, as everything here */
    double level, quad[4];
};

/* surface_uniforms.c: all of it but the pictures of the scene and the mesh, which are zeros. */
void lom_look_at_surface(struct surface *surface, const struct frame *f);
/* How far from its pixel a ray may look, in parts of a picture. */
double lom_ray_reach(const struct frame *f);
/* surface_pictures.c: what the surface reflects and what is behind it, where that is more than sky and water. */
bool lom_draw_surface_pictures(struct surface *surface, struct frame *f, lom_error *error);

#endif
