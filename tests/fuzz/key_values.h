/* Values of the scene file's keys, out of bytes. */
#ifndef LOM_TESTS_FUZZ_KEY_VALUES_H
#define LOM_TESTS_FUZZ_KEY_VALUES_H

#include "bytes.h"
#include "scene/scene_keys.h"

#include <stdio.h>

/* Keys that choose how much is computed, by the end of their path; and files. */
static const char *const left_alone[] = { "output.width",  "output.height", "output.frames", "output.fps",
                                          "shallow.start", "shallow.step",  ".voxels",       ".file",
                                          ".kind",         ".pattern" };

static inline bool is_left_alone(const char *path)
{
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof left_alone / sizeof *left_alone; i++) {
        size_t end = strlen(left_alone[i]);
        if (length >= end && strcmp(path + length - end, left_alone[i]) == 0)
            return true;
    }
    return false;
}

static inline double take_number(fuzz_bytes *in, const lom_key *key)
{
    bool free = key->minimum == 0 && key->maximum == 0;
    double low = free ? -1e9 : key->minimum, high = free ? 1e9 : key->maximum;
    double tiny = key->flags & LOM_KEY_ABOVE ? low + 1e-300 : low;
    switch (take_choice(in, 8)) {
    case 0:
        return tiny;
    case 1:
        return high;
    case 2:
        return high * (1 - 0x1p-53);
    case 3:
        return key->initial[0] + 1e-12;
    case 4:
        return low < 0 && high > 0 ? 1e-300 : low + (high - low) / 1e6;
    case 5:
        return low + (high - low) * take_byte(in) / 255;
    default:
        return key->initial[0] * (1 + take_byte(in) / 64.0);
    }
}

/* Appends what the key is set to; false when it has no such value. */
static inline bool take_value(fuzz_bytes *in, const lom_key *key, char *text, size_t room)
{
    int choices = 0;
    size_t used;
    switch (key->type) {
    case LOM_KEY_BOOL:
        snprintf(text, room, take_bool(in) ? "true" : "false");
        return true;
    case LOM_KEY_INTEGER: {
        int value = (int)key->minimum + take_choice(in, 33);
        snprintf(text, room, "%d", value > key->maximum && key->maximum > key->minimum ? (int)key->maximum : value);
        return true;
    }
    case LOM_KEY_CHOICE:
        while (choices < 12 && key->choices[choices] != NULL)
            choices++;
        snprintf(text, room, "\"%s\"", key->choices[take_choice(in, choices)]);
        return true;
    case LOM_KEY_NUMBER:
    case LOM_KEY_ANGLE:
    case LOM_KEY_COLOR:
        used = (size_t)snprintf(text, room, key->count > 1 ? "[" : "");
        for (int i = 0; i < key->count || i == 0; i++)
            used += (size_t)snprintf(text + used, room - used, "%s%.17g", i > 0 ? ", " : "", take_number(in, key));
        snprintf(text + used, room - used, key->count > 1 ? "]" : "");
        return true;
    default:
        return false;
    }
}

#endif
