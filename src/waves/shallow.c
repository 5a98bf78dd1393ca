/* Making shallow water, and what is done to it from outside. In: a bed, sources, obstacles. Out: depths a step later.
 * Invariant: the volume changes by what is counted as gained and lost, and by nothing else. */
#include "base/own_float_state.h"
#include "base/range.h"
#include "waves/shallow_state.h"

#include <string.h>

static bool is_within(double x, double low, double high)
{
    return x >= low && x <= high;
}

/* 0 becomes `initial`. */
static bool resolve(double *value, double initial, double low, double high, const char *what, lom_error *error)
{
    if (*value == 0)
        *value = initial;
    return lom_check_range(*value, low, high, error, "The %s of shallow water", what);
}

static bool resolve_desc(lom_shallow_desc *d, lom_error *error)
{
    if (d->columns < 2 || d->columns > LOM_SHALLOW_LARGEST || d->rows < 2 || d->rows > LOM_SHALLOW_LARGEST)
        return lom_fail(error, LOM_ERROR_USAGE, "Shallow water has 2 to %d columns and rows of cells, not %d x %d.",
                        LOM_SHALLOW_LARGEST, d->columns, d->rows);
    if (d->bed == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "Shallow water needs a bed.");
    for (int i = 0; i < 4; i++)
        if ((unsigned)d->edge[i] > LOM_SHALLOW_OPEN || !is_within(d->edge_level[i], -1e5, 1e5))
            return lom_fail(error, LOM_ERROR_USAGE,
                            "Edge %d of shallow water is no wall, fall or open one, or its level is beyond 100 km.", i);
    return resolve(&d->cell, 0, 1e-3, 1e5, "cell in metres", error) &&
           resolve(&d->level, 0, -1e5, 1e5, "level in metres", error) &&
           resolve(&d->step, 1.0 / 60, 1e-5, 1e3, "step in seconds", error) &&
           resolve(&d->implicitness, 0.55, 0.5, 1, "implicitness", error) &&
           resolve(&d->gravity, 9.80665, 1e-3, 1000, "gravity in m/s^2", error) &&
           resolve(&d->friction, 0, 0, 10, "friction", error);
}

static bool check_cells(const lom_shallow_desc *d, lom_error *error)
{
    size_t cells = (size_t)d->columns * (size_t)d->rows;
    for (size_t i = 0; i < cells; i++)
        if (!is_within(d->bed[i], -1e5, 1e5) || (d->depth != NULL && !is_within(d->depth[i], 0, 1e5)))
            return lom_fail(
                error, LOM_ERROR_USAGE,
                "Cell (%d, %d) of shallow water has a bed beyond 100 km, a depth that is negative or beyond "
                "it, or none that is a number.",
                (int)(i % (size_t)d->columns), (int)(i / (size_t)d->columns));
    return true;
}

static bool make_scratch(lom_shallow *s, lom_error *error)
{
    const int longer = s->desc.columns > s->desc.rows ? s->desc.columns : s->desc.rows;
    const size_t workers = s->pool != NULL ? (size_t)lom_pool_size(s->pool) : 1;
    s->scratch = lom_allocate(workers * lom_shallow_scratch(longer), sizeof(double), error);
    return s->scratch != NULL;
}

/* The arrays of one, not filled. */
static lom_shallow *allocate(const lom_shallow_desc *d, lom_pool *pool, lom_error *error)
{
    size_t cells = (size_t)d->columns * (size_t)d->rows, columns = (size_t)d->columns, rows = (size_t)d->rows;
    lom_shallow *s = lom_allocate(1, sizeof *s, error);
    if (s == NULL)
        return NULL;
    s->desc = *d;
    s->desc.bed = s->desc.depth = NULL;
    s->ground = lom_allocate(cells, sizeof(double), error);
    s->bed = lom_allocate(cells, sizeof(double), error);
    s->depth = lom_allocate(cells, sizeof(double), error);
    s->flow_x = lom_allocate((columns + 1) * rows, sizeof(double), error);
    s->flow_z = lom_allocate(columns * (rows + 1), sizeof(double), error);
    for (int i = 0; i < 2; i++)
        s->through[i] = lom_allocate(columns > rows ? columns : rows, sizeof(double), error);
    s->pool = pool;
    if (make_scratch(s, error) && s->ground != NULL && s->bed != NULL && s->depth != NULL && s->flow_x != NULL &&
        s->flow_z != NULL && s->through[0] != NULL && s->through[1] != NULL)
        return s;
    lom_free_shallow(s);
    return NULL;
}

