/* Making a sea. In: its description; out: the amplitudes and frequencies of every wave of every cascade. Invariant: an
 * amplitude is a function of the spectrum, the seed, the patch and (n, m) alone; rows are made by any worker. */
#include "base/numbers.h"
#include "pipeline/check_device.h"
#include "waves/sea_state.h"

#include "base/threads.h"
#include "pipeline/device.h"

void lom_wave_amplitude(const lom_sea *sea, int cascade, int n, int m, double amplitude[2])
{
    const lom_cascade_desc *c = &sea->desc.cascade[cascade];
    double step = lom_two_pi / c->length, k = step * lom_double_sqrt((double)n * n + (double)m * m);
    amplitude[0] = amplitude[1] = 0;
    if ((n == 0 && m == 0) || k * c->longest <= lom_two_pi || k * c->shortest > lom_two_pi)
        return;
    double variance = lom_directional_spectrum(&sea->spectrum, step * n, step * m) * step * step;
    if (!(variance > 0))
        return;
    double size = lom_double_sqrt(variance) / 2;
    lom_random_normal(c->seed, (uint64_t)(uint32_t)n << 32 | (uint32_t)m, amplitude);
    amplitude[0] *= size;
    amplitude[1] *= size;
}

/* ---- the waves of a cascade ---- */

struct making {
    const lom_sea *sea;
    struct lom_cascade *cascade;
    int number, workers;
    double *sums; /* a row: variance of heights, of slopes, waves, and of amplitudes the sum over both sides of 0 */
};

static double magnitude(const double a[2])
{
    return lom_double_sqrt(a[0] * a[0] + a[1] * a[1]);
}

static void make_row(const struct making *making, int row)
{
    const lom_sea *sea = making->sea;
    struct lom_cascade *c = making->cascade;
    int size = c->view.size, m = row < size / 2 ? row : row - size;
    double step = lom_two_pi / c->view.length, *sums = making->sums + 4 * (size_t)row;
    size_t pitch = lom_fft_pitch(size / 2), plane = pitch * (size_t)size;
    for (int n = 0; n < size / 2 && m != -size / 2; n++) {
        double there[2], back[2], kx = step * n, kz = step * m;
        lom_wave_amplitude(sea, making->number, n, m, there);
        lom_wave_amplitude(sea, making->number, -n, -m, back);
        float *to = c->factors + (size_t)row * pitch + (size_t)n;
        to[0] = (float)(there[0] + back[0]);
        to[plane] = (float)(there[1] + back[1]);
        to[2 * plane] = (float)(there[1] - back[1]);
        to[3 * plane] = (float)(back[0] - there[0]);
        double k2 = kx * kx + kz * kz;
        sums[3] += (magnitude(there) + magnitude(back)) * (n > 0 ? 2 : 1);
        c->turns[(size_t)row * pitch + (size_t)n] =
            lom_dispersion(lom_double_sqrt(k2), sea->spectrum.depth, sea->spectrum.gravity) / lom_two_pi;
        if (k2 * c->view.longest * c->view.longest > lom_two_pi * lom_two_pi &&
            k2 * c->view.shortest * c->view.shortest <= lom_two_pi * lom_two_pi) {
            double variance = lom_directional_spectrum(&sea->spectrum, kx, kz);
            if (n > 0)
                variance += lom_directional_spectrum(&sea->spectrum, -kx, -kz);
            sums[0] += variance * step * step;
            sums[1] += variance * step * step * k2;
            sums[2] += (variance > 0) * (n > 0 ? 2 : 1);
        }
    }
}

static void make_rows(void *context, int worker)
{
    const struct making *making = context;
    for (int row = worker; row < making->cascade->view.size; row += making->workers)
        make_row(making, row);
}

