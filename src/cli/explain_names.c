/* Words and places of an explanation. In: what was recorded. Out: the names that text and JSON share. */
#include "explain_output.h"

#include <string.h>

const char *lom_compare_text(lom_compare compare)
{
    static const char *const texts[] = { "greater",       "never",   "less",      "equal",
                                         "less or equal", "greater", "not equal", "greater or equal",
                                         "always" };
    return texts[compare];
}

const char *lom_factor_text(lom_factor factor)
{
    static const char *const texts[] = { "0",
                                         "1",
                                         "source",
                                         "1 - source",
                                         "source alpha",
                                         "1 - source alpha",
                                         "target",
                                         "1 - target",
                                         "target alpha",
                                         "1 - target alpha",
                                         "constant",
                                         "1 - constant",
                                         "constant alpha",
                                         "1 - constant alpha",
                                         "min(source alpha, 1 - target alpha)",
                                         "second source",
                                         "1 - second source",
                                         "second source alpha",
                                         "1 - second source alpha" };
    return texts[factor];
}

const char *lom_operation_text(lom_blend_operation operation)
{
    static const char *const texts[] = { "add", "subtract", "reverse subtract", "min", "max" };
    return texts[operation];
}

bool lom_world_place(const lom_explained *explained, const lom_vertex_record *vertex, double place[3])
{
    const double eye[3] = { explained->eye.x, explained->eye.y, explained->eye.z };
    for (const lom_note_record *n = vertex->notes; n != NULL; n = n->next)
        if (n->kind == LOM_NOTE_VALUE && n->components == 3 && strcmp(n->name, "offset") == 0) {
            for (int i = 0; i < 3; i++)
                place[i] = (double)n->value[i] + eye[i];
            return true;
        }
    return false;
}
