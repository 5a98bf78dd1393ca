/* Proves what entities that are transparent come to: panes lie over what is behind them by the sum of both, whatever the
 * order of entities, triangles and materials in files; both sides are seen; a map leaves holes; no shadow is thrown; water
 * shows them below and mirrored, and is in front of what is below it; the reference of rays sees the same; workers, lanes,
 * tiles and crops change no byte; and a scene without any draws what it drew before. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };

/* Looks straight down from 30 m at panes of 40 x 40 m, which fill the view. */
static const char head[] =
    "[output]\nwidth = 48\nheight = 32\nformat = 'rgb32f'\n[camera]\nposition = [0, 30, 0]\ntarget = [0, 0, 0]\n"
    "up = [0, 0, -1]\nfield_of_view = 30\n[sky]\ncolor = [0, 0, 0]\n";
#define EVEN "[light]\nintensity = 0\nambient = [1, 1, 1]\nground = [1, 1, 1]\n"
#define SUN  "[light]\ndirection = [1, -1, 0]\nambient = [0.2, 0.2, 0.2]\nground = [0.2, 0.2, 0.2]\n"
#define PANE(y, light, more)                                                                                           \
    "[[entity]]\nmesh = 'pane.obj'\nposition = [0, " y ", 0]\n[entity.material]\nambient = " light "\n" more "\n"
#define FLOOR PANE("0", "0.2", "diffuse = 0.5")

struct drawn {
    float red[PIXELS];
    lom_plan plan;
    lom_counters counters;
};

static bool draw_by(const lom_device_desc *device, const char *things, struct drawn *out)
{
    static char text[6000];
    lom_error error = { 0 };
    snprintf(text, sizeof text, "%s%s", head, things);
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("panes.toml"), NULL, 0, &error);
    lom_renderer *renderer = scene == NULL ? NULL : lom_create_renderer(scene, device, &error);
    lom_frame drawn = { .image = NULL };
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ 0 }, &drawn, &error);
    CHECK(done, "%s", error.text);
    for (int i = 0; done && i < PIXELS; i++)
        out->red[i] = *(const float *)lom_image_pixel(drawn.image, i % WIDTH, i / WIDTH, 0);
    out->plan = drawn.plan;
    out->counters = drawn.counters;
    lom_free_image(drawn.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

static bool draw(const char *things, struct drawn *out)
{
    return draw_by(&(lom_device_desc){ .threads = 1 }, things, out);
}

static const lom_step *step_of(const struct drawn *d, const char *name)
{
    for (int i = 0; i < d->plan.count; i++)
        if (strcmp(d->plan.step[i].name, name) == 0)
            return &d->plan.step[i];
    return NULL;
}

static void all_are(const struct drawn *d, double expected, const char *what)
{
    for (int i = 0; i < PIXELS; i++)
        CHECK(fabs((double)d->red[i] - expected) < 2e-6, "%s, pixel %d: %.8g, not %.8g", what, i, (double)d->red[i],
              expected);
}

static struct drawn a, b, c;

/* ---- the order ---- */

static void panes_lie_over_one_another(void)
{
    static const char *const panes[3] = { FLOOR, PANE("2", "0.8", "opacity = 0.25"),
                                          PANE("5", "0.1", "opacity = 0.5") };
    static const int orders[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } };
    for (int n = 0; n < 6; n++) {
        char things[2000];
        snprintf(things, sizeof things, EVEN "%s%s%s", panes[orders[n][0]], panes[orders[n][1]], panes[orders[n][2]]);
        if (!draw(things, n == 0 ? &a : &b))
            return;
        if (n > 0)
            CHECK(memcmp(a.red, b.red, sizeof a.red) == 0, "order %d of the file is seen", n);
    }
    all_are(&a, 0.5 * 0.1 + 0.5 * (0.25 * 0.8 + 0.75 * 0.2), "two panes over a floor");
    const lom_step *step = step_of(&a, "transparent");
    CHECK(step != NULL && step->runs && strstr(step->text, "the farthest first") != NULL, "the plan says \"%s\"",
          step != NULL ? step->text : "nothing");
}

