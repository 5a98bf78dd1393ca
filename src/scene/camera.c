/* The camera, the light, the lamps and the entities at a time. In: the scene's key frames and a time. Out: position, target and
 * angle; direction and colour; position and rotation. Invariant: functions of the time alone. */
#include "base/numbers.h"
#include "scene/direction.h"
#include "scene/key_frames.h"

#include <lom/scene.h>

lom_entity_place lom_scene_entity_at(const lom_entity *entity, double time)
{
    lom_entity_place place = { entity->position, entity->rotation };
    if (entity->key_count == 0)
        return place;
    double v[6];
    lom_follow_keys(&(struct lom_key_frames){ entity->keys, sizeof *entity->keys, entity->key_count,
                                              offsetof(lom_entity_key, time), 6,
                                              entity->interpolation == LOM_INTERPOLATION_SMOOTH },
                    time, v);
    return (lom_entity_place){ { v[0], v[1], v[2] }, { v[3], v[4], v[5] } };
}

lom_light lom_scene_light_at(const lom_scene *scene, double time)
{
    lom_light light = scene->light;
    if (light.key_count == 0)
        return light;
    double v[6];
    lom_follow_keys(&(struct lom_key_frames){ light.keys, sizeof *light.keys, light.key_count,
                                              offsetof(lom_light_key, time), 6, false },
                    time, v);
    lom_float_state state;
    lom_enter_float_state(&state);
    light.azimuth = v[0];
    light.elevation = v[1];
    light.direction = lom_sunlight_direction(v[0], v[1]);
    lom_leave_float_state(&state);
    for (int i = 0; i < 3; i++)
        light.color[i] = v[2 + i];
    light.intensity = v[5];
    return light;
}

lom_lamp lom_scene_lamp_at(const lom_lamp *lamp, double time)
{
    lom_lamp at = *lamp;
    if (at.key_count == 0)
        return at;
    double v[7];
    lom_follow_keys(&(struct lom_key_frames){ at.keys, sizeof *at.keys, at.key_count, offsetof(lom_lamp_key, time), 7,
                                              at.interpolation == LOM_INTERPOLATION_SMOOTH },
                    time, v);
    lom_float_state state;
    lom_enter_float_state(&state);
    at.position = (lom_vec3){ v[0], v[1], v[2] };
    lom_vec3 direction = { v[3], v[4], v[5] };
    if (lom_make_unit(&direction))
        at.direction = direction;
    at.intensity = v[6] > 0 ? v[6] : 0; /* a smooth curve may overshoot */
    lom_leave_float_state(&state);
    return at;
}

lom_vec3 lom_sunlight_direction(double azimuth, double elevation)
{
    double sa = lom_double_sin(azimuth), ca = lom_double_cos(azimuth);
    double se = lom_double_sin(elevation), ce = lom_double_cos(elevation);
    return (lom_vec3){ -sa * ce, -se, ca * ce };
}

/* From the coordinates of an entity to the world: all of its rotation, or the heading of its nose (-z) alone. A nose
 * that points straight up or down heads along -z. */
static lom_mat4 follow(const lom_entity *entity, double time, bool all)
{
    lom_entity_place place = lom_scene_entity_at(entity, time);
    lom_mat4 turn = lom_rotation(place.rotation), move = lom_translation(place.position);
    if (!all) {
        double x = -turn.m[0][2], z = -turn.m[2][2], length = lom_double_sqrt(x * x + z * z);
        x = length > 1e-9 ? x / length : 0;
        z = length > 1e-9 ? z / length : -1;
        turn = (lom_mat4){ { { -z, 0, -x, 0 }, { 0, 1, 0, 0 }, { x, 0, -z, 0 }, { 0, 0, 0, 1 } } };
    }
    return lom_multiply(&move, &turn);
}

static bool is_perspective(const lom_camera_view *camera)
{
    return camera->projection == LOM_PROJECTION_PERSPECTIVE;
}

static const double least_height = 1e-3; /* metres; a smooth curve may overshoot */

