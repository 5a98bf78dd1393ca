/* A frame: the plan is made while it is drawn. In: a scene at a time. Out: the picture, and which passes were run or
 * left out and why. The table of stages below is the order of the frame; each stage is one function of a room.
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "pipeline/device.h"
#include "render/frame.h"
#include "render/wires/wires.h"

#include <assert.h>
#include <time.h>

static bool draw_opaque(struct frame *f, lom_error *error);

static const struct stage {
    bool (*run)(struct frame *f, lom_error *error);
    const char *name;
} stages[] = {
    { lom_prepare_lamps, "lamps" },    /* where each of them reaches */
    { lom_prepare_ground, "terrain" }, /* its levels of detail and its shadow */
    { lom_prepare_fluids, "liquid_shadow" },
    { lom_prepare_entities, "entity_shadow" },
    { lom_prepare_lamp_shadows, "lamp_shadow" },
    { lom_prepare_clouds, "cloud_light" },   /* their light */
    { lom_prepare_waters, "waves" },         /* the waves, and what they do to the light on what follows */
    { draw_opaque, "scene" },                /* terrain, entities and sky */
    { lom_draw_lakes, "lake" },              /* tinted or planar water over them */
    { lom_find_surfaces, "sea_waves" },      /* the waves of a sea where one is seen */
    { lom_draw_surfaces, "sea" },            /* or water with waves */
    { lom_draw_fluids, "fluid" },            /* liquids of particles over both */
    { lom_smooth_frame, "edges" },           /* the edges of all that, smoothed */
    { lom_draw_clouds, "clouds" },           /* clouds over all */
    { lom_draw_transparent, "transparent" }, /* what entities have that is transparent */
    { lom_draw_spray, "spray" },             /* drops, nearer than most clouds */
};

lom_pass_desc lom_frame_pass(const struct frame *f, lom_texture *color)
{
    return (lom_pass_desc){ .color = { color },
                            .depth = f->renderer->targets.of[LOM_TARGET_DEPTH],
                            .samples = f->scene->output.samples,
                            .per_sample = f->scene->output.sample_shading,
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
    struct lom_moment *moment = &f->renderer->moment;
    if (f->shown != NULL)
        moment->camera = lom_scene_view_camera_at(&moment->scene, f->shown, f->time);
    else if (f->desc->camera != NULL)
        moment->camera = *f->desc->camera;
    f->camera = moment->camera;
    f->view.projection = lom_camera_projection(&f->camera, (double)f->width / f->height);
    f->view.view = lom_camera_look(&f->camera);
    f->view.eye = lom_camera_eye(&f->camera);
    f->parallel = f->camera.projection != LOM_PROJECTION_PERSPECTIVE;
    f->view.plane[3] = 1;
    f->view.sky = true;
    f->view.pixels = 1;
}

struct lom_scene_view lom_view_of_side(const struct frame *f, double side)
{
    struct lom_scene_view view = f->view;
    const double level = f->divided_at, up = f->view.eye.y < level ? -side : side;
    if (!f->shows_water)
        return view;
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = up;
    view.plane[3] = -up * level;
    return view;
}

static bool draw_opaque(struct frame *f, lom_error *error)
{
    (void)error;
    lom_renderer *r = f->renderer;
    lom_step *step = lom_add_step(f, "scene", true, "terrain, entities and sky, from the camera%s%s",
                                  f->parallel ? ", by parallel rays" : "",
                                  lom_hides_below(f) ? "; nothing of them below the waves, which cover it" : "");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->targets.of[f->target]);
    pass.edges = f->smooths ? r->targets.of[LOM_TARGET_EDGES] : NULL;
    pass.label = "scene";
    const struct lom_window shown = lom_window_of(&f->crop, f->width, f->height);
    struct lom_scene_view part = f->view;
    part.window = &shown;
    lom_begin_pass(r->device, &pass);
    lom_draw_lid(f);
    lom_draw_scene(r, &part);
    return lom_end_pass(r->device) && lom_draw_wires(f);
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

/* The clock, and how much of it workers shared. */
struct moment {
    double milliseconds, shared;
};

static struct moment look_at_clock(const lom_renderer *r)
{
    return (struct moment){ milliseconds(), lom_device_shared_seconds(r->device) * 1e3 };
}

static lom_stage_time time_since(const lom_renderer *r, struct moment *before, const char *name)
{
    struct moment now = look_at_clock(r);
    double whole = now.milliseconds - before->milliseconds, alone = whole - (now.shared - before->shared);
    *before = now;
    return (lom_stage_time){ name, whole, alone > 0 ? alone : 0 };
}

static void add_time(lom_stage_time *sum, lom_stage_time time)
{
    sum->name = time.name;
    sum->milliseconds += time.milliseconds;
    sum->alone += time.alone;
}

static bool draw_stages(struct frame *f, lom_stage_time *times, lom_error *error)
{
    lom_renderer *r = f->renderer;
    if (!lom_make_targets(r, f->width, f->height, f->crop.width, f->crop.height, error))
        return false;
    bool done = true;
    r->targets.asked = f->asked;
    struct moment before = look_at_clock(r);
    const size_t count = sizeof stages / sizeof stages[0];
    for (size_t i = 0; done && i < count; i++) {
        f->done = (double)i / (double)(count + 1);
        done = stages[i].run(f, error);
        done = lom_check_device(r->device, error) && done;
        add_time(&times[i], time_since(r, &before, stages[i].name));
    }
    lom_turn_to_water(f, 0);
    f->done = (double)count / (double)(count + 1);
    lom_report_progress(f, "output");
    return done;
}

static const lom_frame_desc defaults = { .frame = 0 };

bool lom_check_frame(const lom_scene *scene, const lom_frame_desc *desc, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    bool drawable =
        lom_find_frame_sizes(&(struct frame){ .scene = scene, .desc = desc != NULL ? desc : &defaults }, error);
    lom_leave_float_state(&state);
    return drawable;
}

/* The picture, as an image or in the caller's memory. */
static bool put_out(struct frame *f, bool drawn, lom_image *traced, lom_frame *out, lom_error *error)
{
    const lom_frame_desc *desc = f->desc;
    const struct lom_targets *targets = &f->renderer->targets;
    if (!drawn && traced == NULL)
        return false;
    if (desc->pixels == NULL) {
        out->image = drawn ? lom_output_target(f->scene, f->renderer->device, targets, error)
                           : lom_output_image(f->scene, traced, error);
        return out->image != NULL;
    }
    if (!drawn)
        return lom_output_traced(f->scene, traced, desc->order, desc->pixels, desc->pitch, error);
    lom_output_rows(f->scene, f->renderer->device, targets, desc->order, desc->pixels, desc->pitch);
    return true;
}

static void exchange_pixels(uint8_t *a, uint8_t *b, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++) {
        const uint8_t kept = a[i];
        a[i] = b[i];
        b[i] = kept;
    }
}

