/* A scene far from the origin, and one of another size, show the picture of the scene itself: within 2 of 255 at every
 * pixel, at 2^10 to 2^27 m from where it was, and at 10^-3 to 10^3 times its size (scene_transforms.h says what scales
 * how), over the small scenes of every kind. docs/extremes.md has the margins that it prints. */
#include "change_bases.h"
#include "check.h"
#include "moved_text.h"
#include "scene_transforms.h"
#include "small_scene.h"

enum { WIDTH = 96, HEIGHT = 54, TOLERANCE = 2 };
static const double time_shown = 0.75; /* of the scene as it is */

/* Scenes whose picture does not scale wholly, and why; `most` pixels differ by more, of 5184. */
static const struct exception {
    const char *base;
    double low, high; /* factors that are tried */
    int most;
    double near; /* no shift farther than this is tried, in metres; 0: all are */
} exceptions[] = {
    { "reference_clouds", 1, 1, 0, 0 }, /* random paths, whose numbers belong to the bits of their rays */
    { "reference", 1, 1, 0, 0 }, /* ripples are random numbers that belong to the bits of a place; `traced` has none */
    { "sea", 1e-3, 100, 0, 0 },  /* the wind stays within 0.1 .. 100 m/s */
    { "foam", 1e-3, 100, 0, 0 },
    { "plunging", 1, 1000, 0, 0 },   /* a curl smaller than it was is drawn otherwise */
    { "carried", 1e-3, 10, 0, 0 },   /* the strongest spring gives 10^6 m^3/s */
    { "shallow", 1e-3, 1000, 4, 0 }, /* films are in powers of two, so that a cell at the shore may dry elsewhere */
    { "follower", 1e-3, 1000, 4, 0 },
    { "entity_hits", 1e-3, 100, 0, 0 }, /* waves are at most 100 m high */
    { "fluid", 1e-3, 10, 0, 0x1p10 },   /* basins lie within 1000 km, and conduct up to 10 m^2/s */
    { "lit_fluid", 1e-3, 10, 0, 0x1p10 },
    { "far_fluid", 1e-3, 1, 0, -1 }, /* it lies there */
};

/* What bases are drawn with: a wind whose way is whole 64ths of a metre, as clouds go (src/cloud/cloud_wind.c). */
static void replace_wind(char *text)
{
    static const char from[] = "speed = 11\ndirection = -35\n", to[] = "speed = 16\ndirection = 0.0\n";
    for (char *at; (at = strstr(text, from)) != NULL;)
        memcpy(at, to, sizeof to - 1);
}

static const struct base more_transformed[] = {
    { "traced", "",
      VIEW TERRAIN "[water]\nlevel = 0\n[water.optics]\nroughness = 0\n[quality]\nwater = \"reference\"\n"
                   "terrain_shadows = true\n[quality.reference]\nsamples = 4\ndepth = 3\n" },
    { "followed", "",
      "[camera]\nposition = [0, 3, 9]\ntarget = [0, 1, -3]\nfollow = \"box\"\n[light]\nazimuth = 20\n"
      "elevation = 25\n" TERRAIN "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 3, 2]\n"
      "[[entity.key]]\ntime = 0\nposition = [0, 3, 2]\n[[entity.key]]\ntime = 1\nposition = [3, 4, 5]\n"
      "rotation = [0, 40, 10]\n[[lamp]]\nposition = [0, 2, 3]\nfollow = \"box\"\nrange = 13\n"
      "[[lamp.key]]\ntime = 0\nposition = [0, 2, 3]\n[[lamp.key]]\ntime = 1\nposition = [1, 2, 3]\n"
      "[quality]\nentity_shadows = 64\n" },
};

static lom_image *draw_text(const char *text, const struct scene_transform *transform, double time, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), NULL, 0, error);
    if (scene != NULL) {
        scene->output.width = WIDTH, scene->output.height = HEIGHT;
        scene->output.format = LOM_OUTPUT_RGB8;
        transform_scene(scene, transform);
    }
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ 0 }, error) : NULL;
    if (renderer != NULL)
        lom_render_frame(renderer, &(lom_frame_desc){ .has_time = true, .time = time }, &frame, error);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return frame.image;
}

struct difference {
    int largest, pixels, beyond; /* of 255; pixels that differ at all, and by more than the tolerance */
};

static struct difference find_difference(const lom_image *a, const lom_image *b)
{
    struct difference d = { 0, 0, 0 };
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int most = 0;
        for (int c = 0; c < 3; c++) {
            int delta = abs(a->pixels[3 * i + c] - b->pixels[3 * i + c]);
            most = delta > most ? delta : most;
        }
        d.largest = most > d.largest ? most : d.largest;
        d.pixels += most > 0;
        d.beyond += most > TOLERANCE;
    }
    return d;
}

struct change {
    const char *what;
    double aside; /* metres along x, and back along z */
    struct scene_transform transform;
};

