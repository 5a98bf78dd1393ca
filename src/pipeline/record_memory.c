/* Memory of records: blocks that grow by what is recorded and are freed as a whole, so that addresses stay. */
#include "pipeline/record.h"

struct record_block {
    struct record_block *next;
    size_t used, size;
    max_align_t data[];
};

enum { BLOCK = 4096 - 64 };

void *lom_record_allocate(struct record_memory *memory, size_t size)
{
    struct record_block *block = memory->first;
    size = (size + sizeof(max_align_t) - 1) / sizeof(max_align_t) * sizeof(max_align_t);
    if (block == NULL || block->size - block->used < size) {
        size_t room = size > BLOCK ? size : BLOCK;
        block = lom_allocate(1, sizeof *block + room, NULL);
        if (block == NULL) {
            memory->failed = true;
            return NULL;
        }
        block->size = room;
        block->next = memory->first;
        memory->first = block;
    }
    void *result = (uint8_t *)block->data + block->used;
    block->used += size;
    return result;
}

void lom_free_record_memory(struct record_memory *memory)
{
    while (memory->first != NULL) {
        struct record_block *next = memory->first->next;
        lom_release(memory->first);
        memory->first = next;
    }
}
