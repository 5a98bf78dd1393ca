/* Two potentials of the same system: one whose gradient takes the divergence from the faces, and one whose gradient
 * pushes particles from cells that are too dense. Compiled for speed. In: faces, densities, wet cells. Out: faces
 * without divergence, pressures, pushes. Invariant: a potential begins as that of the step before.
 *
 * Velocities in cells/s, the potential q = dt p / (rho cell^2) in cells^2/s: the face between cells a and b changes by
 * q_a - q_b, so that the sum over a cell's faces is 0 when A q = -div. */
#include "fluid/fluid.h"

#include "base/numbers.h"

#include <string.h>

/* What of a face is open. */
static inline double area_of(const struct lom_fluid *f, int axis, size_t n)
{
    return f->floor == NULL ? 1 : f->floor->area[axis][n];
}

static void find_divergence(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        double sum = 0;
        for (int axis = 0; axis < 3; axis++)
            sum += area_of(f, axis, n + f->stride[axis]) * f->face[axis][n + f->stride[axis]].velocity -
                   area_of(f, axis, n) * f->face[axis][n].velocity;
        f->system.right[i] = -sum;
        f->system.x[i] = f->pressure[n];
    }
}

/* What is denser than at rest is pushed apart; what is thinner is drawn together where no air is beside it. */
static void find_excess(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const double share = 0.5, most = 0.5; /* of the excess in a step; of the excess at all */
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        bool inner = true;
        for (int axis = 0; axis < 3; axis++)
            inner = inner && f->kind[n + f->stride[axis]] != LOM_FLUID_AIR &&
                    (n < f->stride[axis] || f->kind[n - f->stride[axis]] != LOM_FLUID_AIR);
        const double excess = f->density[n] / lom_fluid_rest(f, n) - 1;
        f->system.right[i] = share * lom_larger(inner ? -most : 0, lom_smaller(excess, most));
        if (f->floor != NULL)
            f->system.right[i] *= f->floor->volume[n];
        f->system.x[i] = f->push[n];
    }
}

static bool is_wall(const struct lom_fluid *f, int axis, size_t n)
{
    return !(f->open[n] >> axis & 1);
}

/* The potential beyond a face with air: such that the difference is the wet cell's over theta. */
static inline double beyond(const struct lom_fluid *f, const double *potential, size_t wet, size_t air)
{
    return potential[wet] * (1 - 1 / lom_fluid_surface_at(f, wet, air));
}

static void subtract_gradient(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const double *q = f->pressure;
    for (int axis = 0; axis < 3; axis++)
        for (size_t n = first; n < end; n++) {
            struct lom_fluid_face *face = &f->face[axis][n];
            if (is_wall(f, axis, n)) {
                face->velocity = 0;
                continue;
            }
            const size_t low = n - f->stride[axis];
            const bool wet[2] = { f->kind[low] == LOM_FLUID_LIQUID, f->kind[n] == LOM_FLUID_LIQUID };
            if (wet[0] && wet[1])
                face->velocity += q[low] - q[n];
            else if (wet[0])
                face->velocity += q[low] - beyond(f, q, low, n);
            else if (wet[1])
                face->velocity += beyond(f, q, n, low) - q[n];
        }
}

/* Whether a face that is no wall has liquid on a side: its velocity is one that has been solved for. */
static bool is_solved(const struct lom_fluid *f, int axis, size_t n)
{
    return !is_wall(f, axis, n) && (f->kind[n] == LOM_FLUID_LIQUID || f->kind[n - f->stride[axis]] == LOM_FLUID_LIQUID);
}

/* The mean of the faces beside one that have been solved for; across a solid that holds the liquid the opposite. */
static double mean_beside(const struct lom_fluid *f, int axis, size_t n, bool holds)
{
    double sum = 0;
    int count = 0;
    for (int side = 0; side < 6; side++) {
        const size_t step = f->stride[side >> 1];
        if (side >> 1 == axis || (side & 1 ? n + step >= f->count : n < step))
            continue;
        const size_t other = side & 1 ? n + step : n - step;
        if (!is_solved(f, axis, other))
            continue;
        const double v = f->face[axis][other].velocity;
        sum += holds && !f->desc.slides[side >> 1] ? -v : v;
        count++;
    }
    return count > 0 ? sum / count : 0;
}

/* Along the ground, which does not hold the liquid, faces that it closes have the mean of those around them. */
static double mean_over_ground(const struct lom_fluid *f, int axis, size_t n)
{
    double sum = 0;
    int count = 0;
    for (int side = 0; side < 6; side++) {
        const size_t step = f->stride[side >> 1];
        if (side & 1 ? n + step >= f->count : n < step)
            continue;
        const size_t other = side & 1 ? n + step : n - step;
        if (other < f->stride[axis] || !is_solved(f, axis, other))
            continue;
        sum += f->face[axis][other].velocity;
        count++;
    }
    return count > 0 ? sum / count : 0;
}

/* Faces that particles reach but nothing has been solved for have what those beside them have: within solids, and in
 * the air where the liquid has viscosity, which does not let its outermost layer fall alone. */
static void extend(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const bool viscous = f->strain != NULL;
    for (int axis = 0; axis < 3; axis++)
        for (size_t n = first; n < end; n++) {
            const size_t along = f->stride[axis];
            if (n < along || !(f->face[axis][n].mass > 0))
                continue;
            if (!viscous && f->open[n] >> axis & LOM_FLUID_GROUND)
                f->face[axis][n].velocity = mean_over_ground(f, axis, n);
            else if (f->kind[n] == LOM_FLUID_SOLID && f->kind[n - along] == LOM_FLUID_SOLID)
                f->face[axis][n].velocity = mean_beside(f, axis, n, viscous);
            else if (viscous && !is_wall(f, axis, n) && !is_solved(f, axis, n))
                f->face[axis][n].velocity = mean_beside(f, axis, n, false);
        }
}

static void keep(const struct lom_fluid *f, double *potential)
{
    for (size_t i = 0; i < f->wet; i++)
        potential[f->cell_of[i]] = f->system.x[i];
}

/* Walls first: what flows into them is no divergence of the liquid. */
static void stop_at_walls(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (int axis = 0; axis < 3; axis++)
        for (size_t n = first; n < end; n++)
            if (is_wall(f, axis, n))
                f->face[axis][n].velocity = 0;
}

void lom_project_fluid(struct lom_fluid *f)
{
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, stop_at_walls, f);
    lom_share_fluid(f, f->wet, LOM_FLUID_PART, find_divergence, f);
    f->rounds[0] = lom_solve_fluid(f, 1e-4, 400);
    keep(f, f->pressure);
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, subtract_gradient, f);
    if (f->desc.solid_count > 0 || f->floor != NULL || f->strain != NULL)
        lom_share_fluid(f, f->count, LOM_FLUID_PIECE, extend, f);
}

static void find_pushes(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (int axis = 0; axis < 3; axis++)
        for (size_t n = first; n < end; n++)
            f->face[axis][n].push = is_wall(f, axis, n) ? 0 : f->push[n - f->stride[axis]] - f->push[n];
}

/* Air keeps the potential 0: at the surface particles are pushed less than half a cell, however near it is. */
void lom_push_fluid(struct lom_fluid *f)
{
    lom_share_fluid(f, f->wet, LOM_FLUID_PART, find_excess, f);
    f->rounds[1] = lom_solve_fluid(f, 1e-2, 100);
    keep(f, f->push);
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, find_pushes, f);
}
