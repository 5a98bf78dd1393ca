/* The transforms agree with the definition in double for every size, keep energy and symmetry, undo one another, stand
 * extreme inputs, and give the same bytes on every device. */
#include "check.h"

#include "waves/fft_plan.h"

static const double pi = 3.141592653589793;

typedef struct square {
    int size;
    float *re, *im; /* planes of the transform */
    double *a, *b;  /* size x size, exact */
} square;

static square make_square(int size)
{
    size_t n = (size_t)size, plane = lom_fft_rows(size) * lom_fft_pitch(size);
    return (square){ size, lom_allocate(plane, 4, NULL), lom_allocate(plane, 4, NULL), lom_allocate(n * n, 8, NULL),
                     lom_allocate(n * n, 8, NULL) };
}

static void free_square(square *s)
{
    lom_release(s->re);
    lom_release(s->im);
    lom_release(s->a);
    lom_release(s->b);
}

static void put(square *s, int x, int y, float re, float im)
{
    s->re[(size_t)y * lom_fft_pitch(s->size) + (size_t)x] = re;
    s->im[(size_t)y * lom_fft_pitch(s->size) + (size_t)x] = im;
    s->a[(size_t)y * (size_t)s->size + (size_t)x] = re;
    s->b[(size_t)y * (size_t)s->size + (size_t)x] = im;
}

static void fill_random(square *s, uint64_t seed)
{
    for (int y = 0; y < s->size; y++)
        for (int x = 0; x < s->size; x++) {
            double normal[2];
            lom_random_normal(seed, (uint64_t)(y * s->size + x), normal);
            put(s, x, y, (float)normal[0], (float)normal[1]);
        }
}

/* exp(2 pi i j / n) of the last n asked for. */
static const double (*turns_of(int n))[2]
{
    static double turns[4096][2];
    static int filled;
    for (int j = 0; j < n && filled != n; j++) {
        turns[j][0] = lom_double_cos(2 * pi * j / n);
        turns[j][1] = lom_double_sin(2 * pi * j / n);
    }
    filled = n;
    return (const double(*)[2])turns;
}

/* A line of n values `step` apart by the definition. */
static void define_line(double *a, double *b, size_t step, int n, int sign, double *re, double *im)
{
    const double(*turn)[2] = turns_of(n);
    for (int k = 0; k < n; k++)
        for (int i = 0; i < n; i++) {
            const double *t = turn[i * k % n];
            double x = a[(size_t)i * step], y = b[(size_t)i * step];
            re[k] += x * t[0] - sign * y * t[1];
            im[k] += sign * x * t[1] + y * t[0];
        }
}

/* By the definition up to 64; larger ones by halves (Danielson, Lanczos 1942). */
static void exact_line(double *a, double *b, size_t step, int n, int sign)
{
    double *re = lom_allocate((size_t)n, 8, NULL), *im = lom_allocate((size_t)n, 8, NULL);
    if (n <= 64) {
        define_line(a, b, step, n, sign, re, im);
    } else {
        exact_line(a, b, 2 * step, n / 2, sign);
        exact_line(a + step, b + step, 2 * step, n / 2, sign);
        const double(*turn)[2] = turns_of(n);
        for (int k = 0; k < n / 2; k++) {
            double c = turn[k][0], s = sign * turn[k][1];
            size_t even = 2 * (size_t)k * step, odd = even + step;
            double x = a[odd] * c - b[odd] * s, y = a[odd] * s + b[odd] * c;
            re[k] = a[even] + x;
            im[k] = b[even] + y;
            re[k + n / 2] = a[even] - x;
            im[k + n / 2] = b[even] - y;
        }
    }
    for (int k = 0; k < n; k++) {
        a[(size_t)k * step] = re[k];
        b[(size_t)k * step] = im[k];
    }
    lom_release(re);
    lom_release(im);
}

