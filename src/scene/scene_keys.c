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
    { "samples", LOM_KEY_INTEGER, AT(lom_output, samples), .minimum = 1, .maximum = LOM_MAX_SAMPLES, .initial = { 1 },
      .text =
          "Places of a pixel at which coverage and depth are tested: 1, 2, 4, 8 or 16. With more than one, edges are "
          "smooth: the pixel is the mean of its samples in linear light (docs/samples.md)." },
    { "sample_shading", LOM_KEY_BOOL, AT(lom_output, sample_shading),
      .text = "Shade each sample instead of each surface that a pixel shows: textures and glints are smoothed too, at "
              "so many "
              "times the work." },
    { "exposure", LOM_KEY_NUMBER, AT(lom_output, exposure), .minimum = -10, .maximum = 10, .unit = "stops",
      .text = "The light is multiplied by 2 to this power, before the curve; in `rgb32f` too (docs/exposure.md)." },
    { "curve", LOM_KEY_CHOICE, AT(lom_output, curve), .choices = { "clamp", "reinhard", "filmic", "aces" },
      .text =
          "How light becomes the light of the picture, between 0 and 1. `clamp` cuts off at 1, and leaves `rgb32f` as "
          "it is. The others bend towards white, of Reinhard 2002, Hable 2010 and a fit of ACES by Narkowicz 2016." },
    { "white", LOM_KEY_NUMBER, AT(lom_output, white), .minimum = 1, .maximum = 1e6, .initial = { 8 },
      .text = "The least light, after exposure, that `reinhard` and `filmic` show as white." },
};

static bool check_output(void *members, const lom_key_check *check)
{
    const int samples = ((const lom_output *)members)->samples;
    return (samples & (samples - 1)) == 0 || check->fail(check, "samples", "a pixel has 1, 2, 4, 8 or 16 samples.");
}

