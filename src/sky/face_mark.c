/* Where a face's name goes. In: a pattern of paths. Out: its %s. Invariant: folders that happen to have one in their
 * names change nothing for a file's name that has one. */
#include "sky/face_mark.h"

#include <stddef.h>
#include <string.h>

const char *lom_face_mark(const char *pattern)
{
    const char *slash = strrchr(pattern, '/'), *name = slash != NULL ? slash + 1 : pattern;
    const char *mark = strstr(name, "%s");
    if (mark == NULL)
        mark = strstr(pattern, "%s");
    return mark == NULL || strstr(mark + 2, "%s") != NULL ? NULL : mark;
}
