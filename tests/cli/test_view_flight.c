/* Proves what moves in `lom view`: arrows steer an aircraft and nothing else is touched; persons follow it; a drag goes with
 * the hand; plates of clouds are made anew at rest; paths are recorded in the coordinates of what is followed; the sun is
 * moved and stopped; pictures of any shape and windows of any size are painted. */
#include "cli/view_host.h"

/* With a box that moves, followed by the camera in the first person or not. */
static struct lom_view *open_moving(bool first_person)
{
    lom_error error = { .code = LOM_OK };
    static char text[4096];
    snprintf(text, sizeof text,
             "%s[[entity.key]]\ntime = 0\nposition = [0, 2, 2]\n[[entity.key]]\ntime = 1\nposition = [0, 2, -38]\n"
             "[[entity]]\nname = \"other\"\nmesh = \"box.obj\"\nposition = [3, 1, 1]\n",
             small_scene);
    char *at = strstr(text, "target = [0, 1, 0]\n");
    if (first_person && at != NULL) {
        static const char *const with = "follow = \"box\"\nperson = \"first\"\n";
        at += strlen("target = [0, 1, 0]\n");
        memmove(at + strlen(with), at, strlen(at) + 1);
        memcpy(at, with, strlen(with));
    }
    CHECK(at != NULL && small_text("scene.toml", text, &error), "%s", error.text);
    return open_view(LOM_ORDER_RGBX);
}

static void arrows_steer_the_aircraft(void)
{
    struct lom_view *view = open_moving(false);
    go_on(view, 1);
    uint64_t first = hash_of(view);
    send(view, LOM_VIEW_PRESS, LOM_VIEW_RIGHT, 0, 0);
    go_on(view, 20);
    send(view, LOM_VIEW_RELEASE, LOM_VIEW_RIGHT, 0, 0);
    lom_entity_place place = lom_scene_entity_at(&view->scene->entities[0], view->time);
    CHECK(view->runs && view->pilot.speed > 39.9 && view->pilot.speed < 40.1, "%g m/s", view->pilot.speed);
    CHECK(place.position.x > 0.05 && place.position.z < -8 && place.rotation.z < -0.2, "at %g %g, banked by %g",
          place.position.x, place.position.z, place.rotation.z);
    CHECK(hash_of(view) == drawn_afresh(view) && hash_of(view) != first, "it is not drawn there");
    tap(view, LOM_VIEW_SPACE);
    go_on(view, 3);
    int pictures = view->pictures;
    go_on(view, 10);
    CHECK(view->pictures == pictures, "it flies while time stands");
    send(view, LOM_VIEW_PRESS, LOM_VIEW_PAGE_UP, 0, 0);
    send(view, LOM_VIEW_PRESS, LOM_VIEW_UP, 0, 0);
    go_on(view, 10);
    CHECK(view->pilot.speed > 45 && view->pilot.pitch > 0.02, "%g m/s, %g", view->pilot.speed, view->pilot.pitch);
    send(view, LOM_VIEW_RELEASE, LOM_VIEW_PAGE_UP, 0, 0);
    send(view, LOM_VIEW_RELEASE, LOM_VIEW_UP, 0, 0);
    tap(view, LOM_VIEW_SPACE);
    tap(view, LOM_VIEW_BACKSPACE);
    tap(view, '0');
    go_on(view, 3);
    CHECK(hash_of(view) == first && view->settings.count == 0 && !view->pilot.flies, "not as the file has it");
    lom_close_view(view);
}

static void nothing_to_steer_is_said(void)
{
    lom_error error = { .code = LOM_OK };
    CHECK(small_text("scene.toml", small_scene, &error), "%s", error.text);
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    send(view, LOM_VIEW_PRESS, LOM_VIEW_LEFT, 0, 0);
    go_on(view, 3);
    CHECK(view->is_error && strstr(view->message, "no aircraft") != NULL && view->pictures == 1 && !view->runs, "%s",
          view->message);
    tap(view, 'n'); /* what is followed can be steered */
    send(view, LOM_VIEW_PRESS, LOM_VIEW_LEFT, 0, 0);
    go_on(view, 3);
    CHECK(view->pilot.flies && view->runs, "%s", view->message);
    lom_close_view(view);
}

