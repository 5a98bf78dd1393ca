/* The eye of `lom view`. In: turns and moves. Out: a camera. Invariant: the camera that is drawn is the one that a scene
 * file with the printed numbers has, bit for bit; it can always look where it looks. */
#include "view_eye.h"

#include "base/numbers.h"

#include <stdio.h>

static const double steepest = 1.55; /* radians of pitch: a degree from the zenith */

static const lom_vec3 up = { 0, 1, 0 };

/* -z turned by Ry(yaw) Rx(pitch). */
static lom_vec3 direction(double yaw, double pitch)
{
    double cosine = lom_double_cos(pitch);
    return (lom_vec3){ -lom_double_sin(yaw) * cosine, lom_double_sin(pitch), -lom_double_cos(yaw) * cosine };
}

static double within(double value, double least, double most)
{
    return value < least ? least : value > most ? most : value;
}

static void look_along(struct lom_eye *eye, lom_vec3 along)
{
    along = lom_vec3_normalize(along);
    eye->yaw = lom_double_atan2(-along.x, -along.z);
    eye->pitch = within(lom_double_asin(within(along.y, -1, 1)), -steepest, steepest);
}

/* The scene's camera in the coordinates that it is given in. */
static lom_camera_view own_coordinates(const lom_scene *scene, const lom_camera *camera, double time)
{
    lom_scene alone = *scene;
    alone.camera = *camera;
    alone.camera.followed = 0;
    return lom_scene_camera_at(&alone, time);
}

struct lom_eye lom_make_eye(enum lom_eye_kind kind, size_t followed, const lom_scene *scene, const lom_camera *camera,
                            const lom_camera_view *seen, double time)
{
    struct lom_eye eye = { .kind = kind,
                           .distance = 1,
                           .degrees = seen->field_of_view / lom_radians_per_degree,
                           .height = seen->height,
                           .position = seen->position };
    if (kind == LOM_EYE_FREE) {
        look_along(&eye, lom_vec3_subtract(seen->target, seen->position));
        return eye;
    }
    eye.followed = followed;
    eye.position = kind == LOM_EYE_FIRST ? (lom_vec3){ 0, 1.2, -0.5 } : (lom_vec3){ 0, 4, 16 };
    eye.target = (lom_vec3){ 0, kind == LOM_EYE_FIRST ? 1.2 : 2, -12 };
    lom_person person = kind == LOM_EYE_FIRST ? LOM_PERSON_FIRST : LOM_PERSON_THIRD;
    if (camera->followed == followed && camera->person == person) {
        lom_camera_view own = own_coordinates(scene, camera, time);
        eye.position = own.position;
        eye.target = own.target;
    }
    if (kind == LOM_EYE_FIRST)
        look_along(&eye, lom_vec3_subtract(eye.target, eye.position));
    return eye;
}

void lom_eye_camera(const struct lom_eye *eye, lom_camera *camera)
{
    camera->position = eye->position;
    camera->target = lom_vec3_add(eye->position, lom_vec3_scale(direction(eye->yaw, eye->pitch), 10));
    if (eye->kind == LOM_EYE_THIRD) {
        lom_mat4 turn = lom_rotation((lom_vec3){ eye->pitch, 0, 0 });
        lom_mat4 around = lom_rotation((lom_vec3){ 0, eye->yaw, 0 });
        turn = lom_multiply(&around, &turn);
        camera->position = lom_transform_direction(&turn, lom_vec3_scale(eye->position, eye->distance));
        camera->target = lom_transform_direction(&turn, eye->target);
    }
    camera->up = up;
    camera->field_of_view = eye->degrees * lom_radians_per_degree;
    camera->height = eye->height;
    camera->key_count = 0;
    camera->followed = eye->followed;
    camera->person = eye->kind == LOM_EYE_FIRST ? LOM_PERSON_FIRST : LOM_PERSON_THIRD;
}

lom_camera_view lom_eye_view(const struct lom_eye *eye, const lom_scene *scene, double time)
{
    lom_scene moved = *scene;
    if (eye->kind != LOM_EYE_SCENE)
        lom_eye_camera(eye, &moved.camera);
    return lom_scene_camera_at(&moved, time);
}

