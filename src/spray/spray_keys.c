/* The table of the scene file's [[spray]] keys. In: nothing. Out: names, ranges, defaults and documentation of every
 * member of lom_spray. */
#include "spray/spray_keys.h"

#include <lom/particles.h>

#include <string.h>

enum { LONGEST_BOUNCE = 60 }; /* s: every frame steps a drop from its birth on */

#define AT(member) offsetof(lom_spray, member)

static const lom_key keys[] = {
    { "name", LOM_KEY_STRING, AT(name), .text = "A name of its own, for overrides and messages." },
    { "visible", LOM_KEY_BOOL, AT(visible), .initial = { 1 }, .text = "Whether it is drawn." },
    { "source", LOM_KEY_CHOICE, AT(source), .choices = { "segment", "surf", "river", "entity" },
      .text =
          "Where drops begin: on the segment; where and when waves of `[surf]` meet steep ground, or where the river "
          "of `[water.waves]` is faster than its waves, in the rectangle that the segment spans; where and when "
          "the water meets an entity (docs/water.md). Without such waves there are no drops." },
    { "entity", LOM_KEY_STRING, AT(entity),
      .text =
          "With `source = \"entity\"`: name of what stands or floats in the first water, in surf, trochoids, a sea or "
          "a river, or goes through still water." },
    { "kick", LOM_KEY_NUMBER, AT(kick), .maximum = 100, .initial = { 1 },
      .text = "Surf, river, entity: speed of the fastest drops, in parts of what the water has there; `velocity` is "
              "added." },
    { "seed", LOM_KEY_INTEGER, AT(seed), .maximum = 1e9, .initial = { 1 },
      .text = "Another seed gives other drops of the same kind." },
    { "count", LOM_KEY_INTEGER, AT(count), .maximum = LOM_MAX_PARTICLES, .initial = { 1000 },
      .text = "How many drops live at every time; all emitters together have at most 1000000." },
    { "from", LOM_KEY_NUMBER, AT(from), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "One end of the segment on which drops begin: the lip of a fall. An entity needs none." },
    { "to", LOM_KEY_NUMBER, AT(to), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m", .text = "The other end.",
      .initial_text = "`from`" },
    { "velocity", LOM_KEY_NUMBER, AT(velocity), 3, .minimum = -1000, .maximum = 1000, .unit = "m/s",
      .text = "Mean velocity at the start." },
    { "spread", LOM_KEY_NUMBER, AT(spread), .maximum = 100, .unit = "m/s",
      .text = "Standard deviation of each horizontal component of it." },
    { "spread_up", LOM_KEY_NUMBER, AT(spread_up), .maximum = 100, .unit = "m/s",
      .text = "Standard deviation of the upward component." },
    { "wind", LOM_KEY_NUMBER, AT(wind), 3, .minimum = -1000, .maximum = 1000, .unit = "m/s",
      .text = "Velocity of the air that drops take on by `drag`." },
    { "drag", LOM_KEY_NUMBER, AT(drag), .maximum = 1000, .unit = "1/s",
      .text = "Rate at which a drop takes on the velocity of the air: 9.8 over the speed at which it falls in the end. "
              "About 1 for drops of 2 mm, 30 for mist." },
    { "jets", LOM_KEY_INTEGER, AT(jets), .maximum = LOM_MAX_PARTICLES,
      .text = "How many places of the segment let drops out at a time, as strands of a fall. 0: all of it." },
    { "jet_time", LOM_KEY_NUMBER, AT(jet_time), .minimum = 0.001, .maximum = 3600, .initial = { 0.3 }, .unit = "s",
      .text = "How long a jet lasts before it begins at another place; with `source = \"surf\"` for how long after a "
              "wave's "
              "front drops begin." },
    { "jet_width", LOM_KEY_NUMBER, AT(jet_width), .maximum = 1000, .initial = { 0.3 }, .unit = "m",
      .text = "Width of a jet in its middle; it tapers to its ends." },
    { "life", LOM_KEY_NUMBER, AT(life), .minimum = 0.001, .maximum = 3600, .initial = { 2 }, .unit = "s",
      .text = "How long a drop lives. The end of one life is the start of the next." },
    { "height", LOM_KEY_NUMBER, AT(height), .maximum = 1e5, .unit = "m",
      .text = "Instead of `life`: the height through which drops fall from rest in it." },
    { "bounce", LOM_KEY_NUMBER, AT(bounce), .maximum = 1,
      .text = "Share of the speed into the ground that a drop comes back with: from the terrain, without one from the "
              "height "
              "0. 0: drops fall through it. Such drops are stepped from their birth in every frame (docs/stages.md)." },
    { "size",
      LOM_KEY_NUMBER,
      AT(size),
      2,
      LOM_KEY_SPREAD | LOM_KEY_ABOVE,
      0,
      1000,
      { 0.1, 0.1 },
      "m",
      .text = "Radius at the start and at the end of a life." },
    { "stretch", LOM_KEY_NUMBER, AT(stretch), .maximum = 10, .unit = "s",
      .text = "Seconds of its way that a drop is drawn along; its opacity is spread over them." },
    { "color", LOM_KEY_COLOR, AT(color), 3, .maximum = 1, .initial = { 1, 1, 1 },
      .text = "Share of the light that it sends on." },
    { "opacity", LOM_KEY_NUMBER, AT(opacity), .maximum = 1, .initial = { 0.3 },
      .text = "Of the middle of a drop; it falls to 0 at the radius." },
    { "soft", LOM_KEY_NUMBER, AT(soft), .flags = LOM_KEY_ABOVE, .maximum = 1000, .initial = { 0.3 }, .unit = "m",
      .text = "Length over which a drop fades before what stands behind it, and before the camera's near plane." },
    { "forward", LOM_KEY_NUMBER, AT(forward), .maximum = 10, .initial = { 0.3 },
      .text = "Share of the sun's light that is thrown forward: how much spray glows before the sun." },
};

