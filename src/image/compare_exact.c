/* The exact difference of two pictures. In: two images. Out: how many pixels differ, by how much, where, and the mean
 * squared difference of their colours. Invariant: equal rows are found by their bytes, all others sample by sample;
 * what is found in a row is put together from the top, so the result is one on every machine and number of threads.
 * Compiled for speed. */
#include "compare.h"

#include <string.h>

/* What differs in a row. */
struct row {
    size_t pixels, above;    /* with any difference, with one above the tolerance */
    double squares;          /* of the differences of colours */
    double max_delta;        /* 0: the row is equal, and what follows is not set */
    int left, right;         /* differing pixels, both included */
    int max_at, max_channel; /* the first place of max_delta */
};

struct tally {
    const lom_image *a, *b;
    lom_common_format common;
    double tolerance;
    double *samples; /* two rows a worker */
    struct row *rows;
};

static struct row tally_row(const lom_common_format *common, const double *a, const double *b, int width,
                            double tolerance)
{
    struct row row = { .left = -1 };
    for (int x = 0; x < width; x++, a += common->channels, b += common->channels) {
        double largest = 0;
        for (int c = 0; c < common->channels; c++) {
            double delta = lom_sample_delta(a[c], b[c]);
            if (c < common->colors)
                row.squares += delta * delta;
            largest = delta > largest ? delta : largest;
            if (delta > row.max_delta) {
                row.max_delta = delta;
                row.max_at = x;
                row.max_channel = c;
            }
        }
        if (largest == 0)
            continue;
        row.pixels++;
        row.above += largest > tolerance;
        row.left = row.left < 0 ? x : row.left;
        row.right = x;
    }
    return row;
}

static void tally_band(void *context, int worker, int z, int from, int to)
{
    struct tally *tally = context;
    const lom_image *a = tally->a, *b = tally->b;
    size_t bytes = (size_t)a->width * lom_format_size(a->format);
    size_t length = (size_t)a->width * (size_t)tally->common.channels;
    double *samples = tally->samples + 2 * length * (size_t)worker;
    for (int y = from; y < to; y++) {
        if (a->format == b->format && memcmp(lom_image_pixel(a, 0, y, z), lom_image_pixel(b, 0, y, z), bytes) == 0)
            continue;
        lom_read_common_row(a, &tally->common, y, z, samples);
        lom_read_common_row(b, &tally->common, y, z, samples + length);
        tally->rows[(size_t)z * (size_t)a->height + (size_t)y] =
            tally_row(&tally->common, samples, samples + length, a->width, tally->tolerance);
    }
}

/* Fills tally->rows, which the caller frees. */
static bool tally_rows(lom_pool *pool, struct tally *tally, lom_error *error)
{
    const lom_image *a = tally->a;
    size_t length = (size_t)a->width * (size_t)tally->common.channels;
    tally->rows = lom_allocate((size_t)a->height * (size_t)a->depth, sizeof *tally->rows, error);
    tally->samples = lom_allocate(2 * length * (size_t)lom_pool_size(pool), sizeof *tally->samples, error);
    bool good = tally->rows != NULL && tally->samples != NULL;
    if (good)
        lom_run_bands(pool, a->depth, a->height, tally_band, tally);
    lom_release(tally->samples);
    return good;
}

static void add_row(lom_comparison *result, const struct row *row, int y, int z)
{
    if (row->max_delta == 0)
        return;
    int *box = result->box; /* until finish: left, top, right, bottom */
    box[0] = result->pixels == 0 || row->left < box[0] ? row->left : box[0];
    box[1] = result->pixels == 0 || y < box[1] ? y : box[1];
    box[2] = row->right > box[2] ? row->right : box[2];
    box[3] = y > box[3] ? y : box[3];
    result->pixels += row->pixels;
    if (row->max_delta > result->max_delta) {
        result->max_delta = row->max_delta;
        result->max_channel = row->max_channel;
        result->max_at[0] = row->max_at;
        result->max_at[1] = y;
        result->max_at[2] = z;
    }
}

static void finish(const struct tally *tally, lom_comparison *result)
{
    const lom_image *a = tally->a;
    double squares = 0, peak = tally->common.peak;
    const struct row *row = tally->rows;
    for (int z = 0; z < a->depth; z++)
        for (int y = 0; y < a->height; y++, row++) {
            squares += row->squares;
            add_row(result, row, y, z);
        }
    result->identical = result->pixels == 0;
    if (!result->identical) {
        result->box[2] -= result->box[0] - 1;
        result->box[3] -= result->box[1] - 1;
    }
    double mean = squares / ((double)a->width * a->height * a->depth * tally->common.colors);
    result->rmse = __builtin_sqrt(mean);
    result->psnr = mean > 0 ? 10 * lom_double_log2(peak / mean * peak) / lom_double_log2(10) : __builtin_inf();
}

bool lom_compare_images_on(lom_pool *pool, const lom_image *a, const lom_image *b, lom_comparison *result,
                           lom_error *error)
{
    struct tally tally = { .a = a, .b = b };
    *result = (lom_comparison){ .same_size = false };
    if (!lom_find_common_format(a, b, &tally.common, error))
        return false;
    result->is_float = tally.common.is_float;
    result->channels = tally.common.channels;
    result->bits = tally.common.bits;
    result->same_size = lom_require_same_size(a, b, NULL);
    if (!result->same_size)
        return true;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool good = tally_rows(pool, &tally, error);
    if (good)
        finish(&tally, result);
    lom_leave_float_state(&state);
    lom_release(tally.rows);
    return good;
}

bool lom_compare_images(const lom_image *a, const lom_image *b, lom_comparison *result, lom_error *error)
{
    lom_pool *pool = lom_create_compare_pool(a, error);
    bool good = pool != NULL && lom_compare_images_on(pool, a, b, result, error);
    lom_free_pool(pool);
    return good;
}

bool lom_count_differing_pixels(const lom_image *a, const lom_image *b, double tolerance, size_t *pixels,
                                lom_error *error)
{
    struct tally tally = { .a = a, .b = b, .tolerance = tolerance };
    if (!lom_find_common_format(a, b, &tally.common, error) || !lom_require_same_size(a, b, error))
        return false;
    lom_pool *pool = lom_create_compare_pool(a, error);
    if (pool == NULL)
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool good = tally_rows(pool, &tally, error);
    *pixels = 0;
    for (size_t i = 0; good && i < (size_t)a->height * (size_t)a->depth; i++)
        *pixels += tally.rows[i].above;
    lom_leave_float_state(&state);
    lom_free_pool(pool);
    lom_release(tally.rows);
    return good;
}
