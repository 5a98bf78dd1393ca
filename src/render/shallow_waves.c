/* Shallow water of a scene at a time. In: the scene's region, springs and bodies, a time. Out: the surface as textures.
 * Invariant: the state at a time is that after all steps from the start to it, so any frame alone is that of a run; a
 * run goes on from the frame before. */
#include "render/renderer.h"
#include "water/shallow_surface.h"

enum { MOST_STEPS = 10000000 };

/* The height of the terrain between its vertices; deep below the water where there is none. */
static double bed_at(const lom_renderer *r, double x, double z)
{
    const struct lom_ground *ground = &r->ground;
    const double *size = r->scene->terrain.size;
    if (ground->heights == NULL)
        return r->scene->water.level - 100;
    double u = (x / size[0] + 0.5) * ground->columns, v = (z / size[1] + 0.5) * ground->rows;
    u = u < 0 ? 0 : u > ground->columns ? ground->columns : u;
    v = v < 0 ? 0 : v > ground->rows ? ground->rows : v;
    int column = (int)u < ground->columns ? (int)u : ground->columns - 1;
    int row = (int)v < ground->rows ? (int)v : ground->rows - 1;
    const float *h = ground->heights + (size_t)row * ((size_t)ground->columns + 1) + column;
    const float *below = h + ground->columns + 1;
    double s = u - column, t = v - row;
    return (h[0] + s * ((double)h[1] - h[0])) * (1 - t) + (below[0] + s * ((double)below[1] - below[0])) * t;
}

bool lom_load_shallow(lom_renderer *r, lom_error *error)
{
    const lom_shallow_water *w = &r->scene->shallow;
    struct lom_shallow_waves *waves = &r->shallow;
    if (w->given == 0)
        return true;
    double longer = w->size[0] > w->size[1] ? w->size[0] : w->size[1], cell = longer / w->cells;
    int columns = (int)(w->size[0] / cell + 0.5), rows = (int)(w->size[1] / cell + 0.5);
    waves->cell = cell;
    waves->columns = columns < 2 ? 2 : columns;
    waves->rows = rows < 2 ? 2 : rows;
    waves->corner[0] = w->position[0] - waves->columns * cell / 2;
    waves->corner[1] = w->position[1] - waves->rows * cell / 2;
    size_t cells = (size_t)waves->columns * (size_t)waves->rows;
    double *bed = lom_allocate(cells, sizeof *bed, error);
    waves->surface = lom_allocate(cells, sizeof *waves->surface, error);
    waves->moments = lom_allocate(cells, sizeof *waves->moments, error);
    waves->lowest = 0;
    for (size_t i = 0; bed != NULL && i < cells; i++) {
        bed[i] = bed_at(r, waves->corner[0] + ((double)(i % (size_t)waves->columns) + 0.5) * cell,
                        waves->corner[1] + ((double)(i / (size_t)waves->columns) + 0.5) * cell);
        waves->lowest = bed[i] - r->scene->water.level < waves->lowest ? bed[i] - r->scene->water.level : waves->lowest;
    }
    lom_shallow_desc desc = { .columns = waves->columns,
                              .rows = waves->rows,
                              .cell = cell,
                              .bed = bed,
                              .level = r->scene->water.level,
                              .step = w->step,
                              .friction = w->friction,
                              .implicitness = w->implicitness };
    for (int i = 0; i < 4; i++) {
        desc.edge[i] = (lom_shallow_edge)w->edge;
        desc.edge_level[i] = desc.level;
    }
    if (bed != NULL && waves->surface != NULL && waves->moments != NULL)
        waves->first = lom_create_shallow(&desc, error);
    lom_release(bed);
    return waves->first != NULL;
}

void lom_free_shallow_waves(lom_renderer *r)
{
    lom_free_shallow(r->shallow.first);
    lom_free_shallow(r->shallow.now);
    lom_release(r->shallow.surface);
    lom_release(r->shallow.moments);
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
    double s = lom_double_sin(3.141592653589793 * since / body->duration);
    return s * s;
}

static lom_shallow_obstacle place_body(const lom_scene *scene, const lom_shallow_body *body, const double corner[2],
                                       double time)
{
    lom_shallow_obstacle o = { body->position[0],
                               body->position[1],
                               { body->half[0], body->half[1] },
                               body->heading,
                               body->draft * dip_of(body, time) };
    if (body->followed != 0) { /* an entity's -z is ahead, turned by its yaw from +x towards -z */
        lom_entity_place at = lom_scene_entity_at(&scene->entities[body->followed - 1], time);
        o.x = at.position.x;
        o.z = at.position.z;
        o.heading = -1.5707963267948966 - at.rotation.y;
    }
    o.x -= corner[0];
    o.z -= corner[1];
    return o;
}

