/* The pool of a system without threads: the caller alone. In, a function; out, its effects. */
#include "base/threads.h"

struct lom_pool {
    lom_portion *portions;
};

lom_pool *lom_create_pool(int threads, lom_error *error)
{
    lom_pool *pool = lom_allocate(1, sizeof *pool, error);
    if (pool != NULL && (pool->portions = lom_allocate((size_t)threads, sizeof *pool->portions, error)) == NULL) {
        lom_release(pool);
        return NULL;
    }
    return pool;
}

void lom_free_pool(lom_pool *pool)
{
    if (pool != NULL)
        lom_release(pool->portions);
    lom_release(pool);
}

int lom_pool_size(const lom_pool *pool)
{
    (void)pool;
    return 1;
}

void lom_enter_pool(lom_pool *pool)
{
    (void)pool;
}

void lom_leave_pool(lom_pool *pool)
{
    (void)pool;
}

lom_portion *lom_pool_portions(lom_pool *pool)
{
    return pool->portions;
}

uint64_t lom_pool_shared(const lom_pool *pool)
{
    (void)pool;
    return 0;
}

void lom_run_pool(lom_pool *pool, lom_work *work, void *context)
{
    (void)pool;
    work(context, 0);
}

void lom_offer_work(lom_pool *pool, lom_work *work, void *context)
{
    lom_run_pool(pool, work, context);
}
