/* A row of the tiling noise. In: its place. Out: bytes. Invariant: voxel 0 follows voxel 31 without a seam. */
#include "cloud/detail_noise.h"
#include "cloud/cloud_noise.h"

void LOM_WIDE(lom_detail_row)(uint8_t *row, int y, int z, int field)
{
    const float cells = 4.0f / LOM_DETAIL_SIZE;
    for (int x = 0; x < LOM_DETAIL_SIZE; x += LOM_LANES) {
        lom_float3 p = { (lom_to_float(lom_lane_index() + x) + 0.5f) * cells, lom_splat(((float)y + 0.5f) * cells),
                         lom_splat(((float)z + 0.5f) * cells) };
        lom_float noise = lom_saturate(1.9f * lom_billow_octaves(p, 3, 3, 77 + 1000 * field) - 0.42f);
        int32_t bytes[LOM_LANES];
        lom_store_int(bytes, lom_to_int(noise * 255.0f + 0.5f));
        for (int i = 0; i < LOM_LANES; i++)
            row[x + i] = (uint8_t)bytes[i];
    }
}
