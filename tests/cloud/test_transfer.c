/* Proves: volumes by formula are their formulas; a cloud of the scene file has the transfer function that is written,
 * and what is none is refused in one sentence; the reference integrates it in closed form. */
#include "check.h"

#include "base/numbers.h"

#include <lom/reference.h>
#include <lom/scene.h>

#include <stdio.h>
#include <string.h>

static double voxel(const lom_image *volume, int x, int y, int z)
{
    uint16_t value;
    memcpy(&value, lom_image_pixel(volume, x, y, z), sizeof value);
    return value / 65535.0;
}

static void formulas_are_the_volumes(void)
{
    lom_image *ball = lom_make_cloud(&(lom_cloud_desc){ "ball", 17, 17, 17, 3 }, NULL);
    lom_image *ripples = lom_make_cloud(&(lom_cloud_desc){ "ripples", 17, 17, 17, 3 }, NULL);
    for (int i = 0; i < 17; i++) {
        double at = (2 * i + 1) / 17.0 - 1, distance = at < 0 ? -at : at;
        CHECK(lom_magnitude(voxel(ball, i, 8, 8) - (1 - distance)) < 1e-5, "ball at %g", at);
        CHECK(lom_magnitude(voxel(ball, 8, 8, i) - (1 - distance)) < 1e-5, "ball at %g", at);
        double slow = (1 - lom_double_sin(lom_two_pi / 4 * at) + 0.5) / 2.5; /* in the middle the rings are 1 + 1 */
        CHECK(lom_magnitude(voxel(ripples, 8, i, 8) - slow) < 1e-5, "ripples at a height of %g", at);
        double rings = 1 + lom_double_cos(12 * lom_two_pi / 2 * lom_double_cos(lom_two_pi / 4 * distance));
        CHECK(lom_magnitude(voxel(ripples, i, 8, 8) - (1 + 0.25 * rings) / 2.5) < 1e-5, "ripples at a radius of %g",
              at);
    }
    CHECK(voxel(ball, 0, 0, 0) == 0, "nothing in the corners");
    lom_free_image(ball);
    lom_free_image(ripples);
}

static lom_scene *scene_of(const char *cloud, lom_error *error)
{
    char text[1200];
    snprintf(text, sizeof text, "[[cloud]]\n%s\n", cloud);
    return lom_decode_scene(text, strlen(text), "-", NULL, 0, error);
}

static void what_is_written_is_read(void)
{
    lom_error error = { 0 };
    lom_scene *scene =
        scene_of("look = 'glowing'\ntransfer_function = [{ value = 0.25, extinction = 0.5, color = [2, 1, 0] "
                 "}, { value = 0.25 }]",
                 &error);
    CHECK(scene != NULL && scene->cloud[0].transfer_count == 2, "%s", error.text);
    if (scene == NULL)
        return;
    const lom_cloud *cloud = &scene->cloud[0];
    CHECK(cloud->look == LOM_LOOK_GLOWING && cloud->detail == 0, "no noise of its own accord: %g", cloud->detail);
    CHECK(cloud->transfer[0].value == 0.25 && cloud->transfer[0].extinction == 0.5 && cloud->transfer[0].color[0] == 2,
          "the first point");
    CHECK(cloud->transfer[1].extinction == 1 && cloud->transfer[1].color[2] == 1, "opaque and white if not told");
    lom_free_scene(scene);
    scene = scene_of("detail = 0.2\ntransfer_function = [{ value = 0 }]", &error);
    CHECK(scene != NULL && scene->cloud[0].detail == 0.2, "the noise that is told");
    lom_free_scene(scene);
}

