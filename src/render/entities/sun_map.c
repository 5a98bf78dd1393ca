/* A map of the sun's shadow: what entities look like from there. In: which of them, and their extent. Out: the map and
 * its blocks, drawn unless it shows that already. */
#include "render/entities/sun_map.h"

#include "render/frame.h"

static bool make_map(struct frame *f, struct lom_entity_shadow *shadow, int size, const char *name)
{
    if (shadow->map == NULL)
        shadow->map =
            lom_make_texture(f->renderer->device, &(lom_texture_desc){ .width = size,
                                                                       .height = size,
                                                                       .label = name,
                                                                       .format = LOM_FORMAT_DEPTH32F,
                                                                       .sampler = { .wrap_s = LOM_WRAP_BORDER,
                                                                                    .wrap_t = LOM_WRAP_BORDER,
                                                                                    .magnify = LOM_FILTER_NEAREST,
                                                                                    .minify = LOM_FILTER_NEAREST } });
    return shadow->map != NULL;
}

static bool is_in(const struct lom_drawn_entity *entity, int map)
{
    return (entity->shadow_maps >> map & 1) != 0;
}

static uint64_t hash_casters(const lom_renderer *r, int map, const lom_mat4 *projection)
{
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, projection, sizeof *projection);
    for (size_t i = 0; i < r->entities.count; i++)
        if (is_in(&r->entities.items[i], map))
            hash = lom_hash_bytes(lom_hash_bytes(hash, &i, sizeof i), &r->entities.items[i].at->world_from_model,
                                  sizeof(lom_mat4));
    return hash;
}

bool lom_draw_sun_map(struct frame *f, int number, const char *name, const struct lom_sun_casters *casters,
                      const lom_mat4 *light, lom_error *error)
{
    lom_renderer *r = f->renderer;
    struct lom_entity_shadow *shadow = &r->entities.shadows[number];
    int size = f->scene->quality.entity_shadows;
    if (!make_map(f, shadow, size, name))
        return false;
    const struct lom_world_entity *first = r->entities.items[0].source;
    shadow->at = lom_project_sun_map(&casters->extent, light, size, first->home, first->home_size);
    shadow->falls = true;
    uint64_t hash = hash_casters(r, number, &shadow->at.clip_from_world);
    if (shadow->made_for == hash) {
        lom_add_step(f, name, false, "neither the sun nor an entity has moved");
        return true;
    }
    lom_step *step = lom_add_step(f, name, true, "%zu entities as the sun sees them, %.3g m a texel", casters->count,
                                  shadow->at.texel);
    step->width = step->height = size;
    lom_begin_pass(r->device, &(lom_pass_desc){ .depth = shadow->map, .label = name });
    for (size_t i = 0; i < r->entities.count; i++)
        if (is_in(&r->entities.items[i], number))
            lom_draw_caster(r, &r->entities.items[i], &shadow->at.clip_from_world);
    if (!lom_end_pass(r->device) ||
        !lom_fill_near_blocks(&shadow->near, r->device, NULL, shadow->map, LOM_SHADOW_BLOCK, error))
        return false;
    shadow->made_for = hash;
    return true;
}
