/* A liquid between its steps, and the stages of a step. Lengths are cells, from the basin's low corner; a cell and its
 * faces towards low x, y and z share a number: i + j stride[1] + k stride[2], with one more column, layer and row than
 * there are cells, for the faces of the high sides. */
#ifndef LOM_FLUID_FLUID_H
#define LOM_FLUID_FLUID_H

#include "base/threads.h"

#include <lom/fluid.h>

#include <stdatomic.h>

struct lom_fluid_point {
    double at[3];
    double velocity[3];  /* cells/s */
    double affine[3][3]; /* 1/s: derivative of velocity [component] along [axis] */
    double heat;         /* degrees: the temperature, and what has been taken in to melt (fluid_heat.c) */
};

enum lom_fluid_kind { LOM_FLUID_AIR, LOM_FLUID_LIQUID, LOM_FLUID_SOLID };
enum { LOM_FLUID_GROUND = 8 };

/* What particles leave at a face. */
struct lom_fluid_face {
    double mass;     /* 1: of a particle */
    double velocity; /* the momentum, until all have been added */
    double push;     /* cells that particles are moved along the axis by their density */
};

enum { LOM_FLUID_NONE = -1, LOM_FLUID_REST = 8 }; /* no unknown; particles of a cell at rest */

/* A symmetric system of a row an unknown: diagonal[i] x[i] - the sum of x over neighbour[i] = right[i]. Neighbours
 * that are not there are number `count`, where x is 0. */
struct lom_fluid_system {
    size_t count;
    uint32_t (*neighbour)[6];
    double *diagonal, *right, *x;
    double *residual, *way, *product; /* scratch */
    double *partial;                  /* sums of pieces */
    double (*share)[6];               /* of each neighbour: the factor of its x; NULL: 1 */
    atomic_uchar *done;               /* of parts of pieces (lom_sum_fluid) */
};

/* The ground (fluid_floor.c); heights in cells. */
struct lom_fluid_floor {
    double *height;        /* at the corners of columns: i + k stride[1] */
    double *volume, *rest; /* of a cell: what is open of it, and the density it has when it is full */
    double *area[3];       /* of a face: what is open of it */
};

struct lom_fluid {
    lom_fluid_desc desc; /* with its defaults; blocks and solids are the fluid's own */
    lom_fluid_body *solids;
    int cells[3];
    size_t stride[3], count; /* numbers of cells and faces */
    double cell;             /* metres */
    int64_t steps;
    lom_device *device; /* of the step that runs */

    struct lom_fluid_point *points, *sorted;
    size_t point_count;
    uint32_t *place; /* of each point while they are sorted */
    uint32_t *first; /* of the points of a cell, count + 1 */
    struct lom_fluid_face *face[3];
    double *density;   /* particles a cell, weighted by their distance */
    double *cell_heat; /* of a cell's particles, their mean */
    uint8_t *kind;     /* of cells */
    uint8_t *open;     /* of faces: bit of an axis where it is no wall, LOM_FLUID_GROUND << axis where that is the
                                  ground's */
    struct lom_fluid_floor *floor; /* NULL: no ground reaches into the basin */
    double *solid_temperature;     /* of solids that heat, else NAN; NULL: none does */

    size_t wet;
    uint32_t *cell_of; /* an unknown's cell */
    int32_t *unknown;  /* a cell's unknown, or LOM_FLUID_NONE */
    double *pressure;  /* cells^2/s, times the step; of the last step, by cell */
    double *push;      /* cells^2: the potential that moves particles apart, by cell */
    struct lom_fluid_system system;
    struct lom_fluid_strain *strain; /* of viscosity; NULL: there is none */
    int rounds[4];
};

/* Calls work for ranges of at most `piece` that begin at its multiples, on the step's device. */
void lom_share_fluid(const struct lom_fluid *f, size_t count, size_t piece, lom_range_work *work, void *context);

/* fluid_points.c: particles sorted by cell; summed into faces and densities; and moved by the faces. */
void lom_sort_fluid(struct lom_fluid *f);
void lom_gather_fluid(struct lom_fluid *f);
void lom_move_fluid(struct lom_fluid *f);
/* A particle's weight, added to the densities around a place in cells. */
void lom_add_density(struct lom_fluid *f, const double at[3], double weight);

/* fluid_cells.c: which cells are wet, and the rows of the system that their pressures solve. */
void lom_find_wet_cells(struct lom_fluid *f);
/* The part of a cell's side from the middle of a wet cell to the surface, towards a neighbour with air. */
double lom_fluid_surface_at(const struct lom_fluid *f, size_t wet, size_t air);
/* What has been added to solids' cells goes to those beside them. */
void lom_return_density(struct lom_fluid *f);
/* The density of a cell at rest. */
static inline double lom_fluid_rest(const struct lom_fluid *f, size_t n)
{
    return f->floor == NULL ? LOM_FLUID_REST : f->floor->rest[n];
}

/* fluid_floor.c: the ground's heights, where there is one; then, of cells that are marked, what it leaves open. Whether a
 * cell is the ground's; and a particle put onto it where it would be below: false: it cannot be. */
bool lom_open_floor(struct lom_fluid *f, lom_error *error);
bool lom_cut_cells(struct lom_fluid *f, lom_error *error);
void lom_close_floor(struct lom_fluid *f);
double lom_fluid_floor_at(const struct lom_fluid *f, double x, double z);
double lom_fluid_open_volume(const struct lom_fluid *f, const size_t at[3]);
bool lom_floor_fills(const struct lom_fluid *f, const size_t at[3]);
bool lom_is_ground(const struct lom_fluid *f, size_t n);
bool lom_put_on_ground(const struct lom_fluid *f, double at[3]);

/* fluid_pressure.c: faces without divergence; and the potential that pushes particles apart. */
void lom_project_fluid(struct lom_fluid *f);
void lom_push_fluid(struct lom_fluid *f);

/* fluid_viscosity.c, fluid_heat.c */
bool lom_open_strain(struct lom_fluid *f, lom_error *error);
void lom_close_strain(struct lom_fluid *f);
bool lom_shear_fluid(struct lom_fluid *f, lom_error *error);
void lom_heat_fluid(struct lom_fluid *f);
/* Of a particle's heat: the share of it that has melted, 0..1, and its temperature; and the heat at a temperature. */
double lom_fluid_melted(const lom_fluid_desc *d, double heat);
double lom_fluid_temperature(const lom_fluid_desc *d, double heat);
double lom_fluid_heat(const lom_fluid_desc *d, double temperature);

/* fluid_solve.c: conjugate gradients from the system's x on, until the residual is `tolerance` of the right side or
 * `most` rounds are done, which it returns. */
int lom_solve_fluid(const struct lom_fluid *f, double tolerance, int most);
enum { LOM_FLUID_PIECE = 4096, LOM_FLUID_PART = 512 };

/* A sum whose terms workers make in parts of LOM_FLUID_PART, and which is taken in their order, by whoever has made the
 * next of them: the sum of chains of `chain` terms, a multiple of the parts. `add` goes on with a chain by the terms first
 * to end - 1. `done` has room for a flag a part. */
struct lom_fluid_sum {
    lom_range_work *work;
    double (*add)(const void *context, size_t first, size_t end, double sum);
    void *context;
    size_t count, chain;
    atomic_uchar *done;
};
double lom_sum_fluid(const struct lom_fluid *f, const struct lom_fluid_sum *sum);

#endif
