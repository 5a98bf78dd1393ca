/* The tables of the scene file's [quality] keys. In: nothing. Out: names, ranges, defaults and documentation of every
 * member of lom_quality, and of each what it approximates or why it is no dial. */
#include "scene/scene_keys.h"

#include "cloud/cloud_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static const lom_key reference[] = {
    { "samples", LOM_KEY_INTEGER, AT(lom_reference_quality, samples), .minimum = 1, .maximum = 65536, .initial = { 16 },
      .text = "Rays a pixel, spread over its area; 1 is its middle.",
      .dial = &(const lom_key_dial){ .none = "how exact the reference is, not the picture" } },
    { "depth", LOM_KEY_INTEGER, AT(lom_reference_quality, depth), .minimum = 0, .maximum = 64, .initial = { 6 },
      .text = "How many times a ray may be divided or mirrored at water and liquids; after that they are not seen.",
      .dial = &(const lom_key_dial){ .none = "how exact the reference is, not the picture" } },
    { "sun", LOM_KEY_ANGLE, AT(lom_reference_quality, sun), .minimum = 0.01, .maximum = 10, .initial = { 1 },
      .unit = "degrees",
      .text = "Radius of the sun's disc as water shows it. The real one has 0.27; a larger one has the same light and "
              "less noise.",
      .dial = &(const lom_key_dial){ .none = "how exact the reference is, not the picture" } },
};
static const lom_key_table reference_table = { .size = sizeof(lom_reference_quality),
                                               .keys = reference,
                                               .key_count = COUNT(reference),
                                               .text = "How exact the reference is." };

