/* Plans of transforms and running them over threads. In: a size, then planes; out: the planes transformed. Invariant:
 * every table is exact to a rounding (cosines of angles in the first octant, mirrored); a group of columns or rows is
 * transformed by one worker, so threads change no bit. Compiled for speed. */
#include "base/numbers.h"
#include "waves/fft_plan.h"

#include "base/threads.h"
#include "pipeline/check_device.h"
#include "pipeline/device.h"

#include <stdatomic.h>

enum { GROUP = LOM_FFT_PAIR, PADDING = 16 };

size_t lom_fft_rows(int size)
{
    return ((size_t)size + GROUP * 2 - 1) / (GROUP * 2) * (GROUP * 2);
}

size_t lom_fft_pitch(int size)
{
    return lom_fft_rows(size) + PADDING;
}

/* exp(-2 pi i j / n), n a power of two, by the symmetries of the octants. */
static void turn_of(int j, int n, float turn[2])
{
    int octant = (int)((int64_t)j * 8 / n) & 7;
    int64_t rest = (int64_t)j * 8 - (int64_t)octant * n; /* eighths of a turn times n */
    if (octant & 1)
        rest = n - rest;
    double angle = lom_two_pi / 8 * ((double)rest / (double)n);
    double c = lom_double_cos(angle), s = lom_double_sin(angle);
    double x = ((octant + 1) & 2) != 0 ? s : c, y = ((octant + 1) & 2) != 0 ? c : s;
    if (octant >= 2 && octant < 6)
        x = -x;
    if (octant >= 4)
        y = -y;
    turn[0] = (float)x;
    turn[1] = (float)-y;
}

/* Eights first: their stages do the most work a pass over memory; fours make up the rest, a two only for size 2. */
static void choose_radices(struct lom_fft *fft)
{
    int bits = __builtin_ctz((unsigned)fft->size), fours = bits == 1 ? 0 : (3 - bits % 3) % 3;
    int eights = bits == 1 ? 0 : (bits - 2 * fours) / 3, block = fft->size;
    for (int i = 0; i < eights + fours + (bits == 1); i++) {
        int radix = bits == 1 ? 2 : i < eights ? 8 : 4;
        fft->stage[fft->stage_count++] = (struct lom_fft_stage){ .radix = radix, .block = block };
        block /= radix;
    }
}

static void fill_order(struct lom_fft *fft)
{
    for (int i = 0; i < fft->size; i++) {
        int frequency = 0, weight = 1, rest = i;
        for (int s = 0; s < fft->stage_count; s++) {
            int step = fft->stage[s].block / fft->stage[s].radix;
            frequency += rest / step * weight;
            rest %= step;
            weight *= fft->stage[s].radix;
        }
        fft->order[i] = frequency;
        fft->position[frequency] = i;
        fft->identity[i] = i;
    }
}

static void fill_turns(struct lom_fft *fft)
{
    float *next = fft->turns;
    for (int s = 0; s < fft->stage_count - 1; s++) {
        struct lom_fft_stage *stage = &fft->stage[s];
        stage->turns = next;
        for (int j = 0; j < stage->block / stage->radix; j++)
            for (int p = 1; p < stage->radix; p++, next += 2)
                turn_of(j * p % stage->block, stage->block, next);
    }
}

