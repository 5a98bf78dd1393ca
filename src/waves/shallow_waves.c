/* Shallow water as shaders look it up. In: the state of its region at a time (wave_site.h). Out: the surface as
 * textures. */
#include "pipeline/check_device.h"
#include "pipeline/device.h"
#include "pipeline/renew_texture.h"
#include "waves/shallow_state.h"
#include "waves/shallow_surface.h"
#include "waves/wave_field.h"

#include <stdio.h>

struct state {
    const struct lom_wave_site *site;
    lom_device *device;
    struct lom_shallow_region region;
    float (*surface)[4], (*moments)[4]; /* of the last moment */
    lom_texture *map[2];
    int wet; /* cells */
};

static bool exists(const struct lom_wave_source *source)
{
    return source->site->shallow->present;
}

static bool load(void *memory, const struct lom_wave_source *source, lom_error *error)
{
    struct state *state = memory;
    state->site = source->site;
    state->device = source->device;
    if (!lom_open_shallow_region(&state->region, source->site, error) ||
        !lom_share_shallow(state->region.first, state->device->pool, error))
        return false;
    size_t cells = (size_t)state->region.columns * (size_t)state->region.rows;
    state->surface = lom_allocate(cells, sizeof *state->surface, error);
    state->moments = lom_allocate(cells, sizeof *state->moments, error);
    return state->surface != NULL && state->moments != NULL;
}

static void unload(void *memory)
{
    struct state *state = memory;
    for (int i = 0; i < 2; i++)
        lom_release_texture(state->device, state->map[i]);
    lom_close_shallow_region(&state->region);
    lom_release(state->surface);
    lom_release(state->moments);
}

static bool fill_map(const struct state *state, lom_texture **map, const char *label, const void *pixels)
{
    const lom_texture_desc desc = { .width = state->region.columns,
                                    .height = state->region.rows,
                                    .label = label,
                                    .format = LOM_FORMAT_RGBA32F,
                                    .pixels = pixels,
                                    .mips = LOM_MIPS_ALL,
                                    .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } };
    return lom_renew_texture(state->device, map, &desc);
}

static void bound(const void *memory, struct lom_waves_uniform *out, double time)
{
    (void)time;
    const struct state *state = memory;
    out->lowest += (float)(state->region.lowest -
                           0.1 * lom_shallow_film(state->region.cell)); /* the surface of what is dry, too */
    out->highest += LOM_SHALLOW_BOUND;
}

static bool place(void *memory, struct lom_waves_uniform *out, double time, lom_error *error)
{
    struct state *state = memory;
    const struct lom_shallow_region *region = &state->region;
    float bounds[2];
    if (!lom_advance_shallow_region(&state->region, state->site, time, error))
        return false;
    lom_shallow_view view = lom_view_shallow(region->now);
    state->wet = lom_fill_shallow_surface(&view, state->device->pool, 0, state->site->shallow->edge == LOM_SHALLOW_OPEN,
                                          region->foam, state->surface, state->moments, bounds);
    const void *const pixels[2] = { state->surface, state->moments };
    for (int i = 0; i < 2; i++)
        if (!fill_map(state, &state->map[i], i == 0 ? "shallow water" : "moments of shallow water", pixels[i]))
            return lom_check_device(state->device, error);
    out->shallow = (struct lom_shallow_uniform){ .surface = state->map[0], .moments = state->map[1] };
    for (int i = 0; i < 2; i++) {
        out->shallow.corner[i] = (float)(region->corner[i] - out->origin[2 * i]);
        out->shallow.scale[i] = (float)(1 / (region->cell * (i == 0 ? region->columns : region->rows)));
    }
    out->lowest += bounds[0];
    out->highest += bounds[1];
    return true;
}

static double height(const void *memory, const struct lom_waves_uniform *waves, double x, double z)
{
    (void)waves;
    const struct state *state = memory;
    const struct lom_shallow_region *region = &state->region;
    if (region->now == NULL)
        return 0;
    lom_shallow_view view = lom_view_shallow(region->now);
    double texel[4];
    lom_sample_shallow_surface(&view, (const float(*)[4])state->surface, (x - region->corner[0]) / region->cell,
                               (z - region->corner[1]) / region->cell, texel);
    return texel[0];
}

static uint64_t steps(const void *memory)
{
    return ((const struct state *)memory)->region.run;
}

static void report(const void *memory, const struct lom_wave_moment *moment, struct lom_wave_report *out)
{
    const struct state *state = memory;
    const struct lom_shallow_region *region = &state->region;
    out->says = true;
    out->runs = moment->known != LOM_WAVES_BOUNDED;
    if (!out->runs)
        snprintf(out->text, sizeof out->text, "%s: no step of it is run", moment->why);
    else
        snprintf(out->text, sizeof out->text,
                 "%lld steps from the beginning, %llu of them for this frame; %d of %d cells are wet",
                 (long long)lom_view_shallow(region->now).steps,
                 (unsigned long long)(region->run - moment->steps_before), state->wet, region->columns * region->rows);
}

const struct lom_wave_kind lom_shallow_waves = { .step = "shallow",
                                                 .size = sizeof(struct state),
                                                 .advances = true,
                                                 .exists = exists,
                                                 .load = load,
                                                 .free = unload,
                                                 .bound = bound,
                                                 .place = place,
                                                 .height = height,
                                                 .steps = steps,
                                                 .stage = LOM_WAVES_AT_DRAWING,
                                                 .report = report };
