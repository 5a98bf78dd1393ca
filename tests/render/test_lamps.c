/* Proves what lamps give: the attenuation of the table at its distances, the edge of a cone and its exponent, light from
 * infinity as the sun's, sums that are exact; the same in the reference; that what lists leave out changes no bit, at any
 * width, in any view; keys and what is followed; and the sentences of what cannot be. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { SIDE = 33, PIXELS = SIDE * SIDE };

/* Looks straight down from 40 m at a white plane of 80 m, 1 m a pixel in the middle; nothing shines but what is added. */
#define ROOM                                                                                                           \
    "[output]\nwidth = 33\nheight = 33\nformat = 'rgb32f'\n[camera]\nposition = [0, 40, 0]\ntarget = [0, 0, 0]\n"      \
    "up = [0, 0, -1]\nfield_of_view = 44.8\n[sky]\ncolor = [0, 0, 0]\n[light]\nintensity = 0\nambient = [0, 0, 0]\n"   \
    "[[entity]]\nmesh = 'floor.obj'\n"
#define DULL  "[entity.material]\nambient = 1\ndiffuse = 1\nspecular = 0\n"
#define SHINY "[entity.material]\nambient = 0\ndiffuse = 0\nspecular = 1\nshininess = 20\n"
static const char floor_obj[] = "v -40 0 40\nv 40 0 40\nv 40 0 -40\nv -40 0 -40\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\n";

/* The picture of a scene as floats, 3 a pixel; NULL after a failure. lanes 0: the widest. */
static lom_image *draw_at(const char *text, const char *const *set, size_t sets, int lanes, int frame)
{
    lom_error error = { 0 };
    lom_frame drawn = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("lamps.toml"), set, sets, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1, .lanes = lanes }, &error);
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ .frame = frame }, &drawn, &error);
    CHECK(done, "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done ? drawn.image : NULL;
}

static lom_image *draw(const char *text)
{
    return draw_at(text, NULL, 0, 0, 0);
}

static lom_image *trace(const char *text)
{
    static const char *const set[] = { "quality.water=reference", "quality.reference.samples=1" };
    return draw_at(text, set, 2, 0, 0);
}

/* Of a pixel counted from the middle. */
static double red(const lom_image *image, int x, int y)
{
    return (double)*(const float *)lom_image_pixel(image, SIDE / 2 + x, SIDE / 2 + y, 0);
}

/* How far a value may be off: corners are snapped to 1/256 of a pixel where triangles are drawn. */
static const double off[2] = { 2e-4, 1e-6 };
typedef lom_image *painter(const char *text);
static painter *const painters[2] = { draw, trace };
static const char *const painter_names[2] = { "drawn", "traced" };

/* ---- closed forms ---- */

static void the_table_covers_its_distances(void)
{
    static const double rows[][3] = {
        { 7, 0.7, 1.8 },        { 13, 0.35, 0.44 },     { 20, 0.22, 0.20 },     { 32, 0.14, 0.07 },
        { 50, 0.09, 0.032 },    { 65, 0.07, 0.017 },    { 100, 0.045, 0.0075 }, { 160, 0.027, 0.0028 },
        { 200, 0.022, 0.0019 }, { 325, 0.014, 0.0007 }, { 600, 0.007, 0.0002 }, { 3250, 0.0014, 0.000007 },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int p = 0; p < 2; p++) {
            char text[1000];
            const double d = rows[i][0], want = 0.5 / (1 + d * (rows[i][1] + d * rows[i][2]));
            snprintf(text, sizeof text, ROOM DULL "[[lamp]]\nposition = [0, %g, 0]\nrange = %g\ndiffuse = 0.5\n", d, d);
            lom_image *image = painters[p](text);
            if (image != NULL)
                CHECK(fabs(red(image, 0, 0) / want - 1) < 2e-6, "%s, %g m: %.9g, not %.9g", painter_names[p], d,
                      red(image, 0, 0), want);
            lom_free_image(image);
        }
}

