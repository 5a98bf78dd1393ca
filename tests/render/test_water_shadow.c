/* Proves the shadows that entities throw on water: that where a wall hides the sun there is no glint and foam is lit by the
 * sky alone, bit for bit, and that beside the shadow no bit changes, on each model of water; that the reference finds the
 * same shadow in the glitter; that lanes and crops change no byte; and that maps are drawn for a shadow that falls on
 * water alone, and for none where no water shows the sun. */
#include "check.h"
#include "drawn_scene.h"
#include "small_scene.h"

#include <math.h>

enum { WIDTH = 160, HEIGHT = 90, PIXELS = WIDTH * HEIGHT };

/* The sun stands before the eye; a wall of 4 m goes from x = -40 to 0 at z = -10, so its shadow ends at z = -2. */
#define SCENE                                                                                                          \
    "[output]\nwidth = 160\nheight = 90\nformat = 'rgb32f'\n[camera]\nposition = [0, 5, 12]\ntarget = [0, 0, -4]\n"    \
    "field_of_view = 60\n[sky]\ncolor = [0.2, 0.3, 0.4]\n[light]\ndirection = [0, -1, 2]\n"                            \
    "ambient = [0.1, 0.2, 0.3]\n[water]\nlevel = 0\nsize = [300, 300]\n"
#define PLANAR    "normal_map = 'level.ppm'\nshininess = 3\nsoft_shore = false\n[quality]\nwater = 'planar'\n"
#define FLAT      "[water.optics]\nroughness = 0.05\n[quality]\nwater = 'normal_map'\n"
#define MARCHED   "[water.optics]\nroughness = 0.05\n[quality]\nwater = 'marched'\n"
#define DISPLACED "[water.optics]\nroughness = 0.05\n[quality]\nwater = 'displaced'\n"
#define WALL      "[[entity]]\nmesh = 'wall.obj'\nposition = [0, 0, -10]\n[entity.material]\nspecular = 0\n"
static const char wall_obj[] = "v -40 0 0\nv 0 0 0\nv 0 4 0\nv -40 4 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
static const char *const waters[] = { PLANAR, FLAT, MARCHED, DISPLACED };
enum { WATERS = sizeof waters / sizeof *waters };

static const char shadows[] = "quality.entity_shadows=1024", none[] = "quality.entity_shadows=0";

static lom_image *draw_with(const char *text, const char *a, const char *b)
{
    const char *const set[] = { a, b };
    return draw(text, set, b != NULL ? 2 : 1, 0, (lom_rect){ 0 }, NULL);
}

static const float *pixel(const lom_image *image, int x, int y)
{
    return lom_image_pixel(image, x, y, 0);
}

static bool is_same_at(const lom_image *a, const lom_image *b, int x, int y)
{
    return memcmp(pixel(a, x, y), pixel(b, x, y), 3 * sizeof(float)) == 0;
}

/* Nothing but 2^-22 of what the sun adds to `bare`, which the weights of the filter leave. */
static bool is_dark_at(const lom_image *is, const lom_image *lit, const lom_image *bare, int x, int y)
{
    for (int i = 0; i < 3; i++) {
        const double base = (double)pixel(bare, x, y)[i], sun = (double)pixel(lit, x, y)[i] - base;
        if (fabs((double)pixel(is, x, y)[i] - base) > 0x1p-22 * (fabs(sun) + base))
            return false;
    }
    return true;
}

/* Where the middle of a pixel meets the level; false: nowhere on the water before the wall. */
static bool find_place(int x, int y, double place[2])
{
    const double length = sqrt(5 * 5 + 16 * 16), down = 5 / length, ahead = 16 / length, k = tan(M_PI / 6);
    const double u = (2 * (x + 0.5) / WIDTH - 1) * k * WIDTH / HEIGHT, v = (1 - 2 * (y + 0.5) / HEIGHT) * k;
    const double fall = down - v * ahead, t = 5 / fall;
    place[0] = u * t;
    place[1] = 12 - (ahead + v * down) * t;
    return fall > 0 && place[1] > -9.5 && fabs(place[0]) < 39;
}

/* How far into the shadow a place is; less than 0: out of it. Metres along the nearer of its edges. */
static double into_shadow(const double place[2])
{
    return fmin(-2 - place[1], -place[0]);
}

