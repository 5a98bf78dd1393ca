/* Proves what a far sea looks like against the distribution of its slopes (tests/rough_water.h): the light of the sun in
 * it and the area that glitters, at five winds and three heights of the sun, where the slopes are those of Cox and Munk,
 * and where they are those of thousands of waves that are smaller than a pixel; how much of the sky; and that nothing steps
 * while a camera climbs from 2 m to 400 km over such waves. */
#include "check.h"
#include "rough_water.h"
#include "waves/sea_desc.h"

#include <lom/render.h>

static const double degree = 0.017453292519943295;
static const double winds[] = { 2, 5, 8, 12, 15 };

static lom_renderer *open_renderer(const char *text, lom_scene **scene)
{
    lom_error error = { 0 };
    *scene = lom_decode_scene(text, strlen(text), "sea.toml", NULL, 0, &error);
    CHECK(*scene != NULL, "%s", error.text);
    lom_renderer *renderer =
        *scene == NULL ? NULL : lom_create_renderer(*scene, &(lom_device_desc){ .threads = 2 }, &error);
    CHECK(renderer != NULL, "%s", error.text);
    return renderer;
}

static lom_image *draw(lom_renderer *renderer, const lom_frame_desc *desc)
{
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    if (renderer != NULL)
        lom_render_frame(renderer, desc, &frame, &error);
    CHECK(frame.image != NULL, "%s", error.text);
    return frame.image;
}

/* ---- the sun ---- */

enum { WIDTH = 96, HEIGHT = 54 };

/* A black sky over black water, the sun in the east and mirrored in the middle of the picture by level water. */
struct view {
    const char *model, *waves; /* of the scene: [water.waves], or nothing */
    double elevation, height, wind;
};

static void describe_glitter(char text[1200], const struct view *view, double roughness)
{
    snprintf(text, 1200,
             "[output]\nformat = 'rgb32f'\n[camera]\nposition = [0, %g, 0]\nyaw = -90\npitch = %g\n"
             "field_of_view = 60\n[light]\nazimuth = 90\nelevation = %g\ncolor = [1, 1, 1]\nintensity = 1\n"
             "ambient = [0, 0, 0]\n[sky]\ncolor = [0, 0, 0]\n[water]\nsize = 1e6\n[water.optics]\nindex = 1.34\n"
             "absorption = [1, 1, 1]\nscatter = [0, 0, 0]\nroughness = %.17g\n%s[quality]\nwater = '%s'\n",
             view->height, -view->elevation, view->elevation, roughness, view->waves, view->model);
}

/* The unit vector from what the pixel shows to the eye of a camera that looks east and down by `pitch`. */
static void back_from_pixel(double pitch, int x, int y, double v[3])
{
    const double half = tan(30 * degree), c = cos(pitch), s = sin(pitch);
    const double right = (2 * (x + 0.5) / WIDTH - 1) * half * WIDTH / HEIGHT, up = (1 - 2 * (y + 0.5) / HEIGHT) * half;
    const double d[3] = { c + up * s, up * c - s, right }, length = sqrt(1 + right * right + up * up);
    for (int k = 0; k < 3; k++)
        v[k] = -d[k] / length;
}

struct glitter {
    double light; /* the sum over the picture */
    int area;     /* pixels above half of the closed form's brightest */
};

static double closed[HEIGHT][WIDTH];

/* Into `closed`; its brightest pixel. */
static double find_closed_form(const rough_water *w, double elevation)
{
    const double sun[3] = { cos(elevation * degree), sin(elevation * degree), 0 };
    double brightest = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double v[3];
            back_from_pixel(elevation * degree, x, y, v);
            closed[y][x] = 3.141592653589793 * mirrored_light(w, v, sun, true); /* a light of colour 1 has pi */
            brightest = closed[y][x] > brightest ? closed[y][x] : brightest;
        }
    return brightest;
}