static const lom_key_table output_table = { .size = sizeof(lom_output),
                                            .keys = output,
                                            .key_count = COUNT(output),
                                            .check = check_output,
                                            .text = "The picture or the frames of the animation." };

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
    { "base", LOM_KEY_NUMBER, AT(lom_haze, base), .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Height (y) above which the air gets thinner." },
    { "height", LOM_KEY_NUMBER, AT(lom_haze, height), .maximum = 1e6, .unit = "m",
      .text = "Height over which it falls to 1/e; 0: the same everywhere." },
    { "glow", LOM_KEY_COLOR, AT(lom_haze, glow), 3, .maximum = 1000,
      .text = "What is added to the colour in the direction of the sun." },
    { "glow_exponent", LOM_KEY_NUMBER, AT(lom_haze, glow_exponent), .flags = LOM_KEY_ABOVE, .maximum = 1000,
      .initial = { 8 }, .text = "Exponent on the cosine between the path and the sun; larger is narrower." },
};
static const lom_key_table haze_table = {
    .size = sizeof(lom_haze),
    .keys = haze,
    .key_count = COUNT(haze),
    .text = "Air between the camera and what it sees. Without this table it is clear."
};

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
static const lom_key_table reference_table = { .size = sizeof(lom_reference_quality),
                                               .keys = reference,
                                               .key_count = COUNT(reference),
                                               .text = "How exact the reference is." };

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
    { "reflection", LOM_KEY_CHOICE, AT(lom_quality, reflection), .choices = { "phong", "blinn_phong", "toon" },
      .text = "What ground and entities make of light: Lambert's cosine with the highlight of Phong, from the mirrored "
              "light, or of Blinn, from the vector halfway to the eye; or a few tones (docs/lighting.md)." },
    { "toon_thresholds", LOM_KEY_NUMBER, AT(lom_quality, toon_thresholds), 3, .maximum = 1,
      .initial = { 0.1, 0.45, 0.8 },
      .text = "Cosines between normal and light from which `toon` gives each of its tones; below the first there is "
              "none." },
    { "toon_tones", LOM_KEY_NUMBER, AT(lom_quality, toon_tones), 3, .maximum = 1000, .initial = { 0.3, 0.65, 1 },
      .text = "The tones, in parts of the light." },
    { "texture_filter", LOM_KEY_CHOICE, AT(lom_quality, texture_filter),
      .choices = { "trilinear", "bilinear", "nearest" }, .text = "How textures are sampled." },
    { "anisotropy", LOM_KEY_INTEGER, AT(lom_quality, anisotropy), .minimum = 1, .maximum = 16, .initial = { 1 },
      .unit = "probes",
      .text =
          "How many samples along the longer side of its footprint a pixel of ground and entities takes at most, so "
          "that pictures stay sharp on what is seen at a slant (docs/textures.md). 1: one, at the level of the "
          "longer side." },
    { "filtering", LOM_KEY_CHOICE, AT(lom_quality, filtering), .choices = { "float", "fixed" },
      .initial = { LOM_FILTERING_FIXED },
      .text = "Arithmetic in which 8-bit textures are filtered: 24 bits, or 15 (docs/filtering.md). What is compared "
              "with a reference is drawn in float." },
    { "march", LOM_KEY_CHOICE, AT(lom_quality, march), .choices = { "float", "fixed" },
      .text = "The same of the densities and the light of clouds." },
    { "mipmaps", LOM_KEY_BOOL, AT(lom_quality, mipmaps), .initial = { 1 },
      .text = "Smaller versions of textures for distant surfaces. Off: the finest level alone." },
    { "reflection_scale", LOM_KEY_NUMBER, AT(lom_quality, reflection_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 1 }, .text = "Size of the reflection's picture, in parts of the output's, along each axis." },
    { "refraction_scale", LOM_KEY_NUMBER, AT(lom_quality, refraction_scale), .flags = LOM_KEY_ABOVE, .maximum = 1,
      .initial = { 1 }, .text = "The same of the refraction's picture." },
    { "lamp_tiles", LOM_KEY_BOOL, AT(lom_quality, lamp_tiles), .initial = { 1 },
      .text =
          "Look at each lamp only on the squares of ground that its light reaches. Changes time alone: off gives the "
          "same bytes." },
    { "scissor", LOM_KEY_BOOL, AT(lom_quality, scissor), .initial = { 1 },
      .text = "Draw these pictures only where the water can look them up, begin with what the frame shows of them, and "
              "leave out of the frame what waves cover. Changes time alone: off gives the same bytes." },
    { "reference", LOM_KEY_TABLE, AT(lom_quality, reference), .table = &reference_table },
    { "terrain_error", LOM_KEY_NUMBER, AT(lom_quality, terrain_error), .maximum = 1000, .initial = { 1 },
      .unit = "pixels",
      .text = "How far the surface of terrain may be off on the screen where it is drawn with fewer triangles. 0 draws "
              "every pixel of the height map everywhere." },
    { "terrain_composite", LOM_KEY_NUMBER, AT(lom_quality, terrain_composite), .maximum = 64, .unit = "pixels",
      .text = "Colours distant terrain from one picture of all its layers, seen from above, four texels a quad of the "
              "height map: where a texel of it covers at most so many pixels. 0: the layers are sampled everywhere." },
    { "tessellation", LOM_KEY_BOOL, AT(lom_quality, tessellation),
      .text =
          "Terrain is cut by tessellation, each edge as finely as `terrain_error` asks for, instead of block by block "
          "(docs/stages.md): the surface changes without jumps while the camera moves." },
    { "terrain_shadows", LOM_KEY_BOOL, AT(lom_quality, terrain_shadows),
      .text = "Terrain keeps the sun off terrain, entities and water that lie behind it." },
    { "entity_shadows", LOM_KEY_INTEGER, AT(lom_quality, entity_shadows), .minimum = 0, .maximum = 8192,
      .unit = "texels",
      .text =
          "Entities keep the sun off terrain and entities: a side of each of two maps, one of the entities near the "
          "eye. 0: they do not." },
    { "normals", LOM_KEY_NUMBER, AT(lom_quality, normals), .maximum = 1000, .unit = "metres",
      .text = "Length of lines that show the normals of entities' vertices. 0: none are drawn." },
    { "ambient_occlusion", LOM_KEY_BOOL, AT(lom_quality, ambient_occlusion),
      .text = "Ambient light on terrain only from the part of the sky that the terrain around leaves free." },
    { "wireframe", LOM_KEY_CHOICE, AT(lom_quality, wireframe), .choices = { "off", "visible", "all" },
      .text =
          "Edges of the triangles of terrain and entities as lines over what the camera sees of them, under water and "
          "clouds: none; those that no surface hides; all. Mirrored pictures and the reference have none." },
    { "wireframe_color", LOM_KEY_COLOR, AT(lom_quality, wireframe_color), 3, .maximum = 1000,
      .initial = { 0.9, 0.25, 0.05 }, .text = "Colour of these lines, whatever the light." },
};
static bool check_quality(void *members, const lom_key_check *check)
{
    const lom_quality *q = members;
    const double *t = q->toon_thresholds;
    if (q->tessellation && q->wireframe != LOM_WIREFRAME_OFF)
        return check->fail(check, "wireframe",
                           "edges are drawn of terrain in blocks, not of what tessellation cuts: "
                           "either wireframe or tessellation.");
    return (t[0] <= t[1] && t[1] <= t[2]) ||
           check->fail(check, "toon_thresholds", "the thresholds of tones rise from the first to the last.");
}

