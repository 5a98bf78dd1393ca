/* Drawing the sky behind everything: one triangle over the whole frame at the far plane. */
#ifndef LOM_SKY_DRAW_H
#define LOM_SKY_DRAW_H

#include "pipeline/uniforms.h"

#include <lom/geometry.h>
#include <lom/sky.h>

/* The sky box as a cube texture of the device; srgb: its pictures are decoded. NULL with *error set on failure, NULL
 * without where the sky is a colour. */
lom_texture *lom_load_sky(lom_device *device, const lom_sky_params *sky, bool srgb, lom_error *error);

/* Draws the sky where nothing has been drawn (reversed depth is still 0) as seen through projection * view; box may be
 * NULL: one colour. */
void lom_draw_sky(lom_device *device, const lom_sky_params *sky, const lom_texture *box, const lom_mat4 *projection,
                  const lom_mat4 *view);

#endif
