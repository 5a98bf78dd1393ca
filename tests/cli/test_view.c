/* Proves what `lom view` shows, without a window: at rest the picture of a renderer of its own; nothing is drawn while
 * nothing changes; while something moves it is smaller when it would take too long, and exact afterwards; an event abandons
 * what is being drawn; another file, or a mistake in it, changes the picture or leaves it with a sentence; settings that no
 * scene can have are taken back; a recorded path is a scene whose camera was there; a text is legible on any ground. */
#include "cli/view_host.h"

static void at_rest_it_is_the_renderers(void)
{
    static const lom_pixel_order orders[] = { LOM_ORDER_RGBX, LOM_ORDER_BGRX };
    for (int i = 0; i < 2; i++) {
        struct lom_view *view = open_view(orders[i]);
        go_on(view, 1);
        CHECK(view->is_exact && hash_of(view) == drawn_afresh(view), "at the start");
        uint64_t before = hash_of(view);
        send(view, LOM_VIEW_PRESS, 'w', 0, 0);
        go_on(view, 5);
        send(view, LOM_VIEW_RELEASE, 'w', 0, 0);
        go_on(view, 2);
        CHECK(view->is_exact && hash_of(view) == drawn_afresh(view) && hash_of(view) != before, "after w");
        send(view, LOM_VIEW_BUTTON, 0, 5, 5);
        send(view, LOM_VIEW_POINT, 0, 15, 7);
        send(view, LOM_VIEW_LET_GO, 0, 15, 7);
        before = hash_of(view);
        go_on(view, 2);
        CHECK(view->is_exact && hash_of(view) == drawn_afresh(view) && hash_of(view) != before, "after a drag");
        send(view, LOM_VIEW_RESIZE, 0, 41, 23);
        go_on(view, 1);
        CHECK(view->shown.width == 41 && view->shown.height == 23 && hash_of(view) == drawn_afresh(view), "resized");
        lom_close_view(view);
    }
}

static void nothing_is_drawn_while_nothing_changes(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 200);
    CHECK(view->pictures == 1 && lom_view_rests(view), "%d pictures at rest", view->pictures);
    tap(view, 'h');
    tap(view, 'm');
    go_on(view, 10);
    CHECK(view->pictures == 1 && view->is_unpainted, "%d pictures for text alone", view->pictures);
    tap(view, LOM_VIEW_SPACE);
    go_on(view, 6);
    CHECK(view->pictures == 7 && !lom_view_rests(view), "%d pictures while time runs", view->pictures);
    tap(view, LOM_VIEW_SPACE);
    go_on(view, 20);
    CHECK(view->pictures == 7 && lom_view_rests(view), "%d pictures when it stands again", view->pictures);
    lom_close_view(view);
}

static void slow_pictures_are_smaller_while_they_move(void)
{
    static const struct {
        double cost;
        int divisor;
    } cases[] = { { 0, 1 }, { 40, 1 }, { 41, 2 }, { 160, 2 }, { 161, 4 }, { 9000, 4 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct lom_view *view = open_view(LOM_ORDER_RGBX);
        go_on(view, 1);
        view->cost = cases[i].cost;
        send(view, LOM_VIEW_PRESS, 'd', 0, 0);
        go_on(view, 3);
        const int width = (32 + cases[i].divisor - 1) / cases[i].divisor;
        CHECK(view->shown.width == width && view->is_exact == (cases[i].divisor == 1), "%g ms: %d wide", cases[i].cost,
              view->shown.width);
        send(view, LOM_VIEW_RELEASE, 'd', 0, 0);
        go_on(view, 2);
        CHECK(view->shown.width == 32 && view->is_exact && hash_of(view) == drawn_afresh(view), "not settled");
        tap(view, 'z');
        send(view, LOM_VIEW_PRESS, 'd', 0, 0);
        go_on(view, 2);
        CHECK(view->shown.width == 32, "smaller though it must not be");
        lom_close_view(view);
    }
}

static void an_event_abandons_a_picture_at_rest(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 1);
    uint64_t before = hash_of(view);
    send(view, LOM_VIEW_WHEEL, 0, 0, 3);
    lom_step_view(view, turn); /* it has moved */
    lom_step_view(view, turn);
    waits_for_me = true;
    lom_draw_view(view);
    CHECK(hash_of(view) == before && view->is_stale && view->message[0] == '\0', "drawn nevertheless; %s",
          view->message);
    waits_for_me = false;
    lom_draw_view(view);
    CHECK(view->is_exact && hash_of(view) != before && hash_of(view) == drawn_afresh(view), "not drawn");
    lom_close_view(view);
}