/* How many pixels may differ by more; below 0 where the change is not tried. */
static int allowed(const char *name, const struct change *change)
{
    const double scale = change->transform.scale, shift = fmax(change->aside, change->transform.raise);
    for (size_t i = 0; i < sizeof exceptions / sizeof *exceptions; i++) {
        const struct exception *e = &exceptions[i];
        if (strcmp(e->base, name) != 0)
            continue;
        if (scale != 1)
            return scale < e->low || scale > e->high ? -1 : e->most;
        return e->near != 0 && shift > e->near ? -1 : 0;
    }
    return 0;
}

/* Adds the pixels that differ to the sum of all bases. */
static void try_base(const struct base *base, const struct change *change, struct difference *all)
{
    char text[4096], moved[8192];
    lom_error error = { .code = LOM_OK };
    const int most = allowed(base->name, change);
    if (most < 0)
        return;
    snprintf(text, sizeof text, "%s%s", head, base->text);
    replace_wind(text);
    move_text(moved, sizeof moved, text, change->aside, -change->aside);
    lom_image *plain = draw_text(text, &(struct scene_transform){ 0, 1 }, time_shown, &error);
    lom_image *other = draw_text(moved, &change->transform, time_shown * sqrt(change->transform.scale), &error);
    CHECK(plain != NULL && other != NULL, "%s, %s: %s", base->name, change->what, error.text);
    if (plain != NULL && other != NULL) {
        struct difference d = find_difference(plain, other);
        CHECK(d.beyond <= most, "%s, %s: %d pixels differ by more than %d, the most by %d", base->name, change->what,
              d.beyond, TOLERANCE, d.largest);
        if (d.beyond > 0)
            printf("  %s: %s: %d pixels beyond, the most by %d\n", change->what, base->name, d.beyond, d.largest);
        else
            all->largest = d.largest > all->largest ? d.largest : all->largest;
        all->pixels += d.pixels;
        all->beyond += d.beyond;
    }
    lom_free_image(plain);
    lom_free_image(other);
}

static void try_bases(const struct base *of, size_t count, const struct change *change, struct difference *all)
{
    for (size_t i = 0; i < count; i++)
        try_base(&of[i], change, all);
}

static void try_change(const struct change *change)
{
    struct difference all = { 0, 0, 0 };
    try_bases(bases, sizeof bases / sizeof *bases, change, &all);
    try_bases(more_bases, sizeof more_bases / sizeof *more_bases, change, &all);
    try_bases(more_transformed, sizeof more_transformed / sizeof *more_transformed, change, &all);
    printf("  %s: the others differ by %d of 255 at most, in %d pixels of all\n", change->what, all.largest,
           all.pixels - all.beyond);
}

static void scenes_shifted_upwards(void)
{
    try_change(&(struct change){ "up 2^10 m", 0, { 0x1p10, 1 } });
    try_change(&(struct change){ "up 2^27 m", 0, { 0x1p27, 1 } });
}

static void scenes_shifted_aside(void)
{
    try_change(&(struct change){ "aside 2^10 m", 0x1p10, { 0, 1 } });
    try_change(&(struct change){ "aside 2^20 m", 0x1p20, { 0, 1 } });
    try_change(&(struct change){ "aside 2^27 m", 0x1p27, { 0, 1 } });
}

static void scenes_made_smaller(void)
{
    try_change(&(struct change){ "a thousandth", 0, { 0, 1e-3 } });
    try_change(&(struct change){ "a tenth", 0, { 0, 0.1 } });
}

static void scenes_made_larger(void)
{
    try_change(&(struct change){ "ten times", 0, { 0, 10 } });
    try_change(&(struct change){ "100 times", 0, { 0, 100 } });
    try_change(&(struct change){ "1000 times", 0, { 0, 1e3 } });
}

/* What the tests above rest on: moving the eye alone is seen, so a transform that did nothing would not pass. */
static void an_eye_that_moves_alone_is_seen(void)
{
    lom_error error = { .code = LOM_OK };
    char text[4096];
    snprintf(text, sizeof text, "%s%s", head, bases[0].text);
    lom_image *plain = draw_text(text, &(struct scene_transform){ 0, 1 }, time_shown, &error);
    memcpy(strstr(text, "[0, 3, 12]"), "[0, 3, 11]", 10);
    lom_image *other = draw_text(text, &(struct scene_transform){ 0, 1 }, time_shown, &error);
    CHECK(plain != NULL && other != NULL && find_difference(plain, other).beyond > 100, "%s", error.text);
    lom_free_image(plain);
    lom_free_image(other);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(scenes_shifted_upwards);
    RUN(scenes_shifted_aside);
    RUN(scenes_made_smaller);
    RUN(scenes_made_larger);
    RUN(an_eye_that_moves_alone_is_seen);
    remove_small_scene();
    return check_result();
}
