/* Proves on frames: the sun's picture is drawn where its light comes from, and moves with it; the gradient is the one
 * of the reference in double; terrain and clouds before the sun hide it. */
#include "check.h"

#include <lom/render.h>

static lom_image *draw(const char *text, int frame)
{
    lom_error error = { 0 };
    lom_scene *scene = lom_decode_scene(text, strlen(text), "sun.toml", NULL, 0, &error);
    CHECK(scene != NULL, "%s", error.text);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    lom_frame drawn = { .image = NULL };
    if (renderer != NULL)
        lom_render_frame(renderer, &(lom_frame_desc){ .frame = frame }, &drawn, &error);
    CHECK(drawn.image != NULL, "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return drawn.image;
}

static const char sky[] = "[output]\nwidth = 160\nheight = 120\nformat = 'rgb32f'\nfps = 1\n"
                          "[camera]\nposition = [0, 5, 0]\nyaw = -90\npitch = 20\nfield_of_view = 70\n"
                          "[light]\nazimuth = 90\n[[light.key]]\ntime = 0\nelevation = 5\n"
                          "[[light.key]]\ntime = 10\nelevation = 45\n"
                          "[sky]\ngradient = true\nglow = [0.2, 0.15, 0.1]\n";

/* The brightest row of the middle column. */
static int brightest(const lom_image *image)
{
    int best = 0;
    float most = -1;
    for (int y = 0; y < image->height; y++) {
        const float *p = lom_image_pixel(image, image->width / 2, y, 0);
        if (p[0] > most) {
            most = p[0];
            best = y;
        }
    }
    return best;
}

static void the_sun_is_where_its_light_comes_from(void)
{
    char text[800];
    snprintf(text, sizeof text, "%ssun = true\nsun_size = 10\n", sky);
    for (int frame = 0; frame <= 10; frame += 5) {
        lom_image *image = draw(text, frame);
        double angle = (5 + 4 * frame - 20) * 3.141592653589793 / 180, half = 0.70020753820970971; /* tan 35 degrees */
        double row = 60 - 60 * lom_double_sin(angle) / lom_double_cos(angle) / half;
        double off = image == NULL ? 99 : brightest(image) + 0.5 - row;
        CHECK(off > -1.6 && off < 1.6, "frame %d: row off by %g", frame, off);
        lom_free_image(image);
    }
}

static void the_gradient_is_that_of_the_reference(void)
{
    char text[900];
    const char *still = strstr(sky, "[[light.key]]");
    snprintf(text, sizeof text, "%.*selevation = 25\n%s[quality]\nwater = 'reference'\nreference.samples = 1\n",
             (int)(still - sky), sky, strstr(sky, "[sky]"));
    lom_image *exact = draw(text, 0);
    strstr(text, "reference'")[0] = 'p';
    memcpy(strstr(text, "peference'"), "planar'   ", 10);
    lom_image *fast = draw(text, 0);
    double most = 0;
    for (size_t i = 0; exact != NULL && fast != NULL && i < 160 * 120 * 3; i++) {
        double difference = (double)((const float *)(const void *)exact->pixels)[i] -
                            (double)((const float *)(const void *)fast->pixels)[i];
        most = difference > most ? difference : -difference > most ? -difference : most;
    }
    CHECK(most < 2e-6, "largest difference %g", most);
    lom_free_image(exact);
    lom_free_image(fast);
}

static void what_is_before_the_sun_hides_it(void)
{
    char text[1200];
    snprintf(text, sizeof text, "%ssun = true\n[water]\nsize = [9, 9]\nlevel = 1000\n[quality]\nwater = 'planar'\n",
             sky);
    lom_image *open = draw(text, 5);
    snprintf(text, sizeof text,
             "%ssun = true\n[[cloud]]\nkind = 'hemisphere'\nvoxels = [16, 16, 16]\nposition = [3000, 150, 0]\n"
             "size = [1500, 2500, 2500]\ndensity = 5\n[clouds]\nbrightness = 0\nsky = [0, 0, 0]\nground = [0, 0, 0]\n",
             sky);
    lom_image *hidden = draw(text, 5);
    int row = open == NULL ? 0 : brightest(open);
    const float *a = open == NULL ? NULL : lom_image_pixel(open, 80, row, 0);
    const float *b = hidden == NULL ? NULL : lom_image_pixel(hidden, 80, row, 0);
    CHECK(a != NULL && b != NULL && a[0] > 1 && b[0] < 0.05f, "%g behind a cloud", b != NULL ? (double)b[0] : -1);
    lom_free_image(open);
    lom_free_image(hidden);
}

int main(int argc, char **argv)
{
    RUN(the_sun_is_where_its_light_comes_from);
    RUN(the_gradient_is_that_of_the_reference);
    RUN(what_is_before_the_sun_hides_it);
    return check_result();
}
