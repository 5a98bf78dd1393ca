/* Memory that is given out piece by piece and released at once; see arena.h. */
#include "scene/toml/arena.h"

#include <string.h>

enum { FIRST_BLOCK = 4096, LARGEST_BLOCK = 1 << 20, ALIGNMENT = 16 };

struct lom_arena_block {
    struct lom_arena_block *next;
    size_t used, size;
    _Alignas(ALIGNMENT) unsigned char bytes[];
};

static struct lom_arena_block *add_block(lom_arena *arena, size_t needed, lom_error *error)
{
    size_t size = arena->blocks == NULL ? FIRST_BLOCK : arena->blocks->size * 2;
    size = size > LARGEST_BLOCK ? LARGEST_BLOCK : size;
    size = size < needed ? needed : size;
    struct lom_arena_block *block = lom_allocate(1, sizeof *block + size, error);
    if (block == NULL)
        return NULL;
    block->size = size;
    block->next = arena->blocks;
    arena->blocks = block;
    return block;
}

void *lom_arena_take(lom_arena *arena, size_t count, size_t size, lom_error *error)
{
    size_t total;
    if (__builtin_mul_overflow(count, size, &total) || total > SIZE_MAX / 4) {
        lom_fail(error, LOM_ERROR_MEMORY, "%zu elements of %zu bytes are more than the address space holds.", count,
                 size);
        return NULL;
    }
    total = (total + ALIGNMENT - 1) & ~(size_t)(ALIGNMENT - 1);
    struct lom_arena_block *block = arena->blocks;
    if (block == NULL || block->size - block->used < total)
        block = add_block(arena, total, error);
    if (block == NULL)
        return NULL;
    void *piece = block->bytes + block->used;
    block->used += total;
    return piece;
}

char *lom_arena_text(lom_arena *arena, const char *text, size_t length, lom_error *error)
{
    char *copy = lom_arena_take(arena, length + 1, 1, error);
    if (copy != NULL && length > 0)
        memcpy(copy, text, length);
    return copy;
}

void *lom_arena_grow(lom_arena *arena, void *array, size_t count, size_t *capacity, size_t size, lom_error *error)
{
    if (count < *capacity)
        return array;
    size_t larger = *capacity == 0 ? 4 : *capacity * 2;
    void *copy = lom_arena_take(arena, larger, size, error);
    if (copy == NULL)
        return NULL;
    if (count > 0)
        memcpy(copy, array, count * size);
    *capacity = larger;
    return copy;
}

void lom_arena_release(lom_arena *arena)
{
    while (arena->blocks != NULL) {
        struct lom_arena_block *next = arena->blocks->next;
        lom_release(arena->blocks);
        arena->blocks = next;
    }
}
