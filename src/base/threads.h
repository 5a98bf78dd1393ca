/* A pool of worker threads that run one function together and wait for one another. */
#ifndef LOM_BASE_THREADS_H
#define LOM_BASE_THREADS_H

#include "base/portions.h"

typedef struct lom_pool lom_pool;
typedef void lom_work(void *context, int worker);
typedef void lom_range_work(void *context, size_t first, size_t end);

/* A pool of `threads` workers, of which the caller is number 0; each has the default float state. When the system gives
 * fewer threads the pool is that much smaller: results never depend on it. In a forked child the pool is the caller
 * alone. NULL when memory runs out. */
lom_pool *lom_create_pool(int threads, lom_error *error);
/* Ends the workers and frees the pool, or in a forked child its memory; NULL is allowed. */
void lom_free_pool(lom_pool *pool);
/* Workers of the pool, the caller included. */
int lom_pool_size(const lom_pool *pool);
/* Until as many calls of the other the caller is in one process, and nothing asks the system for that before each run. */
void lom_enter_pool(lom_pool *pool);
void lom_leave_pool(lom_pool *pool);
/* One for each of the threads that were asked for, whether or not they are there, for what is handed out by portions: by one
 * caller at a time. */
lom_portion *lom_pool_portions(lom_pool *pool);
/* Nanoseconds by the clock in which two workers or more were at work, since the pool was made. */
uint64_t lom_pool_shared(const lom_pool *pool);
/* Runs work(context, worker) on every worker; returns when all have returned. What they wrote is visible to the caller.
 */
void lom_run_pool(lom_pool *pool, lom_work *work, void *context);

/* The same for work that its callers take from one another until none is left: a worker who comes when the
 * caller has found none left, as one that slept may, is not waited for. */
void lom_offer_work(lom_pool *pool, lom_work *work, void *context);

/* Runs work(context, first, end) for ranges that make up 0 .. count - 1, `piece` at most in each, on all workers. */
void lom_share_out(lom_pool *pool, size_t count, size_t piece, lom_range_work *work, void *context);

#endif
