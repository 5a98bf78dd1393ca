/* What a renderer holds: a scene and a device, and for each thing of the scene a room: its files as meshes and textures,
 * and what a frame leaves for the next. A room is a folder with a struct and the verbs load, prepare, draw and free. */
#ifndef LOM_RENDER_RENDERER_H
#define LOM_RENDER_RENDERER_H

#include "render/clouds/clouds.h"
#include "render/entities/entities.h"
#include "render/fluid/fluid.h"
#include "render/ground/ground.h"
#include "render/lamps.h"
#include "render/sky.h"
#include "render/spray/spray.h"
#include "render/targets.h"
#include "render/textures.h"
#include "render/water/water.h"
#include "world/world.h"

#include <lom/reference.h>

struct lom_renderer {
    struct lom_world *world;
    struct lom_moment moment; /* the world at the time of the frame */
    const lom_scene *scene;   /* of the moment */
    lom_device *device;
    lom_reference *reference; /* instead of all that follows, where the water's model is the reference */

    struct lom_texture_cache textures;
    struct lom_drawn_sky sky;
    struct lom_ground ground; /* its blocks are NULL when the scene has no terrain */
    struct lom_ground_maps ground_maps;
    struct lom_drawn_entities entities;
    struct lom_drawn_water waters[1 + LOM_MAX_OTHER_WATERS]; /* in the scene's order, */
    struct lom_drawn_water
        *water; /* and the one that is looked at, whose keys `scene->water` has (lom_turn_to_water) */
    struct lom_drawn_clouds clouds;
    struct lom_drawn_spray spray;
    struct lom_drawn_fluids fluids;
    struct lom_drawn_lamps lamps;
    struct lom_targets targets; /* of this frame */
    struct lom_targets
        other_targets[1 + LOM_MAX_VIEWS]; /* of sizes before, the last one first: one and a view's each */
    char loaded[160];                     /* what the last change of the scene loaded */
    const lom_renderer *before;           /* while a scene is changed: what rooms may share; else NULL */
};

#endif
