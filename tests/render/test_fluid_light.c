/* Proves of liquids among what else is lit: their shadows are what Beer and Lambert leave along the light's way through
 * them, of the sun and of a lamp, where the geometry says; they take the shadows of others; water mirrors and shows them
 * as it does an entity of the same shape; the reference mirrors and bends rays at their surface, and is near what is
 * drawn; a crop is cut out of the whole and lanes change no byte; and what no shadow of
 * may be seen is not stepped for one. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { SIDE = 97 };
#define HALF 2.25 /* metres of floor on each side of the middle that a picture from below the block shows */

/* Looks straight down from 1.5 m, below the block, at a white floor, which nothing lights but what is added. */
#define LIT                                                                                                            \
    "[output]\nwidth = 97\nheight = 97\nformat = 'rgb32f'\n[camera]\nposition = [0, 1.5, 0]\ntarget = [0, 0, 0]\n"     \
    "up = [0, 0, -1]\nfield_of_view = 112.619865\n[sky]\ncolor = [0, 0, 0]\n"
#define SUN "[light]\nelevation = 90\nintensity = 1\nambient = [0, 0, 0]\n[quality]\nentity_shadows = 1024\n"
#define LAMP                                                                                                           \
    "[light]\nintensity = 0\nambient = [0, 0, 0]\n[[lamp]]\nposition = [0, 8, 0]\ndiffuse = 1\nreach = 1000\n"         \
    "shadow = true\n"
#define MATTE "[entity.material]\nambient = 1\ndiffuse = 1\nspecular = 0\n"
#define FLOOR "[[entity]]\nname = 'floor'\nmesh = 'floor.obj'\n" MATTE
/* 2 m a side, and 2 m above the floor at the beginning. */
#define BLOCK                                                                                                          \
    "[[fluid]]\nname = 'block'\nlow = [-2, 1.6, -2]\nhigh = [2, 4.8, 2]\nspacing = 0.1\ncolor = [0, 0, 0]\n"           \
    "highlight = 0\nabsorption = [0.25, 0.5, 1]\n[[fluid.block]]\nlow = [-1, 2, -1]\nhigh = [1, 4, 1]\n"
static const char floor_obj[] = "v -40 0 40\nv 40 0 40\nv 40 0 -40\nv -40 0 -40\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\n";
static const char square_obj[] = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\n";
static const char cube_obj[] = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                               "vn 0 0 -1\nvn 0 0 1\nvn -1 0 0\nvn 1 0 0\nvn 0 -1 0\nvn 0 1 0\n"
                               "f 4//1 3//1 2//1 1//1\nf 5//2 6//2 7//2 8//2\nf 1//3 5//3 8//3 4//3\n"
                               "f 2//4 3//4 7//4 6//4\nf 1//5 2//5 6//5 5//5\nf 4//6 8//6 7//6 3//6\n";

struct drawn {
    lom_image *image;
    lom_plan plan;
    uint64_t steps;
};

static struct drawn draw_at(const char *text, const char *const *set, size_t sets, int lanes, lom_frame_desc desc)
{
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("fluid.toml"), set, sets, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 2, .lanes = lanes }, &error);
    CHECK(renderer != NULL && lom_render_frame(renderer, &desc, &frame, &error), "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return (struct drawn){ frame.image, frame.plan, frame.fluid_steps };
}

static lom_image *draw_with(const char *text, const char *set)
{
    return draw_at(text, &set, set != NULL, 0, (lom_frame_desc){ .frame = 0 }).image;
}

static const char *const traced[] = { "quality.water=reference", "quality.reference.samples=1",
                                      "fluid.block.visible=false" };

static double sample(const lom_image *image, int x, int y, int channel)
{
    return image == NULL ? -1 : (double)((const float *)lom_image_pixel(image, x, y, 0))[channel];
}

/* ---- what light loses in them ---- */

