/* The table of the scene file's [[lamp]] keys and its check. In: the members as the file gives them. Out: what kind of
 * lamp it is, its attenuation, what its keys take from it. Invariant: afterwards the attenuation is of use at every
 * distance, and directions have unit length. */
#include "base/numbers.h"
#include "scene/direction.h"
#include "scene/scene_keys.h"

#include <lom/scene.h>

#include <string.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

/* ---- attenuation that covers a distance ---- */

/* Linear and quadratic attenuation whose light covers a distance, the constant being 1. */
static const struct cover {
    double distance, linear, quadratic;
} covers[] = { { 7, 0.7, 1.8 },        { 13, 0.35, 0.44 },     { 20, 0.22, 0.20 },     { 32, 0.14, 0.07 },
               { 50, 0.09, 0.032 },    { 65, 0.07, 0.017 },    { 100, 0.045, 0.0075 }, { 160, 0.027, 0.0028 },
               { 200, 0.022, 0.0019 }, { 325, 0.014, 0.0007 }, { 600, 0.007, 0.0002 }, { 3250, 0.0014, 0.000007 } };

/* Between two rows both go as powers of the distance; a row's own distance has its own numbers. */
static double between(double share, double a, double b)
{
    return share == 0 ? a : share == 1 ? b : a * lom_double_pow(b / a, share);
}

static void cover_range(lom_lamp *lamp)
{
    int i = 0;
    while (i + 2 < COUNT(covers) && lamp->range > covers[i + 1].distance)
        i++;
    const struct cover *near = &covers[i], *far = &covers[i + 1];
    double share = lamp->range == near->distance ? 0
                   : lamp->range == far->distance
                       ? 1
                       : lom_double_log(lamp->range / near->distance) / lom_double_log(far->distance / near->distance);
    lamp->attenuation[0] = 1;
    lamp->attenuation[1] = between(share, near->linear, far->linear);
    lamp->attenuation[2] = between(share, near->quadratic, far->quadratic);
}

/* ---- checks ---- */

/* Nothing that tells how light falls off has a meaning for one at infinity. */
static bool check_infinite(lom_lamp *lamp, const lom_key_check *check)
{
    static const char *const near[] = { "attenuation", "range", "reach", "cutoff", "softness", "exponent" };
    for (int i = 0; i < COUNT(near); i++)
        if (check->is_given(check, near[i]))
            return check->fail(check, near[i],
                               "a lamp with a direction alone shines from infinity: it has neither a cone nor a "
                               "distance.");
    if (lamp->shadow)
        return check->fail(check, "shadow", "a lamp at infinity throws no shadow; the sun of [light] does.");
    lamp->kind = LOM_LAMP_INFINITE;
    lamp->attenuation[0] = 1;
    lamp->attenuation[1] = lamp->attenuation[2] = 0;
    return true;
}

static bool check_cone(lom_lamp *lamp, const lom_key_check *check)
{
    const double right = 90 * lom_radians_per_degree;
    if (lamp->cutoff > right && lamp->cutoff < 2 * right)
        return check->fail(check, "cutoff",
                           "a cone ends at most 90 degrees from its middle; 180 degrees is light to all sides.");
    if (lamp->softness > lamp->cutoff)
        return check->fail(check, "softness",
                           "the edge of the cone is softer than the cone is wide: it is more than "
                           "the cutoff.");
    lamp->kind = lamp->cutoff > right ? LOM_LAMP_POINT : LOM_LAMP_SPOT;
    return true;
}

static bool check_attenuation(lom_lamp *lamp, const lom_key_check *check)
{
    if (check->is_given(check, "range")) {
        if (check->is_given(check, "attenuation"))
            return check->fail(check, "range", "a lamp has either a range or its attenuation, not both.");
        cover_range(lamp);
    }
    return lamp->attenuation[0] + lamp->attenuation[1] + lamp->attenuation[2] > 0 ||
           check->fail(check, "attenuation", "the three numbers of an attenuation are not all 0.");
}

static bool check_keys(const lom_lamp *lamp, const lom_key_check *check)
{
    for (size_t i = 0; i < lamp->key_count; i++) {
        const lom_key_check at = check->element(check, "key", i);
        lom_lamp_key *key = &lamp->keys[i];
        if (!at.is_given(&at, "position"))
            key->position = lamp->position;
        if (!at.is_given(&at, "direction"))
            key->direction = lamp->direction;
        if (!at.is_given(&at, "intensity"))
            key->intensity = lamp->intensity;
        if (!lom_make_unit(&key->direction))
            return at.fail(&at, "direction", "a lamp's direction must not be zero.");
        if (i > 0 && !lom_check_rising_time(&at, lamp->keys[i - 1].time, key->time))
            return false;
    }
    return true;
}

static bool check_lamp(void *members, const lom_key_check *check)
{
    lom_lamp *lamp = members;
    const bool placed = check->is_given(check, "position");
    if (!placed && !check->is_given(check, "direction"))
        return check->fail(check, "",
                           "a lamp needs a position, or a direction alone when its light comes from infinity.");
    if (!lom_make_unit(&lamp->direction))
        return check->fail(check, "direction", "a lamp's direction must not be zero.");
    if (!check->is_given(check, "specular"))
        memcpy(lamp->specular, lamp->diffuse, sizeof lamp->specular);
    return (placed ? check_cone(lamp, check) && check_attenuation(lamp, check) : check_infinite(lamp, check)) &&
           check_keys(lamp, check);
}

/* ---- keys ---- */

