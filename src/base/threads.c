/* The pool: in, a function; out, its effects on every worker. A waiting worker spins briefly (a pass has many short
 * phases) and then sleeps (spinning on a shared core costs whole scheduler quanta).
 *
 * A child that is forked has one thread, the one that forked (POSIX.1-2017, fork): none of the pool's workers. There
 * the pool is one of the caller alone, and neither joins threads nor destroys conditions that it believes are waited
 * for. */
#include "base/threads.h"

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>
#include <unistd.h>

enum { SPINS = 2000 };

/* Bytes that a worker needs at most, at every level of optimisation; systems give as little as 128 KiB (musl). */
static const size_t worker_stack = (size_t)1 << 20;

/* When a worker was at its work, nanoseconds; a cache line each. */
struct turn {
    _Alignas(64) int64_t begin, end;
};

struct lom_pool {
    pid_t process; /* that the workers belong to */
    int size;
    pthread_t *threads;
    pthread_mutex_t mutex;
    pthread_cond_t wake, finished;
    atomic_uint generation; /* odd steps are never seen: it counts the calls of lom_run_pool */
    atomic_int running;
    bool ending;
    lom_work *work;
    void *context;
    struct turn *turns;
    uint64_t shared; /* nanoseconds in which two were at work, or more */
};

struct worker {
    lom_pool *pool;
    int number;
};

static void pause_briefly(void)
{
#if defined __x86_64__
    __builtin_ia32_pause();
#endif
}

static unsigned wait_for_generation(lom_pool *pool, unsigned seen)
{
    for (int i = 0; i < SPINS; i++) {
        if (atomic_load_explicit(&pool->generation, memory_order_acquire) != seen)
            return seen + 1;
        pause_briefly();
    }
    pthread_mutex_lock(&pool->mutex);
    while (atomic_load_explicit(&pool->generation, memory_order_acquire) == seen)
        pthread_cond_wait(&pool->wake, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
    return seen + 1;
}

static int64_t now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

static void take_turn(lom_pool *pool, int number)
{
    pool->turns[number].begin = now();
    pool->work(pool->context, number);
    pool->turns[number].end = now();
}

/* Two are at work from when the second begins to when the last but one ends. */
static void count_shared(lom_pool *pool)
{
    int64_t first = INT64_MAX, second = INT64_MAX, last = INT64_MIN, last_but_one = INT64_MIN;
    for (int i = 0; i < pool->size; i++) {
        int64_t begin = pool->turns[i].begin, end = pool->turns[i].end;
        second = begin < first ? first : begin < second ? begin : second;
        first = begin < first ? begin : first;
        last_but_one = end > last ? last : end > last_but_one ? end : last_but_one;
        last = end > last ? end : last;
    }
    if (last_but_one > second)
        pool->shared += (uint64_t)(last_but_one - second);
}

static void *run_worker(void *argument)
{
    struct worker *worker = argument;
    lom_pool *pool = worker->pool;
    int number = worker->number;
    lom_release(worker);
    lom_float_state state;
    lom_enter_float_state(&state);
    for (unsigned seen = 0;;) {
        seen = wait_for_generation(pool, seen);
        if (pool->ending)
            return NULL;
        take_turn(pool, number);
        if (atomic_fetch_sub_explicit(&pool->running, 1, memory_order_acq_rel) == 1) {
            pthread_mutex_lock(&pool->mutex);
            pthread_cond_signal(&pool->finished);
            pthread_mutex_unlock(&pool->mutex);
        }
    }
}

static bool start_worker(lom_pool *pool, int number)
{
    struct worker *worker = lom_allocate(1, sizeof *worker, NULL);
    if (worker == NULL)
        return false;
    *worker = (struct worker){ pool, number };
    pthread_attr_t attributes;
    size_t stack;
    bool started = false;
    if (pthread_attr_init(&attributes) == 0) {
        started = pthread_attr_getstacksize(&attributes, &stack) == 0 &&
                  (stack >= worker_stack || pthread_attr_setstacksize(&attributes, worker_stack) == 0) &&
                  pthread_create(&pool->threads[number], &attributes, run_worker, worker) == 0;
        pthread_attr_destroy(&attributes);
    }
    if (!started)
        lom_release(worker);
    return started;
}

static void free_memory(lom_pool *pool)
{
    lom_release(pool->threads);
    lom_release(pool->turns);
    lom_release(pool);
}

lom_pool *lom_create_pool(int threads, lom_error *error)
{
    lom_pool *pool = lom_allocate(1, sizeof *pool, error);
    if (pool == NULL)
        return NULL;
    pool->threads = lom_allocate((size_t)threads, sizeof *pool->threads, error);
    pool->turns = lom_allocate((size_t)threads, sizeof *pool->turns, error);
    if (pool->threads == NULL || pool->turns == NULL) {
        free_memory(pool);
        return NULL;
    }
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->wake, NULL);
    pthread_cond_init(&pool->finished, NULL);
    pool->process = getpid();
    pool->size = 1;
    while (pool->size < threads && start_worker(pool, pool->size))
        pool->size++;
    return pool;
}

static void advance_generation(lom_pool *pool)
{
    pthread_mutex_lock(&pool->mutex);
    atomic_fetch_add_explicit(&pool->generation, 1, memory_order_release);
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
}

void lom_free_pool(lom_pool *pool)
{
    if (pool == NULL)
        return;
    if (pool->process == getpid()) {
        pool->ending = true;
        advance_generation(pool);
        for (int i = 1; i < pool->size; i++)
            pthread_join(pool->threads[i], NULL);
        pthread_cond_destroy(&pool->finished);
        pthread_cond_destroy(&pool->wake);
        pthread_mutex_destroy(&pool->mutex);
    }
    free_memory(pool);
}

uint64_t lom_pool_shared(const lom_pool *pool)
{
    return pool->shared;
}

int lom_pool_size(const lom_pool *pool)
{
    return pool->process == getpid() ? pool->size : 1;
}

static void wait_for_workers(lom_pool *pool)
{
    for (int i = 0; i < SPINS; i++) {
        if (atomic_load_explicit(&pool->running, memory_order_acquire) == 0)
            return;
        pause_briefly();
    }
    pthread_mutex_lock(&pool->mutex);
    while (atomic_load_explicit(&pool->running, memory_order_acquire) != 0)
        pthread_cond_wait(&pool->finished, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
}

void lom_run_pool(lom_pool *pool, lom_work *work, void *context)
{
    const int size = lom_pool_size(pool);
    if (size == 1) {
        work(context, 0);
        return;
    }
    pool->work = work;
    pool->context = context;
    atomic_store_explicit(&pool->running, size - 1, memory_order_relaxed);
    advance_generation(pool);
    take_turn(pool, 0);
    wait_for_workers(pool);
    count_shared(pool);
}
