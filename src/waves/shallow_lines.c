/* How shallow water flows along its lines. In: beds, depths and discharges; out: the same a step later. With t the
 * step, s the size of a cell, u the implicitness, and a face between cells L and R:
 *
 *   q' = (q - k (1 - u) e - k u e') / (1 + f t)   k = g H t / s, e = surface of R less that of L, f = friction |q|/H^2
 *   F  = (1 - u) q + u q'                         what flows through the face during the step
 *   d  = -(t / s) (F right - F left)              by which the cell's surface rises
 *
 * F is linear in the unknown d: F = F0 - B (d of R - d of L), B = u^2 k / (1 + f t). So d solves a tridiagonal system
 * that is diagonally dominant with negative off-diagonals at any t. It is solved for the rise and not for the surface:
 * water at rest has F0 = 0 and stays at rest to the bit.
 *
 * H is the depth over the higher of the two beds below the higher of the two surfaces, which is never negative, so
 * water flows onto dry cells and not out of them. A face carries at most 2 H sqrt(g H), the speed of the front of a
 * broken dam on a dry bed (A. Ritter 1892). Cells whose faces carry off more than they have give each a share.
 *
 * Invariant: what leaves a cell through a face enters the next one, the same number. Compiled for speed. */
#include "waves/shallow_state.h"

#include <stdatomic.h>

enum { LINES = LOM_SHALLOW_LINES, ARRAYS = 9 };
typedef double line_values[LINES]; /* one a line */

/* LINES lines of n cells and n + 1 faces, side by side. */
struct block {
    int cells;
    line_values *bed, *depth, *flow;   /* in; depth and flow are out too */
    line_values *carried, *resistance; /* F0, then F; B */
    line_values *rise, *upper;         /* d; the solver's */
    line_values *cap, *share;          /* 2 H sqrt(g H) of a face; of its outflow that a cell has */
};

/* What lies beyond the two ends of a line. */
struct ends {
    lom_shallow_edge edge[2];
    double level[2];
};

size_t lom_shallow_scratch(int cells)
{
    return (size_t)ARRAYS * (size_t)(cells + 1) * LINES;
}