static const lom_key lamp_key[] = {
    { "time", LOM_KEY_NUMBER, AT(lom_lamp_key, time), .flags = LOM_KEY_REQUIRED, .minimum = -1e9, .maximum = 1e9,
      .unit = "s", .text = "When the lamp is here; later than the key before." },
    { "position", LOM_KEY_NUMBER, AT(lom_lamp_key, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where it is.", .initial_text = "the lamp's" },
    { "direction", LOM_KEY_NUMBER, AT(lom_lamp_key, direction), 3, .text = "Where its light goes.",
      .initial_text = "the lamp's" },
    { "intensity", LOM_KEY_NUMBER, AT(lom_lamp_key, intensity), .maximum = 1e6, .text = "Factor on its colours.",
      .initial_text = "the lamp's" },
};
static const lom_key_table lamp_key_table = { .size = sizeof(lom_lamp_key),
                                              .keys = lamp_key,
                                              .key_count = COUNT(lamp_key),
                                              .text = "A key frame of a lamp that moves or changes." };

static const lom_key lamp[] = {
    { "name", LOM_KEY_STRING, AT(lom_lamp, name),
      .text = "A name of its own, for overrides, messages and `lom explain`." },
    { "position", LOM_KEY_NUMBER, AT(lom_lamp, position), 3, .minimum = -1e9, .maximum = 1e9, .unit = "m",
      .text = "Where it is. Without it the light comes from infinity, along `direction`." },
    { "direction", LOM_KEY_NUMBER, AT(lom_lamp, direction), 3, .initial = { 0, -1, 0 },
      .text = "The way its light travels, of any length: of light from infinity, or of the middle of a cone." },
    { "ambient", LOM_KEY_COLOR, AT(lom_lamp, ambient), 3, .flags = LOM_KEY_SPREAD, .maximum = 1000,
      .text = "Light on all that it reaches, whichever way that faces." },
    { "diffuse", LOM_KEY_COLOR, AT(lom_lamp, diffuse), 3, .flags = LOM_KEY_SPREAD, .maximum = 1000,
      .initial = { 1, 1, 1 }, .text = "Light on what faces it." },
    { "specular", LOM_KEY_COLOR, AT(lom_lamp, specular), 3, .flags = LOM_KEY_SPREAD, .maximum = 1000,
      .text = "Light in highlights, and in its glints on water.", .initial_text = "as `diffuse`" },
    { "intensity", LOM_KEY_NUMBER, AT(lom_lamp, intensity), .maximum = 1e6, .initial = { 1 },
      .text = "Factor on the three colours." },
    { "attenuation", LOM_KEY_NUMBER, AT(lom_lamp, attenuation), 3, .maximum = 1e6, .initial = { 1, 0, 0 },
      .text = "Constant, linear and quadratic: at d metres the light is divided by their sum c + l d + q d^2." },
    { "range", LOM_KEY_NUMBER, AT(lom_lamp, range), .minimum = 7, .maximum = 3250, .unit = "m",
      .text = "Instead of `attenuation`: the one whose light covers this distance, by the table of docs/lighting.md.",
      .initial_text = "as `attenuation` says" },
    { "reach", LOM_KEY_NUMBER, AT(lom_lamp, reach), .maximum = 1e9, .unit = "m",
      .text = "From here on there is no light; over the quarter before, it fades. 0: where no colour of it is above "
              "1/1000 of white, which an attenuation that is constant has nowhere." },
    { "cutoff", LOM_KEY_ANGLE, AT(lom_lamp, cutoff), .maximum = 180, .initial = { 180 }, .unit = "degrees",
      .text = "From the middle of a spot's cone to its edge, up to 90; 180: light to all sides." },
    { "softness", LOM_KEY_ANGLE, AT(lom_lamp, softness), .maximum = 90, .unit = "degrees",
      .text = "Inside the cone's edge the light begins over so much, at most the cutoff. 0: at once." },
    { "exponent", LOM_KEY_NUMBER, AT(lom_lamp, exponent), .maximum = 10000,
      .text = "On the cosine to the middle of the cone; larger is narrower." },
    { "on", LOM_KEY_BOOL, AT(lom_lamp, on), .initial = { 1 }, .text = "Whether it shines." },
    { "shadow", LOM_KEY_BOOL, AT(lom_lamp, shadow),
      .text = "Opaque entities and terrain in its reach keep its light off what is behind them (docs/lighting.md). Not "
              "of a lamp at infinity." },
    { "shadow_from", LOM_KEY_NUMBER, AT(lom_lamp, shadow_from), .minimum = 0.001, .maximum = 1e6, .initial = { 0.1 },
      .unit = "m",
      .text = "What is nearer to it throws no shadow: its bulb, its glass. Measured along the middle of a spot's cone, "
              "or along the nearest of the world's axes." },
    { "follow", LOM_KEY_STRING, AT(lom_lamp, follow),
      .text = "Name of an entity: `position`, `direction` and the keys are then in its coordinates, turned as it is. "
              "With one that is not visible the lamp is off." },
    { "interpolation", LOM_KEY_CHOICE, AT(lom_lamp, interpolation), .choices = { "linear", "smooth" },
      .text = "Between the keys, as of the camera." },
    { "key", LOM_KEY_TABLES, AT(lom_lamp, keys), .table = &lamp_key_table, .length_offset = AT(lom_lamp, key_count),
      .text = "Key frames of a lamp that moves or changes." },
};
const lom_key_table lom_lamp_keys = {
    .size = sizeof(lom_lamp),
    .keys = lamp,
    .key_count = COUNT(lamp),
    .text =
        "A light beside the sun: a point, a spot, or one at infinity (docs/lighting.md). There may be 16384 of them; "
        "what they give a place is added up.",
    .check = check_lamp
};
