/* What is written as OBJ and MTL is read back as the same mesh, and written again as the same text; what no text can say is
 * refused. */
#include "obj.h"

static void round_trip(void)
{
    lom_error error = { 0 };
    enum { FACES = 300 };
    lom_mesh *mesh = lom_create_mesh(3 * FACES, 3 * FACES, 3, 2, &error);
    for (uint32_t k = 0; k < 3 * FACES; k++) {
        lom_mesh_vertex *v = &mesh->vertices[k];
        float *values[] = { v->position, v->normal, v->uv, v->color };
        const int counts[] = { 3, 3, 2, 3 };
        uint64_t counter = 16 * (uint64_t)k;
        for (int a = 0; a < 4; a++)
            for (int i = 0; i < counts[a]; i++)
                values[a][i] = (float)(lom_random_uniform(5, counter++) * (k % 3 == 0 ? 1e-3 : k % 3 == 1 ? 1 : 40));
        v->color[3] = 1;
        mesh->indices[k] = k;
    }
    mesh->vertices[1].uv[1] = 0;
    mesh->vertices[2].uv[1] = 1;
    mesh->vertices[3].uv[1] = -7.3f;
    mesh->parts[0] = (lom_mesh_part){ 0, 30, -1 };
    mesh->parts[1] = (lom_mesh_part){ 30, 60, 1 };
    mesh->parts[2] = (lom_mesh_part){ 90, 3 * FACES - 90, 0 };
    mesh->materials[0] = lom_default_material("two words");
    mesh->materials[1] = lom_default_material("x#y");
    mesh->materials[1].opacity = .3f;
    strncpy(mesh->materials[1].diffuse_map, "maps/a b.png", 20);
    strncpy(mesh->materials[0].opacity_map, "holes.png", 20);
    lom_bytes obj = lom_encode_obj(mesh, "m.mtl", &error), mtl = lom_encode_mtl(mesh, &error);
    CHECK(obj.data != NULL && mtl.data != NULL, "%s", error.text);
    char folder[] = "/tmp/lom_obj_XXXXXX", obj_path[64], mtl_path[64];
    if (mkdtemp(folder) == NULL)
        return;
    snprintf(obj_path, sizeof obj_path, "%s/m.obj", folder);
    snprintf(mtl_path, sizeof mtl_path, "%s/m.mtl", folder);
    CHECK(lom_write_file(obj_path, obj.data, obj.size, &error) && lom_write_file(mtl_path, mtl.data, mtl.size, &error));
    lom_mesh *back = lom_read_obj(obj_path, &error);
    CHECK(back != NULL && back->warnings.count == 0 && same_mesh(back, mesh), "%s", error.text);
    lom_free_mesh(back);
    lom_free_mesh(mesh);
    lom_release(obj.data);
    lom_release(mtl.data);
    remove(obj_path);
    remove(mtl_path);
    remove(folder);
}

/* Appends a printed number below n to the text. */
static int put(char *text, int at, const char *format, uint64_t key, uint64_t *counter, int n)
{
    return at +
           snprintf(text + at, 4096 - (size_t)at, format, 1 + (int)(lom_random_bits(key, (*counter)++) % (uint64_t)n));
}

static void random_file(char *text, uint64_t key)
{
    static const char *const forms[][2] = { { " %d", "" }, { " %d", "/%d" }, { " %d", "//%d" }, { " %d", "/%d" } };
    uint64_t counter = 0;
    int at = snprintf(text, 4096, "usemtl a # b");
    for (int i = 0; i < 9; i++) {
        at = put(text, at, "\nv %d", key, &counter, 4);
        at = put(text, at, " %d", key, &counter, 4);
        at = put(text, at, " %d", key, &counter, key % 3 == 0 ? 3 : 1);
        at = put(text, at, "\nvt .%d .3", key, &counter, 9);
        at = put(text, at, "\nvn %d 1 0", key, &counter, 3);
    }
    for (int face = 0; face < 4; face++) {
        int corners = 1 + (int)(lom_random_bits(key, counter++) % 9), form = (int)(lom_random_bits(key, counter++) % 4);
        at = put(text, at, "\nusemtl #%d\nf", key, &counter, 2);
        for (int i = 0; i < corners; i++) {
            at = put(text, at, forms[form][0], key, &counter, 9);
            if (form > 0)
                at = put(text, at, forms[form][1], key, &counter, 10);
            if (form > 2)
                at = put(text, at, forms[form][1], key, &counter, 10);
        }
    }
}

/* What is written and read again is written the same: polygons of corners in any order and number, with repeated and
 * missing ones, materials and attributes. */
