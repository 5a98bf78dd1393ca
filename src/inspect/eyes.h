/* Numbers as light and dark. */
#ifndef LOM_INSPECT_EYES_H
#define LOM_INSPECT_EYES_H

#include <lom/geometry.h>
#include <lom/image.h>

/* Of R32F: from the lowest to the highest that is not 0 to 0 .. 1; 0 stays. */
void lom_stretch_numbers(lom_image *image);
/* Distances or depths (R32F) by their logarithms, stretched, as R16. Frees them; NULL gives NULL. */
lom_image *lom_depth_to_eyes(lom_image *raw, lom_error *error);

#endif
