/* The table of the scene file's [water] keys. In: nothing. Out: names, ranges, defaults and documentation of every
 * member of lom_water_params. Where the published method names no value, the default is ours and its text says why. */
#include "water/water_keys.h"

#include "waves/wave_keys.h"

#include <lom/water.h>

#define AT(member) offsetof(lom_water_params, member)

static const lom_key keys[] = {
    { "name", LOM_KEY_STRING, AT(name), .text = "What `lom plan` calls it, and `--set`, where there are several." },
    { "enabled", LOM_KEY_BOOL, AT(enabled), .initial = { 1 }, .text = "Whether the water is drawn at all." },
    { "level", LOM_KEY_NUMBER, AT(level), .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Height (y) of the surface." },
    { "position", LOM_KEY_NUMBER, AT(position), 2, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .initial_text = "the terrain's, else 0",
      .text = "x and z of the middle of the quad; waves, ripples and foam move with it." },
    { "size",
      LOM_KEY_NUMBER,
      AT(size),
      2,
      LOM_KEY_SPREAD | LOM_KEY_ABOVE,
      0,
      1e6,
      { 100, 100 },
      "m",
      .text = "Extent of the quad along x and z.",
      .initial_text = "the terrain's size, else 100" },

    { "reflection", LOM_KEY_BOOL, AT(reflection), .initial = { 1 },
      .text = "Step 1: render the scene mirrored in the surface and show it. Off: `color` is reflected." },
    { "refraction", LOM_KEY_BOOL, AT(refraction), .initial = { 1 },
      .text =
          "Step 2: render what lies below the surface, with its depth, and show it. Off: `color` shines through, and "
          "`soft_shore` has no depth to work with." },
    { "projection", LOM_KEY_BOOL, AT(projection), .initial = { 1 },
      .text = "Step 3: look the two pictures up where the fragment stands on the screen (clip position divided by w). "
              "Off: they are stretched over the quad, which shows why the step is needed." },
    { "flow", LOM_KEY_BOOL, AT(flow), .initial = { 1 },
      .text = "Step 4: the flow map displaces the lookups and moves with time. Off: a still mirror." },
    { "normals", LOM_KEY_BOOL, AT(normals), .initial = { 1 },
      .text = "Step 5: the normal map perturbs the normal. Off: the normal is straight up." },
    { "fresnel", LOM_KEY_BOOL, AT(fresnel), .initial = { 1 },
      .text = "Step 6: mix reflection and refraction by the angle of view. Off: half of each." },
    { "specular", LOM_KEY_BOOL, AT(specular), .initial = { 1 },
      .text = "Step 7: add the Phong highlight of the light on the perturbed normal." },
    { "tint", LOM_KEY_BOOL, AT(tint), .initial = { 1 }, .text = "Step 8: mix `tint_color` into every fragment." },
    { "soft_shore", LOM_KEY_BOOL, AT(soft_shore), .initial = { 1 },
      .text = "Step 9: fade the water out where it is shallow." },

    { "normal_map", LOM_KEY_FILE, AT(normal_map),
      .text = "Picture of normals (RGB = 2n - 1, blue up); repeats without a seam. Without it the water is flat and "
              "nothing flows." },
    { "flow_map", LOM_KEY_FILE, AT(flow_map), .initial_text = "made from `normal_map`",
      .text = "Picture whose red and green displace the lookups; black moves nothing. Without it: smoothstep(0.2, 0.8, "
              "1 - n) of each channel of the normal map." },
    { "tile", LOM_KEY_NUMBER, AT(tile), .flags = LOM_KEY_ABOVE, .maximum = 1e6, .initial = { 20 }, .unit = "m",
      .text = "Length that one repetition of the two maps covers: the size of the waves." },
    { "flow_strength", LOM_KEY_NUMBER, AT(flow_strength), .maximum = 1, .initial = { 0.02 },
      .text = "Largest displacement of a lookup, in parts of the picture. Ours: a fiftieth ripples the reflection "
              "without tearing it." },
    { "flow_speed", LOM_KEY_NUMBER, AT(flow_speed), .minimum = -100, .maximum = 100, .initial = { 0.03 }, .unit = "1/s",
      .text = "How many repetitions of the maps pass in a second." },
    { "normal_up", LOM_KEY_NUMBER, AT(normal_up), .flags = LOM_KEY_ABOVE, .maximum = 1000, .initial = { 3 },
      .text = "Factor on the upward part of the normal before it is normalised; larger is calmer. 3 is the published "
              "value." },
    { "reflectivity", LOM_KEY_NUMBER, AT(reflectivity), .maximum = 1, .initial = { 1 },
      .text = "Share of the reflection at grazing angles." },
    { "fresnel_power", LOM_KEY_NUMBER, AT(fresnel_power), .flags = LOM_KEY_ABOVE, .maximum = 64, .initial = { 1 },
      .text = "Exponent on the cosine between the view and the normal, the refraction's share. 1 is the published "
              "mix; below 1 the water is clearer." },
    { "shininess", LOM_KEY_NUMBER, AT(shininess), .flags = LOM_KEY_ABOVE, .maximum = 10000, .initial = { 40 },
      .text = "Phong exponent of the highlight. Unpublished; ours." },
    { "specular_strength", LOM_KEY_NUMBER, AT(specular_strength), .maximum = 100, .initial = { 0.6 },
      .text = "Factor on the highlight. Unpublished; ours." },
    { "color", LOM_KEY_COLOR, AT(color), 3, .maximum = 1000, .initial = { 0.02, 0.08, 0.12 },
      .text = "What stands in for the picture of a step that is off." },
    { "tint_color", LOM_KEY_COLOR, AT(tint_color), 3, .maximum = 1000, .initial = { 0, 0.1, 0.2 },
      .text = "The blue of the tint. Unpublished; ours." },
    { "tint_amount", LOM_KEY_NUMBER, AT(tint_amount), .maximum = 1, .initial = { 0.2 },
      .text = "Share of the tint in the colour. Unpublished; ours." },
    { "shore_depth", LOM_KEY_NUMBER, AT(shore_depth), .flags = LOM_KEY_ABOVE, .maximum = 1e5, .initial = { 1 },
      .unit = "m", .text = "Depth of water from which it is fully there." },
    { "clip_offset", LOM_KEY_NUMBER, AT(clip_offset), .maximum = 1000, .initial = { 0 }, .unit = "m",
      .text = "How far the two clip planes reach over the surface, so that displaced lookups find no gap at the shore. "
              "The published method has none." },

    { "waves", LOM_KEY_TABLE, AT(waves), .table = &lom_water_waves_keys },
    { "optics", LOM_KEY_TABLE, AT(optics), .table = &lom_water_optics_keys },
    { "foam", LOM_KEY_TABLE, AT(foam), .table = &lom_water_foam_keys },
};

const lom_key_table lom_water_keys = {
    .size = sizeof(lom_water_params),
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .text =
        "Water at a level; without this table there is none. `quality.water` chooses its model. `planar` is a lake on "
        "a "
        "plain quad, in nine steps that can each be switched off, and reads all of these keys. Richer models read "
        "the tables inside this one, and of these keys `enabled`, `level`, `position`, `size` and `clip_offset`; those "
        "of the normal and the flow map, too, where the water has no waves, whose ripples they then are. `tinted` "
        "reads `tint_color`. With `[[water]]` there are several, up to 8, each with its own level, extent, waves and "
        "look; `[surf]` and `[shallow]` are the first one's, and the eye is under one of them or none (docs/water.md)."
};
