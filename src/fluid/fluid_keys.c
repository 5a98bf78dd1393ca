/* The tables of the scene file's [[fluid]] keys. In: nothing. Out: names, ranges, defaults and documentation of
 * lom_fluid_params, its blocks and its solids. */
#include "fluid/fluid_keys.h"

#include <lom/fluid.h>

#define COUNT(keys) (int)(sizeof(keys) / sizeof *(keys))

#define AT(member) offsetof(lom_fluid_body, member)

#define SHAPE                                                                                                          \
    { "shape", LOM_KEY_CHOICE, AT(shape), .choices = { "box", "ellipsoid" },                                           \
      .text = "A box, or the ellipsoid that touches its sides from within." },                                         \
        { "low",                                                                                                       \
          LOM_KEY_NUMBER,                                                                                              \
          AT(low),                                                                                                     \
          3,                                                                                                           \
          .flags = LOM_KEY_REQUIRED,                                                                                   \
          .minimum = -1e6,                                                                                             \
          .maximum = 1e6,                                                                                              \
          .unit = "m",                                                                                                 \
          .text = "Its corner of low x, y and z; what lies outside of the basin is not there." },                      \
    {                                                                                                                  \
        "high", LOM_KEY_NUMBER, AT(high), 3, .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6, .unit = "m",  \
                                             .text = "The opposite corner."                                            \
    }

static bool check_corners(const double low[3], const double high[3], const lom_key_check *check)
{
    for (int i = 0; i < 3; i++)
        if (!(low[i] < high[i]))
            return check->fail(check, "high", "each number of \"high\" is above that of \"low\".");
    return true;
}

static bool check_body(void *members, const lom_key_check *check)
{
    const lom_fluid_body *it = members;
    return check_corners(it->low, it->high, check);
}

static const lom_key block[] = {
    SHAPE,
    { "velocity", LOM_KEY_NUMBER, AT(velocity), 3, .minimum = -1000, .maximum = 1000, .unit = "m/s",
      .text = "With which it begins." },
    { "temperature", LOM_KEY_NUMBER, AT(temperature), .minimum = -1e6, .maximum = 1e6, .initial = { 20 },
      .unit = "degrees of heat", .text = "At the beginning." },
};
static const lom_key_table block_table = { .size = sizeof(lom_fluid_body),
                                           .keys = block,
                                           .key_count = COUNT(block),
                                           .text = "Liquid at the beginning; where two overlap the first one counts.",
                                           .check = check_body };

static const lom_key solid[] = {
    SHAPE,
    { "heats", LOM_KEY_BOOL, AT(heats), .text = "It passes heat to the liquid, or takes it; else it keeps heat off." },
    { "temperature", LOM_KEY_NUMBER, AT(temperature), .minimum = -1e6, .maximum = 1e6, .initial = { 20 },
      .unit = "degrees of heat", .text = "Of a solid that heats, always." },
};
static const lom_key_table solid_table = { .size = sizeof(lom_fluid_body),
                                           .keys = solid,
                                           .key_count = COUNT(solid),
                                           .text = "An obstacle, which is not drawn: an entity in its place is.",
                                           .check = check_body };