/* One mesh of two layers, by MTL; its triangles, and so its parts, in both orders. */
static void layers_of_a_mesh_are_sorted(void)
{
    static const char corners[] = "mtllib layers.mtl\nv -20 2 -20\nv 20 2 -20\nv 20 2 20\nv -20 2 20\n"
                                  "v -20 5 -20\nv 20 5 -20\nv 20 5 20\nv -20 5 20\n";
    static const char *const low = "usemtl low\nf 4 3 1\nf 3 2 1\n", *const high = "usemtl high\nf 8 7 5\nf 7 6 5\n";
    lom_error error = { 0 };
    char text[2][1000];
    snprintf(text[0], sizeof text[0], "%s%s%s", corners, low, high);
    snprintf(text[1], sizeof text[1], "%s%s%s", corners, high, low);
    CHECK(small_text("layers.mtl", "newmtl low\nKa .8 .8 .8\nd .25\nnewmtl high\nKa .1 .1 .1\nTr .5\n", &error) &&
              small_text("up.obj", text[0], &error) && small_text("down.obj", text[1], &error),
          "%s", error.text);
    if (!draw(EVEN FLOOR "[[entity]]\nmesh = 'up.obj'\n", &a) ||
        !draw(EVEN FLOOR "[[entity]]\nmesh = 'down.obj'\n", &b))
        return;
    all_are(&a, 0.5 * 0.1 + 0.5 * (0.25 * 0.8 + 0.75 * 0.2), "two layers over a floor");
    CHECK(memcmp(a.red, b.red, sizeof a.red) == 0, "the order of a mesh's triangles is seen");
}

/* ---- what is seen ---- */

static void both_sides_are_seen(void)
{
    static const char *const models[] = { "phong", "gouraud", "flat" };
    for (int m = 0; m < 3; m++) {
        char things[2][1500];
        for (int turned = 0; turned < 2; turned++)
            snprintf(things[turned], sizeof things[turned],
                     "[quality]\nshading = '%s'\n" SUN FLOOR "[[entity]]\nmesh = 'pane.obj'\nposition = [0, 3, 0]\n"
                     "rotation = [%d, 0, 0]\n[entity.material]\nopacity = 0.5\nspecular = 0.4\n",
                     models[m], turned * 180);
        if (!draw(things[0], &a) || !draw(things[1], &b))
            return;
        for (int i = 0; i < PIXELS; i++)
            CHECK(fabsf(a.red[i] - b.red[i]) < 1e-5f && a.red[i] > 0.3f, "%s, pixel %d: %g, and turned round %g",
                  models[m], i, (double)a.red[i], (double)b.red[i]);
    }
}

/* Of a two-sided entity a pane turned over shows its back, by rays too. */
static void backs_have_their_own_material(void)
{
    static const char back[] =
        "[[entity]]\nmesh = 'pane.obj'\nposition = [0, 3, 0]\nrotation = [%s, 0, 0]\ntwo_sided = true\n"
        "[entity.material]\nambient = 0.8\nopacity = 0.25\n[entity.back]\nambient = 0.4\n";
    for (int turned = 0; turned < 2; turned++)
        for (int rays = 0; rays < 2; rays++) {
            char things[2000];
            int used = snprintf(things, sizeof things, "%s" EVEN FLOOR,
                                rays ? "[quality]\nwater = 'reference'\nreference.samples = 1\n" : "");
            snprintf(things + used, sizeof things - (size_t)used, back, turned ? "180" : "0");
            if (!draw(things, &a))
                return;
            all_are(&a, 0.25 * (turned ? 0.4 : 0.8) + 0.75 * 0.2, rays ? "by rays" : "drawn");
        }
}

/* A picture whose left half is 0: by its red, or by its alpha while red says the contrary. */
static bool put_holes(bool alpha)
{
    lom_error error = { 0 };
    lom_image *map = lom_create_image(64, 4, 1, alpha ? LOM_FORMAT_RGBA8 : LOM_FORMAT_R8, &error);
    for (int i = 0; i < 64 * 4; i++) {
        uint8_t there = i % 64 < 32 ? 0 : 255;
        if (alpha)
            memset(map->pixels + (ptrdiff_t)4 * i, 255 - there, 3);
        map->pixels[alpha ? 4 * i + 3 : i] = there;
    }
    bool put = lom_write_image(small_path("holes.png"), NULL, map, &error);
    CHECK(put, "%s", error.text);
    lom_free_image(map);
    return put;
}

