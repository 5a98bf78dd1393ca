/* The table of the scene file's [[entity]] keys and its check. In: the members as the file gives them. Out: what the
 * keys of its path take from it. */
#include "scene/scene_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static bool check_entity(void *members, const lom_key_check *check)
{
    lom_entity *entity = members;
    if (entity->mesh == NULL)
        return check->fail(check, "mesh", "an entity needs a mesh.");
    if (!check->is_given(check, "two_sided"))
        entity->two_sided = entity->back.present;
    for (size_t i = 0; i < entity->key_count; i++) {
        const lom_key_check at = check->element(check, "key", i);
        lom_entity_key *key = &entity->keys[i];
        if (!at.is_given(&at, "position"))
            key->position = entity->position;
        if (!at.is_given(&at, "rotation"))
            key->rotation = entity->rotation;
        if (i > 0 && !lom_check_rising_time(&at, entity->keys[i - 1].time, key->time))
            return false;
    }
    return entity->key_count == 0 || !entity->on_ground ||
           check->fail(check, "on_ground", "an entity with keys does not stand on the ground.");
}

static const lom_key entity_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_entity_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e9, .maximum = 1e9,
      .unit = "s", .text = "When the entity is here; later than the key before." },
    { "position", LOM_KEY_NUMBER, AT(lom_entity_key, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where its origin is.", .initial_text = "the entity's" },
    { "rotation", LOM_KEY_ANGLE, AT(lom_entity_key, rotation), 3, .minimum = -36000, .maximum = 36000,
      .unit = "degrees", .text = "About x, then y, then z.", .initial_text = "the entity's" },
};
static const lom_key_table entity_key_table = { .size = sizeof(lom_entity_key),
                                                .keys = entity_key,
                                                .key_count = COUNT(entity_key),
                                                .text = "A key frame of the entity's path." };

static const lom_key entity[] = {
    { "name", LOM_KEY_STRING, AT(lom_entity, name), .text = "A name of its own, for overrides and messages." },
    { "mesh", LOM_KEY_FILE, AT(lom_entity, mesh), .flags = LOM_KEY_REQUIRED, .text = "Wavefront OBJ file." },
    { "position", LOM_KEY_NUMBER, AT(lom_entity, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where its origin is." },
    { "rotation", LOM_KEY_ANGLE, AT(lom_entity, rotation), 3, .minimum = -36000, .maximum = 36000, .unit = "degrees",
      .text = "About x, then y, then z." },
    { "scale",
      LOM_KEY_NUMBER,
      AT(lom_entity, scale),
      3,
      LOM_KEY_SPREAD | LOM_KEY_ABOVE,
      0,
      1e6,
      { 1, 1, 1 },
      .text = "Along x, y and z, applied first." },
    { "material", LOM_KEY_TABLE, AT(lom_entity, material), .table = &lom_entity_material_keys },
    { "two_sided", LOM_KEY_BOOL, AT(lom_entity, two_sided),
      .text = "Show the back sides of its triangles, too, with their normals turned round.",
      .initial_text = "whether there is a table `back`" },
    { "back", LOM_KEY_TABLE, AT(lom_entity, back), .table = &lom_entity_back_keys },
    { "on_ground", LOM_KEY_BOOL, AT(lom_entity, on_ground),
      .text = "Measure the position's y from the terrain below instead of from 0." },
    { "line_width", LOM_KEY_INTEGER, AT(lom_entity, line_width), .minimum = 1, .maximum = 64, .initial = { 1 },
      .unit = "pixels", .text = "Width of the mesh's lines (`l`) in the picture." },
    { "point_size", LOM_KEY_NUMBER, AT(lom_entity, point_size), .minimum = 0.25, .maximum = 4096, .initial = { 1 },
      .unit = "pixels",
      .text = "Size of the mesh's points (`p`) in the picture: a square's side, from 2 on a disc's diameter." },
    { "alpha_to_coverage", LOM_KEY_BOOL, AT(lom_entity, alpha_to_coverage),
      .text =
          "Of the samples of a pixel as many show the entity as its texture's alpha says (docs/samples.md); with one "
          "sample those pixels do whose alpha is 1/2 or more. For leaves, nets, fences. The reference does not know "
          "it." },
    { "visible", LOM_KEY_BOOL, AT(lom_entity, visible), .initial = { 1 }, .text = "Whether it is drawn." },
    { "interpolation", LOM_KEY_CHOICE, AT(lom_entity, interpolation), .choices = { "linear", "smooth" },
      .text = "Between the keys of a path, as of the camera." },
    { "key", LOM_KEY_TABLES, AT(lom_entity, keys), .table = &entity_key_table,
      .length_offset = AT(lom_entity, key_count), .text = "Key frames of an entity that moves." },
};
const lom_key_table lom_entity_keys = { .size = sizeof(lom_entity),
                                        .keys = entity,
                                        .key_count = COUNT(entity),
                                        .text = "A mesh that stands in the scene. There may be 16384 of them.",
                                        .check = check_entity };
