/* Arrays that grow. In: how many elements there must be room for. Out: memory of lom_allocate. */
#ifndef LOM_BASE_RESERVE_H
#define LOM_BASE_RESERVE_H

#include <lom/base.h>

/* Room for at least `needed` elements of `size` bytes: where *capacity is less, the array becomes a larger copy of its
 * *capacity elements, zeros behind them, at least twice as long, so that appending is linear. array is the address of a
 * pointer to any type, which is NULL while *capacity is 0. False (and LOM_ERROR_MEMORY) without memory; the array and
 * *capacity are as before then. */
bool lom_reserve(void *array, size_t *capacity, size_t needed, size_t size, lom_error *error);
/* The same for an array whose elements are of no use any more: where *capacity is less, it becomes `needed` zeros (at least
 * 16). False without memory; the array is empty then. */
bool lom_renew(void *array, size_t *capacity, size_t needed, size_t size, lom_error *error);
/* The same, but the elements are not set: for what is large and written before it is read. */
bool lom_renew_bare(void *array, size_t *capacity, size_t needed, size_t size, lom_error *error);
/* lom_allocate without zeros. */
void *lom_allocate_bare(size_t count, size_t size, lom_error *error);

#endif
