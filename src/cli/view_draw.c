/* Drawing what is seen. In: a view. Out: its picture. Invariant: a picture that is at rest has the bytes of `lom render`;
 * while something moves it may be smaller, and what is abandoned leaves the picture before. */
#include "explain_output.h"
#include "paths.h"
#include "view.h"

#include "base/numbers.h"

#include <stdlib.h>
#include <string.h>

static const double aim = 40;     /* milliseconds a picture may take while something moves, before it is made smaller */
static const double scale = 1000; /* times are whole milliseconds, so that `lom render --fps 1000` has them */

static double now(const struct lom_view *view)
{
    return view->host.milliseconds != NULL ? view->host.milliseconds(view->host.context) : 0;
}

/* ---- the frame ---- */

static int whole_time(const struct lom_view *view)
{
    return lom_int_of(view->time * scale + 0.5);
}

lom_frame_desc lom_view_frame(const struct lom_view *view, int divisor, lom_camera_view *camera)
{
    lom_frame_desc desc = { .width = (view->width + divisor - 1) / divisor,
                            .height = (view->height + divisor - 1) / divisor,
                            .has_time = true,
                            .time = (double)whole_time(view) / scale,
                            .memory = view->options.memory.value };
    if (view->eye.kind != LOM_EYE_SCENE) {
        *camera = lom_eye_view(&view->eye, view->scene, desc.time);
        desc.camera = camera;
    }
    return desc;
}

/* A word as a shell takes it. */
static void print_word(FILE *out, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:=@%";
    if (word[0] != '\0' && strspn(word, plain) == strlen(word)) {
        fprintf(out, " %s", word);
        return;
    }
    fputs(" '", out);
    for (; *word != '\0'; word++)
        fputs(*word == '\'' ? "'\\''" : (char[2]){ *word, '\0' }, out);
    fputs("'", out);
}

static void add_setting(FILE *out, const char *setting)
{
    fputs(" --set", out);
    print_word(out, setting);
}

char *lom_view_command(const struct lom_view *view, lom_error *error)
{
    char *text = NULL, *copy = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (out == NULL) {
        lom_fail(error, LOM_ERROR_MEMORY, "There is no memory for a command.");
        return NULL;
    }
    fputs("lom render", out);
    print_word(out, view->path);
    fprintf(out, " --size %dx%d", view->width, view->height);
    lom_option_list set = view->options.set;
    lom_list_settings(&view->settings, &set);
    for (int i = 0; i < set.count; i++)
        if (strncmp(set.items[i], "camera=", 7) != 0 || view->eye.kind == LOM_EYE_SCENE)
            add_setting(out, set.items[i]);
    if (view->eye.kind != LOM_EYE_SCENE) {
        char eye[LOM_MAX_SETTING], value[LOM_MAX_SETTING + 8];
        const size_t followed = view->eye.followed;
        lom_print_eye(eye, sizeof eye, &view->eye, followed != 0 ? view->scene->entities[followed - 1].name : NULL,
                      view->scene, &view->scene->camera);
        snprintf(value, sizeof value, "camera=%s", eye);
        add_setting(out, value);
    }
    if (view->is_other_format)
        add_setting(out, LOM_VIEW_FORMAT);
    if (whole_time(view) != 0)
        fprintf(out, " --frame %d --fps %d", whole_time(view), lom_int_of(scale));
    if (fclose(out) == 0)
        copy = lom_allocate(size + 1, 1, error);
    if (copy != NULL)
        memcpy(copy, text, size);
    free(text);
    return copy;
}

/* ---- pictures ---- */

static bool make_room(struct lom_view_picture *picture, int width, int height, lom_error *error)
{
    size_t size = (size_t)width * (size_t)height * 4;
    if (size > picture->room) {
        lom_release(picture->pixels);
        picture->pixels = lom_allocate(size, 1, error);
        picture->room = picture->pixels != NULL ? size : 0;
    }
    picture->width = width;
    picture->height = height;
    picture->fills = true;
    return picture->pixels != NULL;
}

