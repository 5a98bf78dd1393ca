/* How many triangles each tile of a pass got: steps_tiles.c. */
#ifndef LOM_INSPECT_STEPS_TILES_H
#define LOM_INSPECT_STEPS_TILES_H

#include "inspect/steps.h"

struct tiles {
    uint64_t *count; /* row by row */
    size_t capacity;
    int edge, columns, rows;
};

void lom_count_bin(const struct steps *s, struct tiles *tiles, const lom_rect *tile, size_t triangles);
/* Over what is on the canvas: a colour and a number each. */
void lom_draw_tiles(const struct steps *s, const struct tiles *tiles, struct canvas *canvas);

#endif
