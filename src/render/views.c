/* A picture of several cameras. In: a frame's description, the scene's views. Out: the picture of [camera], and over
 * it the picture of each view in its rectangle. Invariant: a rectangle holds the bytes of its view drawn alone; what
 * the frame would show there is covered. */
#include "render/frame.h"

#include <string.h>

lom_rect lom_view_rectangle(const lom_picture_view *view, int width, int height)
{
    const int size[2] = { width, height };
    int from[2], count[2];
    for (int i = 0; i < 2; i++) {
        const double first = view->rectangle[i], last = first + view->rectangle[2 + i];
        from[i] = lom_int_of(first * size[i] + 0.5);
        from[i] = from[i] < size[i] ? from[i] : size[i] - 1;
        count[i] = lom_int_of(last * size[i] + 0.5) - from[i];
        count[i] = count[i] < 1 ? 1 : count[i] > size[i] - from[i] ? size[i] - from[i] : count[i];
    }
    return (lom_rect){ from[0], from[1], count[0], count[1] };
}

const lom_picture_view *lom_view_at(const lom_scene *scene, int width, int height, int x, int y)
{
    for (size_t i = scene->view_count; i-- > 0;) {
        const lom_rect r = lom_view_rectangle(&scene->views[i], width, height);
        if (scene->views[i].visible && x >= r.x && y >= r.y && x - r.x < r.width && y - r.y < r.height)
            return &scene->views[i];
    }
    return NULL;
}

bool lom_find_view(const lom_scene *scene, const char *name, const lom_picture_view **view, lom_error *error)
{
    *view = NULL;
    if (name == NULL || strcmp(name, LOM_MAIN_VIEW) == 0)
        return true;
    for (size_t i = 0; i < scene->view_count && *view == NULL; i++)
        if (strcmp(scene->views[i].name, name) == 0)
            *view = &scene->views[i];
    return *view != NULL ||
           lom_fail(error, LOM_ERROR_USAGE,
                    "The scene has no [[view]] \"%s\"; the picture without its views is \"%s\".", name, LOM_MAIN_VIEW);
}

bool lom_has_views(const lom_scene *scene, const lom_frame_desc *desc)
{
    for (size_t i = 0; i < scene->view_count; i++)
        if (scene->views[i].visible)
            return desc->view == NULL;
    return false;
}

static lom_rect meet(lom_rect a, lom_rect b)
{
    const int x0 = a.x > b.x ? a.x : b.x, y0 = a.y > b.y ? a.y : b.y;
    const int x1 = a.x + a.width < b.x + b.width ? a.x + a.width : b.x + b.width;
    const int y1 = a.y + a.height < b.y + b.height ? a.y + a.height : b.y + b.height;
    return x1 > x0 && y1 > y0 ? (lom_rect){ x0, y0, x1 - x0, y1 - y0 } : (lom_rect){ 0, 0, 0, 0 };
}

/* The whole while its parts are drawn: part `now` of `count` parts. */
struct parts {
    const lom_frame_desc *whole;
    int now, count;
};

static bool tell_part(void *context, const char *pass, double done)
{
    const struct parts *parts = context;
    return parts->whole->progress(parts->whole->progress_context, pass, (parts->now + done) / parts->count);
}

/* What of a view is drawn into the frame's crop; false: nothing. */
static bool describe_view(const struct frame *f, const lom_picture_view *view, size_t pixel, lom_frame_desc *part)
{
    const lom_rect r = lom_view_rectangle(view, f->width, f->height), seen = meet(r, f->crop);
    if (!view->visible || seen.width == 0)
        return false;
    part->view = view->name;
    part->camera = NULL;
    part->crop = (lom_rect){ seen.x - r.x, seen.y - r.y, seen.width, seen.height };
    const size_t down = (size_t)(seen.y - f->crop.y), across = (size_t)(seen.x - f->crop.x);
    part->pixels = (uint8_t *)f->desc->pixels + down * f->desc->pitch + across * pixel;
    return true;
}

/* All parts can be drawn, before any is. */
static bool check_parts(const struct frame *f, lom_error *error)
{
    for (size_t i = 0; i < f->scene->view_count; i++) {
        lom_frame_desc part = *f->desc;
        if (describe_view(f, &f->scene->views[i], 0, &part) && !lom_check_frame(f->scene, &part, error))
            return false;
    }
    return true;
}

static bool draw_parts(struct frame *f, lom_frame *out, lom_error *error)
{
    const size_t pixel = lom_pixel_bytes(f->scene, f->desc->order);
    struct parts parts = { f->desc, 0, 1 + (int)f->scene->view_count };
    lom_frame_desc main = *f->desc;
    main.view = LOM_MAIN_VIEW;
    if (f->desc->progress != NULL) {
        main.progress = tell_part;
        main.progress_context = &parts;
    }
    if (!lom_draw_part(f->renderer, &main, out, error))
        return false;
    for (size_t i = 0; i < f->scene->view_count; i++) {
        lom_frame_desc part = main;
        parts.now++;
        if (describe_view(f, &f->scene->views[i], pixel, &part) && !lom_draw_part(f->renderer, &part, out, error))
            return false;
    }
    return true;
}

bool lom_draw_views(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error)
{
    lom_frame_desc whole = *desc;
    struct frame f = { .renderer = renderer, .scene = renderer->scene, .desc = &whole };
    if (!lom_find_frame_sizes(&f, error))
        return false;
    whole.crop = f.crop;
    lom_image *image = NULL;
    if (desc->pixels == NULL) {
        const lom_format format = lom_format_of_output(&f.scene->output);
        image = lom_create_image(f.crop.width, f.crop.height, 1, format, error);
        if (image == NULL)
            return false;
        whole.order = LOM_ORDER_OUTPUT;
        whole.pixels = image->pixels;
        whole.pitch = (size_t)f.crop.width * lom_format_size(format);
    }
    const bool done = check_parts(&f, error) && draw_parts(&f, out, error);
    if (done)
        out->image = image;
    else
        lom_free_image(image);
    return done;
}
