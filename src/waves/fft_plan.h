/* What a transform runs on, shared by fft.c and its lanes.
 *
 * Decimation in frequency (Gentleman, Sande 1966): a stage of radix r splits blocks of M elements,
 *     y[p M/r + j] = exp(-2 pi i j p / M) sum over q of x[q M/r + j] exp(-2 pi i p q / r),
 * and the stages leave frequency p1 + r1 p2 + r1 r2 p3 ... at position p1 N/r1 + p2 N/(r1 r2) + ...: `order`. Elements
 * are vectors of LOM_LANES columns (or rows), so putting them in order where they are written costs nothing. The sign
 * +1 is that of -1 with real and imaginary parts exchanged, before and after. */
#ifndef LOM_WAVES_FFT_PLAN_H
#define LOM_WAVES_FFT_PLAN_H

#include "waves/fft.h"

/* Real rows y and y + LOM_FFT_PAIR share a transform, at every width: what shares one shares its rounding. */
enum { LOM_FFT_STAGES = 6, LOM_FFT_MAX = 4096, LOM_FFT_PAIR = 16 };

struct lom_fft_stage {
    int radix, block;   /* r, M */
    const float *turns; /* cos and -sin of 2 pi j p / M: [j][p - 1][2]; NULL for the last stage, which needs none */
};

struct lom_fft {
    int size, stage_count, workers;
    struct lom_fft_stage stage[LOM_FFT_STAGES];
    int *order;    /* frequency at a position */
    int *position; /* of a frequency */
    int *identity; /* 0, 1, 2 ... */
    float *turns;
    float *scratch; /* size * 16 * 2 floats a worker */
};

/* Planes of an array: element i of a vector is at re + i * pitch. */
struct lom_fft_planes {
    float *re, *im;
    size_t pitch;
};

/* One group of LOM_LANES columns or rows from `first` on, in place; of the rows `first` ..
 * `first` + 2 LOM_FFT_PAIR - 1 of half a spectrum whose columns are transformed, into real rows. */
typedef void lom_fft_group(const struct lom_fft *fft, struct lom_fft_planes square, size_t first, float *scratch);
typedef void lom_fft_real_group(const struct lom_fft *fft, struct lom_fft_planes half, size_t first, float *result,
                                float *scratch);

#define LOM_DECLARE_FFT(name, variant)                                                                                 \
    lom_fft_group lom_fft_columns_##variant, lom_fft_rows_##variant;                                                   \
    lom_fft_real_group lom_fft_real_rows_##variant;
LOM_EACH_VARIANT(LOM_DECLARE_FFT, )

#endif