/* Where the map is 0 nothing is, not even a highlight; the other half is as without it. */
static void maps_leave_holes(void)
{
    for (int alpha = 0; alpha < 2; alpha++) {
        static const char shine[] = "specular = 3\nshininess = 1\nopacity = 0.75\n";
        char things[2][1500];
        snprintf(things[0], sizeof things[0], SUN FLOOR PANE("3", "0.7", "%sopacity_map = 'holes.png'"), shine);
        snprintf(things[1], sizeof things[1], SUN FLOOR PANE("3", "0.7", "%s"), shine);
        if (!put_holes(alpha) || !draw(SUN FLOOR, &a) || !draw(things[0], &b) || !draw(things[1], &c))
            return;
        for (int i = 0; i < PIXELS; i++) {
            int x = i % WIDTH;
            float expected = x < WIDTH / 2 ? a.red[i] : c.red[i];
            if (x > WIDTH / 2 - 3 && x < WIDTH / 2 + 2)
                continue;
            CHECK(fabsf(b.red[i] - expected) < 1e-5f && fabsf(a.red[i] - c.red[i]) > 0.1f,
                  "map %d, pixel %d: %g, not %g", alpha, i, (double)b.red[i], (double)expected);
        }
    }
}

/* The same picture by MTL: d, and map_d, which the scene's own keys replace. */
static void materials_of_files_and_of_scenes_are_the_same(void)
{
    lom_error error = { 0 };
    static const char scene[] = EVEN FLOOR "[[entity]]\nmesh = 'file.obj'\nposition = [0, 3, 0]\n";
    char own[1000], text[1000];
    snprintf(text, sizeof text, "mtllib file.mtl\nusemtl glass\n%s",
             "v -20 0 -20\nv 20 0 -20\nv 20 0 20\nv -20 0 20\n"
             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 1 0\n"
             "f 4/4/1 3/3/1 2/2/1 1/1/1\n");
    snprintf(own, sizeof own, "%s[entity.material]\nopacity = 1\n", scene);
    CHECK(small_text("file.obj", text, &error) &&
              small_text("file.mtl", "newmtl glass\nKa .6 .6 .6\nd .5\nmap_d -clamp on holes.png\n", &error),
          "%s", error.text);
    if (!put_holes(true) || !draw(scene, &a) || !draw(own, &b))
        return;
    CHECK(fabsf(a.red[40] - (0.5f * 0.6f + 0.5f * 0.2f)) < 1e-6f && fabsf(a.red[5] - 0.2f) < 1e-6f,
          "by the file: %g in the hole, %g beside it", (double)a.red[5], (double)a.red[40]);
    CHECK(fabsf(b.red[40] - 0.6f) < 1e-6f && fabsf(b.red[5] - 0.2f) < 1e-6f, "opacity of the scene: %g, %g",
          (double)b.red[5], (double)b.red[40]);
}

/* The pane covers x < 0; its shadow would fall 5 m to the right. */
static void no_shadow_is_thrown(void)
{
    static const char scene[] =
        "[quality]\nentity_shadows = 256\n" SUN FLOOR "[[entity]]\nmesh = 'pane.obj'\nposition = [-20, 5, 0]\n"
        "[entity.material]\n%s\n";
    char things[2][1500];
    snprintf(things[0], sizeof things[0], scene, "opacity = 0.99");
    snprintf(things[1], sizeof things[1], scene, "opacity = 1");
    if (!draw(things[0], &a) || !draw(things[1], &b) || !draw("[quality]\nentity_shadows = 256\n" SUN FLOOR, &c))
        return;
    int shaded = 0;
    for (int i = 0; i < PIXELS; i++) {
        shaded += i % WIDTH > WIDTH / 2 + 1 && b.red[i] < c.red[i] - 0.05f;
        CHECK(i % WIDTH <= WIDTH / 2 + 1 || fabsf(a.red[i] - c.red[i]) < 1e-5f, "pixel %d: %g, not %g", i,
              (double)a.red[i], (double)c.red[i]);
    }
    CHECK(shaded > PIXELS / 10, "only %d pixels lie in the shadow of an opaque pane", shaded);
}

/* ---- water ---- */