static bool rewrite(const char *from, const char *to)
{
    lom_error error = { .code = LOM_OK };
    static char text[4096];
    snprintf(text, sizeof text, "%s", small_scene);
    char *at = strstr(text, from);
    if (at == NULL)
        return false;
    snprintf(at, sizeof text - (size_t)(at - text), "%s%s", to, strstr(small_scene, from) + strlen(from));
    return small_text("scene.toml", text, &error);
}

static void files_are_read_again(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 20);
    uint64_t first = hash_of(view);
    CHECK(rewrite("elevation = 25", "elevation = 60"), "not written");
    go_on(view, 20);
    uint64_t second = hash_of(view);
    CHECK(second != first && view->pictures == 2 && second == drawn_afresh(view), "the change is not drawn");
    CHECK(rewrite("elevation = 25", "elevation = \"high\""), "not written");
    go_on(view, 20);
    CHECK(hash_of(view) == second && view->is_error && strstr(view->message, "scene.toml:9:13") != NULL, "%s",
          view->message);
    CHECK(rewrite("elevation = 25", "elevation = 25"), "not written");
    go_on(view, 20);
    CHECK(hash_of(view) == first && !view->is_error && view->message[0] == '\0', "%s", view->message);
    lom_error error = { .code = LOM_OK };
    CHECK(small_picture("color.png", 4, LOM_FORMAT_RGB8, &error), "%s", error.text); /* a file that it names */
    go_on(view, 20);
    CHECK(hash_of(view) != first && hash_of(view) == drawn_afresh(view), "the other texture is not drawn");
    CHECK(small_picture("color.png", 8, LOM_FORMAT_RGB8, &error), "%s", error.text);
    go_on(view, 20);
    CHECK(hash_of(view) == first, "the texture of before is not drawn");
    lom_close_view(view);
}

/* A host that does not wait: whatever comes meanwhile, the old picture stands until the new scene is there. */
static void the_old_picture_stands_while_another_is_read(void)
{
    lom_error error = { .code = LOM_OK };
    CHECK(small_text("scene.toml", small_scene, &error), "%s", error.text);
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    view->host.is_patient = false;
    go_on(view, 1);
    uint64_t first = hash_of(view);
    tap(view, 'r'); /* by another renderer */
    CHECK(rewrite("elevation = 25", "elevation = 70"), "not written");
    lom_reload_view(view);
    for (int i = 0; i < 1000 && (view->load != NULL || view->has_changed); i++) {
        CHECK(hash_of(view) == first && !lom_view_rests(view), "it does not stand");
        send(view, LOM_VIEW_BUTTON, 0, 3, 3);
        send(view, LOM_VIEW_LET_GO, 0, 3, 3);
        lom_draw_view(view);
        lom_step_view(view, turn);
    }
    go_on(view, 1);
    CHECK(view->load == NULL && hash_of(view) != first && hash_of(view) == drawn_afresh(view),
          "the change is not drawn");
    tap(view, 'r'); /* closed while it reads */
    lom_reload_view(view);
    lom_close_view(view);
}

/* Chooses an item of the menu by its path. */
static bool choose(struct lom_view *view, const char *path)
{
    struct lom_menu *menu = view->menu;
    menu->is_open = true;
    for (menu->chosen = 0; menu->chosen < menu->count; menu->chosen++)
        if (menu->items[menu->chosen].key != NULL && strcmp(menu->items[menu->chosen].path, path) == 0)
            return true;
    menu->chosen = 0;
    CHECK(false, "the menu has no %s", path);
    return false;
}

static void the_menu_changes_the_scene(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 1);
    uint64_t first = hash_of(view);
    if (choose(view, "entity.box.visible"))
        tap(view, LOM_VIEW_RIGHT);
    go_on(view, 2);
    CHECK(!view->scene->entities[0].visible && hash_of(view) != first && hash_of(view) == drawn_afresh(view), "%s",
          view->message);
    if (choose(view, "entity.box.visible"))
        tap(view, LOM_VIEW_BACKSPACE);
    go_on(view, 2);
    CHECK(hash_of(view) == first && view->settings.count == 0, "not as the file has it");
    if (choose(view, "camera.pitch")) /* beside a target: no scene can have both */
        tap(view, LOM_VIEW_RIGHT);
    go_on(view, 2);
    CHECK(hash_of(view) == first && view->is_error && view->settings.count == 0 && view->message[0] != '\0', "%s",
          view->message);
    tap(view, LOM_VIEW_ESCAPE);
    tap(view, LOM_VIEW_ESCAPE);
    CHECK(!view->menu->is_open && view->message[0] == '\0' && !view->ends, "not closed");
    tap(view, LOM_VIEW_ESCAPE);
    CHECK(view->ends, "not ended");
    lom_close_view(view);
}