static const lom_key quality[] = {
    { "water", LOM_KEY_CHOICE, AT(lom_quality, water),
      .choices = { "displaced", "tinted", "planar", "normal_map", "marched", "reference" },
      .text =
          "Model of the water, docs/water.md. Displaced: the waves of `[water.waves]` as a mesh. Tinted: a quad of one "
          "colour. Planar: the nine steps of `[water]`. Normal_map: the waves as normals on two triangles. Marched: "
          "met by a ray for each pixel. Reference: rays in double precision, for the whole frame; what the others are "
          "measured against.",
      .dial = &(const lom_key_dial){ .approximates = "the light that comes from the water, by rays at its waves",
                                     .settings = "tinted planar normal_map displaced marched",
                                     .needs = "water water.enabled" } },
    { "clouds", LOM_KEY_CHOICE, AT(lom_quality, clouds),
      .choices = { "octaves", "forward", "single", "original", "billboard", "off", "reference", "sprites", "groups",
                   "layers" },
      .text = "Model of the clouds: marched with octaves of multiple scattering, with multiple forward scattering, or "
              "with light that was scattered once; the reference work's; a flat picture; none; random paths in "
              "double precision, for which the whole frame is the reference's; many soft billboards, each turned at "
              "random; a group of flat pictures; a level sheet a cloud, of four pictures over one another.",
      .dial = &(const lom_key_dial){ .approximates = "light scattered in clouds, by random paths",
                                     .settings = "billboard layers groups sprites original single forward octaves",
                                     .needs = "cloud" } },
    { "cloud_error", LOM_KEY_NUMBER, AT(lom_quality, cloud_error), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 0.05 },
      .text = "Bound on the error of an optical depth, in parts of the greatest one of that length: it sets the step.",
      .dial = &(const lom_key_dial){ .approximates = "the integral along a ray through a cloud",
                                     .settings = "0.4 0.2 0.1 0.05 0.025 0.0125",
                                     .needs = "cloud quality.clouds=octaves|forward|single" } },
    { "cloud_stop", LOM_KEY_NUMBER, AT(lom_quality, cloud_stop), .maximum = 1, .initial = { 0.004 },
      .text = "A ray ends when less than this share of the light behind comes through.",
      .dial = &(const lom_key_dial){ .approximates = "the rest of a ray through a cloud, to its end",
                                     .settings = "0.1 0.03 0.01 0.004 0.001 0",
                                     .needs = "cloud quality.clouds=octaves|forward|single" } },
    { "cloud_octaves", LOM_KEY_INTEGER, AT(lom_quality, cloud_octaves), .minimum = 1, .maximum = 8, .initial = { 4 },
      .text = "Octaves of multiple scattering.",
      .dial = &(const lom_key_dial){ .approximates = "the sum of all orders of scattering",
                                     .settings = "1 2 3 4 6 8",
                                     .needs = "cloud quality.clouds=octaves" } },
    { "cloud_jitter", LOM_KEY_BOOL, AT(lom_quality, cloud_jitter), .initial = { 1 },
      .text = "Shift samples along the ray by a table of blue noise, which breaks up bands.",
      .dial = &(const lom_key_dial){ .approximates = "the mean over all places of the samples along a ray",
                                     .settings = "false true",
                                     .needs = "cloud quality.clouds=octaves|forward|single" } },
    { "cloud_light_scale", LOM_KEY_NUMBER, AT(lom_quality, cloud_light_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 0.5 }, .text = "Size of the grid of light, in parts of the density's, along each axis.",
      .dial = &(const lom_key_dial){ .approximates = "the sunlight at each place of a cloud",
                                     .settings = "0.125 0.25 0.5 1",
                                     .needs = "cloud quality.clouds=octaves|forward|single" } },
    { "spray", LOM_KEY_BOOL, AT(lom_quality, spray), .initial = { 1 }, .text = "Draw the drops of `[[spray]]`.",
      .dial = &(const lom_key_dial){ .none = "says what is shown: drops or none" }, .untraced = "false" },
    { "fluid", LOM_KEY_BOOL, AT(lom_quality, fluid), .initial = { 1 }, .text = "Draw the liquids of `[[fluid]]`.",
      .dial = &(const lom_key_dial){ .none = "says what is shown: liquids or none" }, .untraced = "false" },
    { "impostors", LOM_KEY_CHOICE, AT(lom_quality, impostors), .choices = { "off", "reference", "bounded" },
      .text =
          "Whether a cloud's picture is kept on a plate and shown again while the camera moves: never; by the "
          "reference work's rule; while its error in pixels is below a bound. In a run of frames a plate depends on "
          "the frames before; a frame alone draws every cloud afresh.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud that is marched in each frame",
                                     .settings = "reference bounded off",
                                     .needs = "cloud" } },
    { "impostor", LOM_KEY_TABLE, AT(lom_quality, impostor), .table = &lom_impostor_keys },
    { "shading", LOM_KEY_CHOICE, AT(lom_quality, shading), .choices = { "phong", "gouraud", "flat" },
      .text = "Light for each fragment, for each vertex, or for each face.",
      .dial = &(const lom_key_dial){ .approximates = "the light at each fragment",
                                     .settings = "flat gouraud phong",
                                     .needs = "terrain|entity" } },
    { "reflection", LOM_KEY_CHOICE, AT(lom_quality, reflection), .choices = { "phong", "blinn_phong", "toon" },
      .text = "What ground and entities make of light: Lambert's cosine with the highlight of Phong, from the mirrored "
              "light, or of Blinn, from the vector halfway to the eye; or a few tones (docs/lighting.md).",
      .dial = &(const lom_key_dial){ .none = "a model of surfaces, none of which is an approximation of another" } },
    { "toon_thresholds", LOM_KEY_NUMBER, AT(lom_quality, toon_thresholds), 3, .maximum = 1,
      .initial = { 0.1, 0.45, 0.8 },
      .text = "Cosines between normal and light from which `toon` gives each of its tones; below the first there is "
              "none.",
      .dial = &(const lom_key_dial){ .none = "a look" } },
    { "toon_tones", LOM_KEY_NUMBER, AT(lom_quality, toon_tones), 3, .maximum = 1000, .initial = { 0.3, 0.65, 1 },
      .text = "The tones, in parts of the light.", .dial = &(const lom_key_dial){ .none = "a look" } },
    { "texture_filter", LOM_KEY_CHOICE, AT(lom_quality, texture_filter),
      .choices = { "trilinear", "bilinear", "nearest" }, .text = "How textures are sampled.",
      .dial = &(const lom_key_dial){ .approximates = "the mean of a texture over a pixel's footprint",
                                     .settings = "nearest bilinear trilinear",
                                     .needs = "terrain|entity" } },
    { "anisotropy", LOM_KEY_INTEGER, AT(lom_quality, anisotropy), .minimum = 1, .maximum = 16, .initial = { 1 },
      .unit = "probes",
      .text =
          "How many samples along the longer side of its footprint a pixel of ground and entities takes at most, so "
          "that pictures stay sharp on what is seen at a slant (docs/textures.md). 1: one, at the level of the "
          "longer side.",
      .dial = &(const lom_key_dial){ .approximates = "the mean of a texture over a long footprint",
                                     .settings = "1 2 4 8 16",
                                     .needs = "terrain|entity" } },
    { "filtering", LOM_KEY_CHOICE, AT(lom_quality, filtering), .choices = { "float", "fixed" },
      .initial = { LOM_FILTERING_FIXED },
      .text = "Arithmetic in which 8-bit textures are filtered: 24 bits, or 15 (docs/filtering.md). What is compared "
              "with a reference is drawn in float.",
      .dial =
          &(const lom_key_dial){ .approximates = "weights of texels without rounding", .settings = "fixed float" } },
    { "march", LOM_KEY_CHOICE, AT(lom_quality, march), .choices = { "float", "fixed" },
      .text = "The same of the densities and the light of clouds.",
      .dial = &(const lom_key_dial){ .approximates = "densities and light of clouds without rounding",
                                     .settings = "fixed float",
                                     .needs = "cloud quality.clouds=octaves|forward|single" } },
    { "mipmaps", LOM_KEY_BOOL, AT(lom_quality, mipmaps), .initial = { 1 },
      .text = "Smaller versions of textures for distant surfaces. Off: the finest level alone.",
      .dial = &(const lom_key_dial){ .approximates = "the mean of a texture over a large footprint",
                                     .settings = "false true",
                                     .needs = "terrain|entity" } },
    { "reflection_scale", LOM_KEY_NUMBER, AT(lom_quality, reflection_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 1 }, .text = "Size of the reflection's picture, in parts of the output's, along each axis.",
      .dial = &(const lom_key_dial){ .approximates = "the mirror's picture at every pixel of the frame",
                                     .settings = "0.125 0.25 0.5 1",
                                     .needs = "water water.enabled water.reflection "
                                              "quality.water=planar|normal_map|displaced|marched" } },
    { "refraction_scale", LOM_KEY_NUMBER, AT(lom_quality, refraction_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 1 }, .text = "The same of the refraction's picture.",
      .dial = &(const lom_key_dial){ .approximates = "the picture of the bed at every pixel of the frame",
                                     .settings = "0.125 0.25 0.5 1",
                                     .needs = "water water.enabled water.refraction "
                                              "quality.water=planar|normal_map|displaced|marched" } },
    { "refraction_samples", LOM_KEY_INTEGER, AT(lom_quality, refraction_samples), .minimum = 1,
      .maximum = LOM_MAX_SAMPLES, .initial = { 1 },
      .text = "Samples of a pixel of the refraction's picture: 1, 2, 4, 8 or 16, at most as many as `output.samples`. "
              "The water bends its edges, so that one does (docs/samples.md).",
      .dial = &(const lom_key_dial){ .approximates = "the picture of the bed, the mean over a pixel's area",
                                     .settings = "1 2 4 8 16",
                                     .needs = "water water.enabled water.refraction output.samples=2|4|8|16 "
                                              "quality.water=planar|normal_map|displaced|marched" } },
    { "lamp_tiles", LOM_KEY_BOOL, AT(lom_quality, lamp_tiles), .initial = { 1 },
      .text =
          "Look at each lamp only on the squares of ground that its light reaches. Changes time alone: off gives the "
          "same bytes.",
      .dial = &(const lom_key_dial){ .approximates = "lamps are left out where they do not reach",
                                     .settings = "true false",
                                     .needs = "terrain lamp",
                                     .reference = LOM_DIAL_EQUAL } },
    { "scissor", LOM_KEY_BOOL, AT(lom_quality, scissor), .initial = { 1 },
      .text = "Draw these pictures only where the water can look them up, begin with what the frame shows of them, and "
              "leave out of the frame what waves cover. Changes time alone: off gives the same bytes.",
      .dial = &(const lom_key_dial){ .approximates = "what the water never looks up is not drawn",
                                     .settings = "true false",
                                     .needs = "water water.enabled",
                                     .reference = LOM_DIAL_EQUAL } },
    { "reference", LOM_KEY_TABLE, AT(lom_quality, reference), .table = &reference_table },
    { "terrain_error", LOM_KEY_NUMBER, AT(lom_quality, terrain_error), .maximum = 1000, .initial = { 1 },
      .unit = "pixels",
      .text = "How far the surface of terrain may be off on the screen where it is drawn with fewer triangles. 0 draws "
              "every pixel of the height map everywhere.",
      .dial = &(const lom_key_dial){ .approximates = "every quad of the height map",
                                     .settings = "8 4 2 1 0.5 0",
                                     .needs = "terrain" } },
    { "terrain_composite", LOM_KEY_NUMBER, AT(lom_quality, terrain_composite), .maximum = 64, .initial = { 1 },
      .unit = "pixels",
      .text = "Colours distant terrain from one picture of all its layers, seen from above, two texels a quad of the "
              "height map: where a texel of it covers at most so many pixels. 0: the layers are sampled everywhere.",
      .dial = &(const lom_key_dial){ .approximates = "the layers of the ground, each sampled where it lies",
                                     .settings = "4 2 1 0.5 0",
                                     .needs = "terrain.layer quality.mipmaps" } },
    { "tessellation", LOM_KEY_BOOL, AT(lom_quality, tessellation),
      .text =
          "Terrain is cut by tessellation, each edge as finely as `terrain_error` asks for, instead of block by block "
          "(docs/stages.md): the surface changes without jumps while the camera moves.",
      .dial = &(const lom_key_dial){ .approximates = "the terrain's surface, cut where it is coarse",
                                     .settings = "false true",
                                     .needs = "terrain" } },
    { "terrain_shadows", LOM_KEY_BOOL, AT(lom_quality, terrain_shadows),
      .text = "Terrain keeps the sun off terrain, entities, water and clouds that lie behind it.",
      .dial = &(const lom_key_dial){ .none = "says what is shown: the shadows that ground throws, or none" } },
    { "entity_shadows", LOM_KEY_INTEGER, AT(lom_quality, entity_shadows), .minimum = 0, .maximum = 8192,
      .unit = "texels",
      .text =
          "Entities keep the sun off terrain, entities, liquids and the glints and foam of water: a side of each of "
          "two maps, one of the entities near the eye; liquids have a third of their own. 0: they do not.",
      .dial = &(const lom_key_dial){ .approximates = "the edge of a shadow that an entity or a liquid throws",
                                     .settings = "256 512 1024 2048 4096 8192",
                                     .needs = "entity|fluid quality.entity_shadows" } },
    { "shadow_cascades", LOM_KEY_INTEGER, AT(lom_quality, shadow_cascades), .minimum = 1, .maximum = 4,
      .initial = { 1 }, .unit = "maps",
      .text =
          "1: the two maps of `entity_shadows`. 2 to 4: as many instead, each for a slice of the view's depth and the "
          "last for all (docs/lighting.md); of parallel rays the two maps.",
      .dial = &(const lom_key_dial){ .approximates = "the edge of a shadow that an entity throws, near and far",
                                     .settings = "1 2 3 4",
                                     .needs = "entity quality.entity_shadows" } },
    { "shadow_split", LOM_KEY_NUMBER, AT(lom_quality, shadow_split), .maximum = 1, .initial = { 0.95 },
      .text = "Where slices end: a mix of equal depths (0) and equal ratios (1).",
      .dial = &(const lom_key_dial){ .approximates = "the edge of a shadow, nearer or farther",
                                     .settings = "0 0.5 0.75 0.95 1",
                                     .needs = "entity quality.entity_shadows" } },
    { "lamp_shadows", LOM_KEY_INTEGER, AT(lom_quality, lamp_shadows), .minimum = 0, .maximum = 4096, .initial = { 512 },
      .unit = "texels",
      .text =
          "A side of each map of lamps with `shadow`: one a spot up to 60 degrees wide, up to six of any other; less "
          "than 16 counts as 16. 0: no lamp throws a shadow.",
      .dial = &(const lom_key_dial){ .approximates = "the edge of a lamp's shadow",
                                     .settings = "128 256 512 1024 2048 4096",
                                     .needs = "lamp quality.lamp_shadows" } },
    { "lamp_shadow_maps", LOM_KEY_INTEGER, AT(lom_quality, lamp_shadow_maps), .minimum = 1, .maximum = 4096,
      .initial = { 64 },
      .text = "So many of these maps a frame has at most; lamps further down the file then throw no shadow.",
      .dial = &(const lom_key_dial){ .none = "a bound on memory" } },
    { "normals", LOM_KEY_NUMBER, AT(lom_quality, normals), .maximum = 1000, .unit = "metres",
      .text = "Length of lines that show the normals of entities' vertices. 0: none are drawn.",
      .dial = &(const lom_key_dial){ .none = "lines for people to look at" }, .untraced = "0" },
    { "ambient_occlusion", LOM_KEY_BOOL, AT(lom_quality, ambient_occlusion),
      .text = "Ambient light on terrain only from the part of the sky that the terrain around leaves free.",
      .dial = &(const lom_key_dial){ .none = "says what is shown: shade by the sky that ground hides, or none" },
      .untraced = "false" },
    { "wireframe", LOM_KEY_CHOICE, AT(lom_quality, wireframe), .choices = { "off", "visible", "all" },
      .text =
          "Edges of the triangles of terrain and entities as lines over what the camera sees of them, under water and "
          "clouds: none; those that no surface hides; all. Mirrored pictures and the reference have none.",
      .dial = &(const lom_key_dial){ .none = "lines for people to look at" }, .untraced = "off" },
    { "wireframe_color", LOM_KEY_COLOR, AT(lom_quality, wireframe_color), 3, .maximum = 1000,
      .initial = { 0.9, 0.25, 0.05 }, .text = "Colour of these lines, whatever the light.",
      .dial = &(const lom_key_dial){ .none = "a look" } },
};

static bool check_quality(void *members, const lom_key_check *check)
{
    const lom_quality *q = members;
    const double *t = q->toon_thresholds;
    if ((q->refraction_samples & (q->refraction_samples - 1)) != 0)
        return check->fail(check, "refraction_samples", "a pixel has 1, 2, 4, 8 or 16 samples.");
    return (t[0] <= t[1] && t[1] <= t[2]) ||
           check->fail(check, "toon_thresholds", "the thresholds of tones rise from the first to the last.");
}

const lom_key_table lom_quality_keys = { .size = sizeof(lom_quality),
                                         .keys = quality,
                                         .key_count = COUNT(quality),
                                         .check = check_quality,
                                         .text = "The dials that trade accuracy for time." };
