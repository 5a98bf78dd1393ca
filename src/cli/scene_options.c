/* Scenes as command lines name them. In: options. Out: a scene, a device descriptor, a frame descriptor. */
#include "scene_options.h"

#include "paths.h"

#include <string.h>

/* Files that are something else, by their ending, and how a scene shows them. */
static const struct {
    const char *extension, *what, *how;
} no_scenes[] = {
    { "obj", "a mesh", "a scene is a .toml file, and shows it by [[entity]] with mesh = " },
    { "mtl", "a mesh's materials", "a scene is a .toml file, and shows them by a mesh that names " },
    { "nrrd", "a volume", "a scene is a .toml file, and shows it by [[cloud]] with file = " },
    { "nhdr", "a volume", "a scene is a .toml file, and shows it by [[cloud]] with file = " },
    { "png", "a picture", "`lom info` says what is in " },
    { "ppm", "a picture", "`lom info` says what is in " },
    { "pgm", "a picture", "`lom info` says what is in " },
    { "pam", "a picture", "`lom info` says what is in " },
    { "pfm", "a picture", "`lom info` says what is in " },
};

static bool check_scene_name(const char *path, lom_error *error)
{
    for (size_t i = 0; i < sizeof no_scenes / sizeof no_scenes[0]; i++)
        if (lom_path_is(path, no_scenes[i].extension))
            return lom_fail(error, LOM_ERROR_INPUT, "%s: this is %s, no scene: %s\"%s\".", path, no_scenes[i].what,
                            no_scenes[i].how, lom_path_file(path));
    return true;
}

/* The file of settings comes first, then each --set. */
static lom_scene *read_scene(const char *path, const struct lom_scene_options *options, lom_error *error)
{
    const char *changes[LOM_OPTION_LIST_MAX + 1];
    size_t count = 0;
    char *settings = NULL;
    if (options->settings != NULL) {
        settings = lom_path_print(error, "@%s", options->settings);
        if (settings == NULL)
            return NULL;
        changes[count++] = settings;
    }
    for (int i = 0; i < options->set.count; i++)
        changes[count++] = options->set.items[i];
    lom_scene *scene = lom_read_scene(path, changes, count, error);
    lom_release(settings);
    return scene;
}

lom_scene *lom_open_scene(const char *path, const struct lom_scene_options *options, lom_error *error)
{
    if (!check_scene_name(path, error))
        return NULL;
    lom_scene *scene = read_scene(path, options, error);
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
    lom_frame_desc desc = { .frame = frame, .view = options->view };
    if (options->size.given) {
        desc.width = (int)options->size.value[0];
        desc.height = (int)options->size.value[1];
    }
    desc.memory = options->memory.value;
    if (options->crop.given)
        desc.crop = (lom_rect){ (int)options->crop.value[0], (int)options->crop.value[1], (int)options->crop.value[2],
                                (int)options->crop.value[3] };
    return desc;
}

lom_frame_desc lom_small_frame_of_options(const struct lom_scene_options *options, int frame)
{
    lom_frame_desc desc = lom_frame_of_options(options, frame);
    if (!options->size.given) {
        desc.width = 320;
        desc.height = 180;
    }
    return desc;
}
