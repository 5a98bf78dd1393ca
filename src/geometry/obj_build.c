/* Reads Wavefront OBJ, stage 2 of 2: arrays to a mesh. In: struct lom_obj. Out: a mesh with n - 2 triangles a polygon
 * in file order, one vertex for each different (v, vt, vn), numbered by first use. The hash only finds equal corners;
 * it never orders anything. */
#include "obj.h"
#include "polygon.h"

#include <stdio.h>
#include <string.h>

struct build {
    struct lom_obj *obj;
    struct lom_polygon *polygon;
    lom_vec3 *sums;          /* of unit face normals for each position; NULL when no face lacks normals */
    uint32_t *first_faces;   /* with an area, that share the position, + 1 */
    uint32_t *last_faces;    /* that were added to the sum, + 1: a face counts once */
    uint32_t *slots;         /* hash table of vertex numbers + 1 */
    size_t slot_count;       /* a power of two */
    struct obj_corner *keys; /* of the vertices */
    uint32_t *vertex_of_corner;
    size_t vertex_count;
};

/* ---- indices ---- */

static bool check_index(struct lom_obj *obj, const struct obj_face *face, int32_t index, size_t count, const char *what)
{
    if (index < 0 || (size_t)index < count)
        return true;
    obj->text.line = face->line;
    return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "The face names %s %d, and the file has %zu.", what,
                         (int)index + 1, count);
}

static bool check_indices(struct lom_obj *obj)
{
    for (size_t k = 0; k < obj->face_count; k++) {
        const struct obj_face *face = &obj->faces[k];
        for (uint32_t i = 0; i < face->count; i++) {
            const struct obj_corner *corner = &obj->corners[face->first + i];
            if (!check_index(obj, face, corner->v, obj->position_count, "vertex") ||
                !check_index(obj, face, corner->vt, obj->texture_count, "texture vertex") ||
                !check_index(obj, face, corner->vn, obj->normal_count, "normal"))
                return false;
        }
    }
    return true;
}

/* ---- normals ---- */

static void load_polygon(struct build *build, const struct obj_face *face)
{
    build->polygon->count = (int)face->count;
    for (uint32_t i = 0; i < face->count; i++) {
        const float *p = build->obj->positions[build->obj->corners[face->first + i].v].position;
        for (int axis = 0; axis < 3; axis++)
            build->polygon->point[i][axis] = p[axis];
    }
}

/* Zero for a face without area. */
static lom_vec3 face_normal(struct build *build, const struct obj_face *face)
{
    load_polygon(build, face);
    return lom_vec3_normalize(lom_polygon_area(build->polygon));
}

static bool sum_normals(struct build *build)
{
    struct lom_obj *obj = build->obj;
    bool missing = false;
    for (size_t k = 0; k < obj->face_count; k++)
        missing = missing || obj->corners[obj->faces[k].first].vn < 0;
    if (!missing)
        return true;
    build->sums = lom_allocate(obj->position_count, sizeof *build->sums, obj->text.error);
    build->first_faces = lom_allocate(obj->position_count, sizeof *build->first_faces, obj->text.error);
    build->last_faces = lom_allocate(obj->position_count, sizeof *build->last_faces, obj->text.error);
    if (build->sums == NULL || build->first_faces == NULL || build->last_faces == NULL)
        return false;
    for (size_t k = 0; k < obj->face_count; k++) {
        const struct obj_face *face = &obj->faces[k];
        lom_vec3 normal = face_normal(build, face);
        if (lom_vec3_dot(normal, normal) == 0)
            continue;
        for (uint32_t i = 0; i < face->count; i++) {
            size_t v = (size_t)obj->corners[face->first + i].v;
            if (build->last_faces[v] == k + 1)
                continue;
            build->last_faces[v] = (uint32_t)k + 1;
            build->sums[v] = lom_vec3_add(build->sums[v], normal);
            if (build->first_faces[v] == 0)
                build->first_faces[v] = (uint32_t)k + 1;
        }
    }
    return true;
}

/* A sum of opposed normals leaves rounding, not a direction: below 1e-12 the first face decides. */
static void computed_normal(struct build *build, size_t v, float normal[3])
{
    lom_vec3 unit = { 0, 1, 0 };
    if (lom_vec3_length(build->sums[v]) > 1e-12)
        unit = lom_vec3_normalize(build->sums[v]);
    else if (build->first_faces[v] != 0)
        unit = face_normal(build, &build->obj->faces[build->first_faces[v] - 1]);
    normal[0] = (float)unit.x;
    normal[1] = (float)unit.y;
    normal[2] = (float)unit.z;
}

/* ---- vertices ---- */

/* The finalizer of splitmix64 (Steele, Lea and Flood 2014) over the three indices. */
static size_t hash_corner(struct obj_corner corner)
{
    uint64_t h = (uint32_t)corner.v * UINT64_C(0x9e3779b97f4a7c15);
    h ^= ((uint64_t)(uint32_t)corner.vt << 32 | (uint32_t)corner.vn) * UINT64_C(0xd1b54a32d192ed03);
    h = (h ^ h >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ h >> 27) * UINT64_C(0x94d049bb133111eb);
    return (size_t)(h ^ h >> 31);
}

