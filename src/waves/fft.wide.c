/* Transforms of LOM_LANES columns or rows at once. In: planes of a square; out: the same square with these columns or
 * rows transformed (sign -1). Invariant: the same operations on every element at every width. */
#include "waves/fft_plan.h"

#include "base/shuffle.h"

#include <lom/lanes.h>

typedef struct wave {
    lom_float re, im;
} wave;

LOM_INLINE wave plus(wave a, wave b)
{
    return (wave){ a.re + b.re, a.im + b.im };
}

LOM_INLINE wave minus(wave a, wave b)
{
    return (wave){ a.re - b.re, a.im - b.im };
}

/* -i x */
LOM_INLINE wave quarter(wave x)
{
    return (wave){ x.im, -x.re };
}

LOM_INLINE void transform_2(wave x[2])
{
    wave a = x[0], b = x[1];
    x[0] = plus(a, b);
    x[1] = minus(a, b);
}

LOM_INLINE void transform_4(wave x[4])
{
    wave a = plus(x[0], x[2]), b = minus(x[0], x[2]), c = plus(x[1], x[3]), d = quarter(minus(x[1], x[3]));
    x[0] = plus(a, c);
    x[1] = plus(b, d);
    x[2] = minus(a, c);
    x[3] = minus(b, d);
}

/* Even frequencies are the transform of x[q] + x[q + 4], odd ones of (x[q] - x[q + 4]) exp(-i pi q / 4). */
LOM_INLINE void transform_8(wave x[8])
{
    const float half = 0.70710678f; /* root of 1/2 */
    wave even[4], odd[4];
    for (int q = 0; q < 4; q++) {
        even[q] = plus(x[q], x[q + 4]);
        odd[q] = minus(x[q], x[q + 4]);
    }
    odd[1] = (wave){ (odd[1].re + odd[1].im) * half, (odd[1].im - odd[1].re) * half };
    odd[2] = quarter(odd[2]);
    odd[3] = (wave){ (odd[3].im - odd[3].re) * half, (odd[3].re + odd[3].im) * -half };
    transform_4(even);
    transform_4(odd);
    for (int p = 0; p < 4; p++) {
        x[2 * p] = even[p];
        x[2 * p + 1] = odd[p];
    }
}

LOM_INLINE void transform(wave *x, int radix)
{
    if (radix == 8)
        transform_8(x);
    else if (radix == 4)
        transform_4(x);
    else
        transform_2(x);
}

LOM_INLINE wave load(struct lom_fft_planes from, size_t i)
{
    return (wave){ lom_load(from.re + i * from.pitch), lom_load(from.im + i * from.pitch) };
}

LOM_INLINE void store(struct lom_fft_planes to, size_t i, wave x)
{
    lom_store(to.re + i * to.pitch, x.re);
    lom_store(to.im + i * to.pitch, x.im);
}

/* A stage with turns; `to` may be `from`. */
LOM_INLINE void run_inner(int size, int block, const float *turns, struct lom_fft_planes from, struct lom_fft_planes to,
                          int radix)
{
    size_t step = (size_t)(block / radix);
    for (size_t start = 0; start < (size_t)size; start += (size_t)block) {
        const float *turn = turns;
        for (size_t j = 0; j < step; j++) {
            wave x[8];
            for (int q = 0; q < radix; q++)
                x[q] = load(from, start + j + (size_t)q * step);
            transform(x, radix);
            store(to, start + j, x[0]);
            for (int p = 1; p < radix; p++) {
                wave y = { x[p].re * turn[0] - x[p].im * turn[1], x[p].re * turn[1] + x[p].im * turn[0] };
                store(to, start + j + (size_t)p * step, y);
                turn += 2;
            }
        }
    }
}

