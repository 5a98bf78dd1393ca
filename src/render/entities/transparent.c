/* What entities have that is transparent, over what is drawn already. In: a pass with its depth, how it looks at the scene.
 * Out: draws from back to front, which test the depth and leave it as it is.
 *
 * Order: entities by the distance of the middle of their bounds from the eye, the farthest first, equal ones in the scene's
 * order; within one its transparent triangles by the distance of their middles, equal ones in the mesh's order, whatever
 * their materials. So what a fine mesh has several layers of is right, a bottle as well as a pane; long triangles that
 * cross one another, and entities one of which lies within the other, are not cut.
 *
 * Invariant: the order is a function of the view's eye and of where the entities are, in double. */
#include "render/entities/shaders.h"
#include "render/frame.h"
#include "shading/square.h"

static bool has_transparent(const struct lom_drawn_entity *entity)
{
    return entity->transparent.count != 0;
}

bool lom_list_transparent(struct lom_drawn_entity *entity, lom_error *error)
{
    const struct lom_world_entity *source = entity->source;
    struct lom_transparent *t = &entity->transparent;
    size_t count = 0;
    for (size_t i = 0; i < source->mesh->part_count; i++)
        if (lom_is_transparent(&source->parts[i], source->entity))
            count += source->parts[i].count / 3;
    if (count == 0)
        return true;
    t->triangles = lom_allocate(2 * count, sizeof *t->triangles, error);
    t->indices = lom_allocate(3 * count, sizeof *t->indices, error);
    if (t->triangles == NULL || t->indices == NULL)
        return false;
    t->count = count;
    return true;
}

/* ---- the order ---- */

/* Where a view's rays come from. */
struct order {
    lom_vec3 eye, ahead;
    bool parallel;
};

static struct order order_of(const struct lom_scene_view *view)
{
    const lom_view_rays rays = lom_find_view_rays(&view->projection, &view->view);
    return (struct order){ view->eye, rays.ahead, rays.parallel };
}

/* What grows with the distance: its square, or with parallel rays how far ahead of the eye a place is. */
static double distance_to(const struct order *order, lom_vec3 place)
{
    lom_vec3 d = lom_vec3_subtract(place, order->eye), along = order->parallel ? order->ahead : d;
    return d.x * along.x + d.y * along.y + d.z * along.z;
}

/* Two sorted runs as one: of equally far things that of the first run comes first. */
static void merge(const struct lom_distant *from, size_t middle, size_t end, struct lom_distant *to)
{
    size_t a = 0, b = middle;
    for (size_t i = 0; i < end; i++) {
        bool first = b == end || (a < middle && from[a].distance >= from[b].distance);
        to[i] = from[first ? a++ : b++];
    }
}

/* Farthest first, in runs of twice the length each time; `list` has room for as many once more. Returns where they are. */
static struct lom_distant *sort(struct lom_distant *list, size_t count)
{
    struct lom_distant *from = list, *to = list + count;
    for (size_t run = 1; run < count; run *= 2) {
        for (size_t i = 0; i < count; i += 2 * run) {
            size_t left = count - i;
            merge(from + i, run < left ? run : left, 2 * run < left ? 2 * run : left, to + i);
        }
        struct lom_distant *sorted = to;
        to = from;
        from = sorted;
    }
    return from;
}

/* The middle of a triangle in the world. */
static lom_vec3 find_middle(const struct lom_drawn_entity *entity, const uint32_t *index)
{
    const lom_mesh *mesh = entity->source->mesh;
    double sum[3] = { 0, 0, 0 };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            sum[i] += (double)mesh->vertices[index[k]].position[i];
    return lom_transform_point(&entity->at->world_from_model, (lom_vec3){ sum[0] / 3, sum[1] / 3, sum[2] / 3 });
}

/* Whether a triangle of an entity that has materials of its own for backs turns its back. */
static bool shows_back(const struct lom_drawn_entity *entity, const uint32_t *index, const struct order *order)
{
    lom_vec3 p[3];
    if (entity->backs == NULL)
        return false;
    for (int k = 0; k < 3; k++) {
        const float *at = entity->source->mesh->vertices[index[k]].position;
        p[k] = lom_transform_point(&entity->at->world_from_model, (lom_vec3){ at[0], at[1], at[2] });
    }
    const lom_vec3 n = lom_vec3_cross(lom_vec3_subtract(p[1], p[0]), lom_vec3_subtract(p[2], p[0]));
    const lom_vec3 away = order->parallel ? order->ahead : lom_vec3_subtract(p[0], order->eye);
    const bool behind = n.x * away.x + n.y * away.y + n.z * away.z > 0;
    return behind != lom_is_mirroring(&entity->at->world_from_model);
}

/* The triangles in their order; of the materials those of backs come after those of fronts. */
static const struct lom_distant *order_triangles(const struct lom_drawn_entity *entity, const struct order *order)
{
    const struct lom_world_entity *source = entity->source;
    struct lom_distant *list = entity->transparent.triangles;
    const uint32_t backs = entity->backs != NULL ? (uint32_t)(entity->backs - entity->materials) : 0;
    size_t count = 0;
    for (uint32_t k = 0; k < source->mesh->part_count; k++) {
        const struct lom_world_part *part = &source->parts[k];
        for (uint32_t i = 0; lom_is_transparent(part, source->entity) && i + 2 < part->count; i += 3) {
            const uint32_t *index = source->mesh->indices + part->first + i;
            const uint32_t material = shows_back(entity, index, order) ? k + backs : k;
            list[count++] =
                (struct lom_distant){ part->first + i, material, distance_to(order, find_middle(entity, index)) };
        }
    }
    return sort(list, count);
}

