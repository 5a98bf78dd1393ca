/* Pictures of what is seen at each pixel, from tallies and records of the stages that draw (show_surface.c). */
#ifndef LOM_INSPECT_SHOW_H
#define LOM_INSPECT_SHOW_H

#include <lom/inspect.h>

lom_image *lom_show_normals(lom_renderer *r, const lom_frame_desc *desc, lom_error *error);
lom_image *lom_show_objects(lom_renderer *r, const lom_frame_desc *desc, lom_error *error);
lom_image *lom_show_motion(lom_renderer *r, const lom_frame_desc *desc, lom_error *error);

#endif
