/* Proves that one picture of several cameras holds each of them as it is drawn alone, bit for bit: the picture of
 * [camera] outside, every view in its rectangle, the later over the earlier one, mirrored ones turned around; in all
 * formats and orders of the caller's memory, in crops, at other widths and numbers of threads; that a view alone is
 * the scene with its camera; that the plan tells whose step is whose; that what is told of a frame on its way never
 * falls; that the targets of all sizes are kept; that what cannot be drawn is refused. */
#include "check.h"
#include "small_scene.h"

#include <lom/lom.h>

enum { WIDTH = 46, HEIGHT = 31 };

static const char views[] =
    "[output]\nwidth = 46\nheight = 31\nformat = \"%s\"\n"
    "[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n[light]\nazimuth = 20\nelevation = 25\n"
    "[sky]\npattern = \"sky_%%s.png\"\n"
    "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"color.png\"\ntile = 5\n"
    "[water]\nlevel = 0\nnormal_map = \"normal.png\"\n"
    "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n[[entity.key]]\ntime = 0\n[[entity.key]]\n"
    "time = 1\nposition = [3, 1, 2]\n[quality]\nwater = \"planar\"\nentity_shadows = 64\n"
    "[[view]]\nname = \"map\"\nrectangle = [0.6, 0.1, 0.4, 0.5]\n[view.camera]\nprojection = \"orthographic\"\n"
    "position = [0, 20, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\nheight = 18\nfar = 60\n"
    "[[view]]\nname = \"hidden\"\nvisible = false\nrectangle = [0, 0, 1, 1]\n"
    "[[view]]\nname = \"back\"\nrectangle = [0.3, 0.4, 0.5, 0.3]\nmirrored = true\n[view.camera]\nfollow = \"box\"\n"
    "position = [0, 3, -4]\ntarget = [0, 1, 6]\n[[view.camera.key]]\ntime = 0\n[[view.camera.key]]\ntime = 1\n"
    "position = [2, 4, -4]\n";

static const char *const formats[] = { "rgb8", "rgb16", "rgb32f" };