/* ---- drawing ---- */

static const lom_shader *shader_of(const lom_renderer *renderer, const struct lom_material_uniform *material)
{
    static const lom_shader *const shaders[] = { [LOM_SHADING_PHONG] = &lom_transparent_phong,
                                                 [LOM_SHADING_GOURAUD] = &lom_transparent_gouraud,
                                                 [LOM_SHADING_FLAT] = &lom_transparent_flat };
    const lom_shading shading = renderer->scene->quality.shading;
    return shading == LOM_SHADING_PHONG && material->normal_map != NULL ? &lom_transparent_bumped : shaders[shading];
}

/* A draw for each run of triangles of one material. */
static void draw_entity(lom_renderer *renderer, const struct lom_drawn_entity *entity,
                        const struct lom_scene_view *view, const struct order *order,
                        const struct lom_view_uniform *uniform)
{
    const struct lom_distant *t = order_triangles(entity, order);
    const size_t count = entity->transparent.count;
    struct lom_entity_uniforms uniforms;
    lom_draw_desc draw = lom_begin_entity(renderer, entity, view, uniform, &uniforms);
    draw.cull = LOM_CULL_NONE;
    draw.depth_write_off = true;
    draw.blend[0] = lom_blend_over;
    draw.indices = entity->transparent.indices;
    for (size_t i = 0; i < count; i++)
        memcpy(entity->transparent.indices + 3 * i, entity->source->mesh->indices + t[i].number, 3 * sizeof(uint32_t));
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && t[end].part == t[first].part;)
            end++;
        uniforms.material = entity->materials[t[first].part]; /* the backs' follow the fronts' */
        draw.shader = shader_of(renderer, &uniforms.material);
        draw.first = 3 * first;
        draw.count = 3 * (end - first);
        lom_draw(renderer->device, &draw);
    }
}

/* ---- which entities ---- */

static bool is_seen(const struct lom_drawn_entity *entity, const struct lom_culler *culler)
{
    return has_transparent(entity) && lom_shows_entity(entity, culler);
}

static lom_vec3 middle_of(const lom_box *b)
{
    return (lom_vec3){ (b->low.x + b->high.x) / 2, (b->low.y + b->high.y) / 2, (b->low.z + b->high.z) / 2 };
}

size_t lom_count_transparent_entities(const lom_renderer *renderer, const struct lom_culler *culler)
{
    size_t count = 0;
    for (size_t i = 0; i < renderer->entities.count; i++)
        count += is_seen(&renderer->entities.items[i], culler);
    return count;
}

size_t lom_draw_transparent_entities(lom_renderer *renderer, const struct lom_scene_view *view,
                                     const struct lom_culler *culler, const struct lom_view_uniform *uniform)
{
    const struct lom_drawn_entity *items = renderer->entities.items;
    const struct order order = order_of(view);
    struct lom_distant *list = renderer->entities.order;
    size_t count = 0;
    for (uint32_t i = 0; i < renderer->entities.count; i++)
        if (is_seen(&items[i], culler))
            list[count++] =
                (struct lom_distant){ .number = i, .distance = distance_to(&order, middle_of(&items[i].at->bounds)) };
    list = sort(list, count);
    for (size_t i = 0; i < count; i++)
        draw_entity(renderer, &items[list[i].number], view, &order, uniform);
    return count;
}

/* ---- the passes ---- */

bool lom_draw_transparent_over(struct frame *f, const struct lom_scene_view *view, lom_pass_desc pass)
{
    lom_renderer *r = f->renderer;
    if (!lom_shows_transparent(r, view))
        return true;
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.label = "transparent";
    lom_begin_pass(r->device, &pass);
    lom_draw_transparent_scene(r, view);
    return lom_end_pass(r->device);
}

/* The frame's view of what is on one side of the level of the water that is drawn first: the eye's (1) or the other one (-1). */
static struct lom_scene_view view_of_side(const struct frame *f, double side)
{
    struct lom_scene_view view = f->view;
    const double level = f->divided_at, up = f->view.eye.y < level ? -side : side;
    view.plane[0] = view.plane[2] = 0;
    view.plane[1] = up;
    view.plane[3] = -up * level;
    return view;
}

static bool draw_part(struct frame *f, const struct lom_scene_view *view, const char *text)
{
    lom_renderer *r = f->renderer;
    if (!lom_shows_transparent(r, view))
        return true;
    const struct lom_window shown = lom_window_of(&f->crop, f->width, f->height);
    struct lom_scene_view part = *view;
    part.window = &shown;
    lom_step *step = lom_add_step(f, "transparent", true, "%s", text);
    step->width = f->crop.width;
    step->height = f->crop.height;
    return lom_draw_transparent_over(f, &part, lom_frame_pass(f, r->targets.of[f->target]));
}

bool lom_draw_transparent_beyond(struct frame *f)
{
    const struct lom_scene_view view = view_of_side(f, -1);
    return draw_part(f, &view, "transparent parts of entities beyond the water, the farthest first");
}

static bool has_any(const lom_renderer *renderer)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        if (has_transparent(&renderer->entities.items[i]))
            return true;
    return false;
}

bool lom_draw_transparent(struct frame *f, lom_error *error)
{
    (void)error;
    const struct lom_scene_view view = f->shows_water ? view_of_side(f, 1) : f->view;
    if (!has_any(f->renderer))
        return true;
    if (!lom_shows_transparent(f->renderer, &view)) {
        lom_add_step(f, "transparent", false, "no transparent entity is in view%s",
                     f->shows_water ? " on this side of the water" : "");
        return true;
    }
    return draw_part(f, &view, "transparent parts of entities over the scene, the farthest first");
}
