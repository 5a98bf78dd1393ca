/* The shadows of entities, before the scene is drawn. In: where the entities and the sun are. Out: two maps of how near
 * to the sun they reach, one of the entities near the eye and one of the others, so that both have texels of about a
 * pixel's size (Williams 1978; sorting what casts, not what receives, keeps every entity whole in one map).
 *
 * Invariant: the maps follow from the whole frame; their texels keep their places in the world while the eye moves, as
 * long as their size stays. */
#include "render/frame.h"
#include "render/seen.h"

static const double margin = 4; /* texels around what casts, which stay clear */

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
static lom_box find_receivers(const lom_renderer *r)
{
    lom_box all = r->entities.items[0].at->bounds;
    for (size_t i = 1; i < r->entities.count; i++)
        all = join(all, r->entities.items[i].at->bounds);
    for (int i = 0; i < r->ground.across * r->ground.down; i++)
        all = join(all, r->ground.blocks[i].bounds);
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

/* The casters of a map and their extent as seen from the sun. */
struct casters {
    size_t count;
    lom_box extent;
};

static void add_extent(struct casters *c, lom_box box)
{
    c->extent = c->count++ == 0 ? box : join(c->extent, box);
}

/* Pixels of parallel rays are as large everywhere. */
static double away_from(const struct frame *f, lom_box box)
{
    return f->parallel ? 1 : greater(lom_distance_to_box(f->view.eye, box), f->camera.near_plane);
}

/* Marks what casts with the number of its map: the nearer ones, up to the geometric middle of all distances, and the
 * others. */
static void sort_casters(struct frame *f, lom_vec3 to_light, const lom_mat4 *light, struct casters casters[2])
{
    lom_renderer *r = f->renderer;
    const struct lom_seen seen = lom_find_seen(f);
    lom_box all = find_receivers(r);
    double nearest = 1e300, farthest = 0;
    for (size_t i = 0; i < r->entities.count; i++) {
        struct lom_drawn_entity *e = &r->entities.items[i];
        e->shadow_map = casts(e, &seen, to_light, &all) ? 0 : -1;
        double distance = away_from(f, e->at->bounds);
        if (e->shadow_map == 0) {
            nearest = lesser(nearest, distance);
            farthest = greater(farthest, distance);
        }
    }
    double middle = lom_double_sqrt(nearest * farthest);
    for (size_t i = 0; i < r->entities.count; i++) {
        struct lom_drawn_entity *e = &r->entities.items[i];
        if (e->shadow_map < 0)
            continue;
        e->shadow_map = away_from(f, e->at->bounds) > middle;
        add_extent(&casters[e->shadow_map], lom_transform_box(light, e->at->bounds));
    }
}

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
    double least = greater(greater(width, height) / (size - 2 * margin), 1e-30);
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

static uint64_t hash_casters(const lom_renderer *r, int map, const lom_mat4 *projection)
{
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, projection, sizeof *projection);
    for (size_t i = 0; i < r->entities.count; i++)
        if (r->entities.items[i].shadow_map == map)
            hash = lom_hash_bytes(lom_hash_bytes(hash, &i, sizeof i), &r->entities.items[i].at->world_from_model,
                                  sizeof(lom_mat4));
    return hash;
}

static bool draw_map(struct frame *f, int map, const struct casters *casters, const lom_mat4 *light)
{
    static const char *const names[2] = { "near shadow", "far shadow" };
    lom_renderer *r = f->renderer;
    struct lom_entity_shadow *shadow = &r->entities.shadows[map];
    int size = f->scene->quality.entity_shadows;

    shadow->falls = false;
    if (casters->count == 0) {
        lom_add_step(f, names[map], false, "no shadow of an entity%s is in view",
                     map == 1 ? " farther than the middle" : "");
        return true;
    }
    if (!make_map(f, shadow, size, names[map]))
        return false;
    project_map(shadow, &casters->extent, light, size, r->entities.items[0].source);
    uint64_t hash = hash_casters(r, map, &shadow->clip_from_world);
    if (shadow->made_for == hash) {
        lom_add_step(f, names[map], false, "neither the sun nor an entity has moved");
        return true;
    }
    lom_step *step = lom_add_step(f, names[map], true, "%zu entities as the sun sees them, %.3g m a texel",
                                  casters->count, shadow->texel);
    step->width = step->height = size;
    lom_begin_pass(r->device, &(lom_pass_desc){ .depth = shadow->map, .label = names[map] });
    for (size_t i = 0; i < r->entities.count; i++)
        if (r->entities.items[i].shadow_map == map)
            lom_draw_caster(r, &r->entities.items[i], &shadow->clip_from_world);
    if (!lom_end_pass(r->device))
        return false;
    shadow->made_for = hash;
    return true;
}

bool lom_prepare_entities(struct frame *f, lom_error *error)
{
    (void)error;
    const lom_vec3 to_light = f->renderer->moment.to_light;
    struct casters casters[2] = { { .count = 0 }, { .count = 0 } };
    if (f->renderer->entities.count == 0)
        return true;
    if (f->scene->quality.entity_shadows == 0) {
        lom_add_step(f, "near shadow", false, "quality.entity_shadows is 0");
        return true;
    }
    lom_mat4 light = light_from_world(to_light);
    sort_casters(f, to_light, &light, casters);
    return draw_map(f, 0, &casters[0], &light) && draw_map(f, 1, &casters[1], &light);
}
