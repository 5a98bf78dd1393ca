/* The work on the maps of surf, shared by the files that make them: surf.c and surf_onset.c. */
#ifndef LOM_WAVES_SURF_WORK_H
#define LOM_WAVES_SURF_WORK_H

#include "waves/surf.h"

/* Of the depth: the height from which on a wave breaks (McCowan 1894). */
static const double lom_breaking_ratio = 0.78;

/* The work on a grid. */
struct surf {
    const struct lom_surf_desc *desc;
    int width, height;
    double frequency, shallowest;                  /* depth below which waves run up as a sheet of this depth */
    double *depth, *number, *phase, *flux, *speed; /* speed: of the group */
    double (*normal)[2];                           /* of the crests, the way the waves go */
    int8_t (*from)[2]; /* the neighbours, -1, 0 or 1 along x and z, from which a wave comes */
    bool *breaks;
    int edge;                     /* 0 left, 1 right, 2 top, 3 bottom: where the waves come in */
    double along;                 /* rad/m: how the phase runs along it, towards larger x or z */
    struct lom_surf_onset *onset; /* surf_onset.c */
};

/* What flows into a cell from the neighbours along x and z that its wave comes from: the flux in, the share of its own
 * that flows out, of each; whether waves break where most comes from. */
struct lom_surf_inflow {
    int neighbour[2];
    double in, out, part[2];
    bool breaks;
};
struct lom_surf_inflow lom_surf_inflow_of(const struct surf *s, int i);

/* Waves do not feel what is much shorter than they are: [1 2 1] / 4 along both axes, twice. */
void lom_smooth_surf(const struct surf *s, double *grid, double *scratch);
/* Solves each cell but those of the edge, over and over, from each corner, until none changes. `solve` says whether it
 * changed its cell. */
void lom_sweep_surf(struct surf *s, bool (*solve)(struct surf *s, int x, int y));

/* surf_onset.c: fills map->curls from fluxes and phases that are solved. False when memory runs out. */
bool lom_fill_surf_curls(struct surf *s, struct lom_surf_map *map, lom_error *error);
/* The crest and the trough of each cell's wave, when the shapes of its cells are known. */
void lom_shape_surf_curls(struct lom_surf_map *map, double frequency);

#endif
