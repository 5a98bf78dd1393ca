/* Heat that is conducted. Compiled for speed. In: particles sorted by cell, solids that heat. Out: particles a step
 * later. Invariant: among themselves particles neither gain nor lose heat.
 *
 * A cell's particles are its heat capacity m, their mean its temperature T. The implicit step (finite volumes)
 *     m (T' - T) = K sum over wet neighbours (T'_n - T') + 2 K sum over hot faces (T_solid - T'),
 *     K = capacity at rest * conductivity dt / side^2,
 * divided by K is a row of the system of potentials with another diagonal. All particles of a cell change by T' - T;
 * what makes them differ from their mean fades with the slowest wave that fits into a cell, exp(-pi^2 conductivity dt /
 * side^2). Air and other solids keep heat in. */
#include "fluid/fluid.h"

#include "base/numbers.h"

static double conduction(const struct lom_fluid *f)
{
    return LOM_FLUID_REST * f->desc.conductivity * f->desc.step / (f->cell * f->cell);
}

static double mean_of(const struct lom_fluid *f, size_t n)
{
    double sum = 0;
    for (uint32_t p = f->first[n]; p < f->first[n + 1]; p++)
        sum += f->points[p].temperature;
    return sum / (f->first[n + 1] - f->first[n]);
}

static void fill_rows(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_system *s = &f->system;
    const double k = conduction(f);
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        const double capacity = (f->first[n + 1] - f->first[n]) / k;
        double diagonal = capacity, hot = 0;
        for (int side = 0; side < 6; side++) {
            const size_t step = f->stride[side >> 1];
            diagonal += s->neighbour[i][side] != s->count;
            if (f->solid_temperature == NULL || (side & 1 ? n + step >= f->count : n < step))
                continue;
            const double solid = f->solid_temperature[side & 1 ? n + step : n - step];
            if (solid == solid) {
                diagonal += 2;
                hot += 2 * solid;
            }
        }
        f->temperature[n] = s->x[i] = mean_of(f, n);
        s->diagonal[i] = diagonal;
        s->right[i] = capacity * f->temperature[n] + hot;
    }
}

static void warm_points(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const double stays = lom_double_exp(-lom_pi * lom_pi * f->desc.conductivity * f->desc.step / (f->cell * f->cell));
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        for (uint32_t p = f->first[n]; p < f->first[n + 1]; p++) {
            double *t = &f->points[p].temperature;
            *t = f->system.x[i] + (*t - f->temperature[n]) * stays;
        }
    }
}

void lom_heat_fluid(struct lom_fluid *f)
{
    lom_share_fluid(f, f->wet, LOM_FLUID_PIECE, fill_rows, f);
    f->rounds[3] = lom_solve_fluid(f, 1e-8, 400);
    lom_share_fluid(f, f->wet, LOM_FLUID_PIECE, warm_points, f);
}
