/* What rubs in a liquid that has viscosity: unknown velocities of faces, and samples of strain between them. */
#ifndef LOM_FLUID_FLUID_STRAIN_H
#define LOM_FLUID_FLUID_STRAIN_H

#include "fluid/fluid.h"

/* Differences of faces: number[1] - number[0] + number[3] - number[2]; unknown `count` is always 0. */
struct lom_fluid_sample {
    uint32_t number[4];
    double k; /* times dt over the cell's side squared */
};

/* Of a slab of cells across z: how many there are, then how many are before them; one slab more ends the last. */
struct lom_fluid_slab {
    size_t faces, samples;
};

struct lom_fluid_strain {
    struct lom_fluid_sample *samples;
    size_t sample_count, sample_capacity;
    size_t count, capacity; /* of unknowns: faces */
    size_t *face;           /* count each: 3 times the number, and the axis */
    double *x, *residual, *way, *product, *diagonal;
    uint32_t *unknown; /* of a face, 3 times the number, and the axis; UINT32_MAX: none */
    double *viscosity; /* of a cell, times dt over the side squared */
    struct lom_fluid_slab *slabs;
    /* Which samples an unknown is in, in their order: from first[i] to first[i + 1] 4 times the sample, and its place in it. */
    uint32_t *first, (*touch)[4];
    double *pull;       /* of each sample */
    atomic_uchar *done; /* of lom_sum_fluid */
};

/* Conjugate gradients from x on with the diagonal as preconditioner; the rounds. */
int lom_solve_strain(struct lom_fluid *f);

#endif
