/* All rows of a shape, at the widest lanes that this processor has instructions for: they give the same bytes. */
#include "cloud/shape.h"

typedef void shape_row(uint16_t *row, const struct lom_cloud_shape *shape, int y, int z);
shape_row lom_shape_row_4, lom_shape_row_8, lom_shape_row_16;

static shape_row *widest_row(void)
{
    lom_cpu cpu = lom_detect_cpu();
    return cpu.avx512 ? lom_shape_row_16 : cpu.avx2 ? lom_shape_row_8 : lom_shape_row_4;
}

void lom_fill_shape(uint16_t *voxels, const struct lom_cloud_shape *shape)
{
    shape_row *fill = widest_row();
    for (int z = 0; z < shape->voxels[2]; z++)
        for (int y = 0; y < shape->voxels[1]; y++) {
            size_t row = (size_t)z * (size_t)shape->voxels[1] + (size_t)y;
            fill(voxels + row * (size_t)shape->voxels[0], shape, y, z);
        }
}