/* Arrows reach every item, and no row is longer than the room for it. */
static void the_menu_is_walked_through(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    char text[LOM_MENU_ROW];
    bool is_chosen = false;
    size_t rows = 0, unfolded = 0;
    tap(view, 'm');
    while (lom_menu_row(view, rows, text, NULL))
        rows++;
    tap(view, LOM_VIEW_DOWN);
    tap(view, LOM_VIEW_RIGHT);
    while (lom_menu_row(view, unfolded, text, NULL))
        unfolded++;
    CHECK(rows > 10 && unfolded > rows + 3, "%zu rows, %zu with a group unfolded", rows, unfolded);
    for (int i = 0; i < 500; i++)
        tap(view, LOM_VIEW_DOWN);
    CHECK(lom_menu_row(view, unfolded - 1, text, &is_chosen) && is_chosen, "the last row is not reached");
    for (int i = 0; i < 500; i++)
        tap(view, LOM_VIEW_PAGE_UP);
    tap(view, LOM_VIEW_LEFT);
    CHECK(lom_menu_row(view, rows - 1, text, NULL) && !lom_menu_row(view, rows, text, NULL), "not folded");
    lom_close_view(view);
}

static void a_click_explains(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 1);
    uint64_t before = hash_of(view);
    printf("  (what follows is the explanation of a pixel)\n");
    send(view, LOM_VIEW_BUTTON, 0, 16, 10);
    send(view, LOM_VIEW_LET_GO, 0, 17, 10);
    go_on(view, 2);
    CHECK(strncmp(view->message, "16,10: ", 7) == 0 && strstr(view->message, "wrote this") != NULL, "%s",
          view->message);
    CHECK(hash_of(view) == before, "the picture has changed");
    lom_close_view(view);
}

static void a_path_is_recorded(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    lom_error error = { .code = LOM_OK };
    for (int round = 1; round <= 2; round++) {
        go_on(view, 1);
        tap(view, 'g');
        lom_camera_view start = lom_eye_view(&view->eye, view->scene, 0);
        send(view, LOM_VIEW_PRESS, 'w', 0, 0);
        go_on(view, 60);
        send(view, LOM_VIEW_RELEASE, 'w', 0, 0);
        tap(view, 'g');
        lom_camera_view end = lom_eye_view(&view->eye, view->scene, 0);
        char name[24];
        snprintf(name, sizeof name, "scene-%d.toml", round);
        lom_scene *scene = lom_read_scene(small_path(name), NULL, 0, &error);
        CHECK(scene != NULL, "%s; %s", error.text, view->message);
        lom_camera_view first = scene != NULL ? lom_scene_camera_at(scene, 0) : start;
        size_t keys = scene != NULL ? scene->camera.key_count : 0;
        lom_camera_view last = keys != 0 ? lom_scene_camera_at(scene, scene->camera.keys[keys - 1].time) : end;
        CHECK(memcmp(&first.position, &start.position, sizeof first.position) == 0 &&
                  memcmp(&last.position, &end.position, sizeof last.position) == 0 &&
                  memcmp(&first.position, &last.position, sizeof last.position) != 0,
              "round %d: another path", round);
        CHECK(keys >= 5 && scene->entity_count == 1 && scene->terrain.layer_count == 1, "%zu key frames", keys);
        lom_free_scene(scene);
    }
    lom_close_view(view);
}

static void passes_are_shown_in_turn(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 1);
    uint64_t first = hash_of(view);
    int shown = 0, absent = 0;
    for (int i = 0; i < 40; i++) {
        tap(view, 'v');
        int wanted = view->pass;
        go_on(view, 2);
        if (wanted < 0)
            break;
        shown += view->pass == wanted && hash_of(view) != first;
        absent += view->pass != wanted && view->is_error;
        view->pass = wanted;
    }
    CHECK(view->pass < 0 && shown >= 5 && absent >= 2, "%d shown, %d absent", shown, absent);
    go_on(view, 1);
    CHECK(hash_of(view) == first, "not the picture again");
    lom_close_view(view);
}

