/* Proves that the sea from high above does not show the period of its waves: where a period is 20 pixels wide, the sun's
 * light on it correlates with itself a period away by no more than a thousandth of its squared mean, and has less than a
 * tenth of the contrast that it has where a period is as wide as the picture. */
#include "check.h"

#include <lom/render.h>
#include <math.h>

enum { SIZE = 128 };

static const char *const kinds[] = { "kind = 'sea'\nwind_speed = 9\nsize = 64\npatch = 320\n",
                                     "kind = 'gerstner'\nlength = [53.3, 5]\nheight = 1\ncount = 24\nspread = 45\n" };
static const double period = 320;

/* Straight down from where the picture is `metres` wide, into a grey sum for each pixel. */
static bool draw(const char *waves, const char *model, double metres, double grey[SIZE][SIZE])
{
    char text[1000];
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    const double height = metres / 2 / tan(0.1);
    snprintf(text, sizeof text,
             "[output]\nformat = 'rgb32f'\n[camera]\nposition = [0, %g, 0]\npitch = -90\nfield_of_view = 11.459156\n"
             "[light]\nazimuth = 90\nelevation = 70\nintensity = 1\nambient = [0, 0, 0]\n[sky]\ncolor = [0, 0, 0]\n"
             "[water]\nsize = 1e6\n[water.optics]\nroughness = 0.01\n[water.waves]\n%s[quality]\nwater = '%s'\n",
             height, waves, model);
    lom_scene *scene = lom_decode_scene(text, strlen(text), "sea.toml", NULL, 0, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 2 }, &error);
    const bool is_drawn =
        renderer != NULL &&
        lom_render_frame(renderer, &(lom_frame_desc){ .width = SIZE, .height = SIZE }, &frame, &error);
    CHECK(is_drawn, "%s", error.text);
    for (int i = 0; is_drawn && i < SIZE * SIZE; i++)
        grey[i / SIZE][i % SIZE] = (double)*(const float *)lom_image_pixel(frame.image, i % SIZE, i / SIZE, 0);
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return is_drawn;
}

/* Of a picture over its mean, less what changes slowly: each pixel less the mean of the two `half` a period before and
 * behind it along x. */
struct pattern {
    double mean, contrast, repeats; /* of the whole; root mean square of that; covariance a period away, of mean^2 */
};

static struct pattern pattern_of(double grey[SIZE][SIZE], int across)
{
    static double rest[SIZE][SIZE];
    struct pattern p = { 0, 0, 0 };
    const int half = across / 2;
    int count = 0, pairs = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        p.mean += grey[i / SIZE][i % SIZE] / (SIZE * SIZE);
    for (int y = 0; y < SIZE; y++)
        for (int x = half; x < SIZE - half; x++, count++) {
            rest[y][x] = (grey[y][x] - (grey[y][x - half] + grey[y][x + half]) / 2) / p.mean;
            p.contrast += rest[y][x] * rest[y][x];
        }
    for (int y = 0; y < SIZE; y++)
        for (int x = half; x + across < SIZE - half; x++, pairs++)
            p.repeats += rest[y][x] * rest[y][x + across];
    p.contrast = sqrt(p.contrast / count);
    p.repeats /= pairs;
    return p;
}

static void no_period_shows_from_above(void)
{
    static const char *const models[] = { "normal_map", "displaced" };
    static double grey[SIZE][SIZE];
    for (int i = 0; i < 4; i++) {
        if (!draw(kinds[i / 2], models[i % 2], period, grey))
            continue;
        const struct pattern near = pattern_of(grey, SIZE / 2);
        if (!draw(kinds[i / 2], models[i % 2], period * SIZE / 20, grey))
            continue;
        const struct pattern far = pattern_of(grey, 20);
        printf("  %s, %s: contrast %.4f near, %.4f far; covariance a period away %+.5f of the squared mean\n",
               i < 2 ? "sea" : "trochoids", models[i % 2], near.contrast, far.contrast, far.repeats);
        CHECK(near.contrast > 0.05, "no waves are seen from near: %g", near.contrast);
        CHECK(fabs(far.repeats) < 1e-3, "a period shows: %g", far.repeats);
        CHECK(far.contrast < near.contrast / 10, "%g far, %g near", far.contrast, near.contrast);
    }
}

int main(int argc, char **argv)
{
    RUN(no_period_shows_from_above);
    return check_result();
}
