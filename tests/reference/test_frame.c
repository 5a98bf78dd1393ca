/* Proves that the reference's pictures are those of the pipeline where both draw the same, and that a pixel depends on
 * nothing but its place in the whole frame: threads and crops change no byte. */
#include "check.h"
#include "scene_files.h"

#include <lom/render.h>

#include <math.h>

enum { WIDTH = 120, HEIGHT = 75 };

#define THINGS_ON(light, ground)                                                                                       \
    "[camera]\nposition = [0, 4, 17]\npitch = -12\nnear = 0.2\n"                                                       \
    "[light]\n" light "[terrain]\nheight_map = \"heights.png\"\nsize = [40, 40]\nheight = 4\n"                         \
    "base = -1\ntexture = \"texels.png\"\ntile = 9\n" ground                                                           \
    "[terrain.material]\nspecular = [0.4, 0.4, 0.4]\nshininess = 12\n"                                                 \
    "[[terrain.layer]]\nmap = \"texels.png\"\ntile = 30\nfrom_height = 1\nblend = 1\n"                                 \
    "[[entity]]\nmesh = \"quad.obj\"\nposition = [-4, 1.2, 4]\nrotation = [0, 30, 10]\n"                               \
    "[[entity]]\nmesh = \"quad.obj\"\nposition = [3.6, 0.3, 6]\nscale = [1, 2, 1]\non_ground = true\n"

#define THINGS_UNDER(light) THINGS_ON(light, "")

#define THINGS THINGS_UNDER("azimuth = 160\nelevation = 35\n")

static lom_image *trace(const lom_scene *scene, double index, lom_reference_frame frame)
{
    lom_reference *reference = lom_create_reference(scene, NULL);
    lom_image *image = NULL;
    frame.width = WIDTH;
    frame.height = HEIGHT;
    if (reference != NULL) {
        lom_reference_water water = lom_get_reference_water(reference);
        water.index = index;
        water.roughness = index > 1e6 ? 0 : water.roughness; /* a mirror is smooth */
        CHECK(lom_set_reference_water(reference, &water, NULL));
        image = lom_trace_scene(reference, &frame, NULL);
    }
    lom_free_reference(reference);
    return image;
}

static lom_frame render_with(const lom_scene *scene, int lanes, int threads)
{
    lom_renderer *renderer = lom_create_renderer(scene, &(lom_device_desc){ .lanes = lanes, .threads = threads }, NULL);
    lom_frame frame = { .image = NULL };
    if (renderer != NULL)
        lom_render_frame(renderer, &(lom_frame_desc){ .width = WIDTH, .height = HEIGHT }, &frame, NULL);
    lom_free_renderer(renderer);
    return frame;
}

static lom_image *render(const lom_scene *scene)
{
    return render_with(scene, 4, 1).image;
}

/* Decibels between the pipeline's picture and the reference's with water of this index, one ray a pixel. */
static double agreement(const char *text, double index)
{
    lom_comparison result = { .psnr = 0 };
    lom_scene *scene = make_scene(text);
    lom_image *a = scene == NULL ? NULL : render(scene), *b = NULL;
    if (scene != NULL)
        b = trace(scene, index, (lom_reference_frame){ .samples = 1, .depth = 4 });
    CHECK(a != NULL && b != NULL && lom_compare_images(a, b, &result, NULL));
    lom_free_image(a);
    lom_free_image(b);
    lom_free_scene(scene);
    return result.psnr;
}

#define EXACT                                                                                                          \
    "[output]\nformat = \"rgb32f\"\n[quality]\nmipmaps = false\nterrain_error = 0\nambient_occlusion = false\n"

/* Floats of both; what is left are pixels on edges, where vertices are snapped to 1/256 of a pixel. */
static void opaque_scenes_are_the_pipelines(void)
{
    double psnr = agreement(EXACT THINGS, 1);
    CHECK(psnr > 75, "%.1f dB", psnr);
}

/* Ground with all that it can have: small colours and normals laid over it, a layer from three sides, grains of one that
 * show the brightness of what lies below. */
static void ground_of_many_pictures_is_the_pipelines(void)
{
    double psnr = agreement(EXACT THINGS_ON("azimuth = 160\nelevation = 35\n",
                                            "detail_map = \"texels.png\"\ndetail_tile = 2.5\nnormal_map = "
                                            "\"texels.png\"\n") "[[terrain.layer]]\nmap = \"texels.png\"\ntile = "
                                                                "3\nmapping = \"triplanar\"\nfrom_slope = 8\n"
                                                                "slope_blend = 4\ngrain = 0.6\n",
                            1);
    CHECK(psnr > 60, "%.1f dB", psnr);
    CHECK(fabs(psnr - agreement(EXACT THINGS, 1)) > 0.01, "the pictures show nothing");
}

/* Shadows have hard edges in the one and edges of a texel in the other; everywhere else they are the same. */
static void shadows_fall_where_the_references_do(void)
{
    double psnr = agreement(
        EXACT "entity_shadows = 2048\nterrain_shadows = true\n" THINGS_UNDER("azimuth = 30\nelevation = 40\n"), 1);
    CHECK(psnr > 37, "%.1f dB", psnr);
}

