/* Proves what parallel cameras show (docs/cameras.md), by closed forms: metres are as many pixels wherever they are,
 * what recedes is drawn at the length and angle that it was told, a camera that moves by pixels moves the picture by as
 * many, depth is the distance along the view axis, a scene far from the origin is the same; and over every small scene
 * that a crop is the cut-out of the whole, bit for bit, at both widths and any number of threads; that the reference by
 * rays draws the same. */
#include "check.h"
#include "key_bases.h"
#include "small_scene.h"

#include <lom/lom.h>

enum { BASES = sizeof bases / sizeof bases[0], SIZE = 64 };

static const char square_obj[] = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";

static lom_scene *read_text(const char *text, const char *const *overrides, size_t count)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), overrides, count, &error);
    CHECK(scene != NULL, "%s", error.text);
    return scene;
}

static lom_image *draw(const lom_scene *scene, const lom_device_desc *device, const lom_frame_desc *desc)
{
    lom_error error = { .code = LOM_OK };
    lom_frame frame = { .image = NULL };
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, device, &error) : NULL;
    if (renderer != NULL)
        lom_render_frame(renderer, desc, &frame, &error);
    CHECK(frame.image != NULL, "%s", error.text);
    lom_free_renderer(renderer);
    return frame.image;
}

static lom_image *draw_text(const char *text)
{
    lom_scene *scene = read_text(text, NULL, 0);
    lom_image *image = draw(scene, &(lom_device_desc){ .threads = 1 }, &(lom_frame_desc){ .frame = 0 });
    lom_free_scene(scene);
    return image;
}

/* The pixels that are not black: columns x0 .. x1 - 1 and rows y0 .. y1 - 1, and how many. */
struct seen {
    int x0, y0, x1, y1, count;
};

static struct seen look(const lom_image *image)
{
    struct seen s = { 9999, 9999, 0, 0, 0 };
    for (int y = 0; image != NULL && y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            if (((const float *)lom_image_pixel(image, x, y, 0))[0] == 0)
                continue;
            s.x0 = x < s.x0 ? x : s.x0;
            s.y0 = y < s.y0 ? y : s.y0;
            s.x1 = x + 1 > s.x1 ? x + 1 : s.x1;
            s.y1 = y + 1 > s.y1 ? y + 1 : s.y1;
            s.count++;
        }
    return s;
}

/* A camera at (0, 0, 32) that looks along -z at the origin, a picture of 64 pixels and 16 metres, a square. */
static const char plain[] = "[output]\nwidth = 64\nheight = 64\nformat = 'rgb32f'\n"
                            "[camera]\nposition = [0, 0, 32]\ntarget = [0, 0, 0]\nheight = 16\nfar = 128\n%s\n"
                            "[light]\nambient = [1, 1, 1]\n[sky]\ncolor = [0, 0, 0]\n"
                            "[[entity]]\nmesh = 'square.obj'\nposition = [%.17g, %.17g, %.17g]\n"
                            "material.ambient = [1, 1, 1]\n";

static struct seen draw_square(const char *camera, double x, double y, double z)
{
    char text[1000];
    snprintf(text, sizeof text, plain, camera, x, y, z);
    lom_image *image = draw_text(text);
    struct seen s = look(image);
    lom_free_image(image);
    return s;
}

static void a_metre_is_as_many_pixels_everywhere(void)
{
    for (int i = 0; i < 60; i++) { /* quarters of a metre are pixels */
        const double x = (i % 5 - 2) * 1.75, y = (i / 5 % 4 - 1.5) * 3, z = (i % 3 - 1) * 25.0;
        struct seen s = draw_square("projection = 'orthographic'", x, y, z);
        const int left = 32 + (int)((x - 1) * 4), top = 32 - (int)((y + 1) * 4);
        CHECK(s.count == 64 && s.x0 == left && s.x1 == left + 8 && s.y0 == top && s.y1 == top + 8,
              "at %g, %g, %g: %d pixels, %d..%d, %d..%d", x, y, z, s.count, s.x0, s.x1, s.y0, s.y1);
    }
}

