/* Proves of clouds in the reference's pictures: Beer and Lambert through a uniform cloud, in front of the sky and on
 * the way to the ground; the furnace; the wind's way; and that quality.clouds = "reference" shows them. */
#include "check.h"
#include "scene_files.h"

#include <lom/render.h>

enum { WIDTH = 16, HEIGHT = 9 };

/* A uniform cloud of 100 x 80 x 60 m, of extinction 0.01 / m, 50 m over the origin; what a test adds goes before. */
#define CLOUD                                                                                                          \
    "[[cloud]]\nfile = \"full.raw\"\nvoxels = [2, 2, 2]\nposition = [0, 50, 0]\nsize = [100, 80, 60]\n"                \
    "extinction = 0.01\ndetail = 0\n"
#define SKY "sky.color = [0.5, 0.25, 1]\noutput.format = \"rgb32f\"\nquality.clouds = \"reference\"\n"

static lom_vec3 trace_ray(const char *text, lom_vec3 from, lom_vec3 d, double time)
{
    lom_scene *scene = make_scene(text);
    lom_reference *reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    lom_vec3 light = { -1, -1, -1 };
    if (reference != NULL)
        light = lom_trace_ray(reference, from, d, 0, time, 4);
    lom_free_reference(reference);
    lom_free_scene(scene);
    return light;
}

static bool is_near(double a, double b)
{
    return __builtin_fabs(a - b) < 1e-12;
}

/* All that a cloud without albedo does is to take light: exp(-0.01 l) of it is left after l metres. */
static void absorbing_clouds_follow_beer_and_lambert(void)
{
    const char *along = SKY "[clouds]\nalbedo = 0\n" CLOUD, *turned = SKY "[clouds]\nalbedo = 0\n" CLOUD "yaw = 90\n";
    lom_vec3 by_z = trace_ray(along, (lom_vec3){ 3, 90, 500 }, (lom_vec3){ 0, 0, -1 }, 0);
    lom_vec3 by_x = trace_ray(along, (lom_vec3){ 300, 90, 5 }, (lom_vec3){ -1, 0, 0 }, 0);
    lom_vec3 yawed = trace_ray(turned, (lom_vec3){ 3, 90, 500 }, (lom_vec3){ 0, 0, -1 }, 0);
    lom_vec3 from_inside = trace_ray(along, (lom_vec3){ 3, 90, 0 }, (lom_vec3){ 0, 0, -1 }, 0);
    lom_vec3 beside = trace_ray(along, (lom_vec3){ 300, 90, 500 }, (lom_vec3){ 0, 0, -1 }, 0);
    CHECK(is_near(by_z.z, lom_double_exp(-0.6)) && is_near(by_z.x, 0.5 * lom_double_exp(-0.6)), "%.17g", by_z.z);
    CHECK(is_near(by_x.z, lom_double_exp(-1.0)), "%.17g", by_x.z);
    CHECK(is_near(yawed.z, lom_double_exp(-1.0)), "%.17g", yawed.z);
    CHECK(is_near(from_inside.z, lom_double_exp(-0.3)), "%.17g", from_inside.z);
    CHECK(beside.x == 0.5 && beside.y == 0.25 && beside.z == 1);
}

/* A cloud that is not visible is not there; another that shares its file is. */
static void invisible_clouds_are_not_there(void)
{
    const char *text =
        SKY "[clouds]\nalbedo = 0\n" CLOUD "visible = false\n" CLOUD "yaw = 90\n" CLOUD "visible = false\n";
    lom_vec3 one = trace_ray(text, (lom_vec3){ 3, 90, 500 }, (lom_vec3){ 0, 0, -1 }, 0);
    CHECK(is_near(one.z, lom_double_exp(-1.0)), "%.17g", one.z);
    const char *two =
        SKY "[clouds]\nalbedo = 0\n" CLOUD "yaw = 90\n[[cloud]]\nfile = \"full.raw\"\nvoxels = [2, 2, 2]\n"
            "position = [0, 50, -300]\nsize = [100, 80, 60]\nextinction = 0.01\ndetail = 0\n";
    lom_vec3 both = trace_ray(two, (lom_vec3){ 3, 90, 500 }, (lom_vec3){ 0, 0, -1 }, 0);
    CHECK(is_near(both.z, lom_double_exp(-1.6)), "%.17g", both.z);
}

