/* The pictures of a scene's sky. */
#ifndef LOM_RENDER_SKY_H
#define LOM_RENDER_SKY_H

#include "render/scene_view.h"

struct lom_sky_uniform;

struct lom_drawn_sky {
    lom_texture *box; /* a cube; NULL: the sky is a gradient or one colour */
    lom_texture *sun; /* its picture, or NULL */
};

bool lom_load_sky(lom_renderer *renderer, lom_error *error);
bool lom_load_sun(lom_renderer *renderer, lom_error *error);
void lom_free_sky(lom_renderer *renderer);
void lom_free_sun(lom_renderer *renderer);
/* Draws the sky and the sun behind everything that the pass holds. */
void lom_draw_sky(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_light_uniform *light);
/* What the shaders of water and liquids look the sky up by. */
void lom_set_sky(struct lom_sky_uniform *sky, const lom_renderer *renderer);

#endif
