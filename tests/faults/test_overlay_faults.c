/* Proves what failing memory does to an overlay: whichever of its own allocations fails, once or from there on, it is the
 * same picture as without the fault, or there is an error with a sentence; nothing is given then, and nothing leaks. */
#include "faults.h"

#include <lom/inspect.h>

/* What comes before the overlay does not fail. */
static lom_renderer *prepare(lom_scene **scene)
{
    fault_kind kind = fault.kind;
    lom_frame frame = { .image = NULL };
    fault.kind = NOTHING;
    *scene = lom_read_scene(small_path("scene.toml"), NULL, 0, NULL);
    lom_renderer *renderer = lom_create_renderer(*scene, &(lom_device_desc){ .threads = 1 }, NULL);
    CHECK(lom_render_frame(renderer, &(lom_frame_desc){ .width = 32, .height = 18 }, &frame, NULL));
    lom_free_image(frame.image);
    fault.kind = kind;
    return renderer;
}

static bool draw_overlay(const char *name, uint64_t *hash, lom_error *error)
{
    lom_scene *scene;
    lom_renderer *renderer = prepare(&scene);
    lom_overlay overlay;
    const lom_overlay_desc desc = { .frame = { .width = 32, .height = 18 }, .kind = lom_find_overlay(name, NULL) };
    bool done = lom_draw_overlay(renderer, &desc, &overlay, error);
    CHECK(done ? overlay.shown != NULL
               : overlay.shown == NULL && overlay.numbers == NULL && overlay.frame.image == NULL);
    *hash = done ? lom_hash_image(overlay.shown) : 0;
    lom_free_overlay(&overlay);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

static void every_failing_allocation_of_overlays_is_an_error(void)
{
    fail_memory(draw_overlay, "overdraw", 6, 0, 0);
    fail_memory(draw_overlay, "normals", 8, 0, 0);
    fail_memory(draw_overlay, "tile-work", 9, 0, 0);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(every_failing_allocation_of_overlays_is_an_error);
    remove_small_scene();
    return check_result();
}
