/* Lines of an attachment fetched before they are stored. A store waits for its line, which was last in a cache a frame
 * ago, and a row of a tile is too short for the processor to foresee where the next one lies. */
#ifndef LOM_PIPELINE_ROWS_AHEAD_H
#define LOM_PIPELINE_ROWS_AHEAD_H

#include "pipeline/stages.h"

enum { ROWS_AHEAD = 6, LINE_WORDS = 16 };

/* Row y of the rectangle, of so many words a pixel, if there is one. */
static inline void lom_fetch_row(const struct lom_rectangle *r, int words, int y)
{
    if (y >= r->height)
        return;
    const uint32_t *row = r->texels + (size_t)y * r->pitch;
    for (int x = 0; x < r->width * words; x += LINE_WORDS)
        __builtin_prefetch(row + x, 1);
}

#endif
