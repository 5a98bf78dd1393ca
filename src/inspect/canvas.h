/* A canvas for pictures of what the stages did: lines, dots, rectangles, digits, in the numbers of an 8-bit sRGB picture. */
#ifndef LOM_INSPECT_CANVAS_H
#define LOM_INSPECT_CANVAS_H

#include <lom/inspect.h>

/* Red, green, blue, 0..1, and how much of what is below it hides. */
struct ink {
    float color[3], cover;
};

struct canvas {
    int width, height;
    float *color; /* three a pixel */
};

/* All of one colour; false without memory. Emptied by lom_clear_canvas. */
bool lom_make_canvas(struct canvas *canvas, int width, int height, struct ink ground, lom_error *error);
void lom_clear_canvas(struct canvas *canvas);
/* RGB8_SRGB; NULL without memory. */
lom_image *lom_canvas_image(const struct canvas *canvas, lom_error *error);

/* Places are in pixels, centres at .5; what lies outside is left out. */
void lom_draw_line(struct canvas *canvas, const double a[2], const double b[2], struct ink ink);
void lom_draw_dot(struct canvas *canvas, const double at[2], double radius, struct ink ink);
void lom_fill_box(struct canvas *canvas, int x, int y, int width, int height, struct ink ink);
void lom_draw_box(struct canvas *canvas, double x, double y, double width, double height, struct ink ink);
/* A number of digits `size` pixels a dot, 3 by 5 dots each, around a middle. */
void lom_draw_number(struct canvas *canvas, int x, int y, int size, uint64_t number, struct ink ink);

/* ---- colours of numbers ---- */

enum { LOM_RAMP_COLORS = 9 };
/* From dark blue to yellow (0..1 into color), or, of what has a sign, from blue by dark to orange. */
extern const uint8_t lom_ramp[LOM_RAMP_COLORS][3], lom_signed_ramp[LOM_RAMP_COLORS][3];
void lom_ramp_color(const uint8_t ramp[LOM_RAMP_COLORS][3], double share, uint8_t color[3]);
/* A colour for a number, bright and unlike its neighbours'. */
struct ink lom_ink_of(uint64_t number, float cover);

/* Every pixel as a square of `times` pixels; frees the image. NULL on failure, and when it is NULL. */
lom_image *lom_magnify(lom_image *image, int times, lom_error *error);

#endif
