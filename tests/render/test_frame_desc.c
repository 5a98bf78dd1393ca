/* Proves what a frame may be told beside its number, over every small scene: a camera and a time of the caller's give
 * the bytes of a scene that has them; the caller's memory holds the picture's bytes and nothing is written between its
 * rows; sizes may alternate; a run of impostors goes on by `continues`; a frame that is abandoned at any of its passes
 * leaves the renderer as good as new; what cannot be drawn is refused. */
#include "check.h"
#include "key_bases.h"
#include "small_scene.h"

enum { BASES = sizeof bases / sizeof bases[0], WIDTH = 16, HEIGHT = 9 };

static const lom_device_desc device = { .threads = 2, .tile = 16 };
static char text[8192];

/* A scene of a base, with overrides. */
static lom_scene *read_base(const struct base *base, const char *const *overrides, size_t count)
{
    lom_error error = { .code = LOM_OK };
    snprintf(text, sizeof text, "%s%s", head, base->text);
    lom_scene *scene = NULL;
    if (small_text("base.toml", text, &error))
        scene = lom_read_scene(small_path("base.toml"), overrides, count, &error);
    CHECK(scene != NULL, "%s: %s", base->name, error.text);
    return scene;
}

static uint64_t draw(lom_renderer *renderer, const lom_frame_desc *desc)
{
    lom_error error = { .code = LOM_OK };
    lom_frame frame = { .image = NULL };
    bool drawn = lom_render_frame(renderer, desc, &frame, &error);
    CHECK(drawn, "%s", error.text);
    uint64_t hash = drawn ? lom_hash_image(frame.image) : 0;
    lom_free_image(frame.image);
    return hash;
}

/* The hash of the first frame of a renderer of its own. */
static uint64_t draw_fresh(const lom_scene *scene, const lom_frame_desc *desc)
{
    lom_error error = { .code = LOM_OK };
    lom_renderer *renderer = lom_create_renderer(scene, &device, &error);
    CHECK(renderer != NULL, "%s", error.text);
    uint64_t hash = renderer != NULL ? draw(renderer, desc) : 0;
    lom_free_renderer(renderer);
    return hash;
}

struct watch {
    int left; /* passes that may still begin */
};

static bool count_down(void *context, const char *pass, double done)
{
    struct watch *watch = context;
    (void)pass, (void)done;
    return watch->left-- > 0;
}

/* Abandons the frame after 0, 1, 2 ... passes, each time by the same renderer, and draws it whole after each. */
static void abandon_at_every_pass(const struct base *base)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = read_base(base, NULL, 0);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &device, &error) : NULL;
    CHECK(renderer != NULL, "%s: %s", base->name, error.text);
    const lom_frame_desc whole = { .frame = 2 };
    uint64_t expected = scene != NULL ? draw_fresh(scene, &whole) : 0;
    bool drawn = false;
    for (int passes = 0; renderer != NULL && !drawn && passes < LOM_MAX_STEPS; passes++) {
        struct watch watch = { passes };
        lom_frame frame = { .image = NULL };
        error.code = LOM_OK;
        drawn = lom_render_frame(renderer,
                                 &(lom_frame_desc){ .frame = 1, .progress = count_down, .progress_context = &watch },
                                 &frame, &error);
        CHECK(drawn ? frame.image != NULL : frame.image == NULL && error.code == LOM_ERROR_ABANDONED, "%s: %s",
              base->name, error.text);
        lom_free_image(frame.image);
        if (!drawn)
            CHECK(draw(renderer, &whole) == expected, "%s: another picture after a frame that was abandoned at pass %d",
                  base->name, passes);
    }
    CHECK(drawn, "%s: never drawn", base->name);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void an_abandoned_frame_leaves_nothing(void)
{
    for (int i = 0; i < BASES; i++)
        abandon_at_every_pass(&bases[i]);
}

