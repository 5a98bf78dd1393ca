/* The flow of a river: a field of velocities derived from the bed and the level, and ripples that it carries. */
#ifndef LOM_WAVES_RIVER_H
#define LOM_WAVES_RIVER_H

#include <lom/image.h>

/* Steady flow without friction or whirls in water of depth h: v = -grad p with div(h grad p) = 0, p = 1 where the water
 * enters over the border rows and columns of the map on the side that `direction` (radians from +x towards +z) comes
 * from, 0 where it leaves on the other, and no flow through the shores. depth: size x size metres, 0 or less is land.
 * Velocities are scaled to a mean speed of 1 over the water. An RG32F picture of vx, vz; NULL on failure. */
lom_image *lom_make_river(const double *depth, int size, double direction, lom_error *error);

/* What it is made of for a site: LOM_RIVER_CELLS a side over the bed, or without one water of 1 m everywhere. */
enum { LOM_RIVER_CELLS = 160 };
struct lom_wave_site;
void lom_find_river_depths(const struct lom_wave_site *site, double *depth);

/* ---- river_foam.c ---- */

struct lom_river_foam_desc {
    const double *depth; /* of each cell, metres; 0 or less is land */
    double speed;        /* m/s that a velocity of 1 stands for, above 0 */
    double cell[2];      /* metres from cell to cell along x and z */
    double window;       /* seconds after which 1/e of foam is left */
};
/* The foam that lies on each cell of a square field of lom_make_river, 0 none .. 1: it is made where the water is
 * faster than 0.7 sqrt(g d) (of shallow water the same), goes with the water, and fades. */
void lom_carry_river_foam(float *foam, const lom_image *field, const struct lom_river_foam_desc *desc);

#endif
