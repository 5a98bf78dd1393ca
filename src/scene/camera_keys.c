/* The table of the scene file's [camera] keys and its check. In: the members as the file gives them. Out: where the
 * camera looks and what is up, of unit length. Invariant: afterwards the camera can look where it is told to, at every
 * key. */
#include "scene/direction.h"
#include "scene/scene_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static const double right_angle_limit = 1e-6; /* least sine between a direction of view and up */

static lom_vec3 combine(double a, lom_vec3 u, double b, lom_vec3 v)
{
    return (lom_vec3){ a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z };
}

/* Direction of view and up of a camera with M = Ry(yaw) Rx(pitch) Rz(roll), which looks along its -z. */
static void aim(lom_camera *camera)
{
    double sy = lom_double_sin(camera->yaw), cy = lom_double_cos(camera->yaw);
    double sp = lom_double_sin(camera->pitch), cp = lom_double_cos(camera->pitch);
    lom_vec3 forward = { -sy * cp, sp, -cy * cp };
    camera->target = combine(1, camera->position, 1, forward);
    camera->up = (lom_vec3){ sy * sp, cp, cy * sp };
}

/* True when a camera can look from position to target with this up. */
static bool can_look(lom_vec3 position, lom_vec3 target, lom_vec3 up)
{
    lom_vec3 forward = combine(1, target, -1, position);
    if (!lom_make_unit(&forward) || !lom_make_unit(&up))
        return false;
    lom_vec3 side = lom_vec3_cross(forward, up);
    return side.x * side.x + side.y * side.y + side.z * side.z > right_angle_limit * right_angle_limit;
}

/* Turns up about the direction of view: column y of the camera's matrix times Rz(roll). */
static void roll(lom_camera *camera)
{
    lom_vec3 forward = combine(1, camera->target, -1, camera->position);
    lom_make_unit(&forward);
    lom_vec3 side = lom_vec3_cross(forward, camera->up);
    lom_make_unit(&side);
    camera->up =
        combine(-lom_double_sin(camera->roll), side, lom_double_cos(camera->roll), lom_vec3_cross(side, forward));
}

static bool check_keys(const lom_camera *camera, const lom_key_check *check)
{
    for (size_t i = 0; i < camera->key_count; i++) {
        const lom_key_check at = check->element(check, "key", i);
        lom_camera_key *key = &camera->keys[i];
        if (!at.is_given(&at, "position"))
            key->position = camera->position;
        if (!at.is_given(&at, "target"))
            key->target = camera->target;
        if (!at.is_given(&at, "field_of_view"))
            key->field_of_view = camera->field_of_view;
        if (!at.is_given(&at, "height"))
            key->height = camera->height;
        if (i > 0 && !lom_check_rising_time(&at, camera->keys[i - 1].time, key->time))
            return false;
        if (!can_look(key->position, key->target, camera->up))
            return at.fail(&at, "target", "the camera cannot look there: target is its position, or lies along up.");
    }
    return true;
}

/* Keys of another projection are not looked at, so that one key changes it. */
static bool check_projection(const lom_camera *camera, const lom_key_check *check)
{
    return camera->projection == LOM_PROJECTION_PERSPECTIVE || camera->far_plane > camera->near_plane ||
           check->fail(check, check->is_given(check, "far") ? "far" : "near",
                       "the far plane of a parallel projection is to be beyond its near plane.");
}

static bool check_camera(void *members, const lom_key_check *check)
{
    lom_camera *camera = members;
    bool has_yaw = check->is_given(check, "yaw"), turned = has_yaw || check->is_given(check, "pitch");
    bool has_target = check->is_given(check, "target");
    if (turned && has_target)
        return check->fail(check, has_yaw ? "yaw" : "pitch",
                           "the camera has either a target or yaw and pitch, not both.");
    if (turned && check->is_given(check, "up"))
        return check->fail(check, "up", "yaw and pitch say what is up; use roll to turn the picture.");
    if (turned)
        aim(camera);
    if (!can_look(camera->position, camera->target, camera->up))
        return check->fail(check, has_target ? "target" : "position",
                           "the camera cannot look there: target is its position, or lies along up.");
    lom_make_unit(&camera->up);
    if (check->is_given(check, "roll"))
        roll(camera);
    return check_projection(camera, check) && check_keys(camera, check);
}

