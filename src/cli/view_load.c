/* Reading a scene anew. In: settings or files that have changed. Out: the scene in the place of the one before, or a
 * sentence why not. The renderer loads what differs; another one is made when a file that the scene names was written.
 * Invariant: the picture stands meanwhile, and after a failure the old scene is drawn as before; settings that no scene
 * can have are taken back. */
#include "background.h"
#include "view_menu.h"

#include <string.h>

/* What the other thread has to itself while it works. */
struct lom_view_load {
    const char *path;
    struct lom_scene_options options;
    struct lom_settings settings;
    struct lom_watched *watched; /* NULL: the scene names the files that it named before */
    lom_scene *scene;
    lom_renderer *renderer; /* the view's, which nobody else uses meanwhile; NULL: another one is to be made */
    bool is_done, is_other_format;
    lom_error error;
    struct lom_background *background;
    bool is_told; /* in the line at the bottom, when it is not done at once */
};

static void work(void *context)
{
    struct lom_view_load *load = context;
    lom_device_desc device = lom_device_of_options(&load->options);
    load->scene = lom_open_scene(load->path, &load->options, &load->error);
    load->is_other_format = load->scene != NULL && load->scene->output.format != LOM_OUTPUT_RGB8 &&
                            load->options.set.count < LOM_OPTION_LIST_MAX;
    if (load->is_other_format) {
        load->options.set.items[load->options.set.count++] = LOM_VIEW_FORMAT;
        lom_free_scene(load->scene);
        load->scene = lom_open_scene(load->path, &load->options, &load->error);
    }
    if (load->scene == NULL)
        return;
    if (load->watched != NULL)
        lom_watch_scene(load->watched, load->scene);
    if (load->renderer != NULL) {
        load->is_done = lom_change_scene(load->renderer, load->scene, NULL, &load->error);
    } else {
        load->renderer = lom_create_renderer(load->scene, &device, &load->error);
        load->is_done = load->renderer != NULL;
    }
}

static struct lom_view_load *begin(struct lom_view *view, lom_error *error)
{
    struct lom_view_load *load = lom_allocate(1, sizeof *load, error);
    if (load == NULL)
        return NULL;
    load->path = view->path;
    load->options = view->options;
    load->settings = view->settings;
    lom_list_settings(&load->settings, &load->options.set);
    view->is_file_new = view->is_file_new || view->renderer == NULL || lom_has_changed(view->watched);
    view->needs_renderer = view->needs_renderer || lom_has_named_file_changed(view->watched);
    load->watched = view->is_file_new ? view->watched : NULL;
    load->renderer = view->needs_renderer ? NULL : view->renderer;
    lom_look_at_watched(view->watched);
    load->background = lom_begin_background(work, load, error);
    if (load->background == NULL)
        lom_release(load);
    return load->background == NULL ? NULL : load;
}

/* An entity that is no longer there is followed no more. */
static void keep_within(struct lom_view *view)
{
    if (view->eye.followed > view->scene->entity_count)
        view->eye = (struct lom_eye){ .kind = LOM_EYE_SCENE };
    if (view->pilot.entity >= view->scene->entity_count)
        view->pilot = (struct lom_pilot){ .flies = false };
}

static void show_loaded(struct lom_view *view, struct lom_view_load *load)
{
    if (load->renderer != view->renderer)
        lom_free_renderer(view->renderer);
    lom_free_scene(view->scene);
    view->is_file_new = view->needs_renderer = false;
    view->renderer = load->renderer;
    view->scene = load->scene;
    view->is_other_format = load->is_other_format;
    view->good = load->settings;
    if (lom_find_setting(&load->settings, "camera") == NULL)
        view->camera = view->scene->camera;
    else
        view->camera.key_count = 0; /* they were the scene's before */
    keep_within(view);
    if (!lom_fill_menu(view->menu, view->scene, &load->error))
        lom_tell_view(view, true, "%s", load->error.text);
    else if (view->is_error)
        lom_tell_view(view, false, "%s", "");
    lom_spoil_view(view);
}

static void finish(struct lom_view *view)
{
    struct lom_view_load *load = view->load;
    view->load = NULL;
    view->is_unpainted = true;
    lom_join_background(load->background);
    if (load->is_done) {
        show_loaded(view, load);
    } else {
        lom_free_scene(load->scene);
        if (memcmp(&load->settings, &view->good, sizeof view->good) != 0)
            view->settings = view->good;
        lom_tell_view(view, true, "%s", load->error.text);
    }
    lom_release(load);
}

void lom_reload_view(struct lom_view *view)
{
    lom_error error = { .code = LOM_OK };
    if (view->load == NULL && view->has_changed) {
        view->has_changed = false;
        view->load = begin(view, &error);
        if (view->load == NULL)
            lom_tell_view(view, true, "%s", error.text);
    }
    if (view->load == NULL)
        return;
    if (lom_wait_background(view->load->background, view->host.is_patient ? 1e6 : 0.02)) {
        finish(view);
    } else if (!view->load->is_told) {
        view->load->is_told = true;
        view->is_unpainted = true;
    }
}

void lom_stop_load(struct lom_view *view)
{
    if (view->load != NULL)
        finish(view);
}
