/* A world at a time. In: the key frames of its light, camera, entities and lamps. Out: light, camera, and where the
 * entities and the lamps are. Invariant: a function of the time alone. */
#include "scene/scene_light.h"
#include "world/world.h"

bool lom_place_entity(const struct lom_world_entity *entity, lom_vec3 position, lom_vec3 rotation,
                      struct lom_placement *placement, lom_error *error)
{
    placement->world_from_model = lom_model_matrix(position, rotation, entity->entity->scale);
    placement->bounds = lom_transform_box(&placement->world_from_model, lom_mesh_bounds(entity->mesh));
    return lom_normal_matrix(&placement->world_from_model, &placement->normal_from_model) ||
           lom_fail(error, LOM_ERROR_INPUT, "%s: an entity's scale makes its matrix singular.", entity->entity->mesh);
}

/* Those that stand still are placed the first time. */
static bool place_all(const struct lom_world *world, struct lom_moment *moment, bool first, lom_error *error)
{
    for (size_t i = 0; i < world->entity_count; i++) {
        const struct lom_world_entity *entity = &world->entities[i];
        lom_entity_place at = { entity->home, entity->entity->rotation };
        if (entity->entity->key_count != 0)
            at = lom_scene_entity_at(entity->entity, moment->time);
        else if (!first)
            continue;
        if (!lom_place_entity(entity, at.position, at.rotation, &moment->placements[i], error))
            return false;
    }
    return true;
}

bool lom_world_at(const struct lom_world *world, double time, struct lom_moment *moment, lom_error *error)
{
    const bool first = moment->placements == NULL;
    if (first)
        moment->placements = lom_allocate(world->entity_count, sizeof *moment->placements, error);
    if (moment->placements == NULL)
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    moment->time = time;
    moment->scene = *world->scene;
    moment->scene.light = lom_scene_light_at(world->scene, time);
    moment->to_light = lom_to_light(&moment->scene.light);
    moment->camera = lom_scene_camera_at(world->scene, time);
    bool done = place_all(world, moment, first, error) && lom_place_lamps(world, moment, error);
    lom_leave_float_state(&state);
    if (!done && first)
        lom_free_moment(moment);
    return done;
}

void lom_free_moment(struct lom_moment *moment)
{
    lom_release(moment->placements);
    moment->placements = NULL;
    lom_release(moment->lamps);
    moment->lamps = NULL;
    moment->lamp_count = moment->lamp_capacity = 0;
}

bool lom_world_moves(const struct lom_world *world)
{
    bool moves = world->scene->light.key_count != 0;
    for (size_t i = 0; i < world->scene->lamp_count; i++)
        moves = moves || world->scene->lamps[i].key_count != 0;
    for (size_t i = 0; i < world->entity_count; i++)
        moves = moves || world->entities[i].entity->key_count != 0;
    return moves;
}