static void writing_is_idempotent(void)
{
    for (uint64_t k = 0; k < 400; k++) {
        char text[4096];
        random_file(text, k);
        lom_mesh *mesh = decode(text);
        lom_bytes first = lom_encode_obj(mesh, NULL, NULL);
        lom_mesh *again = lom_decode_obj((const char *)first.data, first.size, "again.obj", NULL);
        CHECK(again != NULL && again->vertex_count == mesh->vertex_count && again->index_count == mesh->index_count &&
                  memcmp(again->indices, mesh->indices, again->index_count * sizeof *again->indices) == 0,
              "file %d:\n%s", (int)k, text);
        lom_bytes second = again != NULL ? lom_encode_obj(again, NULL, NULL) : (lom_bytes){ 0 };
        CHECK(second.size == first.size && memcmp(second.data, first.data, first.size) == 0, "file %d:\n%s", (int)k,
              text);
        lom_release(first.data);
        lom_release(second.data);
        lom_free_mesh(mesh);
        lom_free_mesh(again);
    }
    lom_mesh *mesh = decode(TRIANGLE "vt 0 3.4028234e38\nf 1/1 2/1 3/1\n"); /* the shortest text of -v is above it */
    lom_bytes text = lom_encode_obj(mesh, NULL, NULL);
    lom_error error = { 0 };
    lom_mesh *again = lom_decode_obj((const char *)text.data, text.size, "again.obj", &error);
    CHECK(again != NULL && again->vertices[0].uv[1] == mesh->vertices[0].uv[1], "%s", error.text);
    lom_release(text.data);
    lom_free_mesh(mesh);
    lom_free_mesh(again);
}

static void refused_writing(void)
{
    lom_error error = { 0 };
    lom_mesh *mesh = decode(TRIANGLE "usemtl red\nf 1 2 3\n");
    if (mesh == NULL)
        return;
    mesh->indices[1] = 3;
    CHECK(lom_encode_obj(mesh, NULL, &error).data == NULL && strstr(error.text, "Index 1") != NULL, "%s", error.text);
    mesh->indices[1] = 1;
    mesh->vertices[2].uv[0] = __builtin_nanf("");
    error = (lom_error){ 0 };
    CHECK(lom_encode_obj(mesh, NULL, &error).data == NULL && strstr(error.text, "Vertex 2") != NULL, "%s", error.text);
    mesh->vertices[2].uv[0] = 0;
    const char *names[] = { "", " a", "a ", "a\nb", "#", "# a", "a\\" };
    const lom_mesh_part part = mesh->parts[0], bad_parts[] = { { .first_index = 4 },
                                                               { .index_count = 6 },
                                                               { .first_index = 3, .index_count = 3 },
                                                               { .index_count = 2 },
                                                               { .index_count = 3, .material = 1 } };
    for (size_t i = 0; i < sizeof bad_parts / sizeof *bad_parts; i++) {
        mesh->parts[0] = bad_parts[i];
        error = (lom_error){ 0 };
        CHECK(lom_encode_obj(mesh, NULL, &error).data == NULL && strstr(error.text, "Part 0") != NULL, "case %zu: %s",
              i, error.text);
    }
    mesh->parts[0] = part;
    for (size_t i = 1; i < sizeof names / sizeof *names; i++) {
        error = (lom_error){ 0 };
        CHECK(lom_encode_obj(mesh, names[i], &error).data == NULL && strstr(error.text, "material file") != NULL,
              "case %zu: %s", i, error.text);
    }
    for (int i = 0; i < 5; i++) {
        lom_material *m = &mesh->materials[0];
        float *const numbers[] = { &m->ambient[2], &m->diffuse[0], &m->specular[1], &m->shininess, &m->opacity };
        *m = lom_default_material("red");
        *numbers[i] = i % 2 == 0 ? __builtin_inff() : __builtin_nanf("");
        error = (lom_error){ 0 };
        CHECK(lom_encode_mtl(mesh, &error).data == NULL && strstr(error.text, "\"red\" has a number") != NULL,
              "case %d: %s", i, error.text);
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        mesh->materials[0] = lom_default_material(names[i]);
        CHECK(lom_encode_mtl(mesh, NULL).data == NULL && lom_encode_obj(mesh, NULL, NULL).data == NULL, "case %zu", i);
    }
    memset(mesh->materials[0].name, 'a', sizeof mesh->materials[0].name);
    CHECK(lom_encode_mtl(mesh, NULL).data == NULL, "a name without an end");
    lom_free_mesh(mesh);
}

int main(int argc, char **argv)
{
    RUN(round_trip);
    RUN(writing_is_idempotent);
    RUN(refused_writing);
    return check_result();
}