static size_t print_number(char *text, size_t room, const char *before, double value)
{
    char number[32];
    lom_print_double(number, value);
    int length = snprintf(text, room, "%s%s", before, number);
    return length < 0 || (size_t)length >= room ? 0 : (size_t)length;
}

static size_t print_place(char *text, size_t room, const char *before, lom_vec3 place)
{
    size_t used = print_number(text, room, before, place.x);
    used += print_number(text + used, room - used, ", ", place.y);
    used += print_number(text + used, room - used, ", ", place.z);
    return used;
}

/* The keys of a parallel projection. */
static size_t print_projection(char *text, size_t room, const lom_camera *camera)
{
    if (camera->projection == LOM_PROJECTION_PERSPECTIVE)
        return 0;
    const bool is_oblique = camera->projection == LOM_PROJECTION_OBLIQUE;
    size_t used = print_number(
        text, room, is_oblique ? ", projection = \"oblique\", height = " : ", projection = \"orthographic\", height = ",
        camera->height);
    used += print_number(text + used, room - used, ", far = ", camera->far_plane);
    if (!is_oblique)
        return used;
    used += print_number(text + used, room - used, ", foreshortening = ", camera->foreshortening);
    return used + print_number(text + used, room - used,
                               ", receding_angle = ", camera->receding_angle / lom_radians_per_degree);
}

size_t lom_print_eye(char *text, size_t room, const struct lom_eye *eye, const char *name, const lom_scene *scene,
                     const lom_camera *like)
{
    lom_camera camera = *like;
    lom_eye_camera(eye, &camera);
    if (name == NULL) {
        camera.position = lom_place_in_file(scene, camera.position);
        camera.target = lom_place_in_file(scene, camera.target);
    }
    size_t used = print_place(text, room, "{ position = [", camera.position);
    used += print_place(text + used, room - used, "], target = [", camera.target);
    used += print_number(text + used, room - used, "], field_of_view = ", eye->degrees);
    used += print_number(text + used, room - used, ", near = ", camera.near_plane);
    used += print_projection(text + used, room - used, &camera);
    int length = snprintf(text + used, room - used, name != NULL ? ", follow = \"%s\", person = \"%s\" }" : " }", name,
                          camera.person == LOM_PERSON_FIRST ? "first" : "third");
    return length < 0 || (size_t)length >= room - used ? used : used + (size_t)length;
}

/* A third person whose line of sight is upright cannot look. */
static bool can_look(const struct lom_eye *eye)
{
    lom_camera camera = { .near_plane = 1 };
    lom_eye_camera(eye, &camera);
    lom_vec3 along = lom_vec3_normalize(lom_vec3_subtract(camera.target, camera.position));
    return lom_magnitude(along.y) < lom_double_sin(steepest + 0.01) && lom_vec3_length(along) > 0.5;
}

void lom_turn_eye(struct lom_eye *eye, double left, double above)
{
    struct lom_eye before = *eye;
    eye->yaw += left;
    if (lom_magnitude(eye->yaw) > lom_pi)
        eye->yaw += eye->yaw > 0 ? -lom_two_pi : lom_two_pi;
    eye->pitch = within(eye->pitch + above, -steepest, steepest);
    if (!can_look(eye))
        *eye = before;
}

void lom_move_eye(struct lom_eye *eye, double ahead, double right, double above)
{
    if (eye->kind == LOM_EYE_THIRD) {
        lom_turn_eye(eye, 0.01 * right, -0.01 * above); /* an arc as long as the step ahead */
        struct lom_eye before = *eye;
        eye->distance = within(eye->distance * (1 - 0.01 * within(ahead, -50, 50)), 0.1, 100);
        if (!can_look(eye))
            *eye = before;
        return;
    }
    lom_vec3 forward = direction(eye->yaw, eye->pitch), side = direction(eye->yaw - 0.5 * lom_pi, 0);
    eye->position = lom_vec3_add(eye->position, lom_vec3_scale(forward, ahead));
    eye->position = lom_vec3_add(eye->position, lom_vec3_scale(side, right));
    eye->position.y += above;
}

void lom_zoom_eye(struct lom_eye *eye, double factor)
{
    eye->degrees = within(eye->degrees * factor, 1, 150);
    eye->height = within(eye->height * factor, 1e-3, 1e6);
}
