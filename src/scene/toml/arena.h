/* Memory that is given out piece by piece and released at once. In: sizes. Out: zeroed, aligned pieces that stay where
 * they are. Invariant: every piece belongs to exactly one arena and dies with it. */
#ifndef LOM_SCENE_TOML_ARENA_H
#define LOM_SCENE_TOML_ARENA_H

#include <lom/base.h>

typedef struct lom_arena {
    struct lom_arena_block *blocks; /* the newest first */
} lom_arena;

/* Zeroed memory for count elements of size bytes, aligned to 16; NULL on failure. */
void *lom_arena_take(lom_arena *arena, size_t count, size_t size, lom_error *error);
/* A copy of text[0, length) with a zero byte behind it. */
char *lom_arena_text(lom_arena *arena, const char *text, size_t length, lom_error *error);
/* A larger copy of an array of count elements when it is full, else the array itself; NULL on failure. */
void *lom_arena_grow(lom_arena *arena, void *array, size_t count, size_t *capacity, size_t size, lom_error *error);
void lom_arena_release(lom_arena *arena);

#endif
