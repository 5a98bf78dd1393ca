/* Proves of pools: a range is handed out whole, every number of it once, in pieces that begin at multiples of their
 * size, whatever the count, the piece and the workers; work that is run is run by every worker once; work that is offered is
 * done when the call ends, with nobody left at it, also where workers come late or not at all; the time that is counted as shared holds all of what two workers
 * spent together and never more than has passed; a pool of one shares none; a pool that is entered runs all workers, and one that
 * was left is the caller alone in a forked child. */
#include "base/threads.h"

#include "check.h"

#include <stdatomic.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST = 1000 };

struct taken {
    atomic_int times[MOST];
    size_t count, piece;
    atomic_int wrong;
};

static void take(void *context, size_t first, size_t end)
{
    struct taken *t = context;
    bool whole = end - first == t->piece || end == t->count;
    if (first % t->piece != 0 || first >= end || end > t->count || !whole)
        atomic_fetch_add(&t->wrong, 1);
    for (size_t i = first; i < end && i < MOST; i++)
        atomic_fetch_add(&t->times[i], 1);
}

static void every_number_is_taken_once(void)
{
    static const size_t counts[] = { 0, 1, 7, 8, 9, 64, 999, MOST }, pieces[] = { 1, 8, 64, 5000 };
    for (int threads = 1; threads <= 5; threads += 2) {
        lom_pool *pool = lom_create_pool(threads, NULL);
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
            for (size_t p = 0; p < sizeof pieces / sizeof *pieces; p++) {
                struct taken t = { .count = counts[c], .piece = pieces[p] };
                lom_share_out(pool, t.count, t.piece, take, &t);
                size_t once = 0;
                for (size_t i = 0; i < MOST; i++)
                    once += (size_t)atomic_load(&t.times[i]) == (i < t.count);
                CHECK(once == MOST && atomic_load(&t.wrong) == 0,
                      "%zu by %zu on %d threads: %zu right, %d wrong ranges", t.count, t.piece, threads, once,
                      atomic_load(&t.wrong));
            }
        lom_free_pool(pool);
    }
}

struct rounds {
    atomic_int left, inside, turns[8];
    atomic_int stray; /* at work while no work was offered */
    atomic_bool open;
    int done; /* the caller's to read, whoever wrote it last */
};

static void take_from_counter(void *context, int worker)
{
    struct rounds *r = context;
    atomic_fetch_add(&r->inside, 1);
    atomic_fetch_add(&r->turns[worker], 1);
    atomic_fetch_add(&r->stray, !atomic_load(&r->open));
    for (int i; (i = atomic_fetch_sub(&r->left, 1)) > 0;)
        if (i == 1)
            r->done++;
    atomic_fetch_sub(&r->inside, 1);
}

/* More workers than the machine has cores, and work of nearly no length: many come when it is over. */
static void offered_work_is_done_by_who_comes(void)
{
    enum { ROUNDS = 3000, THREADS = 8 };
    lom_pool *pool = lom_create_pool(THREADS, NULL);
    struct rounds r = { .done = 0 };
    int wrong = 0, before = 0;
    for (int i = 0; i < ROUNDS; i++) {
        atomic_store(&r.left, i % 50 + 1);
        atomic_store(&r.open, true);
        lom_offer_work(pool, take_from_counter, &r);
        wrong += atomic_load(&r.inside) != 0 || r.done != before + 1;
        before = r.done;
        atomic_store(&r.open, false);
    }
    CHECK(wrong == 0 && atomic_load(&r.stray) == 0 && atomic_load(&r.turns[0]) == ROUNDS,
          "%d of %d rounds ended early or undone, %d workers came to none, the caller to %d", wrong, ROUNDS,
          atomic_load(&r.stray), atomic_load(&r.turns[0]));
    for (int k = 1; k < THREADS; k++)
        CHECK(atomic_load(&r.turns[k]) <= ROUNDS, "worker %d: %d turns of %d", k, atomic_load(&r.turns[k]), ROUNDS);
    lom_free_pool(pool);
}

static void work_is_run_by_every_worker_once(void)
{
    enum { ROUNDS = 300, THREADS = 5 };
    lom_pool *pool = lom_create_pool(THREADS, NULL);
    int size = lom_pool_size(pool);
    struct rounds r = { .open = true };
    for (int i = 0; i < ROUNDS; i++) {
        lom_run_pool(pool, take_from_counter, &r);
        lom_offer_work(pool, take_from_counter, &(struct rounds){ .open = true });
        for (int k = 0; k < size; k++)
            CHECK(atomic_load(&r.turns[k]) == i + 1, "worker %d of %d, round %d: %d turns", k, size, i,
                  atomic_load(&r.turns[k]));
    }
    lom_free_pool(pool);
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

struct meeting {
    atomic_int arrived;
    int guests;
};

static const double together = 0.003;

/* Waits until all are here, then stays for a while. */
static void meet(void *context, int worker)
{
    struct meeting *m = context;
    (void)worker;
    atomic_fetch_add(&m->arrived, 1);
    while (atomic_load(&m->arrived) < m->guests)
        ;
    for (double until = seconds() + together; seconds() < until;)
        ;
}

static void shared_time_is_what_two_spend_together(void)
{
    for (int threads = 1; threads <= 3; threads++) {
        lom_pool *pool = lom_create_pool(threads, NULL);
        int size = lom_pool_size(pool);
        double begin = seconds(), shared = 0;
        for (int round = 1; round <= 3; round++) {
            struct meeting m = { .guests = size };
            lom_run_pool(pool, meet, &m);
            shared = (double)lom_pool_shared(pool) * 1e-9;
            CHECK(size == 1 ? shared == 0 : shared >= round * together, "%d workers, round %d: %g s", size, round,
                  shared);
        }
        CHECK(shared <= seconds() - begin, "%d workers: %g s in %g s", size, shared, seconds() - begin);
        lom_free_pool(pool);
    }
}

static void count_turn(void *context, int worker)
{
    (void)worker;
    atomic_fetch_add((atomic_int *)context, 1);
}

static void an_entered_pool_knows_its_process(void)
{
    lom_pool *pool = lom_create_pool(3, NULL);
    const int size = lom_pool_size(pool);
    atomic_int turns = 0;
    lom_enter_pool(pool);
    lom_enter_pool(pool);
    lom_run_pool(pool, count_turn, &turns);
    lom_leave_pool(pool);
    CHECK(lom_pool_size(pool) == size);
    lom_run_pool(pool, count_turn, &turns);
    lom_leave_pool(pool);
    CHECK(lom_pool_size(pool) == size && atomic_load(&turns) == 2 * size, "%d turns", atomic_load(&turns));
    const pid_t child = fork();
    if (child == 0) {
        lom_enter_pool(pool);
        _exit(lom_pool_size(pool));
    }
    int status = 0;
    CHECK(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 1,
          "the child has %d workers", WEXITSTATUS(status));
    lom_free_pool(pool);
}

int main(int argc, char **argv)
{
    RUN(every_number_is_taken_once);
    RUN(offered_work_is_done_by_who_comes);
    RUN(work_is_run_by_every_worker_once);
    RUN(shared_time_is_what_two_spend_together);
    RUN(an_entered_pool_knows_its_process);
    return check_result();
}
