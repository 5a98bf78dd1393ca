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

/* When a worker was last at work, nanoseconds, and in which run; a cache line each. */
struct turn {
    _Alignas(64) int64_t begin, end;
    uint32_t run;
};

/* The door to the work, one word, so that nobody comes to work that has ended: the number of the run, whether all workers
 * are counted from its beginning or each who comes, whether one may still come, whether the pool ends, and how many are at
 * work or expected. */
#define DOOR_RUN   32
#define DOOR_ALL   (UINT64_C(1) << 31)
#define DOOR_OPEN  (UINT64_C(1) << 30)
#define DOOR_ENDS  (UINT64_C(1) << 29)
#define DOOR_COUNT (DOOR_ENDS - 1)

struct lom_pool {
    pid_t process; /* that the workers belong to */
    int size;
    int entered, found; /* how often it is; the size of it then */
    pthread_t *threads;
    pthread_mutex_t mutex;
    pthread_cond_t wake, finished;
    _Atomic uint64_t door;
    lom_work *work;
    void *context;
    struct turn *turns;
    lom_portion *portions;
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

static uint32_t run_of(uint64_t door)
{
    return (uint32_t)(door >> DOOR_RUN);
}

static uint64_t look(lom_pool *pool)
{
    return atomic_load_explicit(&pool->door, memory_order_acquire);
}

/* The door of a run that is not the one that was seen. */
static uint64_t wait_for_run(lom_pool *pool, uint32_t seen)
{
    uint64_t door = look(pool);
    for (int i = 0; i < SPINS && run_of(door) == seen; i++, door = look(pool))
        pause_briefly();
    if (run_of(door) != seen)
        return door;
    pthread_mutex_lock(&pool->mutex);
    while (run_of(door = look(pool)) == seen)
        pthread_cond_wait(&pool->wake, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
    return door;
}

/* Whether a worker who saw this door takes part; the door may be that of a later run then. */
static bool enter(lom_pool *pool, uint64_t *door)
{
    while ((*door & DOOR_OPEN) != 0)
        if (atomic_compare_exchange_weak_explicit(&pool->door, door, *door + 1, memory_order_acq_rel,
                                                  memory_order_acquire))
            return true;
    return (*door & DOOR_ALL) != 0;
}

/* The caller waits for the last one, once the door is closed. */
static void leave(lom_pool *pool)
{
    uint64_t before = atomic_fetch_sub_explicit(&pool->door, 1, memory_order_acq_rel);
    if ((before & DOOR_COUNT) != 1 || (before & DOOR_OPEN) != 0)
        return;
    pthread_mutex_lock(&pool->mutex);
    pthread_cond_signal(&pool->finished);
    pthread_mutex_unlock(&pool->mutex);
}

static int64_t now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

static void take_turn(lom_pool *pool, int number, uint32_t run)
{
    struct turn *turn = &pool->turns[number];
    turn->run = run;
    turn->begin = now();
    pool->work(pool->context, number);
    turn->end = now();
}

/* Two are at work from when the second begins to when the last but one ends. */
static void count_shared(lom_pool *pool, uint32_t run)
{
    int64_t first = INT64_MAX, second = INT64_MAX, last = INT64_MIN, last_but_one = INT64_MIN;
    for (int i = 0; i < pool->size; i++) {
        if (pool->turns[i].run != run)
            continue;
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
    for (uint32_t seen = 0;;) {
        uint64_t door = wait_for_run(pool, seen);
        bool takes_part = enter(pool, &door);
        seen = run_of(door);
        if ((door & DOOR_ENDS) != 0)
            return NULL;
        if (takes_part) {
            take_turn(pool, number, seen);
            leave(pool);
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
    lom_release(pool->portions);
    lom_release(pool);
}

lom_pool *lom_create_pool(int threads, lom_error *error)
{
    lom_pool *pool = lom_allocate(1, sizeof *pool, error);
    if (pool == NULL)
        return NULL;
    pool->threads = lom_allocate((size_t)threads, sizeof *pool->threads, error);
    pool->turns = lom_allocate((size_t)threads, sizeof *pool->turns, error);
    pool->portions = lom_allocate((size_t)threads, sizeof *pool->portions, error);
    if (pool->threads == NULL || pool->turns == NULL || pool->portions == NULL) {
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

/* The next run, and its number; the work is there. */
static uint32_t begin_run(lom_pool *pool, uint64_t state)
{
    uint32_t run = run_of(atomic_load_explicit(&pool->door, memory_order_relaxed)) + 1;
    pthread_mutex_lock(&pool->mutex);
    atomic_store_explicit(&pool->door, (uint64_t)run << DOOR_RUN | state, memory_order_release);
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
    return run;
}

void lom_free_pool(lom_pool *pool)
{
    if (pool == NULL)
        return;
    if (pool->process == getpid()) {
        begin_run(pool, DOOR_ENDS);
        for (int i = 1; i < pool->size; i++)
            pthread_join(pool->threads[i], NULL);
        pthread_cond_destroy(&pool->finished);
        pthread_cond_destroy(&pool->wake);
        pthread_mutex_destroy(&pool->mutex);
    }
    free_memory(pool);
}

lom_portion *lom_pool_portions(lom_pool *pool)
{
    return pool->portions;
}

uint64_t lom_pool_shared(const lom_pool *pool)
{
    return pool->shared;
}

static int find_size(const lom_pool *pool)
{
    return pool->process == getpid() ? pool->size : 1;
}

int lom_pool_size(const lom_pool *pool)
{
    return pool->entered > 0 ? pool->found : find_size(pool);
}

void lom_enter_pool(lom_pool *pool)
{
    if (pool->entered++ == 0)
        pool->found = find_size(pool);
}

void lom_leave_pool(lom_pool *pool)
{
    pool->entered--;
}

static void wait_for_workers(lom_pool *pool)
{
    for (int i = 0; i < SPINS; i++) {
        if ((look(pool) & DOOR_COUNT) == 0)
            return;
        pause_briefly();
    }
    pthread_mutex_lock(&pool->mutex);
    while ((look(pool) & DOOR_COUNT) != 0)
        pthread_cond_wait(&pool->finished, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
}

static void run(lom_pool *pool, lom_work *work, void *context, uint64_t state)
{
    pool->work = work;
    pool->context = context;
    uint32_t number = begin_run(pool, state);
    take_turn(pool, 0, number);
    atomic_fetch_and_explicit(&pool->door, ~DOOR_OPEN, memory_order_acq_rel);
    wait_for_workers(pool);
    count_shared(pool, number);
}

void lom_run_pool(lom_pool *pool, lom_work *work, void *context)
{
    const int size = lom_pool_size(pool);
    if (size == 1)
        work(context, 0);
    else
        run(pool, work, context, DOOR_ALL | (uint64_t)(size - 1));
}

void lom_offer_work(lom_pool *pool, lom_work *work, void *context)
{
    if (lom_pool_size(pool) == 1)
        work(context, 0);
    else
        run(pool, work, context, DOOR_OPEN);
}
