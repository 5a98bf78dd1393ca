/* The table of the scene file's [quality.impostor] keys. In: nothing. Out: names, ranges, defaults and documentation of
 * every member of lom_impostor_dials. */
#include "cloud_keys.h"

#include <lom/cloud.h>

#define AT(member) offsetof(lom_impostor_dials, member)

static const lom_key keys[] = {
    { "bound", LOM_KEY_NUMBER, AT(bound), .flags = LOM_KEY_ABOVE, .maximum = 100, .initial = { 1 }, .unit = "pixels",
      .text = "Bounded rule: a plate is made anew when a corner of the cloud's box would be shown this far from its "
              "place, or a texel has grown by as much." },
    { "scale", LOM_KEY_NUMBER, AT(scale), .flags = LOM_KEY_ABOVE, .maximum = 4, .initial = { 1 },
      .text = "Bounded rule: texels of a plate a pixel of the frame, along each axis." },
    { "inside_scale", LOM_KEY_NUMBER, AT(inside_scale), .flags = LOM_KEY_ABOVE, .maximum = 1, .initial = { 0.5 },
      .text = "The same for a cloud around or close to the camera, which is marched in every frame over the whole "
              "picture." },
    { "sun", LOM_KEY_ANGLE, AT(sun), .minimum = 0, .maximum = 180, .initial = { 1 }, .unit = "degrees",
      .text = "How far the sun may move before a plate is made anew (the reference work's: 2.865, 0.05 radians)." },
    { "largest", LOM_KEY_INTEGER, AT(largest), .minimum = 16, .maximum = 4096, .initial = { 1024 }, .unit = "texels",
      .text = "Bounded rule: longest edge of a plate." },
    { "largest_reference", LOM_KEY_INTEGER, AT(largest_reference), .minimum = 1, .maximum = 4096, .initial = { 64 },
      .unit = "texels", .text = "Reference rule: longest edge of a plate." },
    { "smallest", LOM_KEY_INTEGER, AT(smallest), .minimum = 0, .maximum = 4096, .initial = { 8 }, .unit = "texels",
      .text = "Reference rule: a cloud whose plate would have this edge or less is not drawn." },
    { "two_pass", LOM_KEY_BOOL, AT(two_pass), .initial = { 1 },
      .text =
          "Plates coarser than the frame are first drawn into one of twice their size, with linear filtering: edges "
          "are soft, and texels do not show." },
    { "misting", LOM_KEY_BOOL, AT(misting),
      .text = "The reference work's alpha misting: nearer than twice their longest side clouds fade, to 0.8 of their "
              "opacity." },
    { "culling", LOM_KEY_BOOL, AT(culling), .initial = { 1 },
      .text = "Clouds outside the view cost nothing. Off is for measuring." },
    { "lod", LOM_KEY_BOOL, AT(lod), .initial = { 1 },
      .text = "The size of a plate follows the cloud's size in the picture. Off, for measuring: the largest always." },
};
const lom_key_table lom_impostor_keys = { .size = sizeof(lom_impostor_dials),
                                          .keys = keys,
                                          .key_count = sizeof keys / sizeof *keys,
                                          .text =
                                              "How long and how finely `quality.impostors` keeps pictures of clouds." };
