/* Places measured from the middle of the terrain. In: a scene whose places are the file's. Out: the same less
 * terrain.position, so that x = z = 0 is the middle of the terrain for all who draw. What follows an entity is in the
 * entity's coordinates and stays. */
#include "scene/reader.h"

static void move(lom_vec3 *place, const double middle[2])
{
    place->x -= middle[0];
    place->z -= middle[1];
}

static void move_camera(lom_camera *camera, const double middle[2])
{
    if (camera->follow != NULL)
        return;
    move(&camera->position, middle);
    move(&camera->target, middle);
    for (size_t i = 0; i < camera->key_count; i++) {
        move(&camera->keys[i].position, middle);
        move(&camera->keys[i].target, middle);
    }
}

static void move_lamp(lom_lamp *lamp, const double middle[2])
{
    if (lamp->follow != NULL)
        return;
    move(&lamp->position, middle);
    for (size_t i = 0; i < lamp->key_count; i++)
        move(&lamp->keys[i].position, middle);
}

static void move_entity(lom_entity *entity, const double middle[2])
{
    move(&entity->position, middle);
    for (size_t i = 0; i < entity->key_count; i++)
        move(&entity->keys[i].position, middle);
}

static void move_box(double low[3], double high[3], const double middle[2])
{
    low[0] -= middle[0], low[2] -= middle[1];
    high[0] -= middle[0], high[2] -= middle[1];
}

static void move_fluid(lom_fluid_params *fluid, const double middle[2])
{
    move_box(fluid->low, fluid->high, middle);
    for (size_t i = 0; i < fluid->block_count; i++)
        move_box(fluid->blocks[i].low, fluid->blocks[i].high, middle);
    for (size_t i = 0; i < fluid->solid_count; i++)
        move_box(fluid->solids[i].low, fluid->solids[i].high, middle);
}

static void move_pair(double pair[2], const double middle[2])
{
    pair[0] -= middle[0];
    pair[1] -= middle[1];
}

/* Of what has a place of its own only where the file gives one: else it is where the terrain is. */
static void move_given(const lom_key_check *table, const char *key, double pair[2], const double middle[2])
{
    if (table->is_given(table, key))
        move_pair(pair, middle);
}

static void move_waters(lom_scene *scene, const lom_key_check *root, const double middle[2])
{
    for (size_t i = 0; i <= scene->other_water_count; i++) {
        const lom_key_check water = i == 0 ? lom_check_inside(root, "water") : root->element(root, "water", i);
        move_given(&water, "position", i == 0 ? scene->water.position : scene->other_waters[i - 1].position, middle);
    }
    const lom_key_check shallow = lom_check_inside(root, "shallow"), clouds = lom_check_inside(root, "clouds");
    move_given(&shallow, "position", scene->shallow.position, middle);
    for (size_t i = 0; i < scene->shallow.spring_count; i++)
        move_pair(scene->shallow.springs[i].position, middle);
    for (size_t i = 0; i < scene->shallow.body_count; i++)
        move_pair(scene->shallow.bodies[i].position, middle);
    move_given(&clouds, "middle", scene->clouds.middle, middle);
}

void lom_measure_from_terrain(lom_scene *scene, const lom_key_check *root)
{
    const double *middle = scene->terrain.position;
    if (middle[0] == 0 && middle[1] == 0)
        return;
    move_camera(&scene->camera, middle);
    for (size_t i = 0; i < scene->view_count; i++)
        move_camera(&scene->views[i].camera, middle);
    for (size_t i = 0; i < scene->lamp_count; i++)
        move_lamp(&scene->lamps[i], middle);
    for (size_t i = 0; i < scene->entity_count; i++)
        move_entity(&scene->entities[i], middle);
    for (size_t i = 0; i < scene->cloud_count; i++)
        move(&scene->cloud[i].position, middle);
    for (size_t i = 0; i < scene->spray_count; i++)
        move_box(scene->sprays[i].from, scene->sprays[i].to, middle);
    for (size_t i = 0; i < scene->fluid_count; i++)
        move_fluid(&scene->fluids[i], middle);
    move_waters(scene, root, middle);
}

lom_vec3 lom_place_in_file(const lom_scene *scene, lom_vec3 place)
{
    return (lom_vec3){ place.x + scene->terrain.position[0], place.y, place.z + scene->terrain.position[1] };
}
