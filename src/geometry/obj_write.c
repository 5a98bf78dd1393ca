/* Writes OBJ and MTL. In: a mesh, which is checked first. Out: text that reads back as the same mesh (geometry.h says
 * when). Numbers are the shortest that give the same float. */
#include "output.h"
#include "text.h"

#include <lom/geometry.h>

#include <string.h>

/* ---- checks ---- */

static bool finite_floats(const float *values, int count)
{
    bool finite = true;
    for (int i = 0; i < count; i++)
        finite = finite && __builtin_fabsf(values[i]) < __builtin_inff();
    return finite;
}

/* Would a reader get this name, in an array of size bytes, back as it is? A first '#' before a blank is a comment. */
static bool plain_name(const char *name, size_t size)
{
    size_t length = strnlen(name, size);
    bool plain = length > 0 && length < size && name[0] != ' ' && name[length - 1] != ' ' &&
                 !(name[0] == '#' && (length == 1 || name[1] == ' '));
    for (size_t i = 0; plain && i < length; i++)
        plain = (unsigned char)name[i] >= ' ' && name[i] != 127 && name[i] != '\\';
    return plain;
}

static bool plain_map(const char *map, size_t size)
{
    struct lom_word rest = { map, strnlen(map, size) };
    return map[0] != '-' && plain_name(map, size) && lom_file_name(rest).length == rest.length;
}

/* Each part lies within the indices of its kind and holds whole elements. */
static bool check_parts(const lom_mesh *mesh, lom_error *error)
{
    const struct {
        size_t parts, indices;
        uint32_t corners;
    } kinds[] = { { mesh->part_count, mesh->index_count, 3 },
                  { mesh->line_part_count, mesh->line_index_count, 2 },
                  { mesh->point_part_count, mesh->point_count, 1 } };
    size_t number = 0, low = 0;
    for (size_t kind = 0; kind < 3; low += kinds[kind++].indices)
        for (size_t k = 0; k < kinds[kind].parts; k++, number++) {
            const lom_mesh_part *part = &mesh->parts[number];
            if (part->first_index < low || part->first_index - low > kinds[kind].indices ||
                part->index_count > kinds[kind].indices - (part->first_index - low) ||
                part->index_count % kinds[kind].corners != 0 ||
                (part->material >= 0 && (size_t)part->material >= mesh->material_count))
                return lom_fail(error, LOM_ERROR_USAGE, "Part %zu of the mesh is out of range.", number);
        }
    return true;
}

static bool check_mesh(const lom_mesh *mesh, lom_error *error)
{
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        const lom_mesh_vertex *v = &mesh->vertices[k];
        if (!finite_floats(v->position, 3) || !finite_floats(v->normal, 3) || !finite_floats(v->uv, 2) ||
            !finite_floats(v->color, 3))
            return lom_fail(error, LOM_ERROR_USAGE, "Vertex %zu of the mesh has a number that is not finite.", k);
    }
    const size_t index_count = mesh->index_count + mesh->line_index_count + mesh->point_count;
    for (size_t k = 0; k < index_count; k++)
        if (mesh->indices[k] >= mesh->vertex_count)
            return lom_fail(error, LOM_ERROR_USAGE, "Index %zu of the mesh is %u, and it has %zu vertices.", k,
                            (unsigned)mesh->indices[k], mesh->vertex_count);
    return check_parts(mesh, error);
}

/* The maps of a material, and the words before them. */
enum { MAPS = 6 };
static const char *const map_words[MAPS] = { "map_Kd", "map_Ke", "map_Ks", "map_Ns", "map_Bump", "map_d" };

static const char *map_of(const lom_material *m, int i)
{
    const char *const maps[MAPS] = { m->diffuse_map, m->emissive_map, m->specular_map,
                                     m->gloss_map,   m->normal_map,   m->opacity_map };
    return maps[i];
}

static bool has_plain_names(const lom_material *m)
{
    bool plain = plain_name(m->name, sizeof m->name);
    for (int i = 0; i < MAPS; i++)
        plain = plain && (map_of(m, i)[0] == 0 || plain_map(map_of(m, i), sizeof m->diffuse_map));
    return plain;
}