/* The last stage, whose blocks have `radix` elements; position i goes to place[i]. */
LOM_INLINE void run_last(int size, const int *place, struct lom_fft_planes from, struct lom_fft_planes to, int radix)
{
    for (size_t start = 0; start < (size_t)size; start += (size_t)radix) {
        wave x[8];
        for (int q = 0; q < radix; q++)
            x[q] = load(from, start + (size_t)q);
        transform(x, radix);
        for (int p = 0; p < radix; p++)
            store(to, (size_t)place[start + (size_t)p], x[p]);
    }
}

static void run_stage(const struct lom_fft *fft, int index, struct lom_fft_planes from, struct lom_fft_planes to)
{
    const struct lom_fft_stage *s = &fft->stage[index];
    if (index == fft->stage_count - 1) {
        if (s->radix == 8)
            run_last(fft->size, fft->order, from, to, 8);
        else if (s->radix == 4)
            run_last(fft->size, fft->order, from, to, 4);
        else
            run_last(fft->size, fft->order, from, to, 2);
    } else if (s->radix == 8) {
        run_inner(fft->size, s->block, s->turns, from, to, 8);
    } else {
        run_inner(fft->size, s->block, s->turns, from, to, 4);
    }
}

LOM_INLINE struct lom_fft_planes scratch_planes(const struct lom_fft *fft, float *scratch)
{
    return (struct lom_fft_planes){ scratch, scratch + (size_t)fft->size * LOM_LANES, LOM_LANES };
}

void LOM_WIDE(lom_fft_columns)(const struct lom_fft *fft, struct lom_fft_planes square, size_t first, float *scratch)
{
    struct lom_fft_planes columns = { square.re + first, square.im + first, square.pitch };
    struct lom_fft_planes inner = scratch_planes(fft, scratch);
    int last = fft->stage_count - 1;
    for (int i = 0; i <= last; i++)
        run_stage(fft, i, i == 0 ? columns : inner, i == last ? columns : inner);
}

/* ---- rows: turned into columns and back ---- */

#if LOM_LANES == 4
#define LOM_LOW  0, 4, 1, 5
#define LOM_HIGH 2, 6, 3, 7
#elif LOM_LANES == 8
#define LOM_LOW  0, 8, 1, 9, 2, 10, 3, 11
#define LOM_HIGH 4, 12, 5, 13, 6, 14, 7, 15
#else
#define LOM_LOW  0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23
#define LOM_HIGH 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31
#endif

/* Row i and row i + LOM_LANES / 2 become rows 2 i and 2 i + 1, lane by lane in turn: the bits of (row, lane) turn by
 * one place, and after log2 LOM_LANES times rows and lanes have changed places (H. Stone: Parallel processing with the
 * perfect shuffle, 1971). */
LOM_INLINE void transpose(lom_float row[LOM_LANES])
{
    for (int bit = 1; bit < LOM_LANES; bit *= 2) {
        lom_float next[LOM_LANES];
        for (int i = 0; i < LOM_LANES / 2; i++) {
            next[2 * i] = LOM_SHUFFLE(row[i], row[i + LOM_LANES / 2], lom_int, LOM_LOW);
            next[2 * i + 1] = LOM_SHUFFLE(row[i], row[i + LOM_LANES / 2], lom_int, LOM_HIGH);
        }
        for (int i = 0; i < LOM_LANES; i++)
            row[i] = next[i];
    }
}

LOM_INLINE void load_block(lom_float block[LOM_LANES], const float *from, size_t pitch)
{
    for (size_t i = 0; i < LOM_LANES; i++)
        block[i] = lom_load(from + i * pitch);
    transpose(block);
}

/* All stages but the last within scratch; the last as well, in place: element i stays at position i. */
LOM_INLINE void run_in_place(const struct lom_fft *fft, struct lom_fft_planes inner)
{
    for (int i = 0; i < fft->stage_count - 1; i++)
        run_stage(fft, i, inner, inner);
    int radix = fft->stage[fft->stage_count - 1].radix;
    if (radix == 8)
        run_last(fft->size, fft->identity, inner, inner, 8);
    else if (radix == 4)
        run_last(fft->size, fft->identity, inner, inner, 4);
    else
        run_last(fft->size, fft->identity, inner, inner, 2);
}

