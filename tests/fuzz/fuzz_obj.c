/* Fuzz target: OBJ with its material file. The bytes up to the first 0xFF are the OBJ, the rest every MTL it names.
 * What is accepted is written, read again, and must be written the same. */
#include <lom/geometry.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static lom_bytes read_material(void *context, const char *name, lom_error *error)
{
    const lom_bytes *source = context;
    (void)name;
    lom_bytes copy = { lom_allocate(source->size, 1, error), source->size };
    if (copy.data != NULL && source->size > 0)
        memcpy(copy.data, source->data, source->size);
    return copy;
}

static void require(bool condition)
{
    if (!condition)
        abort();
}

/* Its parts hold all of its indices, in order. */
static void check_parts(const lom_mesh *mesh)
{
    size_t next = 0;
    for (size_t k = 0; k < lom_mesh_parts(mesh); k++) {
        require(mesh->parts[k].first_index == next && mesh->parts[k].index_count > 0);
        next += mesh->parts[k].index_count;
    }
    require(next == mesh->index_count + mesh->line_index_count + mesh->point_count);
}

static void check_again(const lom_mesh *mesh)
{
    lom_bytes first = lom_encode_obj(mesh, NULL, NULL);
    if (first.data == NULL)
        return;
    lom_mesh *again = lom_decode_obj((const char *)first.data, first.size, "again.obj", NULL);
    require(again != NULL && again->index_count == mesh->index_count &&
            again->line_index_count == mesh->line_index_count && again->point_count == mesh->point_count);
    lom_bytes second = lom_encode_obj(again, NULL, NULL);
    require(second.size == first.size && memcmp(second.data, first.data, first.size) == 0);
    lom_release(first.data);
    lom_release(second.data);
    lom_free_mesh(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *mark = size == 0 ? NULL : memchr(data, 0xFF, size);
    size_t obj_size = mark == NULL ? size : (size_t)(mark - data);
    uint8_t *rest = mark == NULL ? NULL : malloc(size - obj_size);
    if (rest != NULL)
        memcpy(rest, mark + 1, size - obj_size - 1);
    lom_bytes mtl = { rest, rest == NULL ? 0 : size - obj_size - 1 };
    lom_error error = { 0 };
    lom_mesh *mesh = lom_decode_obj_with((const char *)data, obj_size, "fuzz.obj", read_material, &mtl, &error);
    require((mesh == NULL) == (error.code != LOM_OK));
    if (mesh != NULL) {
        for (size_t k = 0; k < mesh->index_count + mesh->line_index_count + mesh->point_count; k++)
            require(mesh->indices[k] < mesh->vertex_count);
        check_parts(mesh);
        check_again(mesh);
    }
    lom_free_mesh(mesh);
    free(rest);
    return 0;
}
