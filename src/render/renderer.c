/* Making and freeing a renderer. In: a scene. Out: a device with everything that the scene names. */
#include "base/pass_error.h"
#include "pipeline/check_device.h"
#include "pipeline/share_work.h"
#include "reference/reference.h"
#include "render/rooms.h"
#include "water/water_models.h"

#include <assert.h>

bool lom_is_traced(const lom_scene *scene)
{
    return lom_water_models[scene->quality.water].is_traced || scene->quality.clouds == LOM_CLOUDS_REFERENCE;
}

bool lom_load_renderer(lom_renderer *renderer, unsigned parts, lom_error *error)
{
    if (renderer->world == NULL || !lom_world_at(renderer->world, 0, &renderer->moment, error))
        return false;
    if (lom_is_traced(renderer->world->scene)) {
        renderer->reference = lom_create_reference_of(renderer->world, error);
        return renderer->reference != NULL;
    }
    if (!lom_load_rooms(renderer, parts, error))
        return false;
    lom_release_world_files(renderer->world);
    return true;
}

/* The files are read by all workers, before any of them is asked for. */
static bool load(lom_renderer *renderer, const lom_scene *scene, lom_error *error)
{
    struct lom_files files = { .count = 0 };
    bool done = lom_list_files(&files, scene, error);
    if (done) {
        lom_share_work(renderer->device, files.count, 1, lom_read_files, &files);
        renderer->world = lom_create_world(scene, &files, error);
        done = lom_load_renderer(renderer, LOM_PARTS_ALL, error);
    }
    if (renderer->world != NULL)
        renderer->world->files = NULL;
    lom_free_files(&files);
    return done;
}

lom_renderer *lom_create_renderer(const lom_scene *scene, const lom_device_desc *desc, lom_error *error)
{
    lom_float_state state;
    lom_renderer *renderer = lom_allocate(1, sizeof *renderer, error);
    if (renderer == NULL)
        return NULL;
    lom_enter_float_state(&state);
    renderer->scene = &renderer->moment.scene;
    renderer->water = renderer->waters;
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
    lom_drop_made(renderer, LOM_PARTS_ALL);
    lom_free_rooms(renderer, LOM_PARTS_ALL);
    lom_free_textures(renderer);
    lom_free_lamps(&renderer->lamps);
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