/* Ambient light too, whichever way a surface faces; and all that is between the colours and the eye. */
static void each_place_has_its_attenuation_and_cosine(void)
{
    for (int p = 0; p < 2; p++) {
        lom_image *image = painters[p](ROOM DULL "[[lamp]]\nposition = [3, 5, -2]\nattenuation = [0.5, 0.1, 0.02]\n"
                                                 "ambient = 0.25\ndiffuse = 0.5\nintensity = 3\nreach = 1000\n");
        for (int i = 0; image != NULL && i < PIXELS; i++) {
            const double x = i % SIDE - SIDE / 2, z = i / SIDE - SIDE / 2, step = 80 * tan(22.4 * M_PI / 180) / SIDE;
            const double dx = x * step - 3, dz = z * step + 2, d = sqrt(dx * dx + dz * dz + 25);
            const double want = 3 * (0.25 + 0.5 * 5 / d) / (0.5 + 0.1 * d + 0.02 * d * d);
            const double is = red(image, i % SIDE - SIDE / 2, i / SIDE - SIDE / 2);
            CHECK(fabs(is / want - 1) < off[p], "%s, pixel %d: %.9g, not %.9g", painter_names[p], i, is, want);
        }
        lom_free_image(image);
    }
}

static void a_reach_ends_without_a_step(void)
{
    lom_image *image = draw(ROOM DULL "[[lamp]]\nposition = [0, 4, 0]\nambient = 1\ndiffuse = 0\nreach = 12\n");
    double last = 1;
    for (int x = 0; image != NULL && x <= SIDE / 2; x++) {
        const double place = x * 80 * tan(22.4 * M_PI / 180) / SIDE, d = sqrt(place * place + 16);
        const double t = fmin(fmax((12 - d) / 3, 0), 1), is = red(image, x, 0);
        CHECK(fabs(is - t * t * (3 - 2 * t)) < 2e-3, "at %g m: %g", d, is);
        CHECK(d > 9 || is == 1, "at %g m: %g", d, is);
        CHECK(d < 12 || is == 0, "at %g m: %g", d, is);
        CHECK(is <= last, "rises at %g m", d);
        last = is;
    }
    lom_free_image(image);
}

/* Inside as wide as its cutoff says and not a pixel wider, for cones of 0 to 90 degrees; with the exponent. */
static void a_cone_has_its_edge(void)
{
    static const double cutoffs[] = { 0, 10, 45, 60, 89, 90, 180 };
    static const double exponents[] = { 0, 1, 8 };
    for (int i = 0; i < 21; i++)
        for (int p = 0; p < 2; p++) {
            char text[1000];
            const double cutoff = cutoffs[i / 3], exponent = cutoff == 180 ? 0 : exponents[i % 3];
            snprintf(text, sizeof text,
                     ROOM DULL "[[lamp]]\nposition = [0, 10, 0]\ndirection = [0, -2, 0]\ncutoff = %g\nexponent = %g\n"
                               "ambient = 1\ndiffuse = 0\n",
                     cutoff, exponent);
            lom_image *image = painters[p](text);
            for (int k = 0; image != NULL && k < PIXELS; k++) {
                const int x = k % SIDE - SIDE / 2, y = k / SIDE - SIDE / 2;
                const double step = 80 * tan(22.4 * M_PI / 180) / SIDE, flat = sqrt(x * x + y * y) * step;
                const double angle = atan2(flat, 10) * 180 / M_PI, cosine = 10 / sqrt(flat * flat + 100);
                const double want = angle <= cutoff ? pow(cosine, exponent) : 0;
                if (fabs(angle - cutoff) > (p == 0 ? 0.02 : 1e-6) || angle == cutoff)
                    CHECK(fabs(red(image, x, y) - want) < off[p], "%s, cutoff %g, exponent %g, %g degrees: %g, not %g",
                          painter_names[p], cutoff, exponent, angle, red(image, x, y), want);
            }
            lom_free_image(image);
        }
}

static bool is_same(const lom_image *a, const lom_image *b)
{
    return a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b);
}

/* A lamp at infinity is the sun. */
static void light_from_infinity_is_the_suns(void)
{
    static const char *const materials[2] = { DULL, SHINY };
    for (int i = 0; i < 2; i++) {
        char text[1200];
        snprintf(
            text, sizeof text,
            "%s%s[[lamp]]\ndirection = [1, -2, 0.5]\ndiffuse = [0.5, 0.25, 0.125]\nspecular = [0.5, 0.25, 0.125]\n",
            ROOM, materials[i]);
        lom_image *lamp = draw(text);
        snprintf(text, sizeof text, "%s%s", ROOM, materials[i]);
        static const char *const sun[] = { "light.direction=[1,-2,0.5]", "light.intensity=1",
                                           "light.color=[0.5,0.25,0.125]" };
        lom_image *other = draw_at(text, sun, 3, 0, 0);
        CHECK(is_same(lamp, other), "material %d", i);
        CHECK(lamp != NULL && red(lamp, 0, 0) >= 0 && red(lamp, 10, 5) != 0, "black");
        lom_free_image(lamp);
        lom_free_image(other);
    }
}

