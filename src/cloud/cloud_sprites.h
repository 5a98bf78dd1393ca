/* Clouds of billboards: many soft discs turned at random, or a group of pictures of whole clouds. */
#ifndef LOM_CLOUD_SPRITES_H
#define LOM_CLOUD_SPRITES_H

#include "cloud/cloud_draw.h"

/* What a billboard is in `places`: its middle less the box's in the world, half its side, the cosine and the sine by
 * which its picture is turned, its middle in parts of the box. */
enum {
    LOM_SPRITE_X = 0,
    LOM_SPRITE_HALF = 3,
    LOM_SPRITE_COSINE,
    LOM_SPRITE_SINE,
    LOM_SPRITE_IN_BOX,
    LOM_SPRITE_FLOATS = 9
};

struct lom_cloud_sprites {
    int count;
    float depth;      /* optical depth of a picture where it is opaque */
    float *places;    /* LOM_SPRITE_FLOATS each, as they were made */
    float *drawn;     /* the same from far to near */
    uint32_t *orders; /* a key and two numbers each */
};

/* Whether a model of clouds is made of them. */
bool lom_has_cloud_sprites(int model);
/* Those of a cloud that has its grid of light, of which the mean of the pictures' opacity is told. NULL on failure. */
struct lom_cloud_sprites *lom_make_cloud_sprites(const struct lom_placed_cloud *cloud, int model, double mean_opacity,
                                                 lom_error *error);
void lom_free_cloud_sprites(struct lom_cloud_sprites *sprites);
/* Fills `drawn` for an eye. */
void lom_sort_cloud_sprites(const struct lom_cloud_sprites *sprites, const struct lom_placed_cloud *cloud,
                            const struct lom_cloud_view *view);

#endif
