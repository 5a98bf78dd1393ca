/* The foam that a river carries. In: its velocities, its depths. Out: how much foam lies at each cell. Invariant: a steady
 * flow has steady foam, a function of the field alone: each cell looks back along the way that its water came. */
#include "base/numbers.h"
#include "waves/river.h"
#include "waves/shallow_surface.h"

static const double shallowest = 0.00625; /* metres, at cells of 0.25 m: thinner water makes no foam */
static const double lifetimes = 4;        /* how far back is looked: e^-4 is left of it */
enum { MOST_STEPS = 4000 };

struct river {
    const struct lom_river_foam_desc *desc;
    const lom_image *field;
};

static double depth_at(const struct river *r, int x, int y)
{
    return r->desc->depth[(size_t)y * (size_t)r->field->width + (size_t)x];
}

static double made_at(const struct river *r, int x, int y)
{
    const float *v = lom_image_pixel((lom_image *)r->field, x, y, 0);
    const double vx = (double)v[0] * r->desc->speed, vz = (double)v[1] * r->desc->speed, depth = depth_at(r, x, y);
    return depth > shallowest * lom_shallow_film(r->desc->cell[0])
               ? lom_froude_foam(lom_double_sqrt(vx * vx + vz * vz), depth)
               : 0;
}

/* Between the middles of cells: what is made there, and the velocity in m/s. False: beyond the field or on land. */
static bool look(const struct river *r, double x, double y, double *made, double way[2])
{
    const int size = r->field->width;
    if (!(x >= 0 && y >= 0 && x <= size - 1 && y <= size - 1))
        return false;
    const int column = lom_smaller_int(lom_int_of(x), size - 2), row = lom_smaller_int(lom_int_of(y), size - 2);
    const double u = x - column, w = y - row;
    double wet = 0;
    *made = way[0] = way[1] = 0;
    for (int k = 0; k < 4; k++) {
        const int i = column + (k & 1), j = row + (k >> 1);
        const double share = (k & 1 ? u : 1 - u) * (k & 2 ? w : 1 - w);
        const float *v = lom_image_pixel((lom_image *)r->field, i, j, 0);
        wet += depth_at(r, i, j) > 0 ? share : 0;
        *made += share * made_at(r, i, j);
        for (int a = 0; a < 2; a++)
            way[a] += share * (double)v[a] * r->desc->speed;
    }
    return wet > 0.25;
}

/* The most that is left of what was made on the way to a place: e^(-t / window) of it after t seconds. Steps are half a
 * cell. */
static double carried_to(const struct river *r, double x, double y)
{
    double most = 0, seconds = 0, made, way[2];
    for (int i = 0; i < MOST_STEPS && look(r, x, y, &made, way); i++) {
        most = lom_larger(most, made * lom_double_exp(-seconds / r->desc->window));
        const double cells[2] = { way[0] / r->desc->cell[0], way[1] / r->desc->cell[1] };
        const double speed = lom_double_sqrt(cells[0] * cells[0] + cells[1] * cells[1]);
        if (!(speed > 1e-6) || seconds > lifetimes * r->desc->window)
            break;
        x -= 0.5 * cells[0] / speed;
        y -= 0.5 * cells[1] / speed;
        seconds += 0.5 / speed;
    }
    return most;
}

void lom_carry_river_foam(float *foam, const lom_image *field, const struct lom_river_foam_desc *desc)
{
    const struct river r = { desc, field };
    for (int y = 0; y < field->height; y++)
        for (int x = 0; x < field->width; x++)
            foam[(size_t)y * (size_t)field->width + (size_t)x] = (float)carried_to(&r, x, y);
}
