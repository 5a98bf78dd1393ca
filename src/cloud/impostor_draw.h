/* Plates as draws: a cloud's picture is marched into a texture, magnified, and shown. */
#ifndef LOM_CLOUD_IMPOSTOR_DRAW_H
#define LOM_CLOUD_IMPOSTOR_DRAW_H

#include "cloud/cloud_draw.h"
#include "cloud/impostor.h"

/* Marches the cloud into a texture of the plate's size, in a pass of its own: linear light, multiplied by opacity;
 * nothing of the cloud is 0, 0, 0, 0. `view` gives the near plane, the light, the slice, and the angle of a pixel that
 * detail is chosen by; its eye and matrices are not looked at. mirrored: the plate's axes are left-handed. */
bool lom_draw_plate(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                    const struct lom_cloud_view *view, const struct lom_plate *plate, lom_texture *texture);
/* The first pass of magnification: a picture over all of a larger one, with linear filtering. */
bool lom_magnify_plate(lom_device *device, const lom_texture *from, lom_texture *to);
/* Shows a plate in the pass that has begun. Where what is drawn (view->depth) lies within the cloud's box, the part of
 * the cloud before it is shown as if the cloud were uniform along the ray: opacity 1 - (1 - alpha)^part. age: frames
 * since the texture was drawn, for records. */
void lom_show_plate(lom_device *device, const struct lom_placed_cloud *cloud, const struct lom_cloud_view *view,
                    const struct lom_plate *plate, const lom_texture *texture, double misting, int age);

#endif
