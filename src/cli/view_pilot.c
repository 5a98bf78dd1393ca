/* Steering an entity, and the sun. In: keys that are held, seconds. Out: settings that place them. Invariant: what is
 * steered is placed by one key frame, so that `lom render` with these settings draws the same. */
#include "view_pilot.h"

#include "base/numbers.h"

#include <string.h>

/* ---- turns ----
 * An aircraft turns as M = Ry(yaw) Rx(pitch) Rz(roll): heading, nose, bank. A scene's rotation is Rz(z) Ry(y) Rx(x), whose
 * entries are m20 = -sin y, m21 = cos y sin x, m22 = cos y cos x, m10 = sin z cos y, m00 = cos z cos y. */

lom_vec3 lom_rotation_of_flight(double yaw, double pitch, double roll)
{
    lom_mat4 heading = lom_rotation((lom_vec3){ 0, yaw, 0 }), nose = lom_rotation((lom_vec3){ pitch, 0, 0 });
    lom_mat4 bank = lom_rotation((lom_vec3){ 0, 0, roll }), turn = lom_multiply(&heading, &nose);
    turn = lom_multiply(&turn, &bank);
    double sine = lom_smaller(lom_larger(-turn.m[2][0], -1), 1);
    if (lom_magnitude(sine) > 1 - 1e-12) /* z and x turn about the same axis: x takes it all */
        return (lom_vec3){ lom_double_atan2(-turn.m[1][2], turn.m[1][1]), lom_double_asin(sine), 0 };
    return (lom_vec3){ lom_double_atan2(turn.m[2][1], turn.m[2][2]), lom_double_asin(sine),
                       lom_double_atan2(turn.m[1][0], turn.m[0][0]) };
}

/* Of M: forward is -(m02, m12, m22) = (-sin yaw cos pitch, sin pitch, -cos yaw cos pitch); m10 = cos pitch sin roll,
 * m11 = cos pitch cos roll. */
void lom_flight_of_rotation(lom_vec3 rotation, double *yaw, double *pitch, double *roll)
{
    lom_mat4 turn = lom_rotation(rotation);
    *yaw = lom_double_atan2(turn.m[0][2], turn.m[2][2]);
    *pitch = lom_double_asin(lom_smaller(lom_larger(-turn.m[1][2], -1), 1));
    *roll = lom_double_atan2(turn.m[1][0], turn.m[1][1]);
}

/* ---- the aircraft ---- */

/* Towards a value, a share of the rest for each second that passes. */
static double approach(double value, double aim, double rate, double seconds)
{
    double share = lom_smaller(rate * seconds, 1);
    return value + (aim - value) * share;
}

void lom_fly(struct lom_pilot *pilot, double seconds)
{
    static const double bank = 0.7, nose = 0.35, gravity = 9.81; /* radians; m/s^2 */
    pilot->roll = approach(pilot->roll, -bank * pilot->turning, 2, seconds);
    pilot->pitch = approach(pilot->pitch, nose * pilot->rising, 1.5, seconds);
    /* A coordinated turn: lift L with L cos(roll) = m g and L sin(roll) = m v w, so w = g tan(roll) / v. */
    double rate = gravity * lom_double_tan(pilot->roll) / lom_larger(pilot->speed, 5);
    pilot->yaw += rate * seconds;
    if (lom_magnitude(pilot->yaw) > lom_pi)
        pilot->yaw += pilot->yaw > 0 ? -lom_two_pi : lom_two_pi;
    double metres = pilot->speed * seconds, level = lom_double_cos(pilot->pitch);
    pilot->position.x -= metres * lom_double_sin(pilot->yaw) * level;
    pilot->position.y += metres * lom_double_sin(pilot->pitch);
    pilot->position.z -= metres * lom_double_cos(pilot->yaw) * level;
}

/* 1 + the index of the entity that is steered: the followed one, else the first that moves. */
static size_t find_aircraft(const struct lom_view *view)
{
    const lom_scene *scene = view->scene;
    if (view->eye.followed != 0 || view->camera.followed != 0)
        return view->eye.followed != 0 ? view->eye.followed : view->camera.followed;
    for (size_t i = 0; i < scene->entity_count; i++)
        if (scene->entities[i].key_count != 0)
            return i + 1;
    return 0;
}

bool lom_take_controls(struct lom_view *view)
{
    struct lom_pilot *pilot = &view->pilot;
    size_t found = find_aircraft(view);
    if (pilot->flies && (view->eye.followed == 0 || view->eye.followed == pilot->entity + 1))
        return true;
    if (found == 0) {
        lom_tell_view(view, true, "there is no aircraft to steer: nothing moves, and no entity is followed (n).");
        return false;
    }
    const lom_entity *entity = &view->scene->entities[found - 1];
    lom_entity_place here = lom_scene_entity_at(entity, view->time);
    lom_entity_place next = lom_scene_entity_at(entity, view->time + 0.1);
    *pilot = (struct lom_pilot){ .flies = true, .entity = found - 1, .position = here.position };
    lom_flight_of_rotation(here.rotation, &pilot->yaw, &pilot->pitch, &pilot->roll);
    pilot->speed = lom_vec3_length(lom_vec3_subtract(next.position, here.position)) * 10;
    if (pilot->speed < 1)
        pilot->speed = 30;
    return true;
}

