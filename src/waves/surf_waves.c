/* Waves of [surf] as shaders look them up. In: a site. Out: textures of its maps, made once; what shaders need of them
 * at a time. Invariant: closed in time. */
#include "base/numbers.h"
#include "pipeline/check_device.h"
#include "waves/wave_field.h"

#include <stdio.h>
#include <string.h>

struct state {
    const struct lom_wave_site *site;
    lom_device *device;
    struct lom_surf_map map;
    lom_texture *texture[4]; /* phases, shapes, both halves of curls; NULL: none */
};

static bool exists(const struct lom_wave_source *source)
{
    return source->site->surf->height > 0;
}

/* Half of each cell, or of its curl: four floats of eight. */
static lom_texture *make_texture(lom_device *device, const struct lom_surf_map *map, int number, lom_error *error)
{
    static const char *const labels[4] = { "surf: phase", "surf: height", "surf: curl", "surf: crest" };
    const size_t count = (size_t)map->width * (size_t)map->height;
    float(*texels)[4] = lom_allocate(count, sizeof *texels, error);
    if (texels == NULL)
        return NULL;
    for (size_t i = 0; i < count; i++)
        memcpy(texels[i], (number < 2 ? &map->cells[i].phase : &map->curls[i].since) + number % 2 * 4,
               sizeof texels[i]);
    lom_texture *texture = lom_make_texture(
        device, &(lom_texture_desc){ .width = map->width,
                                     .height = map->height,
                                     .label = labels[number],
                                     .format = LOM_FORMAT_RGBA32F,
                                     .pixels = texels,
                                     .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    lom_release(texels);
    lom_check_device(device, error);
    return texture;
}

static bool load(void *memory, const struct lom_wave_source *source, lom_error *error)
{
    struct state *state = memory;
    state->site = source->site;
    state->device = source->device;
    bool done = lom_make_site_surf(&state->map, source->site, error);
    for (int i = 0; done && i < (state->map.curls != NULL ? 4 : 2); i++) {
        state->texture[i] = make_texture(source->device, &state->map, i, error);
        done = state->texture[i] != NULL;
    }
    return done;
}

static void unload(void *memory)
{
    struct state *state = memory;
    for (int i = 0; i < 4; i++)
        lom_release_texture(state->device, state->texture[i]);
    lom_free_surf_map(&state->map);
}

/* No part of a wave is more than its height from the level. */
static void bound(const void *memory, struct lom_waves_uniform *out, double time)
{
    const struct state *state = memory;
    const lom_water_surf *surf = state->site->surf;
    lom_fill_surf(&out->surf, &state->map, surf, (double[2]){ out->origin[0], out->origin[2] }, time);
    out->surf.waves = state->texture[0];
    out->surf.shapes = state->texture[1];
    out->surf.curls[0] = state->texture[2];
    out->surf.curls[1] = state->texture[3];
    const double rate = lom_two_pi / surf->period;
    out->surf.swing = state->site->foam->carried ? (float)(9.80665 / (rate * rate)) : 0;
    float most = (float)(state->map.highest * (1 + surf->variation) * 1.0001);
    out->highest += most;
    out->lowest -= most;
    if (state->map.curls != NULL) { /* a jet is thicker than the wave that it leaves, below the trough where it lands */
        out->lowest -= 0.5f * most;
        out->reach += (float)(state->map.farthest * (1 + surf->variation) * 1.0001);
    }
}

static double height(const void *memory, const struct lom_waves_uniform *waves, double x, double z)
{
    return lom_surf_height(&((const struct state *)memory)->map, &waves->surf, x, z);
}

static void report(const void *memory, const struct lom_wave_moment *moment, struct lom_wave_report *out)
{
    (void)moment;
    const struct state *state = memory;
    const struct lom_surf_map *map = &state->map;
    const lom_water_surf *surf = state->site->surf;
    out->says = out->runs = true;
    char plunging[80] = "";
    if (map->plunging_slope[1] > 0)
        snprintf(plunging, sizeof plunging, "; they plunge at Iribarren numbers of %.2f to %.2f",
                 map->plunging_slope[0], map->plunging_slope[1]);
    if (map->breaking_depth > 0)
        snprintf(out->text, sizeof out->text,
                 "waves of %g m and %g s rise to %.2f m and break from %.2f m of water on%s", surf->height,
                 surf->period, map->highest, map->breaking_depth, plunging);
    else
        snprintf(out->text, sizeof out->text, "waves of %g m and %g s rise to %.2f m; none breaks", surf->height,
                 surf->period, map->highest);
}

const struct lom_wave_kind lom_surf_waves = { .step = "surf",
                                              .size = sizeof(struct state),
                                              .exists = exists,
                                              .load = load,
                                              .free = unload,
                                              .bound = bound,
                                              .height = height,
                                              .stage = LOM_WAVES_AT_FIRST,
                                              .report = report };