static void what_recedes_has_its_length_and_angle(void)
{
    static const struct {
        const char *camera;
        double right, up; /* a metre of depth */
    } cases[] = { { "projection = 'oblique'\nforeshortening = 0.5\nreceding_angle = 0", 0.5, 0 },
                  { "projection = 'oblique'\nforeshortening = 1\nreceding_angle = 90", 0, 1 },
                  { "projection = 'oblique'\nforeshortening = 1\nreceding_angle = 180", -1, 0 },
                  { "projection = 'oblique'\nforeshortening = 0.25\nreceding_angle = -90", 0, -0.25 },
                  { "projection = 'oblique'\nforeshortening = 0\nreceding_angle = 33", 0, 0 },
                  { "projection = 'oblique'", 0.35355339059327373, 0.35355339059327373 } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int z = -4; z <= 4; z += 2) { /* -z metres farther than the target, which stays in the middle */
            struct seen s = draw_square(cases[i].camera, 0, 0, z);
            const double left = 32 + (-1 - z * cases[i].right) * 4, top = 32 - (1 - z * cases[i].up) * 4;
            CHECK(s.count == 64 && s.x1 - s.x0 == 8 && s.y1 - s.y0 == 8, "%zu, %d: what faces it keeps its shape", i,
                  z);
            CHECK(__builtin_fabs(s.x0 - left) <= 0.5001 && __builtin_fabs(s.y0 - top) <= 0.5001,
                  "%s at z %d: %d, %d, not %g, %g", cases[i].camera, z, s.x0, s.y0, left, top);
        }
}

static void nothing_is_drawn_beyond_its_planes(void)
{
    CHECK(draw_square("projection = 'orthographic'\nnear = 1", 0, 0, 30.5).count == 64);
    CHECK(draw_square("projection = 'orthographic'\nnear = 2", 0, 0, 30.5).count == 0);
    CHECK(draw_square("projection = 'orthographic'", 0, 0, -95.5).count == 64);
    CHECK(draw_square("projection = 'orthographic'", 0, 0, -96.5).count == 0);
}

/* ---- small scenes by parallel rays ---- */

static const char *const orthographic[] = { "camera.projection=orthographic", "camera.height=9", "camera.far=64",
                                            "camera.position=[-3, 8, 11]" };
static const char *const oblique[] = { "camera.projection=oblique", "camera.height=9", "camera.far=64",
                                       "camera.position=[1, 5, 12]" };
enum { OVERRIDES = 4 };

static lom_scene *read_base(int i, const char *const *overrides)
{
    static char text[8192];
    snprintf(text, sizeof text, "%s%s", head, bases[i].text);
    return strstr(text, "yaw = 20") != NULL ? NULL : read_text(text, overrides, OVERRIDES);
}

static bool is_cut_out(const lom_image *whole, const lom_image *part, lom_rect at)
{
    for (int y = 0; y < at.height; y++)
        if (memcmp(lom_image_pixel(whole, at.x, at.y + y, 0), lom_image_pixel(part, 0, y, 0),
                   (size_t)at.width * 3 * sizeof(float)) != 0)
            return false;
    return true;
}

static void a_crop_is_the_cut_out(void)
{
    static const lom_rect crops[] = { { 0, 0, 48, 27 }, { 7, 5, 20, 11 }, { 30, 14, 18, 13 } };
    for (int i = 0; i < BASES; i++)
        for (int kind = 0; kind < 2; kind++) {
            lom_scene *scene = strstr(bases[i].name, "reference") == NULL || strstr(bases[i].name, "impostors") != NULL
                                   ? read_base(i, kind == 0 ? orthographic : oblique)
                                   : NULL;
            if (scene == NULL)
                continue;
            lom_image *whole = draw(scene, &(lom_device_desc){ .threads = 1, .lanes = 4 },
                                    &(lom_frame_desc){ .width = 48, .height = 27 });
            for (int k = 0; k < 3 && whole != NULL; k++) {
                lom_image *part = draw(scene, &(lom_device_desc){ .threads = 1 + k, .lanes = 8, .tile = 16 },
                                       &(lom_frame_desc){ .width = 48, .height = 27, .crop = crops[k] });
                CHECK(part != NULL && is_cut_out(whole, part, crops[k]), "%s, projection %d, crop %d", bases[i].name,
                      kind, k);
                lom_free_image(part);
            }
            lom_free_image(whole);
            lom_free_scene(scene);
        }
}

