/* The shadows of lamps, before the scene is drawn. In: the lamps of the frame, where entities and terrain are. Out: a map
 * for each face of a lamp before which something stands, and what shaders look up in it.
 *
 * Invariant: which lamps and faces have a map follows from the whole frame; a lamp without one gives what it gave. Terrain
 * casts as it is drawn, with the frame's levels of detail, so that it does not shade itself. */
#include "render/lamp_shadows.h"

#include "base/numbers.h"
#include "base/pass_error.h"
#include "base/reserve.h"
#include "pipeline/draw_again.h"
#include "render/entities/shaders.h"
#include "render/frame.h"
#include "render/seen.h"

static const double margin = 4;   /* texels around what a face sees: a place is moved by less, and then filtered */
static const int least_size = 16; /* texels a side */

/* What a face of a lamp sees. */
struct face_view {
    struct lom_scene_view from; /* the lamp's place is its eye */
    double reach;
    lom_mat4 clip_from_world;
    struct lom_culler culler;
};

/* What a frame's step tells. */
struct tally {
    size_t lamps, maps, drawn, empty, unseen, over, liquids;
};

static int map_size(const struct frame *f)
{
    const int size = f->scene->quality.lamp_shadows;
    return size < least_size ? least_size : size;
}

/* ---- what casts ---- */

static const double everything[4] = { 0, 0, 0, 1 }; /* no clip plane */

/* Clip z is the least distance, so depth is that over w. */
static struct face_view view_of(const struct lom_placed_lamp *lamp, lom_vec3 axis, double tangent, double inside)
{
    const lom_vec3 p = lamp->position, target = lom_vec3_add(p, axis);
    const lom_mat4 look = lom_look_at(p, target, (lom_vec3){ 0, 1, 0 });
    const double k = inside / tangent;
    const lom_mat4 project = {
        { { k, 0, 0, 0 }, { 0, k, 0, 0 }, { 0, 0, 0, lamp->lamp->shadow_from }, { 0, 0, -1, 0 } }
    };
    struct face_view v = { { .projection = project, .view = look, .eye = p, .plane = { 0, 0, 0, 1 } },
                           lamp->reach,
                           lom_multiply(&project, &look),
                           { .plane = everything, .eye = p } };
    v.culler.frustum = lom_view_frustum(&v.clip_from_world, false);
    return v;
}

static bool is_in_range(const struct face_view *v, lom_box box)
{
    return lom_distance_to_box(v->from.eye, box) < v->reach && lom_is_visible(&v->culler, &box);
}

static bool is_caster(const struct face_view *v, const struct lom_drawn_entity *entity)
{
    return lom_throws_shadow(entity) && is_in_range(v, entity->at->bounds);
}

/* How many things cast, of which so many are blocks of terrain, and the hash of all that decides what the map shows. */
static size_t count_casters(const lom_renderer *r, const struct face_view *v, int *blocks, uint64_t *hash)
{
    size_t count = 0;
    *hash = lom_hash_bytes(LOM_HASH_START, &v->clip_from_world, sizeof v->clip_from_world);
    for (size_t i = 0; i < r->entities.count; i++)
        if (is_caster(v, &r->entities.items[i])) {
            *hash = lom_hash_bytes(lom_hash_bytes(*hash, &i, sizeof i), &r->entities.items[i].at->world_from_model,
                                   sizeof(lom_mat4));
            count++;
        }
    if (r->ground.knot != NULL) {
        *hash = lom_hash_bytes(*hash, &r->ground.eye, sizeof r->ground.eye);
        *hash = lom_hash_bytes(*hash, &r->ground.errors_allowed, sizeof r->ground.errors_allowed);
    }
    *blocks = lom_see_ground(&r->ground, &v->culler, v->reach);
    for (int i = 0, left = *blocks; left > 0; i++) {
        lom_draw_desc draw;
        uint32_t number;
        if (lom_find_ground_draw(&r->ground, i, &draw, &number) == NULL)
            continue;
        left--;
        *hash = lom_hash_bytes(*hash, &draw.base_vertex, sizeof draw.base_vertex);
        *hash = lom_hash_bytes(*hash, &draw.first, sizeof draw.first);
        count++;
    }
    return count;
}