static bool check_materials(const lom_mesh *mesh, lom_error *error)
{
    for (size_t k = 0; k < mesh->material_count; k++) {
        const lom_material *m = &mesh->materials[k];
        if (!has_plain_names(m))
            return lom_fail(error, LOM_ERROR_USAGE, "Material %zu has a name or map that MTL cannot hold.", k);
        if (!finite_floats(m->ambient, 3) || !finite_floats(m->diffuse, 3) || !finite_floats(m->specular, 3) ||
            !finite_floats(m->emissive, 3) || !finite_floats(&m->shininess, 1) || !finite_floats(&m->opacity, 1) ||
            !finite_floats(&m->bump, 1))
            return lom_fail(error, LOM_ERROR_USAGE, "Material \"%s\" has a number that is not finite.", m->name);
    }
    return true;
}

/* ---- output ---- */

static lom_bytes finish(struct lom_output *output)
{
    if (!output->failed)
        return output->bytes;
    lom_release(output->bytes.data);
    return (lom_bytes){ 0 };
}

static void put_floats(struct lom_output *output, const char *word, const float *values, int count)
{
    lom_put(output, word);
    for (int i = 0; i < count; i++) {
        lom_put(output, " ");
        lom_put_float(output, values[i]);
    }
}

/* The number that the reader's 1 - v rounds back to v: a short one when it does, otherwise the double. */
static void put_flipped(struct lom_output *output, float v)
{
    char text[32];
    float flipped = (float)(1 - (double)v);
    double parsed;
    size_t length = lom_print_float(text, flipped);
    lom_parse_double(text, length, &parsed);
    if ((float)(1 - parsed) != v)
        lom_print_double(text, 1 - (double)v);
    lom_put(output, " ");
    lom_put(output, text);
}

static void put_vertices(struct lom_output *output, const lom_mesh *mesh)
{
    bool colored = false;
    for (size_t k = 0; k < mesh->vertex_count; k++)
        for (int i = 0; i < 3; i++)
            colored = colored || mesh->vertices[k].color[i] != 1;
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        put_floats(output, "v", mesh->vertices[k].position, 3);
        if (colored)
            put_floats(output, "", mesh->vertices[k].color, 3);
        lom_put(output, "\n");
    }
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        put_floats(output, "vt", mesh->vertices[k].uv, 1);
        put_flipped(output, mesh->vertices[k].uv[1]);
        lom_put(output, "\n");
    }
    for (size_t k = 0; k < mesh->vertex_count; k++) {
        put_floats(output, "vn", mesh->vertices[k].normal, 3);
        lom_put(output, "\n");
    }
}

static void put_face(struct lom_output *output, const uint32_t corners[3])
{
    lom_put(output, "f");
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            lom_put(output, k == 0 ? " " : "/");
            lom_put_index(output, corners[i] + 1);
        }
    lom_put(output, "\n");
}

/* A flag a vertex: triangles have it. */
static bool *find_face_vertices(const lom_mesh *mesh, lom_error *error)
{
    bool *of_faces = lom_allocate(mesh->vertex_count, sizeof *of_faces, error);
    for (size_t k = 0; of_faces != NULL && k < mesh->index_count; k++)
        of_faces[mesh->indices[k]] = true;
    return of_faces;
}

/* A vertex of a line or point, in the shortest form that gives it back: the normal that the reader computes without a
 * face is 0, 1, 0, the texture coordinates of none are 0, 0. */
static void put_end(struct lom_output *output, const lom_mesh *mesh, const bool *of_faces, uint32_t vertex)
{
    const lom_mesh_vertex *v = &mesh->vertices[vertex];
    bool normal = of_faces[vertex] || v->normal[0] != 0 || v->normal[1] != 1 || v->normal[2] != 0;
    int count = normal ? 3 : v->uv[0] != 0 || v->uv[1] != 0 ? 2 : 1;
    for (int k = 0; k < count; k++) {
        lom_put(output, k == 0 ? " " : "/");
        lom_put_index(output, vertex + 1);
    }
}

enum { STATEMENT = 32 }; /* vertices of a line or points in one statement */

/* Segments that go on from one another are one l. */
static void put_lines(struct lom_output *output, const lom_mesh *mesh, const bool *of_faces, const uint32_t *ends,
                      uint32_t count)
{
    uint32_t length = 0;
    for (uint32_t i = 0; i < count; i += 2) {
        if (length == 0 || length == STATEMENT || ends[i] != ends[i - 1]) {
            lom_put(output, length == 0 ? "l" : "\nl");
            put_end(output, mesh, of_faces, ends[i]);
            length = 1;
        }
        put_end(output, mesh, of_faces, ends[i + 1]);
        length++;
    }
    lom_put(output, "\n");
}

