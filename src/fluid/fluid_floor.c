/* The ground under a liquid: a height field that cuts cells (C. Batty, F. Bertails, R. Bridson: A fast variational
 * framework for accurate solid-fluid coupling, SIGGRAPH 2007). In: heights. Out: how much of cells and of their faces is
 * open, what cells hold at rest. Invariant: no particle lies below the ground.
 *
 * Heights are linear between the corners of columns along x and along z. Over a span on which they go from a to b the
 * mean of what is open, g(top - height), is (G(top - b) - G(top - a)) / (a - b), G the integral of g: of a face across x
 * or z, and of a slice of a cell, g(t) is t within 0..1; of a face across y it is the step at 0. */
#include "fluid/fluid.h"

#include "base/numbers.h"

enum { SLICES = 4 };                   /* of a cell along each axis */
static const double least = 1.0 / 16;  /* a cell or a face that is open by less is closed */
static const double edge = 1e-3;       /* cells that particles stay above the ground, and off walls */
static const double least_rest = 0.25; /* particles */

/* ---- heights ---- */

static double *corner_of(const struct lom_fluid *f, size_t i, size_t k)
{
    return &f->floor->height[i + k * f->stride[1]];
}

double lom_fluid_floor_at(const struct lom_fluid *f, double x, double z)
{
    const size_t i = lom_count_of(x, (size_t)f->cells[0] - 1), k = lom_count_of(z, (size_t)f->cells[2] - 1);
    const double *near = corner_of(f, i, k), *far = corner_of(f, i, k + 1);
    const double s = x - (double)i, t = z - (double)k;
    const double a = near[0] + s * (near[1] - near[0]), b = far[0] + s * (far[1] - far[0]);
    return a + t * (b - a);
}

/* ---- what is open ---- */

static double integral_of_unit(double t)
{
    return t <= 0 ? 0 : t < 1 ? t * t / 2 : t - 0.5;
}

static double integral_of_step(double t)
{
    return t <= 0 ? 0 : t;
}

static double mean_open(double (*integral)(double t), double top, double from, double to)
{
    if (lom_magnitude(to - from) < 1e-6)
        to = from + 1e-6;
    return (integral(top - from) - integral(top - to)) / (to - from);
}

/* Over the square of a column: means along x, of slices along z. */
static double mean_over_column(const struct lom_fluid *f, const size_t at[3], double (*integral)(double t), double top)
{
    double sum = 0;
    for (int slice = 0; slice < SLICES; slice++) {
        const double z = (double)at[2] + (slice + 0.5) / SLICES, x = (double)at[0];
        sum += mean_open(integral, top, lom_fluid_floor_at(f, x, z), lom_fluid_floor_at(f, x + 1, z));
    }
    return sum / SLICES;
}

double lom_fluid_open_volume(const struct lom_fluid *f, const size_t at[3])
{
    return mean_over_column(f, at, integral_of_unit, (double)at[1] + 1);
}

bool lom_floor_fills(const struct lom_fluid *f, const size_t at[3])
{
    return lom_fluid_open_volume(f, at) < least;
}

/* The face of a cell towards the low side of an axis. */
static double open_area(const struct lom_fluid *f, const size_t at[3], int axis)
{
    const double top = (double)at[1] + 1;
    if (axis == 1)
        return mean_over_column(f, at, integral_of_step, (double)at[1]);
    const double *low = corner_of(f, at[0], at[2]);
    return mean_open(integral_of_unit, top, *low, axis == 0 ? low[f->stride[1]] : low[1]);
}

bool lom_is_ground(const struct lom_fluid *f, size_t n)
{
    return f->floor->volume[n] < least;
}

/* A face is the ground's where it is not that of the basin or of an obstacle. */
static void cut_face(struct lom_fluid *f, const size_t at[3], size_t n, int axis)
{
    const size_t low = n - f->stride[axis];
    const bool open = (f->open[n] >> axis & 1) != 0;
    const double area = open ? open_area(f, at, axis) : 0;
    f->floor->area[axis][n] = area < least ? 0 : area;
    if (open && area >= least)
        return;
    f->open[n] &= (uint8_t) ~(1 << axis);
    if (open || (lom_is_ground(f, n) && f->kind[low] == LOM_FLUID_AIR) ||
        (lom_is_ground(f, low) && f->kind[n] == LOM_FLUID_AIR) || (lom_is_ground(f, low) && lom_is_ground(f, n)))
        f->open[n] |= (uint8_t)(LOM_FLUID_GROUND << axis);
}

/* Of the cells and faces within the basin; numbers beyond its high sides are solid. */
static bool find_place(const struct lom_fluid *f, size_t n, size_t at[3])
{
    at[0] = n % f->stride[1];
    at[1] = n / f->stride[1] % ((size_t)f->cells[1] + 1);
    at[2] = n / f->stride[2];
    return at[0] < (size_t)f->cells[0] && at[1] < (size_t)f->cells[1] && at[2] < (size_t)f->cells[2];
}

