/* What the water models of a frame share: where water is seen, and pictures of the scene for it to look up. In: a mask,
 * a view. Out: a rectangle, a picture with depth. Invariant: cutting a picture to what lookups can reach changes no
 * byte. */
#include "base/numbers.h"
#include "image/texture.h"
#include "pipeline/share_work.h"
#include "render/water/passes.h"
#include "water/scene_copy.h"

#include <lom/record.h>

#include <assert.h>

const struct lom_window lom_whole_view = { { -1, -1 }, { 1, 1 } };

enum { ROWS = 32, BANDS = LOM_MAX_SIZE / ROWS };

/* Where the mask is set, in each band of rows: first and last column and row; x1 < x0: nowhere. */
struct bands {
    const lom_texture *mask;
    struct {
        int x0, y0, x1, y1;
    } of[BANDS];
};

static bool is_set(uint32_t texel) /* the lowest byte is red */
{
    return (texel & 255) != 0;
}

static void look_through_rows(void *context, size_t first, size_t end)
{
    struct bands *bands = context;
    int width = lom_texture_width(bands->mask), x0 = width, x1 = -1, y0 = (int)first, y1 = -1;
    for (int y = (int)first; y < (int)end; y++) {
        const uint32_t *row = lom_texel(bands->mask, 0, 0, y, 0);
        int left = 0, right = width - 1;
        while (left < width && !is_set(row[left]))
            left++;
        if (left == width)
            continue;
        while (!is_set(row[right]))
            right--;
        y0 = x1 < 0 ? y : y0;
        y1 = y;
        x0 = left < x0 ? left : x0;
        x1 = right > x1 ? right : x1;
    }
    bands->of[first / ROWS].x0 = x0;
    bands->of[first / ROWS].y0 = y0;
    bands->of[first / ROWS].x1 = x1;
    bands->of[first / ROWS].y1 = y1;
}

