/* What entities have that is transparent, over what is drawn already. In: a pass with its depth, how it looks at the scene.
 * Out: draws from back to front, which test the depth and leave it as it is.
 *
 * Order: entities by the distance of the middle of their bounds from the eye, the farthest first, equal ones in the scene's
 * order; within one its transparent triangles by the distance of their middles, equal ones in the mesh's order, whatever
 * their materials. So what a fine mesh has several layers of is right, a bottle as well as a pane; long triangles that
 * cross one another, and entities one of which lies within the other, are not cut. */
#include "render/entities/order.h"
#include "render/entities/shaders.h"
#include "render/frame.h"
#include "shading/square.h"

static bool has_transparent(const struct lom_drawn_entity *entity)
{
    return entity->transparent.count != 0;
}

/* Lists the triangles if there is a list; how many they are. */
static size_t list_triangles(const struct lom_world_entity *source, struct lom_listed_triangle *list)
{
    size_t count = 0;
    for (uint32_t k = 0; k < source->mesh->part_count; k++) {
        const struct lom_world_part *part = &source->parts[k];
        for (uint32_t i = 0; lom_is_transparent(part, source->entity) && i + 2 < part->count; i += 3, count++)
            if (list != NULL)
                list[count] = (struct lom_listed_triangle){ part->first + i, k };
    }
    return count;
}

bool lom_list_transparent(struct lom_drawn_entity *entity, lom_error *error)
{
    const struct lom_world_entity *source = entity->source;
    struct lom_transparent *t = &entity->transparent;
    const size_t count = list_triangles(source, NULL), materials = lom_mesh_parts(source->mesh);
    if (count == 0)
        return true;
    t->listed = lom_allocate(count, sizeof *t->listed, error);
    t->triangles = lom_allocate(2 * count, sizeof *t->triangles, error);
    t->indices = lom_allocate(3 * count, sizeof *t->indices, error);
    t->held = lom_allocate(entity->backs != NULL ? 2 * materials : materials, sizeof *t->held, error);
    if (t->listed == NULL || t->triangles == NULL || t->indices == NULL || t->held == NULL)
        return false;
    t->count = list_triangles(source, t->listed);
    return true;
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
static void draw_entity(lom_renderer *renderer, struct lom_drawn_entity *entity, const struct lom_scene_view *view,
                        const struct lom_order *order, const struct lom_view_uniform *uniform)
{
    const struct lom_distant *t = lom_order_triangles(renderer->device, entity, order);
    const size_t count = entity->transparent.count, materials = lom_mesh_parts(entity->source->mesh);
    struct lom_held_draw *held = entity->transparent.held;
    struct lom_entity_uniforms uniforms;
    lom_draw_desc draw = lom_begin_entity(renderer, entity, view, uniform, &uniforms);
    draw.cull = LOM_CULL_NONE;
    draw.depth_write_off = true;
    draw.blend[0] = lom_blend_over;
    draw.indices = entity->transparent.indices;
    memset(held, 0, (entity->backs != NULL ? 2 * materials : materials) * sizeof *held);
    for (size_t first = 0, end; first < count; first = end) {
        const uint32_t material = t[first].part; /* the backs' follow the fronts' */
        for (end = first + 1; end < count && t[end].part == material;)
            end++;
        if (!held[material].is_held) {
            uniforms.material = entity->materials[material];
            draw.shader = shader_of(renderer, &uniforms.material);
            draw.first = 0;
            draw.count = 3 * count;
            lom_hold_draw(renderer->device, &draw, &held[material]);
        }
        draw.first = 3 * first;
        draw.count = 3 * (end - first);
        lom_draw_held(renderer->device, &held[material], &draw);
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
    struct lom_drawn_entity *items = renderer->entities.items;
    const struct lom_order order = lom_order_of(view);
    struct lom_distant *list = renderer->entities.order;
    size_t count = 0;
    for (uint32_t i = 0; i < renderer->entities.count; i++)
        if (is_seen(&items[i], culler))
            list[count++] =
                (struct lom_distant){ .number = i,
                                      .distance = lom_distance_of(&order, middle_of(&items[i].at->bounds)) };
    list = lom_sort_distant(renderer->device, list, count);
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
    const struct lom_scene_view view = lom_view_of_side(f, -1);
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
    const struct lom_scene_view view = lom_view_of_side(f, 1);
    if (!has_any(f->renderer))
        return true;
    if (!lom_shows_transparent(f->renderer, &view)) {
        lom_add_step(f, "transparent", false, "no transparent entity is in view%s",
                     f->shows_water ? " on this side of the water" : "");
        return true;
    }
    return draw_part(f, &view, "transparent parts of entities over the scene, the farthest first");
}
