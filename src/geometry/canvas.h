/* A square picture in the making: sRGB-encoded colours and heights in doubles that repeat at the borders. Painters fill
 * it, and lom_make_albedo rounds it. */
#ifndef LOM_GEOMETRY_CANVAS_H
#define LOM_GEOMETRY_CANVAS_H

#include "geometry/noise.h"

#include <lom/geometry.h>

typedef struct lom_canvas {
    int size;
    lom_noise noise;
    uint64_t seed;
    double (*color)[3]; /* size x size, 0..1 */
    double *height;     /* size x size, in pixels, for the shading of relief */
} lom_canvas;

typedef struct lom_tint {
    double r, g, b;
} lom_tint;

/* Colours are written as they are seen: 0..255. */
lom_tint lom_tint_of(int r, int g, int b);
lom_tint lom_mix_tint(lom_tint a, lom_tint b, double t);
lom_tint lom_scale_tint(lom_tint a, double factor);
void lom_put_tint(lom_canvas *canvas, int x, int y, lom_tint tint);
/* The index of (x, y), wrapped. */
size_t lom_canvas_index(const lom_canvas *canvas, int x, int y);
/* Mixes tint over (x, y), wrapped, by coverage 0..1. */
void lom_cover(lom_canvas *canvas, int x, int y, lom_tint tint, double coverage);
/* A stroke from (x, y), `length` pixels towards the unit vector (dx, dy), bent sideways by `bend` of its length, as
 * wide as `width` at its foot and thin at its tip, from the first to the second colour. */
typedef struct lom_stroke {
    double x, y, dx, dy, length, width, bend;
    lom_tint foot, tip;
} lom_stroke;
void lom_paint_stroke(lom_canvas *canvas, const lom_stroke *stroke);
/* Multiplies the colour by 1 + strength * the slope of the height towards the light at the upper left. */
void lom_shade_relief(lom_canvas *canvas, double strength);
/* A number of [0, 1) that belongs to (what, which). */
double lom_canvas_random(const lom_canvas *canvas, unsigned what, unsigned which);

/* The painters, by file. */
void lom_paint_grass(lom_canvas *canvas);
void lom_paint_forest(lom_canvas *canvas);
void lom_paint_rock(lom_canvas *canvas);
void lom_paint_shore(lom_canvas *canvas);
void lom_paint_snow(lom_canvas *canvas);
void lom_paint_planks(lom_canvas *canvas);
void lom_paint_paint(lom_canvas *canvas);
void lom_paint_livery(lom_canvas *canvas);
void lom_paint_log(lom_canvas *canvas);
void lom_paint_shingles(lom_canvas *canvas);
void lom_paint_bark(lom_canvas *canvas);
void lom_paint_masonry(lom_canvas *canvas);
void lom_paint_needles(lom_canvas *canvas);
void lom_paint_reed(lom_canvas *canvas);
void lom_paint_window(lom_canvas *canvas);
void lom_paint_lit_window(lom_canvas *canvas);
void lom_paint_net(lom_canvas *canvas);

#endif
