/* What moves the eye of `lom view`, and time. In: keys that are held, seconds. Out: another eye. Invariant: an entity is
 * hidden by the scene when the eye is in it, and by nothing else. */
#include "view.h"

#include "view_menu.h"

#include <string.h>

static const double seconds_between_looks = 0.25; /* at the scene's files */

/* The entity that a camera hides: 1 + its index, 0: none. */
static size_t hidden_by(const lom_camera *camera)
{
    return camera->person == LOM_PERSON_FIRST ? camera->followed : 0;
}

static const char *followed_name(const struct lom_view *view, size_t followed)
{
    return followed != 0 ? view->scene->entities[followed - 1].name : NULL;
}

/* The scene's own camera decides what is hidden, so it is the eye's where the two differ in that. */
static void set_camera(struct lom_view *view)
{
    lom_camera camera = view->camera;
    if (view->eye.kind != LOM_EYE_SCENE)
        lom_eye_camera(&view->eye, &camera);
    if (hidden_by(&camera) == hidden_by(&view->camera)) {
        view->has_changed = lom_drop_setting(&view->settings, "camera") || view->has_changed;
        return;
    }
    char text[LOM_MAX_SETTING];
    lom_print_eye(text, sizeof text, &view->eye, followed_name(view, view->eye.followed), view->scene, &camera);
    view->has_changed = lom_set_setting(&view->settings, "camera", text) || view->has_changed;
}

void lom_choose_eye(struct lom_view *view, enum lom_eye_kind kind, size_t followed)
{
    if (view->recording.runs) /* its places are in the coordinates of one eye */
        lom_toggle_recording(view);
    if (kind == LOM_EYE_SCENE) {
        view->eye = (struct lom_eye){ .kind = kind };
    } else {
        lom_camera_view seen = lom_eye_view(&view->eye, view->scene, view->time);
        view->eye = lom_make_eye(kind, followed, view->scene, &view->camera, &seen, view->time);
    }
    set_camera(view);
    lom_spoil_view(view);
}

void lom_use_eye(struct lom_view *view)
{
    if (view->eye.kind != LOM_EYE_SCENE)
        return;
    enum lom_eye_kind person = view->camera.person == LOM_PERSON_FIRST ? LOM_EYE_FIRST : LOM_EYE_THIRD;
    size_t followed = view->camera.followed;
    lom_choose_eye(view, followed != 0 ? person : LOM_EYE_FREE, followed);
}

/* The first entity from index `from` on, around to it again, that has a name, which a setting can hold as it is, and,
 * with `moving`, key frames. 1 + its index; 0: none. */
static size_t find_entity(const lom_scene *scene, size_t from, bool moving)
{
    for (size_t i = 0; i < scene->entity_count; i++) {
        size_t at = (from + i) % scene->entity_count;
        const char *name = scene->entities[at].name;
        if (name != NULL && strpbrk(name, "\"\\") == NULL && (!moving || scene->entities[at].key_count != 0))
            return at + 1;
    }
    return 0;
}

static size_t entity_to_follow(const struct lom_view *view)
{
    if (view->eye.followed != 0)
        return view->eye.followed;
    if (view->pilot.flies)
        return view->pilot.entity + 1;
    if (view->camera.followed != 0)
        return view->camera.followed;
    size_t moving = find_entity(view->scene, 0, true);
    return moving != 0 ? moving : find_entity(view->scene, 0, false);
}

void lom_next_eye(struct lom_view *view)
{
    size_t followed = entity_to_follow(view);
    enum lom_eye_kind next = (view->eye.kind + 1) % LOM_EYE_KINDS;
    if (next > LOM_EYE_FREE && followed == 0)
        next = LOM_EYE_SCENE;
    lom_choose_eye(view, next, next > LOM_EYE_FREE ? followed : 0);
}

void lom_next_entity(struct lom_view *view)
{
    size_t from = view->eye.followed != 0 ? view->eye.followed : 0;
    size_t next = find_entity(view->scene, from, false);
    if (next == 0) {
        lom_tell_view(view, true, "no entity of this scene has a name to be followed by.");
        return;
    }
    lom_choose_eye(view, view->eye.kind == LOM_EYE_FIRST ? LOM_EYE_FIRST : LOM_EYE_THIRD, next);
}

double lom_pull_of_keys(const struct lom_view *view, int more, int less)
{
    return (view->held[more] ? 1.0 : 0.0) - (view->held[less] ? 1.0 : 0.0);
}

static void fly(struct lom_view *view, double seconds)
{
    double ahead = lom_pull_of_keys(view, 'w', 's'), right = lom_pull_of_keys(view, 'd', 'a'),
           above = lom_pull_of_keys(view, 'e', 'q');
    if (ahead == 0 && right == 0 && above == 0)
        return;
    lom_use_eye(view);
    double metres = seconds * view->speed * (view->held[LOM_VIEW_SHIFT] ? 5 : 1);
    lom_move_eye(&view->eye, ahead * metres, right * metres, above * metres);
    view->moves = true;
}

static void look_at_files(struct lom_view *view, double seconds)
{
    view->since_look += seconds;
    if (view->load != NULL || view->since_look < seconds_between_looks)
        return;
    view->since_look = 0;
    view->has_changed = lom_has_changed(view->watched) || view->has_changed;
}

void lom_step_view(struct lom_view *view, double seconds)
{
    view->moves = view->is_nudged;
    view->is_nudged = false;
    fly(view, seconds);
    if (view->runs) {
        view->time += seconds;
        view->moves = true;
    }
    lom_step_pilot(view, seconds);
    lom_step_sun(view, seconds);
    if (view->moves)
        lom_spoil_view(view);
    lom_step_recording(view, seconds);
    look_at_files(view, seconds);
    lom_reload_view(view);
}