/* The blocks that were counted are those that are seen still. */
static void draw_ground_casters(lom_renderer *r, const struct face_view *v, int blocks)
{
    if (r->ground.knot != NULL) { /* cut as the frame cuts them: from its eye */
        lom_draw_cut_wires(r, &v->from, &v->culler, &(lom_draw_desc){ .label = "terrain" }, NULL);
        return;
    }
    lom_mat4 raised = lom_identity();
    raised.m[1][3] = r->scene->terrain.base;
    const lom_mat4 clip_from_ground = lom_multiply(&v->clip_from_world, &raised);
    const struct lom_caster_uniforms uniforms = { lom_round_matrix(&clip_from_ground) };
    lom_draw_desc draw = { .shader = &lom_caster_shader, .uniforms = &uniforms, .label = "terrain" };
    struct lom_held_draw held;
    lom_take_ground(&r->ground, &draw);
    lom_hold_draw(r->device, &draw, &held);
    for (int i = 0, left = blocks; left > 0; i++) {
        uint32_t number;
        if (lom_find_ground_draw(&r->ground, i, &draw, &number) == NULL)
            continue;
        lom_draw_held(r->device, &held, &draw);
        left--;
    }
}

static bool draw_map(lom_renderer *r, const struct face_view *v, int blocks, lom_texture *map)
{
    lom_begin_pass(r->device, &(lom_pass_desc){ .depth = map, .label = "lamp shadow" });
    for (size_t i = 0; i < r->entities.count; i++)
        if (is_caster(v, &r->entities.items[i]))
            lom_draw_caster(r, &r->entities.items[i], &v->clip_from_world);
    draw_ground_casters(r, v, blocks);
    return lom_end_pass(r->device);
}

/* ---- maps ---- */

/* The next map of the frame; NULL when the device holds an error. */
static struct lom_lamp_map *find_map(struct frame *f, size_t number, lom_error *error)
{
    struct lom_lamp_shadows *s = &f->renderer->lamps.shadows;
    const int size = map_size(f);
    if (!lom_reserve(&s->maps, &s->capacity, number + 1, sizeof *s->maps, error))
        return NULL;
    if (number == s->count)
        s->maps[s->count++] = (struct lom_lamp_map){ .texture = NULL };
    struct lom_lamp_map *map = &s->maps[number];
    if (map->texture == NULL)
        map->texture =
            lom_make_texture(f->renderer->device, &(lom_texture_desc){ .width = size,
                                                                       .height = size,
                                                                       .label = "lamp shadow",
                                                                       .format = LOM_FORMAT_DEPTH32F,
                                                                       .sampler = { .wrap_s = LOM_WRAP_BORDER,
                                                                                    .wrap_t = LOM_WRAP_BORDER,
                                                                                    .magnify = LOM_FILTER_NEAREST,
                                                                                    .minify = LOM_FILTER_NEAREST } });
    return map->texture != NULL ? map : NULL;
}

/* A face before which nothing stands keeps no map. */
static bool make_face(struct frame *f, const struct face_view *v, struct lom_lamp_face_uniform *face,
                      struct tally *tally, lom_error *error)
{
    uint64_t hash;
    int blocks;
    if (count_casters(f->renderer, v, &blocks, &hash) == 0)
        return true;
    struct lom_lamp_map *map = find_map(f, tally->maps, error);
    if (map == NULL)
        return false;
    tally->maps++;
    face->map = map->texture;
    if (map->made_for == hash)
        return true;
    tally->drawn++;
    if (!draw_map(f->renderer, v, blocks, map->texture))
        return false;
    map->made_for = hash;
    return true;
}

