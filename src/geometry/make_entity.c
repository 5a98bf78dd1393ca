/* Entities. In: a name and a seed; out: a mesh whose materials name the textures of lom_make_albedo. Coordinates are
 * rounded (houses to millimetres, trees to centimetres), so that the files are short and read back the same. */
#include "geometry/model.h"

#include <string.h>

static const struct entity {
    const char *name;
    void (*build)(lom_mesh_builder *builder, uint64_t seed);
    double units; /* coordinates are multiples of 1 / units */
} entities[] = {
    { "boat", lom_build_boat, 1000 },         { "jetty", lom_build_jetty, 1000 },
    { "cabin", lom_build_cabin, 1000 },       { "spruce", lom_build_spruce, 100 },
    { "pine", lom_build_pine, 100 },          { "boulder", lom_build_boulder, 1000 },
    { "stones", lom_build_stones, 1000 },     { "reeds", lom_build_reeds, 1000 },
    { "aircraft", lom_build_aircraft, 1000 }, { "lit_cabin", lom_build_lit_cabin, 1000 },
    { "lantern", lom_build_lantern, 1000 },   { "lamp_post", lom_build_lamp_post, 1000 },
    { "fire", lom_build_fire, 1000 },         { "ball", lom_build_ball, 1000 },
    { "bowl", lom_build_bowl, 1000 },         { "slab", lom_build_slab, 1000 },
    { "floats", lom_build_floats, 10000 },
};

const char *lom_entity_name(size_t index)
{
    return index < sizeof entities / sizeof entities[0] ? entities[index].name : NULL;
}

static float rounded(float value, double units)
{
    return (float)(lom_double_floor(value * units + 0.5) / units);
}

static void round_mesh(lom_mesh *mesh, double units)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        lom_mesh_vertex *v = &mesh->vertices[i];
        for (int k = 0; k < 3; k++) {
            v->position[k] = rounded(v->position[k], units);
            v->normal[k] = rounded(v->normal[k], units);
        }
        for (int k = 0; k < 2; k++)
            v->uv[k] = rounded(v->uv[k], units);
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
    found->build(builder, seed);
    lom_mesh *mesh = lom_finish_mesh(builder, 0.8, error);
    if (mesh != NULL)
        round_mesh(mesh, found->units);
    lom_leave_float_state(&state);
    return mesh;
}