static bool make_cascade(lom_sea *sea, int number, lom_device *device, lom_error *error)
{
    struct lom_cascade *c = &sea->cascade[number];
    const lom_cascade_desc *desc = &sea->desc.cascade[number];
    size_t size = (size_t)desc->size, plane = size * lom_fft_pitch(desc->size / 2);
    c->view = (lom_sea_cascade){
        .size = desc->size, .length = desc->length, .longest = desc->longest, .shortest = desc->shortest
    };
    c->fft = lom_create_fft(desc->size, device, error);
    c->turns = lom_allocate(plane, sizeof *c->turns, error);
    c->factors = lom_allocate(plane, 4 * sizeof *c->factors, error);
    c->memory = lom_allocate(size * size, 9 * sizeof *c->memory, error);
    double *sums = lom_allocate(size, 4 * sizeof *sums, error);
    if (c->fft == NULL || c->turns == NULL || c->factors == NULL || c->memory == NULL || sums == NULL) {
        lom_release(sums);
        return false;
    }
    c->view.displacement = c->memory;
    c->view.derivatives = c->memory + 4 * size * size;
    c->view.jacobian = c->memory + 8 * size * size;
    for (size_t i = 0; i < size * size; i++)
        c->memory[8 * size * size + i] = 1;
    struct making making = { sea, c, number, lom_pool_size(device->pool), sums };
    lom_run_pool(device->pool, make_rows, &making);
    double waves = 0;
    for (size_t row = 0; row < size; row++) {
        c->view.height_variance += sums[4 * row];
        c->view.slope_variance += sums[4 * row + 1];
        waves += sums[4 * row + 2];
        c->view.bound += 1.001 * sums[4 * row + 3]; /* floats round */
    }
    c->view.waves = lom_int_of(waves);
    lom_release(sums);
    return true;
}

lom_sea *lom_create_sea(const lom_sea_desc *desc, lom_device *device, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_sea *sea = lom_allocate(1, sizeof *sea, error);
    bool made = sea != NULL && lom_check_device(device, error) && lom_resolve_sea(desc, &sea->desc, error);
    int largest = 0;
    if (made)
        sea->spectrum = lom_sea_spectrum(&sea->desc);
    for (int i = 0; made && i < sea->desc.cascade_count; i++) {
        made = make_cascade(sea, i, device, error);
        if (sea->desc.cascade[i].size > largest)
            largest = sea->desc.cascade[i].size;
    }
    if (made) {
        size_t half = lom_fft_rows(largest) * lom_fft_pitch(largest / 2);
        sea->spectrum_planes = lom_allocate(half, 4 * sizeof(float), error);
        sea->fields = lom_allocate(lom_fft_rows(largest) * lom_fft_pitch(largest), LOM_FIELDS * sizeof(float), error);
        sea->bounds = lom_allocate((size_t)largest, 3 * sizeof(float), error);
        made = sea->spectrum_planes != NULL && sea->fields != NULL && sea->bounds != NULL;
    }
    if (!made) {
        lom_free_sea(sea);
        sea = NULL;
    }
    lom_leave_float_state(&state);
    return sea;
}

void lom_free_sea(lom_sea *sea)
{
    if (sea == NULL)
        return;
    for (int i = 0; i < LOM_MAX_CASCADES; i++) {
        lom_free_fft(sea->cascade[i].fft);
        lom_release(sea->cascade[i].turns);
        lom_release(sea->cascade[i].factors);
        lom_release(sea->cascade[i].memory);
    }
    lom_release(sea->spectrum_planes);
    lom_release(sea->fields);
    lom_release(sea->bounds);
    lom_release(sea);
}

const lom_sea_desc *lom_describe_sea(const lom_sea *sea)
{
    return &sea->desc;
}

lom_sea_cascade lom_view_cascade(const lom_sea *sea, int cascade)
{
    if (cascade < 0 || cascade >= sea->desc.cascade_count)
        return (lom_sea_cascade){ 0 };
    return sea->cascade[cascade].view;
}

double lom_significant_height(const lom_sea *sea)
{
    double variance = 0;
    for (int i = 0; i < sea->desc.cascade_count; i++)
        variance += sea->cascade[i].view.height_variance;
    return 4 * lom_double_sqrt(variance);
}
