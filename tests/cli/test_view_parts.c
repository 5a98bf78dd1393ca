/* Proves the parts of `lom view` that need no picture: the camera that an eye prints is the one it draws with, bit for bit;
 * the rotation of a flight is that of its three turns; a banked aircraft turns as physics says; every dial of the menu
 * goes through values that a scene takes, and back. */
#include "check.h"
#include "cli/view_enlarge.h"
#include "cli/view_menu.h"
#include "cli/view_pilot.h"
#include "small_scene.h"

#include <lom/cloud.h>

static const char scene_text[] =
    "[output]\nwidth = 32\nheight = 18\n[camera]\nposition = [1, 3, 12]\ntarget = [0, 1, 0]\nfollow = \"box\"\n"
    "field_of_view = 37.3\n[[camera.key]]\ntime = 0\n[[camera.key]]\ntime = 1\nposition = [2, 4, 13]\n"
    "[light]\nazimuth = 20\nelevation = 25\n[haze]\nheight = 50\n[clouds]\nshadows = false\n"
    "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"color.png\"\n"
    "[water]\nlevel = 0\n[quality]\nterrain_shadows = true\n"
    "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\n[[entity.key]]\ntime = 0\nposition = [0, 1, 2]\n"
    "rotation = [10, 20, 30]\n[[entity.key]]\ntime = 2\nposition = [4, 3, -9]\nrotation = [-20, 100, 5]\n"
    "[[entity]]\nmesh = \"box.obj\"\n";

static lom_scene *read_text(const char *const *overrides, size_t count)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene =
        lom_decode_scene(scene_text, strlen(scene_text), small_path("view.toml"), overrides, count, &error);
    if (count == 0)
        CHECK(scene != NULL, "%s", error.text);
    return scene;
}

/* A number in [-1, 1) by its place. */
static double random_number(uint64_t i)
{
    return (double)(lom_random_bits(11, i) & 0xfffff) / 524288 - 1;
}

/* ---- the eye ---- */

static bool are_same(const lom_camera_view *a, const lom_camera_view *b)
{
    return memcmp(&a->position, &b->position, sizeof a->position) == 0 &&
           memcmp(&a->target, &b->target, sizeof a->target) == 0 && memcmp(&a->up, &b->up, sizeof a->up) == 0 &&
           a->field_of_view == b->field_of_view && a->near_plane == b->near_plane && a->projection == b->projection &&
           a->height == b->height && a->far_plane == b->far_plane && a->shear[0] == b->shear[0] &&
           a->shear[1] == b->shear[1];
}

static void check_eye(const lom_scene *scene, const struct lom_eye *eye, double time)
{
    char text[LOM_MAX_SETTING], override[LOM_MAX_SETTING + 8];
    const char *name = eye->followed != 0 ? scene->entities[eye->followed - 1].name : NULL;
    lom_print_eye(text, sizeof text, eye, name, scene, &scene->camera);
    snprintf(override, sizeof override, "camera=%s", text);
    const char *overrides[] = { override };
    lom_scene *other = read_text(overrides, 1);
    CHECK(other != NULL, "not read: %s", override);
    if (other == NULL)
        return;
    lom_camera_view a = lom_eye_view(eye, scene, time), b = lom_scene_camera_at(other, time);
    CHECK(are_same(&a, &b), "%s at %g s", override, time);
    CHECK(other->camera.person == (eye->kind == LOM_EYE_FIRST ? LOM_PERSON_FIRST : LOM_PERSON_THIRD) &&
              other->camera.followed == eye->followed,
          "%s", override);
    lom_free_scene(other);
}

static void a_printed_eye_is_the_one_that_sees(void)
{
    lom_scene *scene = read_text(NULL, 0);
    for (int kind = LOM_EYE_FREE; scene != NULL && kind < LOM_EYE_KINDS; kind++)
        for (uint64_t n = 0; n < 40; n++) {
            lom_camera_view seen = lom_scene_camera_at(scene, 0.3);
            struct lom_eye eye = lom_make_eye(kind, kind == LOM_EYE_FREE ? 0 : 1, scene, &scene->camera, &seen, 0.3);
            for (uint64_t k = 0; k < n; k++) {
                lom_turn_eye(&eye, random_number(100 * n + 7 * k), random_number(100 * n + 7 * k + 1));
                lom_move_eye(&eye, 9 * random_number(100 * n + 7 * k + 2), random_number(100 * n + 7 * k + 3), 0.1);
                lom_zoom_eye(&eye, 1 + 0.3 * random_number(100 * n + 7 * k + 4));
            }
            check_eye(scene, &eye, 0.05 * (double)n);
        }
    lom_free_scene(scene);
}

