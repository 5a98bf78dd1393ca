/* The surf of a scene as shaders look it up. In: its maps (scene/scene_water.h). Out: textures, made once; what shaders
 * need of them at a time. */
#include "render/renderer.h"

/* Half of each cell: four of its floats. */
static lom_texture *make_map(lom_renderer *r, size_t first, lom_error *error)
{
    const struct lom_surf_map *map = &r->surf;
    const size_t count = (size_t)map->width * (size_t)map->height;
    float(*texels)[4] = lom_allocate(count, sizeof *texels, error);
    if (texels == NULL)
        return NULL;
    for (size_t i = 0; i < count; i++)
        memcpy(texels[i], &map->cells[i].phase + first, sizeof texels[i]);
    lom_texture *texture = lom_make_texture(
        r->device, &(lom_texture_desc){ .width = map->width,
                                        .height = map->height,
                                        .format = LOM_FORMAT_RGBA32F,
                                        .pixels = texels,
                                        .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    lom_release(texels);
    const lom_error *failed = lom_device_error(r->device);
    if (texture == NULL)
        lom_fail(error, failed->code, "%s", failed->text);
    return texture;
}

bool lom_load_surf(lom_renderer *renderer, lom_error *error)
{
    const struct lom_bed bed = { renderer->ground.heights, renderer->ground.columns, renderer->ground.rows };
    bool done = lom_make_scene_surf(&renderer->surf, renderer->scene, &bed, error);
    if (renderer->surf.cells == NULL)
        return done;
    for (int i = 0; done && i < 2; i++) {
        renderer->surf_maps[i] = make_map(renderer, 4 * (size_t)i, error);
        done = renderer->surf_maps[i] != NULL;
    }
    return done;
}

/* No part of a wave is more than its height from the level. */
void lom_add_surf(const lom_renderer *renderer, struct lom_waves_uniform *out, double time)
{
    const lom_water_surf *surf = &renderer->scene->surf;
    if (renderer->surf.cells == NULL)
        return;
    lom_fill_surf(&out->surf, &renderer->surf, surf, time);
    out->surf.waves = renderer->surf_maps[0];
    out->surf.shapes = renderer->surf_maps[1];
    float most = (float)(renderer->surf.highest * (1 + surf->variation) * 1.0001);
    out->highest += most;
    out->lowest -= most;
}
