/* Arrays and byte buffers that grow. In: what is appended. Out: contiguous memory from lom_allocate; sizes are checked
 * before they are used. */
#ifndef LOM_GEOMETRY_ARRAY_H
#define LOM_GEOMETRY_ARRAY_H

#include <lom/base.h>

/* Makes room for more than count elements of size bytes: gives items or a larger copy of its count elements (items is
 * then released), and changes *capacity. NULL on failure; items is still the caller's then. */
void *lom_grow(void *items, size_t *capacity, size_t count, size_t size, lom_error *error);

struct lom_output {
    lom_bytes bytes;
    size_t capacity;
    lom_error *error;
    bool failed; /* sticky: only the end needs to be checked */
};

void lom_put(struct lom_output *output, const char *string);
void lom_put_float(struct lom_output *output, float value);
void lom_put_index(struct lom_output *output, uint32_t index);

#endif
