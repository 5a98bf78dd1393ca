/* A loaded scene at a time. In: a world, a time. Out: the light then, and all triangles in the world, in double, with
 * what their corners carry. */
#include "base/numbers.h"
#include "reference/reference.h"

static lom_vec3 vector_of_floats(const float v[3])
{
    return (lom_vec3){ v[0], v[1], v[2] };
}

/* ---- triangles ---- */

/* Appends the vertices of a mesh; NULL: as they are. Returns the index of the first. */
static uint32_t add_points(lom_reference *reference, const lom_mesh *mesh, const lom_mat4 *place,
                           const lom_mat4 *normals)
{
    uint32_t first = (uint32_t)reference->point_count;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const lom_mesh_vertex *v = &mesh->vertices[i];
        lom_vec3 position = vector_of_floats(v->position), normal = vector_of_floats(v->normal);
        reference->points[reference->point_count] = place == NULL ? position : lom_transform_point(place, position);
        reference->corners[reference->point_count++] =
            (struct lom_ray_corner){ .normal = normals == NULL ? normal : lom_transform_direction(normals, normal),
                                     .color = vector_of_floats(v->color),
                                     .u = v->uv[0],
                                     .v = v->uv[1] };
    }
    return first;
}

/* Appends the triangles of a part; turned: their sense is reversed. */
static void add_triangles(lom_reference *reference, const lom_mesh *mesh, const lom_mesh_part *part,
                          uint32_t first_point, uint32_t material, bool turned)
{
    for (uint32_t i = 0; i + 2 < part->index_count; i += 3) {
        const uint32_t *index = mesh->indices + part->first_index + i;
        struct lom_ray_triangle *triangle = &reference->triangles[reference->triangle_count++];
        triangle->corner[0] = first_point + index[0];
        triangle->corner[1] = first_point + index[turned ? 2 : 1];
        triangle->corner[2] = first_point + index[turned ? 1 : 2];
        triangle->material = material;
    }
}

static double determinant(const lom_mat4 *m)
{
    const double(*r)[4] = m->m;
    lom_vec3 x = { r[0][0], r[1][0], r[2][0] }, y = { r[0][1], r[1][1], r[2][1] }, z = { r[0][2], r[1][2], r[2][2] };
    return dot(cross(x, y), z);
}

/* The ground's points come first. */
static bool add_ground(lom_reference *reference, lom_error *error)
{
    const lom_terrain *t = &reference->scene->terrain;
    if (reference->ground_columns == 0)
        return true;
    const lom_mat4 raised = lom_translation((lom_vec3){ 0, t->base, 0 });
    lom_mesh *ground = lom_make_terrain(reference->world->height_map, t->size[0], t->size[1], t->height, 0, error);
    if (ground != NULL) {
        uint32_t first = add_points(reference, ground, &raised, NULL);
        add_triangles(reference, ground, &ground->parts[0], first, LOM_TERRAIN_MATERIAL, false);
    }
    lom_free_mesh(ground);
    return ground != NULL;
}

/* The points of one side of an entity, and its triangles that are opaque; a back has them the other way round and the
 * normals too. */
static void add_side(lom_reference *reference, const lom_mesh *mesh, const struct lom_placement *at, bool back,
                     uint32_t material)
{
    lom_mat4 normals = at->normal_from_model;
    for (int i = 0; i < 16 && back; i++)
        normals.m[i / 4][i % 4] = -normals.m[i / 4][i % 4];
    uint32_t first = add_points(reference, mesh, &at->world_from_model, &normals);
    const bool turned = determinant(&at->world_from_model) < 0;
    const uint32_t parts = (uint32_t)mesh->part_count, front = back ? material - parts : material;
    for (uint32_t k = 0; k < parts; k++)
        if (!reference->materials[front + k].is_transparent)
            add_triangles(reference, mesh, &mesh->parts[k], first, material + k, turned != back);
}

/* Those that are transparent, once for both sides; `first` is the first point of the first entity. */
static void add_transparent(lom_reference *reference, uint32_t first)
{
    uint32_t material = 0;
    for (size_t i = 0; i < reference->world->entity_count; i++) {
        const struct lom_world_entity *entity = &reference->world->entities[i];
        const uint32_t sides = entity->entity->two_sided ? 2 : 1, parts = (uint32_t)entity->mesh->part_count;
        bool turned = determinant(&reference->moment.placements[i].world_from_model) < 0;
        for (uint32_t k = 0; k < parts; k++)
            if (reference->materials[material + k].is_transparent)
                add_triangles(reference, entity->mesh, &entity->mesh->parts[k], first, material + k, turned);
        first += sides * (uint32_t)entity->mesh->vertex_count;
        material += sides * parts;
    }
}

