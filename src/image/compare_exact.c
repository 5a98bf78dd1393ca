/* The exact difference of two pictures. In: two images. Out: how many pixels differ, by how much, where, and the mean
 * squared difference of their colours. Invariant: equal rows are found by their bytes, all others sample by sample, and
 * sums are formed row by row from the top, so the result is one on every machine. */
#include "compare.h"

#include <string.h>

/* |a - b| with the rules of the header for what has no difference. */
static double sample_delta(double a, double b)
{
    if (a == b)
        return 0;
    bool nan_a = __builtin_isnan(a), nan_b = __builtin_isnan(b);
    if (nan_a || nan_b)
        return nan_a && nan_b ? 0 : __builtin_inf();
    return __builtin_fabs(a - b);
}

struct tally {
    lom_comparison *result;
    int left, top, right, bottom; /* of the differing pixels, both included */
    double squares;
};

static void tally_row(struct tally *tally, const lom_common_format *common, const double *a, const double *b, int width,
                      int y, int z)
{
    lom_comparison *result = tally->result;
    double squares = 0;
    for (int x = 0; x < width; x++, a += common->channels, b += common->channels) {
        bool differs = false;
        for (int c = 0; c < common->channels; c++) {
            double delta = sample_delta(a[c], b[c]);
            if (delta == 0)
                continue;
            differs = true;
            if (c < common->colors)
                squares += delta * delta;
            if (delta > result->max_delta) {
                result->max_delta = delta;
                result->max_channel = c;
                result->max_at[0] = x;
                result->max_at[1] = y;
                result->max_at[2] = z;
            }
        }
        if (!differs)
            continue;
        result->pixels++;
        tally->left = x < tally->left ? x : tally->left;
        tally->right = x > tally->right ? x : tally->right;
        tally->top = y < tally->top ? y : tally->top;
        tally->bottom = y > tally->bottom ? y : tally->bottom;
    }
    tally->squares += squares;
}

static void finish(struct tally *tally, const lom_common_format *common, const lom_image *a)
{
    lom_comparison *result = tally->result;
    double samples = (double)a->width * a->height * a->depth * common->colors;
    double mean = tally->squares / samples;
    result->identical = result->pixels == 0;
    if (!result->identical) {
        const int box[4] = { tally->left, tally->top, tally->right - tally->left + 1, tally->bottom - tally->top + 1 };
        memcpy(result->box, box, sizeof box);
    }
    result->rmse = __builtin_sqrt(mean);
    result->psnr =
        mean > 0 ? 10 * lom_double_log2(common->peak / mean * common->peak) / lom_double_log2(10) : __builtin_inf();
}

bool lom_compare_images(const lom_image *a, const lom_image *b, lom_comparison *result, lom_error *error)
{
    lom_common_format common;
    *result = (lom_comparison){ .same_size = false };
    if (!lom_find_common_format(a, b, &common, error))
        return false;
    result->is_float = common.is_float;
    result->channels = common.channels;
    result->bits = common.bits;
    result->same_size = lom_require_same_size(a, b, NULL);
    if (!result->same_size)
        return true;
    size_t row = (size_t)a->width * (size_t)common.channels;
    double *rows = lom_allocate(2 * row, sizeof *rows, error);
    if (rows == NULL)
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    struct tally tally = { .result = result, .left = a->width, .top = a->height, .right = -1, .bottom = -1 };
    size_t bytes = (size_t)a->width * lom_format_size(a->format);
    for (int z = 0; z < a->depth; z++)
        for (int y = 0; y < a->height; y++) {
            if (a->format == b->format && memcmp(lom_image_pixel(a, 0, y, z), lom_image_pixel(b, 0, y, z), bytes) == 0)
                continue;
            lom_read_common_row(a, &common, y, z, rows);
            lom_read_common_row(b, &common, y, z, rows + row);
            tally_row(&tally, &common, rows, rows + row, a->width, y, z);
        }
    finish(&tally, &common, a);
    lom_leave_float_state(&state);
    lom_release(rows);
    return true;
}

/* Black for equal samples; else 64 and more, by the square root, so that the least difference can be seen. */
static uint8_t shade(double a, double b, double peak)
{
    double delta = sample_delta(a, b) / peak;
    if (delta == 0)
        return 0;
    return (uint8_t)(64 + 191 * __builtin_sqrt(delta < 1 ? delta : 1) + 0.5);
}

lom_image *lom_compare_picture(const lom_image *a, const lom_image *b, lom_error *error)
{
    lom_common_format common;
    if (!lom_find_common_format(a, b, &common, error) || !lom_require_same_size(a, b, error))
        return NULL;
    size_t row = (size_t)a->width * (size_t)common.channels;
    double *rows = lom_allocate(2 * row, sizeof *rows, error);
    lom_image *picture = lom_create_image(a->width, a->height, a->depth, LOM_FORMAT_RGB8, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    for (int z = 0; rows != NULL && picture != NULL && z < a->depth; z++)
        for (int y = 0; y < a->height; y++) {
            lom_read_common_row(a, &common, y, z, rows);
            lom_read_common_row(b, &common, y, z, rows + row);
            uint8_t *out = lom_image_pixel(picture, 0, y, z);
            for (size_t i = 0; i < row; i += (size_t)common.channels, out += 3) {
                uint8_t alpha = 0;
                if (common.channels > common.colors)
                    alpha = shade(rows[i + (size_t)common.colors], rows[row + i + (size_t)common.colors], common.peak);
                for (int c = 0; c < 3; c++) {
                    size_t at = i + (size_t)(common.colors == 3 ? c : 0);
                    uint8_t color = shade(rows[at], rows[row + at], common.peak);
                    out[c] = color > alpha ? color : alpha;
                }
            }
        }
    lom_leave_float_state(&state);
    lom_release(rows);
    if (rows == NULL) {
        lom_free_image(picture);
        return NULL;
    }
    return picture;
}
