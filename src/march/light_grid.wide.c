/* One slice of the sweep of light. In: the optical depth of sheared rays before the slice, and its densities. Out: the
 * same behind it; exp(-depth / 16) at the middle of each voxel. Invariant: a ray's depth depends on its own column of
 * densities alone, in the order of the slices. */
#include "march/light_grid.h"

#include <lom/lanes_mathematics.h>

/* Densities as floats with a border of 0, so that rays beside the slice pass nothing. */
static void unpack_rows(const struct lom_slice *s)
{
    size_t pitch = lom_slice_pitch(s);
    memset(s->rows, 0, pitch * sizeof *s->rows);
    memset(s->rows + ((size_t)s->height + 1) * pitch, 0, pitch * sizeof *s->rows);
    for (int y = 0; y < s->height; y++) {
        float *row = s->rows + ((size_t)y + 1) * pitch;
        const uint16_t *from = s->voxels + (size_t)y * s->row_stride;
        row[0] = 0;
        if (s->voxel_stride == 1)
            for (int x = 0; x < s->width; x++)
                row[1 + x] = (float)from[x];
        else
            for (int x = 0; x < s->width; x++)
                row[1 + x] = (float)from[(size_t)x * s->voxel_stride];
        memset(row + 1 + s->width, 0, (1 + LOM_MOST_LANES) * sizeof *row);
    }
}

/* Harris and Lastra 2001, equation 11: of a voxel's optical depth d, exp(-d) goes on and the share `forward` of d is
 * scattered forward into the beam again: a beam's factor is exp(-d) + forward d. As an optical depth, its logarithm. */
LOM_INLINE lom_float step_depth(lom_float d, float forward)
{
    if (forward == 0)
        return d;
    return -lom_log(lom_min(lom_exp(-d) + forward * d, lom_splat(1.0f)));
}

/* Ray (u, v) lies part_x beyond voxel u - whole_x of row v - whole_y + part_y. */
static void carry_depths(const struct lom_slice *s)
{
    size_t pitch = lom_slice_pitch(s), rays = lom_ray_pitch(s->rays_across);
    for (int j = -1; j < s->height; j++) {
        const float *low = s->rows + ((size_t)j + 1) * pitch, *high = low + pitch;
        float *carried = s->carried + (size_t)(j + s->whole_y) * rays + s->whole_x - 1;
        float *middle = s->middle + (size_t)(j + s->whole_y) * rays + s->whole_x - 1;
        for (int i = 0; i <= s->width; i += LOM_LANES) {
            lom_float a = lom_mix(lom_load(low + i), lom_load(high + i), lom_splat(s->part_y));
            lom_float b = lom_mix(lom_load(low + i + 1), lom_load(high + i + 1), lom_splat(s->part_y));
            lom_float depth = lom_mix(a, b, lom_splat(s->part_x)) * s->scale;
            lom_float before = lom_load(carried + i);
            /* lanes beyond the row add the 0 of its border */
            lom_store(middle + i, before + step_depth(0.5f * depth, s->forward));
            lom_store(carried + i, before + step_depth(depth, s->forward));
        }
    }
}

static void store_light(const struct lom_slice *s)
{
    size_t rays = lom_ray_pitch(s->rays_across);
    for (int y = 0; y < s->height; y++) {
        const float *high = s->middle + (size_t)(y + s->whole_y) * rays + s->whole_x, *low = high - rays;
        int32_t *light = s->light + (size_t)y * s->light_row_stride;
        for (int x = 0; x < s->width; x += LOM_LANES) {
            /* voxel x lies part_x before ray x + whole_x */
            lom_float a = lom_mix(lom_load(high + x), lom_load(low + x), lom_splat(s->part_y));
            lom_float b = lom_mix(lom_load(high + x - 1), lom_load(low + x - 1), lom_splat(s->part_y));
            lom_float depth = lom_mix(a, b, lom_splat(s->part_x));
            lom_int share = lom_to_int(lom_exp(depth * (-1.0f / 16)) * 65535.0f + 0.5f);
            if (s->light_voxel_stride == 1 && x + LOM_LANES <= s->width) {
                lom_store_int(light + x, (lom_load_int(light + x) & ~0xffff) | share);
                continue;
            }
            int32_t words[LOM_LANES];
            lom_store_int(words, share);
            for (int i = 0; i < LOM_LANES && x + i < s->width; i++) {
                int32_t *word = &light[(size_t)(x + i) * s->light_voxel_stride];
                *word = (*word & ~0xffff) | words[i];
            }
        }
    }
}

void LOM_WIDE(lom_sweep_slice)(const struct lom_slice *slice)
{
    unpack_rows(slice);
    carry_depths(slice);
    store_light(slice);
}