static uint32_t find_vertex(struct build *build, struct obj_corner corner)
{
    size_t mask = build->slot_count - 1, slot = hash_corner(corner) & mask;
    for (; build->slots[slot] != 0; slot = (slot + 1) & mask) {
        const struct obj_corner *key = &build->keys[build->slots[slot] - 1];
        if (key->v == corner.v && key->vt == corner.vt && key->vn == corner.vn)
            return build->slots[slot] - 1;
    }
    build->keys[build->vertex_count] = corner;
    build->slots[slot] = (uint32_t)++build->vertex_count;
    return build->slots[slot] - 1;
}

static bool number_vertices(struct build *build)
{
    struct lom_obj *obj = build->obj;
    build->slot_count = 64;
    while (build->slot_count < obj->corner_count + obj->corner_count / 2)
        build->slot_count *= 2;
    build->slots = lom_allocate(build->slot_count, sizeof *build->slots, obj->text.error);
    build->keys = lom_allocate(obj->corner_count, sizeof *build->keys, obj->text.error);
    build->vertex_of_corner = lom_allocate(obj->corner_count, sizeof *build->vertex_of_corner, obj->text.error);
    if (build->slots == NULL || build->keys == NULL || build->vertex_of_corner == NULL)
        return false;
    for (size_t k = 0; k < obj->corner_count; k++)
        build->vertex_of_corner[k] = find_vertex(build, obj->corners[k]);
    return true;
}

static void fill_vertices(struct build *build, lom_mesh *mesh)
{
    const struct lom_obj *obj = build->obj;
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        struct obj_corner key = build->keys[k];
        lom_mesh_vertex *vertex = &mesh->vertices[k];
        memcpy(vertex->position, obj->positions[key.v].position, sizeof vertex->position);
        memcpy(vertex->color, obj->positions[key.v].color, 3 * sizeof(float));
        vertex->color[3] = 1;
        if (key.vt >= 0)
            memcpy(vertex->uv, obj->texture[key.vt].value, sizeof vertex->uv);
        if (key.vn >= 0)
            memcpy(vertex->normal, obj->normals[key.vn].value, sizeof vertex->normal);
        else
            computed_normal(build, (size_t)key.v, vertex->normal);
    }
}

/* ---- triangles and parts ---- */

static size_t count_parts(const struct lom_obj *obj)
{
    size_t parts = 1;
    for (size_t k = 1; k < obj->face_count; k++)
        parts += obj->faces[k].material != obj->faces[k - 1].material;
    return parts;
}

static void fill_triangles(struct build *build, lom_mesh *mesh)
{
    const struct lom_obj *obj = build->obj;
    uint32_t first = 0;
    lom_mesh_part *part = mesh->parts;
    for (size_t k = 0; k < obj->face_count; k++) {
        const struct obj_face *face = &obj->faces[k];
        uint32_t count = 3 * (face->count - 2);
        load_polygon(build, face);
        lom_polygon_triangulate(build->polygon, mesh->indices + first);
        for (uint32_t i = 0; i < count; i++)
            mesh->indices[first + i] = build->vertex_of_corner[face->first + mesh->indices[first + i]];
        if (k > 0 && face->material != face[-1].material)
            part++;
        if (part->index_count == 0)
            *part = (lom_mesh_part){ .first_index = first, .material = face->material };
        part->index_count += count;
        first += count;
    }
}

static void fill_materials(struct lom_obj *obj, lom_mesh *mesh)
{
    const char *undefined = NULL;
    for (size_t k = 0; k < mesh->material_count; k++) {
        mesh->materials[k] = obj->materials.entries[k].material;
        if (undefined == NULL && !obj->materials.entries[k].defined)
            undefined = mesh->materials[k].name;
    }
    if (obj->warning[0] == 0 && undefined != NULL && obj->read_material != NULL)
        snprintf(obj->warning, sizeof obj->warning, "%s: no material file defines \"%s\".", obj->text.name, undefined);
    memcpy(mesh->warning, obj->warning, sizeof mesh->warning);
}

lom_mesh *lom_build_obj(struct lom_obj *obj)
{
    struct build build = { .obj = obj };
    lom_mesh *mesh = NULL;
    build.polygon = lom_allocate(1, sizeof *build.polygon, obj->text.error);
    if (build.polygon != NULL && check_indices(obj) && sum_normals(&build) && number_vertices(&build))
        mesh = lom_create_mesh(build.vertex_count, 3 * (obj->corner_count - 2 * obj->face_count), count_parts(obj),
                               obj->materials.count, obj->text.error);
    if (mesh != NULL) {
        fill_vertices(&build, mesh);
        fill_triangles(&build, mesh);
        fill_materials(obj, mesh);
    }
    lom_release(build.polygon);
    lom_release(build.sums);
    lom_release(build.first_faces);
    lom_release(build.last_faces);
    lom_release(build.slots);
    lom_release(build.keys);
    lom_release(build.vertex_of_corner);
    return mesh;
}
