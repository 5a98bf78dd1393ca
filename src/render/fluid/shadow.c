/* What liquids take of the light behind them. In: their surfaces, a light. Out: maps of their optical depths as the
 * light sees them (shading/liquid_shadow.h): the sun's here, those of lamps by render/lamp_shadows.c.
 *
 * Invariant: a map follows from the whole frame; a liquid whose shadow cannot be seen is not stepped for it. */
#include "base/numbers.h"
#include "render/fluid/mesh.h"
#include "render/fluid/shaders.h"
#include "render/frame.h"

/* ---- a map ---- */

lom_texture *lom_make_fluid_map(lom_device *device, int size)
{
    return lom_make_texture(device, &(lom_texture_desc){ .width = size,
                                                         .height = size,
                                                         .label = "liquid shadow",
                                                         .format = LOM_FORMAT_RGBA32F,
                                                         .sampler = { .wrap_s = LOM_WRAP_CLAMP,
                                                                      .wrap_t = LOM_WRAP_CLAMP,
                                                                      .magnify = LOM_FILTER_NEAREST,
                                                                      .minify = LOM_FILTER_NEAREST } });
}

static struct lom_fluid_caster_uniforms uniforms_of(const lom_fluid_params *p, const struct lom_fluid_light *light)
{
    const lom_vec3 low = { p->low[0], p->low[1], p->low[2] };
    const lom_mat4 placed = lom_translation(low), clip = lom_multiply(&light->clip_from_world, &placed);
    const lom_vec3 shift = lom_vec3_subtract(low, light->from);
    struct lom_fluid_caster_uniforms u = { .clip_from_mesh = lom_round_matrix(&clip),
                                           .parallel = light->parallel,
                                           .shift = { (float)shift.x, (float)shift.y, (float)shift.z } };
    lom_center_row(u.along, light->along, low);
    return u;
}

/* What turns its back to the light counts up, what faces it down; the nearest depth stays. */
static void draw_caster(lom_device *device, const struct lom_fluid_light *light, const lom_fluid_params *p,
                        const lom_mesh *mesh)
{
    static const lom_cull culls[2] = { LOM_CULL_FRONT, LOM_CULL_BACK };
    struct lom_fluid_caster_uniforms u = uniforms_of(p, light);
    for (int i = 0; i < 2; i++) {
        lom_draw_desc draw = { .shader = &lom_fluid_caster_shader,
                               .uniforms = &u,
                               .cull = culls[i],
                               .blend = { { .enabled = true,
                                            .source_color = LOM_FACTOR_ONE,
                                            .target_color = LOM_FACTOR_ONE,
                                            .alpha_operation = LOM_BLEND_MAX } } };
        for (int c = 0; c < 3; c++)
            u.extinction[c] = (float)(i == 0 ? p->absorption[c] : -p->absorption[c]);
        lom_set_fluid_mesh(&draw, mesh);
        lom_draw(device, &draw);
    }
}

bool lom_draw_fluid_map(lom_renderer *r, lom_texture *map, const bool *casts, const struct lom_fluid_light *light)
{
    lom_begin_pass(r->device, &(lom_pass_desc){ .color = { map }, .label = "liquid shadow" });
    for (size_t i = 0; i < r->fluids.count; i++)
        if (casts[i] && r->fluids.items[i].liquid.mesh->index_count > 0)
            draw_caster(r->device, light, &r->scene->fluids[i], r->fluids.items[i].liquid.mesh);
    return lom_end_pass(r->device);
}

/* ---- the sun's ---- */

/* Which liquids throw a shadow that may be seen, and their extent in the sun's view. */
static size_t find_casters(const struct frame *f, const lom_mat4 *light, bool casts[LOM_MAX_FLUIDS], lom_box *extent)
{
    const struct lom_sun_receivers receivers = lom_find_sun_receivers(f);
    size_t count = 0;
    for (size_t i = 0; i < f->scene->fluid_count; i++) {
        const lom_box box = lom_fluid_box(&f->scene->fluids[i]), seen = lom_transform_box(light, box);
        casts[i] = f->scene->fluids[i].visible && lom_may_show_sun_shadow(&receivers, box);
        if (casts[i])
            *extent = count++ == 0 ? seen : lom_join_boxes(*extent, seen);
    }
    return count;
}

static double longest_side(const lom_fluid_params *p)
{
    return lom_larger(p->high[0] - p->low[0], lom_larger(p->high[1] - p->low[1], p->high[2] - p->low[2]));
}

static bool draw_sun_map(struct frame *f, const lom_mat4 *light, const bool *casts, const lom_box *extent, size_t count)
{
    lom_renderer *r = f->renderer;
    struct lom_fluid_shadow *shadow = &r->fluids.shadow;
    const int size = f->scene->quality.entity_shadows;
    const lom_fluid_params *first = &f->scene->fluids[0];
    const lom_vec3 home = { first->low[0], first->low[1], first->low[2] };
    if (shadow->map == NULL && (shadow->map = lom_make_fluid_map(r->device, size)) == NULL)
        return false;
    shadow->at = lom_project_sun_map(extent, light, size, home, longest_side(first));
    shadow->falls = true;
    struct lom_fluid_light sun = { .clip_from_world = shadow->at.clip_from_world, .parallel = true };
    for (int i = 0; i < 4; i++)
        sun.along[i] = -shadow->at.range * shadow->at.clip_from_world.m[2][i] + (i == 3 ? shadow->at.range : 0);
    lom_step *step = lom_add_step(f, "liquid shadow", true, "%zu liquids as the sun sees them, %.3g m a texel", count,
                                  shadow->at.texel);
    step->width = step->height = size;
    return lom_draw_fluid_map(r, shadow->map, casts, &sun);
}

bool lom_prepare_fluids(struct frame *f, lom_error *error)
{
    struct lom_drawn_fluids *all = &f->renderer->fluids;
    bool casts[LOM_MAX_FLUIDS] = { false };
    lom_box extent = { .low = { 0 } };
    all->shadow.falls = false;
    for (size_t i = 0; i < all->count; i++)
        all->items[i].ready = false;
    if (lom_count_fluids(f->scene) == 0)
        return true;
    if (f->scene->quality.entity_shadows == 0) {
        lom_add_step(f, "liquid shadow", false, "quality.entity_shadows is 0");
        return true;
    }
    const lom_mat4 light = lom_sun_view(f->renderer->moment.to_light);
    const size_t count = find_casters(f, &light, casts, &extent);
    if (count == 0) {
        lom_add_step(f, "liquid shadow", false, "no shadow of a liquid is in view");
        return true;
    }
    for (size_t i = 0; i < all->count; i++)
        if (casts[i] && !lom_ready_fluid(f, i, error))
            return false;
    return draw_sun_map(f, &light, casts, &extent, count);
}

void lom_drop_fluid_shadow(lom_renderer *renderer)
{
    lom_release_texture(renderer->device, renderer->fluids.shadow.map);
    renderer->fluids.shadow = (struct lom_fluid_shadow){ .map = NULL };
}

void lom_set_fluid_shadow(struct lom_sun_shadow_uniform *u, const lom_renderer *renderer, lom_vec3 eye)
{
    const struct lom_fluid_shadow *shadow = &renderer->fluids.shadow;
    if (!shadow->falls)
        return;
    const float size = (float)lom_texture_width(shadow->map);
    u->liquid =
        (struct lom_liquid_map_uniform){ .map = shadow->map, .size = size, .offset = (float)(2.5 * shadow->at.texel) };
    lom_set_sun_map_rows(&shadow->at, eye, u->liquid.s, u->liquid.t, u->liquid.depth);
}
