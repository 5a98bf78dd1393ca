/* Numbers 0 .. count - 1 handed out to workers, a portion to each: who has none left takes from the end of another's. Unlike
 * by one counter a number goes to the same worker most often, run for run, and what was written for it is in that
 * worker's cache. */
#ifndef LOM_BASE_PORTIONS_H
#define LOM_BASE_PORTIONS_H

#include <lom/base.h>

#include <stdatomic.h>

/* Of one worker, on a cache line of its own: the first number that is left, and above 32 bits one past the last. */
typedef struct lom_portion {
    _Alignas(64) _Atomic uint64_t left;
} lom_portion;

/* Begins to hand out `count` < 2^32 numbers to `workers` workers; nobody takes any meanwhile. */
void lom_lay_portions(lom_portion *portions, int workers, size_t count);
/* Up to `most` numbers from *first on for a worker, how many: 0 when all are handed out. */
size_t lom_take_portion(lom_portion *portions, int workers, int worker, size_t most, size_t *first);

#endif
