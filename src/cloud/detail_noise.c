/* The tiling noise that eats into clouds, at the widest lanes that this processor has instructions for. */
#include "cloud/detail_noise.h"

#include "lanes/variants.h"

typedef void detail_row(uint8_t *row, int y, int z, int field);
#define DECLARE(name, variant) detail_row lom_detail_row_##variant;
#define ENTRY(name, variant)   [LOM_SLOT_##variant] = lom_detail_row_##variant,
LOM_EACH_VARIANT(DECLARE, )
static detail_row *const rows[LOM_VARIANTS] = { LOM_EACH_VARIANT(ENTRY, ) };

lom_image *lom_make_detail_noise(int field, lom_error *error)
{
    detail_row *fill = rows[lom_widest_variant(false)];
    lom_image *noise = lom_create_image(LOM_DETAIL_SIZE, LOM_DETAIL_SIZE, LOM_DETAIL_SIZE, LOM_FORMAT_R8, error);
    for (int z = 0; noise != NULL && z < LOM_DETAIL_SIZE; z++)
        for (int y = 0; y < LOM_DETAIL_SIZE; y++)
            fill(lom_image_pixel(noise, 0, y, z), y, z, field);
    return noise;
}
