/* What of the world a frame may show: in the eye's view and, where planar water mirrors it, in the mirrored one. */
#ifndef LOM_RENDER_SEEN_H
#define LOM_RENDER_SEEN_H

#include <lom/geometry.h>

struct frame;

struct lom_seen {
    int count;
    lom_frustum frustum[2];
};

struct lom_seen lom_find_seen(const struct frame *f);
/* Whether something of the water may be: a surface with waves always, since they may rise into the view. */
bool lom_may_show_water(const struct frame *f);
/* Whether something of a box may be. */
bool lom_may_show(const struct lom_seen *seen, lom_box box);
/* From a point to the nearest one of a box. */
double lom_distance_to_box(lom_vec3 p, lom_box box);

#endif
