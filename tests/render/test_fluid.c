/* Proves of liquids in frames: light behind a filled basin is dimmed by the length of its ray through it, and
 * mirrored by Fresnel's share; a frame alone is the frame of a run, forwards and back; a crop is cut out of the
 * whole; threads, lanes and several samples change no byte; what is out of view is not stepped; and bad input has a
 * sentence. */
#include "check.h"
#include "small_scene.h"

static const char head[] = "[output]\nwidth = 64\nheight = 48\nformat = 'rgb32f'\n"
                           "[light]\nintensity = 0\nambient = [1, 1, 1]\n[sky]\ncolor = [1, 0.5, 0.25]\n";

static lom_scene *read_scene(const char *tables)
{
    char text[3000];
    lom_error error = { 0 };
    snprintf(text, sizeof text, "%s%s", head, tables);
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("fluid.toml"), NULL, 0, &error);
    CHECK(scene != NULL, "%s", error.text);
    return scene;
}

static lom_renderer *make_renderer(const lom_scene *scene, int threads, int lanes)
{
    lom_error error = { 0 };
    lom_renderer *renderer =
        lom_create_renderer(scene, &(lom_device_desc){ .threads = threads, .lanes = lanes }, &error);
    CHECK(renderer != NULL, "%s", error.text);
    return renderer;
}

static lom_frame draw(lom_renderer *renderer, const lom_frame_desc *desc)
{
    lom_error error = { 0 };
    lom_frame frame = { .image = NULL };
    lom_render_frame(renderer, desc, &frame, &error);
    CHECK(frame.image != NULL, "%s", error.text);
    return frame;
}

static bool is_near(double a, double b, double bound)
{
    return a - b < bound && b - a < bound;
}

/* ---- light ---- */

/* A basin of 2 m, full, its top 8 m below the eye, which looks down: the ray in the picture's middle runs 2 m through
 * it but for its slant. The sky behind it and mirrored in it is the same. */
