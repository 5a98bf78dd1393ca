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
    bool by_bytes; /* both pictures are of one format, whose samples are bytes */
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

/* ---- bytes: the same row by whole numbers, which are exact ---- */

/* deltas[i] = |a[i] - b[i]|; the largest of them, and the sum of their squares. */
static int subtract_bytes(const uint8_t *a, const uint8_t *b, size_t count, uint8_t *deltas, uint64_t *squares)
{
    enum { BLOCK = 1 << 14 }; /* 2^14 times 255^2 is below 2^31 */
    uint8_t largest = 0;
    *squares = 0;
    for (size_t at = 0; at < count; at += BLOCK) {
        size_t end = count - at < BLOCK ? count : at + BLOCK;
        uint32_t sum = 0;
        for (size_t i = at; i < end; i++) {
            uint8_t delta = a[i] > b[i] ? (uint8_t)(a[i] - b[i]) : (uint8_t)(b[i] - a[i]);
            deltas[i] = delta;
            largest = delta > largest ? delta : largest;
            sum += (uint32_t)delta * delta;
        }
        *squares += sum;
    }
    return largest;
}

/* Alpha differs, too, and is no colour. */
static uint64_t alpha_squares(const uint8_t *deltas, int width, int channels)
{
    uint64_t sum = 0;
    for (int x = 0; x < width; x++) {
        uint32_t delta = deltas[(size_t)x * (size_t)channels + (size_t)channels - 1];
        sum += delta * delta;
    }
    return sum;
}

/* Pixels whose largest delta is above `least`: 1 to 4 channels, each with a loop of its own. */
static size_t count_above(const uint8_t *deltas, int width, int channels, int least)
{
    size_t count = 0;
    for (int x = 0; x < width; x++, deltas += channels) {
        bool above = deltas[0] > least;
        for (int c = 1; c < channels; c++)
            above |= deltas[c] > least;
        count += above;
    }
    return count;
}

static size_t count_pixels(const uint8_t *deltas, int width, int channels, int least)
{
    switch (channels) { /* a constant each, so that the loop within vanishes */
    case 1:
        return count_above(deltas, width, 1, least);
    case 2:
        return count_above(deltas, width, 2, least);
    case 3:
        return count_above(deltas, width, 3, least);
    default:
        return count_above(deltas, width, 4, least);
    }
}

/* What tally_row finds; deltas: room for the row's samples. */
static struct row tally_bytes(const lom_common_format *common, const uint8_t *a, const uint8_t *b, int width,
                              double tolerance, uint8_t *deltas)
{
    uint64_t squares;
    int channels = common->channels, largest;
    size_t count = (size_t)width * (size_t)channels, first = 0, last = count - 1;
    struct row row = { .left = -1 };
    largest = subtract_bytes(a, b, count, deltas, &squares);
    if (largest == 0)
        return row;
    if (channels > common->colors)
        squares -= alpha_squares(deltas, width, channels);
    while (deltas[first] == 0)
        first++;
    while (deltas[last] == 0)
        last--;
    const uint8_t *at = memchr(deltas, largest, count);
    row.squares = (double)squares;
    row.max_delta = largest;
    row.max_at = (int)((size_t)(at - deltas) / (size_t)channels);
    row.max_channel = (int)((size_t)(at - deltas) % (size_t)channels);
    row.left = (int)(first / (size_t)channels);
    row.right = (int)(last / (size_t)channels);
    row.pixels = count_pixels(deltas, width, channels, 0);
    row.above = count_pixels(deltas, width, channels, (int)lom_count_of(tolerance, UINT8_MAX));
    return row;
}

/* ---- rows of a band ---- */

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
        struct row *row = &tally->rows[(size_t)z * (size_t)a->height + (size_t)y];
        if (tally->by_bytes) {
            *row = tally_bytes(&tally->common, lom_image_pixel(a, 0, y, z), lom_image_pixel(b, 0, y, z), a->width,
                               tally->tolerance, (uint8_t *)samples);
            continue;
        }
        lom_read_common_row(a, &tally->common, y, z, samples);
        lom_read_common_row(b, &tally->common, y, z, samples + length);
        *row = tally_row(&tally->common, samples, samples + length, a->width, tally->tolerance);
    }
}

static bool are_bytes(const struct tally *tally)
{
    const lom_common_format *common = &tally->common;
    return tally->a->format == tally->b->format && !common->is_float && common->bits == 8 && tally->tolerance >= 0 &&
           lom_describe_format(tally->a->format)->channels == common->channels;
}

/* Fills tally->rows, which the caller frees. */
static bool tally_rows(lom_pool *pool, struct tally *tally, lom_error *error)
{
    const lom_image *a = tally->a;
    size_t length = (size_t)a->width * (size_t)tally->common.channels;
    tally->by_bytes = are_bytes(tally);
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
