/* The lamps of a frame as shaders see them: those that shine, and the tiles of ground that each reaches. */
#ifndef LOM_RENDER_LAMPS_H
#define LOM_RENDER_LAMPS_H

#include "render/lamp_shadows.h"
#include "render/lamp_tiles.h"

#include <lom/render.h>

struct frame;

struct lom_drawn_lamps {
    struct lom_lamp_uniform *items;
    struct lom_lamp_extent *extents;
    size_t count, capacity, extent_capacity;
    lom_vec3 eye; /* of the frame: what their places are less */
    struct lom_lamp_tiles tiles;
    struct lom_lamps_uniform uniform;
    struct lom_lamp_shadows shadows;
};

/* Makes them for a frame, and a step that says how many reach the view. */
bool lom_prepare_lamps(struct frame *f, lom_error *error);
/* Adds them to the light, for places less this eye. */
void lom_set_lamps(struct lom_light_uniform *u, const lom_renderer *renderer, lom_vec3 eye);
void lom_free_lamps(struct lom_drawn_lamps *lamps);

#endif
