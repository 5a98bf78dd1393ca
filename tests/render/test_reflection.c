/* Proves the models of reflection by their formulas, at each fragment and in the reference, with the sun and with a lamp;
 * that tones are tones, per vertex too; and the lecture's warning: a lamp that lights vertices alone misses a coarse mesh,
 * and is right where the mesh is dense; that shadows lie on what has a highlight and no tone. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { SIDE = 33, PIXELS = SIDE * SIDE };

#define ROOM                                                                                                           \
    "[output]\nwidth = 33\nheight = 33\nformat = 'rgb32f'\n[camera]\nposition = [0, 10, 0]\ntarget = [0, 0, 0]\n"      \
    "up = [0, 0, -1]\nfield_of_view = 44.8\n[sky]\ncolor = [0, 0, 0]\n"
#define SUN "[light]\nambient = [0, 0, 0]\ndirection = [-0.6, -0.8, 0]\n"
#define LAMP                                                                                                           \
    "[light]\nambient = [0, 0, 0]\nintensity = 0\n[[lamp]]\nposition = [2, 3, -1]\nattenuation = [1, 0, 0.1]\nreach "  \
    "= 1e6\n"

/* A square of 2 size by 2 size metres at y = 0, of `cells` squares a side. */
static bool put_grid(const char *name, double size, int cells)
{
    static char text[400000];
    lom_error error = { 0 };
    size_t used = (size_t)snprintf(text, sizeof text, "vn 0 1 0\n");
    for (int i = 0; i < (cells + 1) * (cells + 1); i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "v %.9g 0 %.9g\n",
                                 size * (2.0 * (i % (cells + 1)) / cells - 1),
                                 size * (2.0 * (i / (cells + 1)) / cells - 1));
    for (int i = 0; i < cells * cells; i++) {
        const int a = i / cells * (cells + 1) + i % cells + 1, b = a + cells + 1;
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d//1 %d//1 %d//1\nf %d//1 %d//1 %d//1\n", a, b,
                                 a + 1, a + 1, b, b + 1);
    }
    bool put = small_text(name, text, &error);
    CHECK(put, "%s", error.text);
    return put;
}

