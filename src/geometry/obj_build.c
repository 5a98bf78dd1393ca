/* Reads Wavefront OBJ, stage 2 of 2: arrays to a mesh. In: struct lom_obj. Out: a mesh with n - 2 triangles a polygon
 * in file order, n - 1 segments a line, one vertex for each different (v, vt, vn), numbered by first use in triangles, then
 * in lines, then in points: so what is written in that order is numbered the same when it is read. The hash only finds equal corners; it never orders anything. */
#include "obj.h"
#include "polygon.h"

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
    uint32_t *order; /* corners of triangles, lines, points, then their vertices; all corners when there are none */
    size_t order_count, vertex_count;
    bool has_elements;
};

/* ---- indices ---- */

/* An index that the file lacks is one that was not given; whether it was so. */
static bool drop_lacking(int32_t *index, size_t count)
{
    bool lacking = *index >= 0 && (size_t)*index >= count;
    *index = lacking ? -1 : *index;
    return lacking;
}

static bool check_indices(struct lom_obj *obj, enum obj_kind kind)
{
    static const char *const names[OBJ_KINDS] = { "face", "line", "point" };
    for (size_t k = 0; k < obj->elements[kind].count; k++) {
        const struct obj_face *face = &obj->elements[kind].items[k];
        bool lacking = false;
        for (uint32_t i = 0; i < face->count; i++) {
            struct obj_corner *corner = &obj->corners[face->first + i];
            obj->text.line = face->line;
            if ((size_t)corner->v >= obj->position_count)
                return lom_text_fail(&obj->text, LOM_ERROR_INPUT, "The %s names vertex %d, and the file has %zu.",
                                     names[kind], (int)corner->v + 1, obj->position_count);
            lacking |= drop_lacking(&corner->vt, obj->texture_count);
            lacking |= drop_lacking(&corner->vn, obj->normal_count);
        }
        if (lacking)
            lom_pass_over(obj, OBJ_LACKING, face->line);
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
    const struct obj_elements *faces = &obj->elements[OBJ_FACES];
    bool missing = false;
    for (size_t k = 0; faces->count > 0 && k < obj->corner_count; k++)
        missing = missing || obj->corners[k].vn < 0;
    if (!missing)
        return true;
    build->sums = lom_allocate(obj->position_count, sizeof *build->sums, obj->text.error);
    build->first_faces = lom_allocate(obj->position_count, sizeof *build->first_faces, obj->text.error);
    build->last_faces = lom_allocate(obj->position_count, sizeof *build->last_faces, obj->text.error);
    if (build->sums == NULL || build->first_faces == NULL || build->last_faces == NULL)
        return false;
    for (size_t k = 0; k < faces->count; k++) {
        const struct obj_face *face = &faces->items[k];
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
    if (build->sums != NULL && lom_vec3_length(build->sums[v]) > 1e-12)
        unit = lom_vec3_normalize(build->sums[v]);
    else if (build->sums != NULL && build->first_faces[v] != 0)
        unit = face_normal(build, &build->obj->elements[OBJ_FACES].items[build->first_faces[v] - 1]);
    normal[0] = (float)unit.x;
    normal[1] = (float)unit.y;
    normal[2] = (float)unit.z;
}

/* ---- triangles, segments, points ---- */

static uint32_t *order_face(struct build *build, const struct obj_face *face, uint32_t *order)
{
    uint32_t *end = order + 3 * (face->count - 2);
    load_polygon(build, face);
    lom_polygon_triangulate(build->polygon, order);
    for (; order < end; order++)
        *order += face->first;
    return end;
}

static uint32_t *order_line(struct build *build, const struct obj_face *line, uint32_t *order)
{
    (void)build;
    for (uint32_t i = 0; i + 1 < line->count; i++) {
        *order++ = line->first + i;
        *order++ = line->first + i + 1;
    }
    return order;
}

static uint32_t *order_points(struct build *build, const struct obj_face *points, uint32_t *order)
{
    (void)build;
    for (uint32_t i = 0; i < points->count; i++)
        *order++ = points->first + i;
    return order;
}

static bool order_corners(struct build *build)
{
    static uint32_t *(*const put[OBJ_KINDS])(struct build *, const struct obj_face *,
                                             uint32_t *) = { order_face, order_line, order_points };
    const struct lom_obj *obj = build->obj;
    for (int kind = 0; kind < OBJ_KINDS; kind++)
        build->order_count += obj->elements[kind].indices;
    build->has_elements = build->order_count > 0;
    build->order_count = build->has_elements ? build->order_count : obj->corner_count;
    build->order = lom_allocate(build->order_count, sizeof *build->order, obj->text.error);
    if (build->order == NULL)
        return false;
    for (size_t k = 0; !build->has_elements && k < build->order_count; k++)
        build->order[k] = (uint32_t)k;
    uint32_t *order = build->order;
    for (int kind = 0; kind < OBJ_KINDS; kind++)
        for (size_t k = 0; k < obj->elements[kind].count; k++)
            order = put[kind](build, &obj->elements[kind].items[k], order);
    return true;
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
    if (build->slots == NULL || build->keys == NULL)
        return false;
    for (size_t k = 0; k < build->order_count; k++)
        build->order[k] = find_vertex(build, obj->corners[build->order[k]]);
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

/* ---- parts and materials ---- */

static size_t count_parts(const struct obj_elements *elements)
{
    size_t parts = elements->count > 0;
    for (size_t k = 1; k < elements->count; k++)
        parts += elements->items[k].material != elements->items[k - 1].material;
    return parts;
}

/* The parts of a kind, whose indices begin at *first, moved past them; the next part. */
static lom_mesh_part *fill_parts(const struct lom_obj *obj, enum obj_kind kind, lom_mesh_part *part, uint32_t *first)
{
    const struct obj_elements *elements = &obj->elements[kind];
    for (size_t k = 0; k < elements->count; k++) {
        const struct obj_face *face = &elements->items[k];
        uint32_t count = kind == OBJ_FACES   ? 3 * (face->count - 2)
                         : kind == OBJ_LINES ? 2 * (face->count - 1)
                                             : face->count;
        if (k > 0 && face->material != face[-1].material)
            part++;
        if (part->index_count == 0)
            *part = (lom_mesh_part){ .first_index = *first, .material = face->material };
        part->index_count += count;
        *first += count;
    }
    return part + (elements->count > 0);
}

static void fill_all_parts(const struct lom_obj *obj, lom_mesh *mesh)
{
    lom_mesh_part *part = mesh->parts;
    uint32_t first = 0;
    for (int kind = 0; kind < OBJ_KINDS; kind++)
        part = fill_parts(obj, (enum obj_kind)kind, part, &first);
}

/* A material that is used and that no file defines is the one whose name it is before a comment ("newmtl red # warm"),
 * when there is one such. */
static void define_before_comments(struct lom_materials *materials)
{
    struct lom_material_entry *entries = materials->entries;
    for (size_t k = 0; k < materials->count; k++) {
        struct lom_word name = { entries[k].material.name, strlen(entries[k].material.name) };
        struct lom_word shorter = lom_before_comment(name);
        int used = entries[k].defined && shorter.length > 0 && shorter.length < name.length
                       ? lom_known_material(materials, shorter.start, shorter.length)
                       : -1;
        if (used >= 0) {
            entries[used].commented++;
            entries[used].last_commented = (uint32_t)k;
        }
    }
    for (size_t k = 0; k < materials->count; k++)
        if (!entries[k].defined && entries[k].commented == 1) {
            lom_material material = entries[entries[k].last_commented].material;
            memcpy(material.name, entries[k].material.name, sizeof material.name);
            entries[k].material = material;
            entries[k].defined = true;
        }
}

static void fill_materials(struct lom_obj *obj, lom_mesh *mesh)
{
    define_before_comments(&obj->materials);
    for (size_t k = 0; k < mesh->material_count; k++) {
        mesh->materials[k] = obj->materials.entries[k].material;
        if (!obj->materials.entries[k].defined && obj->read_material != NULL)
            lom_warn(&obj->warnings, "%s: no material file defines \"%s\".", obj->text.name, mesh->materials[k].name);
    }
}

/* A sentence for each sort of thing that was passed over. */
static void warn_of_passed(struct lom_obj *obj)
{
    static const struct {
        const char *one, *many;
    } texts[OBJ_PASSED_COUNT] = {
        [OBJ_NO_FACES] = { "the file has no face, line or point: nothing of it is drawn", "" },
        [OBJ_CURVES] = { "a curve or surface is passed over", "curves or surfaces are passed over, this one first" },
        [OBJ_FEW_ENDS] = { "a line of fewer than 2 vertices, or a point of none, is passed over",
                           "lines of fewer than 2 vertices, or points of none, are passed over, this one first" },
        [OBJ_FEW_CORNERS] = { "a face of fewer than 3 corners is passed over",
                              "faces of fewer than 3 corners are passed over, this one first" },
        [OBJ_LACKING] = { "a face names normals or texture coordinates that the file lacks",
                          "faces name normals or texture coordinates that the file lacks, this one first" },
    };
    for (int i = 0; i < OBJ_PASSED_COUNT; i++) {
        size_t count = obj->passed[i].count;
        if (count == 1)
            lom_warn(&obj->warnings, "%s:%zu: %s.", obj->text.name, obj->passed[i].line, texts[i].one);
        else if (count > 1)
            lom_warn(&obj->warnings, "%s:%zu: %zu %s.", obj->text.name, obj->passed[i].line, count, texts[i].many);
    }
}

static lom_mesh *create_mesh(const struct build *build)
{
    const struct obj_elements *elements = build->obj->elements;
    const lom_mesh_counts counts = { .vertices = build->vertex_count,
                                     .indices = elements[OBJ_FACES].indices,
                                     .line_indices = elements[OBJ_LINES].indices,
                                     .points = elements[OBJ_POINTS].indices,
                                     .parts = count_parts(&elements[OBJ_FACES]),
                                     .line_parts = count_parts(&elements[OBJ_LINES]),
                                     .point_parts = count_parts(&elements[OBJ_POINTS]),
                                     .materials = build->obj->materials.count };
    return lom_create_mesh_of(&counts, build->obj->text.error);
}

lom_mesh *lom_build_obj(struct lom_obj *obj)
{
    struct build build = { .obj = obj };
    lom_mesh *mesh = NULL;
    build.polygon = lom_allocate(1, sizeof *build.polygon, obj->text.error);
    bool checked = build.polygon != NULL;
    for (int kind = 0; kind < OBJ_KINDS; kind++)
        checked = checked && check_indices(obj, (enum obj_kind)kind);
    if (checked && sum_normals(&build) && order_corners(&build) && number_vertices(&build))
        mesh = create_mesh(&build);
    if (mesh != NULL) {
        fill_vertices(&build, mesh);
        if (build.has_elements)
            memcpy(mesh->indices, build.order, build.order_count * sizeof *mesh->indices);
        fill_all_parts(obj, mesh);
        fill_materials(obj, mesh);
        warn_of_passed(obj);
        mesh->warnings = obj->warnings;
    }
    lom_release(build.polygon);
    lom_release(build.sums);
    lom_release(build.first_faces);
    lom_release(build.last_faces);
    lom_release(build.slots);
    lom_release(build.keys);
    lom_release(build.order);
    return mesh;
}