/* Part i of a cell's 4 x 4 x 4: how much of it is open, and the middle of that. */
static double open_part(const struct lom_fluid *f, const size_t at[3], int i, double place[3])
{
    place[0] = (double)at[0] + (i % SLICES + 0.5) / SLICES;
    place[2] = (double)at[2] + (i / (SLICES * SLICES) + 0.5) / SLICES;
    const double top = (double)at[1] + (i / SLICES % SLICES + 1.0) / SLICES;
    const double above = (top - lom_fluid_floor_at(f, place[0], place[2])) * SLICES;
    const double open = lom_smaller(lom_larger(above, 0), 1);
    place[1] = top - open / (2 * SLICES);
    return open;
}

/* What cells hold when all that is open is full, as densities are gathered. */
static void find_rest(struct lom_fluid *f)
{
    enum { PARTS = SLICES * SLICES * SLICES };
    size_t at[3];
    for (size_t n = 0; n < f->count; n++)
        for (int i = 0; find_place(f, n, at) && f->kind[n] != LOM_FLUID_SOLID && i < PARTS; i++) {
            double place[3];
            const double open = open_part(f, at, i, place);
            if (open > 0)
                lom_add_density(f, place, open * LOM_FLUID_REST / PARTS);
        }
    lom_return_density(f);
    for (size_t n = 0; n < f->count; n++) {
        f->floor->rest[n] = lom_larger(f->density[n], least_rest);
        f->density[n] = 0;
    }
}

bool lom_cut_cells(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_floor *floor = f->floor;
    bool done = true;
    floor->volume = lom_allocate(f->count, sizeof *floor->volume, error);
    floor->rest = lom_allocate(f->count, sizeof *floor->rest, error);
    for (int axis = 0; axis < 3; axis++) {
        floor->area[axis] = lom_allocate(f->count, sizeof *floor->area[axis], error);
        done = done && floor->area[axis] != NULL;
    }
    if (!done || floor->volume == NULL || floor->rest == NULL)
        return false;
    size_t at[3];
    for (size_t n = 0; n < f->count; n++)
        floor->volume[n] = find_place(f, n, at) ? lom_fluid_open_volume(f, at) : 1;
    for (size_t n = 0; n < f->count; n++)
        for (int axis = 0; find_place(f, n, at) && axis < 3; axis++)
            if (at[axis] > 0)
                cut_face(f, at, n, axis);
    find_rest(f);
    return true;
}

/* ---- the ground ---- */

bool lom_open_floor(struct lom_fluid *f, lom_error *error)
{
    const lom_fluid_desc *d = &f->desc;
    bool rises = false;
    if (d->ground == NULL)
        return true;
    f->floor = lom_allocate(1, sizeof *f->floor, error);
    if (f->floor == NULL)
        return false;
    f->floor->height = lom_allocate(f->stride[1] * ((size_t)f->cells[2] + 1), sizeof(double), error);
    if (f->floor->height == NULL)
        return false;
    for (int k = 0; k <= f->cells[2]; k++)
        for (int i = 0; i <= f->cells[0]; i++) {
            const double y = d->ground(d->ground_context, d->low[0] + i * f->cell, d->low[2] + k * f->cell);
            const double height = (y - d->low[1]) / f->cell;
            rises = rises || height > 0;
            *corner_of(f, (size_t)i, (size_t)k) = lom_larger(-1, lom_smaller(height, f->cells[1] + 1));
        }
    if (!rises)
        lom_close_floor(f);
    return true;
}

void lom_close_floor(struct lom_fluid *f)
{
    if (f->floor == NULL)
        return;
    lom_release(f->floor->height);
    lom_release(f->floor->volume);
    lom_release(f->floor->rest);
    for (int axis = 0; axis < 3; axis++)
        lom_release(f->floor->area[axis]);
    lom_release(f->floor);
    f->floor = NULL;
}

/* Where a place is below the ground, by how much; and the ground's slope there. */
static double depth_below(const struct lom_fluid *f, const double at[3], double slope[2])
{
    const size_t i = lom_count_of(at[0], (size_t)f->cells[0] - 1), k = lom_count_of(at[2], (size_t)f->cells[2] - 1);
    const double *near = corner_of(f, i, k), *far = corner_of(f, i, k + 1);
    const double s = at[0] - (double)i, t = at[2] - (double)k;
    slope[0] = (near[1] - near[0]) * (1 - t) + (far[1] - far[0]) * t;
    slope[1] = (far[0] - near[0]) * (1 - s) + (far[1] - near[1]) * s;
    return lom_fluid_floor_at(f, at[0], at[2]) + edge - at[1];
}

static void keep_in_basin(const struct lom_fluid *f, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = lom_larger(edge, lom_smaller(at[axis], f->cells[axis] - edge));
}

/* To the nearest place of the plane that the ground is there, and again, since it is none; the last little way up. */
bool lom_put_on_ground(const struct lom_fluid *f, double at[3])
{
    const double little = 0.05;
    double slope[2], depth = depth_below(f, at, slope);
    for (int round = 0; round < 4 && depth > 0; round++) {
        const double up = depth / (1 + slope[0] * slope[0] + slope[1] * slope[1]);
        at[0] -= slope[0] * up;
        at[1] += up;
        at[2] -= slope[1] * up;
        keep_in_basin(f, at);
        depth = depth_below(f, at, slope);
    }
    if (depth > 0 && depth < little)
        at[1] += depth;
    return depth < little && at[1] <= f->cells[1] - edge;
}
