/* Enlarging. Compiled for speed. In: pixels. Out: a row of more of them. Invariant: pixels that are equal stay what they
 * are.
 *
 * With factor f, pixel k of the f that a pixel becomes lies (2 k + 1) / (2 f) into it: (2 k + 1 - f) / (2 f) of a pixel away
 * from its middle, which is the weight of the neighbour on that side; in eighths |2 k + 1 - f| * 4 / f. */
#include "view_enlarge.h"

static int eighths(int k, int factor)
{
    int away = 2 * k + 1 - factor;
    return (away < 0 ? -away : away) * 4 / factor;
}

static void blend(const uint8_t *restrict a, const uint8_t *restrict b, int of_b, int count, uint8_t *restrict to)
{
    const uint16_t first = (uint16_t)(8 - of_b), second = (uint16_t)of_b;
    for (int i = 0; i < count; i++)
        to[i] = (uint8_t)((uint16_t)(first * a[i] + second * b[i] + 4) >> 3);
}

/* The row that lies next to row `at` on the side of part k. */
static int neighbour(int at, int k, int factor, int rows)
{
    int next = 2 * k + 1 < factor ? at - 1 : at + 1;
    return next < 0 ? 0 : next >= rows ? rows - 1 : next;
}

void lom_enlarge_row(const uint32_t *picture, int small, int rows, int factor, int y, int width, uint32_t *to)
{
    uint32_t row[LOM_MAX_ENLARGED + 2], part[LOM_MAX_ENLARGED]; /* with the border's pixels once more at its ends */
    const int at = y / factor, of_y = y % factor, other = neighbour(at, of_y, factor, rows);
    blend((const uint8_t *)(picture + (size_t)at * (size_t)small),
          (const uint8_t *)(picture + (size_t)other * (size_t)small), eighths(of_y, factor), 4 * small,
          (uint8_t *)(row + 1));
    row[0] = row[1];
    row[small + 1] = row[small];
    for (int k = 0; k < factor; k++) {
        const uint32_t *beside = 2 * k + 1 < factor ? row : row + 2;
        blend((const uint8_t *)(row + 1), (const uint8_t *)beside, eighths(k, factor), 4 * small, (uint8_t *)part);
        for (int x = 0; x * factor + k < width; x++)
            to[x * factor + k] = part[x];
    }
}
