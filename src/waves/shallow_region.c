/* Shallow water of a site at a time. In: its region, springs and bodies, its bed, a time. Out: the state of
 * the water. Invariant: the state is that after all steps from the start to the time. */
#include "base/numbers.h"
#include "waves/wave_site.h"

#include <string.h>

enum { MOST_STEPS = 10000000 };

/* Between the bed's vertices, over its base. */
static double height_over_base(const struct lom_bed *bed, double x, double z)
{
    const double *size = bed->size;
    double u = (x / size[0] + 0.5) * bed->columns, v = (z / size[1] + 0.5) * bed->rows;
    u = u < 0 ? 0 : u > bed->columns ? bed->columns : u;
    v = v < 0 ? 0 : v > bed->rows ? bed->rows : v;
    int column = lom_int_of(u) < bed->columns ? lom_int_of(u) : bed->columns - 1;
    int row = lom_int_of(v) < bed->rows ? lom_int_of(v) : bed->rows - 1;
    const float *h = bed->heights + (size_t)row * ((size_t)bed->columns + 1) + column;
    const float *below = h + bed->columns + 1;
    double s = u - column, t = v - row;
    return (h[0] + s * ((double)h[1] - h[0])) * (1 - t) + (below[0] + s * ((double)below[1] - below[0])) * t;
}

double lom_bed_over_level(const struct lom_wave_site *site, double x, double z)
{
    const struct lom_bed *bed = &site->bed;
    return bed->heights == NULL ? -100 : height_over_base(bed, x, z) + (bed->base - site->level);
}

double lom_bed_height(const struct lom_bed *bed, double x, double z)
{
    return height_over_base(bed, x, z) + bed->base;
}

bool lom_open_shallow_region(struct lom_shallow_region *region, const struct lom_wave_site *site, lom_error *error)
{
    const lom_shallow_water *w = site->shallow;
    *region = (struct lom_shallow_region){ .first = NULL };
    if (!w->present)
        return true;
    double longer = w->size[0] > w->size[1] ? w->size[0] : w->size[1], cell = longer / w->cells;
    if (!(cell >= 0.001 && cell <= 1e5))
        return lom_fail(error, LOM_ERROR_LIMIT,
                        "The longer of shallow.size over shallow.cells is not within 0.001..100000 m: %g m.", cell);
    int columns = lom_int_of(w->size[0] / cell + 0.5), rows = lom_int_of(w->size[1] / cell + 0.5);
    region->cell = cell;
    region->columns = columns < 2 ? 2 : columns;
    region->rows = rows < 2 ? 2 : rows;
    region->corner[0] = w->position[0] - region->columns * cell / 2;
    region->corner[1] = w->position[1] - region->rows * cell / 2;
    size_t cells = (size_t)region->columns * (size_t)region->rows;
    double *height = lom_allocate(cells, sizeof *height, error);
    for (size_t i = 0; height != NULL && i < cells; i++) {
        height[i] = lom_bed_over_level(site, region->corner[0] + ((double)(i % (size_t)region->columns) + 0.5) * cell,
                                       region->corner[1] + ((double)(i / (size_t)region->columns) + 0.5) * cell);
        region->lowest = height[i] < region->lowest ? height[i] : region->lowest;
    }
    if (site->foam->carried) {
        region->foam = lom_allocate(cells, sizeof *region->foam, error);
        region->foam_after = lom_allocate(cells, sizeof *region->foam_after, error);
        if (region->foam == NULL || region->foam_after == NULL) {
            lom_release(height);
            return false;
        }
    }
    lom_shallow_desc desc = { .columns = region->columns,
                              .rows = region->rows,
                              .cell = cell,
                              .bed = height,
                              .step = w->step,
                              .friction = w->friction,
                              .implicitness = w->implicitness };
    for (int i = 0; i < 4; i++) {
        desc.edge[i] = (lom_shallow_edge)w->edge;
        desc.edge_level[i] = desc.level;
    }
    if (height != NULL) {
        lom_error failed = { 0 };
        region->first = lom_create_shallow(&desc, &failed);
        if (region->first == NULL)
            lom_fail(error, failed.code, "[shallow] at water.level over the terrain: %s", failed.text);
    }
    lom_release(height);
    return region->first != NULL;
}

