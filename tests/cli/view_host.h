/* A host of `lom view` for tests: it waits for what is read, has no clock, and says when events wait. */
#ifndef LOM_TESTS_VIEW_HOST_H
#define LOM_TESTS_VIEW_HOST_H

#include "check.h"
#include "cli/view_menu.h"
#include "small_scene.h"

static const double turn = 1.0 / 60;
static struct lom_scene_options options;
static bool waits_for_me; /* whether events wait */

static inline bool interrupts(void *context)
{
    (void)context;
    return waits_for_me;
}

static inline struct lom_view *open_view(lom_pixel_order order)
{
    lom_error error = { .code = LOM_OK };
    struct lom_view_host host = { .order = order, .is_patient = true, .interrupts = interrupts };
    static char path[400];
    waits_for_me = false;
    snprintf(path, sizeof path, "%s", small_path("scene.toml"));
    struct lom_view *view = lom_open_view(path, &options, &host, &error);
    CHECK(view != NULL, "%s", error.text);
    return view;
}

static inline void send(struct lom_view *view, enum lom_view_event_kind kind, int key, int x, int y)
{
    lom_take_view_event(view, &(struct lom_view_event){ kind, key, x, y });
}

static inline void tap(struct lom_view *view, int key)
{
    send(view, LOM_VIEW_PRESS, key, 0, 0);
    send(view, LOM_VIEW_RELEASE, key, 0, 0);
}

static inline void go_on(struct lom_view *view, int turns)
{
    for (int i = 0; i < turns; i++) {
        lom_step_view(view, turn);
        lom_draw_view(view);
    }
}

static inline uint64_t hash_of(const struct lom_view *view)
{
    lom_error error = { .code = LOM_OK };
    lom_image *image = lom_view_image(view, &error);
    uint64_t hash = image != NULL ? lom_hash_image(image) : 0;
    CHECK(image != NULL, "%s", error.text);
    lom_free_image(image);
    return hash;
}

/* What a new renderer draws of the view's scene, eye and time. */
static inline uint64_t drawn_afresh(const struct lom_view *view)
{
    lom_error error = { .code = LOM_OK };
    lom_camera_view camera;
    lom_frame frame = { .image = NULL };
    lom_frame_desc desc = lom_view_frame(view, 1, &camera);
    lom_renderer *renderer = lom_create_renderer(view->scene, NULL, &error);
    bool done = renderer != NULL && lom_render_frame(renderer, &desc, &frame, &error);
    uint64_t hash = done ? lom_hash_image(frame.image) : 0;
    CHECK(done, "%s", error.text);
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    return hash;
}

#endif
