/* Complex Fourier transforms of squares in float, one thread, against FFTW's measured plan (M. Frigo and S. Johnson:
 * The design and implementation of FFTW3, 2005), in turn in one run: make bench-fft. FFTW transforms from one array
 * into another and in place; the faster counts. Out: a table of the fastest of many runs in processor time. */
#include "waves/fft.h"

#include <fftw3.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double time_fftw(fftwf_plan plan)
{
    double start = now_ms();
    fftwf_execute(plan);
    return now_ms() - start;
}

static void compare(lom_device *device, int size, int runs)
{
    lom_error error = { 0 };
    size_t count = (size_t)size * (size_t)size, plane = lom_fft_rows(size) * lom_fft_pitch(size);
    lom_fft *fft = lom_create_fft(size, device, &error);
    float *re = lom_allocate(plane, sizeof *re, &error), *im = lom_allocate(plane, sizeof *im, &error);
    fftwf_complex *from = fftwf_malloc(count * sizeof *from), *to = fftwf_malloc(count * sizeof *to);
    if (fft == NULL || re == NULL || im == NULL || from == NULL || to == NULL) {
        fprintf(stderr, "There is no memory for a square of %d.\n", size);
        return;
    }
    fftwf_plan apart = fftwf_plan_dft_2d(size, size, from, to, FFTW_FORWARD, FFTW_MEASURE);
    fftwf_plan in_place = fftwf_plan_dft_2d(size, size, from, from, FFTW_FORWARD, FFTW_MEASURE);
    memset(from, 0, count * sizeof *from); /* zeros stay zeros however often they are transformed */
    double ours = 1e30, theirs = 1e30;
    for (int run = 0; run < runs; run++) {
        double start = now_ms();
        lom_transform_square(fft, device, -1, re, im);
        ours = smaller(ours, now_ms() - start);
        theirs = smaller(theirs, smaller(time_fftw(apart), time_fftw(in_place)));
    }
    printf("| %d² | %.3f | %.3f | %.2f |\n", size, ours, theirs, theirs / ours);
    fftwf_destroy_plan(apart);
    fftwf_destroy_plan(in_place);
    fftwf_free(from);
    fftwf_free(to);
    lom_release(re);
    lom_release(im);
    lom_free_fft(fft);
}

int main(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    if (device == NULL)
        return 2;
    printf("| size | lom, ms (%d lanes) | %s, ms | FFTW's time over lom's |\n|---|---|---|---|\n",
           lom_describe_device(device).lanes, fftwf_version);
    compare(device, 256, 300);
    compare(device, 512, 150);
    compare(device, 1024, 60);
    lom_close_device(device);
    return 0;
}
