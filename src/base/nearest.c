/* The nearest of some names. In: a word that is none of them. Out: the one it was most likely meant to be, for "did you
 * mean". Invariant: the answer depends on the texts alone; of equally near names the first wins. */
#include "nearest.h"

#include <lom/base.h>

#include <string.h>

/* Three rows of the table of prefixes are enough (Wagner and Fischer 1974; the swap: Damerau 1964). */
size_t lom_edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][LOM_NEAREST_LONGEST + 1];
    if (a_length > LOM_NEAREST_LONGEST || b_length > LOM_NEAREST_LONGEST)
        return SIZE_MAX;
    for (size_t j = 0; j <= b_length; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *above2 = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            size_t best = above[j - 1] + (a[i - 1] != b[j - 1]);
            if (above[j] + 1 < best)
                best = above[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && above2[j - 2] + 1 < best)
                best = above2[j - 2] + 1;
            row[j] = best;
        }
    }
    return rows[a_length % 3][b_length];
}

const char *lom_nearest_name(const char *word, size_t length, const char *const *names, size_t count)
{
    const char *nearest = NULL;
    size_t best = length / 3 + 1; /* at most one mistake in three letters, and one more */
    for (size_t i = 0; i < count; i++) {
        size_t name_length = strlen(names[i]);
        size_t d = lom_edit_distance(word, length, names[i], name_length);
        if (d < name_length && (d < best || (d == best && nearest == NULL))) {
            nearest = names[i];
            best = d;
        }
    }
    return nearest;
}
