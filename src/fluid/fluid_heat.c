/* Heat that is conducted. Compiled for speed. In: particles sorted by cell, solids that heat. Out: particles a step
 * later. Invariant: among themselves particles neither gain nor lose heat.
 *
 * A cell's particles are its heat capacity m, their mean its temperature T. The implicit step (finite volumes)
 *     m (T' - T) = K sum over wet neighbours (T'_n - T') + 2 K sum over hot faces (T_solid - T'),
 *     K = capacity at rest * conductivity dt / side^2,
 * divided by K is a row of the system of potentials with another diagonal. All particles of a cell change by T' - T;
 * what makes them differ from their mean fades with the slowest wave that fits into a cell, exp(-pi^2 conductivity dt /
 * side^2). Air and other solids keep heat in.
 *
 * With heat of melting L (degrees that it would warm the liquid by) particles carry the enthalpy H, in degrees, and
 *     T = H below the melting from a to b, a + (H - a) (b - a) / (b - a + L) in it, H - L above:
 * the enthalpy method (V. Voller, M. Cross: Accurate solutions of moving boundary phase change problems using the
 * enthalpy method, Int. J. Heat Mass Transfer 24, 1981). m (H(T') - H) stands on the left then. H(T) is convex or
 * concave between its kinks, so Newton's method on T' finds it in some rounds, each the same system with m times the
 * slope of H(T). What each cell then takes in by the fluxes of T' is added to its H: no heat is lost, however near T' is. */
#include "fluid/fluid.h"

#include "base/numbers.h"

static double conduction(const struct lom_fluid *f)
{
    return LOM_FLUID_REST * f->desc.conductivity * f->desc.step / (f->cell * f->cell);
}

enum { ROUNDS = 12 }; /* of Newton's method */

/* What melts at one temperature does so within a thousandth of its heat of melting. */
static double melting_width(const lom_fluid_desc *d)
{
    return lom_larger(d->melting[1] - d->melting[0], d->latent_heat / 1000);
}

double lom_fluid_melted(const lom_fluid_desc *d, double heat)
{
    const double width = melting_width(d) + d->latent_heat, share = heat - d->melting[0];
    return width > 0 ? lom_smaller(lom_larger(share / width, 0), 1) : share >= 0 ? 1 : 0;
}

double lom_fluid_temperature(const lom_fluid_desc *d, double heat)
{
    return d->latent_heat > 0 ? heat - d->latent_heat * lom_fluid_melted(d, heat) : heat;
}

/* H(T), and its slope. */
static double heat_and_slope(const lom_fluid_desc *d, double temperature, double *slope)
{
    const double width = melting_width(d), over = temperature - d->melting[0];
    const bool melts = d->latent_heat > 0 && over > 0 && over < width;
    *slope = melts ? (width + d->latent_heat) / width : 1;
    return melts ? d->melting[0] + over * *slope : temperature + (over > 0 ? d->latent_heat : 0);
}

double lom_fluid_heat(const lom_fluid_desc *d, double temperature)
{
    double slope;
    return heat_and_slope(d, temperature, &slope);
}

static double mean_of(const struct lom_fluid *f, size_t n)
{
    double sum = 0;
    for (uint32_t p = f->first[n]; p < f->first[n + 1]; p++)
        sum += f->points[p].heat;
    return sum / (f->first[n + 1] - f->first[n]);
}

/* Of a cell's sides those that are solids which heat: how many, and the sum of their temperatures. */
static int find_hot_sides(const struct lom_fluid *f, size_t n, double *sum)
{
    int count = 0;
    *sum = 0;
    for (int side = 0; side < 6 && f->solid_temperature != NULL; side++) {
        const size_t step = f->stride[side >> 1];
        if (side & 1 ? n + step >= f->count : n < step)
            continue;
        const double solid = f->solid_temperature[side & 1 ? n + step : n - step];
        if (solid == solid) {
            count++;
            *sum += solid;
        }
    }
    return count;
}

/* Heat passes through what is open of a face. */
static inline double share_of(const struct lom_fluid_system *s, size_t i, int side)
{
    return s->share != NULL ? s->share[i][side] : 1;
}

static void begin_cells(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        f->cell_heat[n] = mean_of(f, n);
        f->system.x[i] = lom_fluid_temperature(&f->desc, f->cell_heat[n]);
    }
}

/* H(T') about the last T' is a straight line. */
static void fill_rows(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_system *s = &f->system;
    const double k = conduction(f);
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        const double capacity = (f->first[n + 1] - f->first[n]) / k;
        double hot, slope;
        const double heat = heat_and_slope(&f->desc, s->x[i], &slope);
        double diagonal = capacity * slope;
        for (int side = 0; side < 6; side++)
            diagonal += s->neighbour[i][side] != s->count ? share_of(s, i, side) : 0;
        diagonal += 2 * find_hot_sides(f, n, &hot);
        s->diagonal[i] = diagonal;
        s->right[i] = capacity * (f->cell_heat[n] + (slope * s->x[i] - heat)) + 2 * hot;
    }
}

/* What a cell takes in from its neighbours and from hot solids, at the temperatures of the end of the step. */
static double inflow(const struct lom_fluid *f, size_t i)
{
    const struct lom_fluid_system *s = &f->system;
    double sum = 0, hot;
    for (int side = 0; side < 6; side++)
        if (s->neighbour[i][side] != s->count)
            sum += share_of(s, i, side) * (s->x[s->neighbour[i][side]] - s->x[i]);
    const int sides = find_hot_sides(f, f->cell_of[i], &hot);
    return sum + 2 * (hot - sides * s->x[i]);
}

static void warm_points(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const double stays = lom_double_exp(-lom_pi * lom_pi * f->desc.conductivity * f->desc.step / (f->cell * f->cell));
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        double heat = f->system.x[i];
        if (f->desc.latent_heat > 0)
            heat = f->cell_heat[n] + inflow(f, i) * conduction(f) / (f->first[n + 1] - f->first[n]);
        for (uint32_t p = f->first[n]; p < f->first[n + 1]; p++) {
            double *h = &f->points[p].heat;
            *h = heat + (*h - f->cell_heat[n]) * stays;
        }
    }
}

void lom_heat_fluid(struct lom_fluid *f)
{
    const int rounds = f->desc.latent_heat > 0 ? ROUNDS : 1;
    lom_share_fluid(f, f->wet, LOM_FLUID_PART, begin_cells, f);
    f->rounds[3] = 0;
    for (int i = 0; i < rounds; i++) {
        lom_share_fluid(f, f->wet, LOM_FLUID_PART, fill_rows, f);
        const int own = lom_solve_fluid(f, 1e-8, 400);
        f->rounds[3] += own;
        if (own == 0)
            break;
    }
    lom_share_fluid(f, f->wet, LOM_FLUID_PART, warm_points, f);
}
