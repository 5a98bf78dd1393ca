/* How many primitives, in words. In: counts by corners. Out: a part of a sentence. */
#include "inspect/steps.h"

#include <stdio.h>

bool lom_any_counted(const struct counted *counted)
{
    return (counted->of[0] | counted->of[1] | counted->of[2]) != 0;
}

const char *lom_say_counted(const struct counted *counted, char text[MAX_COUNTED])
{
    static const char *const names[CORNER_KINDS] = { "point", "line", "triangle" };
    int left = 0, length = 0;
    for (int i = 0; i < CORNER_KINDS; i++)
        left += counted->of[i] != 0;
    if (left == 0)
        snprintf(text, MAX_COUNTED, "0 triangles");
    for (int i = CORNER_KINDS - 1, said = 0; i >= 0; i--)
        if (counted->of[i] != 0) {
            left--;
            length += snprintf(text + length, (size_t)(MAX_COUNTED - length), "%s%llu %s%s",
                               said == 0   ? ""
                               : left == 0 ? " and "
                                           : ", ",
                               (unsigned long long)counted->of[i], names[i], counted->of[i] == 1 ? "" : "s");
            said++;
        }
    return text;
}