static void put_points(struct lom_output *output, const lom_mesh *mesh, const bool *of_faces, const uint32_t *points,
                       uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (i % STATEMENT == 0)
            lom_put(output, i == 0 ? "p" : "\np");
        put_end(output, mesh, of_faces, points[i]);
    }
    lom_put(output, "\n");
}

static void put_part(struct lom_output *output, const lom_mesh *mesh, const bool *of_faces, size_t number)
{
    const lom_mesh_part *part = &mesh->parts[number];
    const uint32_t *indices = mesh->indices + part->first_index;
    if (number >= mesh->part_count + mesh->line_part_count)
        put_points(output, mesh, of_faces, indices, part->index_count);
    else if (number >= mesh->part_count)
        put_lines(output, mesh, of_faces, indices, part->index_count);
    for (uint32_t i = 0; number < mesh->part_count && i < part->index_count; i += 3)
        put_face(output, indices + i);
}

static void put_parts(struct lom_output *output, const lom_mesh *mesh, const bool *of_faces)
{
    const size_t count = lom_mesh_parts(mesh);
    int material = -1;
    for (size_t k = 0; k < count; k++) {
        const lom_mesh_part *part = &mesh->parts[k];
        if (part->index_count == 0)
            continue;
        if (part->material != material) {
            material = part->material;
            lom_put(output, material >= 0 ? "usemtl " : "usemtl");
            lom_put(output, material >= 0 ? mesh->materials[material].name : "");
            lom_put(output, "\n");
        }
        put_part(output, mesh, of_faces, k);
    }
}

lom_bytes lom_encode_obj(const lom_mesh *mesh, const char *material_file, lom_error *error)
{
    struct lom_output output = { .error = error };
    if (!check_mesh(mesh, error) || !check_materials(mesh, error))
        return (lom_bytes){ 0 };
    if (material_file != NULL && !plain_name(material_file, 4096)) {
        lom_fail(error, LOM_ERROR_USAGE, "OBJ cannot hold the name of the material file \"%s\".", material_file);
        return (lom_bytes){ 0 };
    }
    bool *of_faces = find_face_vertices(mesh, error);
    if (of_faces == NULL)
        return (lom_bytes){ 0 };
    if (material_file != NULL) {
        lom_put(&output, "mtllib ");
        lom_put(&output, material_file);
        lom_put(&output, "\n");
    }
    lom_float_state state;
    lom_enter_float_state(&state);
    put_vertices(&output, mesh);
    lom_leave_float_state(&state);
    put_parts(&output, mesh, of_faces);
    lom_release(of_faces);
    return finish(&output);
}

static void put_maps(struct lom_output *output, const lom_material *m)
{
    for (int i = 0; i < MAPS; i++) {
        if (map_of(m, i)[0] == 0)
            continue;
        lom_put(output, "\n");
        lom_put(output, map_words[i]);
        if (map_of(m, i) == m->normal_map && m->bump != 1)
            put_floats(output, " -bm", &m->bump, 1);
        lom_put(output, " ");
        lom_put(output, map_of(m, i));
    }
}

lom_bytes lom_encode_mtl(const lom_mesh *mesh, lom_error *error)
{
    struct lom_output output = { .error = error };
    if (!check_materials(mesh, error))
        return (lom_bytes){ 0 };
    lom_put(&output, "# materials\n");
    for (size_t k = 0; k < mesh->material_count; k++) {
        const lom_material *m = &mesh->materials[k];
        lom_put(&output, "newmtl ");
        lom_put(&output, m->name);
        put_floats(&output, "\nKa", m->ambient, 3);
        put_floats(&output, "\nKd", m->diffuse, 3);
        put_floats(&output, "\nKs", m->specular, 3);
        put_floats(&output, "\nNs", &m->shininess, 1);
        put_floats(&output, "\nd", &m->opacity, 1);
        if (m->emissive[0] != 0 || m->emissive[1] != 0 || m->emissive[2] != 0)
            put_floats(&output, "\nKe", m->emissive, 3);
        put_maps(&output, m);
        lom_put(&output, "\n");
    }
    return finish(&output);
}
