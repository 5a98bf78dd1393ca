/* Proves of portions: every number is handed out once, whatever the count, the workers, how many are asked for at once, and
 * who comes; who comes alone gets all of them; workers who take by turns get a portion each, from its begin on; and who has
 * none left takes from the end of another's. */
#include "base/portions.h"
#include "base/threads.h"

#include "check.h"

enum { MOST = 1000, WORKERS = 7 };

static lom_portion portions[WORKERS];

struct taken {
    atomic_int times[MOST];
    size_t count, most;
    int workers;
    atomic_int wrong;
};

static void take_all(void *context, int worker)
{
    struct taken *t = context;
    size_t first, taken;
    while ((taken = lom_take_portion(portions, t->workers, worker, t->most, &first)) > 0) {
        if (taken > t->most || first + taken > t->count)
            atomic_fetch_add(&t->wrong, 1);
        for (size_t i = first; i < first + taken && i < MOST; i++)
            atomic_fetch_add(&t->times[i], 1);
    }
}

static void check_once(const struct taken *t, const char *who)
{
    size_t once = 0;
    for (size_t i = 0; i < MOST; i++)
        once += (size_t)atomic_load(&t->times[i]) == (i < t->count);
    CHECK(once == MOST && atomic_load(&t->wrong) == 0, "%zu by %zu to %d workers, %s: %zu right, %d wrong", t->count,
          t->most, t->workers, who, once, atomic_load(&t->wrong));
}

static void every_number_is_handed_out_once(void)
{
    static const size_t counts[] = { 0, 1, 6, 7, 8, 240, 999, MOST }, most[] = { 1, 3, 64, 5000 };
    for (int workers = 1; workers <= WORKERS; workers += 2) {
        lom_pool *pool = lom_create_pool(workers, NULL);
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
            for (size_t m = 0; m < sizeof most / sizeof *most; m++) {
                struct taken all = { .count = counts[c], .most = most[m], .workers = workers }, one = all;
                lom_lay_portions(portions, workers, all.count);
                lom_offer_work(pool, take_all, &all);
                check_once(&all, "all of whom may come");
                lom_lay_portions(portions, workers, one.count);
                take_all(&one, workers - 1);
                check_once(&one, "of whom one comes");
            }
        lom_free_pool(pool);
    }
}

static void workers_have_portions_of_their_own(void)
{
    size_t first;
    for (int run = 0; run < 2; run++) {
        lom_lay_portions(portions, 3, 14);
        static const size_t begins[] = { 0, 5, 10 };
        for (size_t i = 0; i < 4; i++)
            for (int worker = 2; worker >= 0; worker--)
                CHECK(lom_take_portion(portions, 3, worker, 1, &first) == 1 && first == begins[worker] + i,
                      "worker %d: %zu at turn %zu", worker, first, i);
        CHECK(lom_take_portion(portions, 3, 2, 1, &first) == 1 && first == 4, "another's last: %zu", first);
        CHECK(lom_take_portion(portions, 3, 0, 3, &first) == 1 && first == 9, "another's last: %zu", first);
        CHECK(lom_take_portion(portions, 3, 1, 1, &first) == 0, "%zu is left", first);
    }
    lom_lay_portions(portions, 2, 20);
    CHECK(lom_take_portion(portions, 2, 1, 10, &first) == 10 && first == 10, "from %zu on", first);
    CHECK(lom_take_portion(portions, 2, 1, 4, &first) == 4 && first == 6, "from %zu on", first);
}

int main(int argc, char **argv)
{
    RUN(every_number_is_handed_out_once);
    RUN(workers_have_portions_of_their_own);
    return check_result();
}