static void a_camera_is_that_of_a_scene(void)
{
    static const char *const moved[] = {
        "camera.key=[]",           "camera.position=[2, 5, 9]", "camera.target=[0, 1.5, 0]",
        "camera.field_of_view=40", "camera.near=0.2",           "camera.projection=perspective"
    };
    const lom_camera_view camera = { .position = { 2, 5, 9 },
                                     .target = { 0, 1.5, 0 },
                                     .up = { 0, 1, 0 },
                                     .field_of_view = 40 * 0.017453292519943295,
                                     .near_plane = 0.2 };
    for (int i = 0; i < BASES; i++) {
        bool turned = strstr(bases[i].text, "yaw = 20") != NULL; /* angles in the place of a target */
        lom_scene *scene = turned ? NULL : read_base(&bases[i], NULL, 0), *other = NULL;
        if (scene == NULL)
            continue;
        other = read_base(&bases[i], moved, 6);
        uint64_t expected = other != NULL ? draw_fresh(other, NULL) : 0;
        CHECK(draw_fresh(scene, &(lom_frame_desc){ .camera = &camera }) == expected, "%s", bases[i].name);
        lom_free_scene(scene);
        lom_free_scene(other);
    }
}

static void a_time_is_that_of_a_frame(void)
{
    for (int i = 0; i < BASES; i++) {
        lom_scene *scene = read_base(&bases[i], NULL, 0);
        if (scene == NULL)
            continue;
        double fps = scene->output.fps;
        CHECK(draw_fresh(scene, &(lom_frame_desc){ .has_time = true, .time = 3 / fps }) ==
                  draw_fresh(scene, &(lom_frame_desc){ .frame = 3 }),
              "%s", bases[i].name);
        lom_free_scene(scene);
    }
}

static void a_run_goes_on_when_it_says_so(void)
{
    for (int i = 0; i < BASES; i++) {
        lom_error error = { .code = LOM_OK };
        lom_scene *scene = strstr(bases[i].name, "impostors") != NULL ? read_base(&bases[i], NULL, 0) : NULL;
        if (scene == NULL)
            continue;
        lom_renderer *numbered = lom_create_renderer(scene, &device, &error);
        lom_renderer *timed = lom_create_renderer(scene, &device, &error);
        for (int frame = 0; frame < 4; frame++) {
            lom_camera_view camera = lom_scene_camera_at(scene, 0);
            camera.position.x += 0.3 * frame;
            CHECK(draw(numbered, &(lom_frame_desc){ .frame = frame, .camera = &camera }) ==
                      draw(timed, &(lom_frame_desc){ .frame = 7,
                                                     .has_time = true,
                                                     .time = frame / scene->output.fps,
                                                     .continues = true,
                                                     .camera = &camera }),
                  "%s: frame %d", bases[i].name, frame);
        }
        lom_free_renderer(numbered);
        lom_free_renderer(timed);
        lom_free_scene(scene);
    }
}