/* Scene's, free, third, first person: each at rest a renderer's picture; in the first the entity is hidden. */
static void persons_follow_in_turn(void)
{
    for (int first_person = 0; first_person < 2; first_person++) {
        struct lom_view *view = open_moving(first_person != 0);
        go_on(view, 1);
        uint64_t first = hash_of(view);
        for (int kind = LOM_EYE_FREE; kind <= LOM_EYE_KINDS; kind++) {
            tap(view, 'c');
            go_on(view, 3);
            bool hides = view->scene->camera.followed != 0 && view->scene->camera.person == LOM_PERSON_FIRST;
            CHECK((int)view->eye.kind == kind % LOM_EYE_KINDS, "eye %d instead of %d", (int)view->eye.kind, kind);
            CHECK(hides == (view->eye.kind == LOM_EYE_FIRST || (kind == LOM_EYE_KINDS && first_person)), "eye %d",
                  kind);
            CHECK(view->is_exact && hash_of(view) == drawn_afresh(view), "eye %d", kind);
        }
        CHECK(hash_of(view) == first && view->settings.count == 0, "not the scene's camera again");
        send(view, LOM_VIEW_PRESS, 'w', 0, 0);
        go_on(view, 5);
        send(view, LOM_VIEW_RELEASE, 'w', 0, 0);
        CHECK(view->eye.kind == (first_person ? LOM_EYE_FIRST : LOM_EYE_FREE), "moved as %d", (int)view->eye.kind);
        tap(view, 'n');
        go_on(view, 3);
        tap(view, 'n');
        go_on(view, 3);
        CHECK(view->eye.followed != 0 && hash_of(view) == drawn_afresh(view), "the next entity");
        lom_close_view(view);
    }
}

/* What is near goes with the hand: of the world, or of the thing that the eye goes around. */
static void a_drag_goes_with_the_hand(void)
{
    struct lom_view *view = open_moving(false);
    for (int third = 0; third < 2; third++) {
        if (third)
            tap(view, 'n');
        go_on(view, 2);
        send(view, LOM_VIEW_BUTTON, 0, 10, 5);
        send(view, LOM_VIEW_POINT, 0, 16, 5);
        struct lom_eye eye = view->eye;
        lom_camera_view before = lom_eye_view(&eye, view->scene, 0);
        send(view, LOM_VIEW_POINT, 0, 22, 9);
        send(view, LOM_VIEW_LET_GO, 0, 22, 9);
        lom_camera_view after = lom_eye_view(&view->eye, view->scene, 0);
        lom_vec3 way = lom_vec3_subtract(after.target, after.position);
        CHECK(third ? after.position.x < before.position.x && after.position.y > before.position.y
                    : way.x < 0 && way.y > lom_vec3_subtract(before.target, before.position).y,
              "person %d", third);
    }
    lom_close_view(view);
}

/* The keys of flying lead a third person around what it follows: nearer, to the right and up. */
static void a_third_person_goes_around(void)
{
    struct lom_view *view = open_moving(false);
    tap(view, 'n');
    go_on(view, 2);
    static const char keys[] = { 'w', 'd', 'e' };
    for (size_t i = 0; i < sizeof keys; i++) {
        struct lom_eye eye = view->eye;
        lom_camera_view before = lom_eye_view(&eye, view->scene, 0);
        send(view, LOM_VIEW_PRESS, keys[i], 0, 0);
        go_on(view, 20);
        send(view, LOM_VIEW_RELEASE, keys[i], 0, 0);
        lom_camera_view after = lom_eye_view(&view->eye, view->scene, 0);
        lom_vec3 moved = lom_vec3_subtract(after.position, before.position);
        lom_vec3 ahead = lom_vec3_normalize(lom_vec3_subtract(before.target, before.position));
        lom_vec3 right = lom_vec3_normalize(lom_vec3_cross(ahead, (lom_vec3){ 0, 1, 0 }));
        double ways[] = { lom_vec3_dot(moved, ahead), lom_vec3_dot(moved, right), moved.y };
        CHECK(ways[i] > 0.02 && ways[i] > 0.8 * lom_vec3_length(moved), "%c: ahead %g, right %g, up %g", keys[i],
              ways[0], ways[1], ways[2]);
    }
    lom_close_view(view);
}

