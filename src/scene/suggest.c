/* The known name that is most like a mistyped one. In: a word and the names. Out: one of them or none. Invariant: the
 * first of the nearest names wins, so the answer depends on the table alone. */
#include "scene/reader.h"

#include "base/nearest.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST = 40 }; /* a suggestion fits into a message */

const char *lom_suggest(const char *unknown, size_t length, lom_name_at *name, const void *context, size_t count)
{
    const char *nearest = NULL;
    size_t allowed = (length + 2) / 3; /* one slip in three letters */
    if (length > LONGEST)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        const char *candidate = name(context, i);
        size_t candidate_length = candidate == NULL ? SIZE_MAX : strlen(candidate);
        if (candidate_length > LONGEST)
            continue;
        size_t distance = lom_edit_distance(unknown, length, candidate, candidate_length);
        if (distance > allowed || distance >= candidate_length || (nearest != NULL && distance == allowed))
            continue;
        nearest = candidate;
        allowed = distance;
    }
    return nearest;
}

const char *lom_suggestion_text(char text[96], const char *suggestion)
{
    text[0] = 0;
    if (suggestion != NULL)
        snprintf(text, 96, " (did you mean \"%.*s\"?)", LONGEST, suggestion);
    return text;
}