static void sizes_may_alternate(void)
{
    static const int sizes[][2] = { { 16, 9 }, { 23, 11 }, { 16, 9 }, { 23, 11 }, { 8, 8 }, { 16, 9 } };
    for (int i = 0; i < BASES; i++) {
        lom_error error = { .code = LOM_OK };
        lom_scene *scene = read_base(&bases[i], NULL, 0);
        lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &device, &error) : NULL;
        for (int k = 0; renderer != NULL && k < 6; k++) {
            lom_frame_desc desc = { .width = sizes[k][0], .height = sizes[k][1] };
            CHECK(draw(renderer, &desc) == draw_fresh(scene, &desc), "%s at %dx%d", bases[i].name, desc.width,
                  desc.height);
        }
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

/* Compares the caller's memory with the picture, sample by sample; what lies behind a row must still be 0xa5. */
static void check_pixels(const char *name, const lom_image *picture, const uint8_t *pixels, size_t pitch,
                         lom_pixel_order order)
{
    size_t row = (size_t)picture->width * lom_format_size(picture->format);
    size_t used = order == LOM_ORDER_OUTPUT ? row : 4 * (size_t)picture->width;
    for (int y = 0; y < picture->height; y++) {
        const uint8_t *at = pixels + (size_t)y * pitch, *from = lom_image_pixel(picture, 0, y, 0);
        bool equal = true;
        for (int x = 0; order != LOM_ORDER_OUTPUT && x < picture->width; x++)
            for (int c = 0; c < 4; c++) {
                int sample = order == LOM_ORDER_BGRX ? 2 - c : c;
                equal = equal && at[4 * x + c] == (c == 3 ? 255 : from[3 * x + sample]);
            }
        if (order == LOM_ORDER_OUTPUT)
            equal = memcmp(at, from, row) == 0;
        CHECK(equal, "%s: row %d differs", name, y);
        for (size_t i = used; i < pitch; i++)
            CHECK(at[i] == 0xa5, "%s: byte %zu behind row %d was written", name, i, y);
    }
}

static void pixels_are_the_pictures(void)
{
    static const char *const formats[] = { "output.format=\"rgb8\"", "output.format=\"rgb16\"",
                                           "output.format=\"rgb32f\"" };
    static uint8_t pixels[HEIGHT * 256];
    for (int i = 0; i < BASES; i++)
        for (int format = 0; format < 3; format++)
            for (int order = 0; order < (format == 0 ? 3 : 1); order++) {
                lom_error error = { .code = LOM_OK };
                lom_frame frame = { .image = NULL }, placed = { .image = NULL };
                lom_scene *scene = read_base(&bases[i], &formats[format], 1);
                lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &device, &error) : NULL;
                lom_frame_desc desc = { .pixels = pixels, .pitch = 250, .order = (lom_pixel_order)order };
                memset(pixels, 0xa5, sizeof pixels);
                CHECK(renderer != NULL && lom_render_frame(renderer, NULL, &frame, &error) &&
                          lom_render_frame(renderer, &desc, &placed, &error) && placed.image == NULL,
                      "%s: %s", bases[i].name, error.text);
                if (frame.image != NULL)
                    check_pixels(bases[i].name, frame.image, pixels, desc.pitch, desc.order);
                lom_free_image(frame.image);
                lom_free_renderer(renderer);
                lom_free_scene(scene);
            }
}

static void what_cannot_be_drawn_is_refused(void)
{
    static uint8_t pixels[64];
    const lom_camera_view good = {
        .position = { 0, 3, 12 }, .target = { 0, 1, 0 }, .up = { 0, 1, 0 }, .field_of_view = 1, .near_plane = 0.1
    };
    lom_camera_view wrong[5];
    for (int i = 0; i < 5; i++)
        wrong[i] = good;
    wrong[0].target = wrong[0].position;
    wrong[1].up = (lom_vec3){ 0, 2, 12 - 1 };
    wrong[1].position = (lom_vec3){ 0, 0, 0 };
    wrong[1].target = wrong[1].up;
    wrong[2].near_plane = 0;
    wrong[3].field_of_view = 4;
    wrong[4].position.y = __builtin_nan("");
    const lom_frame_desc refused[] = { { .camera = &wrong[0] },
                                       { .camera = &wrong[1] },
                                       { .camera = &wrong[2] },
                                       { .camera = &wrong[3] },
                                       { .camera = &wrong[4] },
                                       { .has_time = true, .time = 2e9 },
                                       { .has_time = true, .time = __builtin_nan("") },
                                       { .pixels = pixels, .pitch = 3 },
                                       { .pixels = pixels, .pitch = 4096, .order = LOM_ORDER_RGBX } };
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = read_base(&bases[0], NULL, 0);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, &device, &error) : NULL;
    for (size_t i = 0; renderer != NULL && i < sizeof refused / sizeof refused[0]; i++) {
        lom_frame frame = { .image = NULL };
        lom_error why = { .code = LOM_OK };
        CHECK(!lom_render_frame(renderer, &refused[i], &frame, &why) && frame.image == NULL &&
                  (why.code == LOM_ERROR_USAGE || why.code == LOM_ERROR_LIMIT) && why.text[0] != 0,
              "%zu: %s", i, why.text);
    }
    CHECK(renderer != NULL && draw(renderer, &(lom_frame_desc){ .camera = &good }) != 0, "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(a_camera_is_that_of_a_scene);
    RUN(a_time_is_that_of_a_frame);
    RUN(a_run_goes_on_when_it_says_so);
    RUN(sizes_may_alternate);
    RUN(pixels_are_the_pictures);
    RUN(an_abandoned_frame_leaves_nothing);
    RUN(what_cannot_be_drawn_is_refused);
    remove_small_scene();
    return check_result();
}