static lom_scene *read_views(const char *format, const char *const *overrides, size_t count)
{
    char text[3000];
    lom_error error = { .code = LOM_OK };
    snprintf(text, sizeof text, views, format);
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

static const lom_device_desc one = { .threads = 1, .lanes = 4 };

static void paste(lom_image *onto, const lom_image *part, lom_rect at)
{
    const size_t pixel = lom_format_size(onto->format);
    CHECK(part->width == at.width && part->height == at.height && part->format == onto->format);
    for (int y = 0; y < at.height; y++)
        memcpy(lom_image_pixel(onto, at.x, at.y + y, 0), lom_image_pixel(part, 0, y, 0), pixel * (size_t)at.width);
}

/* The picture put together by hand. */
static lom_image *put_together(const lom_scene *scene, int frame)
{
    lom_image *whole = draw(scene, &one, &(lom_frame_desc){ .frame = frame, .view = LOM_MAIN_VIEW });
    for (size_t i = 0; whole != NULL && i < scene->view_count; i++) {
        if (!scene->views[i].visible)
            continue;
        lom_image *part = draw(scene, &one, &(lom_frame_desc){ .frame = frame, .view = scene->views[i].name });
        if (part != NULL)
            paste(whole, part, lom_view_rectangle(&scene->views[i], WIDTH, HEIGHT));
        lom_free_image(part);
    }
    return whole;
}

static bool are_same(const lom_image *a, const lom_image *b)
{
    return a != NULL && b != NULL && a->format == b->format && lom_image_size(a) == lom_image_size(b) &&
           memcmp(a->pixels, b->pixels, lom_image_size(a)) == 0;
}

static void a_picture_is_its_views(void)
{
    for (int i = 0; i < 3; i++)
        for (int frame = 0; frame < 20; frame += 13) {
            lom_scene *scene = read_views(formats[i], NULL, 0);
            lom_image *expected = put_together(scene, frame);
            lom_image *got = draw(scene, &(lom_device_desc){ .threads = 3, .lanes = 8, .tile = 16 },
                                  &(lom_frame_desc){ .frame = frame });
            CHECK(are_same(expected, got), "%s, frame %d", formats[i], frame);
            lom_free_image(expected);
            lom_free_image(got);
            lom_free_scene(scene);
        }
}

/* Its camera is written in the place of the scene's; what is mirrored is turned around. */
static void a_view_alone_is_the_scene_with_its_camera(void)
{
    static const char *const map[] = {
        "camera.projection=orthographic", "camera.position=[0, 20, 0]", "camera.target=[0, 0, 0]",
        "camera.up=[0, 0, -1]",           "camera.height=18",           "camera.far=60"
    };
    static const char *const back[] = { "camera.follow=box",    "camera.position=[0, 3, -4]", "camera.target=[0, 1, 6]",
                                        "view.0.visible=false", "view.2.visible=false",       "camera.near=0.1" };
    for (int i = 0; i < 2; i++) {
        lom_scene *scene = read_views("rgb8", NULL, 0), *other = read_views("rgb8", i == 0 ? map : back, 6);
        if (scene == NULL || other == NULL)
            return;
        const lom_rect r = lom_view_rectangle(&scene->views[2 * i], WIDTH, HEIGHT);
        lom_image *view = draw(scene, &one, &(lom_frame_desc){ .view = scene->views[2 * i].name });
        lom_image *alone =
            draw(other, &one, &(lom_frame_desc){ .width = r.width, .height = r.height, .view = LOM_MAIN_VIEW });
        int wrong = 0;
        for (int y = 0; view != NULL && alone != NULL && y < r.height; y++)
            for (int x = 0; x < r.width; x++)
                wrong += memcmp(lom_image_pixel(view, x, y, 0),
                                lom_image_pixel(alone, i == 0 ? x : r.width - 1 - x, y, 0), 3) != 0;
        CHECK(wrong == 0 && view != NULL && view->width == r.width, "view %d: %d pixels", i, wrong);
        lom_free_image(view);
        lom_free_image(alone);
        lom_free_scene(scene);
        lom_free_scene(other);
    }
}

static void a_crop_is_the_cut_out(void)
{
    static const lom_rect crops[] = {
        { 0, 0, 46, 31 }, { 0, 0, 9, 9 }, { 20, 8, 20, 14 }, { 30, 13, 1, 1 }, { 13, 12, 5, 3 }
    };
    lom_scene *scene = read_views("rgb16", NULL, 0);
    lom_image *whole = draw(scene, &one, NULL);
    for (int i = 0; i < 5; i++) {
        lom_image *part = draw(scene, &one, &(lom_frame_desc){ .crop = crops[i] });
        for (int y = 0; part != NULL && y < crops[i].height; y++)
            CHECK(memcmp(lom_image_pixel(part, 0, y, 0), lom_image_pixel(whole, crops[i].x, crops[i].y + y, 0),
                         6 * (size_t)crops[i].width) == 0,
                  "crop %d, row %d", i, y);
        lom_free_image(part);
    }
    lom_image *back = draw(scene, &one, &(lom_frame_desc){ .view = "back" });
    lom_image *part = draw(scene, &one, &(lom_frame_desc){ .view = "back", .crop = { 2, 1, 5, 4 } });
    for (int y = 0; back != NULL && part != NULL && y < 4; y++)
        CHECK(memcmp(lom_image_pixel(part, 0, y, 0), lom_image_pixel(back, 2, 1 + y, 0), 30) == 0, "row %d", y);
    lom_free_image(back);
    lom_free_image(part);
    lom_free_image(whole);
    lom_free_scene(scene);
}

static void it_is_the_same_in_the_callers_memory(void)
{
    enum { PITCH = WIDTH * 4 + 12 };
    static uint8_t pixels[PITCH * HEIGHT];
    lom_scene *scene = read_views("rgb8", NULL, 0);
    lom_image *image = draw(scene, &one, NULL);
    lom_renderer *renderer = lom_create_renderer(scene, &one, NULL);
    for (int order = LOM_ORDER_OUTPUT; order <= LOM_ORDER_BGRX; order++) {
        lom_frame frame;
        memset(pixels, 7, sizeof pixels);
        const int step = order == LOM_ORDER_OUTPUT ? 3 : 4, red = order == LOM_ORDER_BGRX ? 2 : 0;
        CHECK(lom_render_frame(renderer,
                               &(lom_frame_desc){ .pixels = pixels, .pitch = PITCH, .order = (lom_pixel_order)order },
                               &frame, NULL));
        int wrong = 0;
        for (int y = 0; image != NULL && y < HEIGHT; y++) {
            for (int x = 0; x < WIDTH; x++) {
                const uint8_t *p = pixels + y * PITCH + x * step, *q = lom_image_pixel(image, x, y, 0);
                wrong += p[red] != q[0] || p[1] != q[1] || p[2 - red] != q[2];
            }
            for (int i = WIDTH * step; i < PITCH; i++)
                wrong += pixels[y * PITCH + i] != 7;
        }
        CHECK(wrong == 0, "order %d: %d", order, wrong);
    }
    lom_free_renderer(renderer);
    lom_free_image(image);
    lom_free_scene(scene);
}

struct told {
    double least, last;
    int falls;
};

static bool listen(void *context, const char *pass, double done)
{
    struct told *told = context;
    (void)pass;
    told->falls += done < told->last || done > 1;
    told->last = done;
    return true;
}

static void the_plan_and_the_progress_tell_of_all(void)
{
    lom_scene *scene = read_views("rgb8", NULL, 0);
    lom_renderer *renderer = lom_create_renderer(scene, &one, NULL);
    struct told told = { .falls = 0 };
    lom_frame frame = { .image = NULL };
    CHECK(lom_render_frame(renderer, &(lom_frame_desc){ .progress = listen, .progress_context = &told }, &frame, NULL));
    int steps[4] = { 0 }, falls = 0, before = 0;
    for (int i = 0; i < frame.plan.count; i++) {
        const int view = frame.plan.step[i].view;
        falls += view < before;
        before = view;
        if (view < 4)
            steps[view]++;
    }
    CHECK(steps[0] > 3 && steps[1] > 3 && steps[2] == 0 && steps[3] > 3 && falls == 0, "%d %d %d %d", steps[0],
          steps[1], steps[2], steps[3]);
    CHECK(told.falls == 0 && told.last > 0.9, "%d falls, at last %g", told.falls, told.last);
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void a_view_that_is_off_costs_nothing(void)
{
    static const char *const off[] = { "view.0.visible=false", "view.2.visible=false" };
    lom_scene *scene = read_views("rgb8", off, 2), *without = read_views("rgb8", (const char *[]){ "view=[]" }, 1);
    lom_frame a = { .image = NULL }, b = { .image = NULL };
    lom_renderer *r = lom_create_renderer(scene, &one, NULL), *q = lom_create_renderer(without, &one, NULL);
    CHECK(lom_render_frame(r, NULL, &a, NULL) && lom_render_frame(q, NULL, &b, NULL));
    CHECK(are_same(a.image, b.image) && memcmp(&a.counters, &b.counters, sizeof a.counters) == 0);
    lom_free_image(a.image);
    lom_free_image(b.image);
    lom_free_renderer(r);
    lom_free_renderer(q);
    lom_free_scene(scene);
    lom_free_scene(without);
}

static void pixels_know_their_view(void)
{
    lom_scene *scene = read_views("rgb8", NULL, 0);
    const lom_rect map = lom_view_rectangle(&scene->views[0], WIDTH, HEIGHT);
    const lom_rect back = lom_view_rectangle(&scene->views[2], WIDTH, HEIGHT);
    CHECK(map.x == 28 && map.y == 3 && map.width == 18 && map.height == 16, "%d %d %d %d", map.x, map.y, map.width,
          map.height);
    CHECK(lom_view_at(scene, WIDTH, HEIGHT, 27, 3) == NULL && lom_view_at(scene, WIDTH, HEIGHT, 45, 3) == scene->views);
    CHECK(lom_view_at(scene, WIDTH, HEIGHT, back.x + back.width - 1, back.y) == &scene->views[2], "the later one");
    lom_renderer *renderer = lom_create_renderer(scene, &one, NULL);
    const lom_explain_desc desc = { .x = 40, .y = 5 };
    lom_explanation *x = lom_explain(renderer, &desc, NULL);
    CHECK(x != NULL && x->view != NULL && strcmp(x->view, "map") == 0 && x->item[0].x == 12 && x->item[0].y == 2);
    lom_image *whole = draw(scene, &one, NULL);
    CHECK(x != NULL && whole != NULL && memcmp(x->frame.image->pixels, lom_image_pixel(whole, 40, 5, 0), 3) == 0);
    lom_free_explanation(renderer, x);
    const lom_explain_desc mirrored = { .x = back.x + 2, .y = back.y + 4 };
    x = lom_explain(renderer, &mirrored, NULL);
    CHECK(x != NULL && whole != NULL &&
          memcmp(x->frame.image->pixels, lom_image_pixel(whole, mirrored.x, mirrored.y, 0), 3) == 0);
    lom_free_explanation(renderer, x);
    lom_free_image(whole);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

/* A run of pictures with views allocates for its first one alone: the same textures serve the next ones. */
static void a_run_has_the_bytes_of_frames_alone(void)
{
    lom_scene *scene = read_views("rgb8", NULL, 0);
    lom_renderer *renderer = lom_create_renderer(scene, &one, NULL);
    for (int i = 0; i < 4; i++) {
        lom_frame frame = { .image = NULL };
        CHECK(lom_render_frame(renderer, &(lom_frame_desc){ .frame = 5 * i }, &frame, NULL));
        lom_image *alone = draw(scene, &one, &(lom_frame_desc){ .frame = 5 * i });
        CHECK(are_same(frame.image, alone), "frame %d", 5 * i);
        lom_free_image(alone);
        lom_free_image(frame.image);
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void what_cannot_be_is_refused(void)
{
    static const struct {
        const char *views, *says;
    } cases[] = { { "[[view]]\nrectangle = [0, 0, 1, 1]\n", "name" },
                  { "[[view]]\nname = 'a'\n", "rectangle" },
                  { "[[view]]\nname = 'main'\nrectangle = [0, 0, 1, 1]\n", "main" },
                  { "[[view]]\nname = ''\nrectangle = [0, 0, 1, 1]\n", "name" },
                  { "[[view]]\nname = 'a'\nrectangle = [0.5, 0, 0.6, 1]\n", "within the picture" },
                  { "[[view]]\nname = 'a'\nrectangle = [0, 0, 0, 1]\n", "within the picture" },
                  { "[[view]]\nname = 'a'\nrectangle = [0, -0.1, 1, 1]\n", "rectangle" },
                  { "[[view]]\nname = 'a'\nrectangle = [0, 0, 1, 1]\n[[view]]\nname = 'a'\nrectangle = [0, 0, 1, 1]\n",
                    "another view" },
                  { "[[view]]\nname = 'a'\nrectangle = [0, 0, 1, 1]\ncamera.follow = 'nobody'\n", "no entity" },
                  { "[[view]]\nname = 'a'\nrectangle = [0, 0, 1, 1]\ncamera.person = 'first'\n", "first person" },
                  { "[[view]]\nname = 'a'\nrectangle = [0, 0, 1, 1]\ncamera.far = 1e9\n", "far" } };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lom_error error = { .code = LOM_OK };
        lom_scene *scene = lom_decode_scene(cases[i].views, strlen(cases[i].views), "a.toml", NULL, 0, &error);
        CHECK(scene == NULL && strstr(error.text, cases[i].says) != NULL, "%s: %s", cases[i].views, error.text);
        lom_free_scene(scene);
    }
    char many[1200] = "";
    for (int i = 0; i < 9; i++)
        snprintf(many + strlen(many), sizeof many - strlen(many), "[[view]]\nname = '%d'\nrectangle = [0, 0, 1, 1]\n",
                 i);
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_decode_scene(many, strlen(many), "a.toml", NULL, 0, &error);
    CHECK(scene == NULL && strstr(error.text, "8 views") != NULL, "%s", error.text);
    scene = read_views("rgb8", NULL, 0);
    error = (lom_error){ .code = LOM_OK };
    CHECK(!lom_check_frame(scene, &(lom_frame_desc){ .view = "nobody" }, &error) &&
              strstr(error.text, "nobody") != NULL,
          "%s", error.text);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(a_picture_is_its_views);
    RUN(a_view_alone_is_the_scene_with_its_camera);
    RUN(a_crop_is_the_cut_out);
    RUN(it_is_the_same_in_the_callers_memory);
    RUN(the_plan_and_the_progress_tell_of_all);
    RUN(a_view_that_is_off_costs_nothing);
    RUN(pixels_know_their_view);
    RUN(a_run_has_the_bytes_of_frames_alone);
    RUN(what_cannot_be_is_refused);
    remove_small_scene();
    return check_result();
}
