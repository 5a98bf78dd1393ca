/* Proves the shadows of lamps: that an umbra's edge is where similar triangles put it, within a texel, of points and of
 * spots, in maps and in the reference; that a wall takes all light and what takes none changes no bit; that casters move
 * with their key frames and terrain is one; that maps are bounded, left out where nothing casts, and independent of lanes
 * and crops; and the sentences of what cannot be. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { SIDE = 129, PIXELS = SIDE * SIDE };

/* Looks straight down from 3.5 m, below what casts, at a white floor; nothing shines but what is added. 9 m across. */
#define HALF 4.5
#define LIT                                                                                                            \
    "[output]\nwidth = 129\nheight = 129\nformat = 'rgb32f'\n[camera]\nposition = [0, 3.5, 0]\ntarget = [0, 0, 0]\n"   \
    "up = [0, 0, -1]\nfield_of_view = 104.25\n[sky]\ncolor = [0, 0, 0]\n[light]\nintensity = 0\n"                      \
    "ambient = [0, 0, 0]\n"
#define FLOOR                                                                                                          \
    "[[entity]]\nname = 'floor'\nmesh = 'floor.obj'\n[entity.material]\nambient = 1\ndiffuse = 1\nspecular = 0\n"
#define SQUARE "[[entity]]\nname = 'square'\nmesh = 'square.obj'\nposition = [0, 4, 0]\n"
static const char floor_obj[] = "v -40 0 40\nv 40 0 40\nv 40 0 -40\nv -40 0 -40\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\n";
static const char square_obj[] = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n";

static lom_scene *decode(const char *text, const char *const *set, size_t sets)
{
    lom_error error = { 0 };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("shadows.toml"), set, sets, &error);
    CHECK(scene != NULL, "%s", error.text);
    return scene;
}

/* A frame, alone or as the next of a renderer that drew those before it too. */
static lom_image *draw_frames(const char *text, const char *const *set, size_t sets, int lanes, int first, int last,
                              lom_rect crop, lom_plan *plan)
{
    lom_error error = { 0 };
    lom_frame drawn = { .image = NULL };
    lom_scene *scene = decode(text, set, sets);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1, .lanes = lanes }, &error);
    bool done = renderer != NULL;
    for (int frame = first; done && frame <= last; frame++) {
        lom_free_image(drawn.image);
        done = lom_render_frame(renderer, &(lom_frame_desc){ .frame = frame, .crop = crop }, &drawn, &error);
    }
    CHECK(done, "%s", error.text);
    if (plan != NULL)
        *plan = drawn.plan;
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done ? drawn.image : NULL;
}

static lom_image *draw_with(const char *text, const char *set)
{
    return draw_frames(text, &set, set != NULL, 0, 0, 0, (lom_rect){ 0 }, NULL);
}

static lom_image *draw(const char *text)
{
    return draw_with(text, NULL);
}

static lom_image *trace(const char *text)
{
    static const char *const set[] = { "quality.water=reference", "quality.reference.samples=1" };
    return draw_frames(text, set, 2, 0, 0, 0, (lom_rect){ 0 }, NULL);
}

static double red(const lom_image *image, int x, int y)
{
    return (double)*(const float *)lom_image_pixel(image, x, y, 0);
}

static bool is_same(const lom_image *a, const lom_image *b)
{
    return a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b);
}

static bool is_dark(const lom_image *image)
{
    for (int i = 0; i < PIXELS; i++)
        if (red(image, i % SIDE, i / SIDE) != 0)
            return false;
    return true;
}

typedef lom_image *painter(const char *text);
static painter *const painters[2] = { draw, trace };
static const char *const painter_names[2] = { "drawn", "traced" };

/* ---- closed forms ---- */