/* Metres that light goes through the block to a place x from the middle of the floor: from straight above, or from a
 * lamp 8 m up, whose ray is at x (8 - y) / 8 at the height y. */
static double way_through(double x, bool lamp)
{
    if (!lamp)
        return fabs(x) < 1 ? 2 : 0;
    const double out = fabs(x) > 1 ? 8 - 8 / fabs(x) : 0, low = fmax(2, out);
    return low < 4 ? (4 - low) * sqrt(64 + x * x) / 8 : 0;
}

static void check_shadow(const char *name, const char *light, bool lamp, double edge, bool traces)
{
    static const double absorption[3] = { 0.25, 0.5, 1 };
    char text[3000];
    snprintf(text, sizeof text, "%s%s%s", LIT, light, FLOOR BLOCK);
    const lom_frame_desc first = { .frame = 0 };
    lom_image *shaded = draw_at(text, traced, traces ? 2 : 0, 0, first).image;
    lom_image *open = draw_at(text, traces ? traced : traced + 2, traces ? 3 : 1, 0, first).image;
    double worst = 0, step = 2 * HALF / SIDE;
    int counted = 0;
    for (int column = 0; column < SIDE; column++)
        for (int channel = 0; channel < 3; channel++) {
            const double x = (column - SIDE / 2) * step, lit = sample(open, column, SIDE / 2, channel);
            const double exact = exp(-absorption[channel] * way_through(x, lamp));
            const double got = sample(shaded, column, SIDE / 2, channel) / lit;
            CHECK(lit > 0.1);
            if (fabs(fabs(x) - edge) < 0.25) /* edges are rounded by a spacing or two */
                continue;
            counted++;
            worst = fmax(worst, fabs(got - exact));
            CHECK(fabs(got - exact) < 0.03, "%s, %g m from the middle, channel %d: %g, not %g", name, x, channel, got,
                  exact);
        }
    printf("  %s: at most %.4f off in %d samples\n", name, worst, counted);
    CHECK(counted > 200);
    lom_free_image(shaded);
    lom_free_image(open);
}

static void light_behind_them_is_what_they_leave_of_it(void)
{
    check_shadow("the sun", SUN, false, 1, false);
    check_shadow("a lamp", LAMP, true, 2, false);
    check_shadow("the sun, traced", SUN, false, 1, true);
    check_shadow("a lamp, traced", LAMP, true, 2, true);
}

static void what_lets_nothing_through_is_dark_behind(void)
{
    lom_image *image = draw_with(LIT SUN FLOOR BLOCK, "fluid.block.absorption=1000");
    CHECK(sample(image, SIDE / 2, SIDE / 2, 0) == 0 && sample(image, 1, 1, 0) > 0.9);
    lom_free_image(image);
}

/* A white, opaque liquid under a square that keeps the sun off its middle, seen from beside the square. */
static void others_shade_them_and_they_not_themselves(void)
{
    static const char text[] =
        "[output]\nwidth = 97\nheight = 97\nformat = 'rgb32f'\n[camera]\nposition = [0, 5, 4]\ntarget = [0, 4, 0]\n"
        "field_of_view = 20\n[sky]\ncolor = [0, 0, 0]\n" SUN BLOCK
        "[[entity]]\nname = 'square'\nmesh = 'square.obj'\nposition = [0, 7, 0]\nscale = 0.5\n";
    static const char *const sets[] = { "fluid.block.absorption=1000", "fluid.block.color=[1,1,1]",
                                        "fluid.block.index=1", "entity.square.visible=false" };
    lom_image *shaded = draw_at(text, sets, 3, 0, (lom_frame_desc){ .frame = 0 }).image;
    lom_image *open = draw_at(text, sets, 4, 0, (lom_frame_desc){ .frame = 0 }).image;
    CHECK(fabs(sample(open, SIDE / 2, SIDE / 2, 0) - 1) < 0.02, "%g", sample(open, SIDE / 2, SIDE / 2, 0));
    CHECK(sample(shaded, SIDE / 2, SIDE / 2, 0) == 0, "%g", sample(shaded, SIDE / 2, SIDE / 2, 0));
    lom_free_image(shaded);
    lom_free_image(open);
}

