/* The maps of what keeps the light of lamps off (shading/lamp_shadow.h). */
#ifndef LOM_RENDER_LAMP_SHADOWS_H
#define LOM_RENDER_LAMP_SHADOWS_H

#include "shading/lamp_shadow.h"

#include <lom/render.h>

struct frame;

/* A map, and the hash of what it shows. */
struct lom_lamp_map {
    lom_texture *texture;
    uint64_t made_for;
};

struct lom_lamp_shadows {
    struct lom_lamp_map *maps; /* kept from frame to frame, in the order of lamps and faces */
    size_t count, capacity;
    lom_texture **liquids; /* likewise of what liquids take of their light; drawn anew in each frame */
    size_t liquid_count, liquid_capacity;
    struct lom_lamp_shadow_uniform *items; /* of the frame's lamps; what throws no shadow has no map */
    size_t item_capacity;
};

/* A stage: makes the maps of the lamps of a frame whose light is seen, once ground and entities are prepared, and a step
 * that says of which lamps. */
bool lom_prepare_lamp_shadows(struct frame *f, lom_error *error);
/* The maps are made anew by the next frame. */
void lom_forget_lamp_shadows(struct lom_lamp_shadows *shadows);
void lom_drop_lamp_shadows(lom_renderer *renderer);

#endif
