/* Waves of kind "flow": the ripples of a river, carried by a field of velocities that follows from the bed and the
 * level. In: a site, a time. Out: the field as a texture, and the phases of the ripples. Invariant: closed in time. */
#include "pipeline/check_device.h"
#include "waves/river.h"
#include "waves/wave_field.h"

#include <string.h>

enum { CELLS = LOM_RIVER_CELLS };

struct state {
    const struct lom_wave_site *site;
    lom_device *device;
    const lom_texture *ripples;
    lom_texture *field;
};

static bool exists(const struct lom_wave_source *source)
{
    return source->site->waves->kind == LOM_WAVES_FLOW && source->ripples != NULL;
}

/* The level less the terrain's vertices. */
void lom_find_river_depths(const struct lom_wave_site *site, double *depth)
{
    const struct lom_bed *bed = &site->bed;
    for (int y = 0; y < CELLS; y++)
        for (int x = 0; x < CELLS; x++) {
            size_t column = (size_t)(x * bed->columns / (CELLS - 1)), row = (size_t)(y * bed->rows / (CELLS - 1));
            size_t vertex = row * ((size_t)bed->columns + 1) + column;
            depth[y * CELLS + x] = bed->heights != NULL ? site->level - bed->base - (double)bed->heights[vertex] : 1;
        }
}

/* Velocities, and the foam that goes with them. */
static lom_image *add_foam(const lom_image *field, const double *depth, const struct lom_wave_site *site,
                           lom_error *error)
{
    const double *size = site->bed.heights != NULL ? site->bed.size : site->size;
    const struct lom_river_foam_desc desc = { .depth = depth,
                                              .speed = site->waves->speed,
                                              .cell = { size[0] / (CELLS - 1), size[1] / (CELLS - 1) },
                                              .window = site->foam->window };
    lom_image *out = lom_create_image(CELLS, CELLS, 1, LOM_FORMAT_RGBA32F, error);
    float *foam = out != NULL ? lom_allocate((size_t)CELLS * CELLS, sizeof *foam, error) : NULL;
    if (foam != NULL)
        lom_carry_river_foam(foam, field, &desc);
    for (int i = 0; foam != NULL && i < CELLS * CELLS; i++) {
        const float *v = lom_image_pixel((lom_image *)field, i % CELLS, i / CELLS, 0);
        memcpy(lom_image_pixel(out, i % CELLS, i / CELLS, 0), (float[4]){ v[0], v[1], foam[i], 0 }, 4 * sizeof *v);
    }
    if (foam == NULL) {
        lom_free_image(out);
        out = NULL;
    }
    lom_release(foam);
    return out;
}

static bool carries_foam(const struct lom_wave_site *site)
{
    return site->foam->carried && site->foam->amount > 0 && site->waves->speed > 0;
}

static bool load(void *memory, const struct lom_wave_source *source, lom_error *error)
{
    struct state *state = memory;
    *state = (struct state){ source->site, source->device, source->ripples, NULL };
    double *depth = lom_allocate((size_t)CELLS * CELLS, sizeof *depth, error);
    if (depth == NULL)
        return false;
    lom_find_river_depths(state->site, depth);
    lom_image *field = lom_make_river(depth, CELLS, state->site->waves->direction, error);
    if (field != NULL && carries_foam(state->site)) {
        lom_image *with = add_foam(field, depth, state->site, error);
        lom_free_image(field);
        field = with;
    }
    lom_release(depth);
    if (field == NULL)
        return false;
    state->field = lom_make_texture(
        source->device, &(lom_texture_desc){ .width = CELLS,
                                             .height = CELLS,
                                             .label = "flow of the river",
                                             .format = field->format,
                                             .pixels = field->pixels,
                                             .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    lom_free_image(field);
    return lom_check_device(source->device, error);
}

static void unload(void *memory)
{
    const struct state *state = memory;
    lom_release_texture(state->device, state->field);
}

void lom_fill_river_phases(struct lom_river_uniform *river, double speed, double tile, const double origin[2],
                           double time)
{
    double period = speed > 0 ? tile / (3 * speed) : 1, weight[2];
    for (int i = 0; i < 2; i++) {
        double cycles = time / period + 0.5 * i, whole = lom_double_floor(cycles), share = cycles - whole;
        double jump[2] = { 0.381966 * whole + 0.5 * i + origin[0] / tile, 0.618034 * whole + origin[1] / tile };
        weight[i] = share < 0.5 ? 2 * share : 2 - 2 * share;
        river->drift[i] = (float)(speed * period * (share - 0.5));
        for (int k = 0; k < 2; k++)
            river->jump[i][k] = (float)(jump[k] - lom_double_floor(jump[k]));
    }
    double norm = lom_double_sqrt(weight[0] * weight[0] + weight[1] * weight[1]);
    river->weight[0] = (float)(weight[0] / norm);
    river->weight[1] = (float)(weight[1] / norm);
}

/* The pattern of the foam drifts as ripples do, by repetitions of its own, counted from where its coordinates are. */
static void set_foam(struct lom_river_uniform *river, const struct lom_wave_site *site, double time)
{
    struct lom_river_uniform pattern = { .field = NULL };
    lom_fill_river_phases(&pattern, site->waves->speed, site->foam->tile, (double[2]){ 0, 0 }, time);
    river->carries_foam = true;
    river->foam_share = pattern.weight[1] / (pattern.weight[0] + pattern.weight[1]);
    for (int i = 0; i < 2; i++) {
        river->foam_drift[i] = pattern.drift[i];
        for (int k = 0; k < 2; k++)
            river->foam_jump[i][k] = (float)(-(double)pattern.jump[i][k] * site->foam->tile);
    }
}

static void bound(const void *memory, struct lom_waves_uniform *out, double time)
{
    const struct state *state = memory;
    const struct lom_wave_site *site = state->site;
    struct lom_river_uniform *river = &out->river;
    river->field = state->field;
    river->ripples = state->ripples;
    river->inverse_tile = (float)(1 / site->tile);
    river->steepness = (float)(1 / site->ripple_up);
    const bool has_bed = site->bed.heights != NULL;
    const double at[2] = { out->origin[0], out->origin[2] }, *size = has_bed ? site->bed.size : site->size;
    double from_middle[2];        /* of the water */
    for (int i = 0; i < 2; i++) { /* the grid's corners are the middles of its texels */
        double step = size[i] / (CELLS - 1);
        from_middle[i] = at[i] - site->middle[i];
        river->corner[i] = (float)(-size[i] / 2 - step / 2 - (has_bed ? at[i] : from_middle[i]));
        river->scale[i] = (float)(1 / (step * CELLS));
    }
    lom_fill_river_phases(river, site->waves->speed, site->tile, from_middle, time);
    if (carries_foam(site))
        set_foam(river, site, time);
}

const struct lom_wave_kind lom_river_waves = {
    .size = sizeof(struct state), .exists = exists, .load = load, .free = unload, .bound = bound
};