/* Plates of a run of moving pictures are not those of a frame alone: at rest it is drawn afresh. */
static void at_rest_plates_are_made_anew(void)
{
    static const char clouds[] = "[[cloud]]\nkind = \"cumulus_mediocris\"\nsize = [12, 6, 8]\nposition = [0, 2, -8]\n"
                                 "voxels = [8, 6, 7]\n[quality]\nimpostors = \"bounded\"\n"
                                 "[quality.impostor]\nbound = 30\n";
    lom_error error = { .code = LOM_OK };
    static char text[4096];
    snprintf(text, sizeof text, "%s%s", small_scene, clouds);
    CHECK(small_text("scene.toml", text, &error), "%s", error.text);
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    if (view == NULL)
        return;
    go_on(view, 1);
    send(view, LOM_VIEW_PRESS, 'd', 0, 0);
    go_on(view, 6);
    uint64_t moving = hash_of(view), alone = drawn_afresh(view);
    CHECK(!view->is_exact && moving != alone, "the run's plates are those of a frame alone");
    send(view, LOM_VIEW_RELEASE, 'd', 0, 0);
    go_on(view, 2);
    CHECK(view->is_exact && hash_of(view) == alone, "not drawn afresh");
    lom_close_view(view);
}

static void the_sun_is_moved_and_stopped(void)
{
    struct lom_view *view = open_moving(false);
    go_on(view, 1);
    uint64_t first = hash_of(view);
    send(view, LOM_VIEW_PRESS, 'i', 0, 0);
    go_on(view, 30);
    send(view, LOM_VIEW_RELEASE, 'i', 0, 0);
    go_on(view, 3);
    uint64_t higher = hash_of(view);
    CHECK(view->sun.elevation > 39.9 && view->sun.elevation < 40.1 && view->sun.azimuth > 19.9999 &&
              view->sun.azimuth < 20.0001,
          "%g %g", view->sun.azimuth, view->sun.elevation);
    CHECK(higher != first && higher == drawn_afresh(view), "it is not drawn there");
    tap(view, 'o');
    go_on(view, 60);
    tap(view, 'o');
    go_on(view, 3);
    CHECK(view->sun.azimuth > 29.9 && view->sun.azimuth < 30.1 && lom_view_rests(view), "%g", view->sun.azimuth);
    tap(view, LOM_VIEW_BACKSPACE);
    go_on(view, 3);
    CHECK(hash_of(view) == first && view->settings.count == 0, "not as the file has it");
    lom_close_view(view);
}

static void lines_are_as_wide_as_the_window(void)
{
    struct lom_view *view = open_moving(false);
    static uint8_t pixels[640 * 400 * 4];
    static const int sizes[][2] = { { 1, 1 }, { 7, 300 }, { 300, 7 }, { 640, 400 } };
    tap(view, LOM_VIEW_TAB);
    tap(view, 'g');
    tap(view, 'v');
    for (int i = 0; i < 4; i++) {
        send(view, LOM_VIEW_RESIZE, 0, sizes[i][0], sizes[i][1]);
        go_on(view, 2);
        for (int keys = 0; keys < 2; keys++) {
            tap(view, LOM_VIEW_F1);
            lom_tell_view(view, keys != 0, "%0600d a b c", 7); /* longer than any line */
            lom_paint_view(view, pixels, 4 * (size_t)sizes[i][0]);
        }
    }
    CHECK(view->width == 640, "not resized");
    lom_close_view(view);
}

/* A path in an entity's coordinates; what has its camera elsewhere than in tables is left alone. */
static void a_path_beside_an_entity_is_recorded(void)
{
    lom_error error = { .code = LOM_OK };
    struct lom_view *view = open_moving(false);
    tap(view, 'n');
    tap(view, 'g');
    send(view, LOM_VIEW_PRESS, 'w', 0, 0);
    go_on(view, 40);
    send(view, LOM_VIEW_RELEASE, 'w', 0, 0);
    lom_camera_view end = lom_eye_view(&view->eye, view->scene, 0.5);
    tap(view, 'c'); /* another eye ends the recording */
    CHECK(strncmp(view->message, "written: ", 9) == 0, "%s", view->message);
    char name[400];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(view->message + 9, ","), view->message + 9);
    lom_scene *scene = lom_read_scene(name, NULL, 0, &error);
    CHECK(scene != NULL && scene->camera.followed == 1 && scene->camera.key_count >= 3, "%s", error.text);
    if (scene != NULL) {
        lom_scene moved = *scene; /* its last place, at the time of the other */
        moved.camera.key_count = 0;
        moved.camera.position = scene->camera.keys[scene->camera.key_count - 1].position;
        moved.camera.target = scene->camera.keys[scene->camera.key_count - 1].target;
        lom_camera_view last = lom_scene_camera_at(&moved, 0.5);
        CHECK(memcmp(&last.position, &end.position, sizeof end.position) == 0, "the path ends elsewhere");
    }
    lom_free_scene(scene);
    lom_close_view(view);
    CHECK(small_text("scene.toml",
                     "camera.position = [0, 3, 12]\ncamera.target = [0, 1, 0]\n[[entity]]\nmesh = \"box.obj\"\n",
                     &error),
          "%s", error.text);
    int files = count_small_files(".toml");
    view = open_view(LOM_ORDER_RGBX);
    tap(view, 'g');
    go_on(view, 2);
    tap(view, 'g');
    CHECK(view->is_error && strstr(view->message, "scene") != NULL && count_small_files(".toml") == files, "%s",
          view->message);
    lom_close_view(view);
}

