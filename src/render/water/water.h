/* Water as it is drawn. */
#ifndef LOM_RENDER_WATER_WATER_H
#define LOM_RENDER_WATER_WATER_H

#include "water/caustics.h"
#include "water/surface.h"
#include "waves/wave_field.h"

#include <lom/render.h>

struct frame;

struct lom_drawn_water {
    lom_texture *normal_map, *flow_map;
    lom_texture *foam; /* its pattern, or NULL */
    lom_texture *bed;  /* heights of the terrain, a texel a vertex, for caustics; or NULL */
    lom_texture *photons, *caustics;
    struct lom_gathered_light light; /* what becomes of the photons */
    struct lom_wave_site site;
    struct lom_wave_field *waves; /* or NULL */
    struct lom_polar_mesh polar;  /* of displaced water */
};

/* After the ground, whose heights are the water's bed. */
bool lom_load_water(lom_renderer *renderer, lom_error *error);
/* Makes the waves, and what they do to the light on what is drawn after them. */
bool lom_prepare_water(struct frame *f, lom_error *error);
/* Draws tinted or planar water over the scene; or finds where the scene leaves water with waves to be seen, and draws
 * it there. */
bool lom_draw_lake(struct frame *f, lom_error *error);
bool lom_find_surface(struct frame *f, lom_error *error);
bool lom_draw_surface(struct frame *f, lom_error *error);
void lom_free_water(lom_renderer *renderer);

#endif
