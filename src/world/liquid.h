/* A liquid of a scene as far as it has been run, for every renderer that shows it: its particles and its surface. */
#ifndef LOM_WORLD_LIQUID_H
#define LOM_WORLD_LIQUID_H

#include "world/world.h"

struct lom_liquid {
    lom_fluid *fluid; /* NULL: not begun */
    lom_mesh *mesh;   /* after the steps of `meshed`, places less the basin's low corner; NULL: none */
    int64_t meshed;
    uint64_t run; /* steps, in all */
};

/* Whether a liquid of the scene is there to be seen. */
bool lom_shows_liquid(const lom_scene *scene, size_t number);
/* The scene's liquid of this number before its first step. NULL with a sentence that names it. */
lom_fluid *lom_begin_liquid(const struct lom_world *world, size_t number, lom_error *error);
/* Runs it to a time, on from where it is or from the beginning, and makes its surface: what steps from the beginning to
 * the time make of it, whatever it was before. On the device's workers, or NULL. */
bool lom_run_liquid(struct lom_liquid *liquid, const struct lom_world *world, size_t number, lom_device *device,
                    double time, lom_error *error);
void lom_free_liquid(struct lom_liquid *liquid);

#endif