static bool check_spray(void *members, const lom_key_check *check)
{
    lom_spray *spray = members;
    const bool of_entity = spray->source == LOM_SPRAY_ENTITY;
    if (of_entity != (spray->entity != NULL))
        return check->fail(check, of_entity ? "source" : "entity",
                           of_entity ? "spray of an entity names one by `entity`."
                                     : "only spray of `source = \"entity\"` names one.");
    if (!of_entity && !check->is_given(check, "from"))
        return check->fail(check, "", "the key \"from\" is missing in this table.");
    if (!check->is_given(check, "to"))
        memcpy(spray->to, spray->from, sizeof spray->to);
    if (spray->source != LOM_SPRAY_SEGMENT && spray->bounce != 0)
        return check->fail(check, "bounce", "drops that bounce begin on a segment.");
    if (!check->is_given(check, "height"))
        return spray->bounce == 0 || spray->life <= LONGEST_BOUNCE ||
               check->fail(check, "bounce", "drops that bounce live at most 60 s, and these live longer.");
    if (check->is_given(check, "life"))
        return check->fail(check, "height", "spray has either a life or a height, not both.");
    spray->life = lom_fall_time(spray->height, spray->drag);
    if (spray->bounce != 0)
        return check->fail(check, "bounce", "drops that bounce have a life, not a height.");
    return (spray->life >= 0.001 && spray->life <= 3600) ||
           check->fail(check, "height", "a fall through this height must take from 0.001 to 3600 s.");
}

const lom_key_table lom_spray_keys = { .size = sizeof(lom_spray),
                                       .keys = keys,
                                       .key_count = sizeof keys / sizeof *keys,
                                       .text =
                                           "Drops of spray or of a waterfall, drawn after the water and the clouds. "
                                           "docs/water.md says how.",
                                       .check = check_spray };
