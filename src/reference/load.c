/* Loading a scene for the reference. In: the scene and its files. Out: all triangles in the world, in double, with what
 * their corners carry; materials and pictures. */
#include "reference/world.h"

#include <stdio.h>
#include <string.h>

static lom_vec3 vector(const double v[3])
{
    return (lom_vec3){ v[0], v[1], v[2] };
}

static lom_vec3 vector_of_floats(const float v[3])
{
    return (lom_vec3){ v[0], v[1], v[2] };
}

/* ---- pictures ---- */

static bool grow_pictures(lom_reference *world, lom_error *error)
{
    if (world->picture_count < world->picture_capacity)
        return true;
    size_t capacity = 2 * world->picture_count + 8;
    struct lom_ray_picture *larger = lom_allocate(capacity, sizeof *larger, error);
    if (larger == NULL)
        return false;
    if (world->picture_count > 0)
        memcpy(larger, world->pictures, world->picture_count * sizeof *larger);
    lom_release(world->pictures);
    world->pictures = larger;
    world->picture_capacity = capacity;
    return true;
}

/* The index of a picture, loaded once; NULL is none. color: sRGB-encoded unless the scene's transfer is naive. */
static bool find_picture(lom_reference *world, const char *path, bool color, int *index, lom_error *error)
{
    *index = LOM_NO_PICTURE;
    if (path == NULL)
        return true;
    for (size_t i = 0; i < world->picture_count; i++)
        if (world->pictures[i].color == color && strcmp(world->pictures[i].path, path) == 0) {
            *index = (int)i;
            return true;
        }
    if (!grow_pictures(world, error))
        return false;
    struct lom_ray_picture *picture = &world->pictures[world->picture_count];
    size_t size = strlen(path) + 1;
    char *copy = lom_allocate(size, 1, error);
    if (copy == NULL)
        return false;
    if (!lom_load_picture(&picture->picture, path, color && world->scene->output.transfer == LOM_TRANSFER_SRGB,
                          error)) {
        lom_free_picture(&picture->picture);
        *picture = (struct lom_ray_picture){ .path = NULL };
        lom_release(copy);
        return false;
    }
    picture->path = memcpy(copy, path, size);
    picture->color = color;
    *index = (int)world->picture_count++;
    return true;
}

/* ---- terrain ---- */

static bool load_layer(lom_reference *world, struct lom_ray_layer *layer, const char *path, bool color, double tile,
                       lom_error *error)
{
    const lom_terrain *t = &world->scene->terrain;
    layer->scale[0] = 1 / (tile > 0 ? tile : t->size[0]);
    layer->scale[1] = 1 / (tile > 0 ? tile : t->size[1]);
    return find_picture(world, path, color, &layer->picture, error);
}

static bool load_ground(lom_reference *world, lom_error *error)
{
    const lom_terrain *t = &world->scene->terrain;
    world->ground = (struct lom_ray_material){ .ambient = vector(t->material.ambient),
                                               .diffuse = vector(t->material.diffuse),
                                               .specular = vector(t->material.specular),
                                               .shininess = t->material.shininess,
                                               .picture = LOM_NO_PICTURE };
    world->layers = lom_allocate(t->layer_count, sizeof *world->layers, error);
    bool done = world->layers != NULL && load_layer(world, &world->ground_texture, t->texture, true, t->tile, error) &&
                load_layer(world, &world->ground_detail, t->detail_map, false, t->detail_tile, error) &&
                load_layer(world, &world->ground_normals, t->normal_map, false, t->detail_tile, error);
    int below = world->ground_texture.picture;
    for (size_t i = 0; done && i < t->layer_count; i++) {
        struct lom_ray_layer *layer = &world->layers[i];
        done = load_layer(world, layer, t->layers[i].map, true, t->layers[i].tile, error);
        layer->below = 1;
        if (done && t->layers[i].grain != 0 && below >= 0)
            layer->below = at_least(lom_mean_brightness(&world->pictures[below].picture), 1e-3);
        below = layer->picture;
    }
    return done;
}

/* ---- meshes ---- */

struct loader {
    lom_reference *world;
    lom_image *height_map;
    lom_mesh *terrain;
    lom_mesh **meshes; /* of each entity; the first that names a file owns its mesh */
    lom_error *error;
};