static void overlays_are_shown_in_turn(void)
{
    struct lom_view *view = open_view(LOM_ORDER_BGRX);
    go_on(view, 1);
    uint64_t first = hash_of(view), before = first;
    int shown = 0, other = 0;
    for (int i = 0; i < 60; i++) {
        tap(view, 'b');
        if (view->overlay < 0)
            break;
        go_on(view, 2);
        shown += view->shown.width == 32 && view->is_exact && !view->is_error;
        other += hash_of(view) != before && hash_of(view) != first;
        before = hash_of(view);
    }
    CHECK(shown >= 10 && other >= shown - 2, "%d shown, %d of them other pictures", shown, other);
    go_on(view, 1);
    CHECK(hash_of(view) == first, "not the picture again");
    lom_close_view(view);
}

/* What is said goes with the next key; a mistake does not, nor the verdict on a pixel that is still marked. */
static void what_is_said_goes(void)
{
    struct lom_view *view = open_view(LOM_ORDER_RGBX);
    go_on(view, 1);
    lom_tell_view(view, false, "%s", "written");
    tap(view, LOM_VIEW_SHIFT);
    CHECK(strcmp(view->message, "written") == 0, "shift: %s", view->message);
    tap(view, 'h');
    CHECK(view->message[0] == '\0' && view->is_unpainted, "h: %s", view->message);
    lom_tell_view(view, true, "%s", "a mistake");
    tap(view, 'h');
    CHECK(strcmp(view->message, "a mistake") == 0, "%s", view->message);
    send(view, LOM_VIEW_BUTTON, 0, 16, 10);
    send(view, LOM_VIEW_LET_GO, 0, 16, 10);
    go_on(view, 1);
    tap(view, 'h');
    CHECK(strncmp(view->message, "16,10: ", 7) == 0 && view->explained_x == 16, "%s", view->message);
    send(view, LOM_VIEW_WHEEL, 0, 0, 1);
    tap(view, 'h');
    CHECK(view->message[0] == '\0' && view->explained_x < 0, "of another picture: %s", view->message);
    lom_close_view(view);
}

/* The frame of a letter is dark, the letter light, whatever is behind; all of the window is written. */
static void what_is_painted_is_legible(void)
{
    struct lom_view *view = open_view(LOM_ORDER_BGRX);
    send(view, LOM_VIEW_RESIZE, 0, 300, 180);
    go_on(view, 1);
    static uint8_t pixels[300 * 180 * 4 + 180 * 8];
    memset(pixels, 0x5a, sizeof pixels);
    lom_tell_view(view, false, "%s", "MMMM");
    lom_paint_view(view, pixels, 300 * 4 + 8);
    int light = 0, unwritten = 0, padding = 0;
    for (int y = 0; y < 180; y++) {
        for (int x = 0; x < 300; x++) {
            const uint8_t *p = pixels + y * (300 * 4 + 8) + 4 * x;
            light += y < 16 && x < 32 && p[0] == 255 && p[1] == 255 && p[2] == 255;
            unwritten += p[3] != 255;
        }
        for (int x = 0; x < 8; x++)
            padding += pixels[y * (300 * 4 + 8) + 1200 + x] != 0x5a;
    }
    CHECK(light == 4 * 18 && unwritten == 0 && padding == 0, "%d light, %d unwritten, %d bytes beside", light,
          unwritten, padding);
    CHECK(!view->is_unpainted, "still unpainted");
    lom_close_view(view);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(at_rest_it_is_the_renderers);
    RUN(nothing_is_drawn_while_nothing_changes);
    RUN(slow_pictures_are_smaller_while_they_move);
    RUN(an_event_abandons_a_picture_at_rest);
    RUN(files_are_read_again);
    RUN(the_old_picture_stands_while_another_is_read);
    RUN(the_menu_changes_the_scene);
    RUN(the_menu_is_walked_through);
    RUN(a_click_explains);
    RUN(a_path_is_recorded);
    RUN(passes_are_shown_in_turn);
    RUN(overlays_are_shown_in_turn);
    RUN(what_is_said_goes);
    RUN(what_is_painted_is_legible);
    remove_small_scene();
    return check_result();
}