struct umbra {
    const char *name, *keys;
    double height, tangent, wide; /* of the lamp; of half its face's field of view, of the cone */
};
static const struct umbra umbrae[] = {
    { "point", "position = [0, 8, 0]\n", 8, 1, 99 },
    { "point at 6 m", "position = [0, 6, 0]\n", 6, 1, 99 },
    { "spot", "position = [0, 8, 0]\ncutoff = 45\n", 8, 1, 1 },
    { "narrow spot", "position = [0, 8, 0]\ncutoff = 35\n", 8, 0.70021, 0.70021 },
    { "wide spot", "position = [0, 8, 0]\ncutoff = 85\n", 8, 1, 11 },
};

/* The square's half side, seen from the lamp, on the floor. */
static double edge_of(const struct umbra *u)
{
    return u->height / (u->height - 4);
}

/* Metres that a texel covers on the floor. */
static double texel_of(const struct umbra *u)
{
    return 2 * u->tangent * u->height / (512 - 8);
}

/* N.L of the lamp over the middle where the cone is wide enough; attenuation is 1. */
static double open_light(const struct umbra *u, double x, double z)
{
    return u->height / sqrt(x * x + z * z + u->height * u->height);
}

static void check_umbra(const struct umbra *u, int by)
{
    char text[2000];
    snprintf(text, sizeof text, LIT FLOOR SQUARE "[[lamp]]\n%sdiffuse = 1\nreach = 1000\nshadow = true\n", u->keys);
    lom_image *image = painters[by](text);
    const double edge = edge_of(u), texel = texel_of(u), step = 2 * HALF / SIDE;
    double width = 0;
    for (int y = 0; image != NULL && y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            const double at[2] = { (x - SIDE / 2) * step, (y - SIDE / 2) * step };
            const double beyond = fmax(fabs(at[0]), fabs(at[1])) - edge, is = red(image, x, y);
            const double open = open_light(u, at[0], at[1]);
            if (hypot(at[0], at[1]) > u->height * u->wide - step)
                continue;
            width += y == SIDE / 2 ? (1 - is / open) * step : 0;
            if (beyond < -2.1 * texel - step)
                CHECK(is == 0, "%s, %s: %g in the umbra, %d,%d", u->name, painter_names[by], is, x, y);
            if (beyond > 2.1 * texel + step)
                CHECK(fabs(is / open - 1) < 2e-4, "%s, %s: %g, not %g, beyond it, %d,%d", u->name, painter_names[by],
                      is, open, x, y);
        }
    CHECK(image == NULL || fabs(width / 2 - edge) < texel + (by == 1 ? step / 2 : step / 8),
          "%s, %s: the edge is at %g m, not at %g; a texel is %g", u->name, painter_names[by], width / 2, edge, texel);
    lom_free_image(image);
}

static void an_umbra_ends_where_similar_triangles_say(void)
{
    for (size_t i = 0; i < sizeof umbrae / sizeof *umbrae; i++)
        for (int p = 0; p < 2; p++)
            check_umbra(&umbrae[i], p);
}

/* From a lamp above a roof that is larger than all that is seen nothing comes, not the least float. */
static void a_wall_leaves_nothing(void)
{
    for (int p = 0; p < 2; p++) {
        lom_image *image = painters[p](LIT FLOOR SQUARE "scale = 30\n[[lamp]]\nposition = [1, 8, 2]\nambient = 1\n"
                                                        "specular = 1\nreach = 1000\nshadow = true\n");
        CHECK(image == NULL || is_dark(image), "%s: light comes through a roof", painter_names[p]);
        lom_free_image(image);
    }
}

/* ---- what takes no light changes no bit ---- */

