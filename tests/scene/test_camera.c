/* Proves that the camera of a scene is where closed forms say: yaw, pitch and roll against matrices written out here,
 * paths against polynomials that the interpolation must reproduce. */
#include "check.h"

#include <lom/scene.h>

#define PI 3.14159265358979323846

static lom_scene *decode(const char *text)
{
    lom_error error = { 0 };
    lom_scene *scene = lom_decode_scene(text, strlen(text), "camera.toml", NULL, 0, &error);
    CHECK(scene != NULL, "%s", error.text);
    return scene;
}

static double distance(lom_vec3 a, lom_vec3 b)
{
    double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return lom_double_sqrt(x * x + y * y + z * z);
}

/* R v for R = rotation by angle about axis 0, 1 or 2, right-handed. */
static lom_vec3 rotated(lom_vec3 v, int axis, double degrees)
{
    double c = lom_double_cos(degrees * PI / 180), s = lom_double_sin(degrees * PI / 180);
    if (axis == 0)
        return (lom_vec3){ v.x, c * v.y - s * v.z, s * v.y + c * v.z };
    if (axis == 1)
        return (lom_vec3){ c * v.x + s * v.z, v.y, c * v.z - s * v.x };
    return (lom_vec3){ c * v.x - s * v.y, s * v.x + c * v.y, v.z };
}

static lom_vec3 turned(lom_vec3 v, double yaw, double pitch, double roll)
{
    return rotated(rotated(rotated(v, 2, roll), 0, pitch), 1, yaw);
}

static void yaw_pitch_roll(void)
{
    for (double yaw = -180; yaw <= 180; yaw += 60) {
        for (double pitch = -90; pitch <= 90; pitch += 30) {
            for (double roll = -90; roll <= 90; roll += 45) {
                char text[200];
                snprintf(text, sizeof text, "[camera]\nposition=[1,2,3]\nyaw=%g\npitch=%g\nroll=%g", yaw, pitch, roll);
                lom_scene *scene = decode(text);
                if (scene == NULL)
                    continue;
                lom_camera_view view = lom_scene_camera_at(scene, 5);
                lom_vec3 forward = turned((lom_vec3){ 0, 0, -1 }, yaw, pitch, roll);
                lom_vec3 target = { 1 + forward.x, 2 + forward.y, 3 + forward.z };
                CHECK(distance(view.target, target) < 1e-14, "%s", text);
                CHECK(distance(view.up, turned((lom_vec3){ 0, 1, 0 }, yaw, pitch, roll)) < 1e-14, "%s", text);
                lom_free_scene(scene);
            }
        }
    }
}

/* A roll with a target: up stays upright to the view and turns by the angle. */
static void roll_with_target(void)
{
    lom_scene *scene = decode("[camera]\nposition=[0,0,10]\ntarget=[0,0,0]\nroll=90\nup=[0.1,3,0.7]");
    if (scene == NULL)
        return;
    double length = lom_double_sqrt(0.1 * 0.1 + 3 * 3);
    CHECK(distance(scene->camera.up, (lom_vec3){ -3 / length, 0.1 / length, 0 }) < 1e-15);
    lom_free_scene(scene);
}

static void sun(void)
{
    static const struct {
        double azimuth, elevation;
        lom_vec3 towards;
    } cases[] = { { 0, 0, { 0, 0, -1 } },   { 90, 0, { 1, 0, 0 } },  { 180, 0, { 0, 0, 1 } },
                  { 270, 0, { -1, 0, 0 } }, { 33, 90, { 0, 1, 0 } }, { 90, 30, { 0.86602540378443864676, 0.5, 0 } } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[100];
        snprintf(text, sizeof text, "light = {azimuth = %g, elevation = %g}", cases[i].azimuth, cases[i].elevation);
        lom_scene *scene = decode(text);
        if (scene == NULL)
            continue;
        lom_vec3 d = scene->light.direction;
        CHECK(distance((lom_vec3){ -d.x, -d.y, -d.z }, cases[i].towards) < 1e-15, "%s", text);
        lom_free_scene(scene);
    }
}

/* A scene with keys at the given times on the path position = (c0 + c1 t + c2 t^2, ...), seen towards z = -100. */
static lom_scene *path_scene(const char *interpolation, const double *times, size_t count, const double c[3])
{
    char text[2000];
    size_t used = (size_t)snprintf(text, sizeof text, "[camera]\ninterpolation='%s'\n", interpolation);
    for (size_t i = 0; i < count; i++) {
        double t = times[i], p = c[0] + c[1] * t + c[2] * t * t;
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "[[camera.key]]\ntime=%.17g\nposition=[%.17g,%.17g,0]\ntarget=[0,%.17g,-100]\n"
                                 "field_of_view=%.17g\n",
                                 t, p, -p, 2 * p, 40 + p / 10);
    }
    return decode(text);
}