/* The sun overhead through 80 m of cloud: exp(-0.8) of its light is left on the ground, all where the cloud is not. */
static void clouds_shadow_the_ground(void)
{
    const char *text = SKY "[light]\nelevation = 90\ncolor = [1, 1, 1]\nintensity = 1\nambient = [0, 0, 0]\n"
                           "[clouds]\nalbedo = 0\nshadow_strength = 1\n[[entity]]\nmesh = \"ground.obj\"\n" CLOUD;
    lom_vec3 shaded = trace_ray(text, (lom_vec3){ 7, 10, 3 }, (lom_vec3){ 0, -1, 0 }, 0);
    lom_vec3 sunny = trace_ray(text, (lom_vec3){ 77, 10, 3 }, (lom_vec3){ 0, -1, 0 }, 0);
    CHECK(sunny.x > 0.1 && is_near(shaded.x / sunny.x, lom_double_exp(-0.8)), "%g of %g", shaded.x, sunny.x);
}

/* In even light from all sides a cloud that takes nothing is not there to be seen: the mean over many rays, whose
 * numbers belong to their origins, is the light. */
static void furnace_in_a_scene(void)
{
    lom_scene *scene = make_scene("sky.color = [0.5, 0.5, 0.5]\nlight.intensity = 0\n[clouds]\nalbedo = 1\n"
                                  "sky = [0.5, 0.5, 0.5]\nground = [0.5, 0.5, 0.5]\nhaze_distance = 0\n" CLOUD);
    lom_reference *reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    CHECK(reference != NULL);
    for (int i = 0; reference != NULL && i < 400; i++) {
        lom_vec3 from = { -40 + 0.2 * i, 60 + 0.1 * i, 200 }, d = { 0, 0, -1 };
        double light = lom_trace_ray(reference, from, d, 0, 0, 0).x;
        double let_through = 0.5 * lom_double_exp(-0.6); /* and one path, which ends at 0.5 whatever way it takes */
        CHECK(is_near(light, let_through) || is_near(light, 0.5 + let_through), "ray %d: %.17g", i, light);
    }
    lom_free_reference(reference);
    lom_free_scene(scene);
}

/* A wind of 16 m/s takes the cloud 64 m along in 4 s: the same bits as of a cloud that stands 64 m farther. */
static void clouds_go_with_the_wind(void)
{
    const char *text = SKY CLOUD "[[clouds.wind]]\nheight = 0\nspeed = 16\n";
    for (int i = 0; i < 20; i++) {
        lom_vec3 d = { 0, 0, -1 }, there = { 2.0 * i, 75, 256 }, here = { 64 + 2.0 * i, 75, 256 };
        lom_vec3 before = trace_ray(text, there, d, 0), after = trace_ray(text, here, d, 4);
        CHECK(before.x == after.x && before.y == after.y && before.z == after.z, "ray %d", i);
    }
}

static void the_renderer_shows_them(void)
{
    uint64_t hashes[2] = { 0, 1 };
    lom_scene *scene = make_scene(SKY "camera.position = [0, 90, 200]\nquality.reference.samples = 4\n" CLOUD);
    lom_reference *reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    lom_reference_frame desc = { .width = WIDTH, .height = HEIGHT, .samples = 4, .depth = 8, .threads = 1 };
    lom_image *traced = reference == NULL ? NULL : lom_trace_scene(reference, &desc, NULL);
    CHECK(traced != NULL);
    for (int i = 0; traced != NULL && i < 2; i++) {
        lom_renderer *renderer =
            lom_create_renderer(scene, &(lom_device_desc){ .lanes = 4 << 2 * i, .threads = 1 + i }, NULL);
        lom_frame frame = { .image = NULL };
        CHECK(renderer != NULL &&
              lom_render_frame(renderer, &(lom_frame_desc){ .width = WIDTH, .height = HEIGHT }, &frame, NULL));
        hashes[i] = frame.image == NULL ? 0 : lom_hash_image(frame.image);
        CHECK(hashes[i] == lom_hash_image(traced), "%d", i);
        lom_free_image(frame.image);
        lom_free_renderer(renderer);
    }
    lom_free_image(traced);
    lom_free_reference(reference);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    const char full[8] = { -1, -1, -1, -1, -1, -1, -1, -1 };
    if (!write_files() || !lom_write_file(scene_path("full.raw"), full, sizeof full, NULL)) {
        printf("FAIL files: they cannot be written\n");
        return 1;
    }
    RUN(absorbing_clouds_follow_beer_and_lambert);
    RUN(invisible_clouds_are_not_there);
    RUN(clouds_shadow_the_ground);
    RUN(furnace_in_a_scene);
    RUN(clouds_go_with_the_wind);
    RUN(the_renderer_shows_them);
    remove(scene_path("full.raw"));
    remove_files();
    return check_result();
}