static void what_is_no_longer_there_is_let_go(void)
{
    lom_error error = { .code = LOM_OK };
    struct lom_view *view = open_moving(false);
    tap(view, 'n');
    tap(view, 'n');
    go_on(view, 2);
    CHECK(view->eye.followed == 2, "followed: %zu", view->eye.followed);
    CHECK(small_text("scene.toml", small_scene, &error), "%s", error.text);
    go_on(view, 20);
    CHECK(view->eye.kind == LOM_EYE_SCENE && view->is_exact && hash_of(view) == drawn_afresh(view), "%s",
          view->message);
    lom_close_view(view);
}

static void small_keys_do_what_they_say(void)
{
    struct lom_view *view = open_moving(false);
    go_on(view, 1);
    double speed = view->speed;
    tap(view, '+');
    tap(view, '+');
    tap(view, '-');
    CHECK(view->speed > 1.24 * speed && view->speed < 1.26 * speed, "%g after %g", view->speed, speed);
    tap(view, 'f');
    tap(view, 'h');
    CHECK(view->is_free && !view->shows_status, "f, h");
    uint64_t first = hash_of(view);
    tap(view, 'v');
    go_on(view, 1);
    tap(view, LOM_VIEW_ESCAPE);
    go_on(view, 1);
    CHECK(view->pass < 0 && hash_of(view) == first && !view->ends, "the pass is still shown");
    lom_close_view(view);
}

/* A picture of another shape stands in the middle, as large as it can, with black beside it. */
static void other_shapes_are_centred(void)
{
    static const struct {
        int width, height, left, top;
    } cases[] = { { 8, 8, 16, 0 }, { 64, 8, 0, 12 }, { 8, 32, 28, 0 }, { 128, 64, 0, 0 } };
    static uint8_t pixels[64 * 32 * 4];
    static uint32_t white[128 * 64];
    struct lom_view *view = open_moving(false);
    send(view, LOM_VIEW_RESIZE, 0, 64, 32);
    view->shows_status = false;
    memset(white, 0xff, sizeof white);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct lom_view_picture kept = view->shown;
        view->shown =
            (struct lom_view_picture){ (uint8_t *)white, sizeof white, cases[i].width, cases[i].height, false };
        lom_paint_view(view, pixels, 4 * 64);
        view->shown = kept;
        int wrong = 0;
        for (int y = 0; y < 32; y++)
            for (int x = 0; x < 64; x++) {
                bool is_inside =
                    x >= cases[i].left && x < 64 - cases[i].left && y >= cases[i].top && y < 32 - cases[i].top;
                wrong += pixels[4 * (64 * y + x)] != (is_inside ? 255 : 0);
            }
        CHECK(wrong == 0, "%dx%d: %d pixels are wrong", cases[i].width, cases[i].height, wrong);
    }
    lom_close_view(view);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(arrows_steer_the_aircraft);
    RUN(nothing_to_steer_is_said);
    RUN(persons_follow_in_turn);
    RUN(a_drag_goes_with_the_hand);
    RUN(a_third_person_goes_around);
    RUN(at_rest_plates_are_made_anew);
    RUN(a_path_beside_an_entity_is_recorded);
    RUN(what_is_no_longer_there_is_let_go);
    RUN(small_keys_do_what_they_say);
    RUN(other_shapes_are_centred);
    RUN(the_sun_is_moved_and_stopped);
    RUN(lines_are_as_wide_as_the_window);
    remove_small_scene();
    return check_result();
}