/* Texels of the map are 4 cm; the filter reaches 1.5 of them. */
static const double edge = 0.2;

/* `bare`: the water without what the shadow hides. */
static void check_shadow(const char *name, const lom_image *is, const lom_image *lit, const lom_image *bare)
{
    int dark = 0, open = 0, shows = 0;
    for (int i = 0; is != NULL && lit != NULL && bare != NULL && i < PIXELS; i++) {
        double place[2];
        const int x = i % WIDTH, y = i / WIDTH;
        if (!find_place(x, y, place) || fabs(into_shadow(place)) < edge)
            continue;
        const bool shaded = into_shadow(place) > 0;
        dark += shaded;
        open += !shaded;
        shows += !is_same_at(lit, bare, x, y);
        CHECK(shaded ? is_dark_at(is, lit, bare, x, y) : is_same_at(is, lit, x, y),
              "%s: %.9g at %d,%d (%g, %g), %s %.9g", name, (double)*pixel(is, x, y), x, y, place[0], place[1],
              shaded ? "shaded" : "open", (double)*pixel(shaded ? bare : lit, x, y));
    }
    CHECK(dark > 700 && open > 2000, "%s: %d dark and %d open places", name, dark, open);
    CHECK(shows > 2900, "%s: the sun shows at %d places", name, shows);
}

static void glints_end_at_the_shadow(void)
{
    static const char *const bare[WATERS] = { "water.specular=false", "water.optics.glitter=0",
                                              "water.optics.glitter=0", "water.optics.glitter=0" };
    for (int i = 0; i < WATERS; i++) {
        char text[1600];
        snprintf(text, sizeof text, SCENE "%s" WALL, waters[i]);
        lom_image *is = draw_with(text, shadows, NULL), *lit = draw_with(text, none, NULL);
        lom_image *without = draw_with(text, none, bare[i]);
        check_shadow(waters[i], is, lit, without);
        lom_free_image(is);
        lom_free_image(lit);
        lom_free_image(without);
    }
}

/* Under foam that covers all, what is left in the shadow is the ambient light: that of a sun of no intensity. */
#define FOAM                                                                                                           \
    "[water.optics]\nroughness = 0.05\nglitter = 0\n[water.foam]\namount = 1\nshore_depth = 100\n[quality]\n"          \
    "water = 'displaced'\n[[entity]]\nmesh = 'bed.obj'\n[entity.material]\nambient = 0\ndiffuse = 0\nspecular = 0\n"
static const char bed_obj[] = "v -90 -1 90\nv 90 -1 90\nv 90 -1 -90\nv -90 -1 -90\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\n";

static void foam_is_dark_in_the_shadow(void)
{
    lom_image *is = draw_with(SCENE FOAM WALL, shadows, "water.optics.scatter=[0,0,0]");
    lom_image *lit = draw_with(SCENE FOAM WALL, none, "water.optics.scatter=[0,0,0]");
    const char *const dark[] = { none, "water.optics.scatter=[0,0,0]", "light.intensity=0" };
    lom_image *bare = draw(SCENE FOAM WALL, dark, 3, 0, (lom_rect){ 0 }, NULL);
    check_shadow("foam", is, lit, bare);
    lom_free_image(is);
    lom_free_image(lit);
    lom_free_image(bare);
}

/* ---- the reference ---- */

/* The mean over 16 x 5 pixels about a place of what the sun adds there, red. */
static double glints_about(const lom_image *image, const lom_image *without, int x, int y)
{
    double sum = 0;
    for (int i = 0; i < 80; i++) {
        const int column = x - 8 + i % 16, row = y - 2 + i / 16;
        sum += (double)*pixel(image, column, row) - (double)*pixel(without, column, row);
    }
    return sum / 80;
}

/* The tracer knows no maps: its glitter is the sun's disc in ripples, which the wall hides. Left of the middle is the shadow,
 * right of it the path of light at as much of an angle from the sun. The disc is small enough for the wall to hide all of it:
 * facets that mirror one after the other find the edge of a larger one. */
