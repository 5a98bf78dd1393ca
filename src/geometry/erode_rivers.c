/* Erosion by rivers. In: heights, and where land rises and how fast; out: heights in which every cell has a way down to
 * open water. Invariant: cells are visited in the order of the flood (height, then index), so each after its receiver.
 * Compiled for speed. */
#include "geometry/erosion.h"

lom_field lom_create_field(int size, double cell, lom_error *error)
{
    return (lom_field){ size, cell, lom_allocate((size_t)size * (size_t)size, sizeof(double), error) };
}

static int clamp_index(int i, int size)
{
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

static void cubic_weights(double t, double weight[4])
{
    weight[0] = t * (-0.5 + t * (1.0 - 0.5 * t));
    weight[1] = 1.0 + t * t * (-2.5 + 1.5 * t);
    weight[2] = t * (0.5 + t * (2.0 - 1.5 * t));
    weight[3] = t * t * (-0.5 + 0.5 * t);
}

double lom_field_at(const lom_field *field, double x, double y)
{
    double left = lom_double_floor(x);
    double top = lom_double_floor(y);
    double across[4], down[4];
    cubic_weights(x - left, across);
    cubic_weights(y - top, down);
    double sum = 0;
    for (int b = 0; b < 4; b++) {
        const double *row =
            field->values + (size_t)clamp_index(lom_int_of(top) + b - 1, field->size) * (size_t)field->size;
        double line = 0;
        for (int a = 0; a < 4; a++)
            line += across[a] * row[clamp_index(lom_int_of(left) + a - 1, field->size)];
        sum += down[b] * line;
    }
    return sum;
}

lom_field lom_double_field(const lom_field *field, lom_error *error)
{
    lom_field fine = lom_create_field(field->size * 2, field->cell * 0.5, error);
    for (int y = 0; fine.values != NULL && y < fine.size; y++)
        for (int x = 0; x < fine.size; x++)
            fine.values[(size_t)y * (size_t)fine.size + (size_t)x] =
                lom_field_at(field, (x + 0.5) * 0.5 - 0.5, (y + 0.5) * 0.5 - 0.5);
    return fine;
}

/* ---- the flood: a binary heap of cells, the lowest on top ---- */

typedef struct entry {
    double height;
    int32_t cell;
} entry;

typedef struct flood {
    int size;
    entry *heap;
    size_t heap_count;
    int32_t *order, *receiver; /* cells as they were reached; where each drains to, itself for open water */
    double *level;             /* height with pits filled */
    uint8_t *reached;
    double *area;
} flood;

static bool is_below(entry a, entry b)
{
    return a.height < b.height || (!(b.height < a.height) && a.cell < b.cell);
}

static void push(flood *f, entry e)
{
    size_t i = f->heap_count++;
    for (; i > 0 && is_below(e, f->heap[(i - 1) / 2]); i = (i - 1) / 2)
        f->heap[i] = f->heap[(i - 1) / 2];
    f->heap[i] = e;
}

static entry pop(flood *f)
{
    entry top = f->heap[0];
    entry last = f->heap[--f->heap_count];
    size_t i = 0;
    for (size_t child = 1; child < f->heap_count; child = 2 * i + 1) {
        if (child + 1 < f->heap_count && is_below(f->heap[child + 1], f->heap[child]))
            child++;
        if (!is_below(f->heap[child], last))
            break;
        f->heap[i] = f->heap[child];
        i = child;
    }
    f->heap[i] = last;
    return top;
}

static const int8_t neighbours[8][2] = { { 1, 0 }, { 0, 1 },  { -1, 0 },  { 0, -1 },
                                         { 1, 1 }, { -1, 1 }, { -1, -1 }, { 1, -1 } };

static double neighbour_distance(int k)
{
    return k < 4 ? 1.0 : 1.4142135623730951;
}

/* The cell beside `cell` in direction k, -1 outside. */
static int32_t neighbour(const flood *f, int32_t cell, int k)
{
    int x = cell % f->size + neighbours[k][0];
    int y = cell / f->size + neighbours[k][1];
    return x < 0 || y < 0 || x >= f->size || y >= f->size ? -1 : y * f->size + x;
}

/* The steepest way down among the neighbours that were reached before. Slopes are varied by a random factor, or
 * valleys would prefer the eight directions of the grid. */
static int32_t choose_receiver(const flood *f, int32_t cell, uint64_t seed)
{
    int32_t best = cell;
    double best_slope = -1;
    uint64_t bits = lom_random_bits(seed, (uint64_t)cell);
    for (int k = 0; k < 8; k++) {
        int32_t other = neighbour(f, cell, k);
        if (other < 0 || f->reached[other] != 2)
            continue;
        double vary = 0.65 + 0.7 / 255.0 * (double)(bits >> (8 * k) & 255);
        double slope = vary * (f->level[cell] - f->level[other]) / neighbour_distance(k);
        if (slope > best_slope) {
            best_slope = slope;
            best = other;
        }
    }
    return best;
}

/* Barnes et al. 2014, algorithm 1; `reached` is 1 in the heap, 2 when its order is settled. */
static void run_flood(flood *f, const double *height, const double *uplift, uint64_t seed)
{
    int32_t cells = f->size * f->size;
    f->heap_count = 0;
    for (int32_t i = 0; i < cells; i++) {
        f->reached[i] = uplift[i] <= 0;
        f->level[i] = 0;
        if (f->reached[i])
            push(f, (entry){ 0, i });
    }
    for (size_t n = 0; f->heap_count > 0; n++) {
        entry e = pop(f);
        f->order[n] = e.cell;
        f->receiver[e.cell] = uplift[e.cell] <= 0 ? e.cell : choose_receiver(f, e.cell, seed);
        f->reached[e.cell] = 2;
        for (int k = 0; k < 8; k++) {
            int32_t other = neighbour(f, e.cell, k);
            if (other < 0 || f->reached[other])
                continue;
            f->reached[other] = 1;
            f->level[other] = height[other] > e.height ? height[other] : e.height;
            push(f, (entry){ f->level[other], other });
        }
    }
}

/* 0 for soil, 1 for rock. */
static double rockiness(const lom_rivers *rivers, double height)
{
    double part = height / rivers->rock_height;
    return part < 0 ? 0 : part > 1 ? 1 : part;
}

/* Hillslope diffusion: what rounds crests and fills the foot of slopes. */
static void creep(flood *f, lom_field *height, const lom_rivers *rivers)
{
    int32_t cells = f->size * f->size;
    double *old = f->level;
    for (int32_t i = 0; i < cells; i++)
        old[i] = height->values[i];
    for (int32_t i = 0; i < cells; i++) {
        if (rivers->uplift[i] <= 0)
            continue;
        double sum = 0;
        for (int k = 0; k < 4; k++) {
            int32_t other = neighbour(f, i, k);
            sum += old[other < 0 ? i : other];
        }
        height->values[i] += rivers->creep * (1 - 0.8 * rockiness(rivers, old[i])) * (sum * 0.25 - old[i]);
    }
}

/* h' = (h + dt (U + K sqrt(A)/d h_r')) / (1 + dt K sqrt(A)/d), the receiver's new height h_r' being known already. */
static void incise(flood *f, lom_field *height, const lom_rivers *rivers)
{
    size_t cells = (size_t)f->size * (size_t)f->size;
    double *h = height->values;
    for (size_t i = 0; i < cells; i++)
        f->area[i] = 1.0 / (double)cells;
    for (size_t n = cells; n-- > 0;) {
        int32_t cell = f->order[n];
        if (f->receiver[cell] != cell)
            f->area[f->receiver[cell]] += f->area[cell];
    }
    for (size_t n = 0; n < cells; n++) {
        int32_t cell = f->order[n];
        int32_t down = f->receiver[cell];
        if (down == cell) {
            h[cell] = 0;
            continue;
        }
        int steps = (cell % f->size != down % f->size) + (cell / f->size != down / f->size);
        double distance = height->cell * neighbour_distance(steps == 1 ? 0 : 4);
        double rate = rivers->step * rivers->incision * lom_double_sqrt(f->area[cell]) / distance;
        double risen = h[cell] + rivers->step * rivers->uplift[cell];
        double carved = (risen + rate * h[down]) / (1.0 + rate);
        double talus = rivers->talus[0] + (rivers->talus[1] - rivers->talus[0]) * rockiness(rivers, h[down]);
        double steepest = h[down] + talus * distance;
        h[cell] = carved < steepest ? carved : steepest;
    }
}

bool lom_erode_by_rivers(lom_field *height, const lom_rivers *rivers, lom_error *error)
{
    size_t cells = (size_t)height->size * (size_t)height->size;
    flood f = { .size = height->size };
    f.heap = lom_allocate(cells, sizeof *f.heap, error);
    f.order = lom_allocate(cells, sizeof *f.order, error);
    f.receiver = lom_allocate(cells, sizeof *f.receiver, error);
    f.level = lom_allocate(cells, sizeof *f.level, error);
    f.reached = lom_allocate(cells, 1, error);
    f.area = lom_allocate(cells, sizeof *f.area, error);
    bool ready = f.heap && f.order && f.receiver && f.level && f.reached && f.area;
    for (int i = 0; ready && i < rivers->steps; i++) {
        run_flood(&f, height->values, rivers->uplift, rivers->seed + (uint64_t)i);
        incise(&f, height, rivers);
        creep(&f, height, rivers);
    }
    lom_release(f.heap);
    lom_release(f.order);
    lom_release(f.receiver);
    lom_release(f.level);
    lom_release(f.reached);
    lom_release(f.area);
    return ready;
}
