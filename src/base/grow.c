/* Arrays that grow by half of their length, so that appending is linear. In: an array that is full. Out: a larger one
 * with the same elements. */
#include "base/grow.h"

#include <string.h>

void *lom_grow(void *items, size_t *capacity, size_t count, size_t size, lom_error *error)
{
    if (count < *capacity)
        return items;
    size_t larger = count + count / 2 + 64;
    void *copy = lom_allocate(larger, size, error);
    if (copy == NULL)
        return NULL;
    if (count > 0)
        memcpy(copy, items, count * size);
    lom_release(items);
    *capacity = larger;
    return copy;
}
