/* The tables of the scene file's materials and their check. In: the members as the file gives them. Out: which of a
 * mesh's own values they replace. */
#include "scene/scene_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static bool check_material(void *members, const lom_key_check *check)
{
    lom_scene_material *material = members;
    material->has_ambient = check->is_given(check, "ambient");
    material->has_diffuse = check->is_given(check, "diffuse");
    material->has_specular = check->is_given(check, "specular");
    material->has_shininess = check->is_given(check, "shininess");
    return true;
}

static const lom_key material[] = {
    { "ambient",
      LOM_KEY_COLOR,
      AT(lom_scene_material, ambient),
      3,
      LOM_KEY_SPREAD,
      0,
      1000,
      { 1, 1, 1 },
      .text = "Factor on the ambient light." },
    { "diffuse",
      LOM_KEY_COLOR,
      AT(lom_scene_material, diffuse),
      3,
      LOM_KEY_SPREAD,
      0,
      1000,
      { 1, 1, 1 },
      .text = "Factor on the diffuse light." },
    { "specular",
      LOM_KEY_COLOR,
      AT(lom_scene_material, specular),
      3,
      LOM_KEY_SPREAD,
      0,
      1000,
      { 0, 0, 0 },
      .text = "Factor on the highlight." },
    { "shininess", LOM_KEY_NUMBER, AT(lom_scene_material, shininess), .maximum = 10000, .initial = { 10 },
      .text = "Phong exponent of the highlight." },
    { "texture", LOM_KEY_FILE, AT(lom_scene_material, texture),
      .text = "Colour picture that multiplies ambient and diffuse." },
};
const lom_key_table lom_entity_material_keys = {
    .size = sizeof(lom_scene_material),
    .keys = material,
    .key_count = COUNT(material),
    .text = "Takes the place of the mesh's own material; what is not given here stays as the mesh has it.",
    .check = check_material
};
/* The terrain's colour comes from terrain.texture, so its material has no texture. */
const lom_key_table lom_terrain_material_keys = { .size = sizeof(lom_scene_material),
                                                  .keys = material,
                                                  .key_count = COUNT(material) - 1,
                                                  .text = "How the terrain answers light.",
                                                  .check = check_material };
