/* Proves that the pictures of the stages show what the stages did, for a scene of three triangles that are known by their
 * formulas: which is drawn, culled, cut; where clipping makes new vertices; how many triangles the tiles get; which
 * pixels are covered; which texels are read, what shaders name; that the last picture is that of lom_render_frame, and that a frame drawn afterwards is too. */
#include "check.h"

#include <lom/lom.h>

#include <unistd.h>

enum { WIDTH = 320, HEIGHT = 180, ZOOM = 3 };

/* The eye is at (0, 0, 3) and looks along -z: w is 3 - z, x / w and y / w end at the frame's sides where they are aspect
 * tan(30) and tan(30). */
static const double tangent = 0.5773502691896257, near_plane = 0.5;
static const double drawn[3][3] = { { -0.8, 0.1, 0 }, { -0.3, 0.1, 0 }, { -0.8, 0.7, 0 } };
static const double turned[3][3] = { { 0.9, 0.2, 0 }, { 0.3, 0.2, 0 }, { 0.3, 0.8, 0 } };
static const double cut[3][3] = { { 1, -1, 0 }, { -1, -1, 0 }, { 0, -1, 5 } }; /* its tip lies behind the eye */

static char folder[] = "/tmp/lom-stages-XXXXXX";
enum { SCENE, MESH, MATERIAL, TEXTURE, FILES };
static char paths[FILES][64];

static bool write_scene(void)
{
    const double(*const triangles[3])[3] = { drawn, turned, cut };
    char mesh[1000] = "", scene[600];
    for (int i = 0; i < 9; i++) {
        const double *v = triangles[i / 3][i % 3];
        snprintf(mesh + strlen(mesh), sizeof mesh - strlen(mesh), "v %.9g %.9g %.9g\n", v[0], v[1], v[2]);
    }
    strcat(mesh, "mtllib three.mtl\nvt 0.05 0.5\nvt 0.35 0.5\nvt 0.05 0.6\n"
                 "usemtl skin\nf 1/1 2/2 3/3\nusemtl plain\nf 4 5 6\nf 7 8 9\n");
    snprintf(
        scene, sizeof scene,
        "[output]\nwidth = %d\nheight = %d\n[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\nfield_of_view = 60\n"
        "near = %g\n[sky]\ncolor = [0.1, 0.2, 0.4]\n[[entity]]\nname = \"three\"\nmesh = \"three.obj\"\n",
        WIDTH, HEIGHT, near_plane);
    if (mkdtemp(folder) == NULL)
        return false;
    static const char *const names[FILES] = { "scene.toml", "three.obj", "three.mtl", "white.png" };
    static const char material[] = "newmtl skin\nKd 1 1 1\nmap_Kd white.png\nnewmtl plain\nKd 1 1 1\n";
    for (int i = 0; i < FILES; i++)
        snprintf(paths[i], sizeof paths[i], "%s/%s", folder, names[i]);
    lom_image *white = lom_create_image(4, 4, 1, LOM_FORMAT_RGB8, NULL);
    memset(white->pixels, 255, lom_image_size(white));
    bool done = lom_write_file(paths[SCENE], scene, strlen(scene), NULL) &&
                lom_write_file(paths[MESH], mesh, strlen(mesh), NULL) &&
                lom_write_file(paths[MATERIAL], material, strlen(material), NULL) &&
                lom_write_image(paths[TEXTURE], "png", white, NULL);
    lom_free_image(white);
    return done;
}

static void remove_scene(void)
{
    for (int i = 0; i < FILES; i++)
        unlink(paths[i]);
    rmdir(folder);
}

static const lom_stage_picture *find(const lom_stage_pictures *pictures, const char *name)
{
    for (size_t i = 0; pictures != NULL && i < pictures->count; i++)
        if (strcmp(pictures->picture[i].name, name) == 0)
            return &pictures->picture[i];
    static const lom_stage_picture none;
    CHECK(false, "no picture \"%s\"", name);
    return &none;
}

/* Pixels of the frame. */
static void project(const double place[3], double at[2])
{
    double w = 3 - place[2];
    at[0] = (place[0] / (w * tangent * WIDTH / HEIGHT) + 1) / 2 * WIDTH;
    at[1] = (1 - place[1] / (w * tangent)) / 2 * HEIGHT;
}

