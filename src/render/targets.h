/* The targets of a frame's passes, by name, remade when the size of the frame or of its drawn part changes. */
#ifndef LOM_RENDER_TARGETS_H
#define LOM_RENDER_TARGETS_H

#include <lom/render.h>
#include <lom/texture.h>

enum lom_target {
    LOM_TARGET_COLOR, /* what becomes the picture, */
    LOM_TARGET_DEPTH, /* and how far away it is */
    LOM_TARGET_REFRACTION,
    LOM_TARGET_REFRACTION_DEPTH,
    LOM_TARGET_REFLECTION,
    LOM_TARGET_REFLECTION_DEPTH,
    LOM_TARGET_MASK, /* not 0 where water may be seen */
    LOM_TARGET_SPRAY,
    LOM_TARGET_WIRE_DEPTH, /* of the surfaces that hide wires */
    LOM_TARGET_SHARP,      /* the picture, and what water mirrors, before their edges are smooth; */
    LOM_TARGET_EDGES,      /* where triangles end in them */
    LOM_TARGET_REFLECTION_SHARP,
    LOM_TARGET_REFLECTION_EDGES,
    LOM_TARGET_FLUID_SCENE,  /* what is behind a liquid, with its reach; */
    LOM_TARGET_FLUID_LENGTH, /* how far rays go through it; the same in what water mirrors and lets through */
    LOM_TARGET_FLUID_REFLECTED,
    LOM_TARGET_FLUID_REFLECTED_LENGTH,
    LOM_TARGET_FLUID_REFRACTED,
    LOM_TARGET_FLUID_REFRACTED_LENGTH,
    LOM_TARGETS
};

struct lom_targets {
    int width, height, drawn_width, drawn_height;
    lom_rect asked;               /* of the drawn part: what the picture is to show */
    lom_texture *of[LOM_TARGETS]; /* NULL: the scene needs none; one texture may bear two names (targets.c) */
    lom_texture *made[LOM_TARGETS];
    size_t made_count;
};

/* Whether they hold light as floats: more than 8 bits are asked for, or light beyond 1 counts. */
bool lom_has_float_targets(const lom_scene *scene);
/* Whether the scene's edges are smoothed after they are drawn. */
bool lom_smooths_edges(const lom_scene *scene);
/* The bytes of the targets and of the picture: no more than a frame of this size will take. */
uint64_t lom_target_bytes(const lom_scene *scene, int width, int height, int drawn_width, int drawn_height);
/* Makes the targets for a frame of this size of which drawn_width x drawn_height is drawn. */
bool lom_make_targets(lom_renderer *renderer, int width, int height, int drawn_width, int drawn_height,
                      lom_error *error);
/* All are made anew by the next frame. */
void lom_drop_targets(lom_renderer *renderer);
/* The format of the scene's pictures. */
lom_format lom_format_of_output(const lom_output *output);
/* What was drawn into the colour target, the part of it that was asked for, in the scene's output format: the caller's.
 * NULL on failure. */
lom_image *lom_output_target(const lom_scene *scene, lom_device *device, const struct lom_targets *targets,
                             lom_error *error);
/* A picture of the reference in rows of the caller's, as below; frees it. False on failure, or when it is NULL. */
bool lom_output_traced(const lom_scene *scene, lom_image *drawn, lom_pixel_order order, void *pixels, size_t pitch,
                       lom_error *error);
/* The same into rows of the caller's, `pitch` bytes apart; the orders of 4 bytes are for output.format "rgb8" alone. */
void lom_output_rows(const lom_scene *scene, lom_device *device, const struct lom_targets *targets,
                     lom_pixel_order order, void *pixels, size_t pitch);
/* The same of a picture of the reference (RGB32F), which is freed; NULL stays NULL. */
lom_image *lom_output_image(const lom_scene *scene, lom_image *drawn, lom_error *error);

#endif