/* ---- the reference ---- */

#define DOWN                                                                                                           \
    "[output]\nwidth = 33\nheight = 33\nformat = 'rgb32f'\n[camera]\nposition = [0, 10, 0]\ntarget = [0, 0, 0]\n"      \
    "up = [0, 0, -1]\nfield_of_view = 8\n[light]\nintensity = 0\nambient = [0.8, 0.8, 0.8]\nground = [0.8, 0.8, "      \
    "0.8]\n"
#define FULL                                                                                                           \
    "[[fluid]]\nlow = [-1, 0, -1]\nhigh = [1, 2, 1]\nspacing = 0.1\ncolor = [0, 0, 0]\nhighlight = 0\n"                \
    "absorption = [0.25, 0.5, 1]\n[[fluid.block]]\nlow = [-1, 0, -1]\nhigh = [1, 2, 1]\n"

/* Under a sky that is 1 all around light goes to and fro between top and bottom: L = e^(-2a) (1 - F + F L) within. What
 * lies on a floor has no air below it, and so nothing that mirrors. */
static void rays_are_mirrored_and_bent_by_their_surface(void)
{
    static const double absorption[3] = { 0.25, 0.5, 1 }, share = 0.0203729;
    const lom_frame_desc first = { .frame = 0 };
    lom_image *floating = draw_at(DOWN "[sky]\ncolor = [1, 1, 1]\n" FULL, traced, 2, 0, first).image;
    lom_image *lying = draw_at(DOWN "[sky]\ncolor = [0, 0, 0]\n" FLOOR FULL, traced, 2, 0, first).image;
    for (int i = 0; i < 3; i++) {
        const double through = exp(-2 * absorption[i]);
        const double within = through * (1 - share) / (1 - through * share);
        const double exact = share + (1 - share) * within, got = sample(floating, 16, 16, i);
        CHECK(fabs(got - exact) < 0.003, "floating, channel %d: %g, not %g", i, got, exact);
        const double below = (1 - share) * through * 0.8, floor = sample(lying, 16, 16, i);
        CHECK(fabs(floor - below) < 0.003, "on a floor, channel %d: %g, not %g", i, floor, below);
    }
    lom_free_image(floating);
    lom_free_image(lying);
}

/* ---- water ---- */

/* A red cube on one side of the water, as a liquid that lets nothing through and as an entity. The picture of the one is
 * that of the other but for the cube's edges, which a liquid rounds by a spacing; its index is that of what is around. */
#define SEEN                                                                                                           \
    "[output]\nwidth = 128\nheight = 96\n[camera]\nposition = [0, 3, 7]\ntarget = [0, 0, 0]\nfield_of_view = 40\n"     \
    "[light]\nintensity = 0\nambient = [0.6, 0.6, 0.6]\n[sky]\ncolor = [0.2, 0.4, 0.8]\n"
#define POOL "[water]\nlevel = 0\nsize = [40, 40]\n"

static void cube(char *text, size_t size, const char *model, double height, bool liquid)
{
    char thing[700];
    if (liquid)
        snprintf(thing, sizeof thing,
                 "[[fluid]]\nlow = [-1, %g, -1]\nhigh = [1, %g, 1]\nspacing = 0.05\ncolor = [0.9, 0.1, 0.1]\n"
                 "highlight = 0\nindex = %s\nabsorption = 10000\n[[fluid.block]]\nlow = [-1, %g, -1]\n"
                 "high = [1, %g, 1]\n",
                 height, height + 2, height < -2 ? "1.333" : "1", height, height + 2);
    else
        snprintf(thing, sizeof thing,
                 "[[entity]]\nmesh = 'cube.obj'\nposition = [0, %g, 0]\n[entity.material]\nambient = [0.9, 0.1, 0.1]\n"
                 "diffuse = [0.9, 0.1, 0.1]\nspecular = 0\n",
                 height + 1);
    snprintf(text, size, "%s%s%s[quality]\nwater = '%s'\n", SEEN, POOL, height > 100 ? "" : thing, model);
}

