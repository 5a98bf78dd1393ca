/* Pictures of the scene for water with waves to look up. In: where the water is seen. Out: the scene on the eye's side,
 * mirrored in the level, and the scene behind the surface, each with its depth; only as far as lookups can reach. */
#include "base/numbers.h"
#include "render/water/surface.h"

static const float nothing[4] = { 0, 0, 0, 0 };

static lom_rect lookups(const struct frame *f, const struct lom_window *window, const lom_texture *picture)
{
    lom_rect r = lom_water_reach(f, window, lom_ray_reach(f), lom_texture_width(picture), lom_texture_height(picture));
    /* Levels of detail: a lookup reads texels up to two of the coarsest level away, and of places that are up to two
     * apart. */
    int more = (3 + LOM_BLUR_PLACES) << LOM_BLUR_LEVELS, x1 = r.x + r.width + more, y1 = r.y + r.height + more;
    r.x = r.x > more ? r.x - more : 0;
    r.y = r.y > more ? r.y - more : 0;
    r.width = (x1 < lom_texture_width(picture) ? x1 : lom_texture_width(picture)) - r.x;
    r.height = (y1 < lom_texture_height(picture) ? y1 : lom_texture_height(picture)) - r.y;
    return r;
}

/* The picture's matrix, and where it has the frame's pixels. */
static void set_picture(struct lom_picture_uniform *out, const struct frame *f, const struct lom_window *window,
                        const lom_mat4 *clip_from_offset, lom_texture *color, lom_texture *depth)
{
    double width = window->high[0] - window->low[0], height = window->high[1] - window->low[1];
    out->clip_from_offset = lom_round_matrix(clip_from_offset);
    out->color = color;
    out->depth = depth;
    out->scale[0] = (float)(2 / (width * f->width));
    out->scale[1] = (float)(2 / (height * f->height));
    out->shift[0] = (float)((-1 - window->low[0]) / width);
    out->shift[1] = (float)((window->high[1] - 1) / height);
}

/* How deep below the level, or for an eye under water high over it, anything of the scene is. */
static double longest_below(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    double low = f->scene->water.level, high = low;
    for (int i = 0; i < r->ground.across * r->ground.down; i++) {
        low = lom_smaller(low, r->ground.blocks[i].bounds.low.y);
        high = lom_larger(high, r->ground.blocks[i].bounds.high.y);
    }
    for (size_t i = 0; i < r->entities.count; i++) {
        low = lom_smaller(low, r->entities.items[i].at->bounds.low.y);
        high = lom_larger(high, r->entities.items[i].at->bounds.high.y);
    }
    for (size_t i = 0; i < f->scene->fluid_count; i++)
        if (lom_shows_liquid(f->scene, i)) {
            low = lom_smaller(low, f->scene->fluids[i].low[1]);
            high = lom_larger(high, f->scene->fluids[i].high[1]);
        }
    return f->below ? high - f->scene->water.level : f->scene->water.level - low;
}

/* The ray at (x, y) in normalised device coordinates, bent at still water: where the picture would have to show it, as
 * far away as can be, which for parallel rays is as deep as the scene is. False where it does not meet the surface, or
 * does not pass; a little beyond the rim of Snell's window it counts as one that just passes, along the surface: rays
 * turn so fast there that none of a grid need be near the farthest. */
