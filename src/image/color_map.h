/* Colours for numbers: 256 of them from dark violet over blue and green to light yellow. */
#ifndef LOM_IMAGE_COLOR_MAP_H
#define LOM_IMAGE_COLOR_MAP_H

#include <stdint.h>

/* Red, green, blue in sRGB, the lowest first. Neighbours are equally far apart to the eye, and each is lighter than those
 * before it, so that the map is the same printed in gray, and to those who do not tell red from green. */
void lom_make_color_map(uint8_t map[256][3]);
/* Magenta: of what no number says, and far from all of the map. */
extern const uint8_t lom_mark_color[3];

#endif
