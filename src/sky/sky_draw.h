/* Drawing the sky behind everything: one triangle over the whole frame at the far plane. */
#ifndef LOM_SKY_SKY_DRAW_H
#define LOM_SKY_SKY_DRAW_H

#include "shading/gradient.h"

#include <lom/geometry.h>
#include <lom/sky.h>

/* The sky box as a cube texture of the device, from six faces (+x, -x, +y, -y, +z, -z), slices of RGBA8; srgb: they are
 * decoded. */
lom_texture *lom_make_sky_texture(lom_device *device, const lom_image *faces, bool srgb);

/* What the shaders get of a sky that is a gradient; off where it is not. */
struct lom_gradient_uniform lom_sky_gradient_of(const lom_sky_params *sky, const lom_texture *box,
                                                const float to_light[3]);

/* Draws the sky where nothing has been drawn (reversed depth is still 0) as seen through projection * view; box may be
 * NULL: a gradient or one colour. */
void lom_draw_sky_box(lom_device *device, const lom_sky_params *sky, const lom_texture *box, const float to_light[3],
                      const lom_mat4 *projection, const lom_mat4 *view);
/* Adds the sun's picture there, in the light's colour. */
void lom_draw_sun(lom_device *device, const lom_sky_params *sky, const lom_texture *picture,
                  const struct lom_light_uniform *light, const lom_mat4 *projection, const lom_mat4 *view);

#endif