/* ---- liquids ---- */

/* Which liquids take of the light of a face, each run to the frame's time; none without memory. */
static size_t find_liquids(struct frame *f, const struct face_view *v, bool takes[LOM_MAX_FLUIDS], lom_error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < f->scene->fluid_count; i++) {
        takes[i] = lom_shows_liquid(f->scene, i) && is_in_range(v, lom_fluid_box(&f->scene->fluids[i]));
        if (takes[i] && !lom_ready_fluid(f, i, error))
            return 0;
        count += takes[i];
    }
    return count;
}

static lom_texture *find_liquid_map(struct frame *f, size_t number, lom_error *error)
{
    struct lom_lamp_shadows *s = &f->renderer->lamps.shadows;
    if (!lom_reserve(&s->liquids, &s->liquid_capacity, number + 1, sizeof *s->liquids, error))
        return NULL;
    if (number == s->liquid_count)
        s->liquids[s->liquid_count++] = NULL;
    if (s->liquids[number] == NULL)
        s->liquids[number] = lom_make_fluid_map(f->renderer->device, map_size(f));
    return s->liquids[number];
}

/* A face that no liquid is before has no map of them. */
static bool make_liquid_face(struct frame *f, const struct face_view *v, struct lom_lamp_shadow_uniform *shadow,
                             struct lom_lamp_face_uniform *face, struct tally *tally, lom_error *error)
{
    bool takes[LOM_MAX_FLUIDS];
    lom_error failed = { 0 };
    if (find_liquids(f, v, takes, &failed) == 0)
        return lom_pass_error(&failed, error);
    lom_texture *map = find_liquid_map(f, tally->liquids, error);
    if (map == NULL)
        return false;
    tally->liquids++;
    face->liquid = map;
    shadow->has_liquid = true;
    return lom_draw_fluid_map(f->renderer, map, takes,
                              &(struct lom_fluid_light){ .clip_from_world = v->clip_from_world, .from = v->from.eye });
}

/* Rows of a rotation as a shader has them, divided by a tangent. */
static void set_axes(struct lom_lamp_face_uniform *face, lom_vec3 axis, double tangent)
{
    const lom_mat4 look = lom_look_at((lom_vec3){ 0, 0, 0 }, axis, (lom_vec3){ 0, 1, 0 });
    for (int i = 0; i < 3; i++) {
        face->right[i] = (float)(look.m[0][i] / tangent);
        face->up[i] = (float)(look.m[1][i] / tangent);
        face->forward[i] = (float)-look.m[2][i];
    }
}

static bool make_maps(struct frame *f, const struct lom_placed_lamp *lamp, struct lom_lamp_uniform *u,
                      struct lom_lamp_shadow_uniform *shadow, struct tally *tally, lom_error *error)
{
    const struct lom_lamp_faces faces = lom_find_lamp_faces(lamp);
    const int size = map_size(f);
    const double inside = 1 - 2 * margin / size;
    const size_t before = tally->maps;
    const double texel = 2 * faces.tangent / (size * inside); /* metres a metre of depth */
    *shadow = (struct lom_lamp_shadow_uniform){ .count = faces.count,
                                                .size = (float)size,
                                                .texel = 1 / (float)size,
                                                .scale = (float)(inside / 2),
                                                .from = (float)lamp->lamp->shadow_from,
                                                .lift = (float)(LOM_SHADOW_LIFT * texel),
                                                .lean = (float)(LOM_SHADOW_LEAN * texel * faces.tangent) };
    for (int i = 0; i < 3; i++)
        shadow->place[i] = u->place[i];
    for (int i = 0; i < faces.count; i++) {
        const struct face_view v = view_of(lamp, faces.axis[i], faces.tangent, inside);
        set_axes(&shadow->face[i], faces.axis[i], faces.tangent);
        if (!make_face(f, &v, &shadow->face[i], tally, error) ||
            !make_liquid_face(f, &v, shadow, &shadow->face[i], tally, error))
            return false;
    }
    if (tally->maps > before || shadow->has_liquid)
        u->shadow = shadow;
    tally->empty += tally->maps == before && !shadow->has_liquid;
    return true;
}