static void check_glitter(lom_renderer *renderer, const struct view *view, const rough_water *w)
{
    struct glitter want = { 0, 0 }, got = { 0, 0 };
    const double brightest = find_closed_form(w, view->elevation);
    lom_image *image = draw(renderer, &(lom_frame_desc){ .width = WIDTH, .height = HEIGHT });
    for (int y = 0; image != NULL && y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const double drawn = (double)*(const float *)lom_image_pixel(image, x, y, 0);
            want.light += closed[y][x];
            got.light += drawn;
            want.area += closed[y][x] > brightest / 2;
            got.area += drawn > brightest / 2;
        }
    const double light = got.light / want.light - 1, area = (double)got.area / want.area - 1;
    CHECK(fabs(light) < 0.02, "%s, sun at %g, wind %g: %+.2f %% of the light", view->model, view->elevation, view->wind,
          100 * light);
    CHECK(fabs(area) < 0.02, "%s, sun at %g, wind %g: area %d, not %d", view->model, view->elevation, view->wind,
          got.area, want.area);
    printf("  %s, sun at %g, wind %2g, mean square slopes %.4f and %.4f: light %+.2f %%, area %d of %d\n", view->model,
           view->elevation, view->wind, w->up, w->cross, 100 * light, got.area, want.area);
    lom_free_image(image);
}

static void ripples_glitter_as_their_slopes_say(void)
{
    for (int elevation = 30; elevation <= 60; elevation += 15)
        for (int i = 0; i < 10; i++) {
            const struct view view = { i < 5 ? "normal_map" : "displaced", "", elevation, 1000, winds[i % 5] };
            const rough_water w = cox_munk_even(view.wind);
            char text[1200];
            lom_scene *scene;
            describe_glitter(text, &view, 2 * w.up);
            lom_renderer *renderer = open_renderer(text, &scene);
            check_glitter(renderer, &view, &w);
            lom_free_renderer(renderer);
            lom_free_scene(scene);
        }
}

/* The mean squares of the slopes of the scene's sea at frame 0, along and across its wind, which blows along x. */
static rough_water slopes_of_sea(const lom_scene *scene)
{
    lom_error error = { 0 };
    rough_water w = { 0, 0, 1.34 };
    const lom_sea_desc desc = lom_scene_sea(&scene->water.waves);
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *sea = lom_create_sea(&desc, device, &error);
    CHECK(sea != NULL && lom_advance_sea(sea, device, 0, &error), "%s", error.text);
    for (int i = 0; sea != NULL && i < lom_describe_sea(sea)->cascade_count; i++) {
        const lom_sea_cascade c = lom_view_cascade(sea, i);
        const size_t samples = (size_t)c.size * (size_t)c.size;
        for (size_t k = 0; k < samples; k++) {
            const double sx = (double)c.derivatives[4 * k], sz = (double)c.derivatives[4 * k + 1];
            w.up += sx * sx / (double)samples;
            w.cross += sz * sz / (double)samples;
        }
    }
    lom_free_sea(sea);
    lom_close_device(device);
    return w;
}

