/* Foam that shallow water carries. In: the foam before a step, the flow after it, the bodies at both. Out: the foam after
 * it. Method: each cell takes what was where its water comes from, between the four cells around that place (R. Courant,
 * E. Isaacson, M. Rees, Comm. Pure Appl. Math. 5, 1952), which is stable at any step and makes nothing above 1; it fades
 * by exp(-step / window). Invariant: a function of the steps before, in a fixed order, whoever takes which rows. Compiled
 * for speed. */
#include "base/numbers.h"
#include "base/threads.h"
#include "waves/shallow_state.h"
#include "waves/shallow_surface.h"
#include "waves/wave_site.h"

static const double shallowest = 0.05; /* metres of water that carry foam */
static const double churning = 2;      /* m/s from which on a body covers its way with foam */

static size_t cell_of(const lom_shallow_view *v, int x, int z)
{
    x = x < 0 ? 0 : x >= v->columns ? v->columns - 1 : x;
    z = z < 0 ? 0 : z >= v->rows ? v->rows - 1 : z;
    return (size_t)z * (size_t)v->columns + (size_t)x;
}

enum { ROWS = 8 /* that a worker takes at a time */ };

struct carrying {
    const struct lom_shallow_region *region;
    const lom_shallow_view *view;
    double left; /* of foam, after a step */
};

/* Foam at a place in cells between middles; none comes from outside. */
static double foam_at(const struct lom_shallow_region *region, const lom_shallow_view *v, double x, double z)
{
    if (!(x >= 0 && z >= 0 && x < v->columns && z < v->rows))
        return 0;
    const int i = lom_int_of(x), j = lom_int_of(z);
    const double u = x - i, w = z - j;
    const float *foam = region->foam;
    return ((double)foam[cell_of(v, i, j)] * (1 - u) + (double)foam[cell_of(v, i + 1, j)] * u) * (1 - w) +
           ((double)foam[cell_of(v, i, j + 1)] * (1 - u) + (double)foam[cell_of(v, i + 1, j + 1)] * u) * w;
}

static void carry_rows(void *context, size_t first, size_t end)
{
    const struct carrying *c = context;
    const lom_shallow_view *v = c->view;
    const size_t columns = (size_t)v->columns;
    const double least = shallowest * lom_shallow_film(v->cell);
    for (int z = (int)first; z < (int)end; z++)
        for (int x = 0; x < v->columns; x++) {
            const size_t at = cell_of(v, x, z), face = (size_t)z * (columns + 1) + (size_t)x;
            const double per_depth = v->step / (v->cell * lom_larger(v->depth[at], least));
            const double dx = (v->flow_x[face] + v->flow_x[face + 1]) / 2 * per_depth;
            const double dz = (v->flow_z[at] + v->flow_z[at + columns]) / 2 * per_depth;
            const double made = v->depth[at] > 0 ? lom_shallow_froude_foam(v, x, z) : 0;
            c->region->foam_after[at] = (float)lom_larger(foam_at(c->region, v, x - dx, z - dz) * c->left, made);
        }
}

static void carry(struct lom_shallow_region *region, const lom_shallow_view *v, double left)
{
    struct carrying carrying = { region, v, left };
    if (region->now->pool != NULL)
        lom_share_out(region->now->pool, (size_t)v->rows, ROWS, carry_rows, &carrying);
    else
        carry_rows(&carrying, 0, (size_t)v->rows);
    float *before = region->foam;
    region->foam = region->foam_after;
    region->foam_after = before;
}

/* The waterline of a body that moves, whole in its middle. */
static void churn(struct lom_shallow_region *region, const lom_shallow_view *v, const lom_shallow_obstacle *body,
                  const lom_shallow_obstacle *before)
{
    const double x = body->x - before->x, z = body->z - before->z;
    const double speed = lom_double_sqrt(x * x + z * z) / v->step;
    const double strength = lom_smaller(speed / (churning * lom_double_sqrt(lom_shallow_film(v->cell))), 1);
    const double along[2] = { lom_double_cos(body->heading), lom_double_sin(body->heading) };
    const double reach = lom_larger(body->half[0], body->half[1]) / v->cell;
    const double low[2] = { body->x / v->cell - reach, body->z / v->cell - reach };
    const int size[2] = { v->columns, v->rows };
    int first[2], last[2];
    for (int i = 0; i < 2; i++) {
        first[i] = lom_int_of(lom_double_floor(lom_larger(0, lom_smaller(low[i], size[i]))));
        last[i] = lom_int_of(lom_double_floor(lom_larger(-1, lom_smaller(low[i] + 2 * reach, size[i] - 1))));
    }
    for (int j = first[1]; body->draft > 0 && j <= last[1]; j++)
        for (int i = first[0]; i <= last[0]; i++) {
            const double dx = (i + 0.5) * v->cell - body->x, dz = (j + 0.5) * v->cell - body->z;
            const double a = (dx * along[0] + dz * along[1]) / body->half[0];
            const double b = (dz * along[0] - dx * along[1]) / body->half[1], left = 1 - a * a - b * b;
            float *foam = &region->foam[cell_of(v, i, j)];
            if (left > 0)
                *foam = (float)lom_larger((double)*foam, strength * lom_smaller(2 * left, 1));
        }
}

void lom_carry_shallow_foam(struct lom_shallow_region *region, const struct lom_wave_site *site,
                            const lom_shallow_obstacle *bodies, const lom_shallow_obstacle *before)
{
    const lom_shallow_view view = lom_view_shallow(region->now);
    carry(region, &view, lom_double_exp(-view.step / site->foam->window));
    for (size_t i = 0; i < site->shallow->body_count; i++)
        churn(region, &view, &bodies[i], &before[i]);
}
