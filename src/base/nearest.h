/* How far two names are apart, for everything that suggests one. */
#ifndef LOM_BASE_NEAREST_H
#define LOM_BASE_NEAREST_H

#include <stddef.h>

enum { LOM_NEAREST_LONGEST = 64 }; /* longer words are like nothing */

/* Optimal string alignment distance of a[0, a_length) and b[0, b_length): insertions, deletions, substitutions and
 * swaps of neighbours count 1 each. SIZE_MAX when one is longer than LOM_NEAREST_LONGEST. */
size_t lom_edit_distance(const char *a, size_t a_length, const char *b, size_t b_length);

#endif
