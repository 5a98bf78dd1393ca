/* The tiling noise that eats into clouds, at the widest lanes that this processor has instructions for. */
#include "cloud/detail_noise.h"

typedef void detail_row(uint8_t *row, int y, int z, int field);
detail_row lom_detail_row_4, lom_detail_row_8, lom_detail_row_16;

lom_image *lom_make_detail_noise(int field, lom_error *error)
{
    lom_cpu cpu = lom_detect_cpu();
    detail_row *fill = cpu.avx512 ? lom_detail_row_16 : cpu.avx2 ? lom_detail_row_8 : lom_detail_row_4;
    lom_image *noise = lom_create_image(LOM_DETAIL_SIZE, LOM_DETAIL_SIZE, LOM_DETAIL_SIZE, LOM_FORMAT_R8, error);
    for (int z = 0; noise != NULL && z < LOM_DETAIL_SIZE; z++)
        for (int y = 0; y < LOM_DETAIL_SIZE; y++)
            fill(lom_image_pixel(noise, 0, y, z), y, z, field);
    return noise;
}
