/* Proves the shadow of terrain on clouds: that behind a ridge a thin fog is dark below the plane through its crest and the sun
 * and not touched above it, over the terrain and beyond its border, in the grid of light and along the paths of the
 * reference; that a cloud above all shadows keeps its bytes; and that a frame alone is that of a run. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { WIDTH = 160, HEIGHT = 90, VERTICES = 65 };

/* A ridge of 200 m along z at x = -160; the sun stands over -x. Looks along -z at a fog of 200 x 120 x 100 m, which lets most
 * light through; nothing else is bright. A pixel is 2 m. */
static const double crest = 200, ridge = -160, pixel = 2, level = 90;
#define SCENE                                                                                                          \
    "[output]\nwidth = 160\nheight = 90\nformat = 'rgb32f'\n[camera]\nprojection = 'orthographic'\nheight = 180\n"     \
    "[sky]\ncolor = [0, 0, 0]\n[light]\nambient = [0, 0, 0]\nground = [0, 0, 0]\n"                                     \
    "[terrain]\nheight_map = 'ridge.pgm'\nsize = 640\nheight = 200\n[terrain.material]\ndiffuse = 0\n"                 \
    "ambient = 0\nspecular = 0\n[clouds]\nphase = 'isotropic'\nsilver = 0\nsky = [0, 0, 0]\nground = [0, 0, 0]\n"      \
    "haze_distance = 0\nshadows = false\n[[cloud]]\nfile = 'fog.raw'\nvoxels = [32, 24, 8]\nsize = [200, 120, 100]\n"  \
    "detail = 0\nextinction = 0.002\n[quality]\nclouds = 'single'\ncloud_light_scale = 1\nterrain_shadows = true\n"

struct place {
    double elevation, x; /* degrees; of the fog's middle */
};
static const struct place places[] = { { 30, 0 }, { 20, 80 }, { 12, 420 } };

static lom_image *draw_frames(const struct place *at, const char *const *more, size_t count, int first, int last,
                              lom_plan *plan)
{
    char set[4][80];
    const char *sets[12] = { set[0], set[1], set[2], set[3] };
    lom_error error = { 0 };
    lom_frame drawn = { .image = NULL };
    snprintf(set[0], sizeof set[0], "light.direction=[%.17g,-1,0]", 1 / tan(at->elevation * M_PI / 180));
    snprintf(set[1], sizeof set[1], "camera.position=[%g,%g,300]", at->x, level);
    snprintf(set[2], sizeof set[2], "camera.target=[%g,%g,0]", at->x, level);
    snprintf(set[3], sizeof set[3], "cloud.0.position=[%g,30,0]", at->x);
    for (size_t i = 0; i < count; i++)
        sets[4 + i] = more[i];
    lom_scene *scene = lom_decode_scene(SCENE, strlen(SCENE), small_path("fog.toml"), sets, 4 + count, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    bool done = renderer != NULL;
    for (int frame = first; done && frame <= last; frame++) {
        lom_free_image(drawn.image);
        done = lom_render_frame(renderer, &(lom_frame_desc){ .frame = frame }, &drawn, &error);
    }
    CHECK(done, "%s", error.text);
    if (plan != NULL)
        *plan = drawn.plan;
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done ? drawn.image : NULL;
}

static lom_image *draw(const struct place *at, const char *set)
{
    return draw_frames(at, &set, 1, 0, 0, NULL);
}

static double red(const lom_image *image, int x, int y)
{
    return (double)*(const float *)lom_image_pixel(image, x, y, 0);
}

/* How far above the shadow's plane the middle of a pixel is. */
static double above_plane(const struct place *at, int x, int y)
{
    const double place = at->x + pixel * (x + 0.5 - WIDTH / 2), height = level - pixel * (y + 0.5 - HEIGHT / 2);
    return height - (crest - (place - ridge) * tan(at->elevation * M_PI / 180));
}

/* Voxels are 6.25 m wide and 5 m high; what a ray sees is mixed of voxels on both sides. */
static double edge_of(const struct place *at)
{
    return 1.55 * (5 + 6.25 * tan(at->elevation * M_PI / 180));
}

static void check_place(const struct place *at)
{
    lom_image *is = draw(at, "quality.clouds=single"), *lit = draw(at, "quality.terrain_shadows=false");
    int dark = 0, open = 0;
    for (int i = 0; is != NULL && lit != NULL && i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const double above = above_plane(at, x, y);
        if (red(lit, x, y) == 0 || fabs(above) < edge_of(at))
            continue;
        dark += above < 0;
        open += above > 0;
        CHECK(red(is, x, y) == (above < 0 ? 0 : red(lit, x, y)),
              "%g degrees: %.9g of %.9g at %d,%d, %g m above the plane", at->elevation, red(is, x, y), red(lit, x, y),
              x, y, above);
    }
    CHECK(dark > 900 && open > 900, "%g degrees: %d dark and %d lit pixels", at->elevation, dark, open);
    /* Down a column half of the light is left within a voxel of the plane: of a lit and a dark voxel the grid mixes 64th
     * roots, of which half of the light is 0.989, almost at the lit one's middle. */
    for (int x = 45; is != NULL && lit != NULL && x < WIDTH - 45; x += 10) {
        int y = HEIGHT / 2 - 28;
        while (y < HEIGHT / 2 + 28 && red(is, x, y) > 0.5 * red(lit, x, y))
            y++;
        if (y > HEIGHT / 2 - 28 && y < HEIGHT / 2 + 28)
            CHECK(fabs(above_plane(at, x, y)) < 4, "%g degrees: half is %g m above the plane", at->elevation,
                  above_plane(at, x, y));
    }
    lom_free_image(is);
    lom_free_image(lit);
}

static void fog_is_dark_below_the_plane(void)
{
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        check_place(&places[i]);
}

/* What is left of the fog's light in the shadow (0) and out of it (1). */
static void find_shares(const struct place *at, const char *clouds, double share[2])
{
    const char *const with[] = { clouds, "quality.reference.samples=16", "quality.terrain_shadows=true" };
    const char *const without[] = { clouds, "quality.reference.samples=16", "quality.terrain_shadows=false" };
    lom_image *is = draw_frames(at, with, 3, 0, 0, NULL), *lit = draw_frames(at, without, 3, 0, 0, NULL);
    double sum[2] = { 0, 0 }, whole[2] = { 0, 0 };
    for (int k = 0; is != NULL && lit != NULL && k < WIDTH * HEIGHT; k++) {
        const int x = k % WIDTH, y = k / WIDTH;
        const double above = above_plane(at, x, y);
        if (abs(x - WIDTH / 2) > 45 || abs(y - HEIGHT / 2) > 28 || fabs(above) < 2)
            continue;
        sum[above > 0] += red(is, x, y);
        whole[above > 0] += red(lit, x, y);
    }
    for (int i = 0; i < 2; i++)
        share[i] = sum[i] / whole[i];
    lom_free_image(is);
    lom_free_image(lit);
}

/* The tracer shoots a ray at the ridge from each scattering; what is scattered twice comes into the shadow. */
static void the_reference_finds_the_same_plane(void)
{
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        double drawn[2] = { 0, 0 }, traced[2] = { 0, 0 };
        find_shares(&places[i], "quality.clouds=single", drawn);
        find_shares(&places[i], "quality.clouds=reference", traced);
        CHECK(drawn[0] < 0.06 && traced[0] < 0.12, "%g degrees: %g drawn, %g traced in the shadow", places[i].elevation,
              drawn[0], traced[0]);
        CHECK(fabs(drawn[1] - traced[1]) < 0.06 && traced[1] > 0.9, "%g degrees: %g drawn, %g traced out of it",
              places[i].elevation, drawn[1], traced[1]);
    }
}

