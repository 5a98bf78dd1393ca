/* The water of a scene over its bed, for every model that shows it: shallow water at a time, and the maps of surf. */
#ifndef LOM_SCENE_SCENE_WATER_H
#define LOM_SCENE_SCENE_WATER_H

#include "waves/surf.h"

#include <lom/scene.h>
#include <lom/shallow.h>

/* The terrain's vertices: (columns + 1) x (rows + 1) heights over terrain.size, row by row. */
struct lom_bed {
    const float *heights; /* NULL: the scene has no terrain, and the bed is deep */
    int columns, rows;    /* quads */
};

struct lom_scene_shallow {
    lom_shallow *first, *now; /* before the first step; after the last one, or NULL. first NULL: there is none */
    double corner[2], cell;   /* x and z of its corner, metres */
    double lowest;            /* of its bed, metres from the level, or 0 */
    int columns, rows;
    uint64_t run; /* steps, in all */
};

/* The region of [shallow] before its first step; nothing where the scene has none. False on failure. What has been made
 * is freed with lom_close_scene_shallow, also then. */
bool lom_open_scene_shallow(struct lom_scene_shallow *shallow, const lom_scene *scene, const struct lom_bed *bed,
                            lom_error *error);
void lom_close_scene_shallow(struct lom_scene_shallow *shallow);
/* Runs the steps from [shallow] start to a time: on from the last time, or from the beginning when that was later. The
 * state is that after all of them, so any moment alone is that of a run. */
bool lom_advance_scene_shallow(struct lom_scene_shallow *shallow, const lom_scene *scene, double time,
                               lom_error *error);

/* The maps of [surf] over the bed, placed in the world; nothing where the scene has none. Freed with
 * lom_free_surf_map. */
bool lom_make_scene_surf(struct lom_surf_map *map, const lom_scene *scene, const struct lom_bed *bed, lom_error *error);

#endif
