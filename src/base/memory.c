/* Checked memory. Every allocation of the library goes through this file, so that one place checks the size and tests
 * can make any allocation fail. */
#include "base/reserve.h"
#include "base/system.h"

#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 }; /* a cache line, and the widest vector */

/* Bytes of a block for that many. 0: more than there is. */
static size_t measure(size_t count, size_t size, lom_error *error)
{
    size_t total;
    if (__builtin_mul_overflow(count, size, &total) || total > SIZE_MAX / 2) {
        lom_fail(error, LOM_ERROR_MEMORY, "%zu elements of %zu bytes are more than the address space holds.", count,
                 size);
        return 0;
    }
    return (total + ALIGNMENT) & ~(size_t)(ALIGNMENT - 1);
}

void *lom_allocate_bare(size_t count, size_t size, lom_error *error)
{
    size_t bytes = measure(count, size, error);
    bool large = bytes >= LOM_LARGE_PAGE;
    size_t alignment = large ? LOM_LARGE_PAGE : ALIGNMENT, whole = bytes / alignment * alignment;
    void *memory = bytes == 0 ? NULL : aligned_alloc(alignment, whole < bytes ? whole + alignment : whole);
    if (memory != NULL && large)
        lom_expect_whole(memory, whole);
    if (memory == NULL && bytes != 0)
        lom_fail(error, LOM_ERROR_MEMORY, "The system gave no memory for %zu bytes.", count * size);
    return memory;
}

void *lom_allocate(size_t count, size_t size, lom_error *error)
{
    void *memory = lom_allocate_bare(count, size, error);
    return memory == NULL ? NULL : memset(memory, 0, measure(count, size, NULL));
}

void lom_release(void *memory)
{
    free(memory);
}
