/* The shadows of entities, before the scene is drawn. In: where the entities and the sun are. Out: maps of how near to the
 * sun they reach: two, one of the entities near the eye and one of the others, so that both have texels of about a
 * pixel's size (Williams 1978; sorting what casts, not what receives, keeps every entity whole in one map); or cascades.
 *
 * Invariant: the maps follow from the whole frame; their texels keep their places in the world while the eye moves, as
 * long as their size stays. */
#include "render/entities/sun_map.h"
#include "render/frame.h"
#include "render/seen.h"

/* Rows: right and up of a picture seen from the sun, and the way to it. */
static lom_mat4 light_from_world(lom_vec3 to_light)
{
    lom_vec3 up = { to_light.y * to_light.y < 0.98 ? 0 : 1, to_light.y * to_light.y < 0.98 ? 1 : 0, 0 };
    lom_vec3 from = { 0, 0, 0 }, to = { -to_light.x, -to_light.y, -to_light.z };
    return lom_look_at(from, to, up);
}

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

static double greater(double a, double b)
{
    return a > b ? a : b;
}

static lom_box join(lom_box a, lom_box b)
{
    return (lom_box){ { lesser(a.low.x, b.low.x), lesser(a.low.y, b.low.y), lesser(a.low.z, b.low.z) },
                      { greater(a.high.x, b.high.x), greater(a.high.y, b.high.y), greater(a.high.z, b.high.z) } };
}

/* All that a shadow could fall on. */
static lom_box find_receivers(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    lom_box all = r->entities.items[0].at->bounds;
    for (size_t i = 1; i < r->entities.count; i++)
        all = join(all, r->entities.items[i].at->bounds);
    for (int i = 0; i < r->ground.across * r->ground.down; i++)
        all = join(all, r->ground.blocks[i].bounds);
    lom_box surface;
    for (size_t i = 0; i <= f->scene->other_water_count; i++)
        if (lom_water_shows_sun(f, i, &surface))
            all = join(all, surface);
    return all;
}

/* How far a range can move by `speed` a metre until it has left another: less than 0: it has. */
static double way_out(double low, double high, double speed, double from, double to)
{
    return speed == 0 ? 1e300 : speed < 0 ? (high - from) / -speed : (to - low) / speed;
}

/* All that is between a box and the last thing behind it that its shadow could fall on. */
static lom_box shadow_volume(lom_box box, lom_vec3 to_light, const lom_box *all)
{
    double length = way_out(box.low.x, box.high.x, -to_light.x, all->low.x, all->high.x);
    length = lesser(length, way_out(box.low.y, box.high.y, -to_light.y, all->low.y, all->high.y));
    length = greater(lesser(length, way_out(box.low.z, box.high.z, -to_light.z, all->low.z, all->high.z)), 0);
    lom_vec3 low = { box.low.x - to_light.x * length, box.low.y - to_light.y * length,
                     box.low.z - to_light.z * length };
    lom_vec3 high = { box.high.x - to_light.x * length, box.high.y - to_light.y * length,
                      box.high.z - to_light.z * length };
    return join(box, (lom_box){ low, high });
}

bool lom_throws_shadow(const struct lom_drawn_entity *entity)
{
    return !entity->source->is_hidden && entity->transparent.count < entity->source->mesh->index_count / 3;
}

/* Whether an entity's shadow may be seen. */
static bool casts(const struct lom_drawn_entity *entity, const struct lom_seen *seen, lom_vec3 to_light,
                  const lom_box *all)
{
    return lom_throws_shadow(entity) && lom_may_show(seen, shadow_volume(entity->at->bounds, to_light, all));
}

void lom_add_sun_caster(struct lom_sun_casters *casters, lom_box box)
{
    casters->extent = casters->count++ == 0 ? box : join(casters->extent, box);
}

/* Pixels of parallel rays are as large everywhere. */
static double away_from(const struct frame *f, lom_box box)
{
    return f->parallel ? 1 : greater(lom_distance_to_box(f->view.eye, box), f->camera.near_plane);
}

/* Marks what casts a shadow that may be seen. */
static size_t mark_casters(struct frame *f, lom_vec3 to_light)
{
    lom_renderer *r = f->renderer;
    const struct lom_seen seen = lom_find_seen(f);
    const lom_box all = find_receivers(f);
    size_t count = 0;
    for (size_t i = 0; i < r->entities.count; i++) {
        struct lom_drawn_entity *e = &r->entities.items[i];
        e->shadow_maps = casts(e, &seen, to_light, &all) ? LOM_SHADOW_CASTS : 0;
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
        nearest = lesser(nearest, distance);
        farthest = greater(farthest, distance);
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

static bool draw_two(struct frame *f, const lom_mat4 *light)
{
    static const char *const names[2] = { "near shadow", "far shadow" };
    static const char *const which[2] = { "", " farther than the middle" };
    struct lom_sun_casters casters[2] = { { .count = 0 }, { .count = 0 } };
    sort_casters(f, light, casters);
    for (int i = 0; i < 2; i++)
        if (casters[i].count == 0)
            lom_add_step(f, names[i], false, "no shadow of an entity%s is in view", which[i]);
        else if (!lom_draw_sun_map(f, i, names[i], &casters[i], light))
            return false;
    return true;
}

bool lom_prepare_entities(struct frame *f, lom_error *error)
{
    (void)error;
    struct lom_drawn_entities *entities = &f->renderer->entities;
    const lom_quality *quality = &f->scene->quality;
    const lom_vec3 to_light = f->renderer->moment.to_light;
    if (entities->count == 0)
        return true;
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++)
        entities->shadows[i].falls = false;
    entities->cascaded = quality->shadow_cascades > 1 && !f->parallel;
    if (quality->entity_shadows == 0) {
        lom_add_step(f, "near shadow", false, "quality.entity_shadows is 0");
        return true;
    }
    const lom_mat4 light = light_from_world(to_light);
    const size_t count = mark_casters(f, to_light);
    return entities->cascaded && count > 0 ? lom_draw_cascades(f, &light) : draw_two(f, &light);
}
