/* What volumes and media share: the order of their cells, and how far each is from what is not empty. */
#ifndef LOM_MARCH_CELLS_H
#define LOM_MARCH_CELLS_H

#include "base/numbers.h"

#include <lom/march.h>

/* The index of a cell of a volume of width x height x depth voxels. */
static inline size_t cell_index(int width, int height, int x, int y, int z)
{
    return ((size_t)z * (size_t)(height + 1) + (size_t)y) * (size_t)(width + 1) + (size_t)x;
}

/* distance holds 0 for cells that are not empty and 255 for the others; afterwards each is the Chebyshev distance to
 * the nearest that is not, at most 255. */
void lom_spread_distances(uint8_t *distance, int width, int height, int depth);

#endif
