/* All rows of a shape, at the widest lanes that this processor has instructions for: they give the same bytes. */
#include "cloud/shape.h"

#include "lanes/variants.h"

typedef void shape_row(uint16_t *row, const struct lom_cloud_shape *shape, int y, int z);
#define DECLARE(name, variant) shape_row lom_shape_row_##variant;
#define ENTRY(name, variant)   [LOM_SLOT_##variant] = lom_shape_row_##variant,
LOM_EACH_VARIANT(DECLARE, )
static shape_row *const rows[LOM_VARIANTS] = { LOM_EACH_VARIANT(ENTRY, ) };

void lom_fill_shape(uint16_t *voxels, const struct lom_cloud_shape *shape)
{
    shape_row *fill = rows[lom_widest_variant(false)];
    for (int z = 0; z < shape->voxels[2]; z++)
        for (int y = 0; y < shape->voxels[1]; y++) {
            size_t row = (size_t)z * (size_t)shape->voxels[1] + (size_t)y;
            fill(voxels + row * (size_t)shape->voxels[0], shape, y, z);
        }
}
