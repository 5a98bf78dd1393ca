/* The range of a key in words, for messages and the documentation alike. In: a key. Out: "above 0 and at most 1 m". */
#include "scene/reader.h"

#include <stdio.h>

static void choices_text(char text[160], const lom_key *key)
{
    size_t used = 0;
    for (size_t i = 0; i < sizeof key->choices / sizeof *key->choices && key->choices[i] != NULL && used < 160; i++) {
        bool last = i + 1 == sizeof key->choices / sizeof *key->choices || key->choices[i + 1] == NULL;
        const char *before = i == 0 ? "" : last ? " or " : ", ";
        used += (size_t)snprintf(text + used, 160 - used, "%s\"%s\"", before, key->choices[i]);
    }
}

const char *lom_range_text(char text[160], const lom_key *key)
{
    text[0] = 0;
    if (key->type == LOM_KEY_CHOICE)
        choices_text(text, key);
    if (key->type == LOM_KEY_CHOICE || (key->minimum == 0 && key->maximum == 0))
        return text;
    char low[32], high[32];
    lom_print_double(low, key->minimum);
    lom_print_double(high, key->maximum);
    if (key->flags & LOM_KEY_ABOVE)
        snprintf(text, 160, "above %s and at most %s", low, high);
    else
        snprintf(text, 160, "from %s to %s", low, high);
    return text;
}
