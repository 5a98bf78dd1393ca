/* Liquids of a scene. In: the scene. Out: each before its first step; and, once a frame, at the frame's time. */
#include "render/frame.h"

size_t lom_count_fluids(const lom_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->fluid_count; i++)
        count += lom_shows_liquid(scene, i);
    return count;
}

lom_box lom_fluid_box(const lom_fluid_params *p)
{
    return (lom_box){ { p->low[0], p->low[1], p->low[2] }, { p->high[0], p->high[1], p->high[2] } };
}

bool lom_load_fluids(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    struct lom_drawn_fluids *m = &renderer->fluids;
    m->items = lom_allocate(scene->fluid_count, sizeof *m->items, error);
    m->count = m->items != NULL ? scene->fluid_count : 0;
    for (size_t i = 0; i < m->count; i++)
        if (lom_shows_liquid(scene, i) &&
            (m->items[i].liquid.fluid = lom_begin_liquid(renderer->world, i, error)) == NULL)
            return false;
    return m->items != NULL;
}

void lom_free_fluids(lom_renderer *renderer)
{
    struct lom_drawn_fluids *m = &renderer->fluids;
    for (size_t i = 0; i < m->count; i++)
        lom_free_liquid(&m->items[i].liquid);
    lom_release(m->items);
    lom_drop_fluid_shadow(renderer);
}

bool lom_ready_fluid(struct frame *f, size_t number, lom_error *error)
{
    lom_renderer *r = f->renderer;
    struct lom_drawn_fluid *it = &r->fluids.items[number];
    const uint64_t before = it->liquid.run;
    if (it->ready)
        return true;
    const bool done = lom_run_liquid(&it->liquid, r->world, number, r->device, f->time, error);
    r->fluids.run += it->liquid.run - before;
    if (!done)
        return false;
    it->ready = true;
    const lom_fluid_view view = lom_view_fluid(it->liquid.fluid);
    lom_add_step(f, "fluid steps", true,
                 "%lld steps from the beginning, %llu of them for this frame; %zu particles, %zu triangles",
                 (long long)view.steps, (unsigned long long)(it->liquid.run - before), view.particles,
                 it->liquid.mesh->index_count / 3);
    return true;
}