static double difference(const lom_image *a, const lom_image *b)
{
    lom_comparison c;
    lom_error error = { 0 };
    CHECK(a != NULL && b != NULL && lom_compare_images(a, b, &c, &error), "%s", error.text);
    return a != NULL && b != NULL ? c.rmse : 1e9;
}

static void water_shows_them_as_it_does_entities(void)
{
    static const char *const models[] = { "planar", "tinted", "normal_map", "displaced", "marched" };
    static const double heights[] = { 0.3, -2.4, -1 };
    for (size_t i = 0; i < sizeof models / sizeof *models; i++)
        for (size_t k = 0; k < 3; k++) {
            char text[2000];
            lom_image *image[3];
            for (int n = 0; n < 3; n++) {
                cube(text, sizeof text, models[i], n == 2 ? 1000 : heights[k], n == 1);
                image[n] = draw_with(text, NULL);
            }
            const double off = difference(image[0], image[1]), seen = difference(image[0], image[2]);
            printf("  %s at %g m: %.2f of 255 off, where the cube makes %.2f\n", models[i], heights[k], off, seen);
            CHECK(off < 0.25 * seen, "%s at %g m: %g, with the cube %g", models[i], heights[k], off, seen);
            for (int n = 0; n < 3; n++)
                lom_free_image(image[n]);
        }
}

/* The picture that is drawn is near the one that is traced: the bound is that of what bending and mirroring in the
 * frame's own pixels gives up. */
static void what_is_drawn_is_near_what_is_traced(void)
{
    static const char text[] = SEEN "[[entity]]\nmesh = 'floor.obj'\nposition = [0, -0.2, 0]\n" MATTE
                                    "[[fluid]]\nlow = [-2, -0.2, -1]\nhigh = [2, 1.8, 1]\nspacing = 0.1\n"
                                    "[[fluid.block]]\nlow = [-2, -0.2, -1]\nhigh = [-0.5, 1.2, 1]\n[quality]\n"
                                    "entity_shadows = 512\n";
    static const char *const sets[] = { "light.intensity=1", "light.elevation=50", "light.azimuth=40",
                                        "quality.water=reference", "quality.reference.samples=4" };
    const lom_frame_desc later = { .frame = 8 };
    lom_image *drawn = draw_at(text, sets, 3, 0, later).image, *rays = draw_at(text, sets, 5, 0, later).image;
    const double off = difference(drawn, rays);
    printf("  drawn and traced differ by %.2f of 255\n", off);
    CHECK(off < 13 && off > 0.1, "%g of 255", off);
    lom_free_image(drawn);
    lom_free_image(rays);
}

/* ---- the same bytes ---- */

#define OVER_WATER                                                                                                     \
    "[output]\nwidth = 64\nheight = 48\n[camera]\nposition = [1, 2, 5]\ntarget = [0, 0.4, 0]\n[light]\nazimuth = 30\n" \
    "elevation = 50\n[sky]\ngradient = true\n" POOL "[[entity]]\nmesh = 'floor.obj'\nposition = [0, -1, 0]\n"          \
    "[[lamp]]\nposition = [1, 3, 1]\ndiffuse = 1\nreach = 9\nshadow = true\n"                                          \
    "[[fluid]]\nlow = [-1.2, -0.6, -1]\nhigh = [1.2, 1.4, 1]\nspacing = 0.1\n"                                         \
    "[[fluid.block]]\nlow = [-1.2, -0.6, -1]\nhigh = [0, 0.8, 1]\n[quality]\nentity_shadows = 256\nlamp_shadows = "    \
    "64\n"