lom_shallow *lom_create_shallow(const lom_shallow_desc *desc, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_shallow_desc d = desc != NULL ? *desc : (lom_shallow_desc){ .columns = 0 };
    if (!resolve_desc(&d, error) || !check_cells(&d, error))
        return NULL;
    lom_shallow *s = allocate(&d, NULL, error);
    size_t cells = (size_t)d.columns * (size_t)d.rows;
    for (size_t i = 0; s != NULL && i < cells; i++) {
        s->ground[i] = s->bed[i] = d.bed[i];
        s->depth[i] = d.depth != NULL ? d.depth[i] : d.level > d.bed[i] ? d.level - d.bed[i] : 0;
    }
    return s;
}

lom_shallow *lom_copy_shallow(const lom_shallow *from, lom_error *error)
{
    lom_shallow *s = allocate(&from->desc, from->pool, error);
    if (s == NULL)
        return NULL;
    size_t columns = (size_t)from->desc.columns, rows = (size_t)from->desc.rows, cells = columns * rows;
    memcpy(s->ground, from->ground, cells * sizeof(double));
    memcpy(s->bed, from->bed, cells * sizeof(double));
    memcpy(s->depth, from->depth, cells * sizeof(double));
    memcpy(s->flow_x, from->flow_x, (columns + 1) * rows * sizeof(double));
    memcpy(s->flow_z, from->flow_z, columns * (rows + 1) * sizeof(double));
    s->steps = from->steps;
    s->gained = from->gained;
    s->lost = from->lost;
    return s;
}

void lom_free_shallow(lom_shallow *s)
{
    if (s == NULL)
        return;
    lom_release(s->ground);
    lom_release(s->bed);
    lom_release(s->depth);
    lom_release(s->flow_x);
    lom_release(s->flow_z);
    lom_release(s->scratch);
    lom_release(s->through[0]);
    lom_release(s->through[1]);
    lom_release(s);
}

bool lom_share_shallow(lom_shallow *s, lom_pool *pool, lom_error *error)
{
    lom_release(s->scratch);
    s->pool = pool;
    return make_scratch(s, error);
}

/* ---- sources and obstacles ---- */

/* Cells first to last, inclusive, whose middles lie between low and high along an axis. */
struct range {
    int first, last;
};

static struct range cells_between(double low, double high, double cell, int count)
{
    double first = lom_double_floor(low / cell - 0.5) + 1, last = lom_double_floor(high / cell - 0.5);
    return (struct range){ first < 0       ? 0
                           : first > count ? count
                                           : lom_int_of(first),
                           last >= count ? count - 1
                           : last < -1   ? -1
                                         : lom_int_of(last) };
}

static int nearest_cell(double x, double cell, int count)
{
    double i = lom_double_floor(x / cell);
    return i < 0 ? 0 : i >= count ? count - 1 : lom_int_of(i);
}

/* Rise of every cell in the disc, or how many there are when `amount` is NULL. */
static int pour(lom_shallow *s, const lom_shallow_source *source, const double *amount)
{
    const lom_shallow_desc *d = &s->desc;
    struct range x = cells_between(source->x - source->radius, source->x + source->radius, d->cell, d->columns);
    struct range z = cells_between(source->z - source->radius, source->z + source->radius, d->cell, d->rows);
    double area = d->cell * d->cell;
    int count = 0;
    for (int j = z.first; j <= z.last; j++)
        for (int i = x.first; i <= x.last; i++) {
            double dx = (i + 0.5) * d->cell - source->x, dz = (j + 0.5) * d->cell - source->z;
            if (dx * dx + dz * dz > source->radius * source->radius)
                continue;
            count++;
            if (amount == NULL)
                continue;
            double *depth = &s->depth[(size_t)j * (size_t)d->columns + (size_t)i], before = *depth;
            *depth = before + *amount > 0 ? before + *amount : 0;
            s->gained += *amount > 0 ? *amount * area : 0;
            s->lost += *amount > 0 ? 0 : (before - *depth) * area;
        }
    return count;
}

