/* Water of the most exact model against the reference's rays (R2 to R1): level water under skies that are functions, whole
 * pictures of floats. The reference (src/reference) is held to Fresnel, Snell, Beer and Lambert by tests/reference; rays and
 * lanes share nothing but the scene. */
#include "check.h"

#include <lom/render.h>

#include <math.h>

enum { WIDTH = 96, HEIGHT = 54 };

static lom_image *draw(const char *model, const char *sky, const char *type, double pitch, double view)
{
    char text[1200];
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    snprintf(text, sizeof text,
             "[output]\nformat = 'rgb32f'\n[camera]\nposition = [0, 10, 0]\npitch = %g\nyaw = -30\nfield_of_view = %g\n"
             "[light]\nazimuth = 120\nelevation = 35\nambient = [0.3, 0.4, 0.5]\nintensity = 0.7\n[sky]\n%s[water]\n"
             "size = 1e6\n[water.optics]\nindex = 1.34\ntype = '%s'\nglitter = 0\nroughness = 0\n[quality]\n"
             "water = '%s'\nreference.samples = 1\n",
             pitch, view, sky, type, model);
    lom_scene *scene = lom_decode_scene(text, strlen(text), "water.toml", NULL, 0, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    if (renderer != NULL)
        lom_render_frame(renderer, &(lom_frame_desc){ .width = WIDTH, .height = HEIGHT }, &frame, &error);
    CHECK(frame.image != NULL, "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return frame.image;
}

static double relative_error(const lom_image *image, const lom_image *exact)
{
    double squares = 0, total = 0;
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        const double a = (double)((const float *)image->pixels)[i], b = (double)((const float *)exact->pixels)[i];
        squares += (a - b) * (a - b);
        total += b * b;
    }
    return sqrt(squares / total);
}

static void level_water_is_the_references(void)
{
    static const char *const skies[] = { "color = [0.3, 0.5, 0.9]\n", "gradient = true\nglow = [0.3, 0.2, 0.1]\n" };
    static const char *const types[] = { "I", "II", "5C" };
    double worst = 0;
    for (int pitch = -80; pitch <= -30; pitch += 10)
        for (int i = 0; i < 6; i++) {
            lom_image *exact = draw("reference", skies[i % 2], types[i / 2], pitch, 30);
            lom_image *image = draw("marched", skies[i % 2], types[i / 2], pitch, 30);
            const double error = exact != NULL && image != NULL ? relative_error(image, exact) : 1;
            CHECK(error <= 1e-5, "pitch %d, type %s, sky %d: %g", pitch, types[i / 2], i % 2, error);
            worst = error > worst ? error : worst;
            lom_free_image(exact);
            lom_free_image(image);
        }
    printf("  relative error at most %.2e\n", worst);
}

/* From 0.2 to 4.2 degrees below the horizon: level water mirrors at the angle at which it is seen, up to it. */
static void grazing_water_is_the_references(void)
{
    static const char *const models[] = { "marched", "displaced", "normal_map" };
    static const double bounds[] = { 1e-5, 1e-4, 2e-2 };
    const char *sky = "gradient = true\nglow = [0.3, 0.2, 0.1]\n";
    for (int i = 0; i < 3; i++) {
        lom_image *exact = draw("reference", sky, "II", -2.2, 4);
        lom_image *image = draw(models[i], sky, "II", -2.2, 4);
        const double error = exact != NULL && image != NULL ? relative_error(image, exact) : 1;
        CHECK(error <= bounds[i], "%s: %g", models[i], error);
        printf("  %s: relative error %.2e\n", models[i], error);
        lom_free_image(exact);
        lom_free_image(image);
    }
}

int main(int argc, char **argv)
{
    RUN(level_water_is_the_references);
    RUN(grazing_water_is_the_references);
    return check_result();
}
