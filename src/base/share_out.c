/* Ranges of a count handed out to the workers of a pool in portions. In: how many, and a function of a range. Out: its
 * effects for all of them. Invariant: pieces begin at multiples of their size, whoever takes them. */
#include "base/threads.h"

struct sharing {
    size_t count, piece;
    lom_range_work *work;
    void *context;
    lom_portion *portions;
    int workers;
};

static void take_pieces(void *context, int worker)
{
    const struct sharing *s = context;
    for (size_t i; lom_take_portion(s->portions, s->workers, worker, 1, &i) > 0;) {
        size_t first = i * s->piece;
        s->work(s->context, first, s->count - first < s->piece ? s->count : first + s->piece);
    }
}

void lom_share_out(lom_pool *pool, size_t count, size_t piece, lom_range_work *work, void *context)
{
    if (count > piece) {
        struct sharing sharing = { count, piece, work, context, lom_pool_portions(pool), lom_pool_size(pool) };
        lom_lay_portions(sharing.portions, sharing.workers, (count - 1) / piece + 1);
        lom_offer_work(pool, take_pieces, &sharing);
    } else if (count > 0)
        work(context, 0, count);
}
