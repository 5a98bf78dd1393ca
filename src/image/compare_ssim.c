/* Structural similarity (Wang, Bovik, Sheikh, Simoncelli, IEEE TIP 13(4), 2004). In: two images of one size. Out: the
 * mean over all windows. Invariant: the five weighted moments of a window are formed in double in one fixed order;
 * equal pictures give exactly 1.
 *
 * The Gaussian is separable, so rows are filtered as they come and kept in a ring; a window's moments are a weighted
 * sum of WINDOW filtered rows. */
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

static double slice_similarity(const lom_image *const images[2], const lom_common_format *common, int z,
                               struct buffers *buffers)
{
    int width = images[0]->width, height = images[0]->height, next = 0;
    int columns = window_count(width), rows = window_count(height);
    double total = 0;
    for (int i = 0; i < rows; i++) {
        struct window window = find_window(height, i);
        for (; next < window.start + window.taps; next++) {
            for (int p = 0; p < 2; p++) {
                lom_read_common_row(images[p], common, next, z, buffers->common[p]);
                luma_row(common, buffers->common[p], width, buffers->luma[p]);
            }
            filter_moments(buffers, width, next);
        }
        for (int m = 0; m < MOMENTS; m++) {
            const double *taps[WINDOW];
            for (int k = 0; k < window.taps; k++)
                taps[k] = buffers->moments[(window.start + k) % WINDOW][m];
            lom_filter_column(taps, columns, window.weight, window.taps, buffers->column[m]);
        }
        total += similarity_row(buffers->column, columns);
    }
    return total / ((double)columns * rows);
}

bool lom_compare_ssim(const lom_image *a, const lom_image *b, double *ssim, lom_error *error)
{
    lom_common_format common;
    if (!lom_find_common_format(a, b, &common, error) || !lom_require_same_size(a, b, error))
        return false;
    size_t width = (size_t)a->width;
    double *memory =
        lom_allocate(width * (2 * (size_t)common.channels + 3 + WINDOW * MOMENTS + MOMENTS), sizeof *memory, error);
    if (memory == NULL)
        return false;
    struct buffers buffers;
    double *next = memory;
    for (int p = 0; p < 2; p++, next += width * (size_t)common.channels)
        buffers.common[p] = next;
    for (int p = 0; p < 2; p++, next += width)
        buffers.luma[p] = next;
    buffers.product = next;
    for (int m = 0; m < MOMENTS; m++) {
        for (int k = 0; k < WINDOW; k++)
            buffers.moments[k][m] = next += width;
        buffers.column[m] = next += width;
    }
    const lom_image *images[2] = { a, b };
    lom_float_state state;
    lom_enter_float_state(&state);
    double sum = 0;
    for (int z = 0; z < a->depth; z++)
        sum += slice_similarity(images, &common, z, &buffers);
    *ssim = sum / a->depth;
    lom_leave_float_state(&state);
    lom_release(memory);
    return true;
}