static struct block lay_out(double *scratch, int cells)
{
    line_values *at = (line_values *)scratch;
    size_t pitch = (size_t)cells + 1;
    return (struct block){ cells,          at,
                           at + pitch,     at + 2 * pitch,
                           at + 3 * pitch, at + 4 * pitch,
                           at + 5 * pitch, at + 6 * pitch,
                           at + 7 * pitch, at + 8 * pitch };
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

/* F0, B and the cap of a face between surfaces a and b over a bed of this height. */
static void weigh_face(const lom_shallow_desc *d, struct block *k, int face, const double *a, const double *b,
                       const double *sill)
{
    double u = d->implicitness, ratio = d->gravity * d->step / d->cell;
    for (int l = 0; l < LINES; l++) {
        double depth = greater(a[l], b[l]) - sill[l], safe = depth > 1e-9 ? depth : 1e-9;
        double flow = k->flow[face][l], fall = b[l] - a[l], pull = ratio * depth;
        double friction = d->friction * (flow < 0 ? -flow : flow) / (safe * safe) * d->step;
        double slowed = u / (1 + friction), resistance = slowed * u * pull;
        double carried = slowed * (flow - pull * (1 - u) * fall) + (1 - u) * flow - resistance * fall;
        k->carried[face][l] = depth > 0 ? carried : 0;
        k->resistance[face][l] = resistance;
        k->cap[face][l] = 2 * depth * __builtin_sqrt(d->gravity * depth);
    }
}

/* The face of an end: walls carry nothing, beyond the others the surface stays as it is. */
static void weigh_end(const lom_shallow_desc *d, struct block *k, const struct ends *ends, int end)
{
    int face = end == 0 ? 0 : k->cells, cell = end == 0 ? 0 : k->cells - 1;
    line_values inside, outside;
    if (ends->edge[end] == LOM_SHALLOW_WALL) {
        for (int l = 0; l < LINES; l++)
            k->carried[face][l] = k->resistance[face][l] = k->cap[face][l] = 0;
        return;
    }
    for (int l = 0; l < LINES; l++) {
        inside[l] = k->bed[cell][l] + k->depth[cell][l];
        outside[l] = ends->edge[end] == LOM_SHALLOW_OPEN ? greater(ends->level[end], k->bed[cell][l]) : k->bed[cell][l];
    }
    weigh_face(d, k, face, end == 0 ? outside : inside, end == 0 ? inside : outside, k->bed[cell]);
}

static void weigh_faces(const lom_shallow_desc *d, struct block *k, const struct ends *ends)
{
    line_values before, after, sill;
    for (int l = 0; l < LINES; l++)
        before[l] = k->bed[0][l] + k->depth[0][l];
    weigh_end(d, k, ends, 0);
    for (int i = 1; i < k->cells; i++) {
        for (int l = 0; l < LINES; l++) {
            after[l] = k->bed[i][l] + k->depth[i][l];
            sill[l] = greater(k->bed[i - 1][l], k->bed[i][l]);
        }
        weigh_face(d, k, i, before, after, sill);
        for (int l = 0; l < LINES; l++)
            before[l] = after[l];
    }
    weigh_end(d, k, ends, 1);
}

/* Gaussian elimination without pivots: the matrix is diagonally dominant. */
static void solve_rise(struct block *k, double ratio)
{
    for (int i = 0; i < k->cells; i++)
        for (int l = 0; l < LINES; l++) {
            double left = i > 0 ? ratio * k->resistance[i][l] : 0, right = ratio * k->resistance[i + 1][l];
            double above = i > 0 ? k->upper[i - 1][l] : 0, known = i > 0 ? k->rise[i - 1][l] : 0;
            double diagonal = 1 + ratio * k->resistance[i][l] + right - left * above;
            double inverse = 1 / diagonal;
            k->upper[i][l] = i + 1 < k->cells ? right * inverse : 0;
            k->rise[i][l] = (-ratio * (k->carried[i + 1][l] - k->carried[i][l]) + left * known) * inverse;
        }
    for (int i = k->cells - 2; i >= 0; i--)
        for (int l = 0; l < LINES; l++)
            k->rise[i][l] += k->upper[i][l] * k->rise[i + 1][l];
}

static void carry(struct block *k)
{
    for (int i = 0; i <= k->cells; i++)
        for (int l = 0; l < LINES; l++) {
            double left = i > 0 ? k->rise[i - 1][l] : 0, right = i < k->cells ? k->rise[i][l] : 0, cap = k->cap[i][l];
            double flow = k->carried[i][l] - k->resistance[i][l] * (right - left);
            k->carried[i][l] = flow > cap ? cap : flow < -cap ? -cap : flow;
        }
}

/* Shares of the outflow, then depths and discharges a step later. */
static void move_water(const lom_shallow_desc *d, struct block *k, double ratio)
{
    double u = d->implicitness;
    for (int i = 0; i < k->cells; i++)
        for (int l = 0; l < LINES; l++) {
            double out = ratio * (greater(k->carried[i + 1][l], 0) + greater(-k->carried[i][l], 0));
            k->share[i][l] = out > k->depth[i][l] ? k->depth[i][l] / out : 1;
        }
    for (int i = 0; i <= k->cells; i++)
        for (int l = 0; l < LINES; l++) {
            double wanted = k->carried[i][l], cap = k->cap[i][l];
            double left = i > 0 ? k->share[i - 1][l] : 1, right = i < k->cells ? k->share[i][l] : 1;
            double flow = wanted * (wanted > 0 ? left : right), next = (flow - (1 - u) * k->flow[i][l]) / u;
            next = flow != wanted ? flow : next;
            k->carried[i][l] = flow;
            k->flow[i][l] = next > cap ? cap : next < -cap ? -cap : next;
        }
    for (int i = 0; i < k->cells; i++)
        for (int l = 0; l < LINES; l++) {
            double depth = k->depth[i][l] + ratio * k->carried[i][l] - ratio * k->carried[i + 1][l];
            k->depth[i][l] = greater(depth, 0);
        }
}

/* Lines of a grid: cell i of line l is at l * line + i * cell. */
struct lines {
    int count, cells;
    size_t line, cell, face_line, face; /* steps in the arrays of cells and of faces */
    double *flow;
    struct ends ends;
};

static int line_of(const struct lines *lines, int first, int l)
{
    return first + l < lines->count ? first + l : lines->count - 1;
}

static void load(const lom_shallow *s, const struct lines *lines, int first, struct block *k)
{
    for (int l = 0; l < LINES; l++) {
        size_t line = (size_t)line_of(lines, first, l);
        const double *bed = s->bed + line * lines->line, *depth = s->depth + line * lines->line;
        const double *flow = lines->flow + line * lines->face_line;
        for (int i = 0; i < lines->cells; i++) {
            k->bed[i][l] = bed[(size_t)i * lines->cell];
            k->depth[i][l] = depth[(size_t)i * lines->cell];
        }
        for (int i = 0; i <= lines->cells; i++)
            k->flow[i][l] = flow[(size_t)i * lines->face];
    }
}

static void store(lom_shallow *s, const struct lines *lines, int first, const struct block *k)
{
    for (int l = 0; l < LINES && first + l < lines->count; l++) {
        size_t line = (size_t)(first + l);
        double *depth = s->depth + line * lines->line, *flow = lines->flow + line * lines->face_line;
        for (int i = 0; i < lines->cells; i++)
            depth[(size_t)i * lines->cell] = k->depth[i][l];
        for (int i = 0; i <= lines->cells; i++)
            flow[(size_t)i * lines->face] = k->flow[i][l];
    }
}

/* What came in and went out through the ends of the lines that are real. */
static void note_ends(lom_shallow *s, const struct lines *lines, int first, const struct block *k)
{
    for (int l = 0; l < LINES && first + l < lines->count; l++) {
        double in = k->carried[0][l], out = k->carried[lines->cells][l];
        s->through[0][first + l] = greater(in, 0) + greater(-out, 0);
        s->through[1][first + l] = greater(-in, 0) + greater(out, 0);
    }
}

/* Line after line, whoever had them. */
static void count_ends(lom_shallow *s, const struct lines *lines)
{
    double area = s->desc.step * s->desc.cell;
    for (int l = 0; l < lines->count; l++) {
        s->gained += area * s->through[0][l];
        s->lost += area * s->through[1][l];
    }
}

struct flowing {
    lom_shallow *water;
    const struct lines *lines;
    size_t scratch; /* doubles a worker */
    atomic_int next;
};

static void flow_in_blocks(void *context, int worker)
{
    struct flowing *flowing = context;
    lom_shallow *s = flowing->water;
    const struct lines *lines = flowing->lines;
    double ratio = s->desc.step / s->desc.cell;
    struct block k = lay_out(s->scratch + (size_t)worker * flowing->scratch, lines->cells);
    for (int first; (first = atomic_fetch_add_explicit(&flowing->next, LINES, memory_order_relaxed)) < lines->count;) {
        load(s, lines, first, &k);
        weigh_faces(&s->desc, &k, &lines->ends);
        solve_rise(&k, ratio);
        carry(&k);
        move_water(&s->desc, &k, ratio);
        store(s, lines, first, &k);
        note_ends(s, lines, first, &k);
    }
}

static void flow_along(lom_shallow *s, const struct lines *lines)
{
    const int longer = s->desc.columns > s->desc.rows ? s->desc.columns : s->desc.rows;
    struct flowing flowing = { .water = s, .lines = lines, .scratch = lom_shallow_scratch(longer) };
    if (s->pool != NULL)
        lom_offer_work(s->pool, flow_in_blocks, &flowing);
    else
        flow_in_blocks(&flowing, 0);
    count_ends(s, lines);
}

void lom_move_shallow_lines(lom_shallow *s)
{
    const lom_shallow_desc *d = &s->desc;
    size_t columns = (size_t)d->columns;
    struct lines along_x = { d->rows,     d->columns,
                             columns,     1,
                             columns + 1, 1,
                             s->flow_x,   { { d->edge[0], d->edge[1] }, { d->edge_level[0], d->edge_level[1] } } };
    struct lines along_z = { d->columns, d->rows,
                             1,          columns,
                             1,          columns,
                             s->flow_z,  { { d->edge[2], d->edge[3] }, { d->edge_level[2], d->edge_level[3] } } };
    flow_along(s, &along_x);
    flow_along(s, &along_z);
}
