/* What the files compare_*.c share: two pictures seen in their common format, a row of doubles at a time, and filters
 * of rows. */
#ifndef LOM_IMAGE_COMPARE_H
#define LOM_IMAGE_COMPARE_H

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

/* IEC 61966-2-1, on [0, 1]. */
double lom_srgb_decode_double(double encoded);
double lom_srgb_encode_double(double linear);

/* out[x] = sum of weight[k] in[x + k] over k in [0, taps): in has width + taps - 1 elements. */
void lom_filter_row(const double *in, int width, const double *weight, int taps, double *out);
/* out[x] = sum of weight[k] rows[k][x] over k in [0, taps). */
void lom_filter_column(const double *const *rows, int width, const double *weight, int taps, double *out);

#endif
