/* The tables of the scene file's [shallow] keys. In: nothing. Out: names, ranges, defaults and documentation of
 * lom_shallow_water, its springs and its bodies. */
#include "base/numbers.h"
#include "waves/wave_keys.h"

#include <lom/shallow.h>
#include <lom/waves.h>

#define COUNT(keys) (int)(sizeof(keys) / sizeof *(keys))

#define AT(member) offsetof(lom_shallow_spring, member)
static const lom_key spring[] = {
    { "position", LOM_KEY_NUMBER, AT(position), 2, .flags = LOM_KEY_REQUIRED, .minimum = -4e8, .maximum = 4e8,
      .unit = "m", .text = "x and z of its middle." },
    { "radius", LOM_KEY_NUMBER, AT(radius), .maximum = 1e6, .initial = { 1 }, .unit = "m",
      .text = "It comes up evenly in a disc." },
    { "rate", LOM_KEY_NUMBER, AT(rate), .flags = LOM_KEY_REQUIRED, .minimum = -1e6, .maximum = 1e6, .unit = "m^3/s",
      .text = "How much; below 0 it is a drain, which takes what there is." },
};
static const lom_key_table spring_table = { .size = sizeof(lom_shallow_spring),
                                            .keys = spring,
                                            .key_count = COUNT(spring),
                                            .text = "Where water comes up or runs out." };

#undef AT
#define AT(member) offsetof(lom_shallow_body, member)
static const lom_key body[] = {
    { "entity", LOM_KEY_STRING, AT(entity), .text = "Name of an entity that it goes with, instead of `position`." },
    { "position", LOM_KEY_NUMBER, AT(position), 2, .minimum = -4e8, .maximum = 4e8, .unit = "m",
      .text = "x and z of its middle." },
    { "half", LOM_KEY_NUMBER, AT(half), 2, .flags = LOM_KEY_SPREAD, .minimum = 1e-6, .maximum = 1e4,
      .initial = { 1, 1 }, .unit = "m", .text = "Its half axes, along and across `heading`." },
    { "heading", LOM_KEY_ANGLE, AT(heading), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Where it points: 0 is +x, 90 is +z. With `entity` these are the entity's own axes, and without a "
              "heading it points along its -z." },
    { "draft", LOM_KEY_NUMBER, AT(draft), .maximum = 1000, .initial = { 0.3 }, .unit = "m",
      .text = "How much of the water's depth it takes in its middle." },
    { "time", LOM_KEY_NUMBER, AT(time), .minimum = -1e9, .maximum = 1e9, .unit = "s",
      .text = "With `duration`: when it begins to dip in." },
    { "duration", LOM_KEY_NUMBER, AT(duration), .maximum = 1e6, .unit = "s",
      .text = "How long it is in the water, in and out again, which makes a ring of waves; 0: always." },
    { "every", LOM_KEY_NUMBER, AT(every), .maximum = 1e6, .unit = "s",
      .text = "With `duration`: after which time it dips in again; 0: once." },
};
static bool check_body(void *members, const lom_key_check *check)
{
    lom_shallow_body *it = members;
    if (it->entity == NULL && !check->is_given(check, "position"))
        return check->fail(check, "entity", "a body needs a position or an entity.");
    if (it->entity != NULL && !check->is_given(check, "heading"))
        it->heading = -lom_pi / 2;
    return !(it->every > 0) || (it->duration > 0 && it->duration <= it->every) ||
           check->fail(check, "every", "it dips in again after its duration, which is above 0.");
}

static const lom_key_table body_table = { .size = sizeof(lom_shallow_body),
                                          .keys = body,
                                          .key_count = COUNT(body),
                                          .text = "Something in the water that pushes it aside.",
                                          .check = check_body };

#undef AT
#define AT(member) offsetof(lom_shallow_water, member)
static const lom_key keys[] = {
    { "position", LOM_KEY_NUMBER, AT(position), 2, .minimum = -4e8, .maximum = 4e8, .unit = "m",
      .initial_text = "the water's", .text = "x and z of the middle of the region that is computed." },
    { "size", LOM_KEY_NUMBER, AT(size), 2, .flags = LOM_KEY_ABOVE | LOM_KEY_SPREAD, .maximum = 1e6, .unit = "m",
      .initial_text = "the water's", .text = "Its extent along x and z." },
    { "cells", LOM_KEY_INTEGER, AT(cells), .minimum = 8, .maximum = 1024, .initial = { 160 },
      .text = "Cells along its longer side." },
    { "start", LOM_KEY_NUMBER, AT(start), .minimum = -1e9, .maximum = 1e9, .unit = "s",
      .text = "When it stands still at `water.level`; all that happens to it happens later." },
    { "step", LOM_KEY_NUMBER, AT(step), .minimum = 0.0005, .maximum = 1, .initial = { 1.0 / 60 }, .unit = "s",
      .text = "Of the computation, from `start` on, whatever frames are asked for." },
    { "friction", LOM_KEY_NUMBER, AT(friction), .maximum = 10, .initial = { 0.01 },
      .text = "Of the bed: 0.003 for sand, 0.03 for stones." },
    { "implicitness", LOM_KEY_NUMBER, AT(implicitness), .minimum = 0.5, .maximum = 1, .initial = { 0.52 },
      .text = "0.5 lets waves keep their energy; more damps them, the short ones first." },
    { "edge", LOM_KEY_CHOICE, AT(edge), .choices = { "wall", "fall", "open" },
      .text = "The region's borders: they reflect; water that comes to them is gone; or beyond them lies water of "
              "`water.level`, and waves fade out before them." },
    { "spring", LOM_KEY_TABLES, AT(springs), .table = &spring_table, .length_offset = AT(spring_count),
      .text = "Where water comes up or runs out." },
    { "body", LOM_KEY_TABLES, AT(bodies), .table = &body_table, .length_offset = AT(body_count),
      .text = "What pushes the water aside." },
};
static bool check_shallow(void *members, const lom_key_check *check)
{
    const lom_shallow_water *it = members;
    if (it->spring_count > LOM_SHALLOW_SOURCES)
        return check->fail(check, "spring", "there are at most 64 springs.");
    return it->body_count <= LOM_SHALLOW_OBSTACLES || check->fail(check, "body", "there are at most 64 bodies.");
}

const lom_key_table lom_shallow_keys = {
    .size = sizeof(lom_shallow_water),
    .keys = keys,
    .key_count = COUNT(keys),
    .text =
        "Shallow water: the surface of `[water]` flows over the terrain, floods and dries it. At `start` it stands at "
        "`water.level`. A frame needs all the steps before it. Of `quality.water`, `normal_map`, `displaced` and "
        "`marched` "
        "show it. docs/water.md says how.",
    .check = check_shallow
};