static lom_mesh *find_mesh(const struct loader *loader, size_t before, const char *path)
{
    const lom_entity *entities = loader->world->scene->entities;
    for (size_t i = 0; i < before; i++)
        if (loader->meshes[i] != NULL && strcmp(entities[i].mesh, path) == 0)
            return loader->meshes[i];
    return NULL;
}

/* Reads every file and counts points, triangles and materials. */
static bool read_meshes(struct loader *loader)
{
    lom_reference *world = loader->world;
    const lom_scene *scene = world->scene;
    const lom_terrain *t = &scene->terrain;
    loader->meshes = lom_allocate(scene->entity_count, sizeof(lom_mesh *), loader->error);
    if (loader->meshes == NULL)
        return false;
    if (t->present) {
        loader->height_map = lom_read_image(t->height_map, loader->error);
        if (loader->height_map != NULL)
            loader->terrain =
                lom_make_terrain(loader->height_map, t->size[0], t->size[1], t->height, t->base, loader->error);
        if (loader->terrain == NULL)
            return false;
        world->point_count += loader->terrain->vertex_count;
        world->triangle_count += loader->terrain->index_count / 3;
    }
    for (size_t i = 0; i < scene->entity_count; i++) {
        if (!scene->entities[i].visible)
            continue;
        loader->meshes[i] = find_mesh(loader, i, scene->entities[i].mesh);
        if (loader->meshes[i] == NULL) {
            loader->meshes[i] = lom_read_obj(scene->entities[i].mesh, loader->error);
            if (loader->meshes[i] == NULL)
                return false;
            lom_add_warnings(&world->warnings, &loader->meshes[i]->warnings);
        }
        world->point_count += loader->meshes[i]->vertex_count;
        world->triangle_count += loader->meshes[i]->index_count / 3;
        world->material_count += loader->meshes[i]->part_count;
    }
    if (world->point_count >= UINT32_MAX || world->triangle_count >= UINT32_MAX / 2)
        return lom_fail(loader->error, LOM_ERROR_LIMIT, "%s: the reference holds at most 2^31 triangles.", scene->path);
    return true;
}

static bool allocate_world(lom_reference *world, lom_error *error)
{
    world->points = lom_allocate(world->point_count, sizeof *world->points, error);
    world->corners = lom_allocate(world->point_count, sizeof *world->corners, error);
    world->triangles = lom_allocate(world->triangle_count, sizeof *world->triangles, error);
    world->materials = lom_allocate(world->material_count, sizeof *world->materials, error);
    world->point_count = world->triangle_count = world->material_count = 0; /* counted again while they are filled */
    return world->points != NULL && world->corners != NULL && world->triangles != NULL && world->materials != NULL;
}

/* Appends the vertices of a mesh; NULL matrices: as they are. Returns the index of the first. */
static uint32_t add_points(lom_reference *world, const lom_mesh *mesh, const lom_mat4 *place, const lom_mat4 *normals)
{
    uint32_t first = (uint32_t)world->point_count;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const lom_mesh_vertex *v = &mesh->vertices[i];
        lom_vec3 position = vector_of_floats(v->position), normal = vector_of_floats(v->normal);
        world->points[world->point_count] = place == NULL ? position : lom_transform_point(place, position);
        world->corners[world->point_count++] =
            (struct lom_ray_corner){ .normal = normals == NULL ? normal : lom_transform_direction(normals, normal),
                                     .color = vector_of_floats(v->color),
                                     .u = v->uv[0],
                                     .v = v->uv[1] };
    }
    return first;
}

/* Appends the triangles of a part; turned: their sense is reversed. */
static void add_triangles(lom_reference *world, const lom_mesh *mesh, const lom_mesh_part *part, uint32_t first_point,
                          uint32_t material, bool turned)
{
    for (uint32_t i = 0; i + 2 < part->index_count; i += 3) {
        const uint32_t *index = mesh->indices + part->first_index + i;
        struct lom_ray_triangle *triangle = &world->triangles[world->triangle_count++];
        triangle->corner[0] = first_point + index[0];
        triangle->corner[1] = first_point + index[turned ? 2 : 1];
        triangle->corner[2] = first_point + index[turned ? 1 : 2];
        triangle->material = material;
    }
}

