/* lom/shallow.h - shallow water over a bed: a height field that flows, dries and floods, with moving obstacles.
 *
 * The linearised shallow-water equations on a grid, q the discharge per metre of width through the faces of cells:
 *     dq/dt = -g H d(bed + h)/dx - friction |q| q / H^2,     dh/dt + dq/dx = sources,
 * solved implicitly along x and then along z, a tridiagonal system a line (M. Kass, G. Miller: Rapid, stable fluid
 * dynamics for computer graphics, SIGGRAPH 1990; V. Casulli: Semi-implicit finite difference methods for the
 * two-dimensional shallow water equations, J. Comput. Phys. 86, 1990). It is stable at any step. Depths change by what
 * flows through faces and nothing else, and a cell gives no more than it has: volume is kept to rounding, no depth is
 * ever negative. Left out: the water's own momentum is not carried along (no hydraulic jumps, no eddies), and waves of
 * all lengths travel at sqrt(g depth).
 *
 * Everything is double and in a fixed order: the same calls give the same bytes on every machine.
 * Conventions: y up; cell (i, j) is column i along x of row j along z; metres, seconds. */
#ifndef LOM_SHALLOW_H
#define LOM_SHALLOW_H

#include <lom/base.h>

LOM_API_BEGIN

enum { LOM_SHALLOW_LARGEST = 4096, LOM_SHALLOW_OBSTACLES = 64, LOM_SHALLOW_SOURCES = 64 };

typedef enum lom_shallow_edge {
    LOM_SHALLOW_WALL = 0, /* reflects */
    LOM_SHALLOW_FALL,     /* water that comes to it is gone */
    LOM_SHALLOW_OPEN      /* beyond it lies a body of water of a given level, which gives and takes */
} lom_shallow_edge;

/* Its zero value, with sizes and a bed, is a good one. */
typedef struct lom_shallow_desc {
    int columns, rows;        /* of cells, 2..LOM_SHALLOW_LARGEST each */
    double cell;              /* metres a side of one, 1e-3..1e5 */
    const double *bed;        /* columns * rows heights, row by row; |height| <= 1e5; copied */
    const double *depth;      /* of the water at first, as many, 0..1e5; copied; NULL: filled up to `level` */
    double level;             /* |level| <= 1e5 */
    double step;              /* seconds of a step, 1e-5..1e3; 0: 1/60 */
    double implicitness;      /* 0.5 (waves keep their energy) .. 1 (they are damped); 0: 0.55 */
    double gravity;           /* m/s^2, 1e-3..1000; 0: 9.80665 */
    double friction;          /* of the bed, without dimension, 0..10 (a natural bed: 0.003 to 0.03) */
    lom_shallow_edge edge[4]; /* at low x, high x, low z, high z */
    double edge_level[4];     /* of LOM_SHALLOW_OPEN, |level| <= 1e5 */
} lom_shallow_desc;

/* Water that is added (or, with a rate below 0, taken, as far as there is any) evenly over the cells whose middles lie
 * in a disc, or at the cell nearest to its middle. */
typedef struct lom_shallow_source {
    double x, z;   /* metres from the grid's corner of low x and z */
    double radius; /* metres, 0..1e6 */
    double rate;   /* m^3/s, |rate| <= 1e9 */
} lom_shallow_source;

/* A body in the water: an elliptic bowl that keeps `draft` (1 - r^2)^2 metres of the column above the bed for itself,
 * r the distance from its middle in parts of its half axes. What it displaces flows away and comes back. */
typedef struct lom_shallow_obstacle {
    double x, z;    /* metres from the same corner */
    double half[2]; /* half axes, metres, above 0 .. 1e6: along and across `heading` */
    double heading; /* radians from +x towards +z */
    double draft;   /* metres, 0..1e4 */
} lom_shallow_obstacle;

typedef struct lom_shallow lom_shallow;

/* NULL when a number is out of its range or none, with a sentence; nothing is allocated then. */
lom_shallow *lom_create_shallow(const lom_shallow_desc *desc, lom_error *error);
/* One that goes on as this one would: a checkpoint. NULL when memory runs out. */
lom_shallow *lom_copy_shallow(const lom_shallow *shallow, lom_error *error);
void lom_free_shallow(lom_shallow *shallow); /* NULL is allowed */

/* One step: the obstacles stand where they are said to for the whole of it. Either list may be NULL when its count is
 * 0. False, with a sentence and nothing changed, when a number is out of its range or none. */
bool lom_step_shallow(lom_shallow *shallow, const lom_shallow_source *sources, int source_count,
                      const lom_shallow_obstacle *obstacles, int obstacle_count, lom_error *error);

/* The state after the last step. Arrays belong to the water and hold until its next step; a cell's surface is at
 * bed + depth. */
typedef struct lom_shallow_view {
    int columns, rows;
    double cell, step;
    int64_t steps;       /* since the beginning */
    const double *bed;   /* columns * rows, what obstacles take of the column added */
    const double *depth; /* likewise; 0 is dry */
    const double *flow_x,
        *flow_z;   /* m^2/s through faces: (columns + 1) * rows at low x, columns * (rows + 1) at low z */
    double volume; /* m^3 */
    double gained,
        lost; /* m^3 since the beginning, by sources and over edges: volume is the first one + gained - lost */
} lom_shallow_view;
lom_shallow_view lom_view_shallow(const lom_shallow *shallow);

LOM_API_END

#endif
