/* The table of all keys of a scene file. In: the tables of the model layers. Out: names, ranges, defaults and
 * documentation of everything lom_scene holds. Invariant: reading, messages and docs/scene.md come from here alone; a
 * new table of keys is one line in `root`. */
#include "scene/scene_keys.h"

#include "cloud/cloud_keys.h"
#include "sky/sky_keys.h"
#include "spray/spray_keys.h"
#include "water/water_keys.h"
#include "waves/wave_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static const lom_key output[] = {
    { "width", LOM_KEY_INTEGER, AT(lom_output, width), .minimum = 1, .maximum = LOM_MAX_SIZE, .initial = { 1280 },
      .unit = "pixels", .text = "Width of the picture." },
    { "height", LOM_KEY_INTEGER, AT(lom_output, height), .minimum = 1, .maximum = LOM_MAX_SIZE, .initial = { 720 },
      .unit = "pixels", .text = "Height of the picture." },
    { "transfer", LOM_KEY_CHOICE, AT(lom_output, transfer), .choices = { "srgb", "naive" },
      .text = "`srgb` decodes colour textures to linear light and encodes the picture once. `naive` does neither, as "
              "simple renderers do." },
    { "format", LOM_KEY_CHOICE, AT(lom_output, format), .choices = { "rgb8", "rgb16", "rgb32f" },
      .text = "Samples of the picture; `rgb32f` is linear and needs a kind of file that holds floats, as .pfm." },
    { "frames", LOM_KEY_INTEGER, AT(lom_output, frames), .minimum = 1, .maximum = 1e6, .initial = { 1 },
      .text = "Length of the animation." },
    { "fps", LOM_KEY_NUMBER, AT(lom_output, fps), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 30 },
      .unit = "1/s", .text = "Frame n shows the time n / fps." },
};
static const lom_key_table output_table = { sizeof(lom_output), output, COUNT(output),
                                            "The picture or the frames of the animation." };

static const lom_key camera_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_camera_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6,
      .unit = "s", .text = "When the camera is here; later than the key before." },
    { "position", LOM_KEY_NUMBER, AT(lom_camera_key, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where the camera is.", .initial_text = "the camera's" },
    { "target", LOM_KEY_NUMBER, AT(lom_camera_key, target), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "The point it looks at.", .initial_text = "the camera's" },
    { "field_of_view", LOM_KEY_ANGLE, AT(lom_camera_key, field_of_view), .minimum = 0.01, .maximum = 179,
      .unit = "degrees", .text = "Vertical angle of view.", .initial_text = "the camera's" },
};
static const lom_key_table camera_key_table = {
    sizeof(lom_camera_key), camera_key, COUNT(camera_key),
    "A key frame of the camera's path. Before the first key and after the last the camera stands still."
};

static const lom_key camera[] = {
    { "position", LOM_KEY_NUMBER, AT(lom_camera, position), 3, .minimum = -1e9, .maximum = 1e9, .initial = { 0, 2, 10 },
      .unit = "m", .text = "Where the camera is." },
    { "target", LOM_KEY_NUMBER, AT(lom_camera, target), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "The point it looks at; instead of `yaw` and `pitch`." },
    { "yaw", LOM_KEY_ANGLE, AT(lom_camera, yaw), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Direction of view: 0 looks along -z, 90 along -x (counter-clockwise seen from above)." },
    { "pitch", LOM_KEY_ANGLE, AT(lom_camera, pitch), .minimum = -90, .maximum = 90, .unit = "degrees",
      .text = "Direction of view: positive looks up." },
    { "roll", LOM_KEY_ANGLE, AT(lom_camera, roll), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Turns the camera counter-clockwise about its direction of view, so the picture turns clockwise." },
    { "up", LOM_KEY_NUMBER, AT(lom_camera, up), 3, .initial = { 0, 1, 0 },
      .text = "What is upwards in the picture; not along the direction of view." },
    { "field_of_view", LOM_KEY_ANGLE, AT(lom_camera, field_of_view), .minimum = 0.01, .maximum = 179, .initial = { 45 },
      .unit = "degrees", .text = "Vertical angle of view." },
    { "near", LOM_KEY_NUMBER, AT(lom_camera, near_plane), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 0.1 },
      .unit = "m", .text = "Distance of the near plane. There is no far plane." },
    { "interpolation", LOM_KEY_CHOICE, AT(lom_camera, interpolation), .choices = { "linear", "smooth" },
      .text = "Between the keys of a path: straight lines, or a Catmull-Rom curve through them." },
    { "key", LOM_KEY_TABLES, AT(lom_camera, keys), .table = &camera_key_table,
      .length_offset = AT(lom_camera, key_count), .text = "Key frames of a path." },
    { "follow", LOM_KEY_STRING, AT(lom_camera, follow),
      .text = "Name of an entity: `position`, `target`, `up` and the keys are then in its coordinates, whose -z is "
              "ahead." },
    { "person", LOM_KEY_CHOICE, AT(lom_camera, person), .choices = { "third", "first" },
      .text = "With `follow`: behind the entity, turned by its heading alone; or in it, turned as it is, without "
              "drawing it." },
};
static const lom_key_table camera_table = { sizeof(lom_camera), camera, COUNT(camera),
                                            "Where the picture is taken from." };

static const lom_key light_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_light_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6,
      .unit = "s", .text = "When the sun is here; later than the key before." },
    { "azimuth", LOM_KEY_ANGLE, AT(lom_light_key, azimuth), .minimum = -36000, .maximum = 36000, .unit = "degrees",
      .text = "Where it stands.", .initial_text = "the light's" },
    { "elevation", LOM_KEY_ANGLE, AT(lom_light_key, elevation), .minimum = -90, .maximum = 90, .unit = "degrees",
      .text = "Its height above the horizon.", .initial_text = "the light's" },
    { "color", LOM_KEY_COLOR, AT(lom_light_key, color), 3, .maximum = 1000, .text = "Colour of the light.",
      .initial_text = "the light's" },
    { "intensity", LOM_KEY_NUMBER, AT(lom_light_key, intensity), .maximum = 1e6, .text = "Factor on the colour.",
      .initial_text = "the light's" },
};
static const lom_key_table light_key_table = { sizeof(lom_light_key), light_key, COUNT(light_key),
                                               "A key frame of the sun's path, with straight lines between." };