static void check_polynomial(const lom_scene *scene, const double c[3], double t)
{
    lom_camera_view view = lom_scene_camera_at(scene, t);
    double p = c[0] + c[1] * t + c[2] * t * t;
    CHECK(distance(view.position, (lom_vec3){ p, -p, 0 }) < 1e-12, "t = %g: %.17g, expected %.17g", t, view.position.x,
          p);
    CHECK(distance(view.target, (lom_vec3){ 0, 2 * p, -100 }) < 1e-12, "t = %g", t);
    CHECK(__builtin_fabs(view.field_of_view - (40 + p / 10) * PI / 180) < 1e-14, "t = %g", t);
}

static void polynomials_are_reproduced(void)
{
    static const double times[] = { -1, 0, 0.5, 2.25, 3, 7 };
    static const double line[] = { 1, -2, 0 }, parabola[] = { 1, -2, 0.75 };
    lom_scene *linear = path_scene("linear", times, 6, line), *smooth = path_scene("smooth", times, 6, parabola);
    lom_scene *three = path_scene("smooth", times, 3, parabola), *two = path_scene("smooth", times, 2, line);
    if (linear == NULL || smooth == NULL || three == NULL || two == NULL)
        return;
    for (double t = -1; t <= 7; t += 0.03125) {
        check_polynomial(linear, line, t);
        check_polynomial(smooth, parabola, t);
        if (t <= 0.5)
            check_polynomial(three, parabola, t);
        if (t <= 0)
            check_polynomial(two, line, t);
    }
    lom_free_scene(linear);
    lom_free_scene(smooth);
    lom_free_scene(three);
    lom_free_scene(two);
}

/* Equal intervals: the value half way between the inner two of four keys is (-p0 + 9 p1 + 9 p2 - p3) / 16, as of the
 * uniform Catmull-Rom spline (Catmull and Rom 1974). */
static void uniform_keys_are_catmull_rom(void)
{
    lom_scene *scene = decode("[camera]\ninterpolation='smooth'\ntarget=[0,0,-9]\n"
                              "[[camera.key]]\ntime=0\nposition=[3,0,0]\n[[camera.key]]\ntime=2\nposition=[-5,1,0]\n"
                              "[[camera.key]]\ntime=4\nposition=[8,0,2]\n[[camera.key]]\ntime=6\nposition=[1,7,0]\n");
    if (scene == NULL)
        return;
    lom_vec3 expected = { (-3 - 45 + 72 - 1) / 16.0, (9 - 7) / 16.0, 18 / 16.0 };
    CHECK(distance(lom_scene_camera_at(scene, 3).position, expected) < 1e-15);
    lom_free_scene(scene);
}

static void keys_and_ends_are_exact(void)
{
    static const double times[] = { 1, 2, 4 }, c[] = { 0.1, 0.7, -0.3 };
    static const char *const kinds[] = { "linear", "smooth" };
    for (int k = 0; k < 2; k++) {
        lom_scene *scene = path_scene(kinds[k], times, 3, c);
        if (scene == NULL)
            continue;
        for (size_t i = 0; i < 3; i++) {
            lom_camera_view view = lom_scene_camera_at(scene, times[i]);
            CHECK(memcmp(&view.position, &scene->camera.keys[i].position, sizeof view.position) == 0, "key %zu", i);
            CHECK(view.field_of_view == scene->camera.keys[i].field_of_view, "key %zu", i);
        }
        lom_camera_view before = lom_scene_camera_at(scene, -1e300), after = lom_scene_camera_at(scene, 1e300);
        lom_camera_view never = lom_scene_camera_at(scene, __builtin_nan(""));
        CHECK(before.position.x == scene->camera.keys[0].position.x);
        CHECK(after.position.x == scene->camera.keys[2].position.x);
        CHECK(never.position.x == scene->camera.keys[0].position.x, "no time at all is the first key");
        lom_free_scene(scene);
    }
}

/* A curve that swings out between extreme angles stays inside what a projection can have. */
static void angles_stay_possible(void)
{
    lom_scene *scene =
        decode("[camera]\ninterpolation='smooth'\n"
               "[[camera.key]]\ntime=0\nfield_of_view=179\n[[camera.key]]\ntime=1\nfield_of_view=0.01\n"
               "[[camera.key]]\ntime=2\nfield_of_view=0.01\n[[camera.key]]\ntime=3\nfield_of_view=179\n");
    if (scene == NULL)
        return;
    for (double t = 0; t < 3; t += 0.01) {
        double angle = lom_scene_camera_at(scene, t).field_of_view;
        CHECK(angle >= 0.0099 * PI / 180 && angle < PI, "t = %g: %g", t, angle);
    }
    lom_free_scene(scene);
}

/* A file is needed to name a mesh; this test's own will do, since nothing loads it. */
static lom_scene *decode_flight(const char *camera)
{
    char text[1600];
    snprintf(text, sizeof text,
             "[camera]\nfollow='plane'\n%s\n[[entity]]\nname='tree'\nmesh='%s'\n[[entity]]\nname='plane'\nmesh='%s'\n"
             "[[entity.key]]\ntime=1\nposition=[10,20,30]\nrotation=[0,90,0]\n"
             "[[entity.key]]\ntime=3\nposition=[30,20,30]\nrotation=[20,90,40]\n",
             camera, __FILE__, __FILE__);
    return decode(text);
}