static bool draw(const char *text, const char *quality, float red[PIXELS])
{
    static char all[3000];
    lom_error error = { 0 };
    lom_frame drawn = { .image = NULL };
    snprintf(all, sizeof all, "%s[quality]\nterrain_error = 0\n%s", text, quality);
    lom_scene *scene = lom_decode_scene(all, strlen(all), small_path("reflection.toml"), NULL, 0, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ 0 }, &drawn, &error);
    CHECK(done, "%s", error.text);
    for (int i = 0; done && i < PIXELS; i++)
        red[i] = *(const float *)lom_image_pixel(drawn.image, i % SIDE, i / SIDE, 0);
    lom_free_image(drawn.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

#define TRACED "water = 'reference'\n[quality.reference]\nsamples = 1\n"

static const char *const models[3] = { "phong", "blinn_phong", "toon" };

/* What a floor of diffuse 0.5, specular 0.25 and shininess 12 reflects at (x, 0, z) of a light from l, seen from 10 m
 * above the origin. */
static double reflected(int model, double x, double z, const double l[3])
{
    const double far = sqrt(x * x + 100 + z * z), e[3] = { -x / far, 10 / far, -z / far };
    const double h[3] = { l[0] + e[0], l[1] + e[1], l[2] + e[2] };
    const double halfway = h[1] / sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    const double mirrored = -l[0] * e[0] + l[1] * e[1] - l[2] * e[2]; /* the normal is up */
    const double cosine = model == 1 ? halfway : mirrored, n = l[1];
    double highlight = n > 0 && cosine > 0 ? pow(cosine, 12) : 0, diffuse = n > 0 ? n : 0;
    if (model == 2) {
        highlight = highlight >= 0.5;
        diffuse = n >= 0.8 ? 1 : n >= 0.5 ? 0.5 : n >= 0.2 ? 0.25 : 0;
    }
    return 0.5 * diffuse + 0.25 * highlight;
}

#define FLOOR                                                                                                          \
    "[[entity]]\nmesh = 'floor.obj'\n[entity.material]\nambient = 0\ndiffuse = 0.5\nspecular = 0.25\nshininess = 12\n"
#define TONES "toon_thresholds = [0.2, 0.5, 0.8]\ntoon_tones = [0.25, 0.5, 1]\n"

static void models_have_their_formulas(void)
{
    static const char *const lights[2] = { SUN, LAMP };
    static float red[PIXELS];
    if (!put_grid("floor.obj", 40, 1))
        return;
    for (int i = 0; i < 12; i++) {
        const int model = i % 3, lamp = i / 3 % 2, traced = i / 6;
        char text[1000], quality[300];
        int wrong = 0;
        snprintf(text, sizeof text, "%s%s%s", ROOM, lights[lamp], FLOOR);
        snprintf(quality, sizeof quality, "reflection = '%s'\n%s%s", models[model], TONES, traced ? TRACED : "");
        if (!draw(text, quality, red))
            return;
        for (int p = 0; p < PIXELS; p++) {
            const double step = 20 * tan(22.4 * M_PI / 180) / SIDE, x = (p % SIDE - SIDE / 2) * step;
            const double z = (p / SIDE - SIDE / 2) * step, way[3] = { 2 - x, 3, -1 - z };
            const double d = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
            const double to_lamp[3] = { way[0] / d, way[1] / d, way[2] / d }, to_sun[3] = { 0.6, 0.8, 0 };
            const double want =
                lamp ? reflected(model, x, z, to_lamp) / (1 + 0.1 * d * d) : reflected(model, x, z, to_sun);
            const bool off = fabs((double)red[p] - want) > 3e-4;
            wrong += off;
            CHECK(!off || model == 2, "%s, lamp %d, traced %d, pixel %d: %g, not %g", models[model], lamp, traced, p,
                  (double)red[p], want);
        }
        CHECK(wrong <= 12, "%s, lamp %d, traced %d: %d pixels are beside the edges of their tones", models[model], lamp,
              traced, wrong);
    }
}

/* On a ball-like lamp's floor no other values than the tones; between vertices they are mixed. */
static void tones_are_few(void)
{
    static float red[PIXELS];
    for (int vertex = 0; vertex < 2; vertex++) {
        char quality[300];
        int tones = 0, other = 0;
        if (!put_grid("dense.obj", 8, 12))
            return;
        snprintf(quality, sizeof quality, "reflection = 'toon'\nshading = '%s'\n%s", vertex ? "gouraud" : "phong",
                 TONES);
        if (!draw(ROOM "[light]\nambient = [0, 0, 0]\nintensity = 0\n[[lamp]]\nposition = [0, 3, 0]\n[[entity]]\n"
                       "mesh = 'dense.obj'\n[entity.material]\nspecular = 0\n",
                  quality, red))
            return;
        for (int p = 0; p < PIXELS; p++) {
            const bool tone = red[p] == 0 || red[p] == 0.25f || red[p] == 0.5f || red[p] == 1;
            tones += tone;
            other += !tone;
        }
        CHECK(tones > PIXELS / 4 && (other > PIXELS / 10) == (vertex == 1), "%d tones and %d between, per vertex %d",
              tones, other, vertex);
    }
}

/* A lamp 1 m over the middle of a floor of 16 m. */
static void lamps_per_vertex_want_dense_meshes(void)
{
    static const int cells[] = { 1, 8, 64 };
    static float exact[PIXELS], red[PIXELS];
    double error[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++) {
        static const char text[] = ROOM "[light]\nambient = [0, 0, 0]\nintensity = 0\n[[lamp]]\nposition = [0, 1, 0]\n"
                                        "range = 7\n[[entity]]\nmesh = 'cells.obj'\n[entity.material]\nspecular = 0\n";
        if (!put_grid("cells.obj", 8, cells[i]) || !draw(text, "shading = 'phong'\n", exact) ||
            !draw(text, "shading = 'gouraud'\n", red))
            return;
        for (int p = 0; p < PIXELS; p++)
            error[i] += fabs((double)red[p] - (double)exact[p]) / PIXELS;
        if (i == 0)
            CHECK(red[PIXELS / 2] < 0.05f * exact[PIXELS / 2], "two triangles show %g of the %g below the lamp",
                  (double)red[PIXELS / 2], (double)exact[PIXELS / 2]);
    }
    CHECK(error[1] < error[0] && error[2] < error[1] / 20 && error[2] < 3e-4, "errors %g, %g, %g", error[0], error[1],
          error[2]);
}

static void thresholds_that_fall_are_refused(void)
{
    static const char text[] = ROOM "[quality]\ntoon_thresholds = [0.5, 0.4, 0.9]\n";
    lom_error error = { 0 };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("reflection.toml"), NULL, 0, &error);
    CHECK(scene == NULL && error.code == LOM_ERROR_INPUT && strstr(error.text, "rise") != NULL, "%s", error.text);
    lom_free_scene(scene);
}