static const lom_key light[] = {
    { "direction", LOM_KEY_NUMBER, AT(lom_light, direction), 3,
      .text = "The way the light travels, from the sun towards the scene, of any length; instead of `azimuth` and "
              "`elevation`.",
      .initial_text = "from `azimuth` and `elevation`" },
    { "azimuth", LOM_KEY_ANGLE, AT(lom_light, azimuth), .minimum = -360, .maximum = 360, .initial = { 135 },
      .unit = "degrees", .text = "Where the sun stands: 0 is north (-z), 90 is east (+x)." },
    { "elevation", LOM_KEY_ANGLE, AT(lom_light, elevation), .minimum = -90, .maximum = 90, .initial = { 45 },
      .unit = "degrees", .text = "Height of the sun above the horizon." },
    { "color", LOM_KEY_COLOR, AT(lom_light, color), 3, .maximum = 1000, .initial = { 1, 1, 1 },
      .text = "Colour of the light." },
    { "intensity", LOM_KEY_NUMBER, AT(lom_light, intensity), .maximum = 1e6, .initial = { 1 },
      .text = "Factor on the colour." },
    { "ambient", LOM_KEY_COLOR, AT(lom_light, ambient), 3, .maximum = 1000, .initial = { 0.15, 0.15, 0.15 },
      .text = "Light from everywhere; not multiplied by the intensity. With `ground`, the light on what faces up." },
    { "ground", LOM_KEY_COLOR, AT(lom_light, ground), 3, .maximum = 1000, .initial_text = "as `ambient`",
      .text = "Light on what faces down; in between the two are mixed by the cosine between the normal and up." },
    { "key", LOM_KEY_TABLES, AT(lom_light, keys), .table = &light_key_table, .length_offset = AT(lom_light, key_count),
      .text = "Key frames of a sun that moves." },
};
static const lom_key_table light_table = { sizeof(lom_light), light, COUNT(light),
                                           "The one directional light of the scene, the sun." };

