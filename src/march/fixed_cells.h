/* What media, noise and grids of light hold at a place, and volumes where they are not marched (fixed_volume.h), filtered
 * in fixed point (lom/fixed.h). In: a cell and the weights of its upper corners, found in float as ever. Out: numbers in
 * [0, 1], multiples of 1/32640 (of bytes) or 1/32767. Order: along z, then x (of words with both, y), then the rest;
 * bytes count as 128 times themselves, 16 bits as their upper 15. Invariant: where the corners are 0 the result is 0, so
 * that what is empty can be left out.
 *
 * Three mixes: within 3 2^-15 + 2^-20 of the float filter, of 16 bits within 2^-16 more. */
#ifndef LOM_MARCH_FIXED_CELLS_H
#define LOM_MARCH_FIXED_CELLS_H

#include <lom/fixed.h>
#include <lom/march.h>

struct fixed_place {
    lom_int index;
    lom_pairs x, y, z; /* negated weights */
};

LOM_INLINE struct fixed_place fix_place(lom_volume_place place)
{
    return (struct fixed_place){ place.index, lom_weight_pairs(place.x), lom_weight_pairs(place.y),
                                 lom_weight_pairs(place.z) };
}

/* The lower half of each lane towards the upper. */
LOM_INLINE lom_float fixed_mix_halves(lom_pairs x, lom_pairs negated_weight)
{
    return lom_lower_of_pairs(lom_mix_pairs(x, (lom_pairs)((lom_int)x >> 16), negated_weight));
}

/* lom_mix_corners: bytes (0, 0), (1, 0), (0, 1), (1, 1) of x and y in each word, one word a z. */
LOM_INLINE lom_float fixed_corners(lom_int low, lom_int high, const struct fixed_place *at)
{
    lom_pairs left = lom_mix_pairs(lom_even_bytes(low), lom_even_bytes(high), at->z);
    lom_pairs right = lom_mix_pairs(lom_odd_bytes(low), lom_odd_bytes(high), at->z);
    return fixed_mix_halves(lom_mix_pairs(left, right, at->x), at->y) * (1 / LOM_FIXED_BYTE);
}

/* The eight corners c[4 z + 2 y + x] of numbers in pairs. */
LOM_INLINE lom_pairs fixed_cell(const lom_pairs c[8], const struct fixed_place *at)
{
    lom_pairs row[4];
    for (int i = 0; i < 4; i++)
        row[i] = lom_mix_pairs(c[i], c[4 + i], at->z);
    return lom_mix_pairs(lom_mix_pairs(row[0], row[1], at->x), lom_mix_pairs(row[2], row[3], at->x), at->y);
}

/* Colour of the eight corners, and the density by the operations of fixed_corners. */
LOM_INLINE lom_float3 fixed_volume_all(const lom_volume *volume, const struct fixed_place *at, lom_float *density)
{
    lom_int corner[8];
    lom_load_volume_corners(volume, (lom_volume_place){ .index = at->index }, corner);
    lom_pairs even[8], odd[8];
    for (int i = 0; i < 8; i++) {
        even[i] = lom_even_bytes(corner[i]);
        odd[i] = lom_odd_bytes(corner[i]);
    }
    lom_pairs rb = fixed_cell(even, at), ga = fixed_cell(odd, at);
    const float byte = 1 / LOM_FIXED_BYTE;
    *density = lom_upper_of_pairs(ga) * byte;
    return (lom_float3){ lom_lower_of_pairs(rb) * byte, lom_lower_of_pairs(ga) * byte, lom_upper_of_pairs(rb) * byte };
}

/* The upper 15 bits of two numbers of 16. */
LOM_INLINE lom_pairs fixed_of_words(lom_int words)
{
    return (lom_pairs)(words >> 1 & 0x7fff7fff);
}

/* A row of a cell at both z, whose halves are x and x + 1, along z. */
LOM_INLINE lom_pairs fixed_medium_row(const lom_int word[2], const struct fixed_place *at)
{
    const lom_int high = (lom_int)lom_splat_uint(0xffff0000);
    return lom_mix_pairs(fixed_of_words((word[0] & 0xffff) | word[1] << 16),
                         fixed_of_words((lom_int)((lom_uint)word[0] >> 16) | (word[1] & high)), at->z);
}

/* lom_mix_medium. */
LOM_INLINE lom_float fixed_mix_medium(const lom_int upper[2], const lom_int lower[2], const struct fixed_place *at)
{
    lom_pairs row = lom_mix_pairs(fixed_medium_row(upper, at), fixed_medium_row(lower, at), at->y);
    return fixed_mix_halves(row, at->x) * (1 / LOM_FIXED_LINEAR);
}

LOM_INLINE lom_float fixed_medium(const lom_medium *medium, const struct fixed_place *at)
{
    lom_int upper[2], lower[2];
    lom_gather_pairs(medium->density, at->index, &upper[0], &upper[1]);
    lom_gather_pairs(medium->density + medium->width + 1, at->index, &lower[0], &lower[1]);
    return fixed_mix_medium(upper, lower, at);
}

LOM_INLINE lom_float fixed_detail(const lom_detail *detail, lom_float3 position)
{
    struct fixed_place at = fix_place(lom_find_in_detail(detail, position));
    lom_int low, high;
    lom_gather_pairs(detail->corners, at.index + at.index, &low, &high);
    return fixed_corners(low, high, &at);
}

/* Rows c[2 z + y] whose halves are x and x + 1. */
LOM_INLINE lom_float fixed_rows(const lom_pairs c[4], const struct fixed_place *at)
{
    lom_pairs upper = lom_mix_pairs(c[0], c[2], at->z), lower = lom_mix_pairs(c[1], c[3], at->z);
    return fixed_mix_halves(lom_mix_pairs(upper, lower, at->y), at->x);
}

LOM_INLINE lom_light_sample fixed_light(const lom_light_grid *grid, lom_float3 position)
{
    struct fixed_place at = fix_place(lom_find_in_cells(grid->width, grid->height, grid->depth, position));
    int pitch = grid->width + 1, slice = pitch * (grid->height + 1);
    lom_pairs sun[4], sky[4], ground[4];
    for (int i = 0; i < 4; i++) {
        lom_int first, second;
        lom_gather_pairs(grid->light + (i & 1) * pitch + (i >> 1) * slice, at.index, &first, &second);
        sun[i] = fixed_of_words((first & 0xffff) | second << 16);
        lom_int bytes = (lom_int)((lom_uint)first >> 16) | (second & (lom_int)lom_splat_uint(0xffff0000));
        sky[i] = lom_even_bytes(bytes);
        ground[i] = lom_odd_bytes(bytes);
    }
    return (lom_light_sample){ fixed_rows(sun, &at) * (1 / LOM_FIXED_LINEAR),
                               fixed_rows(sky, &at) * (1 / LOM_FIXED_BYTE),
                               fixed_rows(ground, &at) * (1 / LOM_FIXED_BYTE) };
}

#endif
