/* Shallow water of a scene at a time, as shaders look it up. In: its state (scene/scene_water.h). Out: the surface as
 * textures. */
#include "render/renderer.h"
#include "waves/shallow_surface.h"

bool lom_load_shallow(lom_renderer *r, lom_error *error)
{
    struct lom_shallow_waves *waves = &r->shallow;
    const struct lom_bed bed = { r->ground.heights, r->ground.columns, r->ground.rows };
    if (!lom_open_scene_shallow(&waves->state, r->scene, &bed, error))
        return false;
    if (waves->state.first == NULL)
        return true;
    size_t cells = (size_t)waves->state.columns * (size_t)waves->state.rows;
    waves->surface = lom_allocate(cells, sizeof *waves->surface, error);
    waves->moments = lom_allocate(cells, sizeof *waves->moments, error);
    return waves->surface != NULL && waves->moments != NULL;
}

void lom_free_shallow_waves(lom_renderer *r)
{
    lom_close_scene_shallow(&r->shallow.state);
    lom_release(r->shallow.surface);
    lom_release(r->shallow.moments);
}

static lom_texture *make_map(lom_renderer *r, const void *pixels)
{
    return lom_make_texture(r->device,
                            &(lom_texture_desc){ .width = r->shallow.state.columns,
                                                 .height = r->shallow.state.rows,
                                                 .format = LOM_FORMAT_RGBA32F,
                                                 .pixels = pixels,
                                                 .mips = LOM_MIPS_ALL,
                                                 .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
}

void lom_bound_shallow(const lom_renderer *r, struct lom_waves_uniform *out)
{
    const struct lom_shallow_waves *waves = &r->shallow;
    if (waves->state.first == NULL)
        return;
    out->lowest += (float)(waves->state.lowest - 0.1); /* the surface of what is dry, too */
    out->highest += LOM_SHALLOW_BOUND;
}

bool lom_place_shallow(lom_renderer *r, struct lom_waves_uniform *out, double time, lom_error *error)
{
    struct lom_shallow_waves *waves = &r->shallow;
    float bounds[2];
    if (waves->state.first == NULL)
        return true;
    if (!lom_advance_scene_shallow(&waves->state, r->scene, time, error))
        return false;
    lom_shallow_view view = lom_view_shallow(waves->state.now);
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
        out->shallow.corner[i] = (float)waves->state.corner[i];
        out->shallow.scale[i] = (float)(1 / (waves->state.cell * (i == 0 ? waves->state.columns : waves->state.rows)));
    }
    out->lowest += bounds[0];
    out->highest += bounds[1];
    return true;
}

double lom_shallow_height(const lom_renderer *r, double x, double z)
{
    const struct lom_shallow_waves *waves = &r->shallow;
    if (waves->state.now == NULL)
        return 0;
    lom_shallow_view view = lom_view_shallow(waves->state.now);
    double texel[4];
    lom_sample_shallow_surface(&view, (const float(*)[4])waves->surface,
                               (x - waves->state.corner[0]) / waves->state.cell,
                               (z - waves->state.corner[1]) / waves->state.cell, texel);
    return texel[0];
}
