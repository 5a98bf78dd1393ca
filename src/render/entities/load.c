/* Entities for drawing. In: the scene. Out: meshes placed in the world, with a material for each part. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "render/renderer.h"

#include <stdio.h>
#include <string.h>

/* T Rz Ry Rx S, and what follows from it. False when it is singular. */
static bool place(struct lom_loaded_entity *loaded, lom_vec3 position, lom_vec3 rotation)
{
    loaded->world_from_model = lom_model_matrix(position, rotation, loaded->entity->scale);
    loaded->bounds = lom_transform_box(&loaded->world_from_model, lom_mesh_bounds(loaded->drawn));
    return lom_normal_matrix(&loaded->world_from_model, &loaded->normal_from_model);
}

void lom_move_entities(lom_renderer *renderer, double time)
{
    for (size_t i = 0; i < renderer->entities.count; i++) {
        struct lom_loaded_entity *loaded = &renderer->entities.items[i];
        lom_entity_place at = lom_scene_entity_at(loaded->entity, time);
        if (loaded->entity->key_count != 0)
            place(loaded, at.position, at.rotation);
    }
}

static void copy3(float out[3], const double in[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)in[i];
}

static bool load_texture(lom_renderer *renderer, const char *path, const lom_texture **texture, lom_error *error)
{
    *texture = lom_load_texture(renderer, path, true, error);
    return *texture != NULL;
}

/* The map of a mesh's material, beside the mesh. One that cannot be read is left out with a warning. */
static bool load_map(lom_renderer *renderer, const lom_entity *entity, const lom_material *material,
                     const lom_texture **texture, lom_error *error)
{
    char path[4096];
    lom_error unreadable = { .code = LOM_OK };
    const char *slash = strrchr(entity->mesh, '/');
    int folder = slash == NULL ? 0 : (int)(slash - entity->mesh) + 1;
    snprintf(path, sizeof path, "%.*s%s", folder, entity->mesh, material->diffuse_map);
    if (load_texture(renderer, path, texture, &unreadable))
        return true;
    return (lom_check_device(renderer->device, &unreadable) && lom_warn_instead(&renderer->warnings, &unreadable)) ||
           lom_pass_error(&unreadable, error);
}

/* The mesh's own material, where the entity does not say otherwise. */
static bool load_material(lom_renderer *renderer, const lom_entity *entity, const lom_material *own,
                          struct lom_material_uniform *out, lom_error *error)
{
    const lom_scene_material *over = &entity->material;
    lom_material base = own != NULL ? *own : lom_default_material("");
    memcpy(out->ambient, base.ambient, sizeof out->ambient);
    memcpy(out->diffuse, base.diffuse, sizeof out->diffuse);
    memcpy(out->specular, base.specular, sizeof out->specular);
    out->shininess = base.shininess;
    out->texture = NULL;
    if (over->has_ambient)
        copy3(out->ambient, over->ambient);
    if (over->has_diffuse)
        copy3(out->diffuse, over->diffuse);
    if (over->has_specular)
        copy3(out->specular, over->specular);
    if (over->has_shininess)
        out->shininess = (float)over->shininess;
    if (over->texture != NULL)
        return load_texture(renderer, over->texture, &out->texture, error);
    return base.diffuse_map[0] == 0 || load_map(renderer, entity, &base, &out->texture, error);
}

static bool load_parts(lom_renderer *renderer, struct lom_loaded_entity *loaded, lom_error *error)
{
    const lom_mesh *mesh = loaded->drawn;
    loaded->parts = lom_allocate(mesh->part_count, sizeof *loaded->parts, error);
    if (loaded->parts == NULL)
        return false;
    for (size_t i = 0; i < mesh->part_count; i++) {
        const lom_mesh_part *part = &mesh->parts[i];
        const lom_material *own = part->material < 0 ? NULL : &mesh->materials[part->material];
        loaded->parts[i].first = part->first_index;
        loaded->parts[i].count = part->index_count;
        if (!load_material(renderer, loaded->entity, own, &loaded->parts[i].material, error))
            return false;
    }
    return true;
}

static const lom_mesh *find_mesh(const lom_renderer *renderer, const char *path)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        if (renderer->entities.items[i].mesh != NULL && strcmp(renderer->entities.items[i].entity->mesh, path) == 0)
            return renderer->entities.items[i].mesh;
    return NULL;
}

static bool load_entity(lom_renderer *renderer, const lom_entity *entity, const lom_image *ground, lom_error *error)
{
    struct lom_loaded_entity *loaded = &renderer->entities.items[renderer->entities.count];
    loaded->entity = entity;
    loaded->drawn = find_mesh(renderer, entity->mesh);
    if (loaded->drawn == NULL)
        loaded->drawn = loaded->mesh = lom_read_obj(entity->mesh, error);
    renderer->entities.count++;
    if (loaded->drawn == NULL)
        return false;
    if (loaded->mesh != NULL)
        lom_add_warnings(&renderer->warnings, &loaded->mesh->warnings);
    const lom_terrain *t = &renderer->scene->terrain;
    lom_vec3 position = entity->position;
    if (entity->on_ground && ground != NULL)
        position.y += lom_terrain_height(ground, t->size[0], t->size[1], t->height, t->base, position.x, position.z);
    if (!place(loaded, position, entity->rotation))
        return lom_fail(error, LOM_ERROR_INPUT, "%s: an entity's scale makes its matrix singular.", entity->mesh);
    const lom_vec3 sides = lom_vec3_subtract(loaded->bounds.high, loaded->bounds.low);
    const double flat = sides.x > sides.z ? sides.x : sides.z;
    loaded->home = position;
    loaded->home_size = sides.y > flat ? sides.y : flat;
    const lom_camera *camera = &renderer->scene->camera;
    loaded->is_hidden = camera->person == LOM_PERSON_FIRST && camera->followed != 0 &&
                        entity == &renderer->scene->entities[camera->followed - 1];
    return load_parts(renderer, loaded, error);
}

bool lom_load_entities(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    lom_image *ground = NULL;
    renderer->entities.items = lom_allocate(scene->entity_count, sizeof *renderer->entities.items, error);
    if (renderer->entities.items == NULL)
        return false;
    if (scene->terrain.present) {
        ground = lom_read_image(scene->terrain.height_map, error);
        if (ground == NULL)
            return false;
    }
    bool done = true;
    for (size_t i = 0; done && i < scene->entity_count; i++)
        if (scene->entities[i].visible)
            done = load_entity(renderer, &scene->entities[i], ground, error);
    lom_free_image(ground);
    return done;
}

void lom_free_entities(lom_renderer *renderer)
{
    for (size_t i = 0; i < renderer->entities.count; i++) {
        lom_free_mesh(renderer->entities.items[i].mesh);
        lom_release(renderer->entities.items[i].parts);
    }
    lom_release(renderer->entities.items);
}
