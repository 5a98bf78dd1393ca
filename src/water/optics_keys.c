/* The tables of the keys inside [water]: optics, foam. In: nothing. Out: names, ranges, defaults and documentation of
 * the members of lom_water_optics and lom_water_foam. */
#include "water/water_keys.h"

#include <lom/water.h>

#include <string.h>

#define COUNT(keys) (sizeof(keys) / sizeof *(keys))

#define AT(member) offsetof(lom_water_optics, member)
static const lom_key optics[] = {
    { "index", LOM_KEY_NUMBER, AT(index), .minimum = 1, .maximum = 3, .initial = { 1.333 },
      .text = "Index of refraction against air; sea water has 1.34." },
    { "fresnel", LOM_KEY_CHOICE, AT(fresnel), .choices = { "exact", "schlick", "dot" },
      .text = "Reflectance: Fresnel's equations; Schlick's approximation; or 1 - e.n, the mix of the reference works.",
      .dial = &(const lom_key_dial){ .approximates = "the share of light that water mirrors, by Fresnel's equations",
                                     .settings = "dot schlick exact",
                                     .needs = "water water.enabled quality.water=normal_map|displaced|marched" } },
    { "type", LOM_KEY_CHOICE, AT(type), .choices = { "pure", "I", "IA", "IB", "II", "III", "1C", "3C", "5C", "7C" },
      .initial = { LOM_WATER_II },
      .text = "Jerlov's name of the water: I is the clearest ocean, 1C to 7C are coasts." },
    { "absorption", LOM_KEY_NUMBER, AT(absorption), 3, .maximum = 1000, .unit = "1/m", .initial_text = "of the type",
      .text = "Light that a metre of water takes of red, green and blue: e^-absorption is left." },
    { "scatter", LOM_KEY_COLOR, AT(scatter), 3, .maximum = 1, .initial_text = "of the type",
      .text = "What bottomless water sends back, in parts of what a white surface would." },
    { "roughness", LOM_KEY_NUMBER, AT(roughness), .maximum = 1, .initial = { 0.0005 },
      .text = "Mean square slope of the ripples that the waves do not contain; Cox and Munk: 0.003 + 0.00512 a m/s of "
              "wind is all of it." },
    { "glitter", LOM_KEY_NUMBER, AT(glitter), .maximum = 100, .initial = { 1 },
      .text = "Factor on the sun's reflection." },
    { "reach", LOM_KEY_NUMBER, AT(reach), .maximum = 1, .initial = { 0.5 },
      .text =
          "How far from its pixel a bent or mirrored ray may look, in parts of the picture. What lies further is sky "
          "above and bottomless water below. An eye under water looks over all of it." },
    { "steps", LOM_KEY_INTEGER, AT(steps), .minimum = 4, .maximum = 256, .initial = { 24 },
      .text = "Of a ray against the scene's depth.",
      .dial = &(const lom_key_dial){ .approximates = "where a bent or mirrored ray meets the scene",
                                     .settings = "6 12 24 48 96",
                                     .needs = "water water.enabled quality.water=normal_map|displaced|marched" } },
    { "caustics", LOM_KEY_NUMBER, AT(caustics), .maximum = 4,
      .text = "The light that the waves focus on the bed: 0 is none, 1 as much as they do.", .untraced = "0" },
    { "caustics_size", LOM_KEY_NUMBER, AT(caustics_size), .flags = LOM_KEY_ABOVE, .maximum = 1e4, .initial = { 40 },
      .unit = "m", .text = "Side of the square of water, in front of the eye, whose caustics are computed." },
    { "caustics_texels", LOM_KEY_INTEGER, AT(caustics_texels), .minimum = 16, .maximum = 2048, .initial = { 512 },
      .text = "Texels a side of it.",
      .dial = &(const lom_key_dial){ .approximates = "the light that waves focus on the bed",
                                     .settings = "128 256 512 1024 2048",
                                     .needs = "water water.enabled water.optics.caustics "
                                              "quality.water=normal_map|displaced|marched",
                                     .reference = LOM_DIAL_FINEST } },
    { "opacity", LOM_KEY_NUMBER, AT(opacity), .maximum = 1, .initial = { 0.75 },
      .text = "Of the tinted quad; its colour is `tint_color`." },
};
/* What the file leaves to the type of water. */
static bool check_optics(void *members, const lom_key_check *check)
{
    lom_water_optics *it = members;
    double absorption[3], scatter[3];
    lom_water_type_optics((lom_water_type)it->type, absorption, scatter);
    if (!check->is_given(check, "absorption"))
        memcpy(it->absorption, absorption, sizeof absorption);
    if (!check->is_given(check, "scatter"))
        memcpy(it->scatter, scatter, sizeof scatter);
    return true;
}

const lom_key_table lom_water_optics_keys = { .size = sizeof(lom_water_optics),
                                              .keys = optics,
                                              .key_count = COUNT(optics),
                                              .text = "What the water does to light.",
                                              .check = check_optics };