/* Terrain and entities, clouds, a lake: what both draw alike. */
static void the_reference_sees_the_same(void)
{
    static const struct {
        const char *text;
        double decibels;
    } cases[] = { { VIEW TERRAIN "[[entity]]\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n[haze]\ndensity = 0.02\n"
                                 "height = 4\n[quality]\nterrain_error = 0\n",
                    55 },
                  { VIEW "[sky]\ngradient = true\n" TERRAIN "[quality]\nterrain_error = 0\n", 95 },
                  { VIEW CLOUD "extinction = 0.04\ndetail_size = 180\n[quality]\ncloud_error = 0.0002\n"
                               "cloud_jitter = false\n[clouds]\nshadows = false\n",
                    45 },
                  { VIEW TERRAIN "[water]\nlevel = 0\nsize = 30\n[water.waves]\nkind = \"gerstner\"\ncount = 2\n"
                                 "height = 0.1\nlength = [8, 3]\n[water.optics]\nroughness = 0\ncaustics = 0\n"
                                 "[quality]\nwater = \"displaced\"\nterrain_error = 0\n",
                    40 } };
    for (int kind = 0; kind < 2; kind++)
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            char text[4000];
            snprintf(text, sizeof text, "%s%s", head, cases[i].text);
            lom_scene *scene = read_text(text, kind == 0 ? orthographic : oblique, OVERRIDES);
            lom_reference *reference = scene != NULL ? lom_create_reference(scene, NULL) : NULL;
            lom_image *rays =
                reference == NULL
                    ? NULL
                    : lom_trace_scene(reference,
                                      &(lom_reference_frame){ .width = 96, .height = 54, .samples = 1, .depth = 3 },
                                      NULL);
            lom_image *image =
                draw(scene, &(lom_device_desc){ .threads = 1 }, &(lom_frame_desc){ .width = 96, .height = 54 });
            lom_comparison result = { .psnr = 0 };
            if (rays != NULL && image != NULL)
                lom_compare_images(image, rays, &result, NULL);
            CHECK(result.psnr >= cases[i].decibels, "case %zu, projection %d: %.2f dB", i, kind, result.psnr);
            lom_free_image(rays);
            lom_free_image(image);
            lom_free_reference(reference);
            lom_free_scene(scene);
        }
}

/* ---- moving ---- */

/* A camera that looks straight down, its pixels 1/4 m, over places that floats hold: the same bits. */
static void a_camera_that_moves_by_pixels_moves_the_picture(void)
{
    char text[3000];
    snprintf(text, sizeof text,
             "[output]\nwidth = 64\nheight = 64\nformat = 'rgb32f'\n[camera]\nposition = [0, 16, 0]\n"
             "target = [0, 0, 0]\nup = [0, 0, -1]\nprojection = 'orthographic'\nheight = 16\nfar = 64\n"
             "[sky]\ncolor = [0.25, 0.5, 0.75]\n[light]\nelevation = 40\n%s"
             "[water]\nlevel = 0\nsize = 30\n[quality]\nwater = 'planar'\n",
             "[[entity]]\nmesh = \"box.obj\"\nposition = [1, 0.5, 1]\n[[entity]]\nmesh = \"box.obj\"\n"
             "position = [-4, -1, -2.5]\n");
    lom_image *before = draw_text(text);
    static const int moves[][2] = { { 1, 0 }, { 0, -3 }, { 8, 16 }, { -5, 2 } };
    for (int i = 0; i < 4; i++) {
        char position[80], target[80];
        const double x = moves[i][0] * 0.25, z = moves[i][1] * 0.25;
        snprintf(position, sizeof position, "camera.position=[%g, 16, %g]", x, z);
        snprintf(target, sizeof target, "camera.target=[%g, 0, %g]", x, z);
        const char *const overrides[] = { position, target };
        lom_scene *scene = read_text(text, overrides, 2);
        lom_image *after = draw(scene, &(lom_device_desc){ .threads = 1 }, &(lom_frame_desc){ .frame = 0 });
        int wrong = 0;
        for (int row = 16; before != NULL && after != NULL && row < 48; row++)
            for (int column = 16; column < 48; column++) {
                const float *a = lom_image_pixel(after, column, row, 0);
                const float *b = lom_image_pixel(before, column + moves[i][0], row + moves[i][1], 0);
                for (int k = 0; k < 3; k++)
                    wrong += a[k] != b[k];
            }
        CHECK(wrong == 0, "moved by %d, %d: %d samples differ", moves[i][0], moves[i][1], wrong);
        lom_free_image(after);
        lom_free_scene(scene);
    }
    lom_free_image(before);
}

