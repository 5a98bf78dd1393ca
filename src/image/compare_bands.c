/* Rows of pictures on many threads. In: a pool and what to do with a band of rows. Out: its effects. Invariant: every
 * row is in one band, and no band in two slices. Compiled for speed. */
#include "compare.h"

#include <stdatomic.h>

/* A filter reads 10 rows on both sides of a band again, and a band that is not the last is waited for. */
enum { LEAST_ROWS = 32, BANDS_A_WORKER = 4, PIXELS_A_WORKER = 1 << 16 };

lom_pool *lom_create_compare_pool(const lom_image *image, lom_error *error)
{
    size_t worth = 1 + (size_t)image->width * (size_t)image->height * (size_t)image->depth / PIXELS_A_WORKER;
    int threads = lom_default_threads();
    return lom_create_pool((size_t)threads < worth ? threads : (int)worth, error);
}

struct bands {
    int slices, rows, height, per_slice;
    lom_band_work *work;
    void *context;
    atomic_llong next;
};

static void run_bands(void *context, int worker)
{
    struct bands *bands = context;
    long long count = (long long)bands->slices * bands->per_slice;
    for (long long i; (i = atomic_fetch_add(&bands->next, 1)) < count;) {
        int from = (int)(i % bands->per_slice) * bands->height;
        int to = bands->rows - from < bands->height ? bands->rows : from + bands->height;
        bands->work(bands->context, worker, (int)(i / bands->per_slice), from, to);
    }
}

void lom_run_bands(lom_pool *pool, int slices, int rows, lom_band_work *work, void *context)
{
    int height = rows / (BANDS_A_WORKER * lom_pool_size(pool));
    height = height < LEAST_ROWS ? LEAST_ROWS : height;
    struct bands bands = { .slices = slices,
                           .rows = rows,
                           .height = height,
                           .per_slice = (rows + height - 1) / height,
                           .work = work,
                           .context = context };
    lom_offer_work(pool, run_bands, &bands);
}