/* From 100 km a pixel is two kilometres wide, and the longest waves some hundred metres. */
static void waves_glitter_as_their_slopes_say(void)
{
    for (int i = 0; i < 5; i++) {
        char text[1200], waves[200];
        lom_scene *scene;
        snprintf(waves, sizeof waves, "[water.waves]\nkind = 'sea'\nwind_speed = %g\nsize = 64\nchoppiness = 0\n",
                 winds[i]);
        const struct view view = { "displaced", waves, 60, 100000, winds[i] };
        describe_glitter(text, &view, 0.002);
        lom_renderer *renderer = open_renderer(text, &scene);
        rough_water w = slopes_of_sea(scene);
        w.up += 0.001;
        w.cross += 0.001;
        check_glitter(renderer, &view, &w);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

/* ---- the sky ---- */

/* A white sky over black water, from straight above to a degree above the horizon. */
static void the_sky_is_mirrored_as_the_slopes_say(void)
{
    static const int angles[] = { 0, 40, 50, 60, 65, 70, 75, 80, 85, 89 };
    double worst = 0;
    for (int k = 0; k < 50; k++) {
        const double angle = angles[k / 5] * degree, v[3] = { sin(angle), cos(angle), 0 };
        const rough_water w = cox_munk_even(winds[k % 5]);
        char text[1200];
        lom_scene *scene;
        snprintf(text, sizeof text,
                 "[output]\nformat = 'rgb32f'\n[camera]\nposition = [0, 100, 0]\npitch = %d\nfield_of_view = 1\n"
                 "[light]\nintensity = 0\nambient = [0, 0, 0]\n[sky]\ncolor = [1, 1, 1]\n[water]\nsize = 1e6\n"
                 "[water.optics]\nindex = 1.34\nabsorption = [1, 1, 1]\nscatter = [0, 0, 0]\nroughness = %.17g\n"
                 "[quality]\nwater = 'displaced'\n",
                 angles[k / 5] - 90, 2 * w.up);
        lom_renderer *renderer = open_renderer(text, &scene);
        lom_image *image = draw(renderer, &(lom_frame_desc){ .width = 16, .height = 9 });
        double mean = 0;
        for (int i = 0; image != NULL && i < 16 * 9; i++)
            mean += (double)((const float *)image->pixels)[3 * i] / (16 * 9);
        const double off = mean / walked_sky(&w, v, 200000) - 1;
        CHECK(fabs(off) < 0.02, "%d degrees, wind %g: %+.2f %%", angles[k / 5], winds[k % 5], 100 * off);
        worst = fabs(off) > worst ? fabs(off) : worst;
        lom_free_image(image);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
    printf("  off by %.2f %% at most\n", 100 * worst);
}

/* ---- the climb ---- */

static const char climb[] =
    "[output]\nwidth = 80\nheight = 60\n[light]\nazimuth = 90\nelevation = 62\nintensity = 1\n"
    "ambient = [0.24, 0.27, 0.31]\n[sky]\ngradient = true\nintensity = 2\n[water]\nsize = 1e6\n"
    "[water.optics]\nroughness = 0.012\n[water.waves]\nkind = 'sea'\nwind_speed = 12\nsize = 128\n"
    "[quality]\nwater = 'displaced'\n";

/* FLIP between pictures from heights a quarter apart grows while waves come into view, and falls when they become smaller
 * than a pixel. A step would be a difference that stands out from those on both its sides. */
static void nothing_steps_as_the_camera_climbs(void)
{
    enum { HEIGHTS = 55 };
    lom_scene *scene;
    lom_renderer *renderer = open_renderer(climb, &scene);
    double height = 2, step[HEIGHTS + 1] = { 0 };
    lom_image *last = NULL;
    for (int i = 0; renderer != NULL && i < HEIGHTS; i++, height *= 1.2535) {
        const lom_vec3 eye = { 0, height, 0 }, ahead = { 0.364 * height, 0, 0 }; /* 70 degrees down */
        const lom_camera_view camera = {
            .position = eye, .target = ahead, .up = { 0, 1, 0 }, .field_of_view = 40 * degree, .near_plane = 0.1
        };
        lom_image *image = draw(renderer, &(lom_frame_desc){ .camera = &camera });
        if (last != NULL && image != NULL)
            CHECK(lom_compare_flip(last, image, &step[i], NULL), "no FLIP");
        lom_free_image(last);
        last = image;
    }
    lom_free_image(last);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    for (int i = 1; i < HEIGHTS; i++) {
        const double around = step[i - 1] > step[i + 1] ? step[i - 1] : step[i + 1];
        CHECK(i == 1 || step[i] < 1.25 * around + 0.002, "at height %d: %g after %g, before %g", i, step[i],
              step[i - 1], step[i + 1]);
        printf("%s%.4f", i % 11 == 1 ? "\n  " : " ", step[i]);
    }
    printf("\n");
    CHECK(step[1] > 0.05 && step[HEIGHTS - 1] < 0.001, "%g first, %g last", step[1], step[HEIGHTS - 1]);
    CHECK(height > 400000, "%g m", height);
}

int main(int argc, char **argv)
{
    RUN(ripples_glitter_as_their_slopes_say);
    RUN(waves_glitter_as_their_slopes_say);
    RUN(the_sky_is_mirrored_as_the_slopes_say);
    RUN(nothing_steps_as_the_camera_climbs);
    return check_result();
}
