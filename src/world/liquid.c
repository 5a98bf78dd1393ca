/* Liquids of a scene at a time. In: their keys, a time. Out: particles and a surface. Invariant: the state is that
 * after all steps from the start to the time. */
#include "world/liquid.h"

enum { MOST_STEPS = 1000000 };

bool lom_shows_liquid(const lom_scene *scene, size_t number)
{
    return scene->quality.fluid && scene->fluids[number].visible;
}

static double ground_under(const void *bed, double x, double z)
{
    return lom_bed_height(bed, x, z);
}

lom_fluid *lom_begin_liquid(const struct lom_world *world, size_t number, lom_error *error)
{
    const lom_fluid_params *p = &world->scene->fluids[number];
    lom_fluid_desc desc = { .spacing = p->spacing,
                            .step = p->step,
                            .viscosity = p->viscosity,
                            .solid_viscosity = p->solid_viscosity,
                            .latent_heat = p->latent_heat,
                            .conductivity = p->conductivity,
                            .blocks = p->blocks,
                            .block_count = p->block_count,
                            .solids = p->solids,
                            .solid_count = p->solid_count,
                            .ground = p->ground && world->bed.heights != NULL ? ground_under : NULL,
                            .ground_context = &world->bed };
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

void lom_free_liquid(struct lom_liquid *liquid)
{
    lom_free_fluid(liquid->fluid);
    lom_free_mesh(liquid->mesh);
    *liquid = (struct lom_liquid){ .fluid = NULL };
}

/* A thousandth of a step is rounding. */
static bool count_steps(const lom_fluid_params *p, double time, int64_t *steps, lom_error *error)
{
    const double all = time > p->start ? lom_double_floor((time - p->start) / p->step + 0.001) : 0;
    if (all > MOST_STEPS)
        return lom_fail(error, LOM_ERROR_LIMIT,
                        "This frame is more than %d steps (fluid.step) after the beginning of a "
                        "liquid (fluid.start).",
                        MOST_STEPS);
    *steps = lom_int64_of(all);
    return true;
}

static bool step(struct lom_liquid *it, const struct lom_world *world, size_t number, lom_device *device,
                 int64_t wanted, lom_error *error)
{
    if (it->fluid != NULL && lom_view_fluid(it->fluid).steps > wanted) {
        lom_free_fluid(it->fluid);
        it->fluid = NULL;
    }
    if (it->fluid == NULL)
        it->fluid = lom_begin_liquid(world, number, error);
    bool done = it->fluid != NULL;
    while (done && lom_view_fluid(it->fluid).steps < wanted) {
        done = lom_step_fluid(it->fluid, device, error);
        it->run++;
    }
    return done;
}

bool lom_run_liquid(struct lom_liquid *it, const struct lom_world *world, size_t number, lom_device *device,
                    double time, lom_error *error)
{
    const lom_fluid_params *p = &world->scene->fluids[number];
    int64_t wanted;
    if (!count_steps(p, time, &wanted, error) || !step(it, world, number, device, wanted, error))
        return false;
    if (it->mesh != NULL && it->meshed == wanted)
        return true;
    lom_free_mesh(it->mesh);
    it->mesh = lom_make_fluid_mesh(it->fluid, p->low, device, error);
    it->meshed = wanted;
    return it->mesh != NULL;
}
