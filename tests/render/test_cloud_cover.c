/* Proves: a sky of many clouds covers the oktas that its scene asks for, in a picture from above. */
#include "check.h"

#include <lom/render.h>
#include <lom/scene.h>

#include <stdio.h>
#include <string.h>

enum { SIDE = 96 };

/* Clouds that send no light before a white sky, seen straight down by parallel rays: a pixel is what comes through. */
static const char text[] =
    "[output]\nwidth = 96\nheight = 96\nformat = \"rgb32f\"\ntransfer = \"naive\"\n"
    "[camera]\nposition = [0, 9000, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\n"
    "projection = \"orthographic\"\nheight = 12000\nfar = 20000\n"
    "[light]\nintensity = 0\n"
    "[sky]\ngradient = true\nzenith = [1, 1, 1]\nhorizon = [1, 1, 1]\nhaze = [1, 1, 1]\n"
    "[quality]\ncloud_light_scale = 0.2\ncloud_jitter = false\n"
    "[clouds]\nsky = [0, 0, 0]\nground = [0, 0, 0]\nshadows = false\narea = 12000\nvoxels = 0.3\n";

/* Eighths of the picture whose light is below exp(-0.1). */
static double measure(double oktas)
{
    char override[64];
    const char *overrides[] = { override };
    lom_error error = { 0 };
    snprintf(override, sizeof override, "clouds.oktas=%g", oktas);
    lom_scene *scene = lom_decode_scene(text, strlen(text), "-", overrides, 1, &error);
    CHECK(scene != NULL, "%s", error.text);
    if (scene == NULL)
        return -1;
    lom_renderer *renderer = lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    lom_frame picture = { .image = NULL };
    CHECK(lom_render_frame(renderer, &(lom_frame_desc){ .width = SIDE, .height = SIDE }, &picture, &error), "%s",
          error.text);
    int covered = 0;
    for (size_t i = 0; picture.image != NULL && i < SIDE * SIDE; i++) {
        float red;
        memcpy(&red, picture.image->pixels + i * 3 * sizeof red, sizeof red);
        covered += red < 0.904837f;
    }
    lom_free_image(picture.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return covered * 8.0 / (SIDE * SIDE);
}

static void cover_from_above_is_the_oktas(void)
{
    CHECK(measure(0) == 0, "no clouds");
    for (int oktas = 2; oktas <= 6; oktas += 2) {
        double cover = measure(oktas);
        CHECK(cover > oktas - 0.6 && cover < oktas + 0.6, "%d oktas are %g", oktas, cover);
    }
}

int main(int argc, char **argv)
{
    RUN(cover_from_above_is_the_oktas);
    return check_result();
}
