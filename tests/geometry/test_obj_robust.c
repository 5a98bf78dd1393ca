/* Bad OBJ and MTL: truncation at every byte, bit flips, hostile counts. Whatever the bytes, the answer is a mesh whose
 * indices are in range or a message that names the place; sanitizers see the rest. */
#include "check.h"

#include <lom/geometry.h>

static const char good_obj[] =
    "mtllib a.mtl b.mtl\r\n# c\nv 0 0 0 1 .5 .25\nv 1 0 0\nv 1 1 0 1\nv 0 1 \\\n 0\nv .5 .5 1e-3\n"
    "vt 0 0\nvt 1 .5 0\nvn 0 0 1\ng a\nusemtl red\nf 1/1/1 2/2/1 3/1/1 4/2/1\nusemtl blue 2\n"
    "s off\nf -1 -2 -3\nf 1//1 2//-1 5//1\nf 1/1 5/2 3/1 2/-1\n";
static const char good_mtl[] = "newmtl red\nKa 1 1 1\nKd .1 .2 .3\nKs 0\nNs 10\nd .5\nmap_Kd -o 1 2 a.png\n"
                               "newmtl blue 2\r\nTr 0.5\nillum 2\n";

struct pair {
    const char *mtl;
    size_t size;
};

static lom_bytes read_pair(void *context, const char *name, lom_error *error)
{
    const struct pair *pair = context;
    if (strcmp(name, "a.mtl") != 0) {
        lom_fail(error, LOM_ERROR_FILE, "none");
        return (lom_bytes){ 0 };
    }
    lom_bytes bytes = { lom_allocate(pair->size, 1, error), pair->size };
    memcpy(bytes.data, pair->mtl, pair->size);
    return bytes;
}

/* Copies to the heap, without a zero byte behind, so that a sanitizer sees every step too far. 1: accepted. */
static int try_decode(const char *obj, size_t obj_size, const char *mtl, size_t mtl_size)
{
    lom_error error = { 0 };
    char *copy = malloc(obj_size + (obj_size == 0));
    memcpy(copy, obj, obj_size);
    struct pair pair = { mtl, mtl_size };
    lom_mesh *mesh = lom_decode_obj_with(copy, obj_size, "a.obj", read_pair, &pair, &error);
    free(copy);
    if (mesh == NULL) {
        CHECK(error.code != LOM_OK && (strncmp(error.text, "a.obj:", 6) == 0 || strncmp(error.text, "a.mtl:", 6) == 0),
              "\"%s\"", error.text);
        return 0;
    }
    CHECK(error.code == LOM_OK && mesh->index_count == 3 * mesh->source_triangles && mesh->vertex_count > 0);
    for (size_t k = 0; k < mesh->index_count; k++)
        CHECK(mesh->indices[k] < mesh->vertex_count);
    size_t next = 0;
    for (size_t k = 0; k < mesh->part_count; next += mesh->parts[k++].index_count)
        CHECK(mesh->parts[k].first_index == next && mesh->parts[k].index_count > 0 && mesh->parts[k].material >= -1 &&
              mesh->parts[k].material < (int)mesh->material_count);
    CHECK(next == mesh->index_count);
    for (size_t k = 0; k < mesh->vertex_count; k++)
        for (int i = 0; i < 3; i++)
            CHECK(mesh->vertices[k].position[i] - mesh->vertices[k].position[i] == 0, "a coordinate is not finite");
    lom_free_mesh(mesh);
    return 1;
}

static void truncation(void)
{
    int accepted = 0;
    for (size_t size = 0; size < sizeof good_obj; size++)
        accepted += try_decode(good_obj, size, good_mtl, sizeof good_mtl - 1);
    CHECK(accepted > 10 && accepted < (int)sizeof good_obj - 100, "%d accepted", accepted);
    accepted = 0;
    for (size_t size = 0; size < sizeof good_mtl; size++)
        accepted += try_decode(good_obj, sizeof good_obj - 1, good_mtl, size);
    CHECK(accepted > 10, "%d accepted", accepted);
}

