/* A map of the sun's shadow: what entities look like from there. In: which of them, and their extent. Out: the map, drawn
 * unless it shows that already.
 *
 * Invariant: texels keep their size and their places in the world while the eye moves, as long as what the map has to hold
 * is about as large. */
#include "render/entities/sun_map.h"

#include "base/numbers.h"
#include "render/frame.h"

static const double margin = 4; /* texels around what casts, which stay clear */

/* A size of texels, at least `least` above 0, from a scale of eighths of a length of the scene, so that it changes
 * seldom. */
static double texel_size(double least, double length)
{
    double size = length > 0 ? length : least;
    while (size < least)
        size *= 1.125;
    while (size / 1.125 >= least)
        size /= 1.125;
    return size;
}

/* From the world to the map's clip space; depth grows towards the sun. Sizes and places of texels are counted from
 * those of the first entity, wherever the scene is and whatever its scale. */
static void project_map(struct lom_entity_shadow *shadow, const lom_box *extent, const lom_mat4 *light, int size,
                        const struct lom_world_entity *first)
{
    double width = extent->high.x - extent->low.x, height = extent->high.y - extent->low.y;
    double least = lom_larger(lom_larger(width, height) / (size - 2 * margin), 1e-30);
    double texel = texel_size(least, first->home_size);
    double near = extent->high.z + margin * texel, far = extent->low.z - margin * texel;
    lom_box from = lom_transform_box(light, (lom_box){ first->home, first->home });
    double x = from.low.x + lom_double_floor((extent->low.x + width / 2 - from.low.x) / texel) * texel;
    double y = from.low.y + lom_double_floor((extent->low.y + height / 2 - from.low.y) / texel) * texel;
    double half = texel * size / 2;
    lom_mat4 square = { { { 1 / half, 0, 0, -x / half },
                          { 0, 1 / half, 0, -y / half },
                          { 0, 0, 1 / (near - far), -far / (near - far) },
                          { 0, 0, 0, 1 } } };
    shadow->clip_from_world = lom_multiply(&square, light);
    shadow->texel = texel;
    shadow->falls = true;
}

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
                      const lom_mat4 *light)
{
    lom_renderer *r = f->renderer;
    struct lom_entity_shadow *shadow = &r->entities.shadows[number];
    int size = f->scene->quality.entity_shadows;
    if (!make_map(f, shadow, size, name))
        return false;
    project_map(shadow, &casters->extent, light, size, r->entities.items[0].source);
    uint64_t hash = hash_casters(r, number, &shadow->clip_from_world);
    if (shadow->made_for == hash) {
        lom_add_step(f, name, false, "neither the sun nor an entity has moved");
        return true;
    }
    lom_step *step =
        lom_add_step(f, name, true, "%zu entities as the sun sees them, %.3g m a texel", casters->count, shadow->texel);
    step->width = step->height = size;
    lom_begin_pass(r->device, &(lom_pass_desc){ .depth = shadow->map, .label = name });
    for (size_t i = 0; i < r->entities.count; i++)
        if (is_in(&r->entities.items[i], number))
            lom_draw_caster(r, &r->entities.items[i], &shadow->clip_from_world);
    if (!lom_end_pass(r->device))
        return false;
    shadow->made_for = hash;
    return true;
}