void lom_find_water(struct frame *f)
{
    struct bands bands = { .mask = f->renderer->targets.of[LOM_TARGET_MASK] };
    assert(bands.mask->storage == LOM_STORAGE_RGBA8);
    int width = lom_texture_width(bands.mask), height = lom_texture_height(bands.mask);
    int x0 = width, y0 = height, x1 = -1, y1 = -1;
    lom_share_work(f->renderer->device, (size_t)height, ROWS, look_through_rows, &bands);
    for (int i = 0; i * ROWS < height; i++) {
        if (bands.of[i].x1 < 0)
            continue;
        x0 = bands.of[i].x0 < x0 ? bands.of[i].x0 : x0;
        x1 = bands.of[i].x1 > x1 ? bands.of[i].x1 : x1;
        y0 = bands.of[i].y0 < y0 ? bands.of[i].y0 : y0;
        y1 = bands.of[i].y1;
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

/* Begins a picture of the frame's size with what the frame shows of it: a surface that is seen there and lies inside
 * the view's plane is the nearest of those inside. The margin, a part of the eye's height over the plane and of how far
 * parallel rays reach, is far more than floats round. Where pixels have several samples a texel is a mixture of
 * surfaces, which may lie on both sides. */
static void copy_scene(struct frame *f, const struct lom_scene_view *view)
{
    const lom_renderer *r = f->renderer;
    const double(*v)[4] = view->view.m;
    double x = 2 / (view->projection.m[0][0] * f->width), y = -2 / (view->projection.m[1][1] * f->height);
    double over = view->plane[1] * view->eye.y + view->plane[3];
    double middle = v[0][1] * x * -f->width / 2 + v[1][1] * y * -f->height / 2 - (f->parallel ? 0 : v[2][1]);
    double margin = 0x1p-8 * (over < 0 ? -over : over) + (f->parallel ? 0x1p-18 * f->camera.far_plane : 0);
    const struct lom_scene_copy_uniforms u = { .height = { (float)(v[0][1] * x), (float)(v[1][1] * y), (float)middle },
                                               .side = (float)view->plane[1],
                                               .over = (float)over,
                                               .margin = (float)margin,
                                               .eye = lom_find_eye(&view->projection, &view->view, 0),
                                               .origin = { (float)f->crop.x, (float)f->crop.y },
                                               .color = r->targets.of[f->target],
                                               .depth = r->targets.of[LOM_TARGET_DEPTH] };
    lom_draw(r->device, &(lom_draw_desc){ .shader = &lom_scene_copy_shader,
                                          .uniforms = &u,
                                          .count = 4,
                                          .vertex_count = 4,
                                          .topology = LOM_TRIANGLE_STRIP,
                                          .depth_compare = LOM_COMPARE_ALWAYS,
                                          .scissor = f->water });
}

/* Whether corners are near enough for the margin: where a triangle is cut is rounded to 2^-24 of where its corners are, a few
 * times. */
static bool cuts_closely(const struct frame *f, const struct lom_scene_view *view)
{
    const lom_renderer *r = f->renderer;
    const double most = 0x1p15 * lom_magnitude(view->plane[1] * view->eye.y + view->plane[3]);
    for (size_t i = 0; i < r->entities.count; i++) {
        const lom_box *box = &r->entities.items[i].at->bounds;
        const double reach[] = { box->low.x, box->low.y, box->low.z, box->high.x, box->high.y, box->high.z };
        for (size_t k = 0; k < sizeof reach / sizeof reach[0]; k++)
            if (!(lom_magnitude(reach[k]) < most))
                return false;
    }
    return true;
}

/* Copying costs a look at every pixel of the water, and pays where there is ground to be copied. */
static bool can_copy(const struct frame *f, const struct lom_scene_view *view, const lom_step *step)
{
    return f->scene->quality.scissor && cuts_closely(f, view) && f->scene->output.samples <= 1 &&
           step->width == f->width && step->height == f->height && lom_shows_terrain(f->renderer, view);
}

/* Liquids over a picture, which is larger by as much as their bent rays look. */
struct over {
    enum lom_target behind, length;
    bool shows;
};

static struct over find_liquids(const struct frame *f, const struct lom_scene_view *view)
{
    const struct lom_culler culler = lom_culler_of(view, NULL);
    struct over over = { LOM_TARGET_FLUID_REFRACTED, LOM_TARGET_FLUID_REFRACTED_LENGTH,
                         lom_shows_fluids(f->renderer, &culler) };
    if (view->mirrored) {
        over.behind = LOM_TARGET_FLUID_REFLECTED;
        over.length = LOM_TARGET_FLUID_REFLECTED_LENGTH;
    }
    return over;
}

static void grow_for_liquids(lom_pass_desc *pass)
{
    const int width = lom_texture_width(pass->color[0]), height = lom_texture_height(pass->color[0]);
    lom_grow_range(&pass->scissor.x, &pass->scissor.width, width, lom_fluid_reach(height));
    lom_grow_range(&pass->scissor.y, &pass->scissor.height, height, lom_fluid_reach(height));
}

/* The water bends the edges of what lies below it, which one sample finds well enough; a mirror shows its own. */
static int count_samples(const lom_scene *scene, bool mirrored)
{
    const int samples = scene->output.samples, most = scene->quality.refraction_samples;
    return mirrored || samples < most ? samples : most;
}

bool lom_draw_picture(struct frame *f, lom_step *step, lom_texture *color, lom_texture *depth,
                      const struct lom_scene_view *view, const float clear[4], lom_rect scissor, bool is_shown,
                      lom_error *error)
{
    lom_renderer *r = f->renderer;
    lom_pass_desc pass = { .color = { color },
                           .depth = depth,
                           .samples = count_samples(f->scene, view->mirrored),
                           .per_sample = f->scene->output.sample_shading,
                           .scissor = scissor };
    pass.label = view->mirrored ? "reflection" : "refraction";
    for (int i = 0; i < 4; i++)
        pass.clear_color[0][i] = clear[i];
    step->width = lom_texture_width(color);
    step->height = lom_texture_height(color);
    step->scissor = scissor;
    const bool smooths = f->smooths && view->mirrored;
    if (smooths)
        lom_begin_smooth_picture(f, &pass);
    const struct over liquids = find_liquids(f, view);
    if (liquids.shows)
        grow_for_liquids(&pass);
    if (view->mirrored)
        r->water->mirrored = lom_count_watched_passes(r->device);
    lom_begin_pass(r->device, &pass);
    if (is_shown && !f->shows_water && can_copy(f, view, step))
        copy_scene(f, view);
    const struct lom_window shown = lom_window_of(&pass.scissor, step->width, step->height);
    struct lom_scene_view part = *view;
    part.window = &shown;
    lom_draw_scene(r, &part);
    bool shows_clouds = r->clouds.set != NULL && view->mirrored && view->sky;
    size_t seen;
    return lom_end_pass(r->device) &&
           (!liquids.shows || lom_draw_fluids_over(f, view, &pass, liquids.behind, liquids.length, error)) &&
           (!smooths || lom_smooth_picture(f, &pass, color, scissor)) &&
           (!shows_clouds || lom_draw_clouds_over(f, view, pass, depth, &seen, error)) &&
           lom_draw_transparent_over(f, &part, pass);
}

bool lom_skip_water(struct frame *f, const char *reason)
{
    static const char *const passes[] = { "reflection", "refraction", "water" };
    for (size_t i = 0; i < sizeof passes / sizeof passes[0]; i++)
        lom_add_step(f, passes[i], false, "%s", reason);
    return true;
}

bool lom_draw_over_scene(struct frame *f, const char *text, const lom_draw_desc *surface, lom_error *error)
{
    if (!f->shows_water) {
        f->shows_water = true;
        f->divided_by = f->turned;
        f->divided_at = f->scene->water.level;
        if (!lom_draw_fluids_beyond(f, error) || !lom_draw_transparent_beyond(f))
            return false;
    }
    lom_step *step = lom_add_step(f, "water", true, "%s", text);
    step->width = f->crop.width;
    step->height = f->crop.height;
    step->scissor = f->water;
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[f->target]);
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.scissor = f->water;
    pass.label = "water";
    if (f->smooths && !surface->depth_write_off) {
        pass.edges = f->renderer->targets.of[LOM_TARGET_EDGES];
        pass.edges_load = LOM_LOAD_KEEP;
    }
    lom_draw_desc labelled = *surface;
    labelled.label = "water";
    labelled.object = LOM_OBJECT_WATER;
    return lom_draw_pass(f->renderer->device, &pass, &labelled, 1);
}
