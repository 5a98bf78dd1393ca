/* lom/march.h - stepping rays through volumes of colour and density: front to back, with exact skipping of empty space.
 *
 * A volume spans [0, 1]^3; voxel i of n has its centre at (i + 0.5) / n; values between centres are trilinear, outside
 * the first and last centre they are the edge's (clamp to edge). Positions are evaluated at the step, start + i * step,
 * never summed, so that what is skipped changes no bit of what is not.
 */
#ifndef LOM_MARCH_H
#define LOM_MARCH_H

#include <lom/image.h>
#include <lom/lanes.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- volumes ---- */

enum { LOM_MAX_VOLUME = 512 }; /* voxels a side */

/* A volume, stored for marching: index (z * (height + 1) + y) * (width + 1) + x names the cell between the voxels
 * x, y, z and x + 1, y + 1, z + 1 (the last voxel repeated). Made by lom_create_volume, read only. */
typedef struct lom_volume {
    int width, height, depth;
    int32_t *density; /* 2 words a cell: word z holds the corners (0, 0, z), (1, 0, z), (0, 1, z), (1, 1, z) from its
                       * lowest byte up */
    int32_t *color;   /* 1 word a voxel, the last of each axis repeated: red in the lowest byte, green, blue, density */
    uint8_t *distance; /* 1 byte a cell: Chebyshev distance, in cells and at most 255, to the nearest cell with a corner
                        * of non-zero density; 0 there */
    bool empty_border; /* no density in the outermost voxels */
} lom_volume;

/* From an RGBA8 image (alpha is the density) or an R8 one (white). NULL on failure; freed with lom_free_volume. */
lom_volume *lom_create_volume(const lom_image *image, lom_error *error);
void lom_free_volume(lom_volume *volume);

/* ---- sampling ---- */

/* Where a position lies: the index of its cell and the weights of the cell's upper corners. */
typedef struct lom_volume_place {
    lom_int index;
    lom_float x, y, z;
} lom_volume_place;

LOM_INLINE lom_float lom_volume_axis(lom_float position, int size, lom_int *cell)
{
    lom_float along = lom_clamp(position * (float)size - 0.5f, (lom_float){ 0 }, lom_splat((float)(size - 1)));
    *cell = __builtin_convertvector(along, lom_int); /* in range and not negative: the floor */
    return along - lom_to_float(*cell);
}

LOM_INLINE lom_volume_place lom_find_in_volume(const lom_volume *volume, lom_float3 position)
{
    lom_volume_place place;
    lom_int x, y, z;
    place.x = lom_volume_axis(position.x, volume->width, &x);
    place.y = lom_volume_axis(position.y, volume->height, &y);
    place.z = lom_volume_axis(position.z, volume->depth, &z);
    place.index = (z * (volume->height + 1) + y) * (volume->width + 1) + x;
    return place;
}

/* Density in [0, 1]: along z, then y, then x, in units of 1/255, scaled at the end. Bytes are masked where they stand:
 * a factor of a power of two is exact, so it may be taken out after the first interpolation. */
LOM_INLINE lom_float lom_sample_density(const lom_volume *volume, lom_volume_place place)
{
    lom_int low, high;
    lom_gather_pairs(volume->density, place.index + place.index, &low, &high);
    lom_float v00 = lom_mix(lom_to_float(low & 0xff), lom_to_float(high & 0xff), place.z);
    lom_float v10 = lom_mix(lom_to_float(low & 0xff00), lom_to_float(high & 0xff00), place.z) * 0x1p-8f;
    lom_float v01 = lom_mix(lom_to_float(low & 0xff0000), lom_to_float(high & 0xff0000), place.z) * 0x1p-16f;
    lom_float v11 =
        lom_mix(lom_to_float((lom_int)((lom_uint)low >> 24)), lom_to_float((lom_int)((lom_uint)high >> 24)), place.z);
    return lom_mix(lom_mix(v00, v01, place.y), lom_mix(v10, v11, place.y), place.x) * (1 / 255.0f);
}

/* One channel of the eight corners, c[4 z + 2 y + x], by mask; in units of the mask's lowest bit. */
LOM_INLINE lom_float lom_volume_channel(const lom_int c[8], int32_t mask, lom_volume_place place)
{
    lom_float row[4];
    for (int i = 0; i < 4; i++)
        row[i] = lom_mix(lom_to_float(c[i] & mask), lom_to_float(c[4 + i] & mask), place.z);
    return lom_mix(lom_mix(row[0], row[2], place.y), lom_mix(row[1], row[3], place.y), place.x);
}

/* Colour in [0, 1], in the same order. */
LOM_INLINE lom_float3 lom_sample_volume_color(const lom_volume *volume, lom_volume_place place)
{
    lom_int corner[8];
    int pitch = volume->width + 1, slice = pitch * (volume->height + 1);
    for (int i = 0; i < 8; i += 2)
        lom_gather_pairs(volume->color + (i >> 1 & 1) * pitch + (i >> 2) * slice, place.index, &corner[i],
                         &corner[i + 1]);
    return (lom_float3){ lom_volume_channel(corner, 0xff, place) * (1 / 255.0f),
                         lom_volume_channel(corner, 0xff00, place) * (0x1p-8f / 255.0f),
                         lom_volume_channel(corner, 0xff0000, place) * (0x1p-16f / 255.0f) };
}

/* ---- marching ---- */

typedef struct lom_march_desc {
    const lom_volume *volume;
    int steps;             /* samples a ray, 1..65536 */
    float absorption;      /* a sample's opacity is density * absorption */
    float light_offset[3]; /* from a sample to the place whose density shades it, in volume units */
    float shade;           /* how much: the colour is multiplied by 1 - shade * density there */
    float opaque;          /* a ray stops when its opacity is above this */
    bool walk;             /* evaluate every step; skipping empty space gives the same bytes */
} lom_march_desc;

typedef struct lom_march_rays {
    lom_float3 start, step; /* sample i is at start + i * step, in volume units */
    lom_mask active;        /* the other lanes give 0 */
} lom_march_rays;

/* Samples evaluated (a packet's step counts once) of those that walking would have. */
typedef struct lom_march_count {
    uint64_t walked, sampled;
} lom_march_count;

/* Opacity and colour (already multiplied by it), front to back: with v = (1 - alpha) density absorption, colour +=
 * v c (1 - shade d), alpha += v (clouds.md 4's general form). count may be NULL and is added to. */
void LOM_WIDE(lom_march_volume)(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                                lom_march_count *count);

#ifdef __cplusplus
}
#endif

#endif
