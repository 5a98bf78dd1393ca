/* Proves on frames with single drops of known opacity, before black: a drop is the disc of its radius; one thinner than
 * a pixel keeps its light wherever it falls among the pixels; none is cut by a wall that it stands in, which a drop
 * without softness is; the nearer one lies over the farther one, whichever the file names first; what is drawn out
 * covers as much; spray is brighter before the sun. */
#include "check.h"
#include "small_scene.h"

/* Ambient light alone, of radiance 1: the red of a pixel is the opacity there. */
static const char head[] = "[output]\nwidth = 96\nheight = 64\nformat = 'rgb32f'\n"
                           "[camera]\nposition = [0, 0, 16]\ntarget = [0, 0, 0]\nfield_of_view = 53.13010235415598\n"
                           "[light]\nintensity = 0\nambient = [1, 1, 1]\n[sky]\ncolor = [0, 0, 0]\n";

/* Of its two drops one is born at the time 0 and one is in the middle of its life, 9.8 mm below where it began. */
#define DROP(place, keys) "[[spray]]\ncount = 2\nlife = 2\ndrag = 1000\nfrom = " place "\n" keys "\n"

static lom_image *draw(const char *tables)
{
    char text[2000];
    lom_error error = { 0 };
    snprintf(text, sizeof text, "%s%s", head, tables);
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("spray.toml"), NULL, 0, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    lom_frame drawn = { .image = NULL };
    if (renderer != NULL)
        lom_render_frame(renderer, &(lom_frame_desc){ .frame = 0 }, &drawn, &error);
    CHECK(drawn.image != NULL, "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return drawn.image;
}

static double pixel(const lom_image *image, int x, int y, int channel)
{
    return image == NULL ? -1 : (double)((const float *)lom_image_pixel(image, x, y, 0))[channel];
}

static double sum(const lom_image *image)
{
    double total = 0;
    for (int y = 0; image != NULL && y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            total += pixel(image, x, y, 0);
    return total;
}

/* A pixel is 16 tan(half of the field) / 32 = 0.25 m wide; the middle is the corner of four pixels. */
static void a_drop_is_its_disc(void)
{
    lom_image *image = draw(DROP("[0, 0.0098, 0]", "size = 5\nopacity = 0.8"));
    for (int x = 0; x < 96; x++) {
        double dx = (x + 0.5 - 48) * 0.25 / 5, rest = 1 - dx * dx - 0.025 * 0.025;
        double exact = rest > 0 ? 0.8 * rest * rest : 0, off = pixel(image, x, 32, 0) - exact;
        CHECK(off < 1e-3 && off > -1e-3, "column %d: off by %g", x, off);
    }
    lom_free_image(image);
}

static void a_thin_drop_keeps_its_light(void)
{
    const double exact = 0.9 * 3.141592653589793 / 3 * 0.2 * 0.2; /* of a radius of 0.2 pixels */
    for (int n = 0; n < 25; n++) {
        char keys[400];
        snprintf(keys, sizeof keys,
                 "[[spray]]\ncount = 2\nlife = 2\ndrag = 1000\nfrom = [%g, %g, 0]\nsize = 0.05\nopacity = 0.9\n",
                 1 + 0.05 * (n % 5), 1 + 0.05 * (double)(n / 5));
        lom_image *image = draw(keys);
        double part = sum(image) / exact;
        CHECK(part > 0.9 && part < 1.1, "place %d: %g of the light", n, part);
        lom_free_image(image);
    }
}

static void what_is_drawn_out_covers_as_much(void)
{
    lom_image *still = draw(DROP("[0, 0.0098, 0]", "size = 2\nopacity = 0.8"));
    lom_image *drawn = draw(DROP("[-4, 0.0098, 0]", "size = 2\nopacity = 0.8\nwind = [4, 0, 0]\nstretch = 2"));
    CHECK(pixel(drawn, 48 + 20, 32, 0) > 0.01 && pixel(still, 48 + 20, 32, 0) == 0, "4 m to each side more");
    double part = sum(drawn) / sum(still);
    CHECK(part > 0.98 && part < 1.02, "%g", part);
    lom_free_image(still);
    lom_free_image(drawn);
}

/* The largest step from pixel to pixel on the middle row of a drop that stands in a wall at 45 degrees. */
static double largest_step(const char *soft, double *left, double *right)
{
    char keys[600];
    snprintf(keys, sizeof keys,
             DROP("[0, 0.0098, 0]",
                  "size = 5\nopacity = 0.8\nsoft = %s") "[[entity]]\nmesh = 'wall.obj'\n[entity.material]\nambient = "
                                                        "[0,0,0]\n",
             soft);
    lom_image *image = draw(keys);
    double most = 0;
    for (int x = 1; x < 96; x++) {
        double step = pixel(image, x, 32, 0) - pixel(image, x - 1, 32, 0);
        most = step > most ? step : -step > most ? -step : most;
    }
    *left = pixel(image, 40, 32, 0);
    *right = pixel(image, 56, 32, 0);
    lom_free_image(image);
    return most;
}

static void a_wall_does_not_cut_a_drop(void)
{
    lom_error error = { 0 };
    const char wall[] = "v -9 -9 -9\nv 9 -9 9\nv 9 9 9\nv -9 9 -9\nf 1 2 3 4\n";
    CHECK(small_text("wall.obj", wall, &error), "%s", error.text);
    double left, right;
    double hard = largest_step("0.001", &left, &right);
    CHECK(hard > 0.7 && left > 0.5 && right == 0, "a hard drop is cut: %g, %g, %g", hard, left, right);
    double soft = largest_step("4", &left, &right);
    CHECK(soft < 0.06 && left > 0.2 && right == 0, "a soft one is not: %g, %g, %g", soft, left, right);
}

static void the_nearer_one_lies_over_the_farther_one(void)
{
#define NEAR DROP("[0, 0, 3]", "size = 2\nopacity = 1\ncolor = [0, 1, 0]")
#define FAR  DROP("[0, 0, -3]", "size = 2\nopacity = 1\ncolor = [1, 0, 0]")
    lom_image *image[2] = { draw(NEAR FAR), draw(FAR NEAR) };
    for (int i = 0; i < 2; i++)
        CHECK(pixel(image[i], 48, 32, 1) > 0.98 && pixel(image[i], 48, 32, 0) < 0.02, "order %d", i);
    lom_free_image(image[0]);
    lom_free_image(image[1]);
}

static void spray_glows_before_the_sun(void)
{
    double value[2];
    for (int i = 0; i < 2; i++) {
        char keys[400];
        snprintf(keys, sizeof keys, "intensity = 1\nazimuth = %d\nelevation = 5\nambient = [0, 0, 0]\n", i * 180);
        char text[1200], *at;
        snprintf(text, sizeof text, "%s%s", head, DROP("[0, 0, 0]", "size = 3\nopacity = 0.1"));
        at = strstr(text, "intensity = 0\nambient = [1, 1, 1]\n");
        char rest[1200];
        snprintf(rest, sizeof rest, "%s", at + strlen("intensity = 0\nambient = [1, 1, 1]\n"));
        snprintf(at, sizeof text - (size_t)(at - text), "%s%s", keys, rest);
        lom_error error = { 0 };
        lom_scene *scene = lom_decode_scene(text, strlen(text), "spray.toml", NULL, 0, &error);
        lom_renderer *r = scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
        lom_frame drawn = { .image = NULL };
        CHECK(r != NULL && lom_render_frame(r, &(lom_frame_desc){ .frame = 0 }, &drawn, &error), "%s", error.text);
        value[i] = pixel(drawn.image, 48, 32, 0);
        lom_free_image(drawn.image);
        lom_free_renderer(r);
        lom_free_scene(scene);
    }
    double ratio = value[0] > value[1] ? value[0] / value[1] : value[1] / value[0];
    CHECK(ratio > 2, "%g before the sun and away from it: %g", value[0], value[1]);
}

int main(int argc, char **argv)
{
    snprintf(small_folder, sizeof small_folder, "/tmp/lom-spray-XXXXXX");
    if (mkdtemp(small_folder) == NULL)
        return 1;
    RUN(a_drop_is_its_disc);
    RUN(a_thin_drop_keeps_its_light);
    RUN(what_is_drawn_out_covers_as_much);
    RUN(a_wall_does_not_cut_a_drop);
    RUN(the_nearer_one_lies_over_the_farther_one);
    RUN(spray_glows_before_the_sun);
    remove(small_path("wall.obj"));
    rmdir(small_folder);
    return check_result();
}