/* What is transparent comes last. */
static void add_entities(lom_reference *reference)
{
    const uint32_t first = (uint32_t)reference->point_count;
    uint32_t material = 0;
    for (size_t i = 0; i < reference->world->entity_count; i++) {
        const struct lom_world_entity *entity = &reference->world->entities[i];
        for (int side = 0; side < (entity->entity->two_sided ? 2 : 1); side++) {
            add_side(reference, entity->mesh, &reference->moment.placements[i], side == 1, material);
            material += (uint32_t)entity->mesh->part_count;
        }
    }
    reference->opaque.count = (uint32_t)reference->triangle_count;
    add_transparent(reference, first);
}

static bool allocate(lom_reference *reference, lom_error *error)
{
    const struct lom_bed *bed = &reference->world->bed;
    const bool ground = reference->ground_columns > 0;
    size_t points = ground ? (size_t)(bed->columns + 1) * (size_t)(bed->rows + 1) : 0;
    size_t triangles = ground ? 2 * (size_t)bed->columns * (size_t)bed->rows : 0;
    for (size_t i = 0; i < reference->world->entity_count; i++) {
        const struct lom_world_entity *entity = &reference->world->entities[i];
        const size_t sides = entity->entity->two_sided ? 2 : 1;
        points += entity->mesh->vertex_count * sides;
        triangles += entity->mesh->index_count / 3 * sides;
    }
    if (points >= UINT32_MAX || triangles >= UINT32_MAX / 2)
        return lom_fail(error, LOM_ERROR_LIMIT, "%s: the reference holds at most 2^31 triangles.",
                        reference->scene->path);
    reference->points = lom_allocate(points, sizeof *reference->points, error);
    reference->corners = lom_allocate(points, sizeof *reference->corners, error);
    reference->triangles = lom_allocate(triangles, sizeof *reference->triangles, error);
    return reference->points != NULL && reference->corners != NULL && reference->triangles != NULL;
}

/* ---- light ---- */

/* 1 / the cosine below the surface of sunlight that came from a direction above it. */
static double find_slant(lom_vec3 to_light, double index)
{
    lom_vec3 down;
    const lom_vec3 up = { 0, 1, 0 };
    if (!(to_light.y > 0) || !lom_reference_refract(scaled(to_light, -1), up, index, &down))
        return 1;
    return -1 / down.y;
}

void lom_light_reference(lom_reference *reference)
{
    const lom_light *light = &reference->scene->light;
    const lom_water_optics *optics = &reference->scene->water.optics;
    const bool water = reference->scene->water.present && reference->scene->water.enabled;
    reference->to_light = reference->moment.to_light;
    reference->light = scaled(vector(light->color), light->intensity);
    reference->ambient = vector(light->ambient);
    reference->ground_light = vector(light->ground);
    reference->slant = water ? find_slant(reference->to_light, optics->index) : 1;
    if (!water || reference->own_water)
        return;
    lom_vec3 lit =
        along(reference->ambient, reference->light, lom_larger(reference->to_light.y, 0)); /* a white surface */
    const double white[3] = { lit.x, lit.y, lit.z };
    for (int i = 0; i < 3; i++)
        reference->water.color[i] = optics->scatter[i] * white[i];
}

/* ---- all of it ---- */

bool lom_place_reference(lom_reference *reference, double time, lom_error *error)
{
    reference->moment = (struct lom_moment){ .placements = NULL };
    reference->scene = &reference->moment.scene;
    reference->opaque = reference->transparent = (struct lom_ray_triangles){ .points = NULL };
    reference->points = NULL;
    reference->corners = NULL;
    reference->triangles = NULL;
    reference->point_count = reference->triangle_count = 0;
    if (!lom_world_at(reference->world, time, &reference->moment, error))
        return false;
    lom_light_reference(reference);
    if (!allocate(reference, error) || !add_ground(reference, error))
        return false;
    add_entities(reference);
    const uint32_t opaque = reference->opaque.count;
    reference->opaque =
        (struct lom_ray_triangles){ .points = reference->points, .triangles = reference->triangles, .count = opaque };
    reference->transparent = (struct lom_ray_triangles){ .points = reference->points,
                                                         .triangles = reference->triangles + opaque,
                                                         .count = (uint32_t)reference->triangle_count - opaque };
    return lom_build_ray_triangles(&reference->opaque, error) &&
           (reference->transparent.count == 0 || lom_build_ray_triangles(&reference->transparent, error));
}

void lom_free_placed(lom_reference *reference)
{
    lom_free_ray_triangles(&reference->opaque);
    lom_free_ray_triangles(&reference->transparent);
    lom_release(reference->triangles);
    lom_release(reference->corners);
    lom_release(reference->points);
    lom_free_moment(&reference->moment);
}