static void exact_square(square *s, int sign)
{
    size_t n = (size_t)s->size;
    for (size_t i = 0; i < n; i++)
        exact_line(s->a + i * n, s->b + i * n, 1, s->size, sign);
    for (size_t i = 0; i < n; i++)
        exact_line(s->a + i, s->b + i, n, s->size, sign);
}

/* Root mean square of the difference over that of the exact square. */
static double relative_error(const square *s)
{
    double difference = 0, whole = 0;
    for (int y = 0; y < s->size; y++)
        for (int x = 0; x < s->size; x++) {
            size_t i = (size_t)y * lom_fft_pitch(s->size) + (size_t)x, j = (size_t)y * (size_t)s->size + (size_t)x;
            double re = s->re[i] - s->a[j], im = s->im[i] - s->b[j];
            difference += re * re + im * im;
            whole += s->a[j] * s->a[j] + s->b[j] * s->b[j];
        }
    return lom_double_sqrt(difference / whole);
}

static lom_device *open(int threads, int lanes, bool plain)
{
    return lom_open_device(&(lom_device_desc){ .threads = threads, .lanes = lanes, .plain = plain });
}

static void check_size(lom_device *device, int size)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        square s = make_square(size);
        lom_fft *fft = lom_create_fft(size, device, NULL);
        fill_random(&s, (uint64_t)size);
        lom_transform_square(fft, device, sign, s.re, s.im);
        exact_square(&s, sign);
        double bound = 0x1p-24 * lom_double_sqrt(2 * lom_double_log2(size)), error = relative_error(&s);
        CHECK(error <= bound, "size %d, sign %d: %g above %g", size, sign, error, bound);
        lom_free_fft(fft);
        free_square(&s);
    }
}

static void f1_every_small_size_is_the_definition(void)
{
    lom_device *device = open(1, 0, false);
    for (int size = 2; size <= 64; size *= 2)
        check_size(device, size);
    lom_close_device(device);
}

static void f1_large_sizes_keep_the_bound(void)
{
    lom_device *device = open(2, 0, false);
    int largest = getenv("LOM_EXHAUSTIVE") != NULL ? 4096 : 512;
    for (int size = 128; size <= largest; size *= 2)
        check_size(device, size);
    lom_close_device(device);
}

static double energy(const square *s)
{
    double sum = 0;
    for (int y = 0; y < s->size; y++)
        for (int x = 0; x < s->size; x++) {
            size_t i = (size_t)y * lom_fft_pitch(s->size) + (size_t)x;
            sum += (double)s->re[i] * s->re[i] + (double)s->im[i] * s->im[i];
        }
    return sum;
}

static void f3_parseval_and_f6_round_trip(void)
{
    lom_device *device = open(1, 0, false);
    for (int size = 2; size <= 256; size *= 2) {
        square s = make_square(size);
        lom_fft *fft = lom_create_fft(size, device, NULL);
        fill_random(&s, 5);
        double before = energy(&s), area = (double)size * size, bound = 8 * 0x1p-24 * 2 * lom_double_log2(size);
        lom_transform_square(fft, device, -1, s.re, s.im);
        double ratio = energy(&s) / area / before - 1;
        CHECK(ratio < bound && -ratio < bound, "size %d: energy off by %g", size, ratio);
        lom_transform_square(fft, device, 1, s.re, s.im);
        for (size_t i = 0; i < (size_t)size * (size_t)size; i++) {
            s.a[i] *= area;
            s.b[i] *= area;
        }
        CHECK(relative_error(&s) < bound, "size %d: back and forth is off by %g", size, relative_error(&s));
        lom_free_fft(fft);
        free_square(&s);
    }
    lom_close_device(device);
}