static void bit_flips(void)
{
    char obj[sizeof good_obj], mtl[sizeof good_mtl];
    for (size_t bit = 0; bit < 8 * (sizeof good_obj - 1); bit++) {
        memcpy(obj, good_obj, sizeof obj);
        obj[bit / 8] = (char)(obj[bit / 8] ^ 1 << bit % 8);
        try_decode(obj, sizeof obj - 1, good_mtl, sizeof good_mtl - 1);
    }
    for (size_t bit = 0; bit < 8 * (sizeof good_mtl - 1); bit++) {
        memcpy(mtl, good_mtl, sizeof mtl);
        mtl[bit / 8] = (char)(mtl[bit / 8] ^ 1 << bit % 8);
        try_decode(good_obj, sizeof good_obj - 1, mtl, sizeof mtl - 1);
    }
    for (uint64_t k = 0; k < 20000; k++) { /* several bytes at once, often ones that mean something */
        static const char meaning[] = "vtnf/-+.e#\\\r\n 0123456789\xFF";
        memcpy(obj, good_obj, sizeof obj);
        for (uint64_t i = 0; i <= k % 5; i++) {
            uint64_t bits = lom_random_bits(k, i);
            obj[bits % (sizeof obj - 1)] = meaning[(bits >> 32) % (sizeof meaning - 1)];
        }
        try_decode(obj, sizeof obj - 1, good_mtl, sizeof good_mtl - 1);
    }
}

/* Repeats a piece of text count times after a head, and adds a tail. */
static void check_repeated(const char *head, const char *piece, size_t count, const char *tail, const char *expected)
{
    size_t length = strlen(piece), size = strlen(head) + count * length + strlen(tail);
    char *text = malloc(size + 1), *at = text + strlen(head);
    memcpy(text, head, strlen(head));
    for (size_t i = 0; i < count; i++, at += length)
        memcpy(at, piece, length);
    memcpy(at, tail, strlen(tail) + 1);
    lom_error error = { 0 };
    lom_mesh *mesh = lom_decode_obj(text, size, "a.obj", &error);
    if (expected == NULL)
        CHECK(mesh != NULL, "%s...: %s", head, error.text);
    else
        CHECK(mesh == NULL && strstr(error.text, expected) != NULL, "%s...: \"%s\"", head, error.text);
    lom_free_mesh(mesh);
    free(text);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void hostile(void)
{
    check_repeated(TRIANGLE "f", " 1 2 3", 100000, "\n", "more than 4096 corners");
    check_repeated(TRIANGLE "f", " 1 2 3 2", 1024, "\n", NULL);
    check_repeated("v 0 0 ", "1", 1000000, "\n", "fit");
    check_repeated("v 0 0 0.", "1", 1000000, "\n" TRIANGLE "f 1 2 3\n", NULL);
    check_repeated("v 0 0 ", "x", 1000000, "\n", "is not a number");
    check_repeated(TRIANGLE "f 1 2 ", "9", 1000000, "\n", "out of range");
    check_repeated("#", "a", 5000000, "\n" TRIANGLE "f 1 2 3\n", NULL);
    check_repeated("g", " \\\n", 1000000, "\n" TRIANGLE "f 1 2 3\n", NULL);
    check_repeated("usemtl ", "a", 1000000, "\n", "longer than 63");
    check_repeated(TRIANGLE "f 1 2 3\n", "vt 1e999\n", 1, "", "fit");
    check_repeated(TRIANGLE, "usemtl\nusemtl a\nf 1 2 3\nf 2 1 3\n", 50000, "", NULL);
    check_repeated(TRIANGLE, "f 1000000000 2 3\n", 3, "", "a.obj:4: The face names vertex 1000000000");
    /* many different materials */
    size_t room = 70000 * 20;
    char *text = malloc(room), *at = text;
    for (int k = 0; k < 70000; k++)
        at += snprintf(at, room - (size_t)(at - text), "usemtl m%d\n", k);
    lom_error error = { 0 };
    CHECK(lom_decode_obj(text, (size_t)(at - text), "a.obj", &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s",
          error.text);
    CHECK(strncmp(error.text, "a.obj:65537: ", 13) == 0, "%s", error.text);
    free(text);
}

/* A grid as a file: vertices are shared, also in the hash's worst orders. */
static void large(void)
{
    lom_error error = { 0 };
    lom_image *map = lom_create_image(200, 300, 1, LOM_FORMAT_R8, NULL);
    lom_mesh *grid = lom_make_terrain(map, 20, 30, 1, 0, &error);
    lom_bytes text = lom_encode_obj(grid, NULL, &error);
    lom_mesh *mesh = lom_decode_obj((const char *)text.data, text.size, "a.obj", &error);
    CHECK(mesh != NULL && mesh->vertex_count == 60000 && mesh->index_count == grid->index_count, "%s", error.text);
    for (size_t k = 0; mesh != NULL && k < mesh->index_count; k++)
        CHECK(memcmp(&mesh->vertices[mesh->indices[k]], &grid->vertices[grid->indices[k]], sizeof *mesh->vertices) ==
              0);
    lom_free_mesh(mesh);
    lom_free_mesh(grid);
    lom_free_image(map);
    lom_release(text.data);
}

int main(int argc, char **argv)
{
    RUN(truncation);
    RUN(bit_flips);
    RUN(hostile);
    RUN(large);
    return check_result();
}
