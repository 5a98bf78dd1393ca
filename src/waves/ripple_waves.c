/* Ripples of the normal map on water that has no waves: those of the planar lake (water/lake.wide.c), as slopes without
 * height. In: a site, a time. Out: the maps and where they have drifted to. Invariant: closed in time. */
#include "waves/wave_field.h"

struct state {
    const struct lom_wave_site *site;
    const lom_texture *normals, *flow;
};

static bool exists(const struct lom_wave_source *source)
{
    return source->site->waves->kind == LOM_WAVES_NONE && source->ripples != NULL;
}

static bool load(void *memory, const struct lom_wave_source *source, lom_error *error)
{
    (void)error;
    *(struct state *)memory = (struct state){ source->site, source->ripples, source->flow };
    return true;
}

static float part_of(double x)
{
    return (float)(x - lom_double_floor(x));
}

static void bound(const void *memory, struct lom_waves_uniform *out, double time)
{
    const struct state *state = memory;
    const struct lom_wave_site *site = state->site;
    const double at[2] = { out->origin[0], out->origin[2] };
    struct lom_ripple_uniform *ripples = &out->ripples;
    ripples->normals = site->is_rippled ? state->normals : NULL;
    ripples->flow = state->flow;
    ripples->inverse_tile = (float)(1 / site->tile);
    ripples->steepness = (float)(1 / site->ripple_up);
    ripples->move = part_of(time * site->ripple_speed);
    for (int i = 0; i < 2; i++)
        ripples->shift[i] = part_of((at[i] - site->middle[i]) / site->tile);
}

const struct lom_wave_kind lom_ripple_waves = {
    .size = sizeof(struct state), .exists = exists, .load = load, .bound = bound
};
