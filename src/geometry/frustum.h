/* Boxes against a frustum, where many lie in one. */
#ifndef LOM_GEOMETRY_FRUSTUM_H
#define LOM_GEOMETRY_FRUSTUM_H

#include <lom/geometry.h>

/* lom_box_visibility of a box, and the planes that it is not wholly inside of, unless it is outside. What is in the box has to be
 * asked for these alone: a value at one of its corners is no greater than one at the box's, rounded or not. */
lom_visibility lom_find_crossed(const lom_frustum *frustum, lom_box box, lom_frustum *crossed);

#endif