static const lom_key haze[] = {
    { "density",
      LOM_KEY_NUMBER,
      AT(lom_haze, density),
      3,
      LOM_KEY_SPREAD,
      0,
      1e3,
      { 1e-4, 1e-4, 1e-4 },
      "1/m",
      .text = "Extinction of the air up to `base`, for red, green and blue. Air scatters blue most: distant snow "
              "turns warm and distant woods blue." },
    { "color", LOM_KEY_COLOR, AT(lom_haze, color), 3, .maximum = 1000, .initial = { 0.5, 0.6, 0.7 },
      .text = "Colour of the air: what a path without end would show. Pictures of the sky have their own haze." },
    { "base", LOM_KEY_NUMBER, AT(lom_haze, base), .minimum = -1e6, .maximum = 1e6, .unit = "m",
      .text = "Height (y) above which the air gets thinner." },
    { "height", LOM_KEY_NUMBER, AT(lom_haze, height), .maximum = 1e6, .unit = "m",
      .text = "Height over which it falls to 1/e; 0: the same everywhere." },
    { "glow", LOM_KEY_COLOR, AT(lom_haze, glow), 3, .maximum = 1000,
      .text = "What is added to the colour in the direction of the sun." },
    { "glow_exponent", LOM_KEY_NUMBER, AT(lom_haze, glow_exponent), .flags = LOM_KEY_ABOVE, .maximum = 1000,
      .initial = { 8 }, .text = "Exponent on the cosine between the path and the sun; larger is narrower." },
};
static const lom_key_table haze_table = { sizeof(lom_haze), haze, COUNT(haze),
                                          "Air between the camera and what it sees. Without this table it is clear." };

/* The order makes the bits LOM_MATERIAL_... */
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
static const lom_key_table entity_material_table = {
    sizeof(lom_scene_material), material, COUNT(material),
    "Takes the place of the mesh's own material; what is not given here stays as the mesh has it."
};
/* The terrain's colour comes from terrain.texture, so its material has no texture. */
static const lom_key_table terrain_material_table = { sizeof(lom_scene_material), material, COUNT(material) - 1,
                                                      "How the terrain answers light." };

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
    sizeof(lom_terrain_layer), terrain_layer, COUNT(terrain_layer),
    "A texture painted over the ones before it, where height and slope are inside its ranges."
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
      .text = "Width along x and length along z; the middle is at x = z = 0." },
    { "height", LOM_KEY_NUMBER, AT(lom_terrain, height), .minimum = -1e6, .maximum = 1e6, .initial = { 20 },
      .unit = "m", .text = "Difference between black and white." },
    { "base", LOM_KEY_NUMBER, AT(lom_terrain, base), .minimum = -1e6, .maximum = 1e6, .unit = "m",
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
    { "material", LOM_KEY_TABLE, AT(lom_terrain, material), .table = &terrain_material_table },
    { "layer", LOM_KEY_TABLES, AT(lom_terrain, layers), .table = &terrain_layer_table,
      .length_offset = AT(lom_terrain, layer_count), .text = "Textures by height and slope." },
};
static const lom_key_table terrain_table = { sizeof(lom_terrain), terrain, COUNT(terrain),
                                             "Ground from a height map. Without this table there is none." };

static const lom_key entity_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_entity_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6,
      .unit = "s", .text = "When the entity is here; later than the key before." },
    { "position", LOM_KEY_NUMBER, AT(lom_entity_key, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where its origin is.", .initial_text = "the entity's" },
    { "rotation", LOM_KEY_ANGLE, AT(lom_entity_key, rotation), 3, .minimum = -36000, .maximum = 36000,
      .unit = "degrees", .text = "About x, then y, then z.", .initial_text = "the entity's" },
};
static const lom_key_table entity_key_table = { sizeof(lom_entity_key), entity_key, COUNT(entity_key),
                                                "A key frame of the entity's path." };

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
    { "material", LOM_KEY_TABLE, AT(lom_entity, material), .table = &entity_material_table },
    { "on_ground", LOM_KEY_BOOL, AT(lom_entity, on_ground),
      .text = "Measure the position's y from the terrain below instead of from 0." },
    { "visible", LOM_KEY_BOOL, AT(lom_entity, visible), .initial = { 1 }, .text = "Whether it is drawn." },
    { "interpolation", LOM_KEY_CHOICE, AT(lom_entity, interpolation), .choices = { "linear", "smooth" },
      .text = "Between the keys of a path, as of the camera." },
    { "key", LOM_KEY_TABLES, AT(lom_entity, keys), .table = &entity_key_table,
      .length_offset = AT(lom_entity, key_count), .text = "Key frames of an entity that moves." },
};
static const lom_key_table entity_table = { sizeof(lom_entity), entity, COUNT(entity),
                                            "A mesh that stands in the scene. There may be 16384 of them." };

