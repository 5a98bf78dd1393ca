/* The targets of a frame's passes, remade when the size of the frame or of its drawn part changes. */
#ifndef LOM_RENDER_TARGETS_H
#define LOM_RENDER_TARGETS_H

#include <lom/render.h>
#include <lom/texture.h>

struct lom_targets {
    int width, height, drawn_width, drawn_height;
    lom_texture *color, *depth, *mask, *reflection, *reflection_depth, *refraction, *refraction_depth, *spray;
};

/* The bytes of those targets that every frame has, and of the picture: no more than they will take. */
uint64_t lom_target_bytes(const lom_scene *scene, int width, int height, int target_width, int target_height);
/* Makes the targets for a frame of this size of which target_width x target_height is drawn. */
bool lom_make_targets(lom_renderer *renderer, int width, int height, int target_width, int target_height,
                      lom_error *error);
/* A drawn picture, which is freed, in the scene's output format; NULL stays NULL. */
lom_image *lom_output_image(const lom_scene *scene, lom_image *drawn, lom_error *error);

#endif
