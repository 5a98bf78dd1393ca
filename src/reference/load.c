/* Loading a scene for the reference. In: a world. Out: materials and pictures, the ground's layers, the sky, the water:
 * what does not move. */
#include "base/numbers.h"
#include "reference/reference.h"

#include "base/reserve.h"

#include <string.h>

/* ---- pictures ---- */

/* Adds a picture of the world's; NULL is passed on. */
static bool add_picture(lom_reference *reference, const char *path, bool color, const lom_image *image, int *index,
                        lom_error *error)
{
    if (image == NULL || !lom_reserve(&reference->pictures, &reference->picture_capacity, reference->picture_count + 1,
                                      sizeof *reference->pictures, error))
        return false;
    struct lom_ray_picture *picture = &reference->pictures[reference->picture_count];
    picture->path = path;
    picture->color = color;
    lom_set_picture(&picture->picture, image, color && reference->scene->output.transfer == LOM_TRANSFER_SRGB);
    *index = (int)reference->picture_count++;
    return true;
}

/* The index of a picture, loaded once; NULL is none. color: sRGB-encoded unless the scene's transfer is naive. */
static bool find_picture(lom_reference *reference, const char *path, bool color, int *index, lom_error *error)
{
    *index = LOM_NO_PICTURE;
    if (path == NULL)
        return true;
    for (size_t i = 0; i < reference->picture_count; i++)
        if (reference->pictures[i].color == color && strcmp(reference->pictures[i].path, path) == 0) {
            *index = (int)i;
            return true;
        }
    return add_picture(reference, path, color, lom_world_picture(reference->world, path, error), index, error);
}

/* ---- terrain ---- */

static bool load_layer(lom_reference *reference, struct lom_ray_layer *layer, const char *path, bool color, double tile,
                       lom_error *error)
{
    const lom_terrain *t = &reference->scene->terrain;
    layer->scale[0] = 1 / (tile > 0 ? tile : t->size[0]);
    layer->scale[1] = 1 / (tile > 0 ? tile : t->size[1]);
    return find_picture(reference, path, color, &layer->picture, error);
}

static bool load_ground(lom_reference *reference, lom_error *error)
{
    const lom_terrain *t = &reference->scene->terrain;
    if (!t->present)
        return true;
    reference->ground_columns = reference->world->bed.columns + 1;
    reference->ground_rows = reference->world->bed.rows + 1;
    reference->ground = (struct lom_ray_material){ .ambient = vector(t->material.ambient),
                                                   .diffuse = vector(t->material.diffuse),
                                                   .specular = vector(t->material.specular),
                                                   .shininess = t->material.shininess,
                                                   .picture = LOM_NO_PICTURE,
                                                   .emissive_map = LOM_NO_PICTURE,
                                                   .specular_map = LOM_NO_PICTURE,
                                                   .gloss_map = LOM_NO_PICTURE,
                                                   .normal_map = LOM_NO_PICTURE };
    reference->layers = lom_allocate(t->layer_count, sizeof *reference->layers, error);
    bool done = reference->layers != NULL &&
                load_layer(reference, &reference->ground_texture, t->texture, true, t->tile, error) &&
                load_layer(reference, &reference->ground_detail, t->detail_map, false, t->detail_tile, error) &&
                load_layer(reference, &reference->ground_normals, t->normal_map, false, t->detail_tile, error);
    int below = reference->ground_texture.picture;
    for (size_t i = 0; done && i < t->layer_count; i++) {
        struct lom_ray_layer *layer = &reference->layers[i];
        done = load_layer(reference, layer, t->layers[i].map, true, t->layers[i].tile, error);
        layer->below = 1;
        if (done && t->layers[i].grain != 0 && below >= 0)
            layer->below = lom_larger(lom_mean_brightness(&reference->pictures[below].picture), 1e-3);
        below = layer->picture;
    }
    return done;
}

/* ---- entities ---- */

static bool load_material(lom_reference *reference, const struct lom_world_material *from, lom_error *error)
{
    struct lom_ray_material *m = &reference->materials[reference->material_count++];
    *m = (struct lom_ray_material){ .ambient = vector(from->ambient),
                                    .diffuse = vector(from->diffuse),
                                    .specular = vector(from->specular),
                                    .emissive = vector(from->emissive),
                                    .shininess = from->shininess,
                                    .opacity = from->opacity,
                                    .opacity_is_in_alpha = from->opacity_is_in_alpha };
    return find_picture(reference, from->texture, true, &m->picture, error) &&
           find_picture(reference, from->emissive_map, true, &m->emissive_map, error) &&
           find_picture(reference, from->specular_map, true, &m->specular_map, error) &&
           find_picture(reference, from->gloss_map, false, &m->gloss_map, error) &&
           find_picture(reference, from->opacity_map, false, &m->opacity_map, error) &&
           find_picture(reference, from->normal_map, false, &m->normal_map, error);
}