#define WATER(more) "[water]\nlevel = 1\nsize = 60\nflow = false\ncolor = [0.1, 0.2, 0.3]\n" more "\n"
#define ABOVE       PANE("3", "0.8", "opacity = 0.25")
#define BELOW       PANE("0.5", "0.8", "opacity = 0.25")

static double largest_difference(const struct drawn *p, const struct drawn *q)
{
    double most = 0;
    for (int i = 0; i < PIXELS; i++)
        most = fmax(most, fabs((double)p->red[i] - (double)q->red[i]));
    return most;
}

#define PLANAR "[quality]\nwater = 'planar'\n" EVEN FLOOR

static void water_lies_between(void)
{
    if (!draw(PLANAR WATER("reflection = false"), &a) || !draw(PLANAR ABOVE WATER("reflection = false"), &b))
        return;
    for (int i = 0; i < PIXELS; i++)
        CHECK(fabs((double)b.red[i] - (0.25 * 0.8 + 0.75 * (double)a.red[i])) < 1e-5, "pixel %d over the water: %g", i,
              (double)b.red[i]);
    CHECK(step_of(&b, "transparent") != NULL && step_of(&b, "transparent")->runs, "the plan does not say so");
    /* Mirrored: what the pane lies over is another water. */
    if (!draw(PLANAR WATER("reflection = true"), &a) || !draw(PLANAR ABOVE WATER("reflection = true"), &b))
        return;
    double most = 0;
    for (int i = 0; i < PIXELS; i++)
        most = fmax(most, fabs((double)b.red[i] - (0.25 * 0.8 + 0.75 * (double)a.red[i])));
    CHECK(most > 1e-3, "the water does not mirror the pane: %g", most);
    /* Below: through the water, and nowhere without a picture of what is below it. */
    if (!draw(PLANAR WATER(""), &a) || !draw(PLANAR BELOW WATER(""), &b))
        return;
    CHECK(largest_difference(&a, &b) > 1e-2, "what is below the water is not seen: %g", largest_difference(&a, &b));
    static const char blind[] = "refraction = false\nsoft_shore = false\nspecular = false";
    char things[2][2000];
    snprintf(things[0], sizeof things[0], PLANAR WATER("%s"), blind);
    snprintf(things[1], sizeof things[1], PLANAR BELOW WATER("%s"), blind);
    if (!draw(things[0], &a) || !draw(things[1], &b))
        return;
    CHECK(memcmp(a.red, b.red, sizeof a.red) == 0, "what is below the water lies over it: %g",
          largest_difference(&a, &b));
}

/* Tinted water is laid over what is below it and under what is above. */
static void tinted_water_too(void)
{
#define TINTED "[quality]\nwater = 'tinted'\n" EVEN FLOOR WATER("")
    if (!draw(TINTED, &a) || !draw(TINTED BELOW, &b) || !draw(TINTED ABOVE, &c))
        return;
    for (int i = 0; i < PIXELS; i++)
        CHECK(fabs((double)c.red[i] - (0.25 * 0.8 + 0.75 * (double)a.red[i])) < 1e-5, "pixel %d over the water: %g", i,
              (double)c.red[i]);
    double floor = 0.2, seen = 0.25 * 0.8 + 0.75 * 0.2;
    for (int i = 0; i < PIXELS; i++) {
        double rest = ((double)b.red[i] - (double)a.red[i]) / (seen - floor); /* what the water lets through */
        CHECK(rest > 0.05 && rest < 0.95, "pixel %d below the water: %g of it", i, rest);
    }
}

/* ---- the reference, and who draws it ---- */

#define GLASSES                                                                                                        \
    FLOOR PANE("2", "0.8", "diffuse = 0.6\nspecular = 0.7\nshininess = 12\nopacity = 0.25")                            \
        PANE("5", "0.1",                                                                                               \
             "diffuse = 0.9\nspecular = 0.3\nemissive = 0.05\nspecular_map = 'holes.png'\nopacity = 0.5\nopacity_map " \
             "= 'holes.png'")

