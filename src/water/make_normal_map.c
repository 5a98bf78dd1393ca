/* The water's normal map, and the flow map made from it. In: a size and a seed; out: RGB pictures that repeat without a
 * seam. Invariant: the surface is a finite sum of waves whose lengths divide the side of the picture, its slope is the
 * exact derivative of that sum, and nothing but rounding to 8 bits is lost. */
#include "base/numbers.h"
#include "base/range.h"
#include "geometry/noise.h"

#include <lom/water.h>

/* Waves have whole numbers of periods along both sides: wave numbers n, m in -PERIODS .. PERIODS. */
enum { PERIODS = 56, COUNT = 2 * PERIODS + 1 };

typedef struct wave {
    double real, imaginary;
} wave;

typedef struct ripples {
    int size;
    double *cosine;           /* of 2 pi i / size */
    wave (*slopes)[2][COUNT]; /* [x][along x, along y][m]: summed over n */
    wave (*spectrum)[COUNT];  /* [n][m] */
    double *slope[2];         /* size x size */
} ripples;

/* A directional spread about the wind, wide for short waves, that never quite vanishes: ripples from the shores cross
 * the wind's waves. The spectrum falls from a hump at 7 periods a side so slowly that all sizes show. */
static double amplitude(double n, double m)
{
    const double wind[2] = { 0.8, 0.6 };
    double k = lom_double_sqrt(n * n + m * m);
    if (k < 3 || k > PERIODS)
        return 0;
    double along = (n * wind[0] + m * wind[1]) / k;
    double spread = lom_mix_double(0.25, 0.5, k / PERIODS) + 0.75 * along * along;
    double hump = lom_smooth_step(2, 9, k);
    double tail = 1.0 - lom_smooth_step(0.6 * PERIODS, PERIODS, k);
    return spread * hump * tail / (k * k * lom_double_sqrt(lom_double_sqrt(k)));
}

static void fill_spectrum(ripples *s, uint64_t seed)
{
    for (int n = -PERIODS; n <= PERIODS; n++)
        for (int m = -PERIODS; m <= PERIODS; m++) {
            double normal[2];
            lom_random_normal(seed, (uint64_t)((n + PERIODS) * COUNT + m + PERIODS), normal);
            double a = amplitude(n, m);
            s->spectrum[n + PERIODS][m + PERIODS] = (wave){ a * normal[0], a * normal[1] };
        }
}

static wave turn(const ripples *s, int periods, int place)
{
    int step = (int)(((int64_t)periods * place % s->size + s->size) % s->size);
    return (wave){ s->cosine[step], s->cosine[(step + 3 * s->size / 4) % s->size] };
}

/* Real part of the sum over n and m of i (n, m) h(n, m) exp(2 pi i (n x + m y) / size), first over n, then over m. */
static void sum_waves(ripples *s)
{
    for (int x = 0; x < s->size; x++)
        for (int n = -PERIODS; n <= PERIODS; n++) {
            wave t = turn(s, n, x);
            for (int m = -PERIODS; m <= PERIODS; m++) {
                wave h = s->spectrum[n + PERIODS][m + PERIODS];
                wave along = { h.real * t.real - h.imaginary * t.imaginary,
                               h.real * t.imaginary + h.imaginary * t.real };
                wave *sum[2] = { &s->slopes[x][0][m + PERIODS], &s->slopes[x][1][m + PERIODS] };
                sum[0]->real -= n * along.imaginary;
                sum[0]->imaginary += n * along.real;
                sum[1]->real -= m * along.imaginary;
                sum[1]->imaginary += m * along.real;
            }
        }
    for (int y = 0; y < s->size; y++) {
        wave t[COUNT];
        for (int m = 0; m < COUNT; m++)
            t[m] = turn(s, m - PERIODS, y);
        for (int x = 0; x < s->size; x++)
            for (int axis = 0; axis < 2; axis++) {
                const wave *line = s->slopes[x][axis];
                double sum = 0;
                for (int m = 0; m < COUNT; m++)
                    sum += line[m].real * t[m].real - line[m].imaginary * t[m].imaginary;
                s->slope[axis][(size_t)y * (size_t)s->size + (size_t)x] = sum;
            }
    }
}