/* Of the fronts of an entity's parts, then of its backs. */
static bool load_materials(lom_reference *reference, lom_error *error)
{
    const struct lom_world *world = reference->world;
    size_t count = 0;
    for (size_t i = 0; i < world->entity_count; i++)
        count += world->entities[i].mesh->part_count * (world->entities[i].entity->two_sided ? 2 : 1);
    reference->materials = lom_allocate(count, sizeof *reference->materials, error);
    for (size_t i = 0; reference->materials != NULL && i < world->entity_count; i++) {
        const struct lom_world_entity *entity = &world->entities[i];
        const size_t parts = entity->mesh->part_count;
        for (size_t k = 0; k < parts; k++) {
            struct lom_ray_material *m = &reference->materials[reference->material_count];
            if (!load_material(reference, &entity->parts[k].material, error))
                return false;
            m->is_transparent = lom_is_transparent(&entity->parts[k], entity->entity);
            m->back = (uint32_t)(reference->material_count - 1 + (entity->entity->two_sided ? parts : 0));
        }
        for (size_t k = 0; entity->entity->two_sided && k < parts; k++)
            if (!load_material(reference, &entity->parts[k].back, error))
                return false;
    }
    return reference->materials != NULL;
}

/* ---- sky and water ---- */

static bool load_sky(lom_reference *reference, lom_error *error)
{
    const lom_sky_params *sky = &reference->scene->sky;
    reference->sky_sine = lom_double_sin(-sky->rotation);
    reference->sky_cosine = lom_double_cos(-sky->rotation);
    if (!sky->present || sky->faces[0] == NULL)
        return true;
    reference->sky_faces = lom_read_sky_faces(sky, reference->world->files, error);
    if (reference->sky_faces != NULL)
        lom_set_picture(&reference->sky, reference->sky_faces, reference->scene->output.transfer == LOM_TRANSFER_SRGB);
    return reference->sky_faces != NULL;
}

static bool make_flow_map(lom_reference *reference, const char *normal_map, int *index, lom_error *error)
{
    return add_picture(reference, "", false, lom_world_made_flow(reference->world, normal_map, error), index, error);
}

/* Where a water is, and its maps; without bounds where it is none. */
static bool load_water(lom_reference *reference, const lom_water_params *w, struct lom_ray_water *out, lom_error *error)
{
    out->normal_map = out->flow_map = LOM_NO_PICTURE;
    out->at = (lom_reference_water){ .low = { 1, 1 }, .index = 1 };
    if (!w->present || !w->enabled)
        return true;
    for (int i = 0; i < 2; i++) {
        out->at.low[i] = w->position[i] - w->size[i] / 2;
        out->at.high[i] = w->position[i] + w->size[i] / 2;
    }
    out->at.lowest = out->at.highest = w->level;
    out->at.roughness = w->optics.roughness;
    out->at.index = w->optics.index;
    for (int i = 0; i < 3; i++)
        out->at.absorption[i] = w->optics.absorption[i];
    if (w->normal_map == NULL || !w->normals)
        return true;
    if (w->flow && w->flow_map == NULL && !make_flow_map(reference, w->normal_map, &out->flow_map, error))
        return false;
    return find_picture(reference, w->normal_map, false, &out->normal_map, error) &&
           (!w->flow || w->flow_map == NULL || find_picture(reference, w->flow_map, false, &out->flow_map, error));
}

static bool load_waters(lom_reference *reference, lom_error *error)
{
    struct lom_ray_water first;
    bool done = load_water(reference, &reference->scene->water, &first, error);
    reference->water = first.at;
    reference->normal_map = first.normal_map;
    reference->flow_map = first.flow_map;
    for (size_t i = 0; done && i < reference->scene->other_water_count; i++)
        done = load_water(reference, &reference->scene->other_waters[i], &reference->other_waters[i], error);
    return done;
}

bool lom_load_reference(lom_reference *reference, lom_error *error)
{
    return load_ground(reference, error) && load_materials(reference, error) && load_sky(reference, error) &&
           load_waters(reference, error) && lom_load_ray_clouds(reference, error);
}