lom_fft *lom_create_fft(int size, const lom_device *device, lom_error *error)
{
    if (size < 2 || size > LOM_FFT_MAX || (size & (size - 1)) != 0) {
        lom_fail(error, LOM_ERROR_USAGE, "A transform of size %d is no power of two within 2..%d.", size, LOM_FFT_MAX);
        return NULL;
    }
    lom_fft *fft = lom_check_device(device, error) ? lom_allocate(1, sizeof *fft, error) : NULL;
    if (fft == NULL)
        return NULL;
    size_t n = (size_t)size;
    fft->size = size;
    fft->workers = lom_pool_size(device->pool);
    fft->order = lom_allocate(n, sizeof(int), error);
    fft->position = lom_allocate(n + GROUP, sizeof(int), error); /* groups of a small size read past it */
    fft->identity = lom_allocate(n, sizeof(int), error);
    fft->turns = lom_allocate(4 * n, sizeof(float), error);
    fft->scratch = lom_allocate((size_t)fft->workers, (n + GROUP) * GROUP * 2 * sizeof(float), error);
    if (fft->order == NULL || fft->position == NULL || fft->identity == NULL || fft->turns == NULL ||
        fft->scratch == NULL) {
        lom_free_fft(fft);
        return NULL;
    }
    choose_radices(fft);
    fill_order(fft);
    fill_turns(fft);
    return fft;
}

void lom_free_fft(lom_fft *fft)
{
    if (fft == NULL)
        return;
    lom_release(fft->order);
    lom_release(fft->position);
    lom_release(fft->identity);
    lom_release(fft->turns);
    lom_release(fft->scratch);
    lom_release(fft);
}

/* ---- running ---- */

#define VARIANT(name, variant)                                                                                         \
    [LOM_SLOT_##variant] = { lom_fft_columns_##variant, lom_fft_rows_##variant, lom_fft_real_rows_##variant },
static const struct {
    lom_fft_group *columns, *rows;
    lom_fft_real_group *real_rows;
} variants[LOM_VARIANTS] = { LOM_EACH_VARIANT(VARIANT, ) };

struct job {
    const lom_fft *fft;
    lom_fft_group *group; /* NULL: real rows */
    lom_fft_real_group *real;
    struct lom_fft_planes planes;
    float *result;
    size_t count, step; /* columns or rows, and how many a call does */
    atomic_size_t next;
};

static void work(void *context, int worker)
{
    struct job *job = context;
    if (worker >= job->fft->workers)
        return;
    float *scratch = job->fft->scratch + (size_t)worker * ((size_t)job->fft->size + GROUP) * GROUP * 2;
    for (;;) {
        size_t first = atomic_fetch_add_explicit(&job->next, job->step, memory_order_relaxed);
        if (first >= job->count)
            return;
        if (job->group != NULL)
            job->group(job->fft, job->planes, first, scratch);
        else
            job->real(job->fft, job->planes, first, job->result, scratch);
    }
}

void lom_transform_square(lom_fft *fft, lom_device *device, int sign, float *real, float *imaginary)
{
    struct lom_fft_planes square = { sign < 0 ? real : imaginary, sign < 0 ? imaginary : real,
                                     lom_fft_pitch(fft->size) };
    size_t lanes = (size_t)device->desc.lanes, count = (size_t)fft->size;
    lom_offer_work(
        device->pool, work,
        &(struct job){
            .fft = fft, .group = variants[device->variant].columns, .planes = square, .count = count, .step = lanes });
    lom_offer_work(
        device->pool, work,
        &(struct job){
            .fft = fft, .group = variants[device->variant].rows, .planes = square, .count = count, .step = lanes });
}

void lom_transform_hermitian(lom_fft *fft, lom_device *device, float *real, float *imaginary, float *result)
{
    size_t lanes = (size_t)device->desc.lanes, count = (size_t)fft->size, pitch = lom_fft_pitch(fft->size / 2);
    device->counters.transforms++;
    lom_offer_work(device->pool, work,
                   &(struct job){ .fft = fft,
                                  .group = variants[device->variant].columns,
                                  .planes = { imaginary, real, pitch },
                                  .count = count / 2,
                                  .step = lanes });
    lom_offer_work(device->pool, work,
                   &(struct job){ .fft = fft,
                                  .real = variants[device->variant].real_rows,
                                  .planes = { real, imaginary, pitch },
                                  .result = result,
                                  .count = count,
                                  .step = 2 * LOM_FFT_PAIR });
}
