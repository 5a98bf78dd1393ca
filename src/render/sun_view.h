/* The sun's view of what stands in its light, for all maps of its shadows: of entities, of liquids. */
#ifndef LOM_RENDER_SUN_VIEW_H
#define LOM_RENDER_SUN_VIEW_H

#include "render/seen.h"

struct frame;

/* Rows: right and up of a picture seen from the sun, and the way to it. */
lom_mat4 lom_sun_view(lom_vec3 to_light);

/* The least box that holds both. */
lom_box lom_join_boxes(lom_box a, lom_box b);

/* What shadows of the sun could fall on and be seen. */
struct lom_sun_receivers {
    struct lom_seen seen;
    lom_box all;
    lom_vec3 to_light;
};
struct lom_sun_receivers lom_find_sun_receivers(const struct frame *f);
/* Whether the shadow of what is in a box may be seen. */
bool lom_may_show_sun_shadow(const struct lom_sun_receivers *receivers, lom_box box);

/* Where a map's texels lie. */
struct lom_sun_map {
    lom_mat4 clip_from_world; /* depth grows towards the sun */
    double texel, range;      /* metres: of a texel's side; from depth 0 to depth 1 */
};

/* The map of size x size texels that holds an extent of the sun's view (x and y; z: of what casts). Sizes and places of
 * texels are counted from `home` and from a length of the scene, so that they stay while the eye moves, wherever the
 * scene is and whatever its scale. */
struct lom_sun_map lom_project_sun_map(const lom_box *extent, const lom_mat4 *light, int size, lom_vec3 home,
                                       double length);

/* The rows of texture coordinates s and t, and of depth, of places less the eye. */
void lom_set_sun_map_rows(const struct lom_sun_map *map, lom_vec3 eye, float s[4], float t[4], float depth[4]);

#endif
