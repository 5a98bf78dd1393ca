/* A frame: the plan is made while it is drawn. In: a scene at a time. Out: the picture, and which passes were run or
 * left out and why. The table of stages below is the order of the frame; each stage is one function (frame.h).
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "render/frame.h"

#include "base/cpu.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <time.h>

static bool draw_opaque(struct frame *f, lom_error *error);

static const struct stage {
    bool (*run)(struct frame *f, lom_error *error);
    const char *name;
} stages[] = {
    { lom_prepare_ground, "terrain" }, /* its levels of detail and its shadow */
    { lom_prepare_entities, "entity_shadow" },
    { lom_prepare_clouds, "cloud_light" }, /* their light */
    { lom_prepare_water, "waves" },        /* the waves, and what they do to the light on what follows */
    { draw_opaque, "scene" },              /* terrain, entities and sky */
    { lom_draw_lake, "lake" },             /* tinted or planar water over them */
    { lom_find_sea, "sea_waves" },         /* the waves of a sea where one is seen */
    { lom_draw_sea, "sea" },               /* or water with waves */
    { lom_draw_clouds, "clouds" },         /* clouds over all */
    { lom_draw_spray, "spray" },           /* drops, nearer than most clouds */
};

static void report(const struct frame *f, const char *pass)
{
    if (f->desc->progress != NULL)
        f->desc->progress(f->desc->progress_context, pass, f->done);
}

lom_step *lom_add_step(struct frame *f, const char *name, bool runs, const char *format, ...)
{
    lom_plan *plan = f->plan;
    int last = plan->count < LOM_MAX_STEPS ? plan->count : LOM_MAX_STEPS - 1;
    lom_step *step = &plan->step[last];
    va_list arguments;
    plan->count = last + 1;
    *step = (lom_step){ .runs = runs };
    snprintf(step->name, sizeof step->name, "%s", name);
    va_start(arguments, format);
    vsnprintf(step->text, sizeof step->text, format, arguments);
    va_end(arguments);
    if (runs)
        report(f, name);
    return step;
}

lom_pass_desc lom_frame_pass(const struct frame *f, lom_texture *color)
{
    return (lom_pass_desc){ .color = { color },
                            .depth = f->renderer->targets.of[LOM_TARGET_DEPTH],
                            .frame_width = f->width,
                            .frame_height = f->height,
                            .origin_x = f->crop.x,
                            .origin_y = f->crop.y };
}

bool lom_draw_pass(lom_device *device, const lom_pass_desc *pass, const lom_draw_desc *draws, size_t count)
{
    lom_begin_pass(device, pass);
    for (size_t i = 0; i < count; i++)
        lom_draw(device, &draws[i]);
    return lom_end_pass(device);
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

static bool draw_opaque(struct frame *f, lom_error *error)
{
    (void)error;
    lom_renderer *r = f->renderer;
    lom_step *step = lom_add_step(f, "scene", true, "terrain, entities and sky, from the camera");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->targets.of[LOM_TARGET_COLOR]);
    lom_begin_pass(r->device, &pass);
    lom_draw_scene(r, &f->view);
    return lom_end_pass(r->device);
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
                           a.tiles - b.tiles,
                           a.transforms - b.transforms };
}

static double milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

/* What the stages draw, read back. */
static lom_image *draw_stages(struct frame *f, lom_stage_time *times, lom_error *error)
{
    lom_renderer *r = f->renderer;
    if (!lom_make_targets(r, f->width, f->height, f->crop.width, f->crop.height, error))
        return NULL;
    bool done = true;
    double before = milliseconds();
    const size_t count = sizeof stages / sizeof stages[0];
    for (size_t i = 0; done && i < count; i++) {
        f->done = (double)i / (double)(count + 1);
        done = stages[i].run(f, error);
        done = lom_check_device(r->device, error) && done;
        double now = milliseconds();
        times[i] = (lom_stage_time){ stages[i].name, now - before };
        before = now;
    }
    f->done = (double)count / (double)(count + 1);
    report(f, "output");
    return done ? lom_read_texture(r->targets.of[LOM_TARGET_COLOR], 0, 0, error) : NULL;
}

static const lom_frame_desc defaults = { .frame = 0 };

/* The picture is read back with alpha as one image, and those have a limit. */
static bool check_picture(const struct frame *f, lom_error *error)
{
    uint64_t pixel = f->scene->output.format == LOM_OUTPUT_RGB8 ? 4 : 16;
    return (uint64_t)f->crop.width * (uint64_t)f->crop.height * pixel <= LOM_MAX_IMAGE_BYTES ||
           lom_fail(error, LOM_ERROR_LIMIT,
                    "A picture of %d x %d pixels, %d bytes each while it is drawn, is larger than the limit of 2^31 "
                    "bytes an image: draw it in parts, each a crop (--crop X,Y,W,H) of the whole frame.",
                    f->crop.width, f->crop.height, (int)pixel);
}