static void entities_follow_their_keys(void)
{
    lom_scene *scene = decode_flight("position=[0,2,10]");
    if (scene == NULL)
        return;
    lom_entity_place place = lom_scene_entity_at(&scene->entities[1], 2);
    CHECK(distance(place.position, (lom_vec3){ 20, 20, 30 }) < 1e-12, "x %g", place.position.x);
    CHECK(distance(place.rotation, (lom_vec3){ 10 * PI / 180, PI / 2, 20 * PI / 180 }) < 1e-12, "y %g",
          place.rotation.y);
    for (double t = -3; t < 9; t += 4) {
        place = lom_scene_entity_at(&scene->entities[0], t);
        CHECK(distance(place.position, scene->entities[0].position) == 0 &&
                  distance(place.rotation, scene->entities[0].rotation) == 0,
              "one without keys stands still");
    }
    place = lom_scene_entity_at(&scene->entities[1], 9);
    CHECK(distance(place.position, (lom_vec3){ 30, 20, 30 }) == 0, "after the last key");
    lom_free_scene(scene);
}

/* Turned by 90 degrees about y the nose (-z) points along -x: what is 10 behind is at +x. */
static void third_person_turns_with_the_heading_alone(void)
{
    lom_scene *scene = decode_flight("position=[0,2,10]\ntarget=[1,0,-5]");
    if (scene == NULL)
        return;
    for (double t = 1; t <= 3; t += 1) {
        lom_camera_view view = lom_scene_camera_at(scene, t);
        double x = 10 * t;
        CHECK(view.position.y == 22 && view.up.x == 0 && view.up.y == 1 && view.up.z == 0, "upright at %g", t);
        if (t == 1) {
            CHECK(distance(view.position, (lom_vec3){ x + 10, 22, 30 }) < 1e-12, "behind: %g %g", view.position.x,
                  view.position.z);
            CHECK(distance(view.target, (lom_vec3){ x - 5, 20, 29 }) < 1e-12, "ahead: %g %g", view.target.x,
                  view.target.z);
        }
        double dx = view.position.x - x, dz = view.position.z - 30;
        CHECK(lom_double_sqrt(dx * dx + dz * dz) - 10 < 1e-12, "ten metres behind at %g", t);
    }
    lom_free_scene(scene);
}

static void first_person_turns_with_all_of_it(void)
{
    lom_scene *scene = decode_flight("position=[0,1,0]\ntarget=[0,1,-1]\nperson='first'");
    if (scene == NULL)
        return;
    lom_camera_view view = lom_scene_camera_at(scene, 3);
    lom_mat4 m = lom_model_matrix((lom_vec3){ 30, 20, 30 }, (lom_vec3){ 20 * PI / 180, PI / 2, 40 * PI / 180 },
                                  (lom_vec3){ 1, 1, 1 });
    CHECK(distance(view.position, lom_transform_point(&m, (lom_vec3){ 0, 1, 0 })) < 1e-12, "the eye");
    CHECK(distance(view.target, lom_transform_point(&m, (lom_vec3){ 0, 1, -1 })) < 1e-12, "ahead");
    CHECK(distance(view.up, lom_transform_direction(&m, (lom_vec3){ 0, 1, 0 })) < 1e-12, "rolled");
    lom_free_scene(scene);
}

/* The reference work's sun: an angle of 0.01 rad a step in the plane of x and y. */
static void the_sun_goes_straight_from_key_to_key(void)
{
    lom_scene *scene = decode("[light]\nazimuth=90\ncolor=[1,0.5,0.25]\n[[light.key]]\ntime=0\nelevation=0\n"
                              "[[light.key]]\ntime=10\nelevation=90\nintensity=3\n");
    if (scene == NULL)
        return;
    for (int i = 0; i <= 10; i++) {
        lom_light light = lom_scene_light_at(scene, i);
        double angle = i * PI / 20;
        lom_vec3 expected = { -lom_double_cos(angle), -lom_double_sin(angle), 0 };
        CHECK(distance(light.direction, expected) < 1e-12, "at %d", i);
        CHECK(light.color[1] == 0.5 && light.intensity - (1 + 0.2 * i) < 1e-12, "at %d: %g", i, light.intensity);
    }
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    RUN(entities_follow_their_keys);
    RUN(third_person_turns_with_the_heading_alone);
    RUN(first_person_turns_with_all_of_it);
    RUN(the_sun_goes_straight_from_key_to_key);
    RUN(yaw_pitch_roll);
    RUN(roll_with_target);
    RUN(sun);
    RUN(polynomials_are_reproduced);
    RUN(uniform_keys_are_catmull_rom);
    RUN(keys_and_ends_are_exact);
    RUN(angles_stay_possible);
    return check_result();
}
