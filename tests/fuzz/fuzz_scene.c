/* Any bytes as a scene file, and its last line as an override: a scene with every number finite, or one line that says
 * what is wrong. Build with clang -fsanitize=fuzzer,address,undefined. */
#include <lom/scene.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void look(const lom_scene *scene)
{
    for (int i = -1; i < 10; i++) {
        lom_camera_view view = lom_scene_camera_at(scene, i * 0.7);
        double sum = view.position.x + view.target.y + view.up.z + view.field_of_view;
        if (!(sum - sum == 0) || !(view.field_of_view > 0))
            abort();
    }
    size_t count;
    if (lom_scene_files(scene, &count)[0] == NULL || count == 0)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    size_t split = size;
    while (split > 0 && data[split - 1] != '\n')
        split--;
    char *override = malloc(size - split + 1);
    if (override == NULL)
        return 0;
    memcpy(override, data + split, size - split);
    override[size - split] = 0;
    const char *overrides[] = { override };
    for (size_t count = 0; count < 2; count++) {
        lom_error error = { 0 };
        lom_scene *scene = lom_decode_scene((const char *)data, split, "fuzz.toml", overrides, count, &error);
        if ((scene != NULL) != (error.code == LOM_OK) || strchr(error.text, '\n') != NULL)
            abort();
        if (scene != NULL)
            look(scene);
        lom_free_scene(scene);
    }
    free(override);
    return 0;
}
