/* The surface over shallow water and over what is dry. In: depths of cells; out: heights, slopes and foam. Invariant: a
 * texel is a function of its cell and the eight around it. */
#include "base/numbers.h"
#include "waves/shallow_surface.h"

enum { FADE = 6 };   /* cells at the border */
enum { PIECE = 16 }; /* rows that a worker fills at a time */
/* metres, at cells of 0.25 m; m/s^2 */
static const double least_depth = 1e-3, below_bed = 0.05, thinnest = 0.02, gravity = 9.80665;

double lom_shallow_film(double cell)
{
    double film = 1;
    while (film > 4 * cell)
        film /= 2;
    while (2 * film <= 4 * cell)
        film *= 2;
    return film;
}

/* Cell (x, z), moved into the grid. */
static size_t cell_of(const lom_shallow_view *v, int x, int z)
{
    x = x < 0 ? 0 : x >= v->columns ? v->columns - 1 : x;
    z = z < 0 ? 0 : z >= v->rows ? v->rows - 1 : z;
    return (size_t)z * (size_t)v->columns + (size_t)x;
}

static bool is_wet(const lom_shallow_view *v, size_t cell)
{
    return v->depth[cell] > least_depth * lom_shallow_film(v->cell);
}

static double surface_of(const lom_shallow_view *v, size_t cell)
{
    return v->bed[cell] + v->depth[cell];
}

/* Of a dry cell. */
static double hidden_surface(const lom_shallow_view *v, int x, int z)
{
    double sum = 0, lowest = v->bed[cell_of(v, x, z)];
    int wet = 0;
    for (int j = z - 1; j <= z + 1; j++)
        for (int i = x - 1; i <= x + 1; i++) {
            size_t cell = cell_of(v, i, j);
            lowest = v->bed[cell] < lowest ? v->bed[cell] : lowest;
            if (is_wet(v, cell)) {
                sum += surface_of(v, cell);
                wet++;
            }
        }
    const double below = below_bed * lom_shallow_film(v->cell);
    double own = v->bed[cell_of(v, x, z)] - below, around = wet > 0 ? sum / wet : lowest - below;
    return around < own ? around : own;
}

/* From wet neighbours alone; 0 without one. */
static double slope(const lom_shallow_view *v, size_t before, size_t at, size_t after)
{
    bool low = is_wet(v, before) && before != at, high = is_wet(v, after) && after != at;
    double from = low ? surface_of(v, before) : surface_of(v, at), to = high ? surface_of(v, after) : surface_of(v, at);
    int steps = low + high;
    return steps > 0 ? (to - from) / (steps * v->cell) : 0;
}

double lom_froude_foam(double speed, double depth)
{
    const double froude = speed / lom_double_sqrt(gravity * depth), foam = (froude - 0.7) / 0.8;
    return foam < 0 ? 0 : foam > 1 ? 1 : foam;
}

double lom_shallow_froude_foam(const lom_shallow_view *v, int x, int z)
{
    const double depth = lom_larger(v->depth[cell_of(v, x, z)], thinnest * lom_shallow_film(v->cell));
    size_t columns = (size_t)v->columns, row = (size_t)z * (columns + 1) + (size_t)x;
    double qx = (v->flow_x[row] + v->flow_x[row + 1]) / 2;
    double qz = (v->flow_z[(size_t)z * columns + (size_t)x] + v->flow_z[(size_t)(z + 1) * columns + (size_t)x]) / 2;
    return lom_froude_foam(lom_double_sqrt(qx * qx + qz * qz) / depth, depth);
}

static double fade_of(const lom_shallow_view *v, int x, int z)
{
    int across = x < v->columns - 1 - x ? x : v->columns - 1 - x, down = z < v->rows - 1 - z ? z : v->rows - 1 - z;
    int from_border = across < down ? across : down;
    double t = from_border >= FADE ? 1 : (double)from_border / FADE;
    return t * t * (3 - 2 * t);
}

