/* A step of the sea: spectra at a time, one transform a field, pixels. In: a sea and a time; out: its views. Invariant:
 * nothing of an earlier step is read, so any time can be made in any order. Compiled for speed. */
#include "base/numbers.h"
#include "pipeline/check_device.h"
#include "waves/sea_state.h"

#include "base/threads.h"
#include "pipeline/device.h"

#define VARIANT(name, variant)                                                                                         \
    [LOM_SLOT_##variant] = { lom_sea_wave_row_##variant, lom_sea_field_row_##variant, lom_sea_view_row_##variant },
static const struct {
    lom_sea_row *wave, *field, *view;
} variants[LOM_VARIANTS] = { LOM_EACH_VARIANT(VARIANT, ) };

struct job {
    lom_sea_row *function;
    const struct lom_sea_rows *rows;
    int workers;
};

/* Whole stretches of rows: neighbours share lines of the cache. */
static void work(void *context, int worker)
{
    const struct job *job = context;
    int first = job->rows->size * worker / job->workers, last = job->rows->size * (worker + 1) / job->workers;
    for (int row = first; row < last; row++)
        job->function(job->rows, row);
}

static void run_rows(lom_device *device, lom_sea_row *function, const struct lom_sea_rows *rows)
{
    lom_run_pool(device->pool, work, &(struct job){ function, rows, lom_pool_size(device->pool) });
}

static struct lom_sea_rows describe_rows(const lom_sea *sea, struct lom_cascade *c, unsigned fields, double time)
{
    size_t size = (size_t)c->view.size, half = lom_fft_rows(c->view.size) * lom_fft_pitch(c->view.size / 2);
    return (struct lom_sea_rows){ .turns = c->turns,
                                  .factors = c->factors,
                                  .wave_re = sea->spectrum_planes,
                                  .wave_im = sea->spectrum_planes + half,
                                  .field_re = sea->spectrum_planes + 2 * half,
                                  .field_im = sea->spectrum_planes + 3 * half,
                                  .fields = sea->fields,
                                  .displacement = c->memory,
                                  .derivatives = c->memory + 4 * size * size,
                                  .jacobian = c->memory + 8 * size * size,
                                  .bounds = sea->bounds,
                                  .size = c->view.size,
                                  .asked = fields,
                                  .time = time,
                                  .choppiness = sea->desc.choppiness,
                                  .wavenumber = (float)(lom_two_pi / c->view.length) };
}

static void keep_bounds(const lom_sea *sea, struct lom_sea_cascade *view, unsigned fields)
{
    float low = sea->bounds[0], high = sea->bounds[1], reach = sea->bounds[2];
    for (int row = 1; row < view->size; row++) {
        const float *b = sea->bounds + 3 * row;
        low = b[0] < low ? b[0] : low;
        high = b[1] > high ? b[1] : high;
        reach = b[2] > reach ? b[2] : reach;
    }
    if (fields & LOM_SEA_HEIGHT) {
        view->lowest = low;
        view->highest = high;
    }
    if (fields & LOM_SEA_DISPLACEMENT)
        view->reach = reach;
}

static void advance(lom_sea *sea, lom_device *device, struct lom_cascade *c, unsigned fields, double time)
{
    static const unsigned needs[LOM_FIELDS] = { LOM_SEA_DISPLACEMENT, LOM_SEA_HEIGHT,  LOM_SEA_DISPLACEMENT,
                                                LOM_SEA_JACOBIAN,     LOM_SEA_SLOPES,  LOM_SEA_SLOPES,
                                                LOM_SEA_JACOBIAN,     LOM_SEA_JACOBIAN };
    struct lom_sea_rows rows = describe_rows(sea, c, fields, time);
    size_t plane = lom_fft_rows(rows.size) * lom_fft_pitch(rows.size);
    run_rows(device, variants[device->variant].wave, &rows);
    for (int i = 0; i < LOM_FIELDS; i++)
        if (fields & needs[i]) {
            rows.field = i;
            run_rows(device, variants[device->variant].field, &rows);
            lom_transform_hermitian(c->fft, device, rows.field_re, rows.field_im, sea->fields + (size_t)i * plane);
        }
    run_rows(device, variants[device->variant].view, &rows);
    keep_bounds(sea, &c->view, fields);
}

bool lom_advance_cascade(lom_sea *sea, lom_device *device, int cascade, unsigned fields, double time, lom_error *error)
{
    if (!(time >= -1e9 && time <= 1e9))
        return lom_fail(error, LOM_ERROR_USAGE, "The sea's time is not within -1e9..1e9 seconds.");
    if (cascade < 0 || cascade >= sea->desc.cascade_count)
        return lom_fail(error, LOM_ERROR_USAGE, "The sea has cascades 0..%d, not %d.", sea->desc.cascade_count - 1,
                        cascade);
    if (fields == 0 || (fields & ~(unsigned)LOM_SEA_ALL) != 0)
        return lom_fail(error, LOM_ERROR_USAGE, "A step of the sea makes fields 1..%d, not %u.", LOM_SEA_ALL, fields);
    if (!lom_check_device(device, error))
        return false;
    struct lom_cascade *c = &sea->cascade[cascade];
    lom_float_state state;
    lom_enter_float_state(&state);
    if (c->view.waves > 0)
        advance(sea, device, c, fields, time);
    lom_leave_float_state(&state);
    c->view.time = time;
    c->view.fields = fields;
    return true;
}

bool lom_advance_sea(lom_sea *sea, lom_device *device, double time, lom_error *error)
{
    for (int i = 0; i < sea->desc.cascade_count; i++)
        if (!lom_advance_cascade(sea, device, i, LOM_SEA_ALL, time, error))
            return false;
    return true;
}