static const lom_key reference[] = {
    { "samples", LOM_KEY_INTEGER, AT(lom_reference_quality, samples), .minimum = 1, .maximum = 65536, .initial = { 16 },
      .text = "Rays a pixel, spread over its area; 1 is its middle." },
    { "depth", LOM_KEY_INTEGER, AT(lom_reference_quality, depth), .minimum = 0, .maximum = 64, .initial = { 6 },
      .text = "How many times a ray may be divided or mirrored at water; after that water is not seen." },
    { "sun", LOM_KEY_ANGLE, AT(lom_reference_quality, sun), .minimum = 0.01, .maximum = 10, .initial = { 1 },
      .unit = "degrees",
      .text = "Radius of the sun's disc as water shows it. The real one has 0.27; a larger one has the same light and "
              "less noise." },
};
static const lom_key_table reference_table = { sizeof(lom_reference_quality), reference, COUNT(reference),
                                               "How exact the reference is." };

static const lom_key quality[] = {
    { "water", LOM_KEY_CHOICE, AT(lom_quality, water),
      .choices = { "planar", "tinted", "normal_map", "displaced", "marched", "reference" },
      .text =
          "Model of the water, docs/water.md. Tinted: a quad of one colour. Planar: the nine steps of `[water]`. Then "
          "the waves of `[water.waves]`: as normals on two triangles; as a mesh; met by a ray for each pixel. "
          "Reference: rays in double precision, for the whole frame; what the others are measured against." },
    { "clouds", LOM_KEY_CHOICE, AT(lom_quality, clouds),
      .choices = { "octaves", "forward", "single", "original", "billboard", "off", "reference" },
      .text = "Model of the clouds: marched with octaves of multiple scattering, with multiple forward scattering, or "
              "with light that was scattered once; the reference work's; a flat picture; none; random paths in "
              "double precision, for which the whole frame is the reference's." },
    { "cloud_error", LOM_KEY_NUMBER, AT(lom_quality, cloud_error), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 0.05 },
      .text =
          "Bound on the error of an optical depth, in parts of the greatest one of that length: it sets the step." },
    { "cloud_stop", LOM_KEY_NUMBER, AT(lom_quality, cloud_stop), .maximum = 1, .initial = { 0.004 },
      .text = "A ray ends when less than this share of the light behind comes through." },
    { "cloud_octaves", LOM_KEY_INTEGER, AT(lom_quality, cloud_octaves), .minimum = 1, .maximum = 8, .initial = { 4 },
      .text = "Octaves of multiple scattering." },
    { "cloud_jitter", LOM_KEY_BOOL, AT(lom_quality, cloud_jitter), .initial = { 1 },
      .text = "Shift samples along the ray by a table of blue noise, which breaks up bands." },
    { "cloud_light_scale", LOM_KEY_NUMBER, AT(lom_quality, cloud_light_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 0.5 }, .text = "Size of the grid of light, in parts of the density's, along each axis." },
    { "spray", LOM_KEY_BOOL, AT(lom_quality, spray), .initial = { 1 }, .text = "Draw the drops of `[[spray]]`." },
    { "impostors", LOM_KEY_CHOICE, AT(lom_quality, impostors), .choices = { "off", "reference", "bounded" },
      .text =
          "Whether a cloud's picture is kept on a plate and shown again while the camera moves: never; by the "
          "reference work's rule; while its error in pixels is below a bound. In a run of frames a plate depends on "
          "the frames before; a frame alone draws every cloud afresh." },
    { "impostor", LOM_KEY_TABLE, AT(lom_quality, impostor), .table = &lom_impostor_keys },
    { "shading", LOM_KEY_CHOICE, AT(lom_quality, shading), .choices = { "phong", "gouraud", "flat" },
      .text = "Light for each fragment, for each vertex, or for each face." },
    { "texture_filter", LOM_KEY_CHOICE, AT(lom_quality, texture_filter),
      .choices = { "trilinear", "bilinear", "nearest" }, .text = "How textures are sampled." },
    { "mipmaps", LOM_KEY_BOOL, AT(lom_quality, mipmaps), .initial = { 1 },
      .text = "Smaller versions of textures for distant surfaces. Off: the finest level alone." },
    { "reflection_scale", LOM_KEY_NUMBER, AT(lom_quality, reflection_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 1 }, .text = "Size of the reflection's picture, in parts of the output's, along each axis." },
    { "refraction_scale", LOM_KEY_NUMBER, AT(lom_quality, refraction_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 1 }, .text = "The same of the refraction's picture." },
    { "scissor", LOM_KEY_BOOL, AT(lom_quality, scissor), .initial = { 1 },
      .text =
          "Draw these pictures only where the water can look them up. Changes time alone: off gives the same bytes." },
    { "reference", LOM_KEY_TABLE, AT(lom_quality, reference), .table = &reference_table },
    { "terrain_error", LOM_KEY_NUMBER, AT(lom_quality, terrain_error), .maximum = 1000, .initial = { 1 },
      .unit = "pixels",
      .text = "How far the surface of terrain may be off on the screen where it is drawn with fewer triangles. 0 draws "
              "every pixel of the height map everywhere." },
    { "terrain_shadows", LOM_KEY_BOOL, AT(lom_quality, terrain_shadows),
      .text = "Terrain keeps the sun off terrain, entities and water that lie behind it." },
    { "entity_shadows", LOM_KEY_INTEGER, AT(lom_quality, entity_shadows), .minimum = 0, .maximum = 8192,
      .unit = "texels",
      .text =
          "Entities keep the sun off terrain and entities: a side of each of two maps, one of the entities near the "
          "eye. 0: they do not." },
    { "ambient_occlusion", LOM_KEY_BOOL, AT(lom_quality, ambient_occlusion),
      .text = "Ambient light on terrain only from the part of the sky that the terrain around leaves free." },
};
static const lom_key_table quality_table = { sizeof(lom_quality), quality, COUNT(quality),
                                             "The dials that trade accuracy for time." };

