/* Proves what failing memory does to pictures of the stages: whichever allocation fails, once or from there on, they are
 * the same pictures with the same words as without the fault, or there is an error with a sentence, and nothing leaks. */
#include "faults.h"

#include <lom/inspect.h>

enum { TRIES = 12 };

static bool picture_stages(const char *name, uint64_t *hash, lom_error *error)
{
    lom_scene *scene = lom_read_scene(small_path("scene.toml"), NULL, 0, error);
    lom_renderer *renderer =
        scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, error) : NULL;
    const lom_stages_desc desc = { .frame = { .width = 16, .height = 9 }, .pass = name };
    lom_stage_pictures *pictures = renderer != NULL ? lom_picture_stages(renderer, &desc, error) : NULL;
    bool done = pictures != NULL;
    *hash = LOM_HASH_START;
    for (size_t i = 0; done && i < pictures->count; i++) {
        uint64_t one = lom_hash_image(pictures->picture[i].image);
        *hash = lom_hash_bytes(*hash, &one, sizeof one);
        *hash = lom_hash_bytes(*hash, pictures->picture[i].text, strlen(pictures->picture[i].text));
    }
    lom_free_stage_pictures(pictures);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

static void every_failing_allocation_of_pictures_is_an_error(void)
{
    fail_memory(picture_stages, "scene", 500, 0, TRIES);
    fail_memory(picture_stages, "water", 500, 0, TRIES);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(every_failing_allocation_of_pictures_is_an_error);
    remove_small_scene();
    return check_result();
}
