/* Entities for drawing. In: the world's. Out: their materials, with textures. */
#include "render/renderer.h"

static void round3(float out[3], const double in[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)in[i];
}

static bool load_material(lom_renderer *renderer, const struct lom_world_material *from,
                          struct lom_material_uniform *out, lom_error *error)
{
    round3(out->ambient, from->ambient);
    round3(out->diffuse, from->diffuse);
    round3(out->specular, from->specular);
    out->shininess = (float)from->shininess;
    out->texture = from->texture == NULL ? NULL : lom_load_texture(renderer, from->texture, true, error);
    return from->texture == NULL || out->texture != NULL;
}

bool lom_load_entities(lom_renderer *renderer, lom_error *error)
{
    const struct lom_world *world = renderer->world;
    struct lom_drawn_entities *entities = &renderer->entities;
    entities->items = lom_allocate(world->entity_count, sizeof *entities->items, error);
    for (size_t i = 0; entities->items != NULL && i < world->entity_count; i++) {
        struct lom_drawn_entity *entity = &entities->items[entities->count++];
        entity->source = &world->entities[i];
        entity->at = &renderer->moment.placements[i];
        size_t parts = entity->source->mesh->part_count;
        entity->materials = lom_allocate(parts, sizeof *entity->materials, error);
        if (entity->materials == NULL)
            return false;
        for (size_t k = 0; k < parts; k++)
            if (!load_material(renderer, &entity->source->parts[k].material, &entity->materials[k], error))
                return false;
    }
    return entities->items != NULL;
}

static void free_materials(lom_renderer *renderer, const struct lom_drawn_entity *entity)
{
    for (size_t k = 0; entity->materials != NULL && k < entity->source->mesh->part_count; k++)
        lom_drop_texture(renderer, entity->materials[k].texture);
    lom_release(entity->materials);
}

void lom_free_entities(lom_renderer *renderer)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        free_materials(renderer, &renderer->entities.items[i]);
    lom_release(renderer->entities.items);
    lom_drop_entity_shadows(renderer);
}

void lom_drop_entity_shadows(lom_renderer *renderer)
{
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++) {
        lom_release_texture(renderer->device, renderer->entities.shadows[i].map);
        renderer->entities.shadows[i] = (struct lom_entity_shadow){ .map = NULL };
    }
}
