/* Structural similarity (Wang, Bovik, Sheikh, Simoncelli, IEEE TIP 13(4), 2004). In: two images of one size. Out: the
 * mean over all windows. Invariant: the five weighted moments of a window are formed in double in one fixed order, and
 * rows of windows are summed from the top whoever did them; equal pictures give exactly 1.
 *
 * The Gaussian is separable, so rows are filtered as they come and kept in a ring; a window's moments are a weighted
 * sum of WINDOW filtered rows. Compiled for speed. */
#include "compare.h"
#include "convert.h"

enum { WINDOW = 11, RADIUS = WINDOW / 2, MOMENTS = 5 };
static const double sigma = 1.5;

/* Where the i-th window of a side lies, and its weights, which sum to 1. */
struct window {
    int start, taps;
    double weight[WINDOW];
};

static int window_count(int side)
{
    return side >= WINDOW ? side - 2 * RADIUS : side;
}

static struct window find_window(int side, int index)
{
    int center = side >= WINDOW ? index + RADIUS : index;
    struct window window = { .start = center > RADIUS ? center - RADIUS : 0 };
    int end = center + RADIUS < side ? center + RADIUS + 1 : side;
    window.taps = end - window.start;
    double sum = 0;
    for (int k = 0; k < window.taps; k++) {
        double d = window.start + k - center;
        window.weight[k] = lom_double_exp(-d * d / (2 * sigma * sigma));
        sum += window.weight[k];
    }
    for (int k = 0; k < window.taps; k++)
        window.weight[k] /= sum;
    return window;
}

/* Luma in 0..1 of a row in the common format. */
static void luma_row(const lom_common_format *common, const double *row, int width, double *out)
{
    for (int x = 0; x < width; x++, row += common->channels) {
        double encoded[3];
        for (int c = 0; c < common->colors; c++) {
            double value = row[c] / common->peak;
            if (common->is_float) /* linear light */
                value = lom_srgb_encode_double(lom_unit_of(value));
            encoded[c] = value;
        }
        out[x] = common->colors == 3 ? 0.299 * encoded[0] + 0.587 * encoded[1] + 0.114 * encoded[2] : encoded[0];
    }
}

struct buffers {
    double *common[2], *luma[2], *product; /* a row each */
    double *moments[WINDOW][MOMENTS];      /* filtered rows: a, b, a a, b b, a b; row y in place y % WINDOW */
    double *column[MOMENTS];
};

/* The five moments of one row, filtered along it. */
static void filter_moments(struct buffers *buffers, int width, int y)
{
    const double *a = buffers->luma[0], *b = buffers->luma[1];
    const double *factors[MOMENTS][2] = { { a, NULL }, { b, NULL }, { a, a }, { b, b }, { a, b } };
    int count = window_count(width);
    struct window inside = find_window(WINDOW, 0);
    for (int m = 0; m < MOMENTS; m++) {
        const double *in = factors[m][0];
        if (factors[m][1] != NULL) {
            for (int x = 0; x < width; x++)
                buffers->product[x] = factors[m][0][x] * factors[m][1][x];
            in = buffers->product;
        }
        double *out = buffers->moments[y % WINDOW][m];
        if (width >= WINDOW) {
            lom_filter_row(in, count, inside.weight, WINDOW, out);
            continue;
        }
        for (int x = 0; x < count; x++) {
            struct window window = find_window(width, x);
            lom_filter_row(in + window.start, 1, window.weight, window.taps, &out[x]);
        }
    }
}

