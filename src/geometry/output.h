/* Text that is put together. In: words and numbers. Out: contiguous memory from lom_allocate. */
#ifndef LOM_GEOMETRY_OUTPUT_H
#define LOM_GEOMETRY_OUTPUT_H

#include <lom/base.h>

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