/* The most of a channel less the most of another, of the pixels around a place. */
static int most_within(const lom_image *image, double x, double y, int channel, int other)
{
    int most = -255;
    for (int j = -1; image != NULL && j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            const uint8_t *p = lom_image_pixel(image, (int)x + i, (int)y + j, 0);
            most = p[channel] - p[other] > most ? p[channel] - p[other] : most;
        }
    return most;
}

/* Whether the legend has a row of this text, which holds this number. */
static bool has_legend(const lom_stage_picture *picture, const char *text)
{
    bool found = false;
    for (int i = 0; i < picture->legend_count; i++)
        found |= strcmp(picture->legend[i].text, text) == 0;
    return found;
}

static void fates_are_shown_where_the_triangles_lie(const lom_stage_pictures *pictures)
{
    const lom_stage_picture *cull = find(pictures, "cull");
    CHECK(has_legend(cull, "culled by their facing: 1 triangle") && has_legend(cull, "drawn: 3 triangles"), "%s",
          cull->legend[0].text);
    CHECK(cull->image->width == WIDTH * ZOOM && cull->image->height == HEIGHT * ZOOM);
    for (int k = 0; k < 3; k++)
        for (int step = 1; step < 8; step++) {
            double a[2], b[2], at[2];
            project(drawn[k], a);
            project(drawn[(k + 1) % 3], b);
            for (int i = 0; i < 2; i++)
                at[i] = (a[i] + (b[i] - a[i]) * step / 8) * ZOOM;
            CHECK(most_within(cull->image, at[0], at[1], 1, 0) > 60, "no green at %g,%g", at[0], at[1]);
            project(turned[k], a);
            project(turned[(k + 1) % 3], b);
            for (int i = 0; i < 2; i++)
                at[i] = (a[i] + (b[i] - a[i]) * step / 8) * ZOOM;
            CHECK(most_within(cull->image, at[0], at[1], 0, 1) > 60, "no red at %g,%g", at[0], at[1]);
        }
}

/* The box of the cut triangle in clip x and w is 6 to 94 of 100 of the picture: x from -x1 to x1, w from -2 to 3. */
static void new_vertices_are_marked_where_the_plane_cuts(const lom_stage_pictures *pictures)
{
    const lom_stage_picture *clip = find(pictures, "clip");
    CHECK(clip->image != NULL && has_legend(clip, "new vertices, made by clipping: 3 corners"));
    CHECK(strstr(clip->text, "crosses a plane: 1 triangle,") != NULL && strstr(clip->text, "pieces left: 2.") != NULL,
          "%s", clip->text);
    double t = (3 - near_plane) / (3 - -2.0), x = 1 - t; /* of the way from w = 3 to w = -2; in parts of x1 */
    for (int side = -1; side <= 1; side += 2) {
        double share[2] = { (side * x + 1) / 2, (near_plane + 2) / 5 };
        const uint8_t *p = lom_image_pixel(clip->image, (int)(WIDTH * ZOOM * (0.06 + 0.88 * share[0])),
                                           (int)(HEIGHT * ZOOM * (0.06 + 0.88 * (1 - share[1]))), 0);
        CHECK(p[0] > 220 && p[1] > 180 && p[2] < 110, "%d %d %d", p[0], p[1], p[2]);
    }
    CHECK(most_within(clip->image, WIDTH * ZOOM / 2, HEIGHT * ZOOM * 0.94 - 1, 0, 1) > 100, "what is cut off is red");
}

/* The sky is in each list, the drawn triangle (window 68 to 143, 48 to 84) in those of four tiles of 64, and the two
 * pieces of what is cut below. */
static void tiles_hold_what_lies_in_them(const lom_stage_pictures *pictures)
{
    const lom_stage_picture *bins = find(pictures, "bins");
    const uint8_t *alone = lom_image_pixel(bins->image, (4 * 64 + 32) * ZOOM, 8 * ZOOM, 0);
    const uint8_t *two = lom_image_pixel(bins->image, (64 + 4) * ZOOM, 8 * ZOOM, 0);
    const uint8_t *again = lom_image_pixel(bins->image, (64 + 4) * ZOOM, (64 + 50) * ZOOM, 0);
    CHECK(strstr(bins->text, "64 x 64") != NULL, "%s", bins->text);
    CHECK(alone[0] < two[0] && alone[1] < two[1], "more triangles are brighter: %d %d", alone[1], two[1]);
    CHECK(again[0] >= two[0], "%d %d", again[0], two[0]);
}

