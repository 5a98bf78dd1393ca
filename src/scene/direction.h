/* Directions that a scene file gives. */
#ifndef LOM_SCENE_DIRECTION_H
#define LOM_SCENE_DIRECTION_H

#include <lom/geometry.h>

/* Makes v a unit vector; false when it is 0 or not finite. Scaled by the largest component first, so that no square
 * overflows. */
bool lom_make_unit(lom_vec3 *v);

#endif