static void rays_see_the_same(void)
{
    static const char air[] = "[haze]\ndensity = [0.01, 0.02, 0.03]\ncolor = [0.5, 0.6, 0.7]\n";
    char things[2][3000];
    for (int n = 0; n < 2; n++)
        snprintf(things[n], sizeof things[n], "[quality]\nmipmaps = false\nfiltering = 'float'\n%s" SUN "%s" GLASSES,
                 n == 0 ? "" : "water = 'reference'\nreference.samples = 1\n", air);
    if (!put_holes(false) || !draw(things[0], &a) || !draw(things[1], &b))
        return;
    CHECK(largest_difference(&a, &b) < 2e-5, "they differ by %g", largest_difference(&a, &b));
}

static void nobody_sees_who_drew_it(void)
{
    static const lom_device_desc devices[] = { { .threads = 1, .lanes = 4 },
                                               { .threads = 3, .lanes = 4, .tile = 16 },
                                               { .threads = 2, .lanes = 8, .chunk = 16, .batch = 2 } };
    for (int n = 0; n < 3; n++) {
        if (!put_holes(false) || !draw_by(&devices[n], SUN GLASSES WATER(""), n == 0 ? &a : &b))
            return;
        if (n > 0)
            CHECK(memcmp(a.red, b.red, sizeof a.red) == 0, "device %d draws others", n);
    }
}

/* A scene without transparent entities has no such pass, and as many as one whose entity is opaque. */
static void what_is_not_there_costs_nothing(void)
{
    if (!draw(EVEN FLOOR WATER(""), &a) || !draw(EVEN FLOOR PANE("0.5", "0.8", "opacity = 1") WATER(""), &b) ||
        !draw(EVEN FLOOR PANE("0.5", "0.8", "opacity = 0.5") WATER(""), &c))
        return;
    CHECK(step_of(&a, "transparent") == NULL && step_of(&b, "transparent") == NULL, "a pass of nothing");
    CHECK(a.counters.passes == b.counters.passes && c.counters.passes > b.counters.passes, "%llu, %llu and %llu passes",
          (unsigned long long)a.counters.passes, (unsigned long long)b.counters.passes,
          (unsigned long long)c.counters.passes);
    /* Behind the eye, it is left out, and the plan says why. */
    if (!draw(EVEN FLOOR PANE("40", "0.8", "opacity = 0.5"), &b))
        return;
    const lom_step *step = step_of(&b, "transparent");
    CHECK(step != NULL && !step->runs && strstr(step->text, "no transparent entity is in view") != NULL,
          "the plan says \"%s\"", step != NULL ? step->text : "nothing");
}

static void what_cannot_be_is_refused(void)
{
    static const struct {
        const char *things, *what;
    } cases[] = { { FLOOR PANE("2", "0.8", "opacity = 1.5"), "opacity" },
                  { FLOOR PANE("2", "0.8", "opacity = -0.1"), "opacity" },
                  { FLOOR PANE("2", "0.8", "opacity_map = 'nowhere.png'"), "nowhere.png" },
                  { "[terrain]\nheight_map = 'height.png'\nsize = 40\nheight = 6\n[terrain.material]\nopacity = 0.5\n",
                    "opacity" } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_scene *scene =
            lom_decode_scene(cases[i].things, strlen(cases[i].things), small_path("bad.toml"), NULL, 0, &error);
        lom_renderer *renderer =
            scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
        CHECK(renderer == NULL && strstr(error.text, cases[i].what) != NULL, "case %zu: \"%s\"", i, error.text);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() ||
        !small_text("pane.obj",
                    "v -20 0 -20\nv 20 0 -20\nv 20 0 20\nv -20 0 20\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 1 0\n"
                    "f 4/4/1 3/3/1 2/2/1 1/1/1\n",
                    &error))
        return 1;
    RUN(panes_lie_over_one_another);
    RUN(layers_of_a_mesh_are_sorted);
    RUN(both_sides_are_seen);
    RUN(backs_have_their_own_material);
    RUN(maps_leave_holes);
    RUN(materials_of_files_and_of_scenes_are_the_same);
    RUN(no_shadow_is_thrown);
    RUN(water_lies_between);
    RUN(tinted_water_too);
    RUN(rays_see_the_same);
    RUN(nobody_sees_who_drew_it);
    RUN(what_is_not_there_costs_nothing);
    RUN(what_cannot_be_is_refused);
    remove_small_scene();
    return check_result();
}
