/* Entities. In: a name and a seed; out: a mesh whose materials name the textures of lom_make_albedo. Coordinates are
 * rounded to millimetres, so that the written files are short and read back as the same numbers. */
#include "geometry/model.h"

#include <string.h>

static const struct entity {
    const char *name;
    void (*build)(lom_mesh_builder *builder, uint64_t seed, lom_error *error);
} entities[] = {
    { "boat", lom_build_boat },     { "jetty", lom_build_jetty }, { "cabin", lom_build_cabin },
    { "spruce", lom_build_spruce }, { "pine", lom_build_pine },   { "boulder", lom_build_boulder },
    { "stones", lom_build_stones }, { "reeds", lom_build_reeds },
};

const char *lom_entity_name(size_t index)
{
    return index < sizeof entities / sizeof entities[0] ? entities[index].name : NULL;
}

static float rounded(float value, double unit)
{
    return (float)(lom_double_floor(value * unit + 0.5) / unit);
}

static void round_mesh(lom_mesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        lom_mesh_vertex *v = &mesh->vertices[i];
        for (int k = 0; k < 3; k++) {
            v->position[k] = rounded(v->position[k], 1000);
            v->normal[k] = rounded(v->normal[k], 1000);
        }
        for (int k = 0; k < 2; k++)
            v->uv[k] = rounded(v->uv[k], 1000);
    }
}

lom_mesh *lom_make_entity(const char *name, uint64_t seed, lom_error *error)
{
    const struct entity *found = NULL;
    for (size_t i = 0; i < sizeof entities / sizeof entities[0]; i++)
        if (strcmp(entities[i].name, name) == 0)
            found = &entities[i];
    if (found == NULL) {
        lom_fail(error, LOM_ERROR_USAGE, "There is no entity named \"%s\".", name);
        return NULL;
    }
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_mesh_builder *builder = lom_create_mesh_builder(error);
    found->build(builder, seed, error);
    lom_mesh *mesh = lom_finish_mesh(builder, 0.8, error);
    if (mesh != NULL)
        round_mesh(mesh);
    lom_leave_float_state(&state);
    return mesh;
}
