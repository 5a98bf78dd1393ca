/* Arrays that grow, in memory from lom_allocate. */
#ifndef LOM_BASE_GROW_H
#define LOM_BASE_GROW_H

#include <lom/base.h>

/* Makes room for more than count elements of size bytes: gives items or a larger copy of its count elements (items is
 * then released), and changes *capacity. NULL on failure; items is still the caller's then. */
void *lom_grow(void *items, size_t *capacity, size_t count, size_t size, lom_error *error);

#endif
