/* The table of all keys of a scene file. In: the tables of the model layers. Out: names, ranges, defaults and
 * documentation of everything lom_scene holds. Invariant: reading, messages and docs/scene.md come from here alone; a
 * new table of keys is one line in `root`. */
#include "scene/scene_keys.h"

#include "cloud/cloud_keys.h"
#include "sky/sky_keys.h"
#include "fluid/fluid_keys.h"
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
          "smooth: the pixel is the mean of its samples in linear light (docs/samples.md).",
      .dial = &(const lom_key_dial){ .approximates = "the mean over a pixel's area", .settings = "1 2 4 8 16" } },
    { "sample_shading", LOM_KEY_BOOL, AT(lom_output, sample_shading),
      .text = "Shade each sample instead of each surface that a pixel shows: textures and glints are smoothed too, at "
              "so many times the work.",
      .dial = &(const lom_key_dial){ .approximates = "the mean of the light over a pixel's area, within surfaces too",
                                     .settings = "false true",
                                     .needs = "output.samples=2|4|8|16" } },
    { "edges", LOM_KEY_CHOICE, AT(lom_output, edges), .choices = { "sharp", "smooth" },
      .text = "With one sample a pixel: `smooth` mixes the pixels along the edge of what is nearer with what lies "
              "beyond it, by the part of the pixel on either side, in linear light (docs/samples.md).",
      .dial = &(const lom_key_dial){ .approximates = "the mean over a pixel's area, along edges",
                                     .settings = "sharp smooth",
                                     .needs = "output.samples=1" } },
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
    { "water", LOM_KEY_TABLE, AT(lom_scene, water), .table = &lom_water_keys,
      .others_offset = AT(lom_scene, other_waters), .length_offset = AT(lom_scene, other_water_count) },
    { "surf", LOM_KEY_TABLE, AT(lom_scene, surf), .table = &lom_water_surf_keys },
    { "shallow", LOM_KEY_TABLE, AT(lom_scene, shallow), .table = &lom_shallow_keys },
    { "wake", LOM_KEY_TABLES, AT(lom_scene, wakes), .table = &lom_water_wake_keys,
      .length_offset = AT(lom_scene, wake_count), .text = "Foam behind what moves through the water." },
    { "entity", LOM_KEY_TABLES, AT(lom_scene, entities), .table = &lom_entity_keys,
      .length_offset = AT(lom_scene, entity_count), .text = "Meshes in the scene." },
    { "clouds", LOM_KEY_TABLE, AT(lom_scene, clouds), .table = &lom_clouds_keys },
    { "cloud", LOM_KEY_TABLES, AT(lom_scene, cloud), .table = &lom_cloud_keys,
      .length_offset = AT(lom_scene, cloud_count), .text = "Clouds in the scene." },
    { "spray", LOM_KEY_TABLES, AT(lom_scene, sprays), .table = &lom_spray_keys,
      .length_offset = AT(lom_scene, spray_count), .text = "Drops of spray and of waterfalls." },
    { "fluid", LOM_KEY_TABLES, AT(lom_scene, fluids), .table = &lom_fluid_keys,
      .length_offset = AT(lom_scene, fluid_count), .text = "Volumes of liquid that move freely." },
    { "quality", LOM_KEY_TABLE, AT(lom_scene, quality), .table = &lom_quality_keys },
};
const lom_key_table lom_scene_keys = {
    .size = sizeof(lom_scene), .keys = root, .key_count = COUNT(root), .text = "The scene as a whole."
};