static const lom_key camera_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_camera_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e9, .maximum = 1e9,
      .unit = "s", .text = "When the camera is here; later than the key before." },
    { "position", LOM_KEY_NUMBER, AT(lom_camera_key, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where the camera is.", .initial_text = "the camera's" },
    { "target", LOM_KEY_NUMBER, AT(lom_camera_key, target), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "The point it looks at.", .initial_text = "the camera's" },
    { "field_of_view", LOM_KEY_ANGLE, AT(lom_camera_key, field_of_view), .minimum = 0.01, .maximum = 179,
      .unit = "degrees", .text = "Vertical angle of view.", .initial_text = "the camera's" },
    { "height", LOM_KEY_NUMBER, AT(lom_camera_key, height), .minimum = 1e-3, .maximum = 1e6, .unit = "m",
      .text = "Metres that the picture of a parallel projection is high.", .initial_text = "the camera's" },
};
static const lom_key_table camera_key_table = {
    .size = sizeof(lom_camera_key),
    .keys = camera_key,
    .key_count = COUNT(camera_key),
    .text = "A key frame of the camera's path. Before the first key and after the last the camera stands still."
};

static const lom_key camera[] = {
    { "position", LOM_KEY_NUMBER, AT(lom_camera, position), 3, .minimum = -1e9, .maximum = 1e9, .initial = { 0, 2, 10 },
      .unit = "m", .text = "Where the camera is." },
    { "target", LOM_KEY_NUMBER, AT(lom_camera, target), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "The point it looks at; instead of `yaw` and `pitch`." },
    { "yaw", LOM_KEY_ANGLE, AT(lom_camera, yaw), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Direction of view: 0 looks along -z, 90 along -x (counter-clockwise seen from above)." },
    { "pitch", LOM_KEY_ANGLE, AT(lom_camera, pitch), .minimum = -90, .maximum = 90, .unit = "degrees",
      .text = "Direction of view: positive looks up." },
    { "roll", LOM_KEY_ANGLE, AT(lom_camera, roll), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Turns the camera counter-clockwise about its direction of view, so the picture turns clockwise." },
    { "up", LOM_KEY_NUMBER, AT(lom_camera, up), 3, .initial = { 0, 1, 0 },
      .text = "What is upwards in the picture; not along the direction of view." },
    { "field_of_view", LOM_KEY_ANGLE, AT(lom_camera, field_of_view), .minimum = 0.01, .maximum = 179, .initial = { 45 },
      .unit = "degrees", .text = "Vertical angle of view." },
    { "near", LOM_KEY_NUMBER, AT(lom_camera, near_plane), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 0.1 },
      .unit = "m", .text = "Distance of the near plane. A perspective has no far plane." },
    { "projection", LOM_KEY_CHOICE, AT(lom_camera, projection), .choices = { "perspective", "orthographic", "oblique" },
      .text = "How the scene is laid on the picture (docs/cameras.md): by rays from an eye; by parallel rays straight "
              "ahead; by parallel rays at a slant." },
    { "height", LOM_KEY_NUMBER, AT(lom_camera, height), .minimum = 1e-3, .maximum = 1e6, .initial = { 20 }, .unit = "m",
      .text = "Metres that the picture of a parallel projection is high, instead of `field_of_view`." },
    { "far", LOM_KEY_NUMBER, AT(lom_camera, far_plane), .flags = LOM_KEY_ABOVE, .maximum = 1e7, .initial = { 10000 },
      .unit = "m",
      .text = "Distance of a parallel projection's far plane, behind which nothing is drawn; beyond `near`." },
    { "foreshortening", LOM_KEY_NUMBER, AT(lom_camera, foreshortening), .minimum = 0, .maximum = 4, .initial = { 0.5 },
      .text = "Oblique: length of what recedes, in parts of its own. 0.5 is a cabinet projection, 1 a cavalier one." },
    { "receding_angle", LOM_KEY_ANGLE, AT(lom_camera, receding_angle), .minimum = -360, .maximum = 360,
      .initial = { 45 }, .unit = "degrees",
      .text = "Oblique: where what recedes goes in the picture; 0 is right, 90 up." },
    { "interpolation", LOM_KEY_CHOICE, AT(lom_camera, interpolation), .choices = { "linear", "smooth" },
      .text = "Between the keys of a path: straight lines, or a Catmull-Rom curve through them." },
    { "key", LOM_KEY_TABLES, AT(lom_camera, keys), .table = &camera_key_table,
      .length_offset = AT(lom_camera, key_count), .text = "Key frames of a path." },
    { "follow", LOM_KEY_STRING, AT(lom_camera, follow),
      .text = "Name of an entity: `position`, `target`, `up` and the keys are then in its coordinates, whose -z is "
              "ahead." },
    { "person", LOM_KEY_CHOICE, AT(lom_camera, person), .choices = { "third", "first" },
      .text = "With `follow`: behind the entity, turned by its heading alone; or in it, turned as it is, without "
              "drawing it." },
};
const lom_key_table lom_camera_keys = { .size = sizeof(lom_camera),
                                        .keys = camera,
                                        .key_count = COUNT(camera),
                                        .text = "Where the picture is taken from.",
                                        .check = check_camera };