static void show_next(struct lom_view *view)
{
    struct lom_view_picture before = view->shown;
    view->shown = view->next;
    view->next = before;
    view->is_unpainted = true;
}

static bool has_blue_first(const struct lom_view *view)
{
    return view->host.order == LOM_ORDER_BGRX;
}

lom_image *lom_view_image(const struct lom_view *view, lom_error *error)
{
    const struct lom_view_picture *from = &view->shown;
    bool srgb = view->scene->output.transfer == LOM_TRANSFER_SRGB;
    lom_image *image =
        lom_create_image(from->width, from->height, 1, srgb ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8, error);
    int red = has_blue_first(view) ? 2 : 0;
    for (size_t i = 0; image != NULL && i < (size_t)from->width * (size_t)from->height; i++) {
        image->pixels[3 * i] = from->pixels[4 * i + (size_t)red];
        image->pixels[3 * i + 1] = from->pixels[4 * i + 1];
        image->pixels[3 * i + 2] = from->pixels[4 * i + 2 - (size_t)red];
    }
    return image;
}

/* ---- the picture of a pass ---- */

/* Three bytes of a pixel of either format that lom_show_to_eyes gives. */
static void put_pixel(const lom_image *image, size_t i, int red, uint8_t *to)
{
    const uint16_t *deep = (const uint16_t *)(const void *)image->pixels;
    for (int c = 0; c < 3; c++) {
        int at = c == 1 ? 1 : c == 0 ? red : 2 - red;
        to[at] = image->format == LOM_FORMAT_R16 ? (uint8_t)((deep[i] * 255u + 32767u) / 65535u)
                                                 : image->pixels[3 * i + (size_t)c];
    }
    to[3] = 255;
}

static bool take_image(struct lom_view *view, const lom_image *image, lom_error *error)
{
    if (!make_room(&view->next, image->width, image->height, error))
        return false;
    for (size_t i = 0; i < (size_t)image->width * (size_t)image->height; i++)
        put_pixel(image, i, has_blue_first(view) ? 2 : 0, view->next.pixels + 4 * i);
    return true;
}

/* In the place of the picture of the frame that was drawn last. */
static bool show_pass(struct lom_view *view, const lom_frame_desc *drawn, lom_error *error)
{
    const char *name = lom_describe_shown_pass((size_t)view->pass)->name;
    lom_frame_desc desc = *drawn;
    desc.pixels = NULL;
    lom_image *image = lom_show_to_eyes(lom_show_pass(view->renderer, &desc, name, error), name, error);
    bool done = image != NULL && take_image(view, image, error);
    view->next.fills = done && image->width == desc.width && image->height == desc.height;
    lom_free_image(image);
    return done;
}

/* In the place of the frame. */
static bool draw_overlay(struct lom_view *view, const lom_frame_desc *frame, lom_error *error)
{
    lom_overlay_desc desc = { .frame = *frame,
                              .kind = lom_describe_overlay((size_t)view->overlay),
                              .legend = LOM_LEGEND_INSIDE };
    lom_overlay overlay;
    desc.frame.pixels = NULL;
    desc.frame.order = LOM_ORDER_OUTPUT;
    bool done = lom_draw_overlay(view->renderer, &desc, &overlay, error) && take_image(view, overlay.shown, error);
    lom_free_overlay(&overlay);
    return done;
}

/* ---- drawing ---- */

static bool goes_on(void *context, const char *pass, double done)
{
    struct lom_view *view = context;
    (void)pass, (void)done;
    return view->moves || view->host.interrupts == NULL || !view->host.interrupts(view->host.context);
}

/* While it moves the least divisor that is quick enough: of two sizes, since a renderer keeps targets of two. */
static int choose_divisor(const struct lom_view *view)
{
    if (!view->moves || !view->adapts || view->saves || view->cost <= aim)
        return 1;
    return view->cost <= 4 * aim ? 2 : 4;
}

static void note_time(struct lom_view *view, double start, int divisor)
{
    double end = now(view), gap = end - view->drawn_at;
    view->took = end - start;
    if (view->host.milliseconds != NULL)
        view->cost = view->took * divisor * divisor;
    view->rate = view->moves && gap > 0 && gap < 1000 ? 0.8 * view->rate + 0.2 * 1000 / gap : 0;
    view->drawn_at = end;
}