/* The sum of equation 13 over a row of windows. C1 = (K1 L)^2, C2 = (K2 L)^2 with L = 1. */
static double similarity_row(double *const *moments, int count)
{
    const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double sum = 0;
    for (int x = 0; x < count; x++) {
        double ma = moments[0][x], mb = moments[1][x];
        double va = moments[2][x] - ma * ma, vb = moments[3][x] - mb * mb, covariance = moments[4][x] - ma * mb;
        sum += (2 * (ma * mb) + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
    return sum;
}

struct similarity {
    const lom_image *images[2];
    lom_common_format common;
    struct buffers *buffers; /* of each worker */
    double *sums;            /* of each row of windows, slice after slice */
};

static void similarity_band(void *context, int worker, int z, int from, int to)
{
    struct similarity *work = context;
    struct buffers *buffers = &work->buffers[worker];
    int width = work->images[0]->width, height = work->images[0]->height;
    int columns = window_count(width), rows = window_count(height), next = find_window(height, from).start;
    for (int i = from; i < to; i++) {
        struct window window = find_window(height, i);
        for (; next < window.start + window.taps; next++) {
            for (int p = 0; p < 2; p++) {
                lom_read_common_row(work->images[p], &work->common, next, z, buffers->common[p]);
                luma_row(&work->common, buffers->common[p], width, buffers->luma[p]);
            }
            filter_moments(buffers, width, next);
        }
        for (int m = 0; m < MOMENTS; m++) {
            const double *taps[WINDOW];
            for (int k = 0; k < window.taps; k++)
                taps[k] = buffers->moments[(window.start + k) % WINDOW][m];
            lom_filter_column(taps, columns, window.weight, window.taps, buffers->column[m]);
        }
        work->sums[(size_t)z * (size_t)rows + (size_t)i] = similarity_row(buffers->column, columns);
    }
}

/* Points the rows of buffers into memory, and returns what lies behind them. */
static double *place_rows(struct buffers *buffers, const lom_common_format *common, size_t width, double *next)
{
    for (int p = 0; p < 2; p++, next += width * (size_t)common->channels)
        buffers->common[p] = next;
    for (int p = 0; p < 2; p++, next += width)
        buffers->luma[p] = next;
    buffers->product = next;
    for (int m = 0; m < MOMENTS; m++) {
        for (int k = 0; k < WINDOW; k++)
            buffers->moments[k][m] = next += width;
        buffers->column[m] = next += width;
    }
    return next + width;
}

/* Of the rows of each slice from the top, then of the slices. */
static double mean_similarity(const struct similarity *work)
{
    const lom_image *a = work->images[0];
    int columns = window_count(a->width), rows = window_count(a->height);
    const double *row = work->sums;
    double sum = 0;
    for (int z = 0; z < a->depth; z++) {
        double total = 0;
        for (int i = 0; i < rows; i++)
            total += *row++;
        sum += total / ((double)columns * rows);
    }
    return sum / a->depth;
}

bool lom_compare_ssim_on(lom_pool *pool, const lom_image *a, const lom_image *b, double *ssim, lom_error *error)
{
    struct similarity work = { .images = { a, b } };
    if (!lom_find_common_format(a, b, &work.common, error) || !lom_require_same_size(a, b, error))
        return false;
    size_t width = (size_t)a->width, workers = (size_t)lom_pool_size(pool);
    size_t rows = 2 * (size_t)work.common.channels + 3 + WINDOW * MOMENTS + MOMENTS;
    double *memory = lom_allocate(width * rows * workers, sizeof *memory, error);
    work.buffers = lom_allocate(workers, sizeof *work.buffers, error);
    work.sums = lom_allocate((size_t)window_count(a->height) * (size_t)a->depth, sizeof *work.sums, error);
    bool good = memory != NULL && work.buffers != NULL && work.sums != NULL;
    if (good) {
        double *next = memory;
        for (size_t i = 0; i < workers; i++)
            next = place_rows(&work.buffers[i], &work.common, width, next);
        lom_float_state state;
        lom_enter_float_state(&state);
        lom_run_bands(pool, a->depth, window_count(a->height), similarity_band, &work);
        *ssim = mean_similarity(&work);
        lom_leave_float_state(&state);
    }
    lom_release(work.sums);
    lom_release(work.buffers);
    lom_release(memory);
    return good;
}

bool lom_compare_ssim(const lom_image *a, const lom_image *b, double *ssim, lom_error *error)
{
    lom_pool *pool = lom_create_compare_pool(a, error);
    bool good = pool != NULL && lom_compare_ssim_on(pool, a, b, ssim, error);
    lom_free_pool(pool);
    return good;
}
