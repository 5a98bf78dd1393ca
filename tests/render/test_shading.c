/* Proves the models of shading, for terrain and entities: on a plane light for each fragment, each vertex and each face
 * is the same and follows Lambert's cosine; where the surface bends they differ, a face is of one colour, and none is
 * brighter or darker on the whole. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { WIDTH = 64, HEIGHT = 48, PIXELS = WIDTH * HEIGHT };

static const char *const models[3] = { "phong", "gouraud", "flat" };

/* The red of every pixel. `light` and `things` are keys of a scene that looks straight down. */
static bool draw(const char *model, const char *light, const char *things, float red[PIXELS])
{
    char text[2000];
    lom_error error = { 0 };
    snprintf(
        text, sizeof text,
        "[output]\nwidth = 64\nheight = 48\nformat = 'rgb32f'\n[camera]\nposition = [0, 30, 0]\ntarget = [0, 0, 0]\n"
        "up = [0, 0, -1]\nfield_of_view = 30\n[sky]\ncolor = [0, 0, 0]\n"
        "[quality]\nshading = '%s'\nambient_occlusion = false\nterrain_error = 0\nmipmaps = false\n"
        "[light]\nambient = [0, 0, 0]\n%s\n%s",
        model, light, things);
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("shading.toml"), NULL, 0, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    lom_frame drawn = { .image = NULL };
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ 0 }, &drawn, &error);
    CHECK(done, "%s", error.text);
    for (int i = 0; done && i < PIXELS; i++)
        red[i] = *(const float *)lom_image_pixel(drawn.image, i % WIDTH, i / WIDTH, 0);
    lom_free_image(drawn.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

/* ---- what is drawn ---- */

/* A plane that rises to +x by 8 m in 40, or hills. */
static bool put_heights(const char *name, bool hills)
{
    lom_error error = { 0 };
    lom_image *map = lom_create_image(17, 17, 1, LOM_FORMAT_R16, &error);
    for (int i = 0; i < 17 * 17; i++) {
        double x = i % 17, z = i / 17;
        double height = hills ? 0.5 + 0.25 * sin(x * 0.9) + 0.25 * cos(z * 0.7) : x / 16;
        ((uint16_t *)(void *)map->pixels)[i] = (uint16_t)(height * 65535 + 0.5);
    }
    bool put = lom_write_image(small_path(name), NULL, map, &error);
    lom_free_image(map);
    CHECK(put, "%s", error.text);
    return put;
}

/* The same as a mesh of triangles, with normals at the vertices: a plane, or a part of a ball. */
static bool put_mesh(const char *name, bool ball)
{
    static char text[20000];
    lom_error error = { 0 };
    size_t used = 0;
    for (int i = 0; i < 81; i++) {
        double x = (i % 9 - 4) * 5, z = (i / 9 - 4) * 5, y = ball ? sqrt(40 * 40 - x * x - z * z) - 32 : x / 5 + 4;
        double n[3] = { ball ? x : -0.2, ball ? y + 32 : 1, ball ? z : 0 };
        used += (size_t)snprintf(text + used, sizeof text - used, "v %.9g %.9g %.9g\nvn %.9g %.9g %.9g\n", x, y, z,
                                 n[0], n[1], n[2]);
    }
    for (int i = 0; i < 64; i++) {
        int a = i / 8 * 9 + i % 8 + 1;
        used += (size_t)snprintf(text + used, sizeof text - used, "f %d//%d %d//%d %d//%d\nf %d//%d %d//%d %d//%d\n", a,
                                 a, a + 9, a + 9, a + 1, a + 1, a + 1, a + 1, a + 9, a + 9, a + 10, a + 10);
    }
    bool put = small_text(name, text, &error);
    CHECK(put, "%s", error.text);
    return put;
}

#define DULL         "specular = [0, 0, 0]\ndiffuse = [0.5, 0.5, 0.5]\n"
#define GROUND(map)  "[terrain]\nheight_map = '" map "'\nsize = 40\nheight = 8\n[terrain.material]\n" DULL
#define ENTITY(mesh) "[[entity]]\nmesh = '" mesh "'\n[entity.material]\n" DULL

/* Of a plane with the normal (-1/5, 1, 0) under two suns, and of the same without. */
static void planes_are_the_same_in_every_model(void)
{
    static const char *const things[2] = { GROUND("plane.png"), ENTITY("plane.obj") };
    static const double ways[2][3] = { { 1, -2, 0.5 }, { -2, -2, 1 } }; /* the way the light travels */
    static float red[3][2][PIXELS];
    if (!put_heights("plane.png", false) || !put_mesh("plane.obj", false))
        return;
    for (int thing = 0; thing < 2; thing++) {
        for (int m = 0; m < 3; m++)
            for (int sun = 0; sun < 2; sun++) {
                char light[100];
                snprintf(light, sizeof light, "direction = [%g, %g, %g]", ways[sun][0], ways[sun][1], ways[sun][2]);
                if (!draw(models[m], light, things[thing], red[m][sun]))
                    return;
            }
        double cosine[2];
        for (int sun = 0; sun < 2; sun++) {
            const double *w = ways[sun];
            cosine[sun] = (0.2 * w[0] - w[1]) / sqrt(1.04 * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
        }
        for (int p = 0; p < PIXELS; p++) {
            double ratio = (double)red[0][0][p] / (double)red[0][1][p], expected = cosine[0] / cosine[1];
            CHECK(fabs(ratio / expected - 1) < 1e-3, "thing %d, pixel %d: %g, not %g", thing, p, ratio, expected);
            for (int m = 1; m < 3; m++)
                CHECK(fabsf(red[m][0][p] - red[0][0][p]) < 1e-4f, "thing %d, pixel %d, %s: %g, not %g", thing, p,
                      models[m], (double)red[m][0][p], (double)red[0][0][p]);
        }
    }
}

/* Neighbours of exactly one colour. */
static int equal_neighbours(const float red[PIXELS])
{
    int equal = 0;
    for (int p = 0; p < PIXELS - 1; p++)
        equal += fabsf(red[p] - red[p + 1]) < 1e-6f;
    return equal;
}

static double mean(const float red[PIXELS])
{
    double sum = 0;
    for (int p = 0; p < PIXELS; p++)
        sum += (double)red[p] / PIXELS;
    return sum;
}

static void bends_show_the_model(void)
{
    static const char *const things[2] = { GROUND("hills.png"), ENTITY("ball.obj") };
    static float red[3][PIXELS];
    if (!put_heights("hills.png", true) || !put_mesh("ball.obj", true))
        return;
    for (int thing = 0; thing < 2; thing++) {
        for (int m = 0; m < 3; m++)
            if (!draw(models[m], "direction = [1, -1.5, 0.4]", things[thing], red[m]))
                return;
        CHECK(equal_neighbours(red[2]) > PIXELS / 2, "%d of flat faces", equal_neighbours(red[2]));
        for (int m = 0; m < 2; m++)
            CHECK(equal_neighbours(red[m]) < PIXELS / 4, "%s: %d", models[m], equal_neighbours(red[m]));
        for (int m = 1; m < 3; m++) {
            CHECK(memcmp(red[m], red[0], sizeof red[0]) != 0, "%s is phong", models[m]);
            CHECK(fabs(mean(red[m]) / mean(red[0]) - 1) < 0.05, "%s: %g, phong: %g", models[m], mean(red[m]),
                  mean(red[0]));
        }
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(planes_are_the_same_in_every_model);
    RUN(bends_show_the_model);
    remove_small_scene();
    return check_result();
}
