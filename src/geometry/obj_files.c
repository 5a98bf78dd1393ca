/* The files that an OBJ file names. In: its path. Out: the paths of its material files and of their maps, as far as
 * they can be read. Invariant: an OBJ or MTL file that is malformed still gives what it named before its mistake;
 * a list is whole, or there is an error. */
#include "base/pass_error.h"
#include "base/reserve.h"
#include "obj.h"

#include <string.h>
#include <unistd.h>

enum { MATERIAL_FILE_LIMIT = 1 << 26 };

size_t lom_folder_length(const char *path, size_t length)
{
    while (length > 0 && path[length - 1] != '/')
        length--;
    return length;
}

/* A name is never the standard input: "./" goes before it. */
char *lom_path_beside(const char *path, const char *name, lom_error *error)
{
    size_t folder = lom_folder_length(path, strlen(path)), length = strlen(name);
    char *joined = lom_allocate(folder + length + 3, 1, error);
    if (joined == NULL)
        return NULL;
    if (folder == 0) {
        path = "./";
        folder = 2;
    }
    if (name[0] == '/')
        folder = 0;
    memcpy(joined, path, folder);
    memcpy(joined + folder, name, length + 1);
    return joined;
}

/* A file that is there and cannot be read is no missing one. */
lom_bytes lom_read_beside(void *context, const char *name, lom_error *error)
{
    char *path = lom_path_beside(*(const char **)context, name, error);
    if (path == NULL)
        return (lom_bytes){ 0 };
    lom_bytes file = lom_read_file(path, MATERIAL_FILE_LIMIT, error);
    if (file.data == NULL && error->code == LOM_ERROR_FILE && access(path, F_OK) == 0)
        error->code = LOM_ERROR_INPUT;
    lom_release(path);
    return file;
}

struct list {
    const char *obj;
    lom_bytes paths; /* one after the other, each with its zero byte */
    size_t capacity;
};

static bool add(struct list *list, const char *name, lom_error *error)
{
    char *path = lom_path_beside(list->obj, name, error);
    if (path == NULL)
        return false;
    size_t size = strlen(path) + 1;
    bool added = lom_reserve(&list->paths.data, &list->capacity, list->paths.size + size, 1, error);
    if (added) {
        memcpy(list->paths.data + list->paths.size, path, size);
        list->paths.size += size;
    }
    lom_release(path);
    return added;
}

static lom_bytes list_and_read(void *context, const char *name, lom_error *error)
{
    struct list *list = context;
    if (!add(list, name, error))
        return (lom_bytes){ 0 };
    return lom_read_beside(&list->obj, name, error);
}

static bool add_maps(struct list *list, const lom_material *m, lom_error *error)
{
    const char *const maps[] = { m->diffuse_map, m->emissive_map, m->specular_map,
                                 m->gloss_map,   m->opacity_map,  m->normal_map };
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (maps[i][0] != 0 && !add(list, maps[i], error))
            return false;
    return true;
}

lom_bytes lom_list_obj_files(const char *path, lom_error *error)
{
    struct list list = { .obj = path };
    lom_error malformed = { .code = LOM_OK };
    lom_bytes file = lom_read_file(path, SIZE_MAX, error);
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    lom_mesh *mesh = lom_decode_obj_with((const char *)file.data, file.size, path, list_and_read, &list, &malformed);
    bool done = malformed.code != LOM_ERROR_MEMORY || lom_pass_error(&malformed, error);
    for (size_t i = 0; mesh != NULL && done && i < mesh->material_count; i++)
        done = add_maps(&list, &mesh->materials[i], error);
    lom_free_mesh(mesh);
    lom_release(file.data);
    if (done)
        return list.paths;
    lom_release(list.paths.data);
    return (lom_bytes){ 0 };
}