/* The last pixel of each row comes first. */
static void mirror_rows(struct frame *f, lom_frame *out)
{
    const lom_frame_desc *desc = f->desc;
    const size_t pixel = lom_pixel_bytes(f->scene, out->image != NULL ? LOM_ORDER_OUTPUT : desc->order);
    const size_t width = (size_t)f->asked.width, pitch = out->image != NULL ? width * pixel : desc->pitch;
    uint8_t *row = out->image != NULL ? out->image->pixels : desc->pixels;
    for (int y = 0; y < f->asked.height; y++, row += pitch)
        for (size_t x = 0; x < width / 2; x++)
            exchange_pixels(row + x * pixel, row + (width - 1 - x) * pixel, pixel);
}

/* A renderer whose frame was abandoned goes on with the next one; a run of impostors begins anew. */
static void leave_abandoned(struct frame *f)
{
    lom_resume_passes(f->renderer->device);
    lom_end_impostor_run(f->renderer);
}

static uint64_t steps_of(const lom_renderer *renderer)
{
    return renderer->waters[0].waves != NULL ? lom_wave_steps(renderer->waters[0].waves) : 0;
}

static bool draw_frame(struct frame *f, lom_frame *out, lom_error *error)
{
    lom_renderer *renderer = f->renderer;
    f->wave_steps = steps_of(renderer);
    lom_error failed = { 0 };
    const bool placed = lom_world_at(renderer->world, f->time, &renderer->moment, &failed);
    if (placed)
        look(f);
    lom_image *traced = placed && renderer->reference != NULL ? lom_draw_reference(f, &failed) : NULL;
    bool drawn = placed && renderer->reference == NULL && draw_stages(f, out->stage, &failed);
    struct moment start = look_at_clock(renderer);
    const bool whole = lom_check_device(renderer->device, &failed); /* and not abandoned */
    bool done = whole && put_out(f, drawn, traced, out, &failed);
    if (done && f->shown != NULL && f->shown->mirrored)
        mirror_rows(f, out);
    if (drawn || traced != NULL)
        add_time(&out->stage[sizeof stages / sizeof stages[0]], time_since(renderer, &start, "output"));
    if (!whole)
        lom_free_image(traced);
    if (f->abandoned)
        leave_abandoned(f);
    assert(done == (failed.code == LOM_OK)); /* no failure is dropped on the way, none without a word */
    return lom_pass_error(&failed, error);
}

bool lom_draw_part(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error)
{
    lom_spray_counters spray = { .moved = 0 };
    struct frame f = { .renderer = renderer,
                       .scene = renderer->scene,
                       .plan = &out->plan,
                       .desc = desc,
                       .number = desc->frame,
                       .time = desc->has_time ? desc->time : desc->frame / renderer->scene->output.fps,
                       .impostors = &out->impostors,
                       .spray = &spray };
    bool drawn = lom_find_frame_sizes(&f, error);
    if (drawn) {
        lom_begin_edges(&f);
        drawn = draw_frame(&f, out, error);
    }
    out->spray.moved += spray.moved;
    out->spray.drawn += spray.drawn;
    return drawn;
}

bool lom_render_frame(lom_renderer *renderer, const lom_frame_desc *desc, lom_frame *out, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state); /* before the sizes and the time, which are computed too */
    desc = desc != NULL ? desc : &defaults;
    const lom_counters before = lom_device_counters(renderer->device);
    const uint64_t steps = steps_of(renderer), fluid_steps = renderer->fluids.run;
    *out = (lom_frame){ .image = NULL };
    lom_enter_pool(renderer->device->pool);
    bool drawn = lom_has_views(renderer->scene, desc) ? lom_draw_views(renderer, desc, out, error)
                                                      : lom_draw_part(renderer, desc, out, error);
    lom_leave_pool(renderer->device->pool);
    out->shallow_steps = steps_of(renderer) - steps;
    out->fluid_steps = renderer->fluids.run - fluid_steps;
    out->counters = subtract(lom_device_counters(renderer->device), before);
    lom_leave_float_state(&state);
    return drawn;
}
