/* The sky as four pictures that are laid over one another: where clouds are, noise, finer noise, and a gradient. */
#ifndef LOM_CLOUD_CLOUD_LAYERS_H
#define LOM_CLOUD_CLOUD_LAYERS_H

#include "cloud/cloud_draw.h"

enum { LOM_GRADIENT_WIDTH = 128, LOM_GRADIENT_HEIGHT = 64 };

/* The first picture, of one cloud. */
struct lom_cloud_sheet {
    lom_texture *shape; /* R32F: the optical depth of its columns from above, 1 that of the deepest */
    float deepest;      /* optical depth */
    double height;      /* of the middle of its mass, less that of the box's middle, metres */
};

/* Of a cloud that has its grid of light. NULL on failure. */
struct lom_cloud_sheet *lom_make_cloud_sheet(const struct lom_placed_cloud *cloud, lom_error *error);
void lom_free_cloud_sheet(struct lom_cloud_sheet *sheet);

/* The last one: (s, t) is the sine of half the angle between the way to the eye's place and that to the light, and d / (d +
 * 4) for the optical depth d before a place; red, green and blue are the shares of the sun's light, the sky's and the
 * ground's that the place sends. RGB32F; NULL on failure. */
lom_image *lom_make_cloud_gradient(const lom_clouds *params, int octaves, lom_error *error);
/* Makes that of a set anew if what it follows has changed. Only sets of the model have one. */
bool lom_update_cloud_gradient(struct lom_cloud_set *set, lom_error *error);

#endif