/* Twice the area to the left of an edge. */
static double side_of(const double a[2], const double b[2], double x, double y)
{
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/* Where the drawn triangle covers a centre by a hundredth of a pixel or more there are two triangles, else the sky's. */
static void coverage_is_that_of_the_centres(const lom_stage_pictures *pictures)
{
    const lom_stage_picture *coverage = find(pictures, "coverage");
    double v[3][2];
    int inside_count = 0;
    for (int k = 0; k < 3; k++)
        project(drawn[k], v[k]);
    for (int y = 0; y < 90; y++)
        for (int x = 0; x < WIDTH / 2; x++) {
            double least = 1e9;
            for (int k = 0; k < 3; k++) {
                double side = -side_of(v[k], v[(k + 1) % 3], x + 0.5, y + 0.5);
                least = side < least ? side : least;
            }
            if (least * least < 1)
                continue;
            const uint8_t *p = lom_image_pixel(coverage->image, x * ZOOM + 1, y * ZOOM + 1, 0);
            inside_count += least > 0;
            CHECK((p[0] > 200) == (least > 0), "%d,%d: %d %d %d", x, y, p[0], p[1], p[2]);
        }
    CHECK(inside_count > 300, "%d pixels", inside_count);
    CHECK(coverage->low == 1 && coverage->high == 2 && coverage->has_scale);
}

/* Of 4 x 4 texels s from 0.05 to 0.35 reads columns -1 (which is 3), 0 and 1, t about 0.45 rows 1 and 2; the level is
 * shown as 133 pixels a texel in the middle of the picture. */
static void texels_that_are_read_are_bright(const lom_stage_pictures *pictures)
{
    const lom_stage_picture *texels = find(pictures, "texture-white-png");
    CHECK(strstr(texels->text, "level 0: 4 x 4, 37.5 %") != NULL, "%s", texels->text);
    for (int i = 0; i < 16 && texels->image != NULL; i++) {
        const uint8_t *p = lom_image_pixel(texels->image, 214 + i % 4 * 133 + 66, 4 + i / 4 * 133 + 66, 0);
        bool read = i % 4 != 2 && (i / 4 == 1 || i / 4 == 2);
        CHECK((p[0] == 255) == read, "texel %d,%d: %d", i % 4, i / 4, p[0]);
    }
}

/* The drawn triangle faces the eye: (0, 0, 1) as red, green and blue; 3 metres before it. */
static void values_and_varyings_are_those_of_the_shaders(const lom_stage_pictures *pictures)
{
    double at[2];
    project(drawn[0], at);
    const uint8_t *normal =
        lom_image_pixel(find(pictures, "normal")->image, ((int)at[0] + 5) * ZOOM, ((int)at[1] - 5) * ZOOM, 0);
    CHECK(normal[0] == 128 && normal[1] == 128 && normal[2] == 255, "%d %d %d", normal[0], normal[1], normal[2]);
    const lom_stage_picture *x = find(pictures, "varying-0-entity-phong"),
                            *z = find(pictures, "varying-2-entity-phong");
    CHECK(strcmp(x->title, "offset.x of entity_phong") == 0 && strcmp(z->title, "offset.z of entity_phong") == 0);
    CHECK(z->low <= -2.9999 && z->low > -3.0001, "%g", z->low);
}

static void lists_are_whole(const lom_stage_pictures *pictures, const lom_frame *frame)
{
    static const char *const wanted[] = { "mesh",     "vertex",
                                          "clip",     "window",
                                          "cull",     "bins",
                                          "coverage", "coverage-detail",
                                          "depth",    "varying-0-entity-phong",
                                          "normal",   "ambient",
                                          "diffuse",  "albedo",
                                          "shaded",   "pass-scene",
                                          "final" };
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++)
        find(pictures, wanted[i]);
    for (size_t i = 0; i < pictures->count; i++) {
        const lom_stage_picture *p = &pictures->picture[i];
        CHECK(p->image != NULL && p->title[0] != 0 && p->text[0] != 0 && p->group != NULL, "%s", p->name);
        CHECK(strspn(p->name, "abcdefghijklmnopqrstuvwxyz0123456789-") == strlen(p->name) && p->name[0] != 0);
        CHECK(p->source == NULL || access(p->source, R_OK) == 0, "%s", p->source);
        for (size_t k = 0; k < i; k++)
            CHECK(strcmp(pictures->picture[k].name, p->name) != 0, "%s", p->name);
    }
    const lom_image *last = pictures->picture[pictures->count - 1].image;
    CHECK(strcmp(pictures->picture[pictures->count - 1].name, "final") == 0);
    CHECK(last->format == frame->image->format && lom_image_size(last) == lom_image_size(frame->image) &&
          memcmp(last->pixels, frame->image->pixels, lom_image_size(last)) == 0);
}