/* What one call fills, and of each piece of rows what the caller wants to know. */
struct filling {
    const lom_shallow_view *view;
    double level;
    bool fades;
    const float *carried;
    float (*surface)[4], (*moments)[4];
    struct piece {
        int wet;
        float low, high;
    } pieces[LOM_SHALLOW_LARGEST / PIECE];
};

static void fill_texel(const struct filling *f, int x, int z, struct piece *piece)
{
    const lom_shallow_view *v = f->view;
    size_t at = cell_of(v, x, z);
    bool here = is_wet(v, at);
    double share = f->fades ? fade_of(v, x, z) : 1;
    double height = ((here ? surface_of(v, at) : hidden_surface(v, x, z)) - f->level) * share;
    double sx = here ? slope(v, cell_of(v, x - 1, z), at, cell_of(v, x + 1, z)) * share : 0;
    double sz = here ? slope(v, cell_of(v, x, z - 1), at, cell_of(v, x, z + 1)) * share : 0;
    height = height < -LOM_SHALLOW_BOUND ? -LOM_SHALLOW_BOUND : height > LOM_SHALLOW_BOUND ? LOM_SHALLOW_BOUND : height;
    float *s = f->surface[at], *m = f->moments[at];
    s[0] = (float)height;
    s[1] = (float)sx;
    s[2] = (float)sz;
    s[3] = here ? (float)((f->carried != NULL ? (double)f->carried[at] : lom_shallow_froude_foam(v, x, z)) * share) : 0;
    m[0] = s[1] * s[1];
    m[1] = s[2] * s[2];
    m[2] = s[1] * s[2];
    m[3] = 0;
    piece->low = s[0] < piece->low ? s[0] : piece->low;
    piece->high = s[0] > piece->high ? s[0] : piece->high;
    piece->wet += here;
}

static void fill_rows(void *context, size_t first, size_t end)
{
    struct filling *f = context;
    struct piece *piece = &f->pieces[first / PIECE];
    *piece = (struct piece){ .wet = 0 };
    for (int z = (int)first; z < (int)end; z++)
        for (int x = 0; x < f->view->columns; x++)
            fill_texel(f, x, z, piece);
}

int lom_fill_shallow_surface(const lom_shallow_view *v, lom_pool *pool, double level, bool fades, const float *carried,
                             float (*surface)[4], float (*moments)[4], float bounds[2])
{
    struct filling f = { v, level, fades, carried, surface, moments, { { .wet = 0 } } };
    int wet = 0;
    if (pool != NULL)
        lom_share_out(pool, (size_t)v->rows, PIECE, fill_rows, &f);
    else
        for (int z = 0; z < v->rows; z += PIECE)
            fill_rows(&f, (size_t)z, (size_t)(z + PIECE < v->rows ? z + PIECE : v->rows));
    bounds[0] = bounds[1] = 0;
    for (int i = 0; i * PIECE < v->rows; i++) {
        bounds[0] = f.pieces[i].low < bounds[0] ? f.pieces[i].low : bounds[0];
        bounds[1] = f.pieces[i].high > bounds[1] ? f.pieces[i].high : bounds[1];
        wet += f.pieces[i].wet;
    }
    return wet;
}

void lom_sample_shallow_surface(const lom_shallow_view *v, const float (*surface)[4], double x, double z,
                                double texel[4])
{
    double column = lom_double_floor(x - 0.5), row = lom_double_floor(z - 0.5);
    double u = x - 0.5 - column, w = z - 0.5 - row;
    column = column < -1 ? -1 : column > v->columns ? v->columns : column;
    row = row < -1 ? -1 : row > v->rows ? v->rows : row;
    for (int i = 0; i < 4; i++)
        texel[i] = 0;
    for (int k = 0; k < 4; k++) {
        const float *s = surface[cell_of(v, lom_int_of(column) + (k & 1), lom_int_of(row) + (k >> 1))];
        for (int i = 0; i < 4; i++)
            texel[i] += (double)s[i] * (k & 1 ? u : 1 - u) * (k >> 1 ? w : 1 - w);
    }
}
