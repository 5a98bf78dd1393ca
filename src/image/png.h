/* What reading and writing PNG share (ISO/IEC 15948, the W3C recommendation "Portable Network Graphics"). */
#ifndef LOM_IMAGE_PNG_H
#define LOM_IMAGE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PNG_SIGNATURE = 8, PNG_CHUNK = 12 /* bytes of a chunk besides its data: length, type, CRC */ };
enum { PNG_GRAY = 0, PNG_RGB = 2, PNG_PALETTE = 3, PNG_GRAY_ALPHA = 4, PNG_RGB_ALPHA = 6 }; /* colour types */
enum { PNG_NONE, PNG_SUB, PNG_UP, PNG_AVERAGE, PNG_PAETH, PNG_FILTERS };

/* The neighbour nearest to left + above - corner, in this order of preference (section 9.4). */
static inline int png_paeth(int left, int above, int corner)
{
    int to_left = above - corner, to_above = left - corner, to_corner = to_left + to_above;
    to_left = to_left < 0 ? -to_left : to_left;
    to_above = to_above < 0 ? -to_above : to_above;
    to_corner = to_corner < 0 ? -to_corner : to_corner;
    int other = to_above <= to_corner ? above : corner;
    return to_left <= to_above && to_left <= to_corner ? left : other;
}

/* Undoes the filter of a row in place; above: the row before it, unfiltered, or zeros; step: bytes of a pixel, at least
 * 1. False when there is no such filter. */
bool lom_png_unfilter(uint8_t *row, const uint8_t *above, size_t size, size_t step, int filter);

#endif