/* A new eye sees what the scene's camera saw. */
static void a_new_eye_changes_nothing(void)
{
    lom_scene *scene = read_text(NULL, 0);
    if (scene == NULL)
        return;
    lom_camera_view seen = lom_scene_camera_at(scene, 0.4);
    struct lom_eye third = lom_make_eye(LOM_EYE_THIRD, 1, scene, &scene->camera, &seen, 0.4);
    lom_camera_view again = lom_eye_view(&third, scene, 0.4);
    CHECK(memcmp(&again.position, &seen.position, sizeof seen.position) == 0 &&
              memcmp(&again.target, &seen.target, sizeof seen.target) == 0,
          "third person: %g %g %g instead of %g %g %g", again.position.x, again.position.y, again.position.z,
          seen.position.x, seen.position.y, seen.position.z);
    struct lom_eye eye = lom_make_eye(LOM_EYE_FREE, 0, scene, &scene->camera, &seen, 0.4);
    again = lom_eye_view(&eye, scene, 0.4);
    lom_vec3 was = lom_vec3_normalize(lom_vec3_subtract(seen.target, seen.position));
    lom_vec3 is = lom_vec3_normalize(lom_vec3_subtract(again.target, again.position));
    CHECK(lom_vec3_length(lom_vec3_subtract(was, is)) < 1e-12, "free: another direction");
    CHECK(memcmp(&again.position, &seen.position, sizeof seen.position) == 0, "free: another place");
    lom_free_scene(scene);
}

/* ---- flying ---- */

static void a_flight_is_its_three_turns(void)
{
    for (uint64_t n = 0; n < 2000; n++) {
        double yaw = 3.2 * random_number(3 * n), pitch = 1.5 * random_number(3 * n + 1);
        double roll = 3.1 * random_number(3 * n + 2), back[3];
        if (n % 5 == 0) /* where the scene's angles lose one */
            yaw = n % 2 == 0 ? 1.5707963267948966 : -1.5707963267948966, pitch = 0;
        lom_mat4 a = lom_rotation((lom_vec3){ 0, yaw, 0 }), b = lom_rotation((lom_vec3){ pitch, 0, 0 });
        lom_mat4 c = lom_rotation((lom_vec3){ 0, 0, roll });
        lom_mat4 expected = lom_multiply(&a, &b);
        expected = lom_multiply(&expected, &c);
        lom_vec3 rotation = lom_rotation_of_flight(yaw, pitch, roll);
        lom_mat4 given = lom_rotation(rotation);
        lom_flight_of_rotation(rotation, &back[0], &back[1], &back[2]);
        a = lom_rotation((lom_vec3){ 0, back[0], 0 }), b = lom_rotation((lom_vec3){ back[1], 0, 0 });
        c = lom_rotation((lom_vec3){ 0, 0, back[2] });
        lom_mat4 again = lom_multiply(&a, &b);
        again = lom_multiply(&again, &c);
        double worst = 0;
        for (int i = 0; i < 9; i++) {
            double d = given.m[i / 3][i % 3] - expected.m[i / 3][i % 3];
            double e = again.m[i / 3][i % 3] - expected.m[i / 3][i % 3];
            worst = d * d > worst ? d * d : worst;
            worst = e * e > worst ? e * e : worst;
        }
        CHECK(worst < 1e-12, "%g %g %g: off by %g squared", yaw, pitch, roll, worst);
    }
}

/* Straight on it goes v t; in a settled turn it heads as w = g tan(bank) / v says, on a circle of radius v / w. */
static void a_turn_is_coordinated(void)
{
    struct lom_pilot pilot = { .flies = true, .speed = 50 };
    for (int i = 0; i < 120; i++)
        lom_fly(&pilot, 1.0 / 60);
    double gone = lom_vec3_length(pilot.position);
    CHECK(gone > 100 - 1e-9 && gone < 100 + 1e-9 && pilot.position.z < -99.9, "gone %g", gone);
    pilot = (struct lom_pilot){ .flies = true, .speed = 50, .turning = 1 };
    for (int i = 0; i < 1200; i++)
        lom_fly(&pilot, 1.0 / 60); /* the bank has settled */
    double bank = -pilot.roll, before = pilot.yaw;
    CHECK(bank > 0.69 && bank < 0.71, "bank %g to the right", bank);
    lom_fly(&pilot, 0.5);
    double turned = before - pilot.yaw;
    turned += turned < 0 ? 6.283185307179586 : 0;
    double expected = 9.81 * lom_double_tan(bank) / 50 * 0.5;
    CHECK(turned > expected * 0.999 && turned < expected * 1.001, "turned %g to the right, expected %g", turned,
          expected);
}