/* Half of a random Hermitian spectrum, and the whole of it in s. */
static void fill_hermitian(square *s, float *half_re, float *half_im)
{
    int n = s->size;
    size_t pitch = lom_fft_pitch(n / 2);
    fill_random(s, 9);
    for (int y = 0; y < n; y++)
        for (int x = 0; x <= n / 2; x++) {
            int my = (n - y) % n, mx = (n - x) % n;
            size_t i = (size_t)y * (size_t)n + (size_t)x;
            if (x == mx && y == my)
                put(s, x, y, (float)s->a[i], 0);
            else
                put(s, mx, my, (float)s->a[i], (float)-s->b[i]);
        }
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n / 2; x++) {
            size_t i = (size_t)y * (size_t)n + (size_t)x, middle = (size_t)y * (size_t)n + (size_t)n / 2;
            half_re[(size_t)y * pitch + (size_t)x] = (float)(x == 0 ? s->a[i] - s->b[middle] : s->a[i]);
            half_im[(size_t)y * pitch + (size_t)x] = (float)(x == 0 ? s->b[i] + s->a[middle] : s->b[i]);
        }
}

static void f4_hermitian_spectrum_gives_a_real_square(void)
{
    lom_device *device = open(1, 0, false);
    for (int size = 4; size <= 256; size *= 2) {
        square s = make_square(size);
        lom_fft *fft = lom_create_fft(size, device, NULL);
        size_t half = lom_fft_rows(size) * lom_fft_pitch(size / 2);
        float *re = lom_allocate(half, 4, NULL), *im = lom_allocate(half, 4, NULL);
        fill_hermitian(&s, re, im);
        exact_square(&s, 1);
        double imaginary = 0, bound = 0x1p-24 * lom_double_sqrt(2 * lom_double_log2(size));
        lom_transform_square(fft, device, 1, s.re, s.im);
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) {
                double v = s.im[(size_t)y * lom_fft_pitch(size) + (size_t)x];
                imaginary += v * v / size / size;
            }
        imaginary = lom_double_sqrt(imaginary / (energy(&s) / size / size));
        CHECK(imaginary <= 4 * 0x1p-24 * 2 * lom_double_log2(size), "size %d: %g is not real", size, imaginary);
        memset(s.im, 0, lom_fft_rows(size) * lom_fft_pitch(size) * 4);
        lom_transform_hermitian(fft, device, re, im, s.re);
        CHECK(relative_error(&s) <= bound, "size %d: %g above %g", size, relative_error(&s), bound);
        lom_release(re);
        lom_release(im);
        lom_free_fft(fft);
        free_square(&s);
    }
    lom_close_device(device);
}

/* Impulse, constant, Nyquist, zeros, denormals, huge values: all known exactly. */
static void f5_simple_inputs_are_exact(void)
{
    enum { N = 64 };
    lom_device *device = open(1, 0, false);
    lom_fft *fft = lom_create_fft(N, device, NULL);
    static const float scales[] = { 0, 1, 0x1p-149f, 0x1p-126f, 1e30f };
    for (int k = 0; k < 5; k++)
        for (int kind = 0; kind < 3; kind++) {
            square s = make_square(N);
            float v = scales[k], expected = kind == 0 ? v : v * N * N;
            for (int y = 0; y < N; y++)
                for (int x = 0; x < N; x++)
                    put(&s, x, y, kind == 0 ? (x + y == 0 ? v : 0) : kind == 1 || (x + y) % 2 == 0 ? v : -v, 0);
            lom_transform_square(fft, device, -1, s.re, s.im);
            int peak = kind == 1 ? 0 : N / 2;
            for (int y = 0; y < N; y++)
                for (int x = 0; x < N; x++) {
                    size_t i = (size_t)y * lom_fft_pitch(N) + (size_t)x;
                    float wanted = kind == 0 || (x == peak && y == peak) ? expected : 0;
                    CHECK(s.re[i] == wanted && s.im[i] == 0, "scale %g, kind %d, (%d, %d): %g %g", v, kind, x, y,
                          s.re[i], s.im[i]);
                }
            free_square(&s);
        }
    lom_free_fft(fft);
    lom_close_device(device);
}

