/* Liquids of a scene at a time. In: their keys, a time. Out: particles and a surface. Invariant: the state is that
 * after all steps from the start to the time. */
#include "render/fluid/advance.h"
#include "render/renderer.h"

enum { MOST_STEPS = 1000000 };

size_t lom_count_fluids(const lom_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; scene->quality.fluid && i < scene->fluid_count; i++)
        count += scene->fluids[i].visible;
    return count;
}

static lom_fluid *begin(const lom_fluid_params *p, lom_error *error)
{
    lom_fluid_desc desc = { .spacing = p->spacing,
                            .step = p->step,
                            .viscosity = p->viscosity,
                            .solid_viscosity = p->solid_viscosity,
                            .latent_heat = p->latent_heat,
                            .conductivity = p->conductivity,
                            .blocks = p->blocks,
                            .block_count = p->block_count,
                            .solids = p->solids,
                            .solid_count = p->solid_count };
    for (int i = 0; i < 3; i++) {
        desc.low[i] = p->low[i];
        desc.high[i] = p->high[i];
        desc.gravity[i] = p->gravity[i];
    }
    for (int i = 0; i < 2; i++)
        desc.melting[i] = p->melting[i];
    lom_error failed = { 0 };
    lom_fluid *fluid = lom_create_fluid(&desc, &failed);
    if (fluid == NULL)
        lom_fail(error, failed.code, "[[fluid]]%s%s: %s", p->name != NULL ? " " : "", p->name != NULL ? p->name : "",
                 failed.text);
    return fluid;
}

bool lom_load_fluids(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    struct lom_drawn_fluids *m = &renderer->fluids;
    m->items = lom_allocate(scene->fluid_count, sizeof *m->items, error);
    m->count = m->items != NULL ? scene->fluid_count : 0;
    for (size_t i = 0; i < m->count; i++)
        if (scene->fluids[i].visible && (m->items[i].fluid = begin(&scene->fluids[i], error)) == NULL)
            return false;
    return m->items != NULL;
}

void lom_free_fluids(lom_renderer *renderer)
{
    struct lom_drawn_fluids *m = &renderer->fluids;
    for (size_t i = 0; i < m->count; i++) {
        lom_free_fluid(m->items[i].fluid);
        lom_free_mesh(m->items[i].mesh);
    }
    lom_release(m->items);
}

/* A thousandth of a step is rounding. */
static bool run(struct lom_drawn_fluids *all, struct lom_drawn_fluid *it, const lom_fluid_params *p, lom_device *device,
                double time, lom_error *error)
{
    const double steps = time > p->start ? lom_double_floor((time - p->start) / p->step + 0.001) : 0;
    if (steps > MOST_STEPS)
        return lom_fail(error, LOM_ERROR_LIMIT,
                        "This frame is more than %d steps (fluid.step) after the beginning of a "
                        "liquid (fluid.start).",
                        MOST_STEPS);
    const int64_t wanted = lom_int64_of(steps);
    if (lom_view_fluid(it->fluid).steps > wanted) {
        lom_free_fluid(it->fluid);
        it->fluid = begin(p, error);
    }
    bool done = it->fluid != NULL;
    while (done && lom_view_fluid(it->fluid).steps < wanted) {
        done = lom_step_fluid(it->fluid, device, error);
        all->run++;
    }
    return done;
}

bool lom_advance_fluid(struct frame *f, size_t number, lom_error *error)
{
    lom_renderer *r = f->renderer;
    const lom_fluid_params *p = &f->scene->fluids[number];
    struct lom_drawn_fluid *it = &r->fluids.items[number];
    if (it->fluid == NULL && (it->fluid = begin(p, error)) == NULL)
        return false;
    if (!run(&r->fluids, it, p, r->device, f->time, error))
        return false;
    const int64_t steps = lom_view_fluid(it->fluid).steps;
    if (it->mesh != NULL && it->meshed == steps)
        return true;
    lom_free_mesh(it->mesh);
    it->mesh = lom_make_fluid_mesh(it->fluid, p->low, r->device, error);
    it->meshed = steps;
    return it->mesh != NULL;
}