/* ---- enlarging ---- */

/* The value at a place, in pixels of the small picture from its first one's middle, by bilinear interpolation. */
static double bilinear(const uint32_t *picture, int width, int height, double x, double y, int byte)
{
    x = x < 0 ? 0 : x > width - 1 ? width - 1 : x;
    y = y < 0 ? 0 : y > height - 1 ? height - 1 : y;
    int left = lom_int_of(x), top = lom_int_of(y);
    int right = left + 1 < width ? left + 1 : left, bottom = top + 1 < height ? top + 1 : top;
    double v[4];
    const int places[4] = { top * width + left, top * width + right, bottom * width + left, bottom * width + right };
    for (int i = 0; i < 4; i++)
        v[i] = (double)(picture[places[i]] >> (8 * byte) & 255);
    double upper = v[0] + (v[1] - v[0]) * (x - left), lower = v[2] + (v[3] - v[2]) * (x - left);
    return upper + (lower - upper) * (y - top);
}

static void enlarging_is_bilinear(void)
{
    enum { SMALL = 13, ROWS = 5 };
    static uint32_t picture[SMALL * ROWS], row[4 * SMALL + 1];
    for (int i = 0; i < SMALL * ROWS; i++)
        picture[i] = (uint32_t)lom_random_bits(5, (uint64_t)i) | 0xff000000;
    for (int factor = 2; factor <= 4; factor += 2)
        for (int cut = 0; cut < factor; cut++)
            for (int y = 0; y < ROWS * factor; y++) {
                const int width = SMALL * factor - cut;
                row[width] = 0x12345678;
                lom_enlarge_row(picture, SMALL, ROWS, factor, y, width, row);
                CHECK(row[width] == 0x12345678, "written behind the row");
                for (int i = 0; i < 4 * width; i++) {
                    double expected =
                        bilinear(picture, SMALL, ROWS, (i / 4 + 0.5) / factor - 0.5, (y + 0.5) / factor - 0.5, i % 4);
                    double off = (double)(row[i / 4] >> (8 * (i % 4)) & 255) - expected;
                    CHECK(off <= 1 && off >= -1, "%d times, row %d, pixel %d: off by %g", factor, y, i / 4, off);
                    CHECK(i % 4 != 3 || off == 0, "equal bytes do not stay");
                }
            }
}

/* ---- settings and the menu ---- */

static void a_setting_is_there_once(void)
{
    struct lom_settings settings = { .count = 0 };
    const double three[3] = { 1, -0.5, 1e-7 };
    lom_option_list list = { .count = 0 };
    CHECK(lom_set_setting(&settings, "a.b", "1") && lom_set_setting(&settings, "a.bc", "2"), "no room");
    CHECK(lom_set_numbers(&settings, "a.b", three, 3) && settings.count == 2, "%d", settings.count);
    CHECK(strcmp(lom_find_setting(&settings, "a.b"), "[1, -0.5, 1e-07]") == 0, "%s",
          lom_find_setting(&settings, "a.b"));
    lom_list_settings(&settings, &list);
    CHECK(list.count == 2 && strcmp(list.items[1], "a.bc=2") == 0, "list");
    CHECK(lom_drop_setting(&settings, "a.b") && !lom_drop_setting(&settings, "a.b") && settings.count == 1 &&
              strcmp(settings.text[0], "a.bc=2") == 0,
          "not dropped");
    for (int i = 0; i < LOM_MAX_SETTINGS + 3; i++) {
        char key[16];
        snprintf(key, sizeof key, "k%d", i);
        CHECK(lom_set_setting(&settings, key, "1") == (i + 1 < LOM_MAX_SETTINGS), "%d", i);
    }
}