static void the_pictures_of_three_triangles(void)
{
    lom_error error = { .code = LOM_OK };
    lom_frame before = { .image = NULL }, after = { .image = NULL };
    lom_scene *scene = write_scene() ? lom_read_scene(paths[SCENE], NULL, 0, &error) : NULL;
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, NULL, &error) : NULL;
    CHECK(renderer != NULL && lom_render_frame(renderer, NULL, &before, &error), "%s", error.text);
    if (renderer == NULL)
        return;
    lom_stage_pictures *pictures = lom_picture_stages(renderer, &(lom_stages_desc){ .pass = NULL }, &error);
    CHECK(pictures != NULL, "%s", error.text);
    if (pictures != NULL) {
        CHECK(pictures->width == WIDTH && pictures->height == HEIGHT && strcmp(pictures->pass, "scene") == 0);
        lists_are_whole(pictures, &before);
        fates_are_shown_where_the_triangles_lie(pictures);
        new_vertices_are_marked_where_the_plane_cuts(pictures);
        tiles_hold_what_lies_in_them(pictures);
        coverage_is_that_of_the_centres(pictures);
        texels_that_are_read_are_bright(pictures);
        values_and_varyings_are_those_of_the_shaders(pictures);
        CHECK(lom_render_frame(renderer, NULL, &after, &error) &&
              memcmp(after.image->pixels, before.image->pixels, lom_image_size(after.image)) == 0);
    }
    CHECK(lom_picture_stages(renderer, &(lom_stages_desc){ .pass = "mirror" }, &error) == NULL);
    CHECK(strstr(error.text, "\"mirror\"") != NULL && strstr(error.text, "scene") != NULL, "%s", error.text);
    lom_free_stage_pictures(pictures);
    lom_free_stage_pictures(NULL);
    lom_free_image(before.image);
    lom_free_image(after.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    remove_scene();
}

/* What is shown depends on the scene alone. */
static void pictures_are_the_same_with_any_workers(void)
{
    uint64_t hash[2] = { 0, 0 };
    for (int i = 0; i < 2; i++) {
        lom_error error = { .code = LOM_OK };
        const lom_device_desc device = { .threads = 1 + 2 * i, .lanes = i == 0 ? 4 : 0 };
        lom_scene *scene = lom_read_scene("assets/scenes/lake.toml", NULL, 0, &error);
        lom_renderer *renderer = lom_create_renderer(scene, &device, &error);
        const lom_stages_desc desc = { .frame = { .width = 64, .height = 36 }, .pass = "water" };
        lom_stage_pictures *pictures = lom_picture_stages(renderer, &desc, &error);
        CHECK(pictures != NULL, "%s", error.text);
        for (size_t k = 0; pictures != NULL && k < pictures->count; k++) {
            uint64_t one = lom_hash_image(pictures->picture[k].image);
            hash[i] = lom_hash_bytes(hash[i], &one, sizeof one);
            hash[i] = lom_hash_bytes(hash[i], pictures->picture[k].text, strlen(pictures->picture[k].text));
        }
        lom_free_stage_pictures(pictures);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
    CHECK(hash[0] == hash[1] && hash[0] != 0);
}

int main(int argc, char **argv)
{
    RUN(the_pictures_of_three_triangles);
    RUN(pictures_are_the_same_with_any_workers);
    return check_result();
}