static void follow_keys(const lom_camera *camera, double time, lom_camera_view *view)
{
    double v[8];
    lom_follow_keys(&(struct lom_key_frames){ camera->keys, sizeof *camera->keys, camera->key_count,
                                              offsetof(lom_camera_key, time), 8,
                                              camera->interpolation == LOM_INTERPOLATION_SMOOTH },
                    time, v);
    view->position = (lom_vec3){ v[0], v[1], v[2] };
    view->target = (lom_vec3){ v[3], v[4], v[5] };
    double least = 0.01 * lom_radians_per_degree,
           greatest = 179 * lom_radians_per_degree; /* a smooth curve may overshoot */
    view->field_of_view = v[6] < least ? least : v[6] > greatest ? greatest : v[6];
    if (!is_perspective(view))
        view->height = v[7] < least_height ? least_height : v[7];
}

/* ---- what pictures are made by ---- */

lom_mat4 lom_camera_projection(const lom_camera_view *c, double aspect)
{
    if (is_perspective(c))
        return lom_perspective(c->field_of_view, aspect, c->near_plane);
    if (c->projection == LOM_PROJECTION_ORTHOGRAPHIC)
        return lom_orthographic(c->height * aspect, c->height, c->near_plane, c->far_plane);
    return lom_oblique(c->height * aspect, c->height, c->near_plane, c->far_plane, c->shear[0], c->shear[1]);
}

/* The ray through the middle goes (-right, -up, 1) a metre ahead: it meets the target when it starts so much right and
 * up of the position as that comes to over the way. */
lom_vec3 lom_camera_eye(const lom_camera_view *c)
{
    if (c->projection != LOM_PROJECTION_OBLIQUE)
        return c->position;
    lom_mat4 look = lom_look_at(c->position, c->target, c->up);
    double away = lom_vec3_length(lom_vec3_subtract(c->target, c->position));
    lom_vec3 right = { look.m[0][0], look.m[0][1], look.m[0][2] }, up = { look.m[1][0], look.m[1][1], look.m[1][2] };
    lom_vec3 shift = lom_vec3_add(lom_vec3_scale(right, c->shear[0] * away), lom_vec3_scale(up, c->shear[1] * away));
    return lom_vec3_add(c->position, shift);
}

lom_mat4 lom_camera_look(const lom_camera_view *c)
{
    lom_mat4 look = lom_look_at(c->position, c->target, c->up);
    if (c->projection == LOM_PROJECTION_OBLIQUE) {
        lom_vec3 eye = lom_camera_eye(c);
        for (int i = 0; i < 3; i++)
            look.m[i][3] = -(look.m[i][0] * eye.x + look.m[i][1] * eye.y + look.m[i][2] * eye.z);
    }
    return look;
}

double lom_camera_distance(const lom_camera_view *c, double depth)
{
    return is_perspective(c) ? c->near_plane / depth : c->far_plane - depth * (c->far_plane - c->near_plane);
}

static lom_camera_view camera_at(const lom_scene *scene, const lom_camera *camera, double time)
{
    lom_camera_view view = { .position = camera->position,
                             .target = camera->target,
                             .up = camera->up,
                             .field_of_view = camera->field_of_view,
                             .near_plane = camera->near_plane,
                             .projection = camera->projection };
    if (camera->projection != LOM_PROJECTION_PERSPECTIVE) {
        view.height = camera->height;
        view.far_plane = camera->far_plane;
    }
    if (camera->projection == LOM_PROJECTION_OBLIQUE) {
        lom_float_state state;
        lom_enter_float_state(&state);
        view.shear[0] = camera->foreshortening * lom_double_cos(camera->receding_angle);
        view.shear[1] = camera->foreshortening * lom_double_sin(camera->receding_angle);
        lom_leave_float_state(&state);
    }
    if (camera->key_count != 0)
        follow_keys(camera, time, &view);
    if (camera->followed != 0) {
        lom_float_state state;
        lom_enter_float_state(&state);
        lom_mat4 m = follow(&scene->entities[camera->followed - 1], time, camera->person == LOM_PERSON_FIRST);
        view.position = lom_transform_point(&m, view.position);
        view.target = lom_transform_point(&m, view.target);
        view.up = lom_transform_direction(&m, view.up);
        lom_leave_float_state(&state);
    }
    return view;
}

lom_camera_view lom_scene_camera_at(const lom_scene *scene, double time)
{
    return camera_at(scene, &scene->camera, time);
}

lom_camera_view lom_scene_view_camera_at(const lom_scene *scene, const lom_picture_view *view, double time)
{
    return camera_at(scene, &view->camera, time);
}
