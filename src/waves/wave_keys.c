/* The tables of the keys of waves: [water.waves], [surf], [water.foam], [[wake]]. In: nothing. Out: names, ranges, defaults
 * and documentation of the members of lom_water_waves, lom_water_surf, lom_water_foam and lom_water_wake. */
#include "waves/wave_keys.h"

#include "waves/sea_desc.h"

#include <lom/waves.h>

#define COUNT(keys) (sizeof(keys) / sizeof *(keys))

#define AT(member) offsetof(lom_water_waves, member)
static const lom_key waves[] = {
    { "kind", LOM_KEY_CHOICE, AT(kind), .choices = { "none", "gerstner", "sea", "flow" },
      .text = "Still water; a handful of trochoidal waves; a sea of thousands of waves, summed by Fourier transforms; "
              "or a flowing river." },
    { "direction", LOM_KEY_ANGLE, AT(direction), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Where the waves travel to: 0 is +x, 90 is +z." },
    { "seed", LOM_KEY_INTEGER, AT(seed), .minimum = 0, .maximum = 1e9, .initial = { 1 },
      .text = "Another seed gives other waves of the same kind." },
    { "height", LOM_KEY_NUMBER, AT(height), .maximum = 100, .initial = { 0.5 }, .unit = "m",
      .text = "Gerstner: significant height, four standard deviations of the surface." },
    { "length",
      LOM_KEY_NUMBER,
      AT(length),
      2,
      LOM_KEY_ABOVE,
      0,
      1e5,
      { 20, 1 },
      "m",
      .text = "Gerstner: lengths of the longest and the shortest wave." },
    { "count", LOM_KEY_INTEGER, AT(count), .minimum = 1, .maximum = LOM_MAX_WAVES, .initial = { 16 },
      .text = "Gerstner: how many waves." },
    { "steepness", LOM_KEY_NUMBER, AT(steepness), .maximum = 1, .initial = { 0.6 },
      .text = "Gerstner: 0 are sines; 1 lets the waves together just reach a cusp, where all crests meet. They never "
              "loop." },
    { "spread", LOM_KEY_ANGLE, AT(spread), .maximum = 180, .initial = { 25 }, .unit = "degrees",
      .text = "Gerstner: standard deviation of the directions." },
    { "spectrum", LOM_KEY_CHOICE, AT(spectrum), .choices = { "jonswap", "pierson_moskowitz", "phillips" },
      .text = "Sea: how the heights are shared among the lengths." },
    { "wind_level", LOM_KEY_STRING, AT(wind_level),
      .text = "Sea: name of the wind, from \"calm\" and \"light-air\" to \"gale\", \"storm\" and \"hurricane\"." },
    { "wind_speed", LOM_KEY_NUMBER, AT(wind_speed), .maximum = 100, .initial = { 8 }, .unit = "m/s",
      .text = "Sea: at a height of 10 m, where no `wind_level` is given; less than 0.1 is a calm." },
    { "fetch", LOM_KEY_NUMBER, AT(fetch), .minimum = 1, .maximum = 1e8, .initial = { 100000 }, .unit = "m",
      .text = "Sea: how much open water lies before the wind." },
    { "depth", LOM_KEY_NUMBER, AT(depth), .maximum = 1e6, .unit = "m",
      .text = "Sea: depth that slows the waves; 0 is deep water." },
    { "height_scale", LOM_KEY_NUMBER, AT(height_scale), .maximum = 100, .initial = { 1 },
      .text = "Sea: factor on the heights; 1 is the physical one." },
    { "choppiness", LOM_KEY_NUMBER, AT(choppiness), .maximum = 4, .initial = { 1 },
      .text = "Sea: factor on the horizontal displacement, which sharpens crests; 1 is the physical one." },
    { "cascades", LOM_KEY_INTEGER, AT(cascades), .minimum = 1, .maximum = 4, .initial = { 3 },
      .text = "Sea: patches of different size whose sum is the surface." },
    { "size", LOM_KEY_INTEGER, AT(size), .minimum = 16, .maximum = 1024, .initial = { 256 },
      .text = "Sea: samples a side of a patch, a power of two." },
    { "speed", LOM_KEY_NUMBER, AT(speed), .maximum = 100, .initial = { 0.6 }, .unit = "m/s",
      .text =
          "Flow: mean speed of the river. It enters the terrain where `direction` comes from; how it runs between its "
          "shores follows from the terrain below the level. Its ripples are those of `water.normal_map`." },
    { "cell", LOM_KEY_NUMBER, AT(cell), .minimum = 1, .maximum = 256, .initial = { 5 }, .unit = "pixels",
      .text = "Displaced: distance between the vertices of the mesh on the screen.",
      .dial = &(const lom_key_dial){ .approximates = "the surface of the water at each pixel",
                                     .settings = "16 10 5 2.5 1.25",
                                     .needs = "water water.enabled quality.water=displaced" } },
    { "patch", LOM_KEY_NUMBER, AT(patch), .maximum = 1e6, .unit = "m", .initial_text = "six of the longest waves",
      .text = "Sea: side of the largest patch." },
};
/* A sea has to be one that can be made: what no key's range says is where its description fails. */
static bool check_waves(void *members, const lom_key_check *check)
{
    const lom_water_waves *it = members;
    if (it->length[0] < it->length[1])
        return check->fail(check, "length", "the longest wave comes first, then the shortest.");
    if (it->kind != LOM_WAVES_SEA)
        return true;
    lom_error error = { 0 };
    lom_sea_desc desc = lom_scene_sea(it), resolved;
    if (it->wind_level != NULL && lom_find_wind_level(it->wind_level, &error) == NULL)
        return check->fail(check, "wind_level", error.text);
    if ((it->size & (it->size - 1)) != 0)
        return check->fail(check, "size", "the samples a side of a patch are a power of two.");
    return lom_resolve_sea(&desc, &resolved, &error) || check->fail(check, "patch", error.text);
}

const lom_key_table lom_water_waves_keys = { .size = sizeof(lom_water_waves),
                                             .keys = waves,
                                             .key_count = COUNT(waves),
                                             .text = "The waves of every model but `tinted` and `planar`.",
                                             .check = check_waves };

#undef AT
#define AT(member) offsetof(lom_water_surf, member)
static const lom_key surf[] = {
    { "height", LOM_KEY_NUMBER, AT(height), .maximum = 30, .unit = "m",
      .text = "Height from trough to crest where the waves reach the terrain; 0: there are none." },
    { "period", LOM_KEY_NUMBER, AT(period), .minimum = 1, .maximum = 30, .initial = { 8 }, .unit = "s",
      .text = "From crest to crest." },
    { "direction", LOM_KEY_ANGLE, AT(direction), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Where they travel to, far from the shore: 0 is +x, 90 is +z." },
    { "variation", LOM_KEY_NUMBER, AT(variation), .maximum = 0.9, .initial = { 0.3 },
      .text = "How much higher and lower than the mean crests are, in groups and along each of them." },
    { "breaking", LOM_KEY_CHOICE, AT(breaking), .choices = { "spilling", "plunging", "auto" },
      .text =
          "How they break: foam runs down the front; the crest is thrown ahead as a jet, falls, and the wave goes on "
          "as "
          "a bore; or each way by the slope of the bed there, plunging at Iribarren numbers of 0.5 to 3.3. Jets are "
          "drawn by `displaced` and `reference`." },
    { "plunging", LOM_KEY_NUMBER, AT(plunging), .maximum = 1, .initial = { 1 },
      .text = "Where waves plunge: how far they do; 0 is spilling." },
};
const lom_key_table lom_water_surf_keys = {
    .size = sizeof(lom_water_surf),
    .keys = surf,
    .key_count = COUNT(surf),
    .text = "Waves of `[water]` that come in from the open water to the terrain's shore, over the "
            "other waves: they rise, turn and break over the bed."
};

#undef AT
#define AT(member) offsetof(lom_water_foam, member)
static const lom_key foam[] = {
    { "amount", LOM_KEY_NUMBER, AT(amount), .maximum = 4, .text = "0 is none; 1 covers what breaks.", .untraced = "0" },
    { "threshold", LOM_KEY_NUMBER, AT(threshold), .maximum = 2, .initial = { 0.6 },
      .text = "A wave breaks where the Jacobian of its displacement, 1 at rest, is below this." },
    { "window", LOM_KEY_NUMBER, AT(window), .flags = LOM_KEY_ABOVE, .maximum = 60, .initial = { 3 }, .unit = "s",
      .text = "How long foam lasts." },
    { "carried", LOM_KEY_BOOL, AT(carried),
      .text =
          "Foam goes with the water that it lies on: surf moves it to and fro, and shallow water carries it from where "
          "it broke, fading by 1/e in `window`; bodies that move leave it behind them; a river has it below rapids." },
    { "shore_depth", LOM_KEY_NUMBER, AT(shore_depth), .maximum = 100, .unit = "m",
      .text = "Depth of water that the shore's foam reaches to; 0 is none.", .untraced = "0" },
    { "tile", LOM_KEY_NUMBER, AT(tile), .flags = LOM_KEY_ABOVE, .maximum = 1e4, .initial = { 6 }, .unit = "m",
      .text = "Length that one repetition of its pattern covers." },
};
const lom_key_table lom_water_foam_keys = { .size = sizeof(lom_water_foam),
                                            .keys = foam,
                                            .key_count = COUNT(foam),
                                            .text = "Foam on breaking waves and at the shore." };

#undef AT
#define AT(member) offsetof(lom_water_wake, member)
static const lom_key wake[] = {
    { "entity", LOM_KEY_STRING, AT(entity), .flags = LOM_KEY_REQUIRED,
      .text = "Name of the entity that leaves it, as it moves." },
    { "heading", LOM_KEY_ANGLE, AT(heading), .minimum = -360, .maximum = 360, .initial = { -90 }, .unit = "degrees",
      .text = "Where its bow is, in the entity's own axes: 0 is +x, 90 is +z, -90 its -z." },
    { "half", LOM_KEY_NUMBER, AT(half), 2, .flags = LOM_KEY_SPREAD, .minimum = 1e-6, .maximum = 1e4,
      .initial = { 1, 1 }, .unit = "m", .text = "Half axes of its waterline, along and across." },
};
const lom_key_table lom_water_wake_keys = {
    .size = sizeof(lom_water_wake),
    .keys = wake,
    .key_count = COUNT(wake),
    .text =
        "Foam that a body leaves behind it on the first water, wherever it goes: it lies where the body was, spreads, "
        "and fades in `water.foam.window`; with `water.foam.carried` its pattern is drawn out as it spreads. "
        "`water.foam.amount` is how much of it there is."
};
