/* FFTW (M. Frigo and S. Johnson: The design and implementation of FFTW3, 2005) in double as the witness of lom's
 * Fourier transforms. In: random squares of every size, impulses, Hermitian spectra. Proves the error of spec F1: root
 * mean square at most 2^-24 sqrt(log2 N) of the result's, and that Parseval's sums are FFTW's. Only make check-long
 * builds this. */
#include "waves/fft.h"

#include "check.h"

#include <fftw3.h>
#include <math.h>

typedef struct square {
    int size;
    size_t pitch;
    float *re, *im;
    fftw_complex *exact;
    fftw_plan forward, back;
} square;

static square make_square(int size)
{
    lom_error error = { 0 };
    size_t plane = lom_fft_rows(size) * lom_fft_pitch(size), count = (size_t)size * (size_t)size;
    square s = { .size = size, .pitch = lom_fft_pitch(size) };
    s.re = lom_allocate(plane, sizeof *s.re, &error);
    s.im = lom_allocate(plane, sizeof *s.im, &error);
    s.exact = fftw_malloc(count * sizeof *s.exact);
    s.forward = fftw_plan_dft_2d(size, size, s.exact, s.exact, FFTW_FORWARD, FFTW_ESTIMATE);
    s.back = fftw_plan_dft_2d(size, size, s.exact, s.exact, FFTW_BACKWARD, FFTW_ESTIMATE);
    return s;
}

static void free_square(square *s)
{
    fftw_destroy_plan(s->forward);
    fftw_destroy_plan(s->back);
    fftw_free(s->exact);
    lom_release(s->re);
    lom_release(s->im);
}

static void put(square *s, int x, int y, float re, float im)
{
    size_t i = (size_t)y * s->pitch + (size_t)x, e = (size_t)y * (size_t)s->size + (size_t)x;
    s->re[i] = re;
    s->im[i] = im;
    s->exact[e][0] = re;
    s->exact[e][1] = im;
}

static void fill(square *s, uint64_t key)
{
    for (int y = 0; y < s->size; y++)
        for (int x = 0; x < s->size; x++) {
            double pair[2];
            lom_random_normal(key, (uint64_t)y * (uint64_t)s->size + (uint64_t)x, pair);
            put(s, x, y, (float)pair[0], (float)pair[1]);
        }
}

/* Root mean square of the difference over that of FFTW's result; *ours, *theirs: the energies. */
static double relative_error(const square *s, double *ours, double *theirs)
{
    double difference = 0;
    *ours = *theirs = 0;
    for (int y = 0; y < s->size; y++)
        for (int x = 0; x < s->size; x++) {
            size_t i = (size_t)y * s->pitch + (size_t)x, e = (size_t)y * (size_t)s->size + (size_t)x;
            double re = s->re[i], im = s->im[i], dr = re - s->exact[e][0], di = im - s->exact[e][1];
            difference += dr * dr + di * di;
            *ours += re * re + im * im;
            *theirs += s->exact[e][0] * s->exact[e][0] + s->exact[e][1] * s->exact[e][1];
        }
    return sqrt(difference / *theirs);
}

static void check_square(lom_device *device, lom_fft *fft, square *s, int sign, const char *what)
{
    double ours, theirs, bound = 0x1p-24 * sqrt(log2(s->size));
    lom_transform_square(fft, device, sign, s->re, s->im);
    fftw_execute(sign < 0 ? s->forward : s->back);
    double error = relative_error(s, &ours, &theirs);
    CHECK(error <= bound, "%s of %d^2, sign %d: %g, more than %g", what, s->size, sign, error, bound);
    CHECK(fabs(ours / theirs - 1) <= 2 * bound, "%s of %d^2: energy %g, not %g", what, s->size, ours, theirs);
    if (sign < 0 && what[0] == 'n')
        printf("  %4d^2: %.2e, %.2f of the bound\n", s->size, error, error / bound);
}

static void squares_are_fftws(void)
{
    lom_error error = { 0 };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    for (int size = 2; size <= 2048; size *= 2) {
        square s = make_square(size);
        lom_fft *fft = lom_create_fft(size, device, &error);
        CHECK(fft != NULL && s.re != NULL && s.im != NULL, "%s", error.text);
        for (int sign = -1; fft != NULL && sign <= 1; sign += 2) {
            fill(&s, (uint64_t)size);
            check_square(device, fft, &s, sign, "noise");
            memset(s.re, 0, lom_fft_rows(size) * s.pitch * sizeof *s.re);
            memset(s.im, 0, lom_fft_rows(size) * s.pitch * sizeof *s.im);
            memset(s.exact, 0, (size_t)size * (size_t)size * sizeof *s.exact);
            put(&s, size - 1, size / 2, 1, -2);
            check_square(device, fft, &s, sign, "an impulse");
        }
        lom_free_fft(fft);
        free_square(&s);
    }
    lom_close_device(device);
}

/* What the sea does: half a Hermitian spectrum to a real square. */
static void real_squares_are_fftws(void)
{
    lom_error error = { 0 };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    for (int size = 4; size <= 1024; size *= 4) {
        square s = make_square(size);
        lom_fft *fft = lom_create_fft(size, device, &error);
        size_t pitch = lom_fft_pitch(size / 2), half = (size_t)size * pitch;
        float *re = lom_allocate(half, sizeof *re, &error), *im = lom_allocate(half, sizeof *im, &error);
        CHECK(fft != NULL && re != NULL && im != NULL, "%s", error.text);
        fill(&s, 77);
        fftw_execute(s.forward); /* of a real square it would be Hermitian, so make it one first */
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) {
                int my = (size - y) % size, mx = (size - x) % size;
                const size_t a = (size_t)(y * size + x), b = (size_t)(my * size + mx);
                if (a > b)
                    continue;
                double r = (s.exact[a][0] + s.exact[b][0]) / 2, i = (s.exact[a][1] - s.exact[b][1]) / 2;
                put(&s, mx, my, (float)r, (float)-i);
                put(&s, x, y, (float)r, a == b ? 0.0f : (float)i);
            }
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size / 2; x++) {
                size_t from = (size_t)y * s.pitch + (size_t)x, to = (size_t)y * pitch + (size_t)x;
                size_t last = (size_t)y * s.pitch + (size_t)size / 2;
                re[to] = x > 0 ? s.re[from] : s.re[from] - s.im[last]; /* X(0, m) + i X(N/2, m) */
                im[to] = x > 0 ? s.im[from] : s.im[from] + s.re[last];
            }
        lom_transform_hermitian(fft, device, re, im, s.re);
        memset(s.im, 0, lom_fft_rows(size) * s.pitch * sizeof *s.im);
        fftw_execute(s.back);
        double ours, theirs, bound = 0x1p-24 * sqrt(log2(size)), off = relative_error(&s, &ours, &theirs);
        CHECK(off <= bound, "a real square of %d^2: %g, more than %g", size, off, bound);
        printf("  real %4d^2: %.2e, %.2f of the bound\n", size, off, off / bound);
        lom_release(re);
        lom_release(im);
        lom_free_fft(fft);
        free_square(&s);
    }
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(squares_are_fftws);
    RUN(real_squares_are_fftws);
    return check_result();
}
