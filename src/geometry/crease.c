/* Normals by crease angle. In: the triangles of a builder. Out: a normal for each corner: the sum of the unit normals
 * of the triangles at its position that are within the angle of its own. Summed in the order of the triangles, so that
 * all corners that see the same triangles get the same bits. Compiled for speed. */
#include "base/numbers.h"
#include "builder.h"

#include <string.h>

struct crease {
    const struct lom_mesh_builder *builder;
    lom_vec3 *faces;   /* unit normals; zero without area */
    uint32_t *places;  /* of each vertex: equal positions have equal numbers */
    uint32_t *slots;   /* hash table of vertex numbers + 1, for the places */
    size_t slot_count; /* a power of two */
    uint32_t *starts;  /* place p is shared by triangles around[starts[p] .. starts[p + 1]), in order */
    uint32_t *around;
};

/* ---- places ---- */

/* FNV-1a of the numbers, -0 as 0; not of bytes, whose order differs between machines (only time would differ). */
static size_t hash_position(const float *position)
{
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; i < 3; i++) {
        float value = position[i] == 0 ? 0 : position[i];
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * UINT64_C(0x100000001b3);
        hash ^= hash >> 29;
    }
    return (size_t)hash;
}

/* The first vertex at the same position. */
static uint32_t find_place(struct crease *crease, uint32_t vertex)
{
    const lom_mesh_vertex *vertices = crease->builder->vertices;
    const float *p = vertices[vertex].position;
    size_t mask = crease->slot_count - 1, slot = hash_position(p) & mask;
    for (; crease->slots[slot] != 0; slot = (slot + 1) & mask) {
        const float *q = vertices[crease->slots[slot] - 1].position;
        if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2])
            return crease->slots[slot] - 1;
    }
    crease->slots[slot] = vertex + 1;
    return vertex;
}

/* Does corner i of the triangle have the same place as an earlier one? A triangle counts once at a place. */
static bool repeated(const struct crease *crease, const struct builder_triangle *triangle, int i)
{
    for (int k = 0; k < i; k++)
        if (crease->places[triangle->corner[k]] == crease->places[triangle->corner[i]])
            return true;
    return false;
}

/* Counts, adds up, and fills backwards from the ends, so that starts end up where they belong. */
static void collect(struct crease *crease)
{
    const struct lom_mesh_builder *builder = crease->builder;
    for (uint32_t v = 0; v < builder->vertex_count; v++)
        crease->places[v] = find_place(crease, v);
    for (size_t k = 0; k < builder->triangle_count; k++)
        for (int i = 0; i < 3; i++)
            if (!repeated(crease, &builder->triangles[k], i))
                crease->starts[crease->places[builder->triangles[k].corner[i]]]++;
    uint32_t sum = 0;
    for (size_t v = 0; v < builder->vertex_count; v++) {
        sum += crease->starts[v];
        crease->starts[v] = sum;
    }
    crease->starts[builder->vertex_count] = sum;
    for (size_t k = builder->triangle_count; k-- > 0;)
        for (int i = 0; i < 3; i++)
            if (!repeated(crease, &builder->triangles[k], i)) {
                uint32_t at = --crease->starts[crease->places[builder->triangles[k].corner[i]]];
                crease->around[at] = (uint32_t)k;
            }
}

/* ---- normals ---- */

static lom_vec3 position(const struct crease *crease, uint32_t vertex)
{
    const float *p = crease->builder->vertices[vertex].position;
    return (lom_vec3){ p[0], p[1], p[2] };
}

static void find_faces(struct crease *crease)
{
    for (size_t k = 0; k < crease->builder->triangle_count; k++) {
        const uint32_t *corner = crease->builder->triangles[k].corner;
        lom_vec3 a = position(crease, corner[0]);
        lom_vec3 ab = lom_vec3_subtract(position(crease, corner[1]), a);
        lom_vec3 ac = lom_vec3_subtract(position(crease, corner[2]), a);
        crease->faces[k] = lom_vec3_normalize(lom_vec3_cross(ab, ac));
    }
}

static lom_vec3 corner_normal(const struct crease *crease, size_t triangle, uint32_t vertex, double least_cosine)
{
    lom_vec3 own = crease->faces[triangle], sum = { 0, 0, 0 };
    bool has_area = lom_vec3_dot(own, own) > 0;
    uint32_t place = crease->places[vertex];
    for (uint32_t i = crease->starts[place]; i < crease->starts[place + 1]; i++) {
        lom_vec3 other = crease->faces[crease->around[i]];
        if (!has_area || lom_vec3_dot(own, other) >= least_cosine)
            sum = lom_vec3_add(sum, other);
    }
    if (lom_vec3_length(sum) > 1e-12)
        return lom_vec3_normalize(sum);
    return has_area ? own : (lom_vec3){ 0, 1, 0 };
}

static bool reserve(struct crease *crease, lom_error *error)
{
    size_t vertices = crease->builder->vertex_count, triangles = crease->builder->triangle_count;
    crease->slot_count = 64;
    while (crease->slot_count < 2 * vertices)
        crease->slot_count *= 2;
    crease->faces = lom_allocate(triangles, sizeof *crease->faces, error);
    crease->places = lom_allocate(vertices, sizeof *crease->places, error);
    crease->slots = lom_allocate(crease->slot_count, sizeof *crease->slots, error);
    crease->starts = lom_allocate(vertices + 1, sizeof *crease->starts, error);
    crease->around = lom_allocate(triangles, 3 * sizeof *crease->around, error);
    return crease->faces != NULL && crease->places != NULL && crease->slots != NULL && crease->starts != NULL &&
           crease->around != NULL;
}

static void fill_normals(struct crease *crease, double angle, float (*normals)[3])
{
    const struct lom_mesh_builder *builder = crease->builder;
    /* 1e-9 below the cosine: triangles of one plane stay together whatever their rounding */
    double least_cosine = angle >= lom_pi ? -2 : lom_double_cos(angle < 0 ? 0 : angle) - 1e-9;
    collect(crease);
    find_faces(crease);
    for (size_t k = 0; k < builder->triangle_count; k++)
        for (size_t i = 0; i < 3; i++) {
            uint32_t vertex = builder->triangles[k].corner[i];
            const float *given = builder->vertices[vertex].normal;
            if (given[0] != 0 || given[1] != 0 || given[2] != 0) {
                memcpy(normals[3 * k + i], given, sizeof normals[0]);
                continue;
            }
            lom_vec3 n = corner_normal(crease, k, vertex, least_cosine);
            normals[3 * k + i][0] = (float)n.x;
            normals[3 * k + i][1] = (float)n.y;
            normals[3 * k + i][2] = (float)n.z;
        }
}

float (*lom_corner_normals(const struct lom_mesh_builder *builder, double angle, lom_error *error))[3]
{
    struct crease crease = { .builder = builder };
    float(*normals)[3] = lom_allocate(builder->triangle_count, 3 * sizeof *normals, error);
    bool reserved = normals != NULL && reserve(&crease, error);
    if (reserved)
        fill_normals(&crease, angle, normals);
    lom_release(crease.faces);
    lom_release(crease.places);
    lom_release(crease.slots);
    lom_release(crease.starts);
    lom_release(crease.around);
    if (!reserved)
        lom_release(normals);
    return reserved ? normals : NULL;
}
