/* Making and freeing a world. In: a scene. Out: its ground and its entities, from files that are read once.
 * Invariant: entities that name one mesh share it. */
#include "world/materials.h"

#include "base/reserve.h"
#include "geometry/terrain.h"

#include <string.h>

/* ---- the ground ---- */

const lom_image *lom_world_height_map(struct lom_world *world, lom_error *error)
{
    const lom_terrain *t = &world->scene->terrain;
    if (world->height_map == NULL && t->present)
        world->height_map = lom_take_image(world->files, t->height_map, error);
    return world->height_map;
}

static bool read_ground(struct lom_world *world, bool is_shared, lom_error *error)
{
    const lom_terrain *t = &world->scene->terrain;
    world->bed = (struct lom_bed){ .size = { t->size[0], t->size[1] }, .base = t->base };
    if (!t->present)
        return true;
    if (is_shared) {
        world->heights = world->before->heights;
        world->bed = world->before->bed;
        return true;
    }
    const lom_image *map = lom_world_height_map(world, error);
    if (map == NULL)
        return false;
    world->heights = lom_allocate((size_t)map->width * (size_t)map->height, sizeof *world->heights, error);
    world->bed.heights = world->heights;
    world->bed.columns = map->width - 1;
    world->bed.rows = map->height - 1;
    return world->heights != NULL && lom_read_terrain_heights(map, t->size, t->height, world->heights, error);
}

/* ---- entities ---- */

static lom_mesh *held_mesh(const struct lom_world *world, const char *path)
{
    for (size_t i = 0; world != NULL && i < world->mesh_count; i++)
        if (strcmp(world->meshes[i].path, path) == 0)
            return world->meshes[i].mesh;
    return NULL;
}

/* The mesh of a file, read when the first entity names it. */
static const lom_mesh *find_mesh(struct lom_world *world, const char *path, lom_error *error)
{
    lom_mesh *mesh = held_mesh(world, path);
    if (mesh != NULL)
        return mesh;
    if (!lom_reserve(&world->meshes, &world->mesh_capacity, world->mesh_count + 1, sizeof *world->meshes, error))
        return NULL;
    mesh = held_mesh(world->before, path);
    if (mesh == NULL)
        mesh = lom_take_mesh(world->files, path, error);
    if (mesh == NULL)
        return NULL;
    lom_add_warnings(&world->warnings, &mesh->warnings);
    world->meshes[world->mesh_count++] = (struct lom_world_mesh){ path, mesh };
    return mesh;
}

/* Whether the camera is in it. */
static bool is_hidden(const lom_scene *scene, const lom_entity *entity)
{
    const lom_camera *camera = &scene->camera;
    return camera->person == LOM_PERSON_FIRST && camera->followed != 0 &&
           entity == &scene->entities[camera->followed - 1];
}

/* Where the same entity of the world before stood, when that was the same place on the same ground: the height map need
 * not be read again. */
static bool keep_home(const struct lom_world *world, struct lom_world_entity *entity)
{
    const struct lom_world *before = world->before;
    const size_t number = world->entity_count - 1;
    if (before == NULL || before->heights != world->heights || number >= before->entity_count)
        return false;
    const struct lom_world_entity *other = &before->entities[number];
    const lom_vec3 a = entity->entity->position, b = other->entity->position;
    if (!other->entity->on_ground || a.x != b.x || a.y != b.y || a.z != b.z)
        return false;
    entity->home = other->home;
    return true;
}

/* Where it stands, and the camera's place in it. */
static bool put(struct lom_world *world, struct lom_world_entity *entity, lom_error *error)
{
    const lom_entity *source = entity->entity;
    const lom_terrain *t = &world->scene->terrain;
    struct lom_placement placement;
    entity->home = source->position;
    if (source->on_ground && t->present && !keep_home(world, entity)) {
        const lom_image *map = lom_world_height_map(world, error);
        if (map == NULL)
            return false;
        entity->home.y +=
            lom_terrain_height(map, t->size[0], t->size[1], t->height, t->base, entity->home.x, entity->home.z);
    }
    if (!lom_place_entity(entity, entity->home, source->rotation, &placement, error))
        return false;
    const lom_vec3 sides = lom_vec3_subtract(placement.bounds.high, placement.bounds.low);
    const double flat = sides.x > sides.z ? sides.x : sides.z;
    entity->home_size = sides.y > flat ? sides.y : flat;
    entity->is_hidden = is_hidden(world->scene, source);
    return true;
}

