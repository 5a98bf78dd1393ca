/* Surf and shallow water for rays. In: the scene's [surf] and [shallow], its terrain, a time. Out: heights and slopes
 * in double. Invariant: a place is read from the maps and the cells that every model of water draws; the slope of surf
 * is that of its height, not the models' k times the wave's own change. */
#include "base/numbers.h"
#include "reference/wave_surface.h"

#include "waves/shallow_surface.h"

static bool make_surf(struct lom_wave_surface *surface, const struct lom_wave_site *site, double time, lom_error *error)
{
    if (!lom_make_site_surf(&surface->surf, site, error))
        return false;
    if (surface->surf.cells != NULL)
        lom_fill_surf(&surface->surf_moment, &surface->surf, site->surf, (double[2]){ 0, 0 }, time);
    return true;
}

static bool make_shallow(struct lom_wave_surface *surface, const struct lom_wave_site *site, double time,
                         lom_error *error)
{
    struct lom_shallow_region *state = &surface->shallow;
    if (!lom_open_shallow_region(state, site, error))
        return false;
    if (state->first == NULL)
        return true;
    size_t cells = (size_t)state->columns * (size_t)state->rows;
    float bounds[2], (*moments)[4] = lom_allocate(cells, sizeof *moments, error);
    surface->shallow_texels = lom_allocate(cells, sizeof *surface->shallow_texels, error);
    bool done =
        moments != NULL && surface->shallow_texels != NULL && lom_advance_shallow_region(state, site, time, error);
    if (done) {
        surface->shallow_view = lom_view_shallow(state->now);
        lom_fill_shallow_surface(&surface->shallow_view, NULL, 0, site->shallow->edge == LOM_SHALLOW_OPEN, NULL,
                                 surface->shallow_texels, moments, bounds);
    }
    lom_release(moments);
    return done;
}

static double finer(double shortest, double length)
{
    return shortest == 0 ? length : lom_smaller(shortest, length);
}

bool lom_make_ray_shore(struct lom_wave_surface *surface, const lom_reference *reference, double time, double *shortest,
                        lom_error *error)
{
    const lom_scene *scene = reference->scene;
    if (reference->number != 0 || (!scene->shallow.present && !(scene->surf.height > 0)))
        return true;
    const struct lom_wave_site site = lom_world_wave_site(reference->world, reference->number);
    bool done = make_surf(surface, &site, time, error) && make_shallow(surface, &site, time, error);
    if (done && surface->surf.cells != NULL) /* its steepest front is a twentieth of a wave */
        *shortest = finer(*shortest, surface->surf.length / 20);
    if (done && surface->shallow.first != NULL)
        *shortest = finer(*shortest, 4 * surface->shallow.cell);
    return done;
}

void lom_free_ray_shore(struct lom_wave_surface *surface)
{
    lom_free_surf_map(&surface->surf);
    lom_close_shallow_region(&surface->shallow);
    lom_release(surface->shallow_texels);
}

/* Derivatives by differences: of the heights alone where waves spill, and of the whole shift where they plunge. */
static void add_surf(struct lom_wave_place *place, const struct lom_wave_surface *surface, double x, double z)
{
    const double step = 1e-3;
    double here[3], change[2][3];
    lom_surf_shift(&surface->surf, &surface->surf_moment, x, z, here);
    for (int a = 0; a < 2; a++) {
        double before[3], after[3];
        const double dx = a == 0 ? step : 0, dz = step - dx;
        lom_surf_shift(&surface->surf, &surface->surf_moment, x + dx, z + dz, after);
        lom_surf_shift(&surface->surf, &surface->surf_moment, x - dx, z - dz, before);
        for (int i = 0; i < 3; i++)
            change[a][i] = (after[i] - before[i]) / (2 * step);
    }
    place->dx += here[0];
    place->dy += here[1];
    place->dz += here[2];
    place->sx += change[0][1];
    place->sz += change[1][1];
    place->xx += change[0][0];
    place->zz += change[1][2];
    place->xz += (change[0][2] + change[1][0]) / 2;
    place->overturns |= here[0] != 0 || here[2] != 0;
}

static void add_shallow(struct lom_wave_place *place, const struct lom_wave_surface *surface, double x, double z)
{
    const struct lom_shallow_region *state = &surface->shallow;
    double column = (x - state->corner[0]) / state->cell, row = (z - state->corner[1]) / state->cell, texel[4];
    if (!(column >= 0 && column <= state->columns && row >= 0 && row <= state->rows))
        return;
    lom_sample_shallow_surface(&surface->shallow_view, (const float(*)[4])surface->shallow_texels, column, row, texel);
    place->dy += texel[0];
    place->sx += texel[1];
    place->sz += texel[2];
}

void lom_add_shore(struct lom_wave_place *place, const struct lom_wave_surface *surface, double x, double z)
{
    if (surface->surf.cells != NULL)
        add_surf(place, surface, x, z);
    if (surface->shallow.first != NULL)
        add_shallow(place, surface, x, z);
}