/* On water too, by planar water's highlight and by the facets of waves. */
static void water_mirrors_lamps_as_the_sun(void)
{
    static const char *const waters[2] = {
        "[water]\nlevel = 0\nnormal_map = 'normal.png'\nshininess = 9\n[quality]\nwater = 'planar'\n",
        "[water]\nlevel = 0\n[water.optics]\nscatter = [0, 0, 0]\n[water.waves]\nkind = 'gerstner'\ncount = 3\n"
        "height = 0.3\n[quality]\nwater = 'displaced'\n"
    };
    static const char head[] = "[output]\nwidth = 33\nheight = 33\nformat = 'rgb32f'\n[camera]\nposition = [0, 4, 12]\n"
                               "[sky]\ncolor = [0.1, 0.1, 0.1]\n[light]\nintensity = 0\nambient = [0, 0, 0]\n";
    for (int i = 0; i < 2; i++) {
        char text[1600];
        snprintf(text, sizeof text, "%s%s[[lamp]]\ndirection = [0, -1, 2]\nspecular = [0.5, 0.25, 0.125]\n", head,
                 waters[i]);
        lom_image *lamp = draw(text);
        snprintf(text, sizeof text, "%s%s", head, waters[i]);
        static const char *const sun[] = { "light.direction=[0,-1,2]", "light.intensity=1",
                                           "light.color=[0.5,0.25,0.125]" };
        lom_image *other = draw_at(text, sun, 3, 0, 0), *dark = draw(text);
        CHECK(is_same(lamp, other), "water %d", i);
        CHECK(!is_same(lamp, dark), "water %d mirrors nothing", i);
        lom_free_image(lamp);
        lom_free_image(other);
        lom_free_image(dark);
    }
}

#define TWO                                                                                                            \
    "[[lamp]]\nname = 'a'\nposition = [3, 6, 1]\nrange = 20\ndiffuse = [2, 1, 0.3]\n[[lamp]]\nname = 'b'\n"            \
    "position = [-4, 3, 2]\nrange = 13\ndiffuse = [0.2, 1, 3]\ndirection = [0.3, -1, 0]\ncutoff = 50\n"

/* In floats, the rounded sum of both alone is that of both together, bit by bit. */
static void two_lamps_give_the_sum_of_each(void)
{
    static const char *const materials[2] = { DULL, SHINY };
    static const char *const one[2] = { "lamp.b.on=false", "lamp.a.on=false" };
    for (int i = 0; i < 2; i++) {
        char text[1600];
        snprintf(text, sizeof text, "%s%s%s", ROOM, materials[i], TWO);
        lom_image *both = draw(text), *a = draw_at(text, &one[0], 1, 0, 0), *b = draw_at(text, &one[1], 1, 0, 0);
        int lit = 0;
        for (int k = 0; both != NULL && a != NULL && b != NULL && k < PIXELS * 3; k++) {
            const float x = ((const float *)(void *)a->pixels)[k], y = ((const float *)(void *)b->pixels)[k];
            const float sum = ((const float *)(void *)both->pixels)[k];
            CHECK(sum == x + y, "material %d, sample %d: %.9g and %.9g are not %.9g", i, k, (double)x, (double)y,
                  (double)sum);
            lit += x > 0 && y > 0;
        }
        CHECK(lit > 100, "material %d: both light %d samples", i, lit);
        lom_free_image(both);
        lom_free_image(a);
        lom_free_image(b);
    }
}

/* ---- extremes (numerics.md, L1 to L3) ---- */

/* A lamp in the surface itself: no distance, no direction. */
static void l1_no_distance_is_finite(void)
{
    static const char *const attenuations[] = { "[0, 0, 1]", "[0, 1, 0]", "[1e-30, 0, 0]", "[0, 0, 1e-30]" };
    for (size_t i = 0; i < sizeof attenuations / sizeof *attenuations; i++)
        for (int p = 0; p < 2; p++) {
            char text[1000];
            snprintf(text, sizeof text,
                     ROOM DULL "[[lamp]]\nposition = [0, 0, 0]\nattenuation = %s\nreach = 30\nambient = 1\n"
                               "cutoff = 90\nspecular = 1\n",
                     attenuations[i]);
            lom_image *image = painters[p](text);
            for (int k = 0; image != NULL && k < PIXELS; k++) {
                const double is = red(image, k % SIDE - SIDE / 2, k / SIDE - SIDE / 2);
                CHECK(isfinite(is) && is >= 0 && is <= 2.1e6, "%s, %s: %g", painter_names[p], attenuations[i], is);
            }
            lom_free_image(image);
        }
}