/* One key frame: then it is a key frame that changes, for which nothing is loaded. */
static bool place(struct lom_view *view)
{
    const struct lom_pilot *pilot = &view->pilot;
    lom_vec3 turn = lom_rotation_of_flight(pilot->yaw, pilot->pitch, pilot->roll);
    const lom_vec3 position = lom_place_in_file(view->scene, pilot->position);
    const double numbers[6] = { position.x,
                                position.y,
                                position.z,
                                turn.x / lom_radians_per_degree,
                                turn.y / lom_radians_per_degree,
                                turn.z / lom_radians_per_degree };
    char key[64], value[LOM_MAX_SETTING], n[6][32];
    for (int i = 0; i < 6; i++)
        lom_print_double(n[i], numbers[i]);
    snprintf(key, sizeof key, "entity.%zu.key", pilot->entity);
    snprintf(value, sizeof value, "[{ time = 0, position = [%s, %s, %s], rotation = [%s, %s, %s] }]", n[0], n[1], n[2],
             n[3], n[4], n[5]);
    return lom_set_setting(&view->settings, key, value);
}

void lom_step_pilot(struct lom_view *view, double seconds)
{
    struct lom_pilot *pilot = &view->pilot;
    bool is_free = !view->menu->is_open; /* else they are the menu's */
    double turning = is_free ? lom_pull_of_keys(view, LOM_VIEW_RIGHT, LOM_VIEW_LEFT) : 0;
    double rising = is_free ? lom_pull_of_keys(view, LOM_VIEW_UP, LOM_VIEW_DOWN) : 0;
    double faster = is_free ? lom_pull_of_keys(view, LOM_VIEW_PAGE_UP, LOM_VIEW_PAGE_DOWN) : 0;
    if (turning != 0 || rising != 0 || faster != 0) {
        if (!lom_take_controls(view)) {
            view->held[LOM_VIEW_RIGHT] = view->held[LOM_VIEW_LEFT] = view->held[LOM_VIEW_UP] = false;
            view->held[LOM_VIEW_DOWN] = view->held[LOM_VIEW_PAGE_UP] = view->held[LOM_VIEW_PAGE_DOWN] = false;
            return;
        }
        view->runs = true; /* nobody steers what stands */
    }
    if (!pilot->flies || !view->runs)
        return;
    pilot->turning = turning;
    pilot->rising = rising;
    pilot->speed = lom_smaller(lom_larger(pilot->speed * (1 + faster * seconds), 1), 1000);
    lom_fly(pilot, seconds);
    view->has_changed = place(view);
    view->moves = true;
}

/* ---- the sun ---- */

/* From direction = (-sin a cos e, -sin e, cos a cos e). */
static void take_sun(struct lom_view *view)
{
    lom_vec3 way = lom_scene_light_at(view->scene, view->time).direction;
    view->sun.azimuth = lom_double_atan2(-way.x, way.z) / lom_radians_per_degree;
    view->sun.elevation = lom_double_asin(lom_smaller(lom_larger(-way.y, -1), 1)) / lom_radians_per_degree;
    view->sun.moved = true;
}

/* The whole table, so that it has neither a direction nor key frames beside these angles. */
static bool place_sun(struct lom_view *view)
{
    lom_light light = lom_scene_light_at(view->scene, view->time);
    const double *const colors[] = { light.color, light.ambient, light.ground };
    const double numbers[] = { view->sun.azimuth, view->sun.elevation, light.intensity };
    char text[LOM_MAX_SETTING], v[3][3][32], n[3][32];
    for (int i = 0; i < 3; i++) {
        lom_print_double(n[i], numbers[i]);
        for (int c = 0; c < 3; c++)
            lom_print_double(v[i][c], colors[i][c]);
    }
    snprintf(text, sizeof text,
             "{ azimuth = %s, elevation = %s, intensity = %s, color = [%s, %s, %s], ambient = [%s, %s, %s], "
             "ground = [%s, %s, %s] }",
             n[0], n[1], n[2], v[0][0], v[0][1], v[0][2], v[1][0], v[1][1], v[1][2], v[2][0], v[2][1], v[2][2]);
    return lom_set_setting(&view->settings, "light", text);
}

void lom_step_sun(struct lom_view *view, double seconds)
{
    static const double by_hand = 30, alone = 10; /* degrees a second */
    struct lom_moved_sun *sun = &view->sun;
    double around = by_hand * lom_pull_of_keys(view, 'l', 'j') + (sun->goes ? alone : 0),
           up = by_hand * lom_pull_of_keys(view, 'i', 'k');
    if (around == 0 && up == 0)
        return;
    if (!sun->moved)
        take_sun(view);
    sun->azimuth += around * seconds;
    if (lom_magnitude(sun->azimuth) > 360)
        sun->azimuth += sun->azimuth > 0 ? -360 : 360;
    sun->elevation = lom_smaller(lom_larger(sun->elevation + up * seconds, -90), 90);
    view->has_changed = place_sun(view);
    view->moves = true;
}

/* ---- back ---- */

void lom_give_back(struct lom_view *view)
{
    char key[64];
    snprintf(key, sizeof key, "entity.%zu.key", view->pilot.entity);
    lom_drop_setting(&view->settings, "light");
    if (view->pilot.flies)
        lom_drop_setting(&view->settings, key);
    view->has_changed = view->has_changed || view->sun.moved || view->pilot.flies;
    view->sun = (struct lom_moved_sun){ .moved = false };
    view->pilot = (struct lom_pilot){ .flies = false };
    lom_choose_eye(view, LOM_EYE_SCENE, 0);
}
