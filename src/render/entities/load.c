/* Entities for drawing. In: the world's. Out: their materials, with textures. */
#include "render/renderer.h"

#include "base/numbers.h"

static bool load_map(lom_renderer *renderer, const char *path, bool color, const lom_texture **out, lom_error *error)
{
    *out = path == NULL ? NULL : lom_load_texture(renderer, path, color, error);
    return path == NULL || *out != NULL;
}

static bool load_material(lom_renderer *renderer, const struct lom_world_material *from,
                          struct lom_material_uniform *out, lom_error *error)
{
    lom_round_three(out->ambient, from->ambient);
    lom_round_three(out->diffuse, from->diffuse);
    lom_round_three(out->specular, from->specular);
    lom_round_three(out->emissive, from->emissive);
    out->shininess = (float)from->shininess;
    out->opacity = (float)from->opacity;
    out->opacity_is_in_alpha = from->opacity_is_in_alpha;
    out->emits = out->emissive[0] != 0 || out->emissive[1] != 0 || out->emissive[2] != 0;
    return load_map(renderer, from->texture, true, &out->texture, error) &&
           load_map(renderer, from->emissive_map, true, &out->emissive_map, error) &&
           load_map(renderer, from->specular_map, true, &out->specular_map, error) &&
           load_map(renderer, from->gloss_map, false, &out->gloss_map, error) &&
           load_map(renderer, from->opacity_map, false, &out->opacity_map, error) &&
           load_map(renderer, from->normal_map, false, &out->normal_map, error);
}

/* The materials of the parts' fronts, then those of their backs. */
static bool load_parts(lom_renderer *renderer, struct lom_drawn_entity *entity, lom_error *error)
{
    const struct lom_world_entity *source = entity->source;
    const size_t parts = lom_mesh_parts(source->mesh), sides = source->entity->two_sided ? 2 : 1;
    entity->materials = lom_allocate(parts * sides, sizeof *entity->materials, error);
    if (entity->materials == NULL)
        return false;
    entity->backs = sides == 2 ? entity->materials + parts : NULL;
    for (size_t k = 0; k < parts; k++)
        if (!load_material(renderer, &source->parts[k].material, &entity->materials[k], error) ||
            (sides == 2 && !load_material(renderer, &source->parts[k].back, &entity->backs[k], error)))
            return false;
    return true;
}

/* The edges of its mesh: those of the entity before it that has the same one. */
static bool find_edges(const struct lom_drawn_entities *entities, struct lom_drawn_entity *entity, lom_error *error)
{
    const struct lom_drawn_entity *other = entities->items;
    while (other->source->mesh != entity->source->mesh)
        other++;
    entity->shares_edges = other != entity;
    entity->edges = other != entity ? other->edges : lom_mesh_edges(entity->source->mesh, &entity->edge_count, error);
    entity->edge_count = other->edge_count;
    return entity->edges != NULL;
}

bool lom_load_entities(lom_renderer *renderer, lom_error *error)
{
    const struct lom_world *world = renderer->world;
    struct lom_drawn_entities *entities = &renderer->entities;
    entities->items = lom_allocate(world->entity_count, sizeof *entities->items, error);
    entities->order = lom_allocate(2 * world->entity_count, sizeof *entities->order, error);
    if (entities->order == NULL)
        return false;
    for (size_t i = 0; entities->items != NULL && i < world->entity_count; i++) {
        struct lom_drawn_entity *entity = &entities->items[entities->count++];
        entity->source = &world->entities[i];
        entity->at = &renderer->moment.placements[i];
        if (!load_parts(renderer, entity, error) || !lom_list_transparent(entity, error))
            return false;
        if (world->scene->quality.wireframe != LOM_WIREFRAME_OFF && !find_edges(entities, entity, error))
            return false;
    }
    return entities->items != NULL;
}

static void free_entity(lom_renderer *renderer, const struct lom_drawn_entity *entity)
{
    const size_t count = lom_mesh_parts(entity->source->mesh) * (entity->backs != NULL ? 2 : 1);
    for (size_t k = 0; entity->materials != NULL && k < count; k++) {
        const struct lom_material_uniform *m = &entity->materials[k];
        lom_drop_texture(renderer, m->texture);
        lom_drop_texture(renderer, m->emissive_map);
        lom_drop_texture(renderer, m->specular_map);
        lom_drop_texture(renderer, m->gloss_map);
        lom_drop_texture(renderer, m->normal_map);
        lom_drop_texture(renderer, m->opacity_map);
    }
    lom_release(entity->materials);
    if (!entity->shares_edges)
        lom_release(entity->edges);
    lom_release(entity->transparent.listed);
    lom_release(entity->transparent.triangles);
    lom_release(entity->transparent.indices);
    lom_release(entity->transparent.held);
}

void lom_free_entities(lom_renderer *renderer)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        free_entity(renderer, &renderer->entities.items[i]);
    lom_release(renderer->entities.items);
    lom_release(renderer->entities.order);
    lom_drop_entity_shadows(renderer);
}

void lom_drop_entity_shadows(lom_renderer *renderer)
{
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++) {
        lom_release_texture(renderer->device, renderer->entities.shadows[i].map);
        lom_free_near_blocks(&renderer->entities.shadows[i].near);
        renderer->entities.shadows[i] = (struct lom_entity_shadow){ .map = NULL };
    }
}
