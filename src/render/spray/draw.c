/* The drops of a frame. In: the frame whose scene, water and clouds are drawn. Out: all emitters' drops over them, in
 * one order, the farthest first. Drops are laid over one another in floats, in a picture of their own that then is laid
 * over the frame: thousands of faint ones would vanish in the rounding of 8 bits. Invariant: a drop that is out of
 * view, hidden or clear changes no byte. */
#include "pipeline/share_work.h"
#include "render/frame.h"
#include "shading/square.h"

static bool is_in_view(const lom_spray *spray, const lom_emitter *emitter, const struct lom_hits *hits,
                       const lom_frustum *frustum)
{
    double low[3], high[3], speed = 0;
    if (hits != NULL)
        lom_bound_hits(hits, emitter, spray->kick, low, high);
    else
        lom_bound_emitter(emitter, low, high);
    for (int i = 0; i < 3; i++)
        speed += (high[i] - low[i]) / emitter->life; /* a mean; drag and gravity change a speed by no more than that */
    double radius = spray->size[0] > spray->size[1] ? spray->size[0] : spray->size[1];
    double reach = 2 * radius + spray->stretch * (2 * speed + 9.80665 * emitter->life);
    lom_box box = { { low[0] - reach, low[1] - reach, low[2] - reach },
                    { high[0] + reach, high[1] + reach, high[2] + reach } };
    return lom_box_visibility(frustum, box) != LOM_OUTSIDE;
}

/* An emitter's drops on their way into sprites, by all workers. */
struct moving {
    const lom_spray *spray;
    const lom_emitter *emitter;
    const struct lom_spray_view *view;
    double time;
    const float *state;          /* of drops that bounce; NULL: they fly freely */
    const struct lom_hits *hits; /* where they begin; NULL: on the segment */
    struct lom_sprite *sprites;
    float *depth;
    struct lom_sprite_reach *reach; /* of each piece */
};

static void take_states(const struct moving *m, size_t first, size_t end, lom_particle *particles)
{
    lom_birth_range(m->emitter, m->time, first, end, particles);
    for (size_t i = first; i < end; i++)
        for (int k = 0; k < 3; k++) {
            const float *state = m->state + i * LOM_BOUNCE_FLOATS;
            particles[i - first].place[k] = m->emitter->from[k] + (double)state[LOM_BOUNCE_PLACE + k];
            particles[i - first].velocity[k] = (double)state[LOM_BOUNCE_VELOCITY + k];
        }
}

static void move_piece(void *context, size_t first, size_t end)
{
    const struct moving *m = context;
    lom_particle particles[LOM_DROPS_TOGETHER];
    if (m->hits != NULL)
        lom_place_hits(m->hits, m->emitter, m->spray->kick, m->time, first, end, particles);
    else if (m->state == NULL)
        lom_place_range(m->emitter, m->time, first, end, particles);
    else
        take_states(m, first, end, particles);
    m->reach[first / LOM_DROPS_TOGETHER] =
        lom_make_sprites(m->spray, m->view, particles, end - first, m->sprites + first, m->depth + first);
}

/* Moves the drops of the emitters that may be seen, and makes sprites of those that are. */
static bool move_drops(struct frame *f, const struct lom_spray_view *view, struct lom_sprite_reach *reach,
                       lom_error *error)
{
    const lom_scene *scene = f->scene;
    struct lom_drawn_spray *m = &f->renderer->spray;
    lom_mat4 clip = lom_multiply(&view->projection, &view->view);
    lom_frustum frustum = lom_view_frustum(&clip, false);
    size_t moved = 0;
    for (size_t i = 0; i < scene->spray_count; i++) {
        const lom_spray *spray = &scene->sprays[i];
        lom_emitter emitter = lom_spray_emitter(spray);
        if (m->hits != NULL)
            m->hits[i].scene = scene;
        const struct lom_hits *hits = spray->source != LOM_SPRAY_SEGMENT && m->hits != NULL ? &m->hits[i] : NULL;
        if (!spray->visible || emitter.count == 0 || (hits != NULL && hits->count == 0) ||
            (spray->bounce == 0 && !is_in_view(spray, &emitter, hits, &frustum)))
            continue;
        if (!lom_check_emitter(&emitter, f->time, error))
            return false;
        if (spray->bounce > 0 && !lom_bounce_drops(f, spray, &emitter))
            return false;
        struct moving moving = { .spray = spray,
                                 .emitter = &emitter,
                                 .view = view,
                                 .time = f->time,
                                 .state = spray->bounce > 0 ? m->state[0] : NULL,
                                 .hits = hits,
                                 .sprites = m->sprites + moved,
                                 .depth = m->depth + moved,
                                 .reach = m->reaches };
        lom_share_work(f->renderer->device, emitter.count, LOM_DROPS_TOGETHER, move_piece, &moving);
        for (size_t piece = 0; piece * LOM_DROPS_TOGETHER < emitter.count; piece++)
            *reach = lom_join_reaches(*reach, m->reaches[piece]);
        moved += emitter.count;
    }
    f->spray->moved = moved;
    f->spray->drawn = reach->seen;
    return true;
}

