/* What the water models of a frame share: where water is seen, and pictures of the scene for it to look up. In: a mask,
 * a view. Out: a rectangle, a picture with depth. Invariant: cutting a picture to what lookups can reach changes no
 * byte. */
#include "image/texture.h"
#include "render/water/passes.h"

#include <assert.h>

const struct lom_window lom_whole_view = { { -1, -1 }, { 1, 1 } };

void lom_find_water(struct frame *f)
{
    const lom_texture *mask = f->renderer->targets.of[LOM_TARGET_MASK];
    assert(mask->storage == LOM_STORAGE_RGBA8);
    int width = lom_texture_width(mask), height = lom_texture_height(mask);
    int x0 = width, y0 = height, x1 = -1, y1 = -1;
    for (int y = 0; y < height; y++) {
        const uint32_t *row = lom_texel(mask, 0, 0, y, 0); /* the lowest byte of a texel is red */
        for (int x = 0; x < width; x++) {
            if ((row[x] & 255) == 0)
                continue;
            x0 = x < x0 ? x : x0;
            x1 = x > x1 ? x : x1;
            y0 = y < y0 ? y : y0;
            y1 = y;
        }
    }
    if (x1 >= 0)
        f->water = (lom_rect){ f->crop.x + x0, f->crop.y + y0, x1 - x0 + 1, y1 - y0 + 1 };
}

/* Frame pixels from..to of an axis as pixels of a picture, grown by `reach` parts of it and two, within it. The axis
 * runs from low to high in normalised device coordinates as pixels do. */
static void map_range(int from, int to, int frame, double low, double high, double reach, int size, int *first,
                      int *count)
{
    double scale = 2.0 / (frame * (high - low)), offset = (-1 - low) / (high - low);
    double a = lom_double_floor((from * scale + offset - reach) * size) - 2;
    double b = lom_double_floor((to * scale + offset + reach) * size) + 3;
    *first = a < 0 ? 0 : a < size ? lom_int_of(a) : size - 1;
    *count = (b > size ? size : b < 1 ? 1 : lom_int_of(b)) - *first;
    *count = *count < 1 ? 1 : *count;
}

lom_rect lom_water_reach(const struct frame *f, const struct lom_window *window, double reach, int width, int height)
{
    const lom_rect *w = &f->water;
    lom_rect r = { 0, 0, width, height };
    if (!f->scene->quality.scissor)
        return r;
    map_range(w->x, w->x + w->width, f->width, window->low[0], window->high[0], reach, width, &r.x, &r.width);
    map_range(w->y, w->y + w->height, f->height, -window->high[1], -window->low[1], reach, height, &r.y, &r.height);
    return r;
}

bool lom_draw_picture(struct frame *f, lom_step *step, lom_texture *color, lom_texture *depth,
                      const struct lom_scene_view *view, const float clear[4], lom_rect scissor, lom_error *error)
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
    bool shows_clouds = r->clouds.set != NULL && view->mirrored && view->sky;
    size_t seen;
    return lom_end_pass(r->device) && (!shows_clouds || lom_draw_clouds_over(f, view, pass, depth, &seen, error));
}

bool lom_skip_water(struct frame *f, const char *reason)
{
    static const char *const passes[] = { "reflection", "refraction", "water" };
    for (size_t i = 0; i < sizeof passes / sizeof passes[0]; i++)
        lom_add_step(f, passes[i], false, "%s", reason);
    return true;
}

bool lom_draw_over_scene(struct frame *f, const char *text, const lom_draw_desc *surface)
{
    lom_step *step = lom_add_step(f, "water", true, "%s", text);
    step->width = f->crop.width;
    step->height = f->crop.height;
    step->scissor = f->water;
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[LOM_TARGET_COLOR]);
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.scissor = f->water;
    return lom_draw_pass(f->renderer->device, &pass, surface, 1);
}
