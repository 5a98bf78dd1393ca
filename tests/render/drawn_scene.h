/* The picture of a scene that a test holds as text. */
#ifndef LOM_TESTS_DRAWN_SCENE_H
#define LOM_TESTS_DRAWN_SCENE_H

#include "check.h"
#include "small_scene.h"

#include <lom/lom.h>

#include <string.h>

/* Drawn on one thread, with overrides like "quality.entity_shadows=64"; lanes 0: the widest; all of the frame with an
 * empty crop. Fails the test, and is NULL, where it is not drawn. The caller frees it. plan may be NULL. */
static inline lom_image *draw(const char *text, const char *const *set, size_t sets, int lanes, lom_rect crop,
                              lom_plan *plan)
{
    lom_error error = { 0 };
    lom_frame drawn = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), set, sets, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1, .lanes = lanes }, &error);
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ .crop = crop }, &drawn, &error);
    CHECK(done, "%s", error.text);
    if (plan != NULL)
        *plan = drawn.plan;
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done ? drawn.image : NULL;
}

#endif
