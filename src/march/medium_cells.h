/* What a march reads of media, noise and grids of light at a packet's places. In: places. Out: what lom/march.h defines there.
 *
 * Invariant: the words that lom/march.h gathers, by the processor's own gathers where these are faster. */
#ifndef LOM_MARCH_MEDIUM_CELLS_H
#define LOM_MARCH_MEDIUM_CELLS_H

#include "lanes/gathers.h"

#include <lom/march.h>

/* The words of each lane's cell: of x and x + 1, at its y and at the next. */
struct medium_words {
    lom_int upper[2], lower[2];
};

LOM_INLINE void load_medium(const lom_medium *m, lom_int index, struct medium_words *words)
{
    lom_gather_pairs_by(m->gathers, m->density, index, &words->upper[0], &words->upper[1]);
    lom_gather_pairs_by(m->gathers, m->density + m->width + 1, index, &words->lower[0], &words->lower[1]);
}

/* lom_sample_detail. */
LOM_INLINE lom_float read_detail(bool gathers, const lom_detail *detail, lom_float3 at)
{
    lom_volume_place place = lom_find_in_detail(detail, at);
    lom_int low, high;
    lom_gather_pairs_by(gathers, detail->corners, place.index + place.index, &low, &high);
    return lom_mix_corners(low, high, place);
}

/* lom_sample_light. */
LOM_INLINE lom_light_sample read_light(bool gathers, const lom_light_grid *grid, lom_float3 position)
{
    lom_volume_place place = lom_find_in_cells(grid->width, grid->height, grid->depth, position);
    const int pitch = grid->width + 1, slice = pitch * (grid->height + 1);
    lom_int corner[8];
    for (int i = 0; i < 8; i += 2)
        lom_gather_pairs_by(gathers, grid->light + (i >> 1 & 1) * pitch + (i >> 2) * slice, place.index, &corner[i],
                            &corner[i + 1]);
    return lom_mix_light(corner, place);
}

#endif
