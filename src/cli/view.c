/* A scene that is looked at. In: events and time. Out: what is to be seen. Invariant: what does not change is not drawn
 * again, and what is shown at rest is the picture of `lom render`. */
#include "view.h"

#include "base/numbers.h"
#include "view_menu.h"

#include <stdarg.h>
#include <string.h>

void lom_tell_view(struct lom_view *view, bool is_error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(view->message, sizeof view->message, format, arguments);
    va_end(arguments);
    view->is_error = is_error;
    view->is_unpainted = true;
    if (is_error)
        lom_complain("%s", view->message);
}

void lom_spoil_view(struct lom_view *view)
{
    view->is_stale = true;
    view->is_exact = false;
    view->explained_x = -1;
}

/* ---- making ---- */

static void resize(struct lom_view *view, int width, int height)
{
    if (width == view->width && height == view->height)
        return;
    view->width = width;
    view->height = height;
    lom_spoil_view(view);
}

/* The first scene is waited for, whoever the host is. */
static bool read_first(struct lom_view *view, lom_error *error)
{
    bool is_patient = view->host.is_patient;
    view->host.is_patient = view->has_changed = true;
    lom_watch_file(view->watched, view->path);
    lom_reload_view(view);
    view->host.is_patient = is_patient;
    return view->renderer != NULL || lom_fail(error, LOM_ERROR_INPUT, "%s", view->message);
}

struct lom_view *lom_open_view(const char *path, const struct lom_scene_options *options,
                               const struct lom_view_host *host, lom_error *error)
{
    struct lom_view *view = lom_allocate(1, sizeof *view, error);
    if (view == NULL)
        return NULL;
    view->path = path;
    view->options = *options;
    view->host = *host;
    view->watched = lom_allocate(1, sizeof *view->watched, error);
    view->menu = view->watched != NULL ? lom_create_menu(error) : NULL;
    view->pass = view->overlay = view->explained_x = -1;
    view->divisor = 1;
    view->speed = 10;
    view->adapts = view->shows_status = true;
    if (view->menu == NULL || !read_first(view, error)) {
        lom_close_view(view);
        return NULL;
    }
    const lom_output *output = &view->scene->output;
    resize(view, options->size.given ? (int)options->size.value[0] : output->width,
           options->size.given ? (int)options->size.value[1] : output->height);
    return view;
}

void lom_close_view(struct lom_view *view)
{
    if (view == NULL)
        return;
    lom_stop_load(view);
    lom_free_renderer(view->renderer);
    lom_free_scene(view->scene);
    lom_free_menu(view->menu);
    if (view->watched != NULL)
        lom_forget_watched(view->watched);
    lom_release(view->watched);
    lom_release(view->recording.keys);
    lom_release(view->shown.pixels);
    lom_release(view->next.pixels);
    lom_release(view);
}

/* ---- events ---- */

/* Radians of a picture's height: what is under the mouse stays there, more or less. */
static double radians_of_pixels(const struct lom_view *view, int pixels)
{
    return view->eye.degrees * lom_radians_per_degree * pixels / view->height;
}

static void point(struct lom_view *view, int x, int y)
{
    enum { STILL = 4 }; /* pixels that a hand may tremble by */
    int right = x - view->x, down = y - view->y;
    view->x = x;
    view->y = y;
    if (!view->is_pressed)
        return;
    bool was_still = view->wandered <= STILL;
    view->wandered += lom_magnitude_int(right) + lom_magnitude_int(down);
    if (view->wandered <= STILL)
        return;
    if (was_still)
        lom_use_eye(view);
    double sign = view->eye.kind == LOM_EYE_THIRD ? -1 : 1; /* the world goes with the hand, or turns with it */
    lom_turn_eye(&view->eye, sign * radians_of_pixels(view, right), sign * radians_of_pixels(view, down));
    lom_spoil_view(view);
    view->is_nudged = true;
}

static void let_go(struct lom_view *view)
{
    enum { STILL = 4 };
    if (view->is_pressed && view->wandered <= STILL && view->load == NULL) {
        view->explains = true;
        view->explained_x = view->x;
        view->explained_y = view->y;
    }
    view->is_pressed = false;
}

void lom_take_view_event(struct lom_view *view, const struct lom_view_event *event)
{
    switch (event->kind) {
    case LOM_VIEW_PRESS:
        if (event->key > 0 && event->key < LOM_VIEW_KEYS) {
            lom_press_key(view, event->key);
            view->held[event->key] = true;
        }
        break;
    case LOM_VIEW_RELEASE:
        if (event->key > 0 && event->key < LOM_VIEW_KEYS)
            view->held[event->key] = false;
        break;
    case LOM_VIEW_BUTTON:
        view->is_pressed = true;
        view->wandered = 0;
        view->x = event->x;
        view->y = event->y;
        break;
    case LOM_VIEW_LET_GO:
        let_go(view);
        break;
    case LOM_VIEW_POINT:
        point(view, event->x, event->y);
        break;
    case LOM_VIEW_WHEEL:
        lom_use_eye(view);
        lom_zoom_eye(&view->eye, event->y > 0 ? 1 / 1.1 : 1.1);
        lom_spoil_view(view);
        view->is_nudged = true;
        break;
    case LOM_VIEW_RESIZE:
        resize(view, event->x, event->y);
        break;
    }
}