static uint64_t hash_plane(uint64_t hash, const float *plane, int size)
{
    for (int y = 0; y < size; y++)
        hash = lom_hash_bytes(hash, plane + (size_t)y * lom_fft_pitch(size), (size_t)size * 4);
    return hash;
}

static uint64_t hash_on(int threads, int lanes, bool plain, int size)
{
    lom_error error = { 0 };
    lom_device *device = open(threads, lanes, plain);
    lom_fft *fft = lom_create_fft(size, device, &error);
    CHECK(fft != NULL, "%s", error.text);
    if (fft == NULL) {
        lom_close_device(device);
        return 0;
    }
    square s = make_square(size);
    fill_random(&s, 77);
    lom_transform_square(fft, device, 1, s.re, s.im);
    uint64_t hash = hash_plane(hash_plane(LOM_HASH_START, s.re, size), s.im, size);
    if (size >= 4) {
        size_t half = lom_fft_rows(size) * lom_fft_pitch(size / 2);
        float *re = lom_allocate(half, 4, NULL), *im = lom_allocate(half, 4, NULL);
        fill_hermitian(&s, re, im);
        lom_transform_hermitian(fft, device, re, im, s.re);
        hash = hash_plane(hash, s.re, size);
        lom_release(re);
        lom_release(im);
    }
    lom_free_fft(fft);
    free_square(&s);
    lom_close_device(device);
    return hash;
}

/* Every table entry is the float next to the exact one, however far round: nothing is carried from entry to entry. */
static void f2_every_turn_is_rounded_once(void)
{
    const double two_pi = 6.283185307179586, half_ulp = 1.0 / (1 << 25);
    lom_device *device = open(1, 0, false);
    for (int size = 2; size <= LOM_FFT_MAX; size *= 2) {
        lom_fft *fft = lom_create_fft(size, device, NULL);
        for (int s = 0; s + 1 < fft->stage_count; s++) {
            const struct lom_fft_stage *stage = &fft->stage[s];
            const float *turn = stage->turns;
            for (int j = 0; j < stage->block / stage->radix; j++)
                for (int p = 1; p < stage->radix; p++, turn += 2) {
                    double angle = two_pi * (j * p % stage->block) / stage->block;
                    double re = (double)turn[0] - lom_double_cos(angle), im = (double)turn[1] + lom_double_sin(angle);
                    CHECK(re <= half_ulp && -re <= half_ulp && im <= half_ulp && -im <= half_ulp,
                          "size %d, stage %d, turn %d of %d: off by %g, %g", size, s, j * p, stage->block, re, im);
                }
        }
        lom_free_fft(fft);
    }
    lom_close_device(device);
}

static void every_device_gives_the_same_bytes(void)
{
    for (int size = 2; size <= 128; size *= 2) {
        uint64_t first = hash_on(1, 4, false, size);
        for (int threads = 1; threads <= 3; threads++)
            for (int lanes = 4; lanes <= 16; lanes *= 2)
                for (int plain = 0; plain < 2; plain++)
                    CHECK(hash_on(threads, lanes, plain != 0, size) == first, "size %d, %d threads, %d lanes", size,
                          threads, lanes);
    }
}

static void other_sizes_are_refused(void)
{
    static const int sizes[] = { -8, 0, 1, 3, 96, 8192 };
    lom_device *device = open(1, 0, false);
    for (int i = 0; i < 6; i++) {
        lom_error error = { 0 };
        CHECK(lom_create_fft(sizes[i], device, &error) == NULL && error.code == LOM_ERROR_USAGE, "size %d", sizes[i]);
    }
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(f1_every_small_size_is_the_definition);
    RUN(f1_large_sizes_keep_the_bound);
    RUN(f2_every_turn_is_rounded_once);
    RUN(f3_parseval_and_f6_round_trip);
    RUN(f4_hermitian_spectrum_gives_a_real_square);
    RUN(f5_simple_inputs_are_exact);
    RUN(every_device_gives_the_same_bytes);
    RUN(other_sizes_are_refused);
    return check_result();
}