static void check_parts(const char *set)
{
    static const lom_rect parts[] = { { 0, 0, 20, 17 }, { 13, 20, 31, 11 }, { 40, 24, 24, 24 } };
    lom_image *whole = draw_at(OVER_WATER, &set, 1, 4, (lom_frame_desc){ .frame = 5 }).image;
    lom_image *wide = draw_at(OVER_WATER, &set, 1, 16, (lom_frame_desc){ .frame = 5 }).image;
    CHECK(whole != NULL && wide != NULL && lom_hash_image(whole) == lom_hash_image(wide), "%s", set);
    for (size_t i = 0; whole != NULL && i < sizeof parts / sizeof *parts; i++) {
        const lom_rect *r = &parts[i];
        lom_image *part = draw_at(OVER_WATER, &set, 1, 0, (lom_frame_desc){ .frame = 5, .crop = *r }).image;
        bool same = part != NULL;
        for (int y = 0; same && y < r->height; y++)
            same = memcmp(lom_image_pixel(part, 0, y, 0), lom_image_pixel(whole, r->x, r->y + y, 0),
                          (size_t)r->width * 3) == 0;
        CHECK(same, "%s, part %d", set, (int)i);
        lom_free_image(part);
    }
    lom_free_image(whole);
    lom_free_image(wide);
}

static void a_crop_is_cut_out_of_the_whole(void)
{
    check_parts("output.samples=1");
    check_parts("output.samples=4");
    check_parts("output.edges=smooth");
    check_parts("quality.water=displaced");
    check_parts("quality.reflection_scale=0.5");
}

/* ---- no more than is seen ---- */

static bool runs(const lom_plan *plan, const char *name)
{
    for (int i = 0; i < plan->count; i++)
        if (strcmp(plan->step[i].name, name) == 0 && plan->step[i].runs)
            return true;
    return false;
}

/* The sun is behind the eye, the basin too, and its shadow falls before it; or it falls behind. */
static void a_basin_is_stepped_for_a_shadow_that_is_seen(void)
{
    static const char *const sets[] = { "light.azimuth=180", "light.azimuth=0" };
    static const char text[] =
        "[camera]\nposition = [0, 1, 0]\ntarget = [0, 1, -9]\n[light]\nelevation = 10\n"
        "[quality]\nentity_shadows = 64\n" FLOOR "[[fluid]]\nlow = [-1, 0, 3]\nhigh = [1, 2, 5]\nspacing = 0.2\n"
        "[[fluid.block]]\nlow = [-1, 0, 3]\nhigh = [1, 1, 5]\n";
    const lom_frame_desc desc = { .frame = 3 };
    uint64_t steps = 0;
    int count = 0;
    for (size_t i = 0; i < 2; i++) {
        struct drawn drawn = draw_at(text, &sets[i], 1, 0, desc);
        CHECK(runs(&drawn.plan, "liquid shadow") == (drawn.steps > 0), "%s", sets[i]);
        CHECK(!runs(&drawn.plan, "fluid"));
        steps += drawn.steps;
        count += drawn.steps > 0;
        lom_free_image(drawn.image);
    }
    CHECK(count == 1, "%d of both, %d steps", count, (int)steps);
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !small_text("floor.obj", floor_obj, &error) ||
        !small_text("square.obj", square_obj, &error) || !small_text("cube.obj", cube_obj, &error))
        return 1;
    RUN(light_behind_them_is_what_they_leave_of_it);
    RUN(what_lets_nothing_through_is_dark_behind);
    RUN(others_shade_them_and_they_not_themselves);
    RUN(rays_are_mirrored_and_bent_by_their_surface);
    RUN(water_shows_them_as_it_does_entities);
    RUN(what_is_drawn_is_near_what_is_traced);
    RUN(a_crop_is_cut_out_of_the_whole);
    RUN(a_basin_is_stepped_for_a_shadow_that_is_seen);
    remove_small_scene();
    return check_result();
}