/* ---- the stage ---- */

static bool is_lamp_seen(const struct lom_seen *seen, const struct lom_placed_lamp *lamp)
{
    const double r = lamp->reach < 1e18 ? lamp->reach : 1e18;
    const lom_vec3 p = lamp->position;
    return lom_may_show(seen, (lom_box){ { p.x - r, p.y - r, p.z - r }, { p.x + r, p.y + r, p.z + r } });
}

static bool make_all(struct frame *f, struct tally *tally, lom_error *error)
{
    struct lom_drawn_lamps *lamps = &f->renderer->lamps;
    const size_t most = (size_t)f->scene->quality.lamp_shadow_maps;
    const struct lom_seen seen = lom_find_seen(f);
    for (size_t i = 0; i < lamps->count; i++) {
        const struct lom_placed_lamp *lamp = &f->renderer->moment.lamps[i];
        if (!lamp->lamp->shadow)
            continue;
        tally->lamps++;
        if (!is_lamp_seen(&seen, lamp))
            tally->unseen++;
        else if (tally->maps + (size_t)lom_find_lamp_faces(lamp).count > most)
            tally->over++;
        else if (!make_maps(f, lamp, &lamps->items[i], &lamps->shadows.items[i], tally, error))
            return false;
    }
    return true;
}

static void add_step(struct frame *f, const struct tally *t)
{
    lom_step *step = lom_add_step(f, "lamp shadows", t->drawn > 0,
                                  "%zu maps of %zu lamps: %zu drawn, the others show what they did; of %zu lamps "
                                  "nothing is in reach, %zu are out of view, %zu beyond quality.lamp_shadow_maps",
                                  t->maps, t->lamps, t->drawn, t->empty, t->unseen, t->over);
    step->width = step->height = t->drawn > 0 ? map_size(f) : 0;
    if (t->liquids == 0)
        return;
    step = lom_add_step(f, "liquid shadows of lamps", true, "%zu maps of what liquids take of their light", t->liquids);
    step->width = step->height = map_size(f);
}

bool lom_prepare_lamp_shadows(struct frame *f, lom_error *error)
{
    struct lom_drawn_lamps *lamps = &f->renderer->lamps;
    struct tally tally = { .lamps = 0 };
    size_t wanted = 0;
    for (size_t i = 0; i < lamps->count; i++)
        wanted += f->renderer->moment.lamps[i].lamp->shadow;
    if (wanted == 0)
        return true;
    if (f->scene->quality.lamp_shadows == 0) {
        lom_add_step(f, "lamp shadows", false, "quality.lamp_shadows is 0");
        return true;
    }
    if (!lom_reserve(&lamps->shadows.items, &lamps->shadows.item_capacity, lamps->count, sizeof *lamps->shadows.items,
                     error) ||
        !make_all(f, &tally, error))
        return false;
    add_step(f, &tally);
    return true;
}

void lom_forget_lamp_shadows(struct lom_lamp_shadows *shadows)
{
    for (size_t i = 0; i < shadows->count; i++)
        shadows->maps[i].made_for = 0;
}

void lom_drop_lamp_shadows(lom_renderer *renderer)
{
    struct lom_lamp_shadows *shadows = &renderer->lamps.shadows;
    for (size_t i = 0; i < shadows->count; i++)
        lom_release_texture(renderer->device, shadows->maps[i].texture);
    for (size_t i = 0; i < shadows->liquid_count; i++)
        lom_release_texture(renderer->device, shadows->liquids[i]);
    lom_release(shadows->liquids);
    lom_release(shadows->maps);
    lom_release(shadows->items);
    *shadows = (struct lom_lamp_shadows){ .maps = NULL };
}
