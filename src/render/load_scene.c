/* The scene's things as the pipeline draws them. In: the scene. Out: terrain in blocks, entities placed in the world
 * with a material for each part, the water's maps. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "render/renderer.h"
#include "spray/make_foam.h"
#include "water/lake.h"

#include <stdio.h>
#include <string.h>

/* The mean over the coarsest level of a texture of colours; no texture is white. */
static bool find_brightness(const lom_texture *texture, float *mean, lom_error *error)
{
    lom_image *level = NULL, *gray = NULL;
    double sum = 0;
    if (texture == NULL)
        return true;
    level = lom_read_texture(texture, lom_texture_levels(texture) - 1, 0, error);
    gray = level == NULL ? NULL : lom_convert_image(level, LOM_FORMAT_R32F, error);
    if (gray != NULL) {
        size_t count = (size_t)gray->width * (size_t)gray->height;
        for (size_t i = 0; i < count; i++)
            sum += (double)((const float *)(const void *)gray->pixels)[i];
        *mean = sum > 1e-3 * (double)count ? (float)(sum / (double)count) : 1e-3f;
    }
    lom_free_image(level);
    lom_free_image(gray);
    return gray != NULL;
}

bool lom_load_terrain(lom_renderer *renderer, lom_error *error)
{
    const lom_terrain *t = &renderer->scene->terrain;
    if (!t->present)
        return true;
    lom_image *map = lom_read_image(t->height_map, error);
    if (map == NULL)
        return false;
    const lom_scene *scene = renderer->scene;
    struct lom_ground *ground = &renderer->ground;
    bool done =
        lom_load_ground(ground, t, map, &scene->quality, renderer->device, error) && lom_load_bed(renderer, error);
    lom_free_image(map);
    if (done && t->texture != NULL)
        done = lom_load_texture(renderer, t->texture, true, error) != NULL;
    if (done && t->layer_count > LOM_MAX_TERRAIN_LAYERS)
        return lom_fail(error, LOM_ERROR_LIMIT, "%s: a terrain has at most %d layers, and this one has %zu.",
                        renderer->scene->path, LOM_MAX_TERRAIN_LAYERS, t->layer_count);
    const lom_texture *below = done && t->texture != NULL ? lom_load_texture(renderer, t->texture, true, error) : NULL;
    for (size_t i = 0; done && i < t->layer_count; i++) {
        renderer->brightness_below[i] = 1;
        done = t->layers[i].grain == 0 || find_brightness(below, &renderer->brightness_below[i], error);
        below = done ? lom_load_texture(renderer, t->layers[i].map, true, error) : NULL;
        done = below != NULL;
    }
    if (done && t->detail_map != NULL)
        done = lom_load_texture(renderer, t->detail_map, false, error) != NULL;
    if (done && t->normal_map != NULL)
        done = lom_load_texture(renderer, t->normal_map, false, error) != NULL;
    return done;
}

bool lom_load_water(lom_renderer *renderer, lom_error *error)
{
    const lom_water_params *w = &renderer->scene->water;
    if (!w->present || w->normal_map == NULL)
        return true;
    renderer->normal_map = lom_load_texture(renderer, w->normal_map, false, error);
    if (renderer->normal_map == NULL)
        return false;
    if (w->flow_map != NULL)
        renderer->flow_map = lom_load_texture(renderer, w->flow_map, false, error);
    if (w->flow_map != NULL || !w->flow)
        return renderer->flow_map != NULL || !w->flow;
    lom_image *file = lom_read_image(w->normal_map, error);
    lom_image *flow = file == NULL ? NULL : lom_make_flow_map(file, error);
    lom_image *rgba = flow == NULL ? NULL : lom_convert_image(flow, LOM_FORMAT_RGBA8, error);
    if (rgba != NULL)
        renderer->flow_map = lom_make_texture(renderer->device, &(lom_texture_desc){ .width = rgba->width,
                                                                                     .height = rgba->height,
                                                                                     .pixels = rgba->pixels,
                                                                                     .mips = LOM_MIPS_ALL });
    lom_free_image(file);
    lom_free_image(flow);
    lom_free_image(rgba);
    return renderer->flow_map != NULL;
}

static bool load_foam(lom_renderer *renderer, lom_error *error)
{
    const lom_water_foam *foam = &renderer->scene->water.foam;
    if (!(foam->amount > 0) && !(foam->shore_depth > 0))
        return true;
    lom_image *pattern = lom_make_foam(256, 1, error);
    if (pattern == NULL)
        return false;
    renderer->foam = lom_make_texture(renderer->device, &(lom_texture_desc){ .width = pattern->width,
                                                                             .height = pattern->height,
                                                                             .format = LOM_FORMAT_R8,
                                                                             .pixels = pattern->pixels,
                                                                             .mips = LOM_MIPS_ALL });
    lom_free_image(pattern);
    return lom_check_device(renderer->device, error);
}

bool lom_load_waves(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    const struct lom_ground *ground = &renderer->ground;
    if (!scene->water.present || !lom_water_models[scene->quality.water].has_waves)
        return true;
    renderer->wave_site =
        lom_scene_wave_site(scene, &(struct lom_bed){ ground->heights,
                                                      ground->columns,
                                                      ground->rows,
                                                      { scene->terrain.size[0], scene->terrain.size[1] },
                                                      scene->terrain.base });
    const struct lom_wave_source source = { &renderer->wave_site, renderer->normal_map, renderer->device };
    if (!load_foam(renderer, error))
        return false;
    renderer->waves = lom_load_wave_field(&source, error);
    return renderer->waves != NULL;
}

/* T Rz Ry Rx S, and what follows from it. False when it is singular. */
static bool place(struct lom_loaded_entity *loaded, lom_vec3 position, lom_vec3 rotation)
{
    loaded->world_from_model = lom_model_matrix(position, rotation, loaded->entity->scale);
    loaded->bounds = lom_transform_box(&loaded->world_from_model, lom_mesh_bounds(loaded->drawn));
    return lom_normal_matrix(&loaded->world_from_model, &loaded->normal_from_model);
}

void lom_move_scene(lom_renderer *renderer, double time)
{
    lom_scene *scene = &renderer->moment;
    scene->light = lom_scene_light_at(scene, time);
    for (size_t i = 0; i < renderer->entity_count; i++) {
        struct lom_loaded_entity *loaded = &renderer->entities[i];
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
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (renderer->entities[i].mesh != NULL && strcmp(renderer->entities[i].entity->mesh, path) == 0)
            return renderer->entities[i].mesh;
    return NULL;
}

static bool load_entity(lom_renderer *renderer, const lom_entity *entity, const lom_image *ground, lom_error *error)
{
    struct lom_loaded_entity *loaded = &renderer->entities[renderer->entity_count];
    loaded->entity = entity;
    loaded->drawn = find_mesh(renderer, entity->mesh);
    if (loaded->drawn == NULL)
        loaded->drawn = loaded->mesh = lom_read_obj(entity->mesh, error);
    renderer->entity_count++;
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
    renderer->entities = lom_allocate(scene->entity_count, sizeof *renderer->entities, error);
    if (renderer->entities == NULL)
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
