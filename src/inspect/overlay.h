/* Overlays: their kinds (overlay_kinds.c), how they are drawn (overlay.c), what eyes see of them (overlay_show.c) with a
 * legend (overlay_legend.c). */
#ifndef LOM_INSPECT_OVERLAY_H
#define LOM_INSPECT_OVERLAY_H

#include "render/tallied.h"

#include <lom/inspect.h>

/* How numbers become colours. */
enum overlay_look {
    OVERLAY_SCALE,    /* along the map, from low to high */
    OVERLAY_LINES,    /* distances to lines: bright within a pixel */
    OVERLAY_VECTORS,  /* -1 .. 1 as red, green, blue */
    OVERLAY_MARKS,    /* marked where not 0 */
    OVERLAY_VERTICES, /* 1 .. 3 along the map; 4 marked */
    OVERLAY_LOOKS
};

/* What a value is found from. */
struct overlay_place {
    const lom_tally *tally;
    const lom_camera_view *camera;
    uint64_t tile; /* weighted work of the pixel's tile */
};
typedef void overlay_value(const struct overlay_place *at, float *value);

struct overlay_row {
    lom_overlay_kind kind;
    overlay_value *value;
    enum overlay_look look;
    lom_tally_desc tally; /* its target is not set */
    bool by_tile;         /* needs overlay_place.tile */
};
/* The row whose kind this is. */
const struct overlay_row *lom_overlay_row(const lom_overlay_kind *kind);
/* The work of a texel, in quarters of a texture lookup. */
uint64_t lom_tally_work(const lom_tally *tally);

/* The ends of the scale in use. */
struct overlay_scale {
    double low, high;
    bool is_logarithmic;
    double from, length; /* low, and high less low; of their logarithms */
};
struct overlay_scale lom_overlay_scale(double low, double high, bool is_logarithmic);
/* Whether a value is shown: a logarithmic scale has no 0. */
bool lom_has_number(const struct overlay_scale *scale, float value);
/* 0..1 along the scale, bounded. */
double lom_overlay_part(const struct overlay_scale *scale, double value);

/* RGB8, the legend as asked for. picture: RGB8 of the numbers' size. NULL on failure. */
lom_image *lom_show_overlay(const struct overlay_row *row, const struct overlay_scale *scale, lom_legend legend,
                            const lom_image *numbers, const lom_image *picture, lom_error *error);

/* A legend for a picture of the numbers' width: how many rows it takes, and itself, into the lowest of them. */
int lom_legend_height(const struct overlay_row *row, const struct overlay_scale *scale, const lom_image *numbers);
void lom_draw_legend(const struct overlay_row *row, const struct overlay_scale *scale, const lom_image *numbers,
                     lom_image *shown);

/* The colours of lines, and of one made vertex to three of them. */
void lom_vertex_color(int made, uint8_t rgb[3]);
extern const uint8_t lom_line_color[3];

#endif
