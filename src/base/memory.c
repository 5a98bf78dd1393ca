/* Checked memory. Every allocation of the library goes through lom_allocate, so that one place checks the size and
 * tests can make any allocation fail. */
#include <lom/base.h>

#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 }; /* a cache line, and the widest vector */

void *lom_allocate(size_t count, size_t size, lom_error *error)
{
    size_t total;
    if (__builtin_mul_overflow(count, size, &total) || total > SIZE_MAX / 2) {
        lom_fail(error, LOM_ERROR_MEMORY, "%zu elements of %zu bytes are more than the address space holds.", count,
                 size);
        return NULL;
    }
    size_t rounded = (total + ALIGNMENT) & ~(size_t)(ALIGNMENT - 1);
    void *memory = aligned_alloc(ALIGNMENT, rounded);
    if (memory == NULL) {
        lom_fail(error, LOM_ERROR_MEMORY, "The system gave no memory for %zu bytes.", total);
        return NULL;
    }
    return memset(memory, 0, rounded);
}

void lom_release(void *memory)
{
    free(memory);
}