/* Floors at many slopes and lamps at many heights do not shade themselves, nor what lies beside them. */
static void what_hides_nothing_changes_no_bit(void)
{
    static const char *const slopes[] = { "[0, 0, 0]", "[10, 0, 5]", "[30, 20, 0]", "[45, 45, 10]" };
    static const char *const places[] = { "[0, 8, 0]", "[3, 0.5, -2]", "[-2, 2, 1]", "[4, 3, 4]", "[0.01, 40, 0]" };
    static const char *const shapes[] = { "", "cutoff = 50\n", "cutoff = 80\n" };
    for (int i = 0; i < 60; i++) {
        char text[2000];
        snprintf(text, sizeof text,
                 LIT "[[entity]]\nmesh = 'floor.obj'\nrotation = %s\n[entity.material]\nspecular = 1\n"
                     "[[lamp]]\nposition = %s\n%sreach = 90\nrange = 50\n",
                 slopes[i % 4], places[i / 4 % 5], shapes[i / 20]);
        lom_image *without = draw(text), *with = draw_with(text, "lamp.0.shadow=true");
        CHECK(is_same(with, without), "case %d: a shadow of nothing changes the picture of:\n%s", i, text);
        lom_free_image(without);
        lom_free_image(with);
    }
}

static bool says(const lom_plan *plan, const char *what)
{
    for (int i = 0; i < plan->count; i++)
        if (strcmp(plan->step[i].name, "lamp shadows") == 0 && strstr(plan->step[i].text, what) != NULL)
            return true;
    return false;
}

#define LAMP "[[lamp]]\nposition = [0, 8, 0]\nreach = 1000\nshadow = true\n"

/* No map where nothing casts, where the light is not seen, or beyond so many; none where the dial is 0. */
static void maps_are_made_only_where_they_are_needed(void)
{
    static const struct {
        const char *text, *set, *says;
        bool shadow;
    } cases[] = {
        { LIT FLOOR SQUARE LAMP, "title=''", "5 maps of 1 lamps: 5 drawn", true },
        { LIT FLOOR SQUARE LAMP, "quality.lamp_shadows=0", "quality.lamp_shadows is 0", false },
        { LIT FLOOR SQUARE LAMP, "quality.lamp_shadow_maps=5", "1 beyond quality.lamp_shadow_maps", false },
        { LIT FLOOR SQUARE LAMP, "lamp.0.shadow_from=4.5", "5 maps of 1 lamps", false },
        { LIT FLOOR SQUARE LAMP, "entity.1.visible=false", "5 maps of 1 lamps", false },
        { LIT FLOOR SQUARE "[[lamp]]\nposition = [2.5, 2.5, 0]\nreach = 2\nshadow = true\n", "title=''",
          "of 1 lamps nothing is in reach", false },
        { LIT FLOOR SQUARE "[[lamp]]\nposition = [0, 8, 60]\nreach = 9\nshadow = true\n", "title=''",
          "1 are out of view", false },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_plan plan;
        const char *const set[] = { cases[i].set, "lamp.0.shadow=false" };
        lom_image *is = draw_frames(cases[i].text, set, 1, 0, 0, 0, (lom_rect){ 0 }, &plan);
        lom_image *bare = draw_frames(cases[i].text, set, 2, 0, 0, 0, (lom_rect){ 0 }, NULL);
        CHECK(says(&plan, cases[i].says), "case %zu: the plan does not say: %s", i, cases[i].says);
        CHECK(is_same(is, bare) != cases[i].shadow, "case %zu: shadow or none", i);
        lom_free_image(is);
        lom_free_image(bare);
    }
}

/* ---- motion, lanes, crops, terrain ---- */

#define MOVING                                                                                                         \
    LIT FLOOR SQUARE "[[entity.key]]\ntime = 0\n[[entity.key]]\ntime = 1\nposition = [2, 4, 1]\n"                      \
                     "[[lamp]]\nname = 'a'\nposition = [0, 8, 0]\nreach = 1000\nshadow = true\n"                       \
                     "[[lamp]]\nposition = [3, 7, 0]\ndirection = [-1, -2, 0]\ncutoff = 40\nreach = 99\n"              \
                     "shadow = true\n[[lamp.key]]\ntime = 0\n[[lamp.key]]\ntime = 1\nposition = [3, 7, 2]\n"