/* Places are multiples of 1/8 m, so that all of them are exact up to 2^27 m: the same bytes. */
static void a_scene_far_away_is_the_same(void)
{
    for (int kind = 0; kind < 2; kind++) {
        uint64_t first = 0;
        for (int shift = 9; shift <= 27; shift += shift == 9 ? 1 : shift == 10 ? 10 : 7) {
            const double at = shift == 9 ? 0 : __builtin_ldexp(1, shift);
            char text[2000];
            snprintf(text, sizeof text,
                     "[output]\nwidth = 64\nheight = 48\nformat = 'rgb32f'\n[camera]\nposition = [%.17g, 6, %.17g]\n"
                     "target = [%.17g, 0, %.17g]\nprojection = '%s'\nheight = 8\nfar = 64\n[sky]\ngradient = true\n"
                     "[haze]\ndensity = 0.01\n[[entity]]\nmesh = \"box.obj\"\nposition = [%.17g, 0.5, %.17g]\n"
                     "[water]\nlevel = 0\nposition = [%.17g, %.17g]\nsize = 16\n[quality]\nwater = '%s'\n",
                     at + 3, at + 10, at, at, kind == 0 ? "orthographic" : "oblique", at, at + 1, at, at, "planar");
            lom_image *image = draw_text(text);
            uint64_t hash = image != NULL ? lom_hash_image(image) : 1;
            first = shift == 9 ? hash : first;
            CHECK(hash == first, "at 2^%d m, projection %d", shift, kind);
            lom_free_image(image);
        }
    }
}

static void its_depth_is_the_distance_along_the_view_axis(void)
{
    char text[1000];
    for (int kind = 0; kind < 2; kind++) {
        snprintf(text, sizeof text, plain, kind == 0 ? "projection = 'orthographic'" : "projection = 'oblique'", 0.0,
                 0.0, 3.0);
        lom_scene *scene = read_text(text, NULL, 0);
        lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, NULL, NULL) : NULL;
        lom_frame frame = { .image = NULL };
        bool drawn = renderer != NULL && lom_render_frame(renderer, NULL, &frame, NULL);
        lom_image *depth = drawn ? lom_show_pass(renderer, &(lom_frame_desc){ .frame = 0 }, "depth", NULL) : NULL;
        CHECK(depth != NULL);
        if (depth != NULL) {
            float at = *(const float *)lom_image_pixel(depth, kind == 0 ? 32 : 28, kind == 0 ? 32 : 36, 0);
            CHECK(__builtin_fabsf(at - 29) < 1e-4f, "%g m", (double)at);
            CHECK(*(const float *)lom_image_pixel(depth, 2, 2, 0) == 0);
        }
        lom_free_image(depth);
        lom_free_image(frame.image);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

static void what_it_cannot_be_is_refused(void)
{
    static const struct {
        const char *keys, *says;
    } cases[] = { { "projection = 'orthographic'\nfar = 0.05", "far plane" },
                  { "projection = 'oblique'\nnear = 20000", "far plane" },
                  { "projection = 'isometric'", "projection" },
                  { "projection = 'oblique'\nheight = 0", "height" },
                  { "projection = 'oblique'\nforeshortening = -1", "foreshortening" },
                  { "projection = 'oblique'\n[[camera.key]]\ntime = 0\nheight = -2", "height" } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[400];
        lom_error error = { .code = LOM_OK };
        snprintf(text, sizeof text, "[camera]\n%s\n", cases[i].keys);
        lom_scene *scene = lom_decode_scene(text, strlen(text), "a.toml", NULL, 0, &error);
        CHECK(scene == NULL && strstr(error.text, cases[i].says) != NULL, "%s: %s", cases[i].keys, error.text);
        lom_free_scene(scene);
    }
    const lom_camera_view good = { .target = { 0, 0, -1 },
                                   .up = { 0, 1, 0 },
                                   .near_plane = 1,
                                   .height = 2,
                                   .far_plane = 9,
                                   .projection = LOM_PROJECTION_OBLIQUE };
    lom_camera_view wrong[3] = { good, good, good };
    wrong[0].height = 0;
    wrong[1].far_plane = 1;
    wrong[2].shear[1] = __builtin_nan("");
    lom_scene *scene = read_text("[output]\nwidth = 8\nheight = 8\n", NULL, 0);
    CHECK(lom_check_frame(scene, &(lom_frame_desc){ .camera = &good }, NULL));
    for (int i = 0; i < 3; i++)
        CHECK(!lom_check_frame(scene, &(lom_frame_desc){ .camera = &wrong[i] }, NULL), "%d", i);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    if (!make_small_scene() || !small_text("square.obj", square_obj, &error))
        return 1;
    RUN(a_metre_is_as_many_pixels_everywhere);
    RUN(what_recedes_has_its_length_and_angle);
    RUN(nothing_is_drawn_beyond_its_planes);
    RUN(a_crop_is_the_cut_out);
    RUN(the_reference_sees_the_same);
    RUN(a_camera_that_moves_by_pixels_moves_the_picture);
    RUN(a_scene_far_away_is_the_same);
    RUN(its_depth_is_the_distance_along_the_view_axis);
    RUN(what_it_cannot_be_is_refused);
    remove_small_scene();
    return check_result();
}