/* ---- what changes nothing ---- */

static void clouds_above_all_shadows_keep_their_bytes(void)
{
    static const char *const high[] = { "cloud.0.position=[0,201,0]", "camera.position=[0,260,300]",
                                        "camera.target=[0,260,0]", "quality.terrain_shadows=false" };
    lom_plan plan = { .count = 0 };
    lom_image *a = draw_frames(&places[0], high, 3, 0, 0, &plan), *b = draw_frames(&places[0], high, 4, 0, 0, NULL);
    bool told = false;
    CHECK(a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b), "terrain below a cloud shades it");
    for (int i = 0; i < plan.count; i++)
        told |= strcmp(plan.step[i].name, "cloud light") == 0 && strstr(plan.step[i].text, " 0 of them") != NULL;
    CHECK(told, "the plan does not say so");
    lom_free_image(a);
    lom_free_image(b);
}

/* The fog drifts out of the shadow, and the sun rises. */
static void a_frame_alone_is_that_of_a_run(void)
{
    static const char *const moved[] = { "clouds.wind=[{height=0,speed=60,direction=90}]", "output.frames=40" };
    lom_image *alone = draw_frames(&places[0], moved, 2, 30, 30, NULL);
    lom_image *run = draw_frames(&places[0], moved, 2, 26, 30, NULL);
    lom_image *first = draw_frames(&places[0], moved, 2, 0, 0, NULL);
    CHECK(alone != NULL && run != NULL && lom_hash_image(alone) == lom_hash_image(run), "they differ");
    CHECK(first != NULL && alone != NULL && lom_hash_image(first) != lom_hash_image(alone), "nothing moves");
    lom_free_image(alone);
    lom_free_image(run);
    lom_free_image(first);
}

static bool make_files(lom_error *error)
{
    static char map[VERTICES * VERTICES * 4 + 40];
    static char fog[32 * 24 * 8];
    size_t length = (size_t)snprintf(map, sizeof map, "P2 %d %d 255\n", VERTICES, VERTICES);
    for (int i = 0; i < VERTICES * VERTICES; i++)
        length += (size_t)snprintf(map + length, sizeof map - length, "%s ", i % VERTICES == 16 ? "255" : "0");
    memset(fog, 255, sizeof fog);
    return small_text("ridge.pgm", map, error) && lom_write_file(small_path("fog.raw"), fog, sizeof fog, error);
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !make_files(&error))
        return 1;
    RUN(fog_is_dark_below_the_plane);
    RUN(the_reference_finds_the_same_plane);
    RUN(clouds_above_all_shadows_keep_their_bytes);
    RUN(a_frame_alone_is_that_of_a_run);
    remove_small_scene();
    return check_result();
}