#undef AT
#define AT(member) offsetof(lom_fluid_params, member)
static const lom_key keys[] = {
    { "name", LOM_KEY_STRING, AT(name), .text = "A name of its own, for overrides and messages." },
    { "visible", LOM_KEY_BOOL, AT(visible), .initial = { 1 }, .text = "Whether it is drawn." },
    { "low", LOM_KEY_NUMBER, AT(low), 3, .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6, .unit = "m",
      .text = "The basin's corner of low x, y and z. It is closed on all sides, and is not drawn." },
    { "high", LOM_KEY_NUMBER, AT(high), 3, .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6, .unit = "m",
      .text =
          "The opposite corner; moved to whole cells of two spacings, of which there are at most 512 along an axis." },
    { "spacing", LOM_KEY_NUMBER, AT(spacing), .minimum = 1e-4, .maximum = 1000, .initial = { 0.05 }, .unit = "m",
      .text = "Between particles, of which all together are at most 1000000." },
    { "start", LOM_KEY_NUMBER, AT(start), .minimum = -1e6, .maximum = 1e6, .unit = "s",
      .text = "Until then the blocks stand still." },
    { "step", LOM_KEY_NUMBER, AT(step), .minimum = 1e-5, .maximum = 0.1, .initial = { 1.0 / 120 }, .unit = "s",
      .text = "Of the computation, from `start` on, whatever frames are asked for. Nothing may go farther in it than "
              "some spacings." },
    { "gravity", LOM_KEY_NUMBER, AT(gravity), 3, .minimum = -1000, .maximum = 1000, .initial = { 0, -9.80665, 0 },
      .unit = "m/s^2", .text = "What pulls at it." },
    { "viscosity", LOM_KEY_NUMBER, AT(viscosity), .maximum = 1e4, .unit = "m^2/s",
      .text = "Water 0.000001, oil 0.0001, honey 0.01; 0: none, and walls do not hold it." },
    { "solid_viscosity", LOM_KEY_NUMBER, AT(solid_viscosity), .maximum = 1e4, .unit = "m^2/s",
      .text = "Below `melting`, where it is stiff (100 stands for seconds); 0: `viscosity` everywhere." },
    { "melting", LOM_KEY_NUMBER, AT(melting), 2, .flags = LOM_KEY_SPREAD, .minimum = -1e6, .maximum = 1e6,
      .unit = "degrees of heat", .text = "Temperatures between which one viscosity goes over into the other." },
    { "latent_heat", LOM_KEY_NUMBER, AT(latent_heat), .maximum = 1e6, .unit = "degrees of heat",
      .text =
          "Heat that melting takes, in degrees by which it would warm the liquid: water 80, wax 70, iron 550. Until "
          "it has been taken in the temperature stays within `melting`." },
    { "conductivity", LOM_KEY_NUMBER, AT(conductivity), .maximum = 10, .unit = "m^2/s",
      .text = "How fast temperatures even out: water 0.00000014, copper 0.0001; more melts sooner. 0: they stay." },
    { "block", LOM_KEY_TABLES, AT(blocks), .table = &block_table, .length_offset = AT(block_count),
      .text = "Liquid at the beginning." },
    { "solid", LOM_KEY_TABLES, AT(solids), .table = &solid_table, .length_offset = AT(solid_count),
      .text = "Obstacles." },
    { "ground", LOM_KEY_BOOL, AT(ground), .initial = { 1 },
      .text = "The terrain is a floor of the basin where it reaches into it; else it is only seen." },
    { "index", LOM_KEY_NUMBER, AT(index), .minimum = 1, .maximum = 4, .initial = { 1.333 },
      .text = "Of refraction: how much it bends light and mirrors." },
    { "absorption", LOM_KEY_NUMBER, AT(absorption), 3, .flags = LOM_KEY_SPREAD, .maximum = 1e5,
      .initial = { 1.6, 0.35, 0.2 }, .unit = "1/m",
      .text =
          "Of red, green and blue: e^-1 of the light is left after a metre over it. Much of it hides what is behind." },
    { "color", LOM_KEY_COLOR, AT(color), 3, .maximum = 1, .initial = { 0.01, 0.05, 0.07 },
      .text = "What its own matter sends back of the light where it is too deep for any to come through." },
    { "highlight", LOM_KEY_NUMBER, AT(highlight), .maximum = 100, .initial = { 2 },
      .text = "The sun's and lamps' picture on it, in parts of their light." },
    { "shininess", LOM_KEY_NUMBER, AT(shininess), .maximum = 1e5, .initial = { 400 },
      .text = "Exponent of that picture; larger is smaller." },
};

static bool check_fluid(void *members, const lom_key_check *check)
{
    const lom_fluid_params *it = members;
    if (it->melting[1] < it->melting[0])
        return check->fail(check, "melting", "it begins at the lower one of its temperatures.");
    if (it->block_count == 0)
        return check->fail(check, "block", "a liquid has at least one block.");
    if (it->block_count > LOM_FLUID_BODIES)
        return check->fail(check, "block", "there are at most 64 blocks.");
    if (it->solid_count > LOM_FLUID_BODIES)
        return check->fail(check, "solid", "there are at most 64 solids.");
    return check_corners(it->low, it->high, check);
}

const lom_key_table lom_fluid_keys = {
    .size = sizeof(lom_fluid_params),
    .keys = keys,
    .key_count = COUNT(keys),
    .text =
        "A volume of liquid that moves freely: a dam that breaks, a splash, wax that melts. A frame needs all the "
        "steps "
        "before it; where its basin is out of view it has none. It is drawn after the waters and before clouds, with "
        "the scene behind it bent and absorbed; water mirrors it and shows what of it lies below. Its shadows "
        "(`quality.entity_shadows`, lamps with `shadow`) are as deep as `absorption` makes them. docs/fluid.md says "
        "how.",
    .check = check_fluid
};
