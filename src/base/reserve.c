/* Growth by doubling. In: an array and how long it must be. Out: a longer copy, or a longer array. */
#include "base/reserve.h"

#include <string.h>

enum { FIRST = 16 };

bool lom_reserve(void *array, size_t *capacity, size_t needed, size_t size, lom_error *error)
{
    if (needed <= *capacity)
        return true;
    size_t twice = *capacity < SIZE_MAX / 2 ? 2 * *capacity : needed;
    size_t larger = needed > twice ? needed : twice;
    larger = larger > FIRST ? larger : FIRST;
    void *items, *copy = lom_allocate(larger, size, error);
    if (copy == NULL)
        return false;
    memcpy(&items, array, sizeof items); /* of whatever type the pointer is */
    if (items != NULL)
        memcpy(copy, items, *capacity * size);
    lom_release(items);
    memcpy(array, &copy, sizeof copy);
    *capacity = larger;
    return true;
}

bool lom_renew_bare(void *array, size_t *capacity, size_t needed, size_t size, lom_error *error)
{
    void *items;
    if (needed <= *capacity)
        return true;
    memcpy(&items, array, sizeof items);
    lom_release(items);
    items = lom_allocate_bare(needed, size, error);
    memcpy(array, &items, sizeof items);
    *capacity = items != NULL ? needed : 0;
    return items != NULL;
}

bool lom_renew(void *array, size_t *capacity, size_t needed, size_t size, lom_error *error)
{
    if (needed <= *capacity)
        return true;
    void *items, *none = NULL;
    memcpy(&items, array, sizeof items);
    lom_release(items);
    memcpy(array, &none, sizeof none);
    *capacity = 0;
    return lom_reserve(array, capacity, needed, size, error);
}
