/* Distances of cells. In: which are empty. Out: how far the nearest one is that is not. Invariant: a distance is exact
 * or capped at 255.
 *
 * Two sweeps with all neighbours of weight 1 give the Chebyshev distance exactly (Rosenfeld and Pfaltz 1968, in three
 * dimensions). Of the 13 neighbours that come before a cell in storage order 12 lie in four rows that are finished, so
 * a row takes their minimum without order, and then its own neighbour in order. */
#include "march/cells.h"

/* row[x] = min(row[x], 1 + min(from[x - 1], from[x], from[x + 1])), the ends without the neighbour they lack. */
static void relax_row(uint8_t *restrict row, const uint8_t *restrict from, int width)
{
    for (int x = 1; x < width; x++) {
        uint8_t nearest = from[x - 1] < from[x] ? from[x - 1] : from[x];
        nearest = nearest < from[x + 1] ? nearest : from[x + 1];
        uint8_t through = (uint8_t)(nearest + (nearest < 255));
        row[x] = through < row[x] ? through : row[x];
    }
    for (int end = 0; end <= width; end += width > 0 ? width : 1) {
        uint8_t nearest = from[end];
        if (end > 0 && from[end - 1] < nearest)
            nearest = from[end - 1];
        if (end < width && from[end + 1] < nearest)
            nearest = from[end + 1];
        uint8_t through = (uint8_t)(nearest + (nearest < 255));
        row[end] = through < row[end] ? through : row[end];
    }
}

static void relax_along(uint8_t *row, int width, int sign)
{
    for (int i = 1; i <= width; i++) {
        int x = sign > 0 ? i : width - i;
        int through = row[x - sign] + 1;
        row[x] = through < row[x] ? (uint8_t)through : row[x];
    }
}

/* The rows before (y, z) in the order of the sweep, sign -1 being the sweep from the last cell back. */
static const int8_t rows_before[4][2] = { { -1, -1 }, { 0, -1 }, { 1, -1 }, { -1, 0 } };

void lom_spread_distances(uint8_t *distance, int width, int height, int depth)
{
    for (int sign = 1; sign >= -1; sign -= 2)
        for (int k = 0; k <= depth; k++)
            for (int j = 0; j <= height; j++) {
                int z = sign > 0 ? k : depth - k, y = sign > 0 ? j : height - j;
                uint8_t *row = distance + cell_index(width, height, 0, y, z);
                for (int i = 0; i < 4; i++) {
                    int from_y = y + sign * rows_before[i][0], from_z = z + sign * rows_before[i][1];
                    if (from_y >= 0 && from_y <= height && from_z >= 0 && from_z <= depth)
                        relax_row(row, distance + cell_index(width, height, 0, from_y, from_z), width);
                }
                relax_along(row, width, sign);
            }
}
