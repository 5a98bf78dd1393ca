/* Proves that what workers sort together is what insertion sorts: the farthest first, equally far things as they stood, in
 * lists of all lengths around those that are cut; with 1, 2 and 5 workers. */
#include "check.h"
#include "render/entities/order.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 9000 };

static struct lom_distant list[2 * MOST], sorted[MOST];

static int compare(const void *one, const void *other)
{
    const struct lom_distant *a = one, *b = other;
    return a->distance != b->distance ? (a->distance < b->distance ? 1 : -1) : a->number < b->number ? -1 : 1;
}

/* Of so many different distances. */
static void fill(size_t count, uint64_t distances)
{
    for (uint32_t i = 0; i < count; i++)
        list[i] = (struct lom_distant){ i, 7, (double)(lom_random_bits(3, i) % distances) };
    memcpy(sorted, list, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, compare);
}

static void check_lists(lom_device *device, int threads)
{
    static const size_t counts[] = { 0, 1, 2, 3, 1000, 2047, 2048, 2049, 4096, 5000, 6145, MOST };
    static const uint64_t distances[] = { 1, 5, 1000000 };
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        for (size_t k = 0; k < sizeof distances / sizeof *distances; k++) {
            fill(counts[i], distances[k]);
            const struct lom_distant *got = lom_sort_distant(device, list, counts[i]);
            CHECK(memcmp(got, sorted, counts[i] * sizeof *got) == 0, "%zu things, %d workers", counts[i], threads);
        }
}

static void workers_sort_as_one_does(void)
{
    static const int threads[] = { 1, 2, 5 };
    for (int i = 0; i < 3; i++) {
        lom_device *device = lom_open_device(&(lom_device_desc){ .threads = threads[i] });
        check_lists(device, threads[i]);
        lom_close_device(device);
    }
}

int main(int argc, char **argv)
{
    RUN(workers_sort_as_one_does);
    return check_result();
}
