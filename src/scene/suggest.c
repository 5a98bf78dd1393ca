/* The known name that is most like a mistyped one. In: a word and the names. Out: one of them or none. Invariant: the
 * first of the nearest names wins, so the answer depends on the table alone. */
#include "reader.h"

#include <stdio.h>
#include <string.h>

enum { LONGEST = 40 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours (Damerau 1964; rows
 * as in Wagner and Fischer 1974). Both at most LONGEST. */
static size_t edit_distance(const char *a, size_t m, const char *b, size_t n)
{
    size_t rows[3][LONGEST + 1];
    for (size_t j = 0; j <= n; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= m; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *second = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            size_t best = least(above[j] + 1, row[j - 1] + 1);
            best = least(best, above[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                best = least(best, second[j - 2] + 1);
            row[j] = best;
        }
    }
    return rows[m % 3][n];
}

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
        size_t distance = edit_distance(unknown, length, candidate, candidate_length);
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
