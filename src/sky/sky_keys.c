/* The table of the scene file's [sky] keys. In: nothing. Out: names, ranges, defaults and documentation of every member
 * of lom_sky_params. */
#include "sky_keys.h"

#include <lom/sky.h>

#define AT(member) offsetof(lom_sky_params, member)

static const lom_key keys[] = {
    { "pattern", LOM_KEY_STRING, AT(pattern),
      .text = "File names of the six pictures of a sky box with one `%s`, for which `right` (+x), `left` (-x), `top` "
              "(+y), `bottom` (-y), `front` (+z) and `back` (-z) are put in turn." },
    { "faces", LOM_KEY_FILE, AT(faces), 6,
      .text = "The same six pictures, each by its own name, in that order; instead of `pattern`." },
    { "rotation", LOM_KEY_ANGLE, AT(rotation), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Turns the box about the y axis, counter-clockwise seen from above." },
    { "intensity", LOM_KEY_NUMBER, AT(intensity), .maximum = 1e6, .initial = { 1 },
      .text = "Factor on the pictures, or on `color`." },
    { "color", LOM_KEY_COLOR, AT(color), 3, .maximum = 1000, .initial = { 0.25, 0.45, 0.8 },
      .text = "The whole sky's colour when there are no pictures." },
};

const lom_key_table lom_sky_keys = { sizeof(lom_sky_params), keys, sizeof keys / sizeof *keys,
                                     "What is behind everything: a box of six pictures, or one colour." };
