/* What the files compare_*.c share: two pictures seen in their common format, a row of doubles at a time, filters of
 * rows, and bands of rows on many threads. */
#ifndef LOM_IMAGE_COMPARE_H
#define LOM_IMAGE_COMPARE_H

#include "base/threads.h"

#include <lom/image.h>

typedef struct lom_common_format {
    int colors;    /* 1 or 3 */
    int channels;  /* colors, and 1 when there is an alpha, which comes last */
    int bits;      /* of the unsigned normalised samples; 32 for floats */
    bool is_float; /* linear light (or plain numbers), else steps 0 .. peak */
    double peak;   /* 2^bits - 1, or 1 */
} lom_common_format;

/* The format in which a and b are compared; false when one of them has none. */
bool lom_find_common_format(const lom_image *a, const lom_image *b, lom_common_format *common, lom_error *error);
/* False, with a message, unless the sizes of a and b agree. */
bool lom_require_same_size(const lom_image *a, const lom_image *b, lom_error *error);
/* Row y of slice z in the common format, width * channels doubles. */
void lom_read_common_row(const lom_image *image, const lom_common_format *common, int y, int z, double *out);

/* |a - b| with the rules of lom/image.h for what has no difference. */
static inline double lom_sample_delta(double a, double b)
{
    double delta = __builtin_fabs(a - b);
    if (__builtin_expect(delta >= 0, 1))
        return delta;
    return a == b || (__builtin_isnan(a) && __builtin_isnan(b)) ? 0 : __builtin_inf(); /* infinities, NaN */
}

/* IEC 61966-2-1, on [0, 1]. */
double lom_srgb_decode_double(double encoded);
double lom_srgb_encode_double(double linear);

/* out[x] = sum of weight[k] in[x + k] over k in [0, taps): in has width + taps - 1 elements. */
void lom_filter_row(const double *in, int width, const double *weight, int taps, double *out);
/* out[x] = sum of weight[k] rows[k][x] over k in [0, taps). */
void lom_filter_column(const double *const *rows, int width, const double *weight, int taps, double *out);

/* A pool of lom_default_threads() workers, or of fewer where the pictures are small. */
lom_pool *lom_create_compare_pool(const lom_image *image, lom_error *error);

/* Calls work(context, worker, z, from, to) for bands of rows that together are all rows 0 .. rows - 1 of all slices.
 * What is found must be kept for each row, and be put together from the top afterwards: then it depends neither on the
 * bands nor on who did them. */
typedef void lom_band_work(void *context, int worker, int z, int from, int to);
void lom_run_bands(lom_pool *pool, int slices, int rows, lom_band_work *work, void *context);

/* The public functions on a pool. */
bool lom_compare_images_on(lom_pool *pool, const lom_image *a, const lom_image *b, lom_comparison *result,
                           lom_error *error);
bool lom_compare_ssim_on(lom_pool *pool, const lom_image *a, const lom_image *b, double *ssim, lom_error *error);
bool lom_compare_flip_on(lom_pool *pool, const lom_image *a, const lom_image *b, double *flip, lom_error *error);

#endif