static bool run_step(lom_renderer *r, double time, lom_error *error)
{
    const lom_shallow_water *w = &r->scene->shallow;
    lom_shallow_source sources[LOM_SHALLOW_SOURCES];
    lom_shallow_obstacle bodies[LOM_SHALLOW_OBSTACLES];
    for (size_t i = 0; i < w->spring_count; i++)
        sources[i] = (lom_shallow_source){ w->springs[i].position[0] - r->shallow.corner[0],
                                           w->springs[i].position[1] - r->shallow.corner[1], w->springs[i].radius,
                                           w->springs[i].rate };
    for (size_t i = 0; i < w->body_count; i++)
        bodies[i] = place_body(r->scene, &w->bodies[i], r->shallow.corner, time);
    r->shallow.run++;
    return lom_step_shallow(r->shallow.now, sources, (int)w->spring_count, bodies, (int)w->body_count, error);
}

/* To the step before a time; a thousandth of a step is rounding. */
static bool advance(lom_renderer *r, double time, lom_error *error)
{
    struct lom_shallow_waves *waves = &r->shallow;
    double step = r->scene->shallow.step, start = r->scene->shallow.start;
    double steps = time > start ? lom_double_floor((time - start) / step + 0.001) : 0;
    if (steps > MOST_STEPS)
        return lom_fail(error, LOM_ERROR_LIMIT,
                        "This frame is more than %d steps of shallow water after the beginning.", MOST_STEPS);
    if (waves->now != NULL && lom_view_shallow(waves->now).steps > (int64_t)steps) {
        lom_free_shallow(waves->now);
        waves->now = NULL;
    }
    if (waves->now == NULL)
        waves->now = lom_copy_shallow(waves->first, error);
    bool done = waves->now != NULL;
    for (int64_t i = done ? lom_view_shallow(waves->now).steps : 0; done && i < (int64_t)steps; i++)
        done = run_step(r, start + (double)i * step, error);
    return done;
}

static lom_texture *make_map(lom_renderer *r, const void *pixels)
{
    return lom_make_texture(r->device,
                            &(lom_texture_desc){ .width = r->shallow.columns,
                                                 .height = r->shallow.rows,
                                                 .format = LOM_FORMAT_RGBA32F,
                                                 .pixels = pixels,
                                                 .mips = LOM_MIPS_ALL,
                                                 .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
}

void lom_bound_shallow(const lom_renderer *r, struct lom_waves_uniform *out)
{
    const struct lom_shallow_waves *waves = &r->shallow;
    if (waves->first == NULL)
        return;
    out->lowest += (float)(waves->lowest - 0.1); /* the surface of what is dry, too */
    out->highest += LOM_SHALLOW_BOUND;
}

bool lom_place_shallow(lom_renderer *r, struct lom_waves_uniform *out, double time, lom_error *error)
{
    struct lom_shallow_waves *waves = &r->shallow;
    float bounds[2];
    if (waves->first == NULL)
        return true;
    if (!advance(r, time, error))
        return false;
    lom_shallow_view view = lom_view_shallow(waves->now);
    waves->wet = lom_fill_shallow_surface(&view, r->scene->water.level, r->scene->shallow.edge == LOM_SHALLOW_OPEN,
                                          waves->surface, waves->moments, bounds);
    const void *const pixels[2] = { waves->surface, waves->moments };
    for (int i = 0; i < 2; i++) {
        lom_release_texture(r->device, waves->map[i]);
        waves->map[i] = make_map(r, pixels[i]);
        if (waves->map[i] == NULL)
            return lom_fail(error, lom_device_error(r->device)->code, "%s", lom_device_error(r->device)->text);
    }
    out->shallow = (struct lom_shallow_uniform){ .surface = waves->map[0], .moments = waves->map[1] };
    for (int i = 0; i < 2; i++) {
        out->shallow.corner[i] = (float)waves->corner[i];
        out->shallow.scale[i] = (float)(1 / (waves->cell * (i == 0 ? waves->columns : waves->rows)));
    }
    out->lowest += bounds[0];
    out->highest += bounds[1];
    return true;
}

double lom_shallow_height(const lom_renderer *r, double x, double z)
{
    const struct lom_shallow_waves *waves = &r->shallow;
    if (waves->now == NULL)
        return 0;
    lom_shallow_view view = lom_view_shallow(waves->now);
    return lom_shallow_surface_height(&view, (const float(*)[4])waves->surface, (x - waves->corner[0]) / waves->cell,
                                      (z - waves->corner[1]) / waves->cell);
}
