/* Lists of lamps for squares of ground (shading/lamp.h). */
#ifndef LOM_RENDER_LAMP_TILES_H
#define LOM_RENDER_LAMP_TILES_H

#include "shading/lamp.h"

/* Where a lamp's light can be: x and z in [low, high]; at infinity: everywhere. */
struct lom_lamp_extent {
    double low[2], high[2];
    bool everywhere;
};

struct lom_lamp_tiles {
    double corner[2], side; /* metres */
    int columns, rows;
    uint32_t *first; /* of each tile's list, then that of all else (without tiles: of all lamps), and the end */
    uint16_t *list;
    size_t first_capacity, list_capacity;
};

/* Fills the tiles (zeros at first) for lamps in these extents; memory is kept. margin: metres by which a place that a
 * shader looks up may be off. without_tiles: one list of all lamps, for every place. False without memory. */
bool lom_fill_lamp_tiles(struct lom_lamp_tiles *tiles, const struct lom_lamp_extent *extents, size_t count,
                         double margin, bool without_tiles, lom_error *error);
void lom_free_lamp_tiles(struct lom_lamp_tiles *tiles);

#endif
