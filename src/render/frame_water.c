/* What the water models of a frame share: where water is seen, and pictures of the scene for it to look up. In: a mask,
 * a view. Out: a rectangle, a picture with depth. Invariant: cutting a picture to what lookups can reach changes no
 * byte. */
#include "render/frame_water.h"

bool lom_find_water(struct frame *f, lom_error *error)
{
    lom_image *mask = lom_read_texture(f->renderer->mask, 0, 0, error);
    if (mask == NULL)
        return false;
    int x0 = mask->width, y0 = mask->height, x1 = -1, y1 = -1;
    for (int y = 0; y < mask->height; y++) {
        const uint8_t *row = lom_image_pixel(mask, 0, y, 0);
        for (int x = 0; x < mask->width; x++) {
            if (row[x] == 0)
                continue;
            x0 = x < x0 ? x : x0;
            x1 = x > x1 ? x : x1;
            y0 = y < y0 ? y : y0;
            y1 = y;
        }
    }
    lom_free_image(mask);
    if (x1 >= 0)
        f->water = (lom_rect){ f->crop.x + x0, f->crop.y + y0, x1 - x0 + 1, y1 - y0 + 1 };
    return true;
}

lom_rect lom_water_reach(const struct frame *f, double reach, int width, int height)
{
    const lom_rect *w = &f->water;
    int rx = (int)(reach * width) + 2, ry = (int)(reach * height) + 2;
    if (!f->scene->quality.scissor)
        return (lom_rect){ 0, 0, width, height };
    int x0 = (int)((int64_t)w->x * width / f->width) - rx, y0 = (int)((int64_t)w->y * height / f->height) - ry;
    int x1 = (int)((int64_t)(w->x + w->width) * width / f->width) + 1 + rx;
    int y1 = (int)((int64_t)(w->y + w->height) * height / f->height) + 1 + ry;
    x0 = x0 < 0 ? 0 : x0;
    y0 = y0 < 0 ? 0 : y0;
    x1 = x1 > width ? width : x1;
    y1 = y1 > height ? height : y1;
    return (lom_rect){ x0, y0, x1 - x0, y1 - y0 };
}

bool lom_draw_picture(struct frame *f, lom_step *step, lom_texture *color, lom_texture *depth,
                      const struct lom_scene_view *view, const float clear[4], lom_rect scissor)
{
    lom_renderer *r = f->renderer;
    lom_pass_desc pass = { .color = { color }, .depth = depth, .scissor = scissor };
    for (int i = 0; i < 4; i++)
        pass.clear_color[0][i] = clear[i];
    step->width = lom_texture_width(color);
    step->height = lom_texture_height(color);
    step->scissor = scissor;
    lom_begin_pass(r->device, &pass);
    lom_draw_scene(r, view);
    bool done = lom_end_pass(r->device);
    if (done && r->clouds != NULL && view->mirrored && view->sky) {
        lom_error error = { 0 };
        lom_draw_clouds(f, view, pass, depth, &error);
        done = error.code == LOM_OK && lom_device_error(r->device)->code == LOM_OK;
    }
    return done;
}

bool lom_skip_water(struct frame *f, const char *reason)
{
    static const char *const passes[] = { "reflection", "refraction", "water" };
    for (size_t i = 0; i < sizeof passes / sizeof passes[0]; i++)
        lom_add_step(f, passes[i], false, "%s", reason);
    return true;
}

void lom_begin_water(struct frame *f, const char *text)
{
    lom_step *step = lom_add_step(f, "water", true, "%s", text);
    step->width = f->crop.width;
    step->height = f->crop.height;
    step->scissor = f->water;
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->color);
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.scissor = f->water;
    lom_begin_pass(f->renderer->device, &pass);
}