/* How much of its draft a body that dips in has in the water at a time: sin^2 over the duration. */
static double dip_of(const lom_shallow_body *body, double time)
{
    double since = time - body->time;
    if (body->duration == 0)
        return 1;
    if (body->every > 0 && since > 0)
        since -= lom_double_floor(since / body->every) * body->every;
    if (since <= 0 || since >= body->duration)
        return 0;
    double s = lom_double_sin(lom_pi * since / body->duration);
    return s * s;
}

static lom_shallow_obstacle place_body(const struct lom_wave_site *site, const lom_shallow_body *body,
                                       const double corner[2], double time)
{
    lom_shallow_obstacle o = { body->position[0],
                               body->position[1],
                               { body->half[0], body->half[1] },
                               body->heading,
                               body->draft * dip_of(body, time) };
    if (body->followed != 0) {
        double place[2];
        double ahead; /* of the entity's -z */
        site->follow(site->scene, body->followed, time, place, &ahead);
        o.heading = ahead + (body->heading + lom_pi / 2);
        o.x = place[0];
        o.z = place[1];
    }
    o.x -= corner[0];
    o.z -= corner[1];
    return o;
}

static bool run_step(struct lom_shallow_region *region, const struct lom_wave_site *site, double time, lom_error *error)
{
    const lom_shallow_water *w = site->shallow;
    lom_shallow_source sources[LOM_SHALLOW_SOURCES];
    lom_shallow_obstacle bodies[LOM_SHALLOW_OBSTACLES];
    for (size_t i = 0; i < w->spring_count; i++)
        sources[i] = (lom_shallow_source){ w->springs[i].position[0] - region->corner[0],
                                           w->springs[i].position[1] - region->corner[1], w->springs[i].radius,
                                           w->springs[i].rate };
    for (size_t i = 0; i < w->body_count; i++)
        bodies[i] = place_body(site, &w->bodies[i], region->corner, time);
    region->run++;
    if (!lom_step_shallow(region->now, sources, (int)w->spring_count, bodies, (int)w->body_count, error))
        return false;
    if (region->foam != NULL) {
        lom_shallow_obstacle before[LOM_SHALLOW_OBSTACLES];
        for (size_t i = 0; i < w->body_count; i++)
            before[i] = place_body(site, &w->bodies[i], region->corner, time - w->step);
        lom_carry_shallow_foam(region, site, bodies, before);
    }
    return true;
}

/* To the step before the time; a thousandth of a step is rounding. */
bool lom_advance_shallow_region(struct lom_shallow_region *region, const struct lom_wave_site *site, double time,
                                lom_error *error)
{
    double step = site->shallow->step, start = site->shallow->start;
    double steps = time > start ? lom_double_floor((time - start) / step + 0.001) : 0;
    if (steps > MOST_STEPS)
        return lom_fail(
            error, LOM_ERROR_LIMIT,
            "This frame is more than %d steps (shallow.step) of shallow water after the beginning (shallow.start).",
            MOST_STEPS);
    if (region->now != NULL && lom_view_shallow(region->now).steps > lom_int64_of(steps)) {
        lom_free_shallow(region->now);
        region->now = NULL;
    }
    if (region->now == NULL) {
        region->now = lom_copy_shallow(region->first, error);
        if (region->foam != NULL)
            memset(region->foam, 0, (size_t)region->columns * (size_t)region->rows * sizeof *region->foam);
    }
    bool done = region->now != NULL;
    for (int64_t i = done ? lom_view_shallow(region->now).steps : 0; done && i < lom_int64_of(steps); i++)
        done = run_step(region, site, start + (double)i * step, error);
    return done;
}

void lom_close_shallow_region(struct lom_shallow_region *region)
{
    lom_free_shallow(region->first);
    lom_free_shallow(region->now);
    lom_release(region->foam);
    lom_release(region->foam_after);
}