static bool read_entities(struct lom_world *world, lom_error *error)
{
    const lom_scene *scene = world->scene;
    world->entities = lom_allocate(scene->entity_count, sizeof *world->entities, error);
    if (world->entities == NULL)
        return false;
    for (size_t i = 0; i < scene->entity_count; i++) {
        if (!scene->entities[i].visible)
            continue;
        struct lom_world_entity *entity = &world->entities[world->entity_count++];
        entity->entity = &scene->entities[i];
        entity->mesh = find_mesh(world, entity->entity->mesh, error);
        if (entity->mesh == NULL || !put(world, entity, error) || !lom_resolve_materials(world, entity, error))
            return false;
    }
    return true;
}

/* ---- all of it ---- */

struct lom_world *lom_create_world_after(const lom_scene *scene, const struct lom_world *before, bool shares_ground,
                                         struct lom_files *files, lom_error *error)
{
    struct lom_world *world = lom_allocate(1, sizeof *world, error);
    if (world == NULL)
        return NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    world->scene = scene;
    world->before = before;
    world->files = files;
    bool done = read_ground(world, shares_ground, error) && read_entities(world, error);
    world->before = NULL;
    lom_leave_float_state(&state);
    if (done)
        return world;
    if (before != NULL)
        lom_part_worlds(before, world);
    lom_free_world(world);
    return NULL;
}

struct lom_world *lom_create_world(const lom_scene *scene, struct lom_files *files, lom_error *error)
{
    return lom_create_world_after(scene, NULL, false, files, error);
}

void lom_part_worlds(const struct lom_world *owner, struct lom_world *other)
{
    if (owner == NULL || other == NULL)
        return;
    if (other->heights == owner->heights)
        other->heights = NULL;
    for (size_t i = 0; i < other->mesh_count; i++)
        for (size_t k = 0; k < owner->mesh_count; k++)
            if (other->meshes[i].mesh == owner->meshes[k].mesh) {
                other->meshes[i].mesh = NULL;
                break;
            }
}

/* A part that has the entity's own texture goes with its name. */
static void follow_entity(struct lom_world_entity *entity, const lom_scene *scene, const lom_entity *source)
{
    entity->entity = source;
    entity->is_hidden = is_hidden(scene, source);
    const char *front = source->material.texture, *back = source->back.texture != NULL ? source->back.texture : front;
    for (size_t i = 0; i < lom_mesh_parts(entity->mesh); i++) {
        struct lom_world_part *part = &entity->parts[i];
        part->material.texture = front != NULL ? front : part->material.texture;
        part->back.texture = back != NULL ? back : part->back.texture;
    }
}

void lom_follow_scene(struct lom_world *world, const lom_scene *scene)
{
    struct lom_world_entity *next = world->entities;
    world->scene = scene;
    for (size_t i = 0; i < scene->entity_count; i++)
        if (scene->entities[i].visible)
            follow_entity(next++, scene, &scene->entities[i]);
    for (size_t i = 0; i < world->mesh_count; i++) /* that of an entity, so one of them names it */
        for (size_t k = 0; k < scene->entity_count; k++)
            if (scene->entities[k].visible && strcmp(world->meshes[i].path, scene->entities[k].mesh) == 0) {
                world->meshes[i].path = scene->entities[k].mesh;
                break;
            }
}

void lom_release_world_files(struct lom_world *world)
{
    lom_free_image(world->height_map);
    world->height_map = NULL;
    for (size_t i = 0; i < world->picture_count; i++) {
        lom_free_image(world->pictures[i].image);
        world->pictures[i].image = NULL;
    }
}

void lom_free_world(struct lom_world *world)
{
    if (world == NULL)
        return;
    lom_release_world_files(world);
    for (size_t i = 0; i < world->entity_count; i++)
        lom_release(world->entities[i].parts);
    for (size_t i = 0; i < world->mesh_count; i++)
        lom_free_mesh(world->meshes[i].mesh);
    for (size_t i = 0; i < world->picture_count; i++)
        lom_release(world->pictures[i].path);
    lom_release(world->entities);
    lom_release(world->meshes);
    lom_release(world->pictures);
    lom_release(world->heights);
    lom_release(world);
}

struct lom_wave_site lom_world_wave_site(const struct lom_world *world, size_t number)
{
    return lom_scene_wave_site(world->scene, number, &world->bed);
}
