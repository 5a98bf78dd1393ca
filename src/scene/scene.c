/* A scene from its file: read, parse, override, fill by the tables, check. In: a path or text, overrides. Out: a
 * lom_scene that owns all it points to. Invariant: a scene that is returned is valid; the rest is released. */
#include "scene/reader.h"
#include "scene/scene_keys.h"

#include <string.h>

static const char standard_input[] = "standard input";

/* The folder of path with its last slash; "" when path names none. */
static const char *folder_of(lom_arena *arena, const char *path, lom_error *error)
{
    const char *slash = strrchr(path, '/');
    return lom_arena_text(arena, path, slash == NULL ? 0 : (size_t)(slash - path) + 1, error);
}

static bool fill(lom_reader *reader, const lom_toml_source *source, const char *const *overrides, size_t override_count)
{
    lom_toml_value *root = lom_toml_parse(reader->tree, source, reader->error);
    if (root == NULL)
        return false;
    reader->root = root;
    for (size_t i = 0; i < override_count; i++)
        if (!lom_apply_override(reader, root, overrides[i]))
            return false;
    return lom_read_table(reader, &lom_scene_keys, root, reader->scene) && lom_check_scene(reader, root);
}

static lom_scene *new_scene(const char *path, lom_error *error)
{
    lom_scene *scene = lom_allocate(1, sizeof *scene, error);
    if (scene == NULL)
        return NULL;
    scene->memory = lom_allocate(1, sizeof *scene->memory, error);
    if (scene->memory != NULL)
        scene->path = lom_arena_text(&scene->memory->arena, path, strlen(path), error);
    if (scene->path == NULL || (strcmp(path, "-") != 0 && !lom_add_scene_file(scene, scene->path, error))) {
        lom_free_scene(scene);
        return NULL;
    }
    return scene;
}

lom_scene *lom_decode_scene(const char *text, size_t size, const char *path, const char *const *overrides,
                            size_t override_count, lom_error *error)
{
    lom_scene *scene = new_scene(path, error);
    if (scene == NULL)
        return NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_arena tree = { 0 };
    lom_reader reader = { .tree = &tree, .scene = scene, .folder = folder_of(&tree, path, error), .error = error };
    const char *name = strcmp(path, "-") == 0 ? standard_input : path;
    lom_toml_source source = { .name = name, .text = text, .size = size };
    bool good = reader.folder != NULL && fill(&reader, &source, overrides, override_count);
    lom_arena_release(&tree);
    lom_leave_float_state(&state);
    if (good)
        return scene;
    lom_free_scene(scene);
    return NULL;
}

lom_scene *lom_read_scene(const char *path, const char *const *overrides, size_t override_count, lom_error *error)
{
    lom_bytes bytes = lom_read_file(path, LOM_TOML_MAX_SIZE, error);
    if (bytes.data == NULL)
        return NULL;
    lom_scene *scene = lom_decode_scene((const char *)bytes.data, bytes.size, path, overrides, override_count, error);
    lom_release(bytes.data);
    return scene;
}

void lom_free_scene(lom_scene *scene)
{
    if (scene == NULL)
        return;
    if (scene->memory != NULL)
        lom_arena_release(&scene->memory->arena);
    lom_release(scene->memory);
    lom_release(scene);
}

const char *const *lom_scene_files(const lom_scene *scene, size_t *count)
{
    *count = scene->memory->file_count;
    return scene->memory->files;
}