static bool bend_ray(const struct surface *surface, const struct frame *f, double x, double y, double out[2])
{
    const float(*r)[3] = surface->uniforms.ray, *along = surface->uniforms.eye.along;
    double d[3], side = f->below ? -1 : 1, eta = (double)surface->uniforms.eta;
    for (int i = 0; i < 3; i++)
        d[i] = f->parallel ? (double)along[i] : (double)r[i][0] * x + (double)r[i][1] * y + (double)r[i][2];
    double size = lom_double_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), c = -side * d[1] / size;
    double square = 1 - eta * eta * (1 - c * c);
    if (c <= 0 || square <= -0.15)
        return false;
    const double down = square > 0 ? lom_double_sqrt(square) : 0;
    double bent[3] = { eta * d[0] / size, -side * down, eta * d[2] / size }, view[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            view[i] += f->view.view.m[i][k] * bent[k];
    if (f->parallel) {
        const double(*p)[4] = f->view.projection.m, length = longest_below(f) / lom_larger(lom_magnitude(bent[1]), 0.1);
        out[0] = x + length * (view[0] * p[0][0] + view[2] * p[0][2]);
        out[1] = y + length * (view[1] * p[1][1] + view[2] * p[1][2]);
        return true;
    }
    double w = -view[2] > 0.1 ? -view[2] : 0.1;
    out[0] = view[0] / w * f->view.projection.m[0][0];
    out[1] = view[1] / w * f->view.projection.m[1][1];
    return true;
}

/* What the picture behind the surface has to show: all that rays of the view, bent at still water, can see, and a
 * margin for waves; of the view itself what is not above the horizon. A function of the whole frame's camera. */
static struct lom_window bent_window(const struct surface *surface, const struct frame *f)
{
    struct lom_window window = lom_whole_view;
    double top = -1, bent[2];
    if (!surface->uniforms.bent && !f->below)
        return window;
    const int rays = f->below ? 32 : 8; /* a side; a 30th of the view is less than what counts as the rim */
    for (int i = 0; i <= rays * rays; i++) {
        double x = i % rays * 2.0 / (rays - 1) - 1, y = i / rays * 2.0 / rays - 1;
        if (!bend_ray(surface, f, x, y, bent))
            continue;
        top = y > top ? y : top;
        for (int k = 0; k < 2; k++) {
            double margin = 0.12 * (bent[k] < 0 ? -1 : 1), at = bent[k] + margin;
            at = at < -3 ? -3 : at > 3 ? 3 : at;
            window.low[k] = at < window.low[k] ? at : window.low[k];
            window.high[k] = at > window.high[k] ? at : window.high[k];
        }
    }
    if (!f->below && window.high[1] <= 1 && top + 0.5 < 1) /* rows of rays are a quarter apart */
        window.high[1] = top + 0.5;
    return window;
}

/* The scene on the eye's side (above: 1, below: -1), less the clip offset. */
static void clip_at(struct lom_scene_view *view, const struct frame *f, double side, double over)
{
    view->plane[0] = view->plane[2] = 0;
    view->plane[1] = side;
    view->plane[3] = -side * f->scene->water.level + over + f->scene->water.clip_offset;
    view->sky = false;
}

static bool draw_mirrored(struct surface *surface, struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    struct lom_scene_view view = f->view;
    lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, f->scene->water.level);
    view.view = lom_multiply(&f->view.view, &mirror);
    view.eye.y = 2 * f->scene->water.level - f->view.eye.y;
    view.mirrored = true;
    view.pixels = f->scene->quality.reflection_scale;
    clip_at(&view, f, f->below ? -1 : 1, 0);
    if (!lom_shows_scene(r, &view)) {
        lom_add_step(f, "reflection", false, "nothing but %s is reflected", f->below ? "water" : "the sky");
        return true;
    }
    lom_step *step =
        lom_add_step(f, "reflection", true, "terrain, entities and liquids on the eye's side, mirrored in the level");
    lom_mat4 mirrored = lom_mirror((lom_vec3){ 0, 1, 0 }, surface->level),
             clip = lom_multiply(&surface->clip_from_offset, &mirrored);
    set_picture(&surface->uniforms.mirrored, f, &lom_whole_view, &clip, r->targets.of[LOM_TARGET_REFLECTION],
                r->targets.of[LOM_TARGET_REFLECTION_DEPTH]);
    return lom_draw_picture(f, step, r->targets.of[LOM_TARGET_REFLECTION], r->targets.of[LOM_TARGET_REFLECTION_DEPTH],
                            &view, nothing, lookups(f, &lom_whole_view, r->targets.of[LOM_TARGET_REFLECTION]), false,
                            error);
}