/* ---- entities ---- */

/* The mesh's own material, where the entity does not say otherwise. */
/* The map of a mesh's material, beside the mesh. One that cannot be read is left out with a warning. */
static bool find_map(lom_reference *world, const lom_entity *entity, const lom_material *material, int *index,
                     lom_error *error)
{
    char path[4096];
    lom_error unreadable = { .code = LOM_OK };
    const char *slash = strrchr(entity->mesh, '/');
    int folder = slash == NULL ? 0 : (int)(slash - entity->mesh) + 1;
    snprintf(path, sizeof path, "%.*s%s", folder, entity->mesh, material->diffuse_map);
    if (find_picture(world, material->diffuse_map[0] != 0 ? path : NULL, true, index, &unreadable))
        return true;
    *index = LOM_NO_PICTURE;
    return lom_warn_instead(&world->warnings, &unreadable) || lom_fail(error, unreadable.code, "%s", unreadable.text);
}

static bool add_material(lom_reference *world, const lom_entity *entity, const lom_material *own, lom_error *error)
{
    const lom_scene_material *over = &entity->material;
    lom_material base = own != NULL ? *own : lom_default_material("");
    struct lom_ray_material *m = &world->materials[world->material_count++];
    m->ambient = over->has_ambient ? vector(over->ambient) : vector_of_floats(base.ambient);
    m->diffuse = over->has_diffuse ? vector(over->diffuse) : vector_of_floats(base.diffuse);
    m->specular = over->has_specular ? vector(over->specular) : vector_of_floats(base.specular);
    m->shininess = over->has_shininess ? over->shininess : base.shininess;
    if (over->texture != NULL)
        return find_picture(world, over->texture, true, &m->picture, error);
    return find_map(world, entity, &base, &m->picture, error);
}

static double determinant(const lom_mat4 *m)
{
    const double(*r)[4] = m->m;
    lom_vec3 x = { r[0][0], r[1][0], r[2][0] }, y = { r[0][1], r[1][1], r[2][1] }, z = { r[0][2], r[1][2], r[2][2] };
    return dot(cross(x, y), z);
}

static bool add_entity(struct loader *loader, size_t index)
{
    lom_reference *world = loader->world;
    const lom_terrain *t = &world->scene->terrain;
    const lom_entity *entity = &world->scene->entities[index];
    const lom_mesh *mesh = loader->meshes[index];
    lom_vec3 position = entity->position;
    if (entity->on_ground && loader->height_map != NULL)
        position.y +=
            lom_terrain_height(loader->height_map, t->size[0], t->size[1], t->height, t->base, position.x, position.z);
    lom_mat4 place = lom_model_matrix(position, entity->rotation, entity->scale), normals;
    if (!lom_normal_matrix(&place, &normals))
        return lom_fail(loader->error, LOM_ERROR_INPUT, "%s: an entity's scale makes its matrix singular.",
                        entity->mesh);
    uint32_t first = add_points(world, mesh, &place, &normals);
    for (size_t i = 0; i < mesh->part_count; i++) {
        const lom_mesh_part *part = &mesh->parts[i];
        add_triangles(world, mesh, part, first, (uint32_t)world->material_count, determinant(&place) < 0);
        if (!add_material(world, entity, part->material < 0 ? NULL : &mesh->materials[part->material], loader->error))
            return false;
    }
    return true;
}

static void free_meshes(struct loader *loader)
{
    const lom_scene *scene = loader->world->scene;
    for (size_t i = 0; loader->meshes != NULL && i < scene->entity_count; i++)
        if (loader->meshes[i] != NULL && find_mesh(loader, i, scene->entities[i].mesh) == NULL)
            lom_free_mesh(loader->meshes[i]);
    lom_release(loader->meshes);
    lom_free_mesh(loader->terrain);
    lom_free_image(loader->height_map);
}

