/* Fourier transforms of squares of N x N samples, N a power of two in 2..4096, in float over lanes and threads; not
 * normalized: Y(u, v) = sum of X(n, m) exp(sign 2 pi i (n u + m v) / N).
 *
 * A square is two planes, real and imaginary parts, of lom_fft_rows(N) rows with lom_fft_pitch(N) floats from one row
 * to the next; what lies outside the square is undefined and changes nothing. The pitch is no power of two, so that a
 * column does not fall on a few sets of the cache. Error: root mean square at most 2^-24 sqrt(log2 N) of the result's.
 * The bytes are the same for every device. */
#ifndef LOM_WAVES_FFT_H
#define LOM_WAVES_FFT_H

#include <lom/pipeline.h>

typedef struct lom_fft lom_fft;

/* Tables for a size and scratch memory for the device's threads; NULL on failure. Serves one transform at a time. */
lom_fft *lom_create_fft(int size, const lom_device *device, lom_error *error);
void lom_free_fft(lom_fft *fft);
size_t lom_fft_pitch(int size);
size_t lom_fft_rows(int size);

/* In place; sign is -1 or 1. */
void lom_transform_square(lom_fft *fft, lom_device *device, int sign, float *real, float *imaginary);

/* The real square of a spectrum with X(-n, -m) = conj(X(n, m)), sign 1. Only columns n = 0 .. N/2 - 1 of the spectrum
 * are given, as N rows of lom_fft_pitch(N / 2) floats, N at least 4: column 0 holds X(0, m) + i X(N/2, m). The spectrum
 * is overwritten; the result is one plane of a square of size N. */
void lom_transform_hermitian(lom_fft *fft, lom_device *device, float *real, float *imaginary, float *result);

#endif