static void light_is_dimmed_by_the_length_of_its_way(void)
{
    static const double absorption[3] = { 0.25, 0.5, 1 }, sky[3] = { 1, 0.5, 0.25 };
    static const struct {
        const char *index;
        double share;
    } rows[] = { { "1", 0 }, { "1.333", 0.0203729 } };
    for (size_t row = 0; row < 2; row++) {
        char text[1000];
        snprintf(
            text, sizeof text,
            "[camera]\nposition = [0, 10, 0.5]\ntarget = [0, 2, 0]\nfield_of_view = 20\n[[fluid]]\nlow = [-1, 0, -1]\n"
            "high = [1, 2, 1]\nspacing = 0.1\nabsorption = [0.25, 0.5, 1]\ncolor = [0, 0, 0]\nhighlight = 0\n"
            "index = %s\n"
            "[[fluid.block]]\nlow = [-1, 0, -1]\nhigh = [1, 2, 1]\n",
            rows[row].index);
        lom_scene *scene = read_scene(text);
        lom_renderer *renderer = make_renderer(scene, 1, 4);
        lom_frame frame = draw(renderer, &(lom_frame_desc){ .frame = 0 });
        const float *pixel = lom_image_pixel(frame.image, 32, 24, 0);
        for (int i = 0; i < 3; i++) {
            const double exact =
                sky[i] * (rows[row].share + (1 - rows[row].share) * lom_double_exp(-2 * absorption[i]));
            CHECK(is_near((double)pixel[i], exact, 0.003), "index %s, channel %d: %g, not %g", rows[row].index, i,
                  (double)pixel[i], exact);
        }
        lom_free_image(frame.image);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

/* ---- the same bytes ---- */

#define CAMERA "[camera]\nposition = [1, 3, 6]\ntarget = [0, 0.6, 0]\n"
#define DAM                                                                                                            \
    "[[fluid]]\nname = 'dam'\nlow = [-2, 0, -1]\nhigh = [2, 2, 1]\nspacing = 0.1\n"                                    \
    "[[fluid.block]]\nlow = [-2, 0, -1]\nhigh = [-0.8, 1.6, 1]\n"                                                      \
    "[[entity]]\nmesh = 'box.obj'\nposition = [0.6, 0, 0]\nscale = 0.5\n"

static uint64_t hash_frame(lom_renderer *renderer, int number, uint64_t *steps)
{
    lom_frame frame = draw(renderer, &(lom_frame_desc){ .frame = number });
    const uint64_t hash = frame.image != NULL ? lom_hash_image(frame.image) : 0;
    *steps = frame.fluid_steps;
    lom_free_image(frame.image);
    return hash;
}

static void a_frame_alone_is_the_frame_of_a_run(void)
{
    lom_scene *scene = read_scene(CAMERA DAM);
    lom_renderer *run = make_renderer(scene, 1, 4), *alone = make_renderer(scene, 3, 8);
    uint64_t hash[12] = { 0 }, steps, all = 0;
    for (int i = 0; i < 12; i++) {
        hash[i] = hash_frame(run, i, &steps);
        all += steps;
    }
    CHECK(hash[0] != hash[11]);
    CHECK(hash_frame(alone, 11, &steps) == hash[11] && steps == all, "%d steps alone, %d in a run", (int)steps,
          (int)all);
    CHECK(hash_frame(alone, 11, &steps) == hash[11] && steps == 0, "%d steps again", (int)steps);
    CHECK(hash_frame(alone, 4, &steps) == hash[4] && steps > 0, "back: %d steps", (int)steps);
    lom_free_renderer(run);
    lom_free_renderer(alone);
    lom_free_scene(scene);
}

static void check_crops(const char *output)
{
    char text[3000];
    lom_error error = { 0 };
    snprintf(text, sizeof text, "%s%s", head, CAMERA DAM);
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("fluid.toml"), &output, 1, &error);
    CHECK(scene != NULL, "%s", error.text);
    lom_renderer *renderer = make_renderer(scene, 2, 8);
    lom_frame whole = draw(renderer, &(lom_frame_desc){ .frame = 8 });
    static const lom_rect parts[] = { { 0, 0, 20, 17 }, { 13, 20, 31, 11 }, { 40, 24, 24, 24 } };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        const lom_rect *r = &parts[i];
        lom_frame part = draw(renderer, &(lom_frame_desc){ .frame = 8, .crop = *r });
        bool same = true;
        for (int y = 0; y < r->height; y++)
            same = same && memcmp(lom_image_pixel(part.image, 0, y, 0), lom_image_pixel(whole.image, r->x, r->y + y, 0),
                                  (size_t)r->width * 12) == 0;
        CHECK(same, "%s, part %d", output, (int)i);
        lom_free_image(part.image);
    }
    lom_free_image(whole.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void a_crop_is_cut_out_of_the_whole(void)
{
    check_crops("output.samples=1");
    check_crops("output.samples=4");
    check_crops("output.edges='smooth'");
}

static void what_is_out_of_view_is_not_stepped(void)
{
    lom_scene *scene = read_scene("[camera]\nposition = [0, 1, 9]\ntarget = [0, 1, 20]\n" DAM);
    lom_renderer *renderer = make_renderer(scene, 1, 4);
    lom_frame frame = draw(renderer, &(lom_frame_desc){ .frame = 20 });
    CHECK(frame.fluid_steps == 0, "%d steps", (int)frame.fluid_steps);
    bool told = false;
    for (int i = 0; i < frame.plan.count; i++)
        told = told || (strcmp(frame.plan.step[i].name, "fluid") == 0 && !frame.plan.step[i].runs);
    CHECK(told);
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

/* ---- what is refused ---- */

static void bad_input_has_a_sentence(void)
{
    static const struct {
        const char *tables, *sentence;
    } rows[] = {
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\n", "a liquid has at least one block." },
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [1, 0, 1]\nblock = [{ low = [0, 0, 0], high = [1, 1, 1] }]\n",
          "each number of \"high\" is above that of \"low\"." },
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nblock = [{ low = [0, 2, 0], high = [1, 1, 1] }]\n",
          "each number of \"high\" is above that of \"low\"." },
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nmelting = [5, 4]\n"
          "block = [{ low = [0, 0, 0], high = [1, 1, 1] }]\n",
          "it begins at the lower one of its temperatures." },
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nspacing = 0.0001\n"
          "block = [{ low = [0, 0, 0], high = [1, 1, 1] }]\n",
          "The basin of a fluid is 5000 cells" },
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [4, 4, 4]\nspacing = 0.02\n"
          "block = [{ low = [0, 0, 0], high = [4, 4, 4] }]\n",
          "8000000 particles" },
        { "[[fluid]]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nblock = [{ low = [3, 3, 3], high = [4, 4, 4] }]\n",
          "0 particles" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[2000];
        lom_error error = { 0 };
        snprintf(text, sizeof text, "%s%s", head, rows[i].tables);
        lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("fluid.toml"), NULL, 0, &error);
        lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, NULL, &error) : NULL;
        CHECK(renderer == NULL && strstr(error.text, rows[i].sentence) != NULL, "row %d: %s", (int)i, error.text);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(light_is_dimmed_by_the_length_of_its_way);
    RUN(a_frame_alone_is_the_frame_of_a_run);
    RUN(a_crop_is_cut_out_of_the_whole);
    RUN(what_is_out_of_view_is_not_stepped);
    RUN(bad_input_has_a_sentence);
    remove_small_scene();
    return check_result();
}
