/* The tiling noise that eats into clouds. */
#ifndef LOM_CLOUD_DETAIL_NOISE_H
#define LOM_CLOUD_DETAIL_NOISE_H

#include <lom/image.h>
#include <lom/lanes.h>

enum {
    LOM_DETAIL_SIZE = 32, /* voxels a side */
    LOM_DETAIL_FIELDS = 3 /* independent ones, for shapes that change */
};

/* Three octaves of inverted cellular noise of 4, 8 and 16 cells a side, R8. NULL on failure; freed with lom_free_image.
 */
lom_image *lom_make_detail_noise(int field, lom_error *error);

/* detail_noise.wide.c: a row of it. */
void LOM_WIDE(lom_detail_row)(uint8_t *row, int y, int z, int field);

#endif