static const lom_key_table quality_table = { .size = sizeof(lom_quality),
                                             .keys = quality,
                                             .key_count = COUNT(quality),
                                             .check = check_quality,
                                             .text = "The dials that trade accuracy for time." };

static const lom_key root[] = {
    { "title", LOM_KEY_STRING, AT(lom_scene, title), .text = "What the scene shows, for people." },
    { "output", LOM_KEY_TABLE, AT(lom_scene, output), .table = &output_table },
    { "camera", LOM_KEY_TABLE, AT(lom_scene, camera), .table = &lom_camera_keys },
    { "view", LOM_KEY_TABLES, AT(lom_scene, views), .table = &lom_view_keys, .length_offset = AT(lom_scene, view_count),
      .text = "Other looks at the scene in the same picture." },
    { "light", LOM_KEY_TABLE, AT(lom_scene, light), .table = &lom_light_keys },
    { "lamp", LOM_KEY_TABLES, AT(lom_scene, lamps), .table = &lom_lamp_keys, .length_offset = AT(lom_scene, lamp_count),
      .text = "Lights beside the sun." },
    { "haze", LOM_KEY_TABLE, AT(lom_scene, haze), .table = &haze_table },
    { "sky", LOM_KEY_TABLE, AT(lom_scene, sky), .table = &lom_sky_keys },
    { "terrain", LOM_KEY_TABLE, AT(lom_scene, terrain), .table = &lom_terrain_keys },
    { "water", LOM_KEY_TABLE, AT(lom_scene, water), .table = &lom_water_keys },
    { "surf", LOM_KEY_TABLE, AT(lom_scene, surf), .table = &lom_water_surf_keys },
    { "shallow", LOM_KEY_TABLE, AT(lom_scene, shallow), .table = &lom_shallow_keys },
    { "entity", LOM_KEY_TABLES, AT(lom_scene, entities), .table = &lom_entity_keys,
      .length_offset = AT(lom_scene, entity_count), .text = "Meshes in the scene." },
    { "clouds", LOM_KEY_TABLE, AT(lom_scene, clouds), .table = &lom_clouds_keys },
    { "cloud", LOM_KEY_TABLES, AT(lom_scene, cloud), .table = &lom_cloud_keys,
      .length_offset = AT(lom_scene, cloud_count), .text = "Clouds in the scene." },
    { "spray", LOM_KEY_TABLES, AT(lom_scene, sprays), .table = &lom_spray_keys,
      .length_offset = AT(lom_scene, spray_count), .text = "Drops of spray and of waterfalls." },
    { "quality", LOM_KEY_TABLE, AT(lom_scene, quality), .table = &quality_table },
};
const lom_key_table lom_scene_keys = {
    .size = sizeof(lom_scene), .keys = root, .key_count = COUNT(root), .text = "The scene as a whole."
};