static void bad_functions_are_refused(void)
{
    static const struct {
        const char *cloud, *sentence;
    } rows[] = {
        { "transfer_function = [{ value = 0.5 }, { value = 0.4 }]",
          "the values of a transfer function must not fall." },
        { "transfer_function = [{ extinction = 0.5 }]", "the key \"value\" is missing in this table." },
        { "transfer_function = [{ value = 1.5 }]", "must be from 0 to 1." },
        { "transfer_function = [{ value = nan }]", "\"value\"" },
        { "transfer_function = [{ value = 0, extinction = -1 }]", "must be from 0 to 1." },
        { "transfer_function = [{ value = 0, color = [2, 0, 0] }]", "only what glows is above 1." },
        { "look = 'surface'\ntransfer_function = [{ value = 0, color = [0, 0, 1.5] }]", "only what glows is above 1." },
        { "look = 'shiny'", "\"shiny\"" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lom_error error = { 0 };
        lom_scene *scene = scene_of(rows[i].cloud, &error);
        CHECK(scene == NULL && strstr(error.text, rows[i].sentence) != NULL && strchr(error.text, '\n') == NULL,
              "%s: \"%s\"", rows[i].cloud, error.text);
        lom_free_scene(scene);
    }
    char many[1000] = "transfer_function = [";
    for (int i = 0; i < 17; i++)
        strcat(many, "{ value = 1 }, ");
    strcat(many, "]");
    lom_error error = { 0 };
    lom_scene *scene = scene_of(many, &error);
    CHECK(scene == NULL && strstr(error.text, "a transfer function has at most 16 points.") != NULL, "\"%s\"",
          error.text);
    lom_free_scene(scene);
}

/* A rise from 0 to 1 over 8 voxels along x, 80 m long; between the outermost centres it is even. */
static lom_reference_volume *rise(const lom_transfer_point *points, size_t count, lom_volume_look look)
{
    lom_image *image = lom_create_image(9, 1, 1, LOM_FORMAT_R32F, NULL);
    for (int i = 0; i < 9; i++)
        ((float *)image->pixels)[i] = (float)i / 8;
    lom_error error = { 0 };
    lom_reference_volume *volume =
        lom_create_reference_volume(&(lom_reference_volume_desc){ .density = image,
                                                                  .low = { -5, -5, -5 },
                                                                  .high = { 85, 5, 5 },
                                                                  .extinction = 0.05,
                                                                  .albedo = { 1, 1, 1 },
                                                                  .phase = { .kind = LOM_PHASE_ISOTROPIC },
                                                                  .transfer = points,
                                                                  .transfer_count = count,
                                                                  .look = look },
                                    &error);
    CHECK(volume != NULL, "%s", error.text);
    lom_free_image(image);
    return volume;
}

static void the_reference_integrates_it(void)
{
    const lom_transfer_point points[] = { { 0.25, 0, { 1, 1, 1 } },
                                          { 0.25, 1, { 1, 0.5, 0.25 } },
                                          { 0.5, 0.5, { 1, 0.5, 0.25 } },
                                          { 0.75, 0, { 1, 0.5, 0.25 } } };
    lom_reference_volume *volume = rise(points, 4, LOM_LOOK_GLOWING);
    const lom_vec3 origin = { 0, 0, 0 }, along = { 1, 0, 0 }, back = { -1, 0, 0 }, end = { 80, 0, 0 };
    /* 20 m at a mean of 3/4, 20 m of a mean of 1/4 */
    double depth = lom_volume_optical_depth(volume, origin, along, 0, 80);
    CHECK(lom_magnitude(depth - 0.05 * 20) < 1e-7, "depth %.12g", depth);
    CHECK(lom_magnitude(lom_volume_optical_depth(volume, end, back, 0, 80) - depth) < 1e-9, "and back");
    CHECK(lom_volume_optical_depth(volume, origin, along, 0, 19.9) == 0, "nothing before the step");
    lom_volume_light found;
    lom_reference_light light = { .to_sun = { 0, 1, 0 }, .sun = { 3, 3, 3 } };
    lom_volume_rays rays = { origin, along, 80, 20000, 8, 1 };
    CHECK(lom_trace_volume(volume, &light, &rays, &found, NULL), "traced");
    double opacity = 1 - lom_double_exp(-depth);
    for (int k = 0; k < 3; k++) {
        double want = opacity / (1 << k);
        CHECK(lom_magnitude(found.scattered[k] - want) < 5 * found.error[k] + 1e-9, "it glows: %g for %g",
              found.scattered[k], want);
    }
    lom_free_reference_volume(volume);
    lom_transfer_point fallen[] = { { 0.5, 1, { 1, 1, 1 } }, { 0.25, 1, { 1, 1, 1 } } };
    lom_image *image = lom_create_image(1, 1, 1, LOM_FORMAT_R8, NULL);
    lom_error error = { 0 };
    volume = lom_create_reference_volume(
        &(lom_reference_volume_desc){ .density = image, .high = { 1, 1, 1 }, .transfer = fallen, .transfer_count = 2 },
        &error);
    CHECK(volume == NULL && error.code == LOM_ERROR_USAGE, "what is no function: \"%s\"", error.text);
    lom_free_image(image);
}

/* Full extinction s from a value on, of albedo a, 40 m thick, whose surfaces lie across the way and are lit from where
 * the eye is: the integral of s e^(-s t) a e^(-s t), a / 2 (1 - e^(-2 s 40)). Lit from behind nothing is sent. */
static void a_wall_sends_by_lambert(void)
{
    const lom_transfer_point points[] = { { 0.5, 0, { 1, 1, 1 } }, { 0.5, 1, { 0.5, 0.5, 0.5 } } };
    lom_reference_volume *volume = rise(points, 2, LOM_LOOK_SURFACE);
    lom_reference_light light = { .to_sun = { -1, 0, 0 }, .sun = { lom_pi, lom_pi, lom_pi } };
    lom_volume_rays rays = { { 0, 0, 0 }, { 1, 0, 0 }, 80, 40000, 1, 1 };
    lom_volume_light found;
    CHECK(lom_trace_volume(volume, &light, &rays, &found, NULL), "traced");
    double want = 0.25 * (1 - lom_double_exp(-4));
    CHECK(lom_magnitude(found.scattered[0] - want) < 5 * found.error[0], "%g, not %g", found.scattered[0], want);
    light.to_sun = (lom_vec3){ 1, 0, 0 };
    CHECK(lom_trace_volume(volume, &light, &rays, &found, NULL) && found.scattered[0] == 0, "lit from behind: %g",
          found.scattered[0]);
    lom_free_reference_volume(volume);
}

int main(int argc, char **argv)
{
    RUN(formulas_are_the_volumes);
    RUN(what_is_written_is_read);
    RUN(bad_functions_are_refused);
    RUN(the_reference_integrates_it);
    RUN(a_wall_sends_by_lambert);
    return check_result();
}
