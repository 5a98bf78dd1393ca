/* The table of the scene file's [sky] keys. In: nothing. Out: names, ranges, defaults and documentation of every member
 * of lom_sky_params. */
#include "sky/sky_keys.h"

#include "sky/face_mark.h"

#include <lom/sky.h>

#include <stdio.h>
#include <string.h>

#define AT(member) offsetof(lom_sky_params, member)

static const lom_key keys[] = {
    { "pattern", LOM_KEY_STRING, AT(pattern),
      .text = "File names of the six pictures of a sky box with one `%s`, for which `right` (+x), `left` (-x), `top` "
              "(+y), `bottom` (-y), `front` (+z) and `back` (-z) are put in turn." },
    { "faces", LOM_KEY_FILE, AT(faces), 6,
      .text = "The same six pictures, each by its own name, in that order; instead of `pattern`." },
    { "cube", LOM_KEY_FILE, AT(cube),
      .text = "One file of all six faces (a cube in DDS or KTX); instead of `pattern` and `faces`." },
    { "rotation", LOM_KEY_ANGLE, AT(rotation), .minimum = -360, .maximum = 360, .unit = "degrees",
      .text = "Turns the box about the y axis, counter-clockwise seen from above." },
    { "intensity", LOM_KEY_NUMBER, AT(intensity), .maximum = 1e6, .initial = { 1 },
      .text = "Factor on the pictures, or on `color`." },
    { "color", LOM_KEY_COLOR, AT(color), 3, .maximum = 1000, .initial = { 0.25, 0.45, 0.8 },
      .text = "The whole sky's colour when there are no pictures." },
    { "gradient", LOM_KEY_BOOL, AT(gradient),
      .text = "Instead of one colour, from `horizon` to `zenith`, with haze low down and a glow towards the sun." },
    { "zenith", LOM_KEY_COLOR, AT(zenith), 3, .maximum = 1000, .initial = { 0.061, 0.119, 0.271 },
      .text = "Colour straight above (the default is the reference work's)." },
    { "horizon", LOM_KEY_COLOR, AT(horizon), 3, .maximum = 1000, .initial = { 0.287, 0.407, 0.645 },
      .text = "Colour at the horizon, behind the haze." },
    { "haze", LOM_KEY_COLOR, AT(haze), 3, .maximum = 1000, .initial = { 0.539, 0.645, 0.730 },
      .text = "Colour of the haze at the horizon, and of everything below it." },
    { "haze_height", LOM_KEY_NUMBER, AT(haze_height), .flags = LOM_KEY_ABOVE, .maximum = 1, .initial = { 0.25 },
      .text = "Sine of the elevation at which the haze ends." },
    { "glow", LOM_KEY_COLOR, AT(glow), 3, .maximum = 1000, .text = "What is added towards the sun." },
    { "sun", LOM_KEY_BOOL, AT(sun),
      .text = "Draw the sun: a picture on a square that faces the camera, where the light "
              "comes from." },
    { "sun_size", LOM_KEY_ANGLE, AT(sun_size), .minimum = 0.1, .maximum = 120, .initial = { 20 }, .unit = "degrees",
      .text = "How wide the square is; the disc is a 20th of it." },
    { "sun_rays", LOM_KEY_NUMBER, AT(sun_rays), .maximum = 1, .initial = { 0.4 }, .text = "How strong its rays are." },
};

/* The pattern with a face's name in the place of its %s, as a path. */
static const char *face_path(const lom_key_check *check, const char *pattern, const char *name)
{
    const char *mark = lom_face_mark(pattern);
    size_t size = strlen(pattern) + strlen(name);
    char *text = lom_allocate(size, 1, check->error);
    if (text == NULL)
        return NULL;
    snprintf(text, size, "%.*s%s%s", (int)(mark - pattern), pattern, name, mark + 2);
    const char *path = check->path(check, "pattern", text);
    lom_release(text);
    return path;
}

static bool check_sky(void *members, const lom_key_check *check)
{
    static const char *const names[6] = { "right", "left", "top", "bottom", "front", "back" };
    lom_sky_params *sky = members;
    bool has_faces = sky->faces[0] != NULL;
    for (int i = 1; i < 6; i++)
        if ((sky->faces[i] != NULL) != has_faces)
            return check->fail(check, "faces", "\"faces\" must name all six pictures, or be left out.");
    if (sky->cube != NULL) {
        if (has_faces || sky->pattern != NULL)
            return check->fail(check, "cube", "the sky has either a cube, a pattern or faces.");
        for (int i = 0; i < 6; i++)
            sky->faces[i] = sky->cube;
        return true;
    }
    if (sky->pattern == NULL)
        return true;
    if (has_faces)
        return check->fail(check, "pattern", "the sky has either a pattern or faces, not both.");
    if (lom_face_mark(sky->pattern) == NULL)
        return check->fail(check, "pattern", "\"pattern\" must have one %s, for right, left, top, ...");
    for (int i = 0; i < 6; i++) {
        sky->faces[i] = face_path(check, sky->pattern, names[i]);
        if (sky->faces[i] == NULL)
            return false;
    }
    return true;
}

const lom_key_table lom_sky_keys = { .size = sizeof(lom_sky_params),
                                     .keys = keys,
                                     .key_count = sizeof keys / sizeof *keys,
                                     .text =
                                         "What is behind everything: a box of six pictures, a gradient, or one colour.",
                                     .check = check_sky };
