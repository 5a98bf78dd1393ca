/* The table of the scene file's [terrain] keys and its check. */
#include "scene/scene_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static bool check_layer(void *members, const lom_key_check *check)
{
    const lom_terrain_layer *layer = members;
    if (layer->map == NULL)
        return check->fail(check, "map", "a layer needs a map.");
    if (layer->from_height > layer->to_height)
        return check->fail(check, "from_height", "\"from_height\" must not be above \"to_height\".");
    if (layer->from_slope > layer->to_slope)
        return check->fail(check, "from_slope", "\"from_slope\" must not be above \"to_slope\".");
    return true;
}

static bool check_terrain(void *members, const lom_key_check *check)
{
    const lom_terrain *terrain = members;
    return !terrain->present || terrain->height_map != NULL ||
           check->fail(check, "height_map", "the terrain needs a height map.");
}

static const lom_key terrain_layer[] = {
    { "map", LOM_KEY_FILE, AT(lom_terrain_layer, map), .flags = LOM_KEY_REQUIRED, .text = "Colour picture." },
    { "tile", LOM_KEY_NUMBER, AT(lom_terrain_layer, tile), .maximum = 1e6, .initial = { 10 }, .unit = "m",
      .text = "Length that one repetition covers; 0 is once over the whole terrain." },
    { "from_height", LOM_KEY_NUMBER, AT(lom_terrain_layer, from_height), .minimum = -1e9, .maximum = 1e9,
      .initial = { -1e9 }, .unit = "m", .text = "Where the layer begins (y).", .initial_text = "no bound" },
    { "to_height", LOM_KEY_NUMBER, AT(lom_terrain_layer, to_height), .minimum = -1e9, .maximum = 1e9,
      .initial = { 1e9 }, .unit = "m", .text = "Where it ends (y).", .initial_text = "no bound" },
    { "from_slope", LOM_KEY_ANGLE, AT(lom_terrain_layer, from_slope), .maximum = 90, .unit = "degrees",
      .text = "Least slope: 0 is flat ground." },
    { "to_slope", LOM_KEY_ANGLE, AT(lom_terrain_layer, to_slope), .maximum = 90, .initial = { 90 }, .unit = "degrees",
      .text = "Greatest slope: 90 is an upright wall." },
    { "blend", LOM_KEY_NUMBER, AT(lom_terrain_layer, blend), .maximum = 1e6, .initial = { 1 }, .unit = "m",
      .text = "Height over which the layer fades in and out at its bounds." },
    { "slope_blend", LOM_KEY_ANGLE, AT(lom_terrain_layer, slope_blend), .maximum = 90, .initial = { 5 },
      .unit = "degrees", .text = "The same at the bounds of the slope." },
    { "grain", LOM_KEY_NUMBER, AT(lom_terrain_layer, grain), .maximum = 100,
      .text =
          "Where the layer fades, it lies thicker on what is darker than the picture below it is on average, as snow "
          "lies in clefts; larger numbers make its border sharper and more ragged." },
    { "mapping", LOM_KEY_CHOICE, AT(lom_terrain_layer, mapping), .choices = { "planar", "triplanar" },
      .text = "`planar` lays the picture on from above, which stretches it on steep ground; `triplanar` from above and "
              "from the sides, mixed by the normal." },
};
static const lom_key_table terrain_layer_table = {
    .size = sizeof(lom_terrain_layer),
    .keys = terrain_layer,
    .key_count = COUNT(terrain_layer),
    .text = "A texture painted over the ones before it, where height and slope are inside its ranges.",
    .check = check_layer
};

static const lom_key terrain[] = {
    { "height_map", LOM_KEY_FILE, AT(lom_terrain, height_map), .flags = LOM_KEY_REQUIRED,
      .text = "Grey picture (white is highest), of 8 or 16 bits; one vertex a pixel." },
    { "size",
      LOM_KEY_NUMBER,
      AT(lom_terrain, size),
      2,
      LOM_KEY_SPREAD | LOM_KEY_ABOVE,
      0,
      1e6,
      { 100, 100 },
      "m",
      .text = "Width along x and length along z." },
    { "position", LOM_KEY_NUMBER, AT(lom_terrain, position), 2, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "x and z of its middle. All is drawn as exactly there as at 0." },
    { "height", LOM_KEY_NUMBER, AT(lom_terrain, height), .minimum = -1e6, .maximum = 1e6, .initial = { 20 },
      .unit = "m", .text = "Difference between black and white." },
    { "base", LOM_KEY_NUMBER, AT(lom_terrain, base), .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Height (y) of black." },
    { "texture", LOM_KEY_FILE, AT(lom_terrain, texture), .text = "Colour picture under all layers." },
    { "tile", LOM_KEY_NUMBER, AT(lom_terrain, tile), .maximum = 1e6, .unit = "m",
      .text = "Length that one repetition of the texture covers; 0 is once over the whole terrain." },
    { "detail_map", LOM_KEY_FILE, AT(lom_terrain, detail_map),
      .text = "Grey picture for close views: the colour is multiplied by twice its value." },
    { "detail_tile", LOM_KEY_NUMBER, AT(lom_terrain, detail_tile), .flags = LOM_KEY_ABOVE, .maximum = 1e6,
      .initial = { 4 }, .unit = "m", .text = "Length that one repetition of the detail and normal maps covers." },
    { "normal_map", LOM_KEY_FILE, AT(lom_terrain, normal_map),
      .text = "Picture of normals (RGB = 2n - 1, blue up) that roughens the ground." },
    { "material", LOM_KEY_TABLE, AT(lom_terrain, material), .table = &lom_terrain_material_keys },
    { "layer", LOM_KEY_TABLES, AT(lom_terrain, layers), .table = &terrain_layer_table,
      .length_offset = AT(lom_terrain, layer_count), .text = "Textures by height and slope." },
};
const lom_key_table lom_terrain_keys = { .size = sizeof(lom_terrain),
                                         .keys = terrain,
                                         .key_count = COUNT(terrain),
                                         .text = "Ground from a height map. Without this table there is none.",
                                         .check = check_terrain };
