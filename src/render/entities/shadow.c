/* The shadows of entities, before the scene is drawn. In: where the entities and the sun are. Out: maps of how near to the
 * sun they reach: two, one of the entities near the eye and one of the others, so that both have texels of about a
 * pixel's size (Williams 1978; sorting what casts, not what receives, keeps every entity whole in one map); or cascades.
 *
 * Invariant: the maps follow from the whole frame; their texels keep their places in the world while the eye moves, as
 * long as their size stays. */
#include "base/numbers.h"
#include "render/entities/sun_map.h"
#include "render/frame.h"

bool lom_throws_shadow(const struct lom_drawn_entity *entity)
{
    return !entity->source->is_hidden && entity->transparent.count < entity->source->mesh->index_count / 3;
}

/* Whether an entity's shadow may be seen. */
static bool casts(const struct lom_drawn_entity *entity, const struct lom_sun_receivers *receivers)
{
    return lom_throws_shadow(entity) && lom_may_show_sun_shadow(receivers, entity->at->bounds);
}

void lom_add_sun_caster(struct lom_sun_casters *casters, lom_box box)
{
    casters->extent = casters->count++ == 0 ? box : lom_join_boxes(casters->extent, box);
}

/* Pixels of parallel rays are as large everywhere. */
static double away_from(const struct frame *f, lom_box box)
{
    return f->parallel ? 1 : lom_larger(lom_distance_to_box(f->view.eye, box), f->camera.near_plane);
}

/* Marks what casts a shadow that may be seen. */
static size_t mark_casters(struct frame *f)
{
    lom_renderer *r = f->renderer;
    const struct lom_sun_receivers receivers = lom_find_sun_receivers(f);
    size_t count = 0;
    for (size_t i = 0; i < r->entities.count; i++) {
        struct lom_drawn_entity *e = &r->entities.items[i];
        e->shadow_maps = casts(e, &receivers) ? LOM_SHADOW_CASTS : 0;
        count += e->shadow_maps != 0;
    }
    return count;
}

/* Parts what casts: the nearer entities, up to the geometric middle of all distances, and the others. */
static void sort_casters(struct frame *f, const lom_mat4 *light, struct lom_sun_casters casters[2])
{
    lom_renderer *r = f->renderer;
    double nearest = 1e300, farthest = 0;
    for (size_t i = 0; i < r->entities.count; i++) {
        const struct lom_drawn_entity *e = &r->entities.items[i];
        double distance = away_from(f, e->at->bounds);
        if (e->shadow_maps == 0)
            continue;
        nearest = lom_smaller(nearest, distance);
        farthest = lom_larger(farthest, distance);
    }
    double middle = lom_double_sqrt(nearest * farthest);
    for (size_t i = 0; i < r->entities.count; i++) {
        struct lom_drawn_entity *e = &r->entities.items[i];
        if (e->shadow_maps == 0)
            continue;
        const int map = away_from(f, e->at->bounds) > middle;
        e->shadow_maps |= 1u << map;
        lom_add_sun_caster(&casters[map], lom_transform_box(light, e->at->bounds));
    }
}

static bool draw_two(struct frame *f, const lom_mat4 *light, lom_error *error)
{
    static const char *const names[2] = { "near shadow", "far shadow" };
    static const char *const which[2] = { "", " farther than the middle" };
    struct lom_sun_casters casters[2] = { { .count = 0 }, { .count = 0 } };
    sort_casters(f, light, casters);
    for (int i = 0; i < 2; i++)
        if (casters[i].count == 0)
            lom_add_step(f, names[i], false, "no shadow of an entity%s is in view", which[i]);
        else if (!lom_draw_sun_map(f, i, names[i], &casters[i], light, error))
            return false;
    return true;
}

bool lom_prepare_entities(struct frame *f, lom_error *error)
{
    struct lom_drawn_entities *entities = &f->renderer->entities;
    const lom_quality *quality = &f->scene->quality;
    if (entities->count == 0)
        return true;
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++)
        entities->shadows[i].falls = false;
    entities->cascaded = quality->shadow_cascades > 1 && !f->parallel;
    if (quality->entity_shadows == 0) {
        lom_add_step(f, "near shadow", false, "quality.entity_shadows is 0");
        return true;
    }
    const lom_mat4 light = lom_sun_view(f->renderer->moment.to_light);
    const size_t count = mark_casters(f);
    return entities->cascaded && count > 0 ? lom_draw_cascades(f, &light, error) : draw_two(f, &light, error);
}
