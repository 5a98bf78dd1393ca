/* The table of the scene file's [light] keys and its check. In: the members as the file gives them. Out: the direction
 * of the light, of unit length, and what its keys take from it. */
#include "scene/direction.h"
#include "scene/scene_keys.h"

#include <lom/scene.h>

#include <string.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static bool check_keys(const lom_light *light, const lom_key_check *check)
{
    for (size_t i = 0; i < light->key_count; i++) {
        const lom_key_check at = check->element(check, "key", i);
        lom_light_key *key = &light->keys[i];
        if (!at.is_given(&at, "azimuth"))
            key->azimuth = light->azimuth;
        if (!at.is_given(&at, "elevation"))
            key->elevation = light->elevation;
        if (!at.is_given(&at, "color"))
            memcpy(key->color, light->color, sizeof key->color);
        if (!at.is_given(&at, "intensity"))
            key->intensity = light->intensity;
        if (i > 0 && !lom_check_rising_time(&at, light->keys[i - 1].time, key->time))
            return false;
    }
    return true;
}

static bool check_light(void *members, const lom_key_check *check)
{
    lom_light *light = members;
    bool stands = check->is_given(check, "azimuth") || check->is_given(check, "elevation");
    if (!check->is_given(check, "ground"))
        memcpy(light->ground, light->ambient, sizeof light->ground);
    if (!check->is_given(check, "direction"))
        light->direction = lom_sunlight_direction(light->azimuth, light->elevation);
    else if (stands)
        return check->fail(check, "direction", "the light has either a direction or azimuth and elevation, not both.");
    if (!lom_make_unit(&light->direction))
        return check->fail(check, "direction", "the light's direction must not be zero.");
    return check_keys(light, check);
}

static const lom_key light_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_light_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e9, .maximum = 1e9,
      .unit = "s", .text = "When the sun is here; later than the key before." },
    { "azimuth", LOM_KEY_ANGLE, AT(lom_light_key, azimuth), .minimum = -36000, .maximum = 36000, .unit = "degrees",
      .text = "Where it stands.", .initial_text = "the light's" },
    { "elevation", LOM_KEY_ANGLE, AT(lom_light_key, elevation), .minimum = -90, .maximum = 90, .unit = "degrees",
      .text = "Its height above the horizon.", .initial_text = "the light's" },
    { "color", LOM_KEY_COLOR, AT(lom_light_key, color), 3, .maximum = 1000, .text = "Colour of the light.",
      .initial_text = "the light's" },
    { "intensity", LOM_KEY_NUMBER, AT(lom_light_key, intensity), .maximum = 1e6, .text = "Factor on the colour.",
      .initial_text = "the light's" },
};
static const lom_key_table light_key_table = { .size = sizeof(lom_light_key),
                                               .keys = light_key,
                                               .key_count = COUNT(light_key),
                                               .text = "A key frame of the sun's path, with straight lines between." };

static const lom_key light[] = {
    { "direction", LOM_KEY_NUMBER, AT(lom_light, direction), 3,
      .text = "The way the light travels, from the sun towards the scene, of any length; instead of `azimuth` and "
              "`elevation`.",
      .initial_text = "from `azimuth` and `elevation`" },
    { "azimuth", LOM_KEY_ANGLE, AT(lom_light, azimuth), .minimum = -360, .maximum = 360, .initial = { 135 },
      .unit = "degrees", .text = "Where the sun stands: 0 is north (-z), 90 is east (+x)." },
    { "elevation", LOM_KEY_ANGLE, AT(lom_light, elevation), .minimum = -90, .maximum = 90, .initial = { 45 },
      .unit = "degrees", .text = "Height of the sun above the horizon." },
    { "color", LOM_KEY_COLOR, AT(lom_light, color), 3, .maximum = 1000, .initial = { 1, 1, 1 },
      .text = "Colour of the light." },
    { "intensity", LOM_KEY_NUMBER, AT(lom_light, intensity), .maximum = 1e6, .initial = { 1 },
      .text = "Factor on the colour." },
    { "ambient", LOM_KEY_COLOR, AT(lom_light, ambient), 3, .maximum = 1000, .initial = { 0.15, 0.15, 0.15 },
      .text = "Light from everywhere; not multiplied by the intensity. With `ground`, the light on what faces up." },
    { "ground", LOM_KEY_COLOR, AT(lom_light, ground), 3, .maximum = 1000, .initial_text = "as `ambient`",
      .text = "Light on what faces down; in between the two are mixed by the cosine between the normal and up." },
    { "key", LOM_KEY_TABLES, AT(lom_light, keys), .table = &light_key_table, .length_offset = AT(lom_light, key_count),
      .text = "Key frames of a sun that moves." },
};
const lom_key_table lom_light_keys = { .size = sizeof(lom_light),
                                       .keys = light,
                                       .key_count = COUNT(light),
                                       .text = "The one directional light of the scene, the sun.",
                                       .check = check_light };