static const lom_key root[] = {
    { "title", LOM_KEY_STRING, AT(lom_scene, title), .text = "What the scene shows, for people." },
    { "output", LOM_KEY_TABLE, AT(lom_scene, output), .table = &output_table },
    { "camera", LOM_KEY_TABLE, AT(lom_scene, camera), .table = &camera_table },
    { "light", LOM_KEY_TABLE, AT(lom_scene, light), .table = &light_table },
    { "haze", LOM_KEY_TABLE, AT(lom_scene, haze), .table = &haze_table },
    { "sky", LOM_KEY_TABLE, AT(lom_scene, sky), .table = &lom_sky_keys },
    { "terrain", LOM_KEY_TABLE, AT(lom_scene, terrain), .table = &terrain_table },
    { "water", LOM_KEY_TABLE, AT(lom_scene, water), .table = &lom_water_keys },
    { "surf", LOM_KEY_TABLE, AT(lom_scene, surf), .table = &lom_water_surf_keys },
    { "shallow", LOM_KEY_TABLE, AT(lom_scene, shallow), .table = &lom_shallow_keys },
    { "entity", LOM_KEY_TABLES, AT(lom_scene, entities), .table = &entity_table,
      .length_offset = AT(lom_scene, entity_count), .text = "Meshes in the scene." },
    { "clouds", LOM_KEY_TABLE, AT(lom_scene, clouds), .table = &lom_clouds_keys },
    { "cloud", LOM_KEY_TABLES, AT(lom_scene, cloud), .table = &lom_cloud_keys,
      .length_offset = AT(lom_scene, cloud_count), .text = "Clouds in the scene." },
    { "spray", LOM_KEY_TABLES, AT(lom_scene, sprays), .table = &lom_spray_keys,
      .length_offset = AT(lom_scene, spray_count), .text = "Drops of spray and of waterfalls." },
    { "quality", LOM_KEY_TABLE, AT(lom_scene, quality), .table = &quality_table },
};
const lom_key_table lom_scene_keys = { sizeof(lom_scene), root, COUNT(root), "The scene as a whole." };
