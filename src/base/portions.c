/* Numbers handed out to workers. In: how many of each. Out: ranges. Invariant: every number is handed out once, whoever
 * comes, and whoever does not. */
#include "base/portions.h"

static uint64_t join(uint64_t first, uint64_t end)
{
    return end << 32 | first;
}

void lom_lay_portions(lom_portion *portions, int workers, size_t count)
{
    const uint64_t share = count / (size_t)workers, more = count % (size_t)workers;
    uint64_t first = 0;
    for (int i = 0; i < workers; i++) {
        uint64_t end = first + share + ((uint64_t)i < more);
        atomic_store_explicit(&portions[i].left, join(first, end), memory_order_relaxed);
        first = end;
    }
}

static size_t take(lom_portion *portion, size_t most, bool from_end, size_t *taken)
{
    uint64_t left = atomic_load_explicit(&portion->left, memory_order_relaxed), rest;
    size_t count;
    do {
        const uint64_t first = left & UINT32_MAX, end = left >> 32;
        count = end - first < most ? (size_t)(end - first) : most;
        *taken = (size_t)(from_end ? end - count : first);
        rest = from_end ? join(first, end - count) : join(first + count, end);
    } while (count > 0 && !atomic_compare_exchange_weak_explicit(&portion->left, &left, rest, memory_order_relaxed,
                                                                 memory_order_relaxed));
    return count;
}

size_t lom_take_portion(lom_portion *portions, int workers, int worker, size_t most, size_t *first)
{
    size_t count = take(&portions[worker], most, false, first);
    for (int i = 1; i < workers && count == 0; i++)
        count = take(&portions[(worker + i) % workers], most, true, first);
    return count;
}