/* The factor that brings the root of the mean squared slope to `wanted`. */
static double slope_factor(const ripples *s, double wanted)
{
    size_t pixels = (size_t)s->size * (size_t)s->size;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++)
        sum += s->slope[0][i] * s->slope[0][i] + s->slope[1][i] * s->slope[1][i];
    return sum > 0 ? wanted / lom_double_sqrt(sum / (double)pixels) : 0;
}

/* Red and green are the horizontal components (x to the right, z down the picture), blue points up. */
static lom_image *paint_normals(const ripples *s, double roughness, lom_error *error)
{
    lom_image *map = lom_create_image(s->size, s->size, 1, LOM_FORMAT_RGB8, error);
    double factor = slope_factor(s, roughness);
    for (int y = 0; map != NULL && y < s->size; y++)
        for (int x = 0; x < s->size; x++) {
            size_t i = (size_t)y * (size_t)s->size + (size_t)x;
            double nx = -factor * s->slope[0][i];
            double nz = -factor * s->slope[1][i];
            double length = lom_double_sqrt(nx * nx + nz * nz + 1);
            uint8_t *pixel = lom_image_pixel(map, x, y, 0);
            pixel[0] = lom_unorm8_of_double(0.5 + 0.5 * nx / length);
            pixel[1] = lom_unorm8_of_double(0.5 + 0.5 * nz / length);
            pixel[2] = lom_unorm8_of_double(0.5 + 0.5 / length);
        }
    return map;
}

lom_image *lom_make_normal_map(const lom_normal_map_desc *desc, lom_error *error)
{
    static const lom_normal_map_desc defaults = { .size = 0 };
    desc = desc != NULL ? desc : &defaults;
    ripples s = { .size = desc->size != 0 ? desc->size : 512 };
    if (s.size < 128 || s.size > 4096 || s.size % 4 != 0) {
        lom_fail(error, LOM_ERROR_USAGE, "A normal map is made with a side of 128 to 4096, a multiple of 4, not %d.",
                 s.size);
        return NULL;
    }
    if (!lom_check_range(desc->roughness, 0, 1000, error, "The roughness of a normal map"))
        return NULL;
    size_t pixels = (size_t)s.size * (size_t)s.size;
    s.cosine = lom_allocate((size_t)s.size, sizeof *s.cosine, error);
    s.slopes = lom_allocate((size_t)s.size, sizeof *s.slopes, error);
    s.spectrum = lom_allocate(COUNT, sizeof *s.spectrum, error);
    s.slope[0] = lom_allocate(pixels, sizeof(double), error);
    s.slope[1] = lom_allocate(pixels, sizeof(double), error);
    lom_image *map = NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    if (s.cosine && s.slopes && s.spectrum && s.slope[0] && s.slope[1]) {
        for (int i = 0; i < s.size; i++)
            s.cosine[i] = lom_double_cos(lom_two_pi * i / s.size);
        fill_spectrum(&s, desc->seed);
        sum_waves(&s);
        map = paint_normals(&s, desc->roughness > 0 ? desc->roughness : 0.42, error);
    }
    lom_leave_float_state(&state);
    lom_release(s.cosine);
    lom_release(s.slopes);
    lom_release(s.spectrum);
    lom_release(s.slope[0]);
    lom_release(s.slope[1]);
    return map;
}

lom_image *lom_make_flow_map(const lom_image *normal_map, lom_error *error)
{
    lom_image *flow = lom_convert_image(normal_map, LOM_FORMAT_RGB8, error);
    if (flow == NULL)
        return NULL;
    lom_float_state state;
    lom_enter_float_state(&state);
    size_t samples = lom_image_size(flow);
    for (size_t i = 0; i < samples; i++)
        flow->pixels[i] = lom_unorm8_of_double(lom_smooth_step(0.2, 0.8, 1.0 - flow->pixels[i] / 255.0));
    lom_leave_float_state(&state);
    return flow;
}