/* Whether the frame shows what is behind the surface as a picture of it would: no ray is bent, and the bed is lit alike. */
static bool is_shown(const struct surface *surface, const struct frame *f)
{
    return !surface->uniforms.bent && !f->below && f->view.caustics.map == NULL;
}

static bool draw_behind(struct surface *surface, struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    struct lom_scene_view view = f->view;
    const struct lom_waves_uniform *waves = &surface->uniforms.waves;
    struct lom_window window = bent_window(surface, f);
    view.projection = lom_zoom_to(&window, &f->view.projection);
    view.pixels = f->scene->quality.refraction_scale;
    clip_at(&view, f, f->below ? 1 : -1, f->below ? -(double)waves->lowest : (double)waves->highest);
    if (!lom_shows_scene(r, &view)) {
        lom_add_step(f, "refraction", false, "nothing but %s is behind the surface", f->below ? "the sky" : "water");
        return true;
    }
    lom_step *step =
        lom_add_step(f, "refraction", true, "terrain, entities and liquids behind the surface, with their depth");
    lom_mat4 clip = lom_clip_from_offset(&view.projection, &view.view);
    set_picture(&surface->uniforms.behind, f, &window, &clip, r->targets.of[LOM_TARGET_REFRACTION],
                r->targets.of[LOM_TARGET_REFRACTION_DEPTH]);
    return lom_draw_picture(f, step, r->targets.of[LOM_TARGET_REFRACTION], r->targets.of[LOM_TARGET_REFRACTION_DEPTH],
                            &view, nothing, lookups(f, &window, r->targets.of[LOM_TARGET_REFRACTION]),
                            is_shown(surface, f), error);
}

static float find_largest_row(const lom_matrix_uniform *m)
{
    float largest = 0;
    for (int i = 0; i < 4; i++) {
        float sum = 0;
        for (int k = 0; k < 4; k++)
            sum += m->m[i][k] < 0 ? -m->m[i][k] : m->m[i][k];
        largest = sum > largest ? sum : largest;
    }
    return largest;
}

/* Of the picture of what is above the water, which is looked up blurred. */
static bool find_near_blocks(struct surface *surface, struct frame *f, lom_error *error)
{
    struct lom_picture_uniform *above = f->below ? &surface->uniforms.behind : &surface->uniforms.mirrored;
    struct lom_near_blocks *blocks = &f->renderer->water->near;
    if (above->color == NULL)
        return true;
    if (!lom_fill_near_blocks(blocks, f->renderer->device, above->color, above->depth, LOM_PICTURE_BLOCK, error))
        return false;
    above->near = (struct lom_near_uniform){ blocks->around, blocks->columns, blocks->rows };
    above->rows_sum = find_largest_row(&above->clip_from_offset);
    return true;
}

/* Of the picture of what is below the water, where rays are bent into it. */
static bool find_far_rows(struct surface *surface, struct frame *f, lom_error *error)
{
    struct lom_picture_uniform *below = &surface->uniforms.behind;
    struct lom_far_rows *rows = &f->renderer->water->far;
    if (f->below || below->color == NULL || !surface->uniforms.bent)
        return true;
    if (!lom_fill_far_rows(rows, f->renderer->device, below->depth, LOM_PICTURE_ROW, error))
        return false;
    below->far = (struct lom_far_uniform){ rows->below, rows->rows };
    below->rows_sum = find_largest_row(&below->clip_from_offset);
    return true;
}

bool lom_draw_surface_pictures(struct surface *surface, struct frame *f, lom_error *error)
{
    return draw_mirrored(surface, f, error) && draw_behind(surface, f, error) && find_near_blocks(surface, f, error) &&
           find_far_rows(surface, f, error);
}
