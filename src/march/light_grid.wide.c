/* One slice of the sweep of light. In: the optical depth of sheared rays before the slice, and its densities. Out: the
 * same behind it; exp(-depth / 64) at the middle of each voxel. Invariant: a ray's depth depends on its own column of
 * densities alone, in the order of the slices. */
#include "march/light_grid.h"

#include <lom/lanes_mathematics.h>

typedef uint16_t share_lanes __attribute__((vector_size(LOM_LANES * 2)));

/* Row y as floats with a border of 0, so that rays beside the slice pass nothing; rows beside it are all 0. */
static void unpack_row(const struct lom_slice *s, int y, float *row)
{
    const uint16_t *from = s->voxels + (size_t)y * s->voxel_pitch;
    int width = y >= 0 && y < s->height ? s->width : 0;
    row[0] = 0;
    for (int x = 0; x < width; x++)
        row[1 + x] = (float)from[x];
    memset(row + 1 + width, 0, ((size_t)(s->width - width) + 1 + LOM_MOST_LANES) * sizeof *row);
}

/* Harris and Lastra 2001, equation 11: of a voxel's optical depth d, exp(-d) goes on and the share `forward` of d is
 * scattered forward into the beam again: a beam's factor is exp(-d) + forward d. As an optical depth, its logarithm. */
LOM_INLINE lom_float step_depth(lom_float d, float forward)
{
    if (forward == 0 || !lom_any(d > 0.0f))
        return d;
    return -lom_log(lom_min(lom_exp(-d) + forward * d, lom_splat(1.0f)));
}

/* The rays between the rows j (low) and j + 1 (high) of voxels: ray i lies part_x beyond voxel i - 1, part_y beyond row
 * j. */
static void carry_depths(const struct lom_slice *s, int j, const float *low, const float *high, float *middle)
{
    float *carried = s->carried + (size_t)(j + s->whole_y) * lom_ray_pitch(s->rays_across) + s->whole_x - 1;
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

/* Of a row of voxels: voxel x lies part_x before ray x + 1, part_y before the rays above its row (high). */
static void store_shares(const struct lom_slice *s, int y, const float *low, const float *high)
{
    uint16_t *shares = s->shares + (size_t)y * s->share_pitch;
    for (int x = 0; x < s->width; x += LOM_LANES) {
        lom_float a = lom_mix(lom_load(high + x + 1), lom_load(low + x + 1), lom_splat(s->part_y));
        lom_float b = lom_mix(lom_load(high + x), lom_load(low + x), lom_splat(s->part_y));
        lom_float depth = lom_mix(a, b, lom_splat(s->part_x));
        lom_int share = lom_to_int(lom_fade(depth * (-1.0f / LOM_LIGHT_DEPTH)) * 65535.0f + 0.5f);
        share_lanes narrow = __builtin_convertvector(share, share_lanes);
        memcpy(shares + x, &narrow, sizeof narrow);
    }
}

void LOM_WIDE(lom_sweep_slice)(const struct lom_slice *s)
{
    size_t pitch = lom_row_pitch(s->width);
    float *low = s->rows, *high = low + pitch, *middle_low = high + pitch, *middle_high = middle_low + pitch;
    unpack_row(s, -1, low);
    for (int y = -1; y < s->height; y++) {
        float *next = low, *next_middle = middle_low;
        unpack_row(s, y + 1, high);
        carry_depths(s, y, low, high, middle_high);
        if (y >= 0)
            store_shares(s, y, middle_low, middle_high);
        low = high;
        high = next;
        middle_low = middle_high;
        middle_high = next_middle;
    }
}