static void a_frame_alone_is_the_frame_of_a_run(void)
{
    lom_image *run = draw_frames(MOVING, NULL, 0, 4, 0, 3, (lom_rect){ 0 }, NULL);
    lom_image *alone = draw_frames(MOVING, NULL, 0, 8, 3, 3, (lom_rect){ 0 }, NULL);
    lom_image *first = draw_frames(MOVING, NULL, 0, 8, 0, 0, (lom_rect){ 0 }, NULL);
    CHECK(is_same(run, alone), "frame 3 of a run by 4 lanes is not frame 3 alone by 8");
    CHECK(!is_same(first, alone), "nothing has moved");
    lom_free_image(run);
    lom_free_image(alone);
    lom_free_image(first);
}

static void a_crop_is_cut_from_the_whole(void)
{
    const lom_rect crop = { 30, 41, 50, 37 };
    lom_image *whole = draw(MOVING), *part = draw_frames(MOVING, NULL, 0, 0, 0, 0, crop, NULL);
    for (int y = 0; whole != NULL && part != NULL && y < crop.height; y++)
        for (int x = 0; x < crop.width; x++)
            CHECK(red(part, x, y) == red(whole, x + crop.x, y + crop.y), "%d,%d: %g, not %g", x, y, red(part, x, y),
                  red(whole, x + crop.x, y + crop.y));
    lom_free_image(whole);
    lom_free_image(part);
}

/* The share of pixels that a map gives another light than the reference, by more than 1/20. */
static double wrong_share(const char *text, const char *set)
{
    const char *const drawn[] = { set, "output.samples=4" };
    const char *const exact[] = { set, "quality.water=reference", "quality.reference.samples=4" };
    lom_image *a = draw_frames(text, drawn, 2, 0, 0, 0, (lom_rect){ 0 }, NULL);
    lom_image *b = draw_frames(text, exact, 3, 0, 0, 0, (lom_rect){ 0 }, NULL);
    int wrong = 0, count = a != NULL && b != NULL ? a->width * a->height : 0;
    for (int i = 0; i < count; i++)
        wrong += fabs(red(a, i % a->width, i / a->width) - red(b, i % a->width, i / a->width)) > 0.05;
    lom_free_image(a);
    lom_free_image(b);
    return count == 0 ? 1 : (double)wrong / count;
}

/* Hills and a tent under a lamp; the same without the shadow is wrong over more than ten times as much. */
static void terrain_and_entities_cast_as_in_the_reference(void)
{
    static const char text[] =
        "[output]\nwidth = 160\nheight = 90\nformat = 'rgb32f'\n[camera]\nposition = [0, 14, 22]\ntarget = [0, 0, 0]\n"
        "[sky]\ncolor = [0, 0, 0]\n[light]\nintensity = 0\nambient = [0, 0, 0]\n[terrain]\nheight_map = 'height.png'\n"
        "size = 40\nheight = 30\nbase = -9\n[[entity]]\nmesh = 'box.obj'\nposition = [0, 0.3, 2]\non_ground = true\n"
        "[[lamp]]\nposition = [4, 4, 3]\nreach = 1000\n[quality]\nterrain_error = 0\n";
    const double with = wrong_share(text, "lamp.0.shadow=true");
    lom_image *bare = draw(text), *dark = draw_with(text, "lamp.0.shadow=true");
    int changed = 0;
    for (int i = 0; bare != NULL && dark != NULL && i < bare->width * bare->height; i++)
        changed +=
            fabs(red(bare, i % bare->width, i / bare->width) - red(dark, i % bare->width, i / bare->width)) > 0.05;
    CHECK(changed > 160 * 90 / 10, "the shadow is of %d pixels", changed);
    CHECK(with < 0.02, "%g of the pixels are wrong", with);
    lom_free_image(bare);
    lom_free_image(dark);
}

/* Terrain that tessellation cuts casts the triangles it is drawn as. The eye stands far away, so these are few, and another
 * shape than the height map's: a map of the blocks would let it shade itself. */