/* Sets a dial of the scene to a value; false: no scene can have it together with the rest. */
static bool is_taken(const struct lom_menu_item *item, double value)
{
    char text[160], override[LOM_MENU_PATH + 200];
    lom_print_item(text, item, value);
    snprintf(override, sizeof override, "%s=%s", item->path, text);
    const char *overrides[] = { override };
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_decode_scene(scene_text, strlen(scene_text), small_path("view.toml"), overrides, 1, &error);
    bool is_range = strstr(error.text, "must be") != NULL || strstr(error.text, "unknown") != NULL;
    CHECK(scene != NULL || !is_range, "%s: %s", override, error.text);
    bool is_direction = strstr(item->path, ".up") != NULL || strstr(item->path, ".direction") != NULL; /* made a unit */
    struct lom_menu *menu = scene != NULL && !is_direction ? lom_create_menu(&error) : NULL;
    if (menu != NULL && lom_fill_menu(menu, scene, &error))
        for (size_t i = 0; i < menu->count; i++)
            if (strcmp(menu->items[i].path, item->path) == 0 && menu->items[i].component == item->component) {
                char read[160];
                lom_print_item(read, &menu->items[i], lom_key_value(item->key, menu->items[i].member));
                CHECK(strcmp(read, text) == 0, "%s is read as %s", override, read);
            }
    lom_free_menu(menu);
    lom_free_scene(scene);
    return scene != NULL;
}

static void dials_go_through_what_a_scene_takes(void)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = read_text(NULL, 0);
    struct lom_menu *menu = scene != NULL ? lom_create_menu(&error) : NULL;
    int dials = 0, taken = 0, groups = 0;
    if (menu == NULL || !lom_fill_menu(menu, scene, &error)) {
        CHECK(false, "%s", error.text);
        return;
    }
    for (size_t i = 0; i < menu->count; i++) {
        const struct lom_menu_item *item = &menu->items[i];
        groups += item->key == NULL;
        for (int direction = -1; item->key != NULL && direction <= 1; direction += 2) {
            double value = lom_key_value(item->key, item->member);
            for (int n = 0; n < 3; n++) {
                double next = lom_step_key(item->key, value, direction, n == 2);
                if (next == value)
                    continue;
                value = next;
                dials++;
                taken += is_taken(item, value);
            }
        }
    }
    CHECK(groups > 15 && dials > 1000 && taken > dials * 9 / 10, "%d groups, %d steps, %d taken", groups, dials, taken);
    lom_free_menu(menu);
    lom_free_scene(scene);
}

static void steps_print_as_people_write(void)
{
    static const lom_key part = { .name = "part", .type = LOM_KEY_NUMBER, .maximum = 1 };
    static const lom_key above = { .name = "above", .type = LOM_KEY_NUMBER, .maximum = 1, .flags = LOM_KEY_ABOVE };
    static const lom_key metres = { .name = "metres", .type = LOM_KEY_NUMBER, .minimum = -1e9, .maximum = 1e9 };
    static const lom_key choice = { .name = "choice", .type = LOM_KEY_CHOICE, .choices = { "a", "b", "c" } };
    static const struct {
        const lom_key *key;
        double value;
        int direction;
        bool fast;
        const char *next;
    } steps[] = {
        { &part, 0.2, 1, false, "0.21" },         { &part, 0.99, 1, true, "1" },     { &part, 0, -1, false, "0" },
        { &above, 0.001, -1, true, "0.001" },     { &metres, 0, -1, false, "-0.1" }, { &metres, 23, 1, false, "24" },
        { &metres, -1600, 1, false, "-1500" },    { &metres, 0.3, 1, true, "0.4" },  { &metres, 0.7, 1, false, "0.71" },
        { &metres, 0.0001, 1, false, "0.00011" }, { &metres, 0.7, -1, true, "0.6" }, { &metres, 0.1, -1, true, "0" },
        { &choice, 0, -1, false, "\"c\"" },       { &choice, 2, 1, false, "\"a\"" },
    };
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        char text[64];
        lom_print_key_value(text, steps[i].key,
                            lom_step_key(steps[i].key, steps[i].value, steps[i].direction, steps[i].fast));
        CHECK(strcmp(text, steps[i].next) == 0, "%s %g: %s instead of %s", steps[i].key->name, steps[i].value, text,
              steps[i].next);
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(a_printed_eye_is_the_one_that_sees);
    RUN(a_new_eye_changes_nothing);
    RUN(a_flight_is_its_three_turns);
    RUN(a_turn_is_coordinated);
    RUN(enlarging_is_bilinear);
    RUN(a_setting_is_there_once);
    RUN(dials_go_through_what_a_scene_takes);
    RUN(steps_print_as_people_write);
    remove_small_scene();
    return check_result();
}
