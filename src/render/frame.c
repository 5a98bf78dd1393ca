/* A frame: the plan is made while it is drawn. In: a scene at a time. Out: the picture, and which passes were run or
 * left out and why.
 *
 *   scene -> visibility (where is water?) -> reflection, refraction (only there) -> water over the scene
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "render/renderer.h"
#include "sky/sky_draw.h"
#include "water/lake.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct frame {
    lom_renderer *renderer;
    const lom_scene *scene;
    int width, height;
    lom_rect crop;
    double time;
    lom_camera_view camera;
    struct lom_scene_view view;
    lom_rect water; /* where the surface is seen, in frame pixels; width 0: nowhere */
    lom_plan *plan;
};

static lom_step *add_step(struct frame *f, const char *name, bool runs, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static lom_step *add_step(struct frame *f, const char *name, bool runs, const char *format, ...)
{
    lom_step *step = &f->plan->step[f->plan->count++];
    va_list arguments;
    *step = (lom_step){ .runs = runs };
    snprintf(step->name, sizeof step->name, "%s", name);
    va_start(arguments, format);
    vsnprintf(step->text, sizeof step->text, format, arguments);
    va_end(arguments);
    return step;
}

static void look(struct frame *f)
{
    f->camera = lom_scene_camera_at(f->scene, f->time);
    f->view.projection = lom_perspective(f->camera.field_of_view, (double)f->width / f->height, f->camera.near_plane);
    f->view.view = lom_look_at(f->camera.position, f->camera.target, f->camera.up);
    f->view.eye = f->camera.position;
    f->view.plane[3] = 1;
    f->view.sky = true;
}

static bool draw_opaque(struct frame *f)
{
    lom_renderer *r = f->renderer;
    lom_step *step = add_step(f, "scene", true, "terrain, entities and sky, from the camera");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_begin_pass(r->device, &(lom_pass_desc){ .color = { r->color },
                                                .depth = r->depth,
                                                .frame_width = f->width,
                                                .frame_height = f->height,
                                                .origin_x = f->crop.x,
                                                .origin_y = f->crop.y });
    lom_draw_scene(r, &f->view);
    return lom_end_pass(r->device);
}

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
    lom_step *step = add_step(f, "visibility", true, "which pixels show the water's surface");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_begin_pass(r->device, &(lom_pass_desc){ .color = { r->mask },
                                                .depth = r->depth,
                                                .depth_load = LOM_LOAD_KEEP,
                                                .frame_width = f->width,
                                                .frame_height = f->height,
                                                .origin_x = f->crop.x,
                                                .origin_y = f->crop.y });
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
        add_step(f, "reflection", false, "water.reflection is off");
        return true;
    }
    view.view = lom_multiply(&f->view.view, &mirror);
    view.eye.y = 2 * water->level - f->view.eye.y;
    view.mirrored = true;
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = 1;
    view.plane[3] = water->clip_offset - water->level;
    lom_step *step =
        add_step(f, "reflection", true, "terrain, entities and sky above the water, mirrored in its plane");
    return draw_picture(f, step, f->renderer->reflection, f->renderer->reflection_depth, &view);
}

/* Step 2: the scene below the plane (plus the offset), with its depth. */
static bool draw_refraction(struct frame *f)
{
    const lom_water_params *water = &f->scene->water;
    struct lom_scene_view view = f->view;
    if (!water->refraction && !water->soft_shore && !water->specular) {
        add_step(f, "refraction", false, "water.refraction and everything that reads its depth are off");
        return true;
    }
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = -1;
    view.plane[3] = water->level + water->clip_offset;
    view.sky = false;
    lom_step *step = add_step(f, "refraction", true, "terrain and entities below the water, with their depth");
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
    lom_step *step = add_step(f, "water", true, "the surface over the scene, from the pictures above and below it");
    step->width = f->crop.width;
    step->height = f->crop.height;
    step->scissor = f->water;
    lom_begin_pass(r->device, &(lom_pass_desc){ .color = { r->color },
                                                .depth = r->depth,
                                                .color_load = { LOM_LOAD_KEEP },
                                                .depth_load = LOM_LOAD_KEEP,
                                                .scissor = f->water,
                                                .frame_width = f->width,
                                                .frame_height = f->height,
                                                .origin_x = f->crop.x,
                                                .origin_y = f->crop.y });
    lom_draw_lake(r->device, &lom_lake_shader, water, &view);
    return lom_end_pass(r->device);
}

static bool skip_water(struct frame *f, const char *reason)
{
    static const char *const passes[] = { "reflection", "refraction", "water" };
    for (size_t i = 0; i < sizeof passes / sizeof passes[0]; i++)
        add_step(f, passes[i], false, "%s", reason);
    return true;
}

static bool draw_water(struct frame *f, lom_error *error)
{
    const lom_water_params *water = &f->scene->water;
    if (water->given == 0)
        return skip_water(f, "the scene has no water");
    if (!water->enabled)
        return skip_water(f, "water.enabled is false");
    if (!is_in_view(f))
        return skip_water(f, "the water's quad is outside the view");
    if (!draw_visibility(f, error))
        return false;
    if (f->water.width == 0)
        return skip_water(f, "the scene hides all of the water");
    return draw_reflection(f) && draw_refraction(f) && draw_surface(f);
}

static lom_counters subtract(lom_counters a, lom_counters b)
{
    return (lom_counters){ a.passes - b.passes,
                           a.draws - b.draws,
                           a.vertices - b.vertices,
                           a.triangles - b.triangles,
                           a.triangles_clipped - b.triangles_clipped,
                           a.triangles_binned - b.triangles_binned,
                           a.fragments - b.fragments,
                           a.packets - b.packets,
                           a.tiles - b.tiles };
}

static bool draw_frame(struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    if (!lom_make_targets(r, f->width, f->height, f->crop.width, f->crop.height, error))
        return false;
    if (draw_opaque(f) && draw_water(f, error))
        return true;
    const lom_error *failed = lom_device_error(r->device);
    return lom_fail(error, failed->code, "%s", failed->text);
}

bool lom_render_frame(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    struct frame f = { .renderer = renderer, .scene = scene, .plan = &out->plan };
    *out = (lom_frame){ .image = NULL };
    f.width = desc->width != 0 ? desc->width : scene->output.width;
    f.height = desc->height != 0 ? desc->height : scene->output.height;
    f.crop = desc->crop.width != 0 ? desc->crop : (lom_rect){ 0, 0, f.width, f.height };
    f.time = desc->frame / scene->output.fps;
    if (f.width < 1 || f.height < 1 || f.width > LOM_MAX_SIZE || f.height > LOM_MAX_SIZE || f.crop.x < 0 ||
        f.crop.y < 0 || f.crop.width < 1 || f.crop.height < 1 || f.crop.x > f.width - f.crop.width ||
        f.crop.y > f.height - f.crop.height)
        return lom_fail(error, LOM_ERROR_USAGE, "The crop %d,%d,%d,%d does not lie inside the frame of %dx%d pixels.",
                        f.crop.x, f.crop.y, f.crop.width, f.crop.height, f.width, f.height);
    lom_counters before = lom_device_counters(renderer->device);
    lom_float_state state;
    lom_enter_float_state(&state);
    look(&f);
    if (draw_frame(&f, error))
        out->image = lom_output_image(renderer, error);
    lom_leave_float_state(&state);
    out->counters = subtract(lom_device_counters(renderer->device), before);
    return out->image != NULL;
}
