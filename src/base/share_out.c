/* Ranges of a count handed out to the workers of a pool by a counter. In: how many, and a function of a range. Out: its
 * effects for all of them. Invariant: pieces begin at multiples of their size, whoever takes them. */
#include "base/threads.h"

#include <stdatomic.h>

struct sharing {
    size_t count, piece;
    lom_range_work *work;
    void *context;
    atomic_size_t next;
};

static void take_pieces(void *context, int worker)
{
    struct sharing *s = context;
    (void)worker;
    for (;;) {
        size_t first = atomic_fetch_add_explicit(&s->next, s->piece, memory_order_relaxed);
        if (first >= s->count)
            return;
        s->work(s->context, first, s->count - first < s->piece ? s->count : first + s->piece);
    }
}

void lom_share_out(lom_pool *pool, size_t count, size_t piece, lom_range_work *work, void *context)
{
    struct sharing sharing = { .count = count, .piece = piece, .work = work, .context = context };
    if (count > piece)
        lom_offer_work(pool, take_pieces, &sharing);
    else if (count > 0)
        work(context, 0, count);
}