/* The planar lake, still and all mirror, draws the scene mirrored in its plane: so does the reference's mirror. */
static void the_planar_reflection_is_the_mirrored_scene(void)
{
    double psnr = agreement(EXACT "water = \"planar\"\n" THINGS
                                  "[water]\nlevel = 0.2\nrefraction = false\nflow = false\nnormals = false\n"
                                  "specular = false\ntint = false\nsoft_shore = false\nfresnel_power = 64\n",
                            1e15);
    CHECK(psnr > 48, "%.1f dB", psnr);
}

static bool same_rectangle(const lom_image *whole, const lom_image *part, int x0, int y0)
{
    bool same = part != NULL;
    for (int y = 0; same && y < part->height; y++)
        same = memcmp(lom_image_pixel(whole, x0, y0 + y, 0), lom_image_pixel(part, 0, y, 0),
                      (size_t)part->width * lom_format_size(part->format)) == 0;
    return same;
}

static void threads_and_crops_change_no_byte(void)
{
    lom_scene *scene =
        make_scene(THINGS "[water]\nlevel = 0.2\nnormal_map = \"texels.png\"\nflow_map = \"texels.png\"\n");
    if (scene == NULL)
        return;
    lom_image *whole = trace(scene, 1.33, (lom_reference_frame){ .samples = 3, .depth = 3, .threads = 1 });
    CHECK(whole != NULL);
    for (int threads = 2; threads <= 8 && whole != NULL; threads += 3) {
        lom_image *other = trace(scene, 1.33, (lom_reference_frame){ .samples = 3, .depth = 3, .threads = threads });
        CHECK(other != NULL && lom_hash_image(other) == lom_hash_image(whole), "%d threads", threads);
        lom_free_image(other);
    }
    const lom_rect crops[] = { { 0, 0, WIDTH, 1 }, { 37, 31, 64, 33 }, { WIDTH - 1, HEIGHT - 1, 1, 1 } };
    for (int i = 0; i < 3 && whole != NULL; i++) {
        lom_image *part = trace(scene, 1.33, (lom_reference_frame){ .crop = crops[i], .samples = 3, .depth = 3 });
        CHECK(same_rectangle(whole, part, crops[i].x, crops[i].y), "crop %d", i);
        lom_free_image(part);
    }
    lom_free_image(whole);
    lom_free_scene(scene);
}

/* quality.water = "reference": the renderer's picture is the traced one, with no pass but that. */
static void the_renderer_shows_it(void)
{
    lom_scene *scene = make_scene(THINGS "[output]\nformat = \"rgb32f\"\n[quality]\nwater = \"reference\"\n"
                                         "[quality.reference]\nsamples = 2\ndepth = 3\n[water]\nlevel = 0.2\n");
    if (scene == NULL)
        return;
    lom_frame one = render_with(scene, 4, 1), other = render_with(scene, 16, 3);
    lom_image *traced =
        trace(scene, scene->water.optics.index, (lom_reference_frame){ .samples = 2, .depth = 3, .threads = 2 });
    CHECK(one.image != NULL && other.image != NULL && traced != NULL);
    if (one.image != NULL && other.image != NULL && traced != NULL)
        CHECK(lom_hash_image(one.image) == lom_hash_image(traced) &&
              lom_hash_image(other.image) == lom_hash_image(traced));
    CHECK(one.plan.count == 1 && strcmp(one.plan.step[0].name, "reference") == 0 && one.plan.step[0].runs);
    CHECK(one.counters.passes == 0 && one.counters.draws == 0);
    lom_free_image(one.image);
    lom_free_image(other.image);
    lom_free_image(traced);
    lom_free_scene(scene);
}

static lom_image *render_as(const char *water, const char *format, const char *transfer, lom_rect crop)
{
    char text[3000];
    lom_frame frame = { .image = NULL };
    snprintf(text, sizeof text, THINGS "[output]\nformat = \"%s\"\ntransfer = \"%s\"\n%s[water]\nlevel = 0.2\n", format,
             transfer, water);
    lom_scene *scene = make_scene(text);
    lom_renderer *renderer =
        scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .lanes = 4, .threads = 1 }, NULL) : NULL;
    CHECK(renderer != NULL &&
              lom_render_frame(renderer, &(lom_frame_desc){ .width = WIDTH, .height = HEIGHT, .crop = crop }, &frame,
                               NULL),
          "%s", text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return frame.image;
}

