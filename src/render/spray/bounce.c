/* Drops that bounce, of an emitter at the frame's time. In: their births. Out: their states, stepped by feedback from one
 * buffer into the other. Each frame steps every drop from its birth on, so that any frame alone is that of a run; it costs
 * life / LOM_BOUNCE_STEP passes. */
#include "pipeline/share_work.h"
#include "render/frame.h"

#include <lom/stages.h>

struct births {
    const lom_emitter *emitter;
    double time;
    float *state;
};

static void start_piece(void *context, size_t first, size_t end)
{
    const struct births *b = context;
    lom_particle particles[LOM_DROPS_TOGETHER];
    lom_birth_range(b->emitter, b->time, first, end, particles);
    for (size_t i = first; i < end; i++) {
        const lom_particle *p = &particles[i - first];
        float *state = b->state + i * LOM_BOUNCE_FLOATS;
        for (int k = 0; k < 3; k++) {
            state[LOM_BOUNCE_PLACE + k] = (float)(p->place[k] - b->emitter->from[k]);
            state[LOM_BOUNCE_VELOCITY + k] = (float)p->velocity[k];
        }
        state[LOM_BOUNCE_LEFT] = (float)(p->share * b->emitter->life);
    }
}

static struct lom_bounce_uniforms uniforms_of(const struct frame *f, const lom_spray *spray)
{
    const lom_terrain *t = &f->scene->terrain;
    const lom_renderer *r = f->renderer;
    const struct lom_ground *ground = &r->ground;
    struct lom_bounce_uniforms u = { .step = LOM_BOUNCE_STEP,
                                     .drag = (float)spray->drag,
                                     .bounce = (float)spray->bounce,
                                     .level = (float)-spray->from[1] };
    for (int i = 0; i < 3; i++)
        u.wind[i] = (float)spray->wind[i];
    if (ground->blocks == NULL)
        return u;
    u.heights = ground->heights;
    u.columns = ground->columns;
    u.rows = ground->rows;
    u.level = (float)(t->base - spray->from[1]);
    const int quads[2] = { ground->columns, ground->rows };
    for (int i = 0; i < 2; i++) {
        u.corner[i] = (float)(-t->size[i] / 2 - spray->from[2 * i]);
        u.scale[i] = (float)(quads[i] / t->size[i]);
    }
    return u;
}

bool lom_bounce_drops(struct frame *f, const lom_spray *spray, const lom_emitter *emitter)
{
    enum { STRIDE = LOM_BOUNCE_FLOATS * sizeof(float) };
    struct lom_drawn_spray *m = &f->renderer->spray;
    lom_device *device = f->renderer->device;
    struct births births = { emitter, f->time, m->state[0] };
    struct lom_bounce_uniforms u = uniforms_of(f, spray);
    size_t bytes = emitter->count * STRIDE, steps = lom_count_of(emitter->life / (double)LOM_BOUNCE_STEP, SIZE_MAX) + 1;
    lom_share_work(device, emitter->count, LOM_DROPS_TOGETHER, start_piece, &births);
    lom_add_step(f, "spray steps", true, "%zu passes for feedback of %zu drops that bounce", steps, emitter->count);
    for (size_t i = 0; i < steps; i++) {
        const float *from = m->state[0];
        lom_feedback kept = { .data = m->state[1], .size = bytes, .varyings = LOM_VARYINGS(0, LOM_BOUNCE_FLOATS) };
        lom_begin_pass(device, &(lom_pass_desc){ .feedback_only = true, .label = "drops that bounce" });
        lom_draw(device, &(lom_draw_desc){
                             .shader = &lom_bounce_shader,
                             .uniforms = &u,
                             .attribute = { { from, bytes, STRIDE, LOM_ATTRIBUTE_FLOAT4 },
                                            { from + LOM_BOUNCE_VELOCITY, bytes - 16, STRIDE, LOM_ATTRIBUTE_FLOAT3 } },
                             .count = emitter->count,
                             .topology = LOM_POINTS,
                             .feedback = &kept });
        if (!lom_end_pass(device))
            return false;
        float *swap = m->state[0];
        m->state[0] = m->state[1];
        m->state[1] = swap;
    }
    return true;
}
