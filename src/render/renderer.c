/* Making and freeing a renderer. In: a scene. Out: a device with everything that the scene names. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "reference/reference.h"
#include "render/renderer.h"
#include "water/water_models.h"

#include <assert.h>

/* In the order in which they are loaded: the bed of the water is the ground. */
static const struct room {
    bool (*load)(lom_renderer *renderer, lom_error *error);
    void (*free)(lom_renderer *renderer);
} rooms[] = {
    { lom_load_ground, lom_free_ground }, { lom_load_entities, lom_free_entities }, { lom_load_water, lom_free_water },
    { lom_load_clouds, lom_free_clouds }, { lom_load_spray, lom_free_spray },
};
static const size_t room_count = sizeof rooms / sizeof rooms[0];

static bool load(lom_renderer *renderer, const lom_scene *scene, lom_error *error)
{
    renderer->world = lom_create_world(scene, error);
    if (renderer->world == NULL || !lom_world_at(renderer->world, 0, &renderer->moment, error))
        return false;
    if (lom_water_models[scene->quality.water].is_traced || scene->quality.clouds == LOM_CLOUDS_REFERENCE) {
        renderer->reference = lom_create_reference_of(renderer->world, error);
        return renderer->reference != NULL;
    }
    if (!lom_load_sky(renderer, error))
        return false;
    for (size_t i = 0; i < room_count; i++)
        if (!rooms[i].load(renderer, error))
            return false;
    lom_release_world_files(renderer->world);
    return true;
}

lom_renderer *lom_create_renderer(const lom_scene *scene, const lom_device_desc *desc, lom_error *error)
{
    lom_float_state state;
    lom_renderer *renderer = lom_allocate(1, sizeof *renderer, error);
    if (renderer == NULL)
        return NULL;
    lom_enter_float_state(&state);
    renderer->scene = &renderer->moment.scene;
    lom_device_desc device = desc != NULL ? *desc : (lom_device_desc){ .threads = 0 };
    device.filtering = scene->quality.filtering;
    renderer->device = lom_open_device(&device);
    lom_error failed = { 0 };
    bool done = lom_check_device(renderer->device, &failed) && load(renderer, scene, &failed);
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
    lom_free_reference(renderer->reference);
    for (size_t i = 0; i < room_count; i++)
        rooms[i].free(renderer);
    lom_free_textures(renderer);
    lom_free_moment(&renderer->moment);
    lom_free_world(renderer->world);
    lom_close_device(renderer->device);
    lom_release(renderer);
}

const char *lom_renderer_warning(const lom_renderer *renderer)
{
    return renderer->world->warnings.text;
}

size_t lom_renderer_warning_count(const lom_renderer *renderer)
{
    return renderer->world->warnings.count;
}

const lom_device *lom_renderer_device(const lom_renderer *renderer)
{
    return renderer->device;
}
