/* A small picture, enlarged while something moves. */
#ifndef LOM_CLI_VIEW_ENLARGE_H
#define LOM_CLI_VIEW_ENLARGE_H

#include <stddef.h>
#include <stdint.h>

enum { LOM_MAX_ENLARGED = 4096 }; /* pixels of a row that is enlarged */

/* Row y of a picture (4 bytes a pixel, `small` x `rows` pixels, at most LOM_MAX_ENLARGED wide) enlarged 2 or 4 times: the
 * first `width` pixels of it, at most factor * small. Between the middles of four pixels it is bilinear, in eighths,
 * rounded once in each direction; outside of them the border goes on. */
void lom_enlarge_row(const uint32_t *picture, int small, int rows, int factor, int y, int width, uint32_t *to);

#endif
