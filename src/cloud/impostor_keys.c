/* The table of the scene file's [quality.impostor] keys. In: nothing. Out: names, ranges, defaults and documentation of
 * every member of lom_impostor_dials. */
#include "cloud_keys.h"

#include <lom/cloud.h>

#define AT(member) offsetof(lom_impostor_dials, member)

static const lom_key keys[] = {
    { "bound", LOM_KEY_NUMBER, AT(bound), .flags = LOM_KEY_ABOVE, .maximum = 100, .initial = { 1 }, .unit = "pixels",
      .text = "Bounded rule: a plate is made anew when a corner of the cloud's box would be shown this far from its "
              "place, or a texel has grown by as much.",
      .dial = &(const lom_key_dial){ .approximates = "the cloud as it is seen from where the camera is now",
                                     .settings = "8 4 2 1 0.5 0.25",
                                     .needs = "cloud quality.impostors=bounded" } },
    { "scale", LOM_KEY_NUMBER, AT(scale), .flags = LOM_KEY_ABOVE, .maximum = 4, .initial = { 1 },
      .text = "Bounded rule: texels of a plate a pixel of the frame, along each axis.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud's picture, finer than the frame",
                                     .settings = "0.25 0.5 1 2",
                                     .needs = "cloud quality.impostors=bounded" } },
    { "inside_scale", LOM_KEY_NUMBER, AT(inside_scale), .flags = LOM_KEY_ABOVE, .maximum = 1, .initial = { 0.5 },
      .text = "The same for a cloud around or close to the camera, which is marched in every frame over the whole "
              "picture.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud around the camera, marched at each pixel",
                                     .settings = "0.25 0.5 1",
                                     .needs = "cloud quality.impostors=bounded" } },
    { "sun", LOM_KEY_ANGLE, AT(sun), .minimum = 0, .maximum = 180, .initial = { 1 }, .unit = "degrees",
      .text = "How far the sun may move before a plate is made anew (the reference work's: 2.865, 0.05 radians).",
      .dial = &(const lom_key_dial){ .approximates = "light that follows the sun in each frame",
                                     .settings = "10 3 1 0.3 0",
                                     .needs = "cloud quality.impostors=reference|bounded" } },
    { "largest", LOM_KEY_INTEGER, AT(largest), .minimum = 16, .maximum = 4096, .initial = { 1024 }, .unit = "texels",
      .text = "Bounded rule: longest edge of a plate.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud's picture, finer than the frame",
                                     .settings = "128 256 512 1024 2048",
                                     .needs = "cloud quality.impostors=bounded" } },
    { "largest_reference", LOM_KEY_INTEGER, AT(largest_reference), .minimum = 1, .maximum = 4096, .initial = { 64 },
      .unit = "texels", .text = "Reference rule: longest edge of a plate.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud's picture, finer than the frame",
                                     .settings = "32 64 128 256 512",
                                     .needs = "cloud quality.impostors=reference" } },
    { "smallest", LOM_KEY_INTEGER, AT(smallest), .minimum = 0, .maximum = 4096, .initial = { 8 }, .unit = "texels",
      .text = "Reference rule: a cloud whose plate would have this edge or less is not drawn.",
      .dial = &(const lom_key_dial){ .approximates = "clouds that are small in the picture",
                                     .settings = "32 16 8 4 0",
                                     .needs = "cloud quality.impostors=reference" } },
    { "two_pass", LOM_KEY_BOOL, AT(two_pass), .initial = { 1 },
      .text =
          "Plates coarser than the frame are first drawn into one of twice their size, with linear filtering: edges "
          "are soft, and texels do not show.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud's picture, finer than the frame",
                                     .settings = "false true",
                                     .needs = "cloud quality.impostors=reference|bounded" } },
    { "misting", LOM_KEY_BOOL, AT(misting),
      .text = "The reference work's alpha misting: nearer than twice their longest side clouds fade, to 0.8 of their "
              "opacity.",
      .dial = &(const lom_key_dial){ .none = "a look: the reference work's" } },
    { "culling", LOM_KEY_BOOL, AT(culling), .initial = { 1 },
      .text = "Clouds outside the view cost nothing. Off is for measuring.",
      .dial = &(const lom_key_dial){ .approximates = "clouds outside of the view do not show",
                                     .settings = "true false",
                                     .needs = "cloud quality.impostors=reference|bounded",
                                     .reference = LOM_DIAL_EQUAL } },
    { "lod", LOM_KEY_BOOL, AT(lod), .initial = { 1 },
      .text = "The size of a plate follows the cloud's size in the picture. Off, for measuring: the largest always.",
      .dial = &(const lom_key_dial){ .approximates = "a cloud's picture, finer than the frame",
                                     .settings = "true false",
                                     .needs = "cloud quality.impostors=reference|bounded" } },
};
const lom_key_table lom_impostor_keys = { .size = sizeof(lom_impostor_dials),
                                          .keys = keys,
                                          .key_count = sizeof keys / sizeof *keys,
                                          .text =
                                              "How long and how finely `quality.impostors` keeps pictures of clouds." };