static bool draw(struct lom_view *view, int divisor, lom_error *error)
{
    lom_camera_view camera;
    lom_frame frame;
    lom_frame_desc desc = lom_view_frame(view, divisor, &camera);
    double start = now(view);
    if (!make_room(&view->next, desc.width, desc.height, error))
        return false;
    desc.continues = view->moves && !view->saves;
    desc.view = view->pass >= 0 ? LOM_MAIN_VIEW : NULL;
    desc.pixels = view->next.pixels;
    desc.pitch = 4 * (size_t)desc.width;
    desc.order = view->host.order;
    desc.progress = goes_on;
    desc.progress_context = view;
    if (view->overlay >= 0 ? !draw_overlay(view, &desc, error)
                           : !lom_render_frame(view->renderer, &desc, &frame, error))
        return false;
    view->is_exact = divisor == 1 && (!desc.continues || view->scene->quality.impostors == LOM_IMPOSTORS_OFF);
    note_time(view, start, divisor);
    view->divisor = divisor;
    view->pictures++;
    if (view->pass >= 0 && !show_pass(view, &desc, error)) { /* a scene without it */
        lom_tell_view(view, true, "%s", error->text);
        view->pass = -1;
        view->is_exact = false;
        *error = (lom_error){ .code = LOM_OK };
    }
    return true;
}

/* What made the pixel that was clicked: all of it on standard output, the verdict on the picture. */
static void explain(struct lom_view *view)
{
    lom_camera_view camera;
    lom_error error = { .code = LOM_OK };
    lom_explain_desc desc = {
        .frame = lom_view_frame(view, 1, &camera), .x = view->explained_x, .y = view->explained_y, .follow = 3
    };
    view->explains = false;
    lom_explanation *explanation = lom_explain(view->renderer, &desc, &error);
    if (explanation == NULL) {
        lom_tell_view(view, true, "%s", error.text);
        return;
    }
    int number = lom_int_of(view->time * view->scene->output.fps);
    lom_print_explanation(stdout, &(struct lom_explain_head){ view->path, number, explanation });
    fflush(stdout);
    lom_tell_view(view, false, "%d,%d: %s", desc.x, desc.y, explanation->item[0].verdict);
    lom_free_explanation(view->renderer, explanation);
}

/* The file of what is shown, and the command that makes the same. */
static void save(struct lom_view *view)
{
    lom_error error = { .code = LOM_OK };
    lom_image *image = lom_view_image(view, &error);
    char *name = image != NULL ? lom_new_name(lom_path_file(view->path), "png", &error) : NULL;
    char *command = name != NULL ? lom_view_command(view, &error) : NULL;
    view->saves = false;
    if (command != NULL && lom_write_image(name, NULL, image, &error)) {
        printf("%s -o", command);
        print_word(stdout, name);
        printf("\n");
        fflush(stdout);
        lom_tell_view(view, false, "written: %s", name);
    } else {
        lom_tell_view(view, true, "%s", error.text);
    }
    lom_release(command);
    lom_release(name);
    lom_free_image(image);
}

void lom_draw_view(struct lom_view *view)
{
    lom_error error = { .code = LOM_OK };
    if (view->load != NULL || view->renderer == NULL)
        return;
    if (view->is_stale || (!view->is_exact && !view->moves) || (view->saves && !view->is_exact)) {
        if (draw(view, choose_divisor(view), &error)) {
            view->is_stale = false;
            show_next(view);
        } else if (error.code != LOM_ERROR_ABANDONED) {
            lom_tell_view(view, true, "%s", error.text);
            view->is_stale = false; /* until something changes */
            view->is_exact = true;
        }
    }
    if (view->explains)
        explain(view);
    if (view->saves && view->is_exact)
        save(view);
}

bool lom_view_rests(const struct lom_view *view)
{
    return !view->moves && !view->runs && !view->is_stale && view->is_exact && view->load == NULL && !view->explains &&
           !view->has_changed;
}