/* Frequencies of a plane of scratch as LOM_LANES rows. */
LOM_INLINE void write_rows(const struct lom_fft *fft, const float *inner, float *to, size_t pitch)
{
    for (size_t k = 0; k < (size_t)fft->size; k += LOM_LANES) {
        lom_float block[LOM_LANES];
        for (size_t i = 0; i < LOM_LANES; i++)
            block[i] = lom_load(inner + (size_t)fft->position[k + i] * LOM_LANES);
        transpose(block);
        for (size_t i = 0; i < LOM_LANES; i++)
            lom_store(to + i * pitch + k, block[i]);
    }
}

void LOM_WIDE(lom_fft_rows)(const struct lom_fft *fft, struct lom_fft_planes square, size_t first, float *scratch)
{
    struct lom_fft_planes inner = scratch_planes(fft, scratch);
    float *re = square.re + first * square.pitch, *im = square.im + first * square.pitch;
    for (size_t n = 0; n < (size_t)fft->size; n += LOM_LANES) {
        lom_float block[LOM_LANES];
        load_block(block, re + n, square.pitch);
        for (size_t i = 0; i < LOM_LANES; i++)
            lom_store(inner.re + (n + i) * LOM_LANES, block[i]);
        load_block(block, im + n, square.pitch);
        for (size_t i = 0; i < LOM_LANES; i++)
            lom_store(inner.im + (n + i) * LOM_LANES, block[i]);
    }
    run_in_place(fft, inner);
    write_rows(fft, inner.re, re, square.pitch);
    write_rows(fft, inner.im, im, square.pitch);
}

/* Two real rows in one complex transform: with spectra A and B of rows y and y + LOM_FFT_PAIR, G = A + i B at n and
 * conj(A) + i conj(B) at N - n; column 0 holds A(0) + i A(N/2). The sign is 1: parts are exchanged. */
static void run_pairs(const struct lom_fft *fft, struct lom_fft_planes half, size_t first, float *result,
                      float *scratch)
{
    struct lom_fft_planes inner = scratch_planes(fft, scratch), parts = { inner.im, inner.re, LOM_LANES };
    size_t middle = (size_t)fft->size / 2, pitch = half.pitch, below = LOM_FFT_PAIR * pitch;
    const float *re = half.re + first * pitch, *im = half.im + first * pitch;
    for (size_t n = 0; n < middle; n += LOM_LANES) {
        lom_float a_re[LOM_LANES], a_im[LOM_LANES], b_re[LOM_LANES], b_im[LOM_LANES];
        load_block(a_re, re + n, pitch);
        load_block(a_im, im + n, pitch);
        load_block(b_re, re + below + n, pitch);
        load_block(b_im, im + below + n, pitch);
        for (size_t i = 0; i < LOM_LANES && n + i < middle; i++) {
            size_t k = n + i;
            if (k == 0) {
                store(inner, 0, (wave){ a_re[i], b_re[i] });
                store(inner, middle, (wave){ a_im[i], b_im[i] });
            } else {
                store(inner, k, (wave){ a_re[i] - b_im[i], a_im[i] + b_re[i] });
                store(inner, (size_t)fft->size - k, (wave){ a_re[i] + b_im[i], b_re[i] - a_im[i] });
            }
        }
    }
    run_in_place(fft, parts);
    size_t out = lom_fft_pitch(fft->size);
    write_rows(fft, inner.re, result + first * out, out);
    write_rows(fft, inner.im, result + (first + LOM_FFT_PAIR) * out, out);
}

void LOM_WIDE(lom_fft_real_rows)(const struct lom_fft *fft, struct lom_fft_planes half, size_t first, float *result,
                                 float *scratch)
{
    for (size_t row = first; row < first + LOM_FFT_PAIR; row += LOM_LANES)
        run_pairs(fft, half, row, result, scratch);
}