/* IEC 61966-2-1 */
static double encode(double x, bool srgb)
{
    x = x > 0 ? x < 1 ? x : 1 : 0;
    return !srgb ? x : x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

/* 8 and 16 bits are the floats, encoded and rounded once, of the reference's picture and, in 16 bits, of the
 * pipeline's; a crop is the cut-out. */
static void formats_hold_the_same_picture(void)
{
    static const char *const waters[2] = {
        "[quality]\nwater = \"reference\"\n[quality.reference]\nsamples = 1\ndepth = 2\n",
        "[quality]\nwater = \"planar\"\n"
    };
    static const char *const transfers[2] = { "srgb", "naive" };
    const lom_rect all = { 0, 0, 0, 0 }, part = { 37, 20, 30, 21 };
    for (int w = 0; w < 2; w++)
        for (int t = 0; t < 2; t++) {
            lom_image *floats = render_as(waters[w], "rgb32f", transfers[t], all);
            lom_image *deep = render_as(waters[w], "rgb16", transfers[t], all);
            lom_image *bytes = render_as(waters[w], "rgb8", transfers[t], all);
            lom_image *cut = render_as(waters[w], "rgb16", transfers[t], part);
            if (floats == NULL || deep == NULL || bytes == NULL || cut == NULL)
                return;
            CHECK(same_rectangle(deep, cut, part.x, part.y), "water %d, %s: a crop is another picture", w,
                  transfers[t]);
            double most = 0, mean = 0;
            for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
                double value = encode((double)((const float *)(const void *)floats->pixels)[i], t == 0);
                double of_deep = fabs(value * 65535 - ((const uint16_t *)(const void *)deep->pixels)[i]);
                most = of_deep > most ? of_deep : most;
                mean += fabs(value * 255 - bytes->pixels[i]) / (3 * WIDTH * HEIGHT);
            }
            CHECK(most < 0.51, "water %d, %s: 16 bits are off by %g", w, transfers[t], most);
            CHECK(mean < 0.3, "water %d, %s: 8 bits are off by %g on average", w, transfers[t], mean);
            lom_free_image(floats);
            lom_free_image(deep);
            lom_free_image(bytes);
            lom_free_image(cut);
        }
}

/* What the meshes' pictures lack is told by the reference as by the renderer. */
static void warnings_are_the_renderers(void)
{
    lom_scene *scene = make_scene(THINGS "[[entity]]\nmesh = \"bare.obj\"\n");
    lom_reference *reference = scene != NULL ? lom_create_reference(scene, NULL) : NULL;
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, NULL, NULL) : NULL;
    CHECK(reference != NULL && renderer != NULL, "not loaded");
    if (reference != NULL && renderer != NULL) {
        const lom_warnings *warnings = lom_reference_warnings(reference);
        CHECK(warnings->count == 1 && lom_renderer_warning_count(renderer) == 1 &&
                  strcmp(warnings->text, lom_renderer_warning(renderer)) == 0 &&
                  strstr(warnings->text, "absent.png") != NULL,
              "\"%s\", \"%s\"", warnings->text, lom_renderer_warning(renderer));
    }
    lom_free_renderer(renderer);
    lom_free_reference(reference);
    lom_free_scene(scene);
}

/* More samples come closer to many: the mean over a pixel's area is what they are after. */
static void samples_converge(void)
{
    double last = 1e9;
    lom_scene *scene = make_scene(THINGS);
    lom_image *many = scene == NULL ? NULL : trace(scene, 1, (lom_reference_frame){ .samples = 256 });
    for (int samples = 1; many != NULL && samples <= 64; samples *= 8) {
        lom_comparison result = { .rmse = 0 };
        lom_image *few = trace(scene, 1, (lom_reference_frame){ .samples = samples });
        CHECK(few != NULL && lom_compare_images(few, many, &result, NULL));
        CHECK(result.rmse < 0.6 * last && result.rmse > 0, "%g with %d samples", result.rmse, samples);
        last = result.rmse;
        lom_free_image(few);
    }
    CHECK(many != NULL);
    lom_free_image(many);
    lom_free_scene(scene);
}

static void bad_frames_are_refused(void)
{
    lom_scene *scene = make_scene("sky.color = [1, 1, 1]\n");
    lom_reference *reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    const lom_reference_frame bad[] = { { .width = 0, .height = 9, .samples = 1 },
                                        { .width = 9, .height = LOM_MAX_SIZE + 1, .samples = 1 },
                                        { .width = 9, .height = 9, .samples = 0 },
                                        { .width = 9, .height = 9, .samples = 1, .depth = -1 },
                                        { .width = 9, .height = 9, .samples = 1, .time = 1e308 * 10 },
                                        { .width = 9, .height = 9, .samples = 1, .crop = { 5, 5, 5, 5 } } };
    CHECK(reference != NULL);
    for (size_t i = 0; reference != NULL && i < sizeof bad / sizeof *bad; i++) {
        lom_error error = { .code = LOM_OK };
        CHECK(lom_trace_scene(reference, &bad[i], &error) == NULL && error.code == LOM_ERROR_USAGE, "frame %zu", i);
    }
    lom_free_reference(reference);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    if (!write_files()) {
        printf("FAIL files: they cannot be written\n");
        return 1;
    }
    RUN(opaque_scenes_are_the_pipelines);
    RUN(ground_of_many_pictures_is_the_pipelines);
    RUN(shadows_fall_where_the_references_do);
    RUN(the_planar_reflection_is_the_mirrored_scene);
    RUN(threads_and_crops_change_no_byte);
    RUN(the_renderer_shows_it);
    RUN(formats_hold_the_same_picture);
    RUN(warnings_are_the_renderers);
    RUN(samples_converge);
    RUN(bad_frames_are_refused);
    remove_files();
    return check_result();
}