/* A ball of radius 1 about (0, 1, 0), of 24 by 12 smooth quads. */
static bool put_ball(const char *name)
{
    enum { ROUND = 24, DOWN = 12 };
    static char text[100000];
    lom_error error = { 0 };
    size_t used = 0;
    for (int i = 0; i < ROUND * (DOWN + 1); i++) {
        const double a = 2 * M_PI * (i % ROUND) / ROUND, b = M_PI * (i / ROUND) / DOWN;
        const double n[3] = { sin(b) * cos(a), cos(b), sin(b) * sin(a) };
        used += (size_t)snprintf(text + used, sizeof text - used, "v %.6f %.6f %.6f\nvn %.6f %.6f %.6f\n", n[0],
                                 n[1] + 1, n[2], n[0], n[1], n[2]);
    }
    for (int i = 0; i < ROUND * DOWN; i++) {
        const int a = i + 1, b = i / ROUND * ROUND + (i + 1) % ROUND + 1, c = b + ROUND, d = a + ROUND;
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d//%d %d//%d %d//%d %d//%d\n", a, a, b, b, c, c,
                                 d, d);
    }
    bool put = small_text(name, text, &error);
    CHECK(put, "%s", error.text);
    return put;
}

/* The tone of a slanting surface is 0 and its highlight may not be: whether a shadow lies on it is asked whatever the tones
 * beside it are. */
static void a_tone_of_nothing_is_in_shadow_too(void)
{
    static const char scene_text[] =
        "[output]\nwidth = 240\nheight = 160\nformat = 'rgb32f'\n[camera]\nposition = [0, 1.2, 6]\n"
        "target = [0, 0.8, 0]\nfield_of_view = 38\n[light]\nazimuth = 50\nelevation = 20\nambient = [0, 0, 0]\n"
        "[sky]\ncolor = [0, 0, 0]\n[quality]\nreflection = 'toon'\nentity_shadows = 512\n"
        "[[entity]]\nname = 'large'\nmesh = 'ball.obj'\n[entity.material]\ndiffuse = 0.75\nspecular = 0.6\n"
        "shininess = 1\n[[entity]]\nname = 'small'\nmesh = 'ball.obj'\nposition = [2.706, 1.79, -1.01]\n"
        "scale = 0.5\n[entity.material]\ndiffuse = 0.75\nspecular = 0.6\nshininess = 1\n";
    lom_error error = { 0 };
    lom_image *pictures[2] = { NULL };
    if (!put_ball("ball.obj"))
        return;
    for (int i = 0; i < 2; i++) {
        const lom_device_desc desc = { .threads = 1, .lanes = i == 0 ? 4 : 0 }; /* 0: the widest */
        lom_frame drawn = { .image = NULL };
        lom_scene *scene = lom_decode_scene(scene_text, strlen(scene_text), small_path("toon.toml"), NULL, 0, &error);
        lom_renderer *renderer = scene == NULL ? NULL : lom_create_renderer(scene, &desc, &error);
        CHECK(renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ 0 }, &drawn, &error), "%s", error.text);
        pictures[i] = drawn.image;
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
    CHECK(pictures[0] != NULL && pictures[1] != NULL && lom_hash_image(pictures[0]) == lom_hash_image(pictures[1]),
          "the least and the widest lanes draw different pictures");
    for (int i = 0; i < 2; i++)
        lom_free_image(pictures[i]);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(models_have_their_formulas);
    RUN(tones_are_few);
    RUN(lamps_per_vertex_want_dense_meshes);
    RUN(thresholds_that_fall_are_refused);
    RUN(a_tone_of_nothing_is_in_shadow_too);
    remove_small_scene();
    return check_result();
}
