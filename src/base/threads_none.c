/* The pool of a system without threads: the caller alone. In, a function; out, its effects. */
#include "base/threads.h"

struct lom_pool {
    lom_portion portion;
};

lom_pool *lom_create_pool(int threads, lom_error *error)
{
    (void)threads;
    return lom_allocate(1, sizeof(lom_pool), error);
}

void lom_free_pool(lom_pool *pool)
{
    lom_release(pool);
}

int lom_pool_size(const lom_pool *pool)
{
    (void)pool;
    return 1;
}

lom_portion *lom_pool_portions(lom_pool *pool)
{
    return &pool->portion;
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
