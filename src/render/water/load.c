/* Water for drawing. In: the scene. Out: its maps, the pattern of its foam, its bed and its waves. */
#include "pipeline/check_device.h"
#include "render/renderer.h"
#include "scene/scene_water.h"
#include "spray/make_foam.h"
#include "water/lake.h"
#include "water/water_models.h"

#include <string.h>

/* A black texel of a flow map names no direction: its alpha is 0, so that it has no share in what is looked up. */
static void leave_out_black(lom_image *map)
{
    const size_t channel = map->format == LOM_FORMAT_RGBA16 ? 2 : 1, pixel = 4 * channel;
    static const uint8_t black[6];
    for (size_t i = 0, size = lom_image_size(map); i < size; i += pixel)
        if (memcmp(map->pixels + i, black, 3 * channel) == 0)
            memset(map->pixels + i + 3 * channel, 0, channel);
}

static lom_texture *make_flow_map(lom_renderer *renderer, const lom_image *source, lom_mips mips,
                                  lom_sampler_desc sampler, lom_error *error)
{
    const lom_format format = source->format == LOM_FORMAT_RGBA16 ? source->format : LOM_FORMAT_RGBA8;
    lom_image *map = lom_convert_image(source, format, error);
    if (map == NULL)
        return NULL;
    leave_out_black(map);
    lom_texture *texture = lom_make_texture(renderer->device, &(lom_texture_desc){ .width = map->width,
                                                                                   .height = map->height,
                                                                                   .format = format,
                                                                                   .pixels = map->pixels,
                                                                                   .label = "flow map",
                                                                                   .mips = mips,
                                                                                   .sampler = sampler });
    lom_free_image(map);
    return lom_check_device(renderer->device, error) ? texture : NULL;
}

/* The flow map that is named, or made from the normal map where the water flows; true without one. */
static bool load_flow_map(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    const lom_water_params *w = &scene->water;
    if (w->flow_map == NULL && !w->flow)
        return true;
    if (w->flow_map == NULL) {
        const lom_image *made = lom_world_made_flow(renderer->world, w->normal_map, error);
        if (made != NULL)
            renderer->water->flow_map =
                make_flow_map(renderer, made, LOM_MIPS_ALL, (lom_sampler_desc){ .anisotropy = 0 }, error);
    } else {
        const lom_image *file = lom_world_picture(renderer->world, w->flow_map, error);
        if (file != NULL)
            renderer->water->flow_map =
                make_flow_map(renderer, file, scene->quality.mipmaps ? LOM_MIPS_ALL : LOM_MIPS_NONE,
                              lom_scene_sampler(&scene->quality), error);
        lom_release_world_picture(renderer->world, w->flow_map);
    }
    return renderer->water->flow_map != NULL;
}

bool lom_load_water_maps(lom_renderer *renderer, lom_error *error)
{
    const lom_water_params *w = &renderer->scene->water;
    if (!w->present || w->normal_map == NULL)
        return true;
    if (!load_flow_map(renderer, error))
        return false;
    renderer->water->normal_map = lom_load_texture(renderer, w->normal_map, false, error);
    return renderer->water->normal_map != NULL;
}

bool lom_shows_waves(const lom_scene *scene)
{
    return scene->water.present && lom_water_models[scene->quality.water].has_waves;
}

bool lom_shows_foam(const lom_scene *scene)
{
    const lom_water_foam *foam = &scene->water.foam;
    return lom_shows_waves(scene) && (foam->amount > 0 || foam->shore_depth > 0);
}

bool lom_load_foam(lom_renderer *renderer, lom_error *error)
{
    if (!lom_shows_foam(renderer->scene))
        return true;
    lom_image *pattern = lom_make_foam(256, 1, error);
    if (pattern == NULL)
        return false;
    renderer->water->foam = lom_make_texture(renderer->device, &(lom_texture_desc){ .width = pattern->width,
                                                                                    .height = pattern->height,
                                                                                    .format = LOM_FORMAT_R8,
                                                                                    .pixels = pattern->pixels,
                                                                                    .label = "foam",
                                                                                    .mips = LOM_MIPS_ALL });
    lom_free_image(pattern);
    return lom_check_device(renderer->device, error);
}

static size_t number_of(const lom_renderer *renderer)
{
    return (size_t)(renderer->water - renderer->waters);
}

bool lom_load_waves(lom_renderer *renderer, lom_error *error)
{
    if (!lom_shows_waves(renderer->scene))
        return true;
    renderer->water->site = lom_world_wave_site(renderer->world, number_of(renderer));
    const struct lom_wave_source source = { &renderer->water->site, renderer->water->normal_map,
                                            renderer->water->flow_map, renderer->device };
    renderer->water->waves = lom_load_wave_field(&source, error);
    return renderer->water->waves != NULL;
}

bool lom_shows_caustics(const lom_scene *scene)
{
    return lom_shows_waves(scene) && scene->terrain.present && scene->water.optics.caustics > 0;
}

/* The terrain's heights as a texture, where caustics need them. */
bool lom_load_bed(lom_renderer *renderer, lom_error *error)
{
    const struct lom_bed *bed = &renderer->world->bed;
    if (!lom_shows_caustics(renderer->scene))
        return true;
    renderer->water->bed = lom_make_texture(
        renderer->device, &(lom_texture_desc){ .width = bed->columns + 1,
                                               .height = bed->rows + 1,
                                               .format = LOM_FORMAT_R32F,
                                               .pixels = bed->heights,
                                               .label = "bed",
                                               .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    return lom_check_device(renderer->device, error);
}

/* ---- freeing ---- */

void lom_free_water_maps(lom_renderer *renderer)
{
    lom_drop_texture(renderer, renderer->water->normal_map);
    lom_release_texture(renderer->device, renderer->water->flow_map);
}

void lom_free_foam(lom_renderer *renderer)
{
    lom_release_texture(renderer->device, renderer->water->foam);
}

void lom_free_bed(lom_renderer *renderer)
{
    lom_release_texture(renderer->device, renderer->water->bed);
}

void lom_free_waves(lom_renderer *renderer)
{
    lom_free_wave_field(renderer->water->waves);
    lom_free_polar_mesh(&renderer->water->polar);
    lom_free_near_blocks(&renderer->water->near);
    lom_free_far_rows(&renderer->water->far);
}

void lom_drop_caustics(lom_renderer *renderer)
{
    for (size_t i = 0; i <= LOM_MAX_OTHER_WATERS; i++) {
        struct lom_drawn_water *water = &renderer->waters[i];
        lom_release_texture(renderer->device, water->photons);
        lom_release_texture(renderer->device, water->caustics);
        lom_free_gathered_light(&water->light);
        water->photons = water->caustics = NULL;
        water->light = (struct lom_gathered_light){ .size = 0 };
    }
}

void lom_follow_water(lom_renderer *renderer)
{
    for (size_t i = 0; i <= LOM_MAX_OTHER_WATERS; i++)
        if (renderer->waters[i].waves != NULL)
            renderer->waters[i].site = lom_world_wave_site(renderer->world, i);
}