/* What cannot be, each with its sentence. */
static void l2_and_l3_what_is_no_lamp_is_refused(void)
{
    static const struct {
        const char *keys, *sentence;
    } cases[] = {
        { "position = [0, 1, 0]\nattenuation = [0, 0, 0]", "not all 0" },
        { "position = [0, 1, 0]\nattenuation = [1, 0, 0]\nrange = 7", "either a range or its attenuation" },
        { "position = [0, 1, 0]\nrange = 6", "range" },
        { "position = [0, 1, 0]\ncutoff = 91", "at most 90 degrees" },
        { "position = [0, 1, 0]\ncutoff = -1", "cutoff" },
        { "position = [0, 1, 0]\ncutoff = 20\nsoftness = 21", "softer than the cone is wide" },
        { "position = [0, 1, 0]\nexponent = -1", "exponent" },
        { "position = [0, 1, 0]\ndirection = [0, 0, 0]", "must not be zero" },
        { "direction = [0, -1, 0]\ncutoff = 20", "shines from infinity" },
        { "direction = [0, -1, 0]\nreach = 20", "shines from infinity" },
        { "diffuse = 1", "needs a position" },
        { "position = [0, 1, 0]\nfollow = 'nobody'", "no entity has this name" },
        { "position = [0, 1, 0]\nname = 'a'\n[[lamp]]\nname = 'a'\nposition = [0, 1, 0]", "another lamp" },
        { "position = [0, 1, 0]\n[[lamp.key]]\ntime = 1\n[[lamp.key]]\ntime = 1", "must rise" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        lom_error error = { 0 };
        snprintf(text, sizeof text, "%s[[lamp]]\n%s\n", ROOM DULL, cases[i].keys);
        lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("lamps.toml"), NULL, 0, &error);
        CHECK(scene == NULL && error.code == LOM_ERROR_INPUT && strstr(error.text, cases[i].sentence) != NULL, "%s: %s",
              cases[i].keys, error.text);
        lom_free_scene(scene);
    }
}

/* ---- lists ---- */

/* Ground, an entity, water and many lamps: some at infinity, some without end, cones, some far away. */
static const char *many_lamps(const char *water)
{
    static char text[24000];
    size_t used = (size_t)snprintf(
        text, sizeof text,
        "[output]\nwidth = 96\nheight = 54\n[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n"
        "[light]\nintensity = 0.05\nambient = [0.01, 0.01, 0.02]\n[sky]\ngradient = true\n"
        "[terrain]\nheight_map = 'height.png'\nsize = 40\nheight = 6\nbase = -3\ntexture = 'color.png'\n"
        "[terrain.material]\nspecular = 0.2\n[water]\nlevel = 0\nnormal_map = 'normal.png'\n%s"
        "[[entity]]\nname = 'box'\nmesh = 'box.obj'\nposition = [0, 0.3, 2]\n",
        water);
    for (int i = 0; i < 90; i++) {
        const double r[4] = { lom_random_uniform(5, (uint64_t)i * 4), lom_random_uniform(5, (uint64_t)i * 4 + 1),
                              lom_random_uniform(5, (uint64_t)i * 4 + 2), lom_random_uniform(5, (uint64_t)i * 4 + 3) };
        if (i == 40) {
            used +=
                (size_t)snprintf(text + used, sizeof text - used, "[[lamp]]\ndirection = [1, -1, 0]\ndiffuse = 0.1\n");
            continue;
        }
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "[[lamp]]\nposition = [%.4f, %.4f, %.4f]\ndiffuse = [%.3f, 0.5, %.3f]\nrange = 7\n",
                                 r[0] * 44 - 22, r[1] * 5 - 1, r[2] * 44 - 22, r[3], 1 - r[3]);
        if (i % 30 != 7)
            used += (size_t)snprintf(text + used, sizeof text - used, "reach = %.3f\n", 0.5 + 6 * r[3]);
        if (i % 3 == 0)
            used += (size_t)snprintf(text + used, sizeof text - used,
                                     "cutoff = 70\nsoftness = 30\nexponent = 2\ndirection = [%.3f, -1, %.3f]\n", r[1],
                                     r[0]);
    }
    return text;
}

