/* A triangle between set-up, which writes it, and the stages of a tile, which read it: what kind it is, where its
 * vertices and its pixels lie. Its edge functions, area and depths follow from the vertices, and are found again where they are
 * needed. Invariant: its numbers are exact, or rounded once from exact ones. */
#ifndef LOM_PIPELINE_TRIANGLE_H
#define LOM_PIPELINE_TRIANGLE_H

#include <stdint.h>

typedef enum lom_triangle_kind {
    TRIANGLE_WINDOW = 0, /* fits an even-aligned 4x4 window inside one tile; mask holds its pixels */
    TRIANGLE_SMALL,      /* edge functions fit int32 */
    TRIANGLE_LARGE,      /* edge functions in 64 bits, rebased for each tile */
    TRIANGLE_NONE /* as the draw is: a sprite or point about vertex 0, or a line from vertex 0 to vertex 1, which is
                            vertex 2, too (sprite.c, line.c) */
} lom_triangle_kind;

/* After set-up, six words, written and read by lanes. Vertices are in the order of snapped (y, x), so nothing depends on the
 * order they came in. */
typedef struct lom_primitive {
    uint32_t row[3];      /* where the vertices' rows begin in the chunk's */
    uint32_t state;       /* TRIANGLE_WINDOW: bit k for pixel k of the window at (left & ~1, top & ~1); then the bits of
                             TRIANGLE_... */
    uint32_t first, last; /* pixels (frame, inclusive): left | top << 16, right | bottom << 16 */
} lom_primitive;

enum {                          /* lom_primitive.state */
       TRIANGLE_KIND = 16,      /* 2 bits: lom_triangle_kind */
       TRIANGLE_FRONT = 18,     /* front facing */
       TRIANGLE_CUT = 19,       /* its bounds were cut by the scissor, so coverage must be tested against them */
       TRIANGLE_PROVOKING = 20, /* 2 bits: which row is the provoking vertex's */
       TRIANGLE_LISTED = 22,    /* few pixels and no clip distance: drawn with others where the draw allows it */
       TRIANGLE_CLIP = 24       /* 8 bits: bit i for a clip distance i that changes sign inside */
};

/* What follows from a primitive's vertices. Edge function i is that of the edge opposite to vertex i, positive inside; the
 * three of them add up to twice the area. Of a sprite or point the steps are those of s and t, a pixel right and down. */
typedef struct lom_triangle {
    lom_primitive primitive;
    float step_x1, step_y1, step_x2, step_y2; /* edge functions 1 and 2: their change a pixel right and down, exact */
    float inverse_area;                       /* 1 / |twice the area|, both in units^2 */
    float depth[3];                           /* of vertex 0, then differences of 1 and 2 to it */
    int32_t area,
        start[2]; /* TRIANGLE_WINDOW, TRIANGLE_SMALL: twice the area, edge functions 1 and 2 at pixel (left & ~1,
                               top & ~1) */
} lom_triangle;

struct lom_bounds { /* pixels of the frame, inclusive */
    int left, top, right, bottom;
};

static inline lom_triangle_kind lom_kind_of(const lom_primitive *p)
{
    return (lom_triangle_kind)(p->state >> TRIANGLE_KIND & 3);
}

static inline struct lom_bounds lom_bounds_of(const lom_primitive *p)
{
    return (struct lom_bounds){ (int)(p->first & 0xffff), (int)(p->first >> 16), (int)(p->last & 0xffff),
                                (int)(p->last >> 16) };
}

#endif
