/* Text in pictures: printable ASCII in letters of 5 x 7 pixels, two more below the line for descenders, each pixel
 * `scale` x `scale` of the picture's. */
#ifndef LOM_IMAGE_GLYPHS_H
#define LOM_IMAGE_GLYPHS_H

#include <stddef.h>
#include <stdint.h>

enum {
    LOM_GLYPH_WIDTH = 5,
    LOM_GLYPH_HEIGHT = 9, /* the lowest two: g, j, p, q, y, _ and the like */
    LOM_GLYPH_STEP = 6,   /* from a letter to the next */
    LOM_GLYPH_LINE = 11   /* from a line to the next */
};

/* Pixels of 3 or 4 bytes in the caller's memory. */
struct lom_pixel_rows {
    uint8_t *pixels;
    size_t pitch; /* bytes from a row to the next */
    int width, height, bytes;
};

/* Draws text whose first letter's top left pixel is (x, y), at scale >= 1; '\n' begins a line. What lies outside the
 * picture is cut off; what is not ASCII is a box. ink and edge: the bytes of a pixel, in the order of the rows'; the edge
 * is one scaled pixel around all ink, NULL: none. */
void lom_draw_text(const struct lom_pixel_rows *rows, int x, int y, int scale, const char *text, const uint8_t *ink,
                   const uint8_t *edge);
/* Pixels from the left of a text's first letter to the right of its last, of the longest line; 0 when there is none. */
int lom_text_width(const char *text, int scale);

#endif