/* The eye near and far away, planar water and water with waves, light for fragments and for vertices. */
static void lists_change_no_bit_at_any_width(void)
{
    static const char *const waters[2] = {
        "[quality]\nwater = 'planar'\n", "[water.waves]\nkind = 'gerstner'\ncount = 3\n[quality]\nwater = 'displaced'\n"
    };
    static const char *const views[][2] = { { "quality.shading=phong", "camera.position=[0,3,12]" },
                                            { "quality.shading=gouraud", "camera.position=[5,2,9]" },
                                            { "quality.reflection=toon", "camera.position=[-60,40,200]" },
                                            { "quality.shading=flat", "camera.position=[3e5,3e4,0]" } };
    for (int w = 0; w < 2; w++)
        for (int v = 0; v < 4; v++) {
            const char *text = many_lamps(waters[w]);
            const char *const with[] = { views[v][0], views[v][1], v == 3 ? "camera.field_of_view=0.01" : "title=''" };
            const char *const without[] = { with[0], with[1], with[2], "quality.lamp_tiles=false" };
            lom_image *a = draw_at(text, with, 3, 4, 0), *b = draw_at(text, without, 4, 4, 0);
            lom_image *c = draw_at(text, with, 3, 8, 0);
            CHECK(is_same(a, b), "water %d, view %d: lists change the picture", w, v);
            CHECK(is_same(a, c), "water %d, view %d: 4 and 8 lanes differ", w, v);
            lom_free_image(a);
            lom_free_image(b);
            lom_free_image(c);
        }
}

/* ---- keys, and what is followed ---- */

static void keys_move_a_lamp(void)
{
    static const char moving[] = ROOM DULL
        "[[lamp]]\nposition = [0, 1, 0]\nrange = 20\n[[lamp.key]]\ntime = 0\nposition = [0, 2, 0]\nintensity = 2\n"
        "[[lamp.key]]\ntime = 2\nposition = [8, 6, -4]\nintensity = 4\n";
    static const char still[] = ROOM DULL "[[lamp]]\nposition = [4, 4, -2]\nrange = 20\nintensity = 3\n";
    lom_image *a = draw_at(moving, NULL, 0, 0, 30), *b = draw(still);
    CHECK(is_same(a, b), "half way");
    lom_free_image(a);
    lom_free_image(b);
}

/* Turned by 90 degrees about y, what is ahead (-z) is at -x; the entity's scale is not the lamp's. */
static void a_lamp_goes_with_its_entity(void)
{
    static const char there[] = "[[lamp]]\nposition = [7, 3, 4]\nrange = 20\ncutoff = 60\ndirection = [-1, -1, 0]\n";
    static const char with[] = "[[lamp]]\nposition = [0, 2, -3]\nrange = 20\ncutoff = 60\ndirection = [0, -1, -1]\n"
                               "follow = 'box'\n";
    static const char box[] = "[[entity]]\nname = 'box'\nmesh = 'box.obj'\nposition = [10, 1, 4]\nscale = 0.5\n"
                              "rotation = [0, 90, 0]\n";
    static const char *const hidden[] = { "entity.box.visible=false" };
    char text[2][2000];
    snprintf(text[0], sizeof text[0], "%s%s%s", ROOM DULL, box, there);
    snprintf(text[1], sizeof text[1], "%s%s%s", ROOM DULL, box, with);
    lom_image *a = draw(text[0]), *b = draw(text[1]), *c = draw_at(text[1], hidden, 1, 0, 0);
    for (int k = 0; a != NULL && b != NULL && k < PIXELS * 3; k++) {
        const double x = (double)((const float *)(void *)a->pixels)[k],
                     y = (double)((const float *)(void *)b->pixels)[k];
        CHECK(fabs(x - y) <= 1e-5, "sample %d: %g, not %g", k, y, x);
    }
    CHECK(b != NULL && red(b, 3, 2) > 0, "dark");
    for (int k = 0; c != NULL && k < PIXELS * 3; k++)
        CHECK(((const float *)(void *)c->pixels)[k] == 0, "lit by the lamp of what is hidden");
    lom_free_image(a);
    lom_free_image(b);
    lom_free_image(c);
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !small_text("floor.obj", floor_obj, &error))
        return 1;
    RUN(the_table_covers_its_distances);
    RUN(each_place_has_its_attenuation_and_cosine);
    RUN(a_reach_ends_without_a_step);
    RUN(a_cone_has_its_edge);
    RUN(light_from_infinity_is_the_suns);
    RUN(water_mirrors_lamps_as_the_sun);
    RUN(two_lamps_give_the_sum_of_each);
    RUN(l1_no_distance_is_finite);
    RUN(l2_and_l3_what_is_no_lamp_is_refused);
    RUN(lists_change_no_bit_at_any_width);
    RUN(keys_move_a_lamp);
    RUN(a_lamp_goes_with_its_entity);
    remove_small_scene();
    return check_result();
}