static void apply_source(lom_shallow *s, const lom_shallow_source *source)
{
    const lom_shallow_desc *d = &s->desc;
    lom_shallow_source at = *source;
    int count = pour(s, &at, NULL);
    if (count == 0) {
        at.x = (nearest_cell(source->x, d->cell, d->columns) + 0.5) * d->cell;
        at.z = (nearest_cell(source->z, d->cell, d->rows) + 0.5) * d->cell;
        at.radius = 0.25 * d->cell;
        count = 1;
    }
    double amount = source->rate * d->step / (d->cell * d->cell * count);
    pour(s, &at, &amount);
}

static void raise_bed(lom_shallow *s, const lom_shallow_obstacle *o)
{
    const lom_shallow_desc *d = &s->desc;
    double reach = o->half[0] > o->half[1] ? o->half[0] : o->half[1];
    double along_x = lom_double_cos(o->heading), along_z = lom_double_sin(o->heading);
    struct range x = cells_between(o->x - reach, o->x + reach, d->cell, d->columns);
    struct range z = cells_between(o->z - reach, o->z + reach, d->cell, d->rows);
    for (int j = z.first; j <= z.last; j++)
        for (int i = x.first; i <= x.last; i++) {
            double dx = (i + 0.5) * d->cell - o->x, dz = (j + 0.5) * d->cell - o->z;
            double a = (dx * along_x + dz * along_z) / o->half[0], b = (dz * along_x - dx * along_z) / o->half[1];
            double left = 1 - a * a - b * b;
            if (left > 0)
                s->bed[(size_t)j * (size_t)d->columns + (size_t)i] += o->draft * left * left;
        }
}

static bool check_lists(const lom_shallow_source *sources, int source_count, const lom_shallow_obstacle *obstacles,
                        int obstacle_count, lom_error *error)
{
    if (source_count < 0 || source_count > LOM_SHALLOW_SOURCES || obstacle_count < 0 ||
        obstacle_count > LOM_SHALLOW_OBSTACLES)
        return lom_fail(error, LOM_ERROR_USAGE, "Shallow water takes up to %d sources and %d obstacles, not %d and %d.",
                        LOM_SHALLOW_SOURCES, LOM_SHALLOW_OBSTACLES, source_count, obstacle_count);
    for (int i = 0; i < source_count; i++) {
        const lom_shallow_source *s = &sources[i];
        if (!is_within(s->x, -1e9, 1e9) || !is_within(s->z, -1e9, 1e9) || !is_within(s->radius, 0, 1e6) ||
            !is_within(s->rate, -1e9, 1e9))
            return lom_fail(error, LOM_ERROR_USAGE, "Source %d of shallow water has a number out of its range.", i);
    }
    for (int i = 0; i < obstacle_count; i++) {
        const lom_shallow_obstacle *o = &obstacles[i];
        if (!is_within(o->x, -1e9, 1e9) || !is_within(o->z, -1e9, 1e9) || !is_within(o->half[0], 1e-9, 1e6) ||
            !is_within(o->half[1], 1e-9, 1e6) || !is_within(o->heading, -1e6, 1e6) || !is_within(o->draft, 0, 1e4))
            return lom_fail(error, LOM_ERROR_USAGE, "Obstacle %d of shallow water has a number out of its range.", i);
    }
    return true;
}

bool lom_step_shallow(lom_shallow *s, const lom_shallow_source *sources, int source_count,
                      const lom_shallow_obstacle *obstacles, int obstacle_count, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (!check_lists(sources, source_count, obstacles, obstacle_count, error))
        return false;
    memcpy(s->bed, s->ground, (size_t)s->desc.columns * (size_t)s->desc.rows * sizeof *s->bed);
    for (int i = 0; i < obstacle_count; i++)
        raise_bed(s, &obstacles[i]);
    for (int i = 0; i < source_count; i++)
        apply_source(s, &sources[i]);
    lom_move_shallow_lines(s);
    s->steps++;
    return true;
}

lom_shallow_view lom_view_shallow(const lom_shallow *s)
{
    LOM_OWN_FLOAT_STATE;
    const lom_shallow_desc *d = &s->desc;
    double volume = 0;
    for (size_t i = 0; i < (size_t)d->columns * (size_t)d->rows; i++)
        volume += s->depth[i];
    return (lom_shallow_view){ .columns = d->columns,
                               .rows = d->rows,
                               .cell = d->cell,
                               .step = d->step,
                               .steps = s->steps,
                               .bed = s->bed,
                               .depth = s->depth,
                               .flow_x = s->flow_x,
                               .flow_z = s->flow_z,
                               .volume = volume * d->cell * d->cell,
                               .gained = s->gained,
                               .lost = s->lost };
}
