/* Making and freeing a renderer. In: a scene. Out: a device with everything that the scene names. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "render/renderer.h"
#include "sky/sky_draw.h"

#include <assert.h>

static bool load_sun(lom_renderer *renderer, lom_error *error)
{
    enum { SIZE = 256 };
    if (!renderer->scene->sky.sun)
        return true;
    lom_image *picture = lom_make_sun_picture(SIZE, renderer->scene->sky.sun_rays, error);
    if (picture != NULL)
        renderer->sun = lom_make_texture(
            renderer->device, &(lom_texture_desc){ .width = SIZE,
                                                   .height = SIZE,
                                                   .format = LOM_FORMAT_R32F,
                                                   .pixels = picture->pixels,
                                                   .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    lom_free_image(picture);
    return renderer->sun != NULL;
}

static bool load(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    if (lom_water_models[scene->quality.water].is_traced || scene->quality.clouds == LOM_CLOUDS_REFERENCE) {
        renderer->reference = lom_create_reference(scene, error);
        if (renderer->reference != NULL)
            lom_add_warnings(&renderer->warnings, lom_reference_warnings(renderer->reference));
        return renderer->reference != NULL;
    }
    const bool srgb = scene->output.transfer == LOM_TRANSFER_SRGB;
    return lom_load_sky(renderer->device, &scene->sky, srgb, &renderer->sky, error) && load_sun(renderer, error) &&
           lom_load_terrain(renderer, error) && lom_load_entities(renderer, error) && lom_load_water(renderer, error) &&
           lom_load_waves(renderer, error) && lom_load_scene_clouds(renderer, error) && lom_load_spray(renderer, error);
}

lom_renderer *lom_create_renderer(const lom_scene *scene, const lom_device_desc *desc, lom_error *error)
{
    lom_float_state state;
    lom_renderer *renderer = lom_allocate(1, sizeof *renderer, error);
    if (renderer == NULL)
        return NULL;
    lom_enter_float_state(&state);
    renderer->moment = *scene;
    renderer->scene = &renderer->moment;
    renderer->device = lom_open_device(desc);
    lom_error failed = { 0 };
    bool done = lom_check_device(renderer->device, &failed) && load(renderer, &failed);
    done = lom_check_device(renderer->device, &failed) && done;
    assert(done == (failed.code == LOM_OK)); /* as in lom_render_frame */
    lom_pass_error(&failed, error);
    lom_leave_float_state(&state);
    if (done)
        return renderer;
    lom_free_renderer(renderer);
    return NULL;
}

void lom_free_renderer(lom_renderer *renderer)
{
    if (renderer == NULL)
        return;
    for (size_t i = 0; i < renderer->entity_count; i++) {
        lom_free_mesh(renderer->entities[i].mesh);
        lom_release(renderer->entities[i].parts);
    }
    for (size_t i = 0; i < renderer->path_count; i++)
        lom_release(renderer->paths[i]);
    lom_free_reference(renderer->reference);
    lom_free_wave_field(renderer->waves);
    lom_free_polar_mesh(&renderer->polar);
    lom_free_scene_clouds(renderer);
    lom_free_spray(renderer);
    lom_free_ground(&renderer->ground);
    lom_release(renderer->entities);
    lom_release(renderer->paths);
    lom_release(renderer->textures);
    lom_close_device(renderer->device);
    lom_release(renderer);
}

const char *lom_renderer_warning(const lom_renderer *renderer)
{
    return renderer->warnings.text;
}

size_t lom_renderer_warning_count(const lom_renderer *renderer)
{
    return renderer->warnings.count;
}

const lom_device *lom_renderer_device(const lom_renderer *renderer)
{
    return renderer->device;
}
