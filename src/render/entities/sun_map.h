/* The maps of the sun's shadow, however their casters are chosen: two sorted by what casts (shadow.c), or cascades of the view
 * (cascades.c). */
#ifndef LOM_RENDER_ENTITIES_SUN_MAP_H
#define LOM_RENDER_ENTITIES_SUN_MAP_H

#include "render/entities/entities.h"

/* In lom_drawn_entity.shadow_maps: a bit for each map that shows it, and behind them one that it casts a shadow which may be
 * seen. */
enum { LOM_SHADOW_CASTS = 1 << LOM_ENTITY_SHADOWS };

/* What a map shows. */
struct lom_sun_casters {
    size_t count;
    lom_box extent; /* of the map as seen from the sun: x and y; z: of what casts */
};

/* An extent that holds a box, too. */
void lom_add_sun_caster(struct lom_sun_casters *casters, lom_box box);
/* Draws a map of one or more casters, and adds its step. light: from the world to the sun's view. */
bool lom_draw_sun_map(struct frame *f, int number, const char *name, const struct lom_sun_casters *casters,
                      const lom_mat4 *light, lom_error *error);

/* cascades.c: the same for all that is marked with LOM_SHADOW_CASTS, in cascades of the view. */
bool lom_draw_cascades(struct frame *f, const lom_mat4 *light, lom_error *error);

#endif
