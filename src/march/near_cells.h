/* What a packet of rays reads of a grid of cells, where its lanes lie near one another: a few rows of four words that all
 * lanes share, and a permutation for each corner, in place of loads for each lane. Rays of a window of pixels are a small
 * part of a voxel apart as long as voxels are larger than pixels.
 *
 * Invariant: the words that the gathers of lom/march.h give, which remain for packets whose lanes lie farther apart. */
#ifndef LOM_MARCH_NEAR_CELLS_H
#define LOM_MARCH_NEAR_CELLS_H

#include "lanes/fours.h"

#include <lom/march.h>

/* Rows of four are shared by as many lanes as pay for them; widths that are lowered are to be small. */
#if LOM_LANES == 16 && !defined LOM_LOWERED
enum { SHARES_ROWS = true };
#else
enum { SHARES_ROWS = false };
#endif

/* Where the lanes lie in a volume: indices and weights, and each lane's cell by axes. */
struct spot {
    lom_volume_place place;
    lom_int x, y, z;
};

LOM_INLINE struct spot find_spot(const lom_volume *volume, lom_float3 position)
{
    struct spot spot;
    spot.place.x = lom_volume_axis(position.x, volume->width, &spot.x);
    spot.place.y = lom_volume_axis(position.y, volume->height, &spot.y);
    spot.place.z = lom_volume_axis(position.z, volume->depth, &spot.z);
    spot.place.index = (spot.z * (volume->height + 1) + spot.y) * (volume->width + 1) + spot.x;
    return spot;
}

/* The least cell of lanes that lie in two neighbouring ones; of other lanes some number that `share` finds out. */
LOM_INLINE int first_of_two(lom_int cell)
{
    return cell[0] - lom_any(cell < lom_splat_int(cell[0]));
}

/* The cells of the lanes from (x, y, z) on, within `across` and two by two. */
struct share {
    int x, y, z;
    lom_int dx, dy, dz;
    bool holds; /* whether all lanes lie there */
};

LOM_INLINE struct share find_share(const struct spot *spot, int x, int y, int z, int across)
{
    struct share s = { x, y, z, spot->x - x, spot->y - y, spot->z - z, false };
    s.holds = lom_all(((lom_uint)s.dx < (uint32_t)across) & ((lom_uint)(s.dy | s.dz) < 2u));
    return s;
}

LOM_INLINE int lesser_cell(int a, int b)
{
    return a < b ? a : b;
}

/* Words low and high of the cells' densities (lom_sample_density). */
LOM_INLINE void load_densities(const lom_volume *volume, const struct spot *spot, lom_int *low, lom_int *high)
{
    if (SHARES_ROWS) {
        struct share s = find_share(spot, first_of_two(spot->x), first_of_two(spot->y), first_of_two(spot->z), 2);
        if (s.holds) {
            int pitch = volume->width + 1, slice = pitch * (volume->height + 1);
            const int32_t *first = volume->density + 2 * (s.z * slice + s.y * pitch + s.x);
            const int32_t *row[LOM_LANES / 4];
            for (int k = 0; k < LOM_LANES / 4; k++)
                row[k] = first + 2 * ((k >> 1) * slice + (k & 1) * pitch);
            lom_float cells = lom_as_float(lom_load_fours(row));
            lom_int which = s.dz * 8 + s.dy * 4 + s.dx * 2;
            *low = lom_as_int(lom_permute(cells, which));
            *high = lom_as_int(lom_permute(cells, which + 1));
            return;
        }
    }
    lom_gather_pairs(volume->density, spot->place.index + spot->place.index, low, high);
}

static __attribute__((noinline, unused)) void gather_corners(const lom_volume *volume, const lom_int *index,
                                                             lom_int corner[8])
{
    lom_load_volume_corners(volume, (lom_volume_place){ .index = *index }, corner);
}

/* lom_load_volume_corners. Three slices of three rows hold the corners of 2 x 2 cells and of 3 across. */
LOM_INLINE void load_corners(const lom_volume *volume, const struct spot *spot, lom_int corner[8])
{
    if (!SHARES_ROWS) {
        lom_load_volume_corners(volume, spot->place, corner);
        return;
    }
    /* rows and slices end within the grid */
    int x = lesser_cell(first_of_two(spot->x), volume->width - 3);
    int y = lesser_cell(first_of_two(spot->y), volume->height - 2);
    int z = lesser_cell(first_of_two(spot->z), volume->depth - 2);
    struct share s = find_share(spot, x, y, z, 3);
    if (!s.holds || (x | y | z) < 0) {
        gather_corners(volume, &spot->place.index, corner);
        return;
    }
    int pitch = volume->width + 1, slice = pitch * (volume->height + 1);
    lom_int plane[3];
    for (int k = 0; k < 3; k++) {
        const int32_t *first = volume->color + (z + k) * slice + y * pitch + x;
        const int32_t *row[LOM_LANES / 4];
        for (int j = 0; j < LOM_LANES / 4; j++)
            row[j] = first + (j < 3 ? j : 2) * pitch;
        plane[k] = lom_load_fours(row);
    }
    lom_int which = s.dz * 16 + s.dy * 4 + s.dx;
    for (int i = 0; i < 8; i++)
        corner[i] = lom_permute_two(plane[i >> 2], plane[(i >> 2) + 1], which + ((i >> 1 & 1) * 4 + (i & 1)));
}

/* lom_sample_volume_all of corners that are loaded, and its operations. */
LOM_INLINE lom_float3 mix_corners(const lom_int corner[8], lom_volume_place place, lom_float *density)
{
    lom_int high[8];
    for (int i = 0; i < 8; i++)
        high[i] = (lom_int)((lom_uint)corner[i] >> 24);
    *density = lom_volume_channel(high, 0xff, place) * (1 / 255.0f);
    return (lom_float3){ lom_volume_channel(corner, 0xff, place) * (1 / 255.0f),
                         lom_volume_channel(corner, 0xff00, place) * (0x1p-8f / 255.0f),
                         lom_volume_channel(corner, 0xff0000, place) * (0x1p-16f / 255.0f) };
}

#endif
