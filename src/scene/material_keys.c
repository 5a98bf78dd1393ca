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
    material->has_emissive = check->is_given(check, "emissive");
    material->has_bump = check->is_given(check, "bump");
    material->has_opacity = check->is_given(check, "opacity");
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
    { "emissive", LOM_KEY_COLOR, AT(lom_scene_material, emissive), 3, .flags = LOM_KEY_SPREAD, .maximum = 1000,
      .text = "Light of its own, which falls on nothing else: a lamp does that." },
    { "emissive_map", LOM_KEY_FILE, AT(lom_scene_material, emissive_map),
      .text = "Colour picture that multiplies `emissive`." },
    { "specular_map", LOM_KEY_FILE, AT(lom_scene_material, specular_map),
      .text = "Colour picture that multiplies `specular`." },
    { "gloss_map", LOM_KEY_FILE, AT(lom_scene_material, gloss_map),
      .text = "Picture whose red, from 0 to 1, multiplies `shininess`." },
    { "normal_map", LOM_KEY_FILE, AT(lom_scene_material, normal_map),
      .text = "Normals in the mesh's texture coordinates (red to the right, green up the picture, blue off the "
              "surface), for "
              "light at each fragment; a grey picture holds heights." },
    { "bump", LOM_KEY_NUMBER, AT(lom_scene_material, bump), .minimum = -1000, .maximum = 1000, .initial = { 1 },
      .text = "Of a normal map that holds heights: white is so many 64ths of the picture's width above black." },
    { "opacity", LOM_KEY_NUMBER, AT(lom_scene_material, opacity), .maximum = 1, .initial = { 1 },
      .text =
          "The share of what is behind it that it hides. Below 1 it is drawn after all that is opaque, its triangles "
          "from the farthest to the nearest, and throws no shadow (docs/transparency.md)." },
    { "opacity_map", LOM_KEY_FILE, AT(lom_scene_material, opacity_map),
      .text = "Picture that multiplies opacity, and the highlight: its alpha, or where that is whole its red." },
};
enum { TERRAIN_KEYS = 4 };
const lom_key_table lom_entity_material_keys = {
    .size = sizeof(lom_scene_material),
    .keys = material,
    .key_count = COUNT(material),
    .text = "Takes the place of the mesh's own material; what is not given here stays as the mesh has it.",
    .check = check_material
};
const lom_key_table lom_entity_back_keys = {
    .size = sizeof(lom_scene_material),
    .keys = material,
    .key_count = COUNT(material),
    .text = "What the back sides of a two-sided entity are made of; what is not given here is as in front.",
    .check = check_material
};
/* The terrain's colour comes from terrain.texture, so its material has no texture. */
const lom_key_table lom_terrain_material_keys = { .size = sizeof(lom_scene_material),
                                                  .keys = material,
                                                  .key_count = TERRAIN_KEYS,
                                                  .text = "How the terrain answers light.",
                                                  .check = check_material };
