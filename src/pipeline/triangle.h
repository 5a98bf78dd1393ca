/* A triangle between set-up, which writes it, and the stages of a tile, which read it: what kind it is, where its
 * pixels lie, its edge functions. Invariant: its numbers are exact, or rounded once from exact ones. */
#ifndef LOM_PIPELINE_TRIANGLE_H
#define LOM_PIPELINE_TRIANGLE_H

#include <stdint.h>

typedef enum lom_triangle_kind {
    TRIANGLE_WINDOW = 0, /* fits an even-aligned 4x4 window inside one tile; mask holds its pixels */
    TRIANGLE_SMALL,      /* edge functions fit int32 */
    TRIANGLE_LARGE,      /* edge functions in 64 bits, rebased for each tile */
    TRIANGLE_NONE        /* as the draw is: a sprite or point about vertex 0, the steps are those of s and t, a pixel
                            right and down; or a line from vertex 0 to vertex 1, which is vertex 2, too (line.c) */
} lom_triangle_kind;

/* A triangle after set-up, 16 words (four rows of four, written and read by lanes). Its vertices are in the order of
 * snapped (y, x), so nothing depends on the order they came in. Edge function i is that of the edge opposite to vertex
 * i, positive inside; the three of them add up to twice the area. */
typedef struct lom_triangle {
    float step_x1, step_y1, step_x2, step_y2; /* edge functions 1 and 2: their change a pixel right and down, exact */
    float inverse_area;                       /* 1 / |twice the area|, both in units^2 */
    float depth[3];                           /* of vertex 0, then differences of 1 and 2 to it */
    union {
        struct { /* else: twice the area, edge functions 1 and 2 at pixel (left & ~1, top & ~1) */
            int32_t area, start[2];
        } small;
        struct { /* TRIANGLE_LARGE, TRIANGLE_NONE: the last pixel, inclusive */
            int32_t right, bottom, unused;
        } large;
    };
    uint32_t first;  /* first pixel (frame, inclusive): left | top << 16 */
    uint32_t row[3]; /* where the vertices' rows begin in the chunk's */
    uint32_t state;  /* TRIANGLE_WINDOW: bit k for pixel k of the window at (left & ~1, top & ~1); TRIANGLE_SMALL:
                        right - left | (bottom - top) << 8; then the bits of TRIANGLE_... */
} lom_triangle;

enum {                          /* lom_triangle.state */
       TRIANGLE_KIND = 16,      /* 2 bits: lom_triangle_kind */
       TRIANGLE_FRONT = 18,     /* front facing */
       TRIANGLE_CUT = 19,       /* its bounds were cut by the scissor, so coverage must be tested against them */
       TRIANGLE_PROVOKING = 20, /* 2 bits: which row is the provoking vertex's */
       TRIANGLE_CLIP = 24       /* 8 bits: bit i for a clip distance i that changes sign inside */
};

struct lom_bounds { /* pixels of the frame, inclusive */
    int left, top, right, bottom;
};

static inline lom_triangle_kind lom_kind_of(const lom_triangle *t)
{
    return (lom_triangle_kind)(t->state >> TRIANGLE_KIND & 3);
}

static inline struct lom_bounds lom_bounds_of(const lom_triangle *t)
{
    int left = (int)(t->first & 0xffff), top = (int)(t->first >> 16);
    switch (lom_kind_of(t)) {
    case TRIANGLE_LARGE:
    case TRIANGLE_NONE:
        return (struct lom_bounds){ left, top, t->large.right, t->large.bottom };
    case TRIANGLE_SMALL:
        return (struct lom_bounds){ left, top, left + (int)(t->state & 255), top + (int)(t->state >> 8 & 255) };
    default: /* lies within one tile, which its first pixel names */
        return (struct lom_bounds){ left, top, left, top };
    }
}

#endif
