/* The planar lake of a frame (spec, part A). In: the frame whose opaque scene is drawn. Out: the water over it.
 *
 *   visibility (where is water?) -> reflection, refraction (only there) -> water over the scene
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "render/frame.h"
#include "water/lake.h"

static lom_lake_view lake_view(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    return (lom_lake_view){ .clip_from_world = lom_multiply(&f->view.projection, &f->view.view),
                            .eye = f->view.eye,
                            .near_plane = f->camera.near_plane,
                            .time = f->time,
                            .frame_width = f->width,
                            .frame_height = f->height,
                            .light = lom_scene_light(f->scene),
                            .normal_map = r->normal_map,
                            .flow_map = r->flow_map };
}

/* The smallest rectangle of frame pixels with water in it. */
static bool find_water(struct frame *f, lom_error *error)
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

static bool is_in_view(const struct frame *f)
{
    const lom_water_params *w = &f->scene->water;
    lom_box box = { { w->position[0] - w->size[0] / 2, w->level, w->position[1] - w->size[1] / 2 },
                    { w->position[0] + w->size[0] / 2, w->level, w->position[1] + w->size[1] / 2 } };
    lom_mat4 clip_from_world = lom_multiply(&f->view.projection, &f->view.view);
    lom_frustum frustum = lom_view_frustum(&clip_from_world, false);
    return lom_box_visibility(&frustum, box) != LOM_OUTSIDE;
}

static bool draw_visibility(struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    lom_lake_view v = lake_view(f);
    lom_step *step = lom_add_step(f, "visibility", true, "which pixels show the water's surface");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->mask);
    pass.depth_load = LOM_LOAD_KEEP;
    lom_begin_pass(r->device, &pass);
    lom_draw_lake(r->device, &lom_lake_mask_shader, &f->scene->water, &v);
    return lom_end_pass(r->device) && find_water(f, error);
}

/* The part of a picture of the scene (scaled to width x height) that lookups from the visible water can reach. */
static lom_rect reach(const struct frame *f, int width, int height)
{
    const lom_rect *w = &f->water;
    int rx = lom_lake_reach(&f->scene->water, width), ry = lom_lake_reach(&f->scene->water, height);
    if (!f->scene->water.projection)
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

static bool draw_picture(struct frame *f, lom_step *step, lom_texture *color, lom_texture *depth,
                         const struct lom_scene_view *view)
{
    lom_renderer *r = f->renderer;
    const lom_water_params *water = &f->scene->water;
    int width = lom_texture_width(color), height = lom_texture_height(color);
    lom_pass_desc pass = { .color = { color }, .depth = depth, .scissor = reach(f, width, height) };
    for (int i = 0; i < 3; i++)
        pass.clear_color[0][i] = (float)water->color[i];
    pass.clear_color[0][3] = 1;
    step->width = width;
    step->height = height;
    step->scissor = pass.scissor;
    lom_begin_pass(r->device, &pass);
    lom_draw_scene(r, view);
    return lom_end_pass(r->device);
}

/* Step 1: the view times a mirror in the plane; nothing below the plane (less the offset). */
static bool draw_reflection(struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    struct lom_scene_view view = f->view;
    lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, water->level);
    if (!water->reflection) {
        lom_add_step(f, "reflection", false, "water.reflection is off");
        return true;
    }
    view.view = lom_multiply(&f->view.view, &mirror);
    view.eye.y = 2 * water->level - f->view.eye.y;
    view.mirrored = true;
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = 1;
    view.plane[3] = water->clip_offset - water->level;
    lom_step *step =
        lom_add_step(f, "reflection", true, "terrain, entities and sky above the water, mirrored in its plane");
    return draw_picture(f, step, f->renderer->reflection, f->renderer->reflection_depth, &view);
}

/* Step 2: the scene below the plane (plus the offset), with its depth. */
static bool draw_refraction(struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    struct lom_scene_view view = f->view;
    if (!water->refraction && !water->soft_shore && !water->specular) {
        lom_add_step(f, "refraction", false, "water.refraction and everything that reads its depth are off");
        return true;
    }
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = -1;
    view.plane[3] = water->level + water->clip_offset;
    view.sky = false;
    lom_step *step = lom_add_step(f, "refraction", true, "terrain and entities below the water, with their depth");
    return draw_picture(f, step, f->renderer->refraction, f->renderer->refraction_depth, &view);
}

static bool draw_surface(struct frame *f)
{
    lom_renderer *r = f->renderer;
    const lom_water_params *water = &f->scene->water;
    lom_lake_view view = lake_view(f);
    bool below = water->refraction || water->soft_shore || water->specular;
    view.reflection = water->reflection ? r->reflection : NULL;
    view.refraction = below ? r->refraction : NULL;
    view.refraction_depth = below ? r->refraction_depth : NULL;
    lom_step *step = lom_add_step(f, "water", true, "the surface over the scene, from the pictures above and below it");
    step->width = f->crop.width;
    step->height = f->crop.height;
    step->scissor = f->water;
    lom_pass_desc pass = lom_frame_pass(f, r->color);
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.scissor = f->water;
    lom_begin_pass(r->device, &pass);
    lom_draw_lake(r->device, &lom_lake_shader, water, &view);
    return lom_end_pass(r->device);
}

/* The cheapest model: a blended quad of one colour. */
static bool draw_tinted(struct frame *f)
{
    lom_renderer *r = f->renderer;
    lom_lake_view view = lake_view(f);
    lom_add_step(f, "reflection", false, "tinted water reflects nothing");
    lom_add_step(f, "refraction", false, "tinted water is blended over the scene");
    lom_step *step = lom_add_step(f, "water", true, "a quad of one colour, blended over the scene");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->color);
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    lom_begin_pass(r->device, &pass);
    lom_draw_lake(r->device, &lom_lake_tinted_shader, &f->scene->water, &view);
    return lom_end_pass(r->device);
}

static bool skip_water(struct frame *f, const char *reason)
{
    static const char *const passes[] = { "reflection", "refraction", "water" };
    for (size_t i = 0; i < sizeof passes / sizeof passes[0]; i++)
        lom_add_step(f, passes[i], false, "%s", reason);
    return true;
}

bool lom_draw_lake_stage(struct frame *f, lom_error *error)
{
    const lom_water_params *water = &f->scene->water;
    if (water->given == 0)
        return skip_water(f, "the scene has no water");
    if (!water->enabled)
        return skip_water(f, "water.enabled is false");
    if (!is_in_view(f))
        return skip_water(f, "the water's quad is outside the view");
    if (f->scene->quality.water == LOM_WATER_TINTED)
        return draw_tinted(f);
    if (!draw_visibility(f, error))
        return false;
    if (f->water.width == 0)
        return skip_water(f, "the scene hides all of the water");
    return draw_reflection(f) && draw_refraction(f) && draw_surface(f);
}