static bool load_triangles(lom_reference *world, lom_error *error)
{
    struct loader loader = { .world = world, .error = error };
    bool done = read_meshes(&loader) && allocate_world(world, error);
    if (done && loader.terrain != NULL) {
        uint32_t first = add_points(world, loader.terrain, NULL, NULL);
        add_triangles(world, loader.terrain, &loader.terrain->parts[0], first, LOM_TERRAIN_MATERIAL, false);
        world->ground_columns = loader.height_map->width;
        world->ground_rows = loader.height_map->height;
        done = load_ground(world, error);
    }
    for (size_t i = 0; done && i < world->scene->entity_count; i++)
        if (loader.meshes[i] != NULL)
            done = add_entity(&loader, i);
    free_meshes(&loader);
    return done;
}

/* ---- light, sky, water ---- */

static void set_light(lom_reference *world)
{
    const lom_light *light = &world->scene->light;
    world->to_light = scaled(light->direction, -1);
    world->light = scaled(vector(light->color), light->intensity);
    world->ambient = vector(light->ambient);
    world->ground_light = vector(light->ground);
}

static bool load_sky(lom_reference *world, lom_error *error)
{
    const lom_sky_params *sky = &world->scene->sky;
    world->sky_sine = lom_double_sin(-sky->rotation);
    world->sky_cosine = lom_double_cos(-sky->rotation);
    if (!sky->present || sky->faces[0] == NULL)
        return true;
    return lom_load_cube(&world->sky, sky->faces, world->scene->output.transfer == LOM_TRANSFER_SRGB, error);
}

/* The flow map that belongs to a normal map whose scene names none. */
static bool make_flow_map(lom_reference *world, const char *normal_map, lom_error *error)
{
    lom_image *normals = lom_read_image(normal_map, error);
    lom_image *flow = normals == NULL ? NULL : lom_make_flow_map(normals, error);
    bool done = flow != NULL && grow_pictures(world, error);
    if (done) {
        world->flow_map = (int)world->picture_count++;
        done = lom_make_picture(&world->pictures[world->flow_map].picture, flow, false, error);
    }
    lom_free_image(normals);
    lom_free_image(flow);
    return done;
}

/* 1 / the cosine below the surface of sunlight that came from a direction above it. */
static double find_slant(lom_vec3 to_light, double index)
{
    lom_vec3 down;
    const lom_vec3 up = { 0, 1, 0 };
    if (!(to_light.y > 0) || !lom_reference_refract(scaled(to_light, -1), up, index, &down))
        return 1;
    return -1 / down.y;
}

static bool load_water(lom_reference *world, lom_error *error)
{
    const lom_water_params *w = &world->scene->water;
    world->normal_map = world->flow_map = LOM_NO_PICTURE;
    world->slant = 1;
    world->water = (lom_reference_water){ .low = { 1, 1 }, .index = 1 };
    if (!w->present || !w->enabled)
        return true;
    for (int i = 0; i < 2; i++) {
        world->water.low[i] = w->position[i] - w->size[i] / 2;
        world->water.high[i] = w->position[i] + w->size[i] / 2;
    }
    world->water.lowest = world->water.highest = w->level;
    world->slant = find_slant(world->to_light, w->optics.index);
    world->water.roughness = w->optics.roughness;
    world->water.index = w->optics.index;
    lom_vec3 light = along(world->ambient, world->light, at_least(world->to_light.y, 0)); /* of a white surface */
    const double white[3] = { light.x, light.y, light.z };
    for (int i = 0; i < 3; i++) {
        world->water.absorption[i] = w->optics.absorption[i];
        world->water.color[i] = w->optics.scatter[i] * white[i];
    }
    if (w->normal_map == NULL || !w->normals)
        return true;
    if (!find_picture(world, w->normal_map, false, &world->normal_map, error))
        return false;
    if (!w->flow)
        return true;
    return w->flow_map != NULL ? find_picture(world, w->flow_map, false, &world->flow_map, error)
                               : make_flow_map(world, w->normal_map, error);
}

bool lom_load_world(lom_reference *world, lom_error *error)
{
    set_light(world);
    if (!load_triangles(world, error) || !load_sky(world, error) || !load_water(world, error) ||
        !lom_load_ray_clouds(world, error))
        return false;
    world->opaque = (struct lom_ray_triangles){ .points = world->points,
                                                .triangles = world->triangles,
                                                .count = (uint32_t)world->triangle_count };
    return lom_build_ray_triangles(&world->opaque, error);
}