static void patches_cast_as_they_are_drawn(void)
{
    static const char text[] =
        "[output]\nwidth = 160\nheight = 90\nformat = 'rgb32f'\n[camera]\nposition = [0, 60, 90]\n"
        "target = [0, 0, 0]\nfield_of_view = 24\n[sky]\ncolor = [0, 0, 0]\n[light]\nintensity = 0\n"
        "ambient = [0, 0, 0]\n[terrain]\nheight_map = 'rough.pgm'\nsize = 40\nheight = 3\n[terrain.material]\n"
        "specular = 0\n[[lamp]]\nposition = [0, 30, 0]\nreach = 1000\n[quality]\ntessellation = true\n"
        "terrain_error = 40\nshading = 'flat'\n";
    lom_image *open = draw_with(text, "lamp.0.shadow=false"), *is = draw_with(text, "lamp.0.shadow=true");
    int lit = 0, dark = 0;
    for (int i = 0; open != NULL && is != NULL && i < open->width * open->height; i++) {
        const double bare = red(open, i % open->width, i / open->width);
        lit += bare > 0;
        dark += red(is, i % is->width, i / is->width) < 0.99 * bare;
    }
    CHECK(lit > 3000, "%d pixels are lit", lit);
    CHECK(dark < lit / 100, "%d of %d pixels are in a shadow that the triangles do not throw", dark, lit);
    lom_free_image(open);
    lom_free_image(is);
}

/* ---- what cannot be ---- */

static void what_throws_no_shadow_is_refused(void)
{
    static const struct {
        const char *keys, *sentence;
    } cases[] = {
        { "[[lamp]]\ndirection = [0, -1, 0]\nshadow = true\n", "a lamp at infinity throws no shadow" },
        { "[[lamp]]\nposition = [0, 1, 0]\nshadow_from = 0\n", "shadow_from" },
        { "[[lamp]]\nposition = [0, 1, 0]\nshadow = 1\n", "shadow" },
        { "[quality]\nlamp_shadows = -1\n", "lamp_shadows" },
        { "[quality]\nlamp_shadows = 4097\n", "lamp_shadows" },
        { "[quality]\nlamp_shadow_maps = 0\n", "lamp_shadow_maps" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        lom_error error = { 0 };
        snprintf(text, sizeof text, "%s%s", LIT FLOOR, cases[i].keys);
        lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("shadows.toml"), NULL, 0, &error);
        CHECK(scene == NULL && error.code == LOM_ERROR_INPUT && strstr(error.text, cases[i].sentence) != NULL, "%s: %s",
              cases[i].keys, error.text);
        lom_free_scene(scene);
    }
}

/* 65 x 65 random heights. */
static bool make_rough_map(lom_error *error)
{
    enum { VERTICES = 65 };
    static char map[VERTICES * VERTICES * 4 + 40];
    size_t length = (size_t)snprintf(map, sizeof map, "P2 %d %d 255\n", VERTICES, VERTICES);
    for (int i = 0; i < VERTICES * VERTICES; i++)
        length +=
            (size_t)snprintf(map + length, sizeof map - length, "%d ", (int)(lom_random_bits(9, (uint64_t)i) & 255));
    return small_text("rough.pgm", map, error);
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !make_rough_map(&error) || !small_text("floor.obj", floor_obj, &error) ||
        !small_text("square.obj", square_obj, &error))
        return 1;
    RUN(an_umbra_ends_where_similar_triangles_say);
    RUN(a_wall_leaves_nothing);
    RUN(what_hides_nothing_changes_no_bit);
    RUN(maps_are_made_only_where_they_are_needed);
    RUN(a_frame_alone_is_the_frame_of_a_run);
    RUN(a_crop_is_cut_from_the_whole);
    RUN(terrain_and_entities_cast_as_in_the_reference);
    RUN(patches_cast_as_they_are_drawn);
    RUN(what_throws_no_shadow_is_refused);
    remove_small_scene();
    return check_result();
}