static void the_reference_has_the_same_shadow(void)
{
    static const char *const off = "water.optics.glitter=0", *const on = "water.optics.glitter=1";
    lom_image *fast[2], *slow[2], *open = draw_with(SCENE FLAT WALL, none, on);
    for (int i = 0; i < 2; i++) {
        const char *const exact[] = { shadows, "quality.water=reference", "quality.reference.samples=64",
                                      "quality.reference.sun=3", i == 0 ? on : off };
        fast[i] = draw_with(SCENE FLAT WALL, shadows, exact[4]);
        slow[i] = draw(SCENE FLAT WALL, exact, 5, 0, (lom_rect){ 0 }, NULL);
    }
    for (int side = -1; fast[0] != NULL && fast[1] != NULL && slow[0] != NULL && slow[1] != NULL && side <= 1;
         side += 2) {
        const int x = WIDTH / 2 + side * 14, y = 43;
        const double is = glints_about(fast[0], fast[1], x, y), other = glints_about(slow[0], slow[1], x, y);
        const double bare = glints_about(open, fast[1], x, y);
        CHECK(bare > 0.1, "glints of %g", bare);
        CHECK(fabs(is - other) < 0.05 * bare, "%s: %g drawn, %g traced, %g without a wall",
              side < 0 ? "shaded" : "open", is, other, bare);
        CHECK(side > 0 || other < 1e-6 * bare, "%g traced of %g", other, bare);
    }
    lom_free_image(open);
    for (int i = 0; i < 2; i++) {
        lom_free_image(fast[i]);
        lom_free_image(slow[i]);
    }
}

/* ---- what changes nothing ---- */

static void lanes_and_crops_change_no_byte(void)
{
    const lom_rect crop = { 37, 30, 60, 41 };
    const char *const set[] = { shadows };
    lom_image *a = draw(SCENE FLAT WALL, set, 1, 4, (lom_rect){ 0 }, NULL);
    lom_image *b = draw(SCENE FLAT WALL, set, 1, 16, (lom_rect){ 0 }, NULL);
    lom_image *part = draw(SCENE FLAT WALL, set, 1, 16, crop, NULL);
    CHECK(a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b), "4 and 16 lanes differ");
    for (int y = 0; a != NULL && part != NULL && y < crop.height; y++)
        for (int x = 0; x < crop.width; x++)
            CHECK(is_same_at(part, a, x, y) || memcmp(pixel(part, x, y), pixel(a, x + crop.x, y + crop.y), 12) == 0,
                  "%d,%d of the crop", x, y);
    lom_free_image(a);
    lom_free_image(b);
    lom_free_image(part);
}

static bool runs(const char *text, const char *set, const char *step)
{
    lom_plan plan = { .count = 0 };
    const char *const sets[] = { shadows, set };
    bool found = false;
    lom_free_image(draw(text, sets, 2, 0, (lom_rect){ 0 }, &plan));
    for (int i = 0; i < plan.count; i++)
        found |= strcmp(plan.step[i].name, step) == 0 && plan.step[i].runs;
    return found;
}

/* The eye looks down on water with nothing else in view. */
static void maps_follow_what_water_shows(void)
{
    const char *const away = "camera.target=[0,0,9]";
    CHECK(runs(SCENE FLAT WALL, "camera.target=[-6,0,5]", "near shadow"), "no map though the sun's glints are in view");
    CHECK(!runs(SCENE "[water.optics]\nglitter = 0\n[quality]\nwater = 'normal_map'\n" WALL, away, "near shadow"),
          "a map though water shows no sun");
    CHECK(!runs(SCENE PLANAR "[water.optics]\nroughness = 0\n" WALL, "water.specular=false", "near shadow") ||
              runs(SCENE PLANAR WALL, away, "near shadow"),
          "planar water without a highlight");
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    static const char level[] = "P3 1 1 255 128 128 255\n";
    if (!make_small_scene() || !small_text("wall.obj", wall_obj, &error) || !small_text("bed.obj", bed_obj, &error) ||
        !small_text("level.ppm", level, &error))
        return 1;
    RUN(glints_end_at_the_shadow);
    RUN(foam_is_dark_in_the_shadow);
    RUN(the_reference_has_the_same_shadow);
    RUN(lanes_and_crops_change_no_byte);
    RUN(maps_follow_what_water_shows);
    remove_small_scene();
    return check_result();
}
