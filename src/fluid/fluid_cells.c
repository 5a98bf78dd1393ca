/* Which cells are wet, and the shape of the system that potentials in them solve. Compiled for speed. In: sorted
 * particles, densities. Out: kinds of cells, unknowns, neighbours, diagonals. Invariant: unknowns are in the order of
 * cells.
 *
 * The potential is 0 at the surface, which lies where the density, between the middles of a wet cell and of one with
 * air, falls through half of that at rest: theta cells away. The difference through that face is the wet cell's
 * potential over theta (lom/fluid.h: Gibou). A face of a solid lets nothing through. */
#include "fluid/fluid.h"

#include "base/numbers.h"

static const double nearest_surface = 0.25; /* theta at least: what is nearer makes the system stiff */

double lom_fluid_surface_at(const struct lom_fluid *f, size_t wet, size_t air)
{
    const double inner = f->density[wet] - 0.5 * lom_fluid_rest(f, wet);
    const double outer = f->density[air] - 0.5 * lom_fluid_rest(f, air);
    if (!(inner > 0))
        return nearest_surface;
    return outer < 0 ? lom_larger(nearest_surface, inner / (inner - outer)) : 1;
}

/* What has been added to a solid's cells lies before it: it is shared by the cells beside it that are none. */
void lom_return_density(struct lom_fluid *f)
{
    const bool has_solids = f->desc.solid_count > 0 || f->floor != NULL;
    for (size_t n = 0; has_solids && n < f->count; n++) {
        if (f->kind[n] != LOM_FLUID_SOLID || !(f->density[n] > 0))
            continue;
        size_t beside[6];
        int count = 0;
        for (int axis = 0; axis < 3; axis++) {
            const size_t step = f->stride[axis];
            if (n >= step && f->kind[n - step] != LOM_FLUID_SOLID)
                beside[count++] = n - step;
            if (n + step < f->count && f->kind[n + step] != LOM_FLUID_SOLID)
                beside[count++] = n + step;
        }
        for (int i = 0; i < count; i++)
            f->density[beside[i]] += f->density[n] / count;
        f->density[n] = 0;
    }
}

static void connect(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_system *s = &f->system;
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        double diagonal = 0;
        for (int side = 0; side < 6; side++) {
            const size_t step = f->stride[side >> 1], face = side & 1 ? n + step : n;
            s->neighbour[i][side] = (uint32_t)s->count;
            if (s->share != NULL)
                s->share[i][side] = 0;
            if (!(f->open[face] >> (side >> 1) & 1))
                continue;
            const size_t other = side & 1 ? n + step : n - step;
            if (f->kind[other] == LOM_FLUID_LIQUID)
                s->neighbour[i][side] = (uint32_t)f->unknown[other];
            const double slope = f->kind[other] == LOM_FLUID_LIQUID ? 1 : 1 / lom_fluid_surface_at(f, n, other);
            if (s->share != NULL)
                s->share[i][side] = f->floor->area[side >> 1][face];
            diagonal += s->share != NULL ? s->share[i][side] * slope : slope;
        }
        s->diagonal[i] = diagonal;
    }
}

/* Kinds of cells; in the place of the first one's unknown, how many are wet. */
static void find_kinds(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    int32_t wet = 0;
    for (size_t n = first; n < end; n++) {
        if (f->kind[n] == LOM_FLUID_SOLID)
            continue;
        f->kind[n] = f->first[n + 1] > f->first[n] ? LOM_FLUID_LIQUID : LOM_FLUID_AIR;
        if (f->kind[n] == LOM_FLUID_AIR)
            f->pressure[n] = f->push[n] = 0;
        else
            wet++;
    }
    f->unknown[first] = wet;
}

/* Unknowns, from the one that stands in the place of the first cell's. */
static void number_cells(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    int32_t wet = f->unknown[first];
    for (size_t n = first; n < end; n++) {
        f->unknown[n] = f->kind[n] == LOM_FLUID_LIQUID ? wet : LOM_FLUID_NONE;
        if (f->kind[n] == LOM_FLUID_LIQUID)
            f->cell_of[wet++] = (uint32_t)n;
    }
}

void lom_find_wet_cells(struct lom_fluid *f)
{
    int32_t wet = 0;
    lom_return_density(f);
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, find_kinds, f);
    for (size_t n = 0; n < f->count; n += LOM_FLUID_PIECE) {
        const int32_t here = f->unknown[n];
        f->unknown[n] = wet;
        wet += here;
    }
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, number_cells, f);
    f->wet = f->system.count = (size_t)wet;
    lom_share_fluid(f, f->wet, LOM_FLUID_PART, connect, f);
}
