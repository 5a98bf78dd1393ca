/* Scenes as command lines name them. In: options. Out: a scene, a device descriptor, a frame descriptor. */
#include "scene_options.h"

#include <string.h>

lom_scene *lom_open_scene(const char *path, const struct lom_scene_options *options, lom_error *error)
{
    lom_scene *scene = lom_read_scene(path, options->set.items, (size_t)options->set.count, error);
    if (scene != NULL && options->fps.given)
        scene->output.fps = options->fps.value;
    return scene;
}

lom_device_desc lom_device_of_options(const struct lom_scene_options *options)
{
    lom_device_desc desc = { .threads = 0 };
    if (options->threads.given)
        desc.threads = (int)options->threads.value[0];
    if (options->lanes != NULL && strcmp(options->lanes, "auto") != 0)
        desc.lanes = strcmp(options->lanes, "4") == 0 ? 4 : strcmp(options->lanes, "8") == 0 ? 8 : 16;
    return desc;
}

lom_frame_desc lom_frame_of_options(const struct lom_scene_options *options, int frame)
{
    lom_frame_desc desc = { .frame = frame };
    if (options->size.given) {
        desc.width = (int)options->size.value[0];
        desc.height = (int)options->size.value[1];
    }
    if (options->crop.given)
        desc.crop = (lom_rect){ (int)options->crop.value[0], (int)options->crop.value[1], (int)options->crop.value[2],
                                (int)options->crop.value[3] };
    return desc;
}
