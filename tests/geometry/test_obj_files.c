/* Proves that the files an OBJ names are found: material files, their maps, beside the OBJ, in order; also when the OBJ
 * or a material file is malformed or a file is not there. */
#include "check.h"

#include <lom/geometry.h>

#include <unistd.h>

static char folder[64] = "/tmp/lom-obj-XXXXXX";

static void put(const char *name, const char *text)
{
    char path[128];
    lom_error error = { 0 };
    snprintf(path, sizeof path, "%s/%s", folder, name);
    CHECK(lom_write_file(path, text, strlen(text), &error), "%s", error.text);
}

/* The list is exactly these names, each in the folder; ended by NULL. */
static void check_list(const char *obj, const char *const *names)
{
    char path[128], expected[4096];
    lom_error error = { 0 };
    size_t size = 0;
    snprintf(path, sizeof path, "%s/%s", folder, obj);
    lom_bytes list = lom_list_obj_files(path, &error);
    CHECK(error.code == LOM_OK, "%s", error.text);
    for (; *names != NULL; names++)
        size += 1 + (size_t)snprintf(expected + size, sizeof expected - size, "%s/%s", folder, *names);
    CHECK(list.size == size && (size == 0 || memcmp(list.data, expected, size) == 0),
          "%s: %zu bytes, not %zu: \"%s\" ...", obj, list.size, size, list.size > 0 ? (const char *)list.data : "");
    lom_release(list.data);
}

static const char *const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

static void materials_and_maps(void)
{
    char obj[2048];
    put("a.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\nnewmtl plain\nKd 1 1 1\n");
    put("b.mtl", "newmtl blue\nmap_Kd sub/blue.ppm\n");
    snprintf(obj, sizeof obj,
             "mtllib a.mtl\nmtllib b.mtl\n%susemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\nusemtl plain\nf 1 2 3\n",
             triangle);
    put("two.obj", obj);
    check_list("two.obj", (const char *const[]){ "a.mtl", "b.mtl", "red.png", "sub/blue.ppm", NULL });
    snprintf(obj, sizeof obj, "mtllib %s/a.mtl\n%susemtl red\nf 1 2 3\n", folder, triangle);
    put("absolute.obj", obj);
    check_list("absolute.obj", (const char *const[]){ "a.mtl", "red.png", NULL });
    snprintf(obj, sizeof obj, "%sf 1 2 3\n", triangle);
    put("none.obj", obj);
    check_list("none.obj", (const char *const[]){ NULL });
}

static void what_is_malformed_names_files_still(void)
{
    char obj[2048];
    snprintf(obj, sizeof obj, "mtllib a.mtl\n%sf 1 2 99\n", triangle);
    put("bad.obj", obj);
    check_list("bad.obj", (const char *const[]){ "a.mtl", NULL });
    snprintf(obj, sizeof obj, "mtllib missing.mtl\n%sf 1 2 3\n", triangle);
    put("missing.obj", obj);
    check_list("missing.obj", (const char *const[]){ "missing.mtl", NULL });
}

/* Enough names to grow the list several times. */
static void many_files(void)
{
    static char names[40][16], obj[4096];
    const char *expected[41] = { NULL };
    size_t size = 0;
    for (int i = 0; i < 40; i++) {
        snprintf(names[i], sizeof names[i], "m%d.mtl", i);
        expected[i] = names[i];
        put(names[i], "# empty\n");
        size += (size_t)snprintf(obj + size, sizeof obj - size, "mtllib %s\n", names[i]);
    }
    snprintf(obj + size, sizeof obj - size, "%sf 1 2 3\n", triangle);
    put("many.obj", obj);
    check_list("many.obj", expected);
}

static void no_such_file(void)
{
    lom_error error = { 0 };
    lom_bytes list = lom_list_obj_files("/no/such.obj", &error);
    CHECK(list.data == NULL && list.size == 0 && error.code == LOM_ERROR_FILE, "%s", error.text);
}

int main(int argc, char **argv)
{
    if (mkdtemp(folder) == NULL)
        return 1;
    RUN(materials_and_maps);
    RUN(what_is_malformed_names_files_still);
    RUN(many_files);
    RUN(no_such_file);
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command) != 0 || check_result();
}