static int pixel(double ndc, int size, int margin)
{
    double at = lom_double_floor((0.5 + 0.5 * ndc) * size) + margin;
    return at < 0 ? 0 : at > size ? size : lom_int_of(at);
}

/* The pixels that sprites reach. */
static lom_rect reach_of(const struct frame *f, const struct lom_sprite_reach *sprites)
{
    if (!f->scene->quality.scissor)
        return (lom_rect){ 0, 0, f->width, f->height };
    int x0 = pixel(sprites->low[0], f->width, -1), x1 = pixel(sprites->high[0], f->width, 2);
    int y0 = pixel(-sprites->high[1], f->height, -1), y1 = pixel(-sprites->low[1], f->height, 2);
    return (lom_rect){ x0, y0, x1 > x0 ? x1 - x0 : 1, y1 > y0 ? y1 - y0 : 1 };
}

static struct lom_spray_uniforms uniforms_of(const struct frame *f, const struct lom_spray_view *view)
{
    const lom_renderer *r = f->renderer;
    struct lom_spray_uniforms u = { .light = lom_renderer_light(r, view->eye),
                                    .haze = lom_scene_haze(f->scene, view->eye.y, false),
                                    .eye = lom_find_eye(&view->projection, &view->view, 0),
                                    .sprites = r->spray.sprites[0].middle };
    lom_mat4 clip = lom_clip_from_offset(&view->projection, &view->view);
    u.clip_from_offset = lom_round_matrix(&clip);
    return u;
}

static bool draw_sprites(struct frame *f, const struct lom_spray_view *view, const struct lom_sprite_reach *sprites)
{
    lom_renderer *r = f->renderer;
    lom_rect reach = reach_of(f, sprites);
    struct lom_spray_uniforms u = uniforms_of(f, view);
    lom_step *step = lom_add_step(f, "spray", true, "%zu drops of %llu, the farthest first, then over the frame",
                                  sprites->seen, (unsigned long long)f->spray->moved);
    step->width = f->crop.width;
    step->height = f->crop.height;
    step->scissor = reach;
    lom_order_particles(r->spray.depth, f->spray->moved, r->spray.order, r->spray.scratch); /* the seen ones first */
    lom_pass_desc pass = lom_frame_pass(f, r->targets.of[LOM_TARGET_SPRAY]);
    pass.depth_load = LOM_LOAD_KEEP;
    pass.scissor = reach;
    pass.label = "drops";
    const lom_draw_desc draw = { .shader = &lom_spray_shader,
                                 .uniforms = &u,
                                 .indices = r->spray.order,
                                 .count = sprites->seen,
                                 .vertex_count = f->spray->moved,
                                 .topology = LOM_SPRITES,
                                 .depth_write_off = true,
                                 .blend = { lom_blend_over } };
    if (!lom_draw_pass(r->device, &pass, &draw, 1))
        return false;
    struct lom_spray_layer_uniforms layer = { { (float)f->crop.x, (float)f->crop.y }, r->targets.of[LOM_TARGET_SPRAY] };
    pass = lom_frame_pass(f, r->targets.of[f->target]);
    pass.depth = NULL;
    pass.color_load[0] = LOM_LOAD_KEEP;
    pass.scissor = reach;
    pass.label = "spray";
    lom_begin_pass(r->device, &pass);
    lom_draw_square(r->device, &lom_spray_layer_shader, &layer, &lom_blend_over);
    return lom_end_pass(r->device);
}

static const char *reason_without(const struct frame *f)
{
    const lom_scene *scene = f->scene;
    if (scene->spray_count == 0)
        return "the scene has no emitter";
    if (!scene->quality.spray)
        return "quality.spray is off";
    if (f->renderer->spray.capacity == 0)
        return "no emitter that is visible has a drop";
    return f->below ? "the eye is under water" : NULL;
}

bool lom_draw_spray(struct frame *f, lom_error *error)
{
    const char *reason = reason_without(f);
    if (reason != NULL) {
        lom_add_step(f, "spray", false, "%s", reason);
        return true;
    }
    const lom_vec3 to_light = f->renderer->moment.to_light;
    struct lom_spray_view view = { .projection = f->view.projection,
                                   .view = f->view.view,
                                   .rays = lom_find_view_rays(&f->view.projection, &f->view.view),
                                   .eye = f->view.eye,
                                   .near_plane = f->camera.near_plane,
                                   .width = f->width,
                                   .height = f->height,
                                   .to_light = { to_light.x, to_light.y, to_light.z } };
    struct lom_sprite_reach sprites = { .seen = 0, .low = { 1, 1 }, .high = { -1, -1 } };
    if (!move_drops(f, &view, &sprites, error))
        return false;
    if (sprites.seen != 0)
        return draw_sprites(f, &view, &sprites);
    lom_add_step(f, "spray", false, f->spray->moved != 0 ? "none of %llu drops is in view" : "no emitter is in view",
                 (unsigned long long)f->spray->moved);
    return true;
}