static bool check_memory(const struct frame *f, lom_error *error)
{
    static const double gib = 1024.0 * 1024 * 1024;
    double taken = (double)lom_target_bytes(f->scene, f->width, f->height, f->crop.width, f->crop.height) / gib;
    double limit = f->desc->memory > 0 ? f->desc->memory : (double)lom_machine_memory() / gib;
    return limit == 0 || taken <= limit ||
           lom_fail(
               error, LOM_ERROR_LIMIT,
               "The targets of a frame of %d x %d pixels take %.3g GiB at least, more than the limit of %.3g GiB (%s): "
               "draw it smaller or in parts (--crop), lower quality.reflection_scale and refraction_scale, or "
               "raise the limit (--memory GIB).",
               f->width, f->height, taken, limit, f->desc->memory > 0 ? "as asked for" : "this machine's memory");
}

/* Beyond it, doubles no longer hold a time to a ten-millionth of a second. */
static bool check_time(const struct frame *f, lom_error *error)
{
    static const double most = 1e9;
    double fps = f->scene->output.fps, time = f->desc->frame / fps;
    return (time >= -most && time <= most) ||
           lom_fail(error, LOM_ERROR_LIMIT,
                    "Frame %d is not within 1e9 seconds of the first at %g a second (output.fps).", f->desc->frame,
                    fps);
}

static bool find_sizes(struct frame *f, lom_error *error)
{
    const lom_frame_desc *desc = f->desc;
    f->width = desc->width != 0 ? desc->width : f->scene->output.width;
    f->height = desc->height != 0 ? desc->height : f->scene->output.height;
    f->crop = desc->crop.width != 0 ? desc->crop : (lom_rect){ 0, 0, f->width, f->height };
    if (f->width < 1 || f->height < 1 || f->width > LOM_MAX_SIZE || f->height > LOM_MAX_SIZE || f->crop.x < 0 ||
        f->crop.y < 0 || f->crop.width < 1 || f->crop.height < 1 || f->crop.x > f->width - f->crop.width ||
        f->crop.y > f->height - f->crop.height)
        return lom_fail(error, LOM_ERROR_USAGE, "The crop %d,%d,%d,%d does not lie inside the frame of %dx%d pixels.",
                        f->crop.x, f->crop.y, f->crop.width, f->crop.height, f->width, f->height);
    return check_time(f, error) && check_picture(f, error) && check_memory(f, error);
}

bool lom_check_frame(const lom_scene *scene, const lom_frame_desc *desc, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    bool drawable = find_sizes(&(struct frame){ .scene = scene, .desc = desc != NULL ? desc : &defaults }, error);
    lom_leave_float_state(&state);
    return drawable;
}

static bool draw_frame(struct frame *f, lom_frame *out, lom_error *error)
{
    lom_renderer *renderer = f->renderer;
    lom_counters before = lom_device_counters(renderer->device);
    f->wave_steps = renderer->water.waves != NULL ? lom_wave_steps(renderer->water.waves) : 0;
    renderer->moment.light = lom_scene_light_at(&renderer->moment, f->time);
    lom_move_entities(renderer, f->time);
    look(f);
    lom_error failed = { 0 };
    lom_image *drawn =
        renderer->reference != NULL ? lom_draw_reference(f, &failed) : draw_stages(f, out->stage, &failed);
    double start = milliseconds();
    out->image = lom_output_image(f->scene, drawn, &failed);
    if (drawn != NULL)
        out->stage[sizeof stages / sizeof stages[0]] = (lom_stage_time){ "output", milliseconds() - start };
    out->shallow_steps = renderer->water.waves != NULL ? lom_wave_steps(renderer->water.waves) - f->wave_steps : 0;
    out->counters = subtract(lom_device_counters(renderer->device), before);
    assert((out->image != NULL) == (failed.code == LOM_OK)); /* no failure is dropped on the way, none without a word */
    return lom_pass_error(&failed, error);
}

bool lom_render_frame(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state); /* before the sizes and the time, which are computed too */
    desc = desc != NULL ? desc : &defaults;
    struct frame f = { .renderer = renderer,
                       .scene = renderer->scene,
                       .plan = &out->plan,
                       .desc = desc,
                       .number = desc->frame,
                       .time = desc->frame / renderer->scene->output.fps,
                       .impostors = &out->impostors,
                       .spray = &out->spray };
    *out = (lom_frame){ .image = NULL };
    bool drawn = find_sizes(&f, error) && draw_frame(&f, out, error);
    lom_leave_float_state(&state);
    return drawn;
}
