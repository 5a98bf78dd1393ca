/* The cascades of a sea as textures. In: the scene's wind, a time. Out: what shaders look up: displacements,
 * derivatives, and second moments with the foam of a fixed window. Any frame alone has the same. */
#include "pipeline/check_device.h"
#include "pipeline/renew_texture.h"
#include "pipeline/share_work.h"
#include "waves/sea_desc.h"
#include "waves/wave_field.h"

#include <lom/sea.h>

#include <stdio.h>
#include <string.h>

struct state {
    const struct lom_wave_site *site;
    lom_device *device;
    lom_sea *sea;
    lom_texture *field[LOM_SURFACE_CASCADES][3];
    float *moments; /* of one cascade at a time: room for the largest */
};

enum { places = LOM_SEA_HEIGHT | LOM_SEA_DISPLACEMENT };
enum { MOMENTS = 3 }; /* of the window before this one, at which foam is looked for */

static bool exists(const struct lom_wave_source *source)
{
    return source->site->waves->kind == LOM_WAVES_SEA;
}

static bool load(void *memory, const struct lom_wave_source *source, lom_error *error)
{
    struct state *state = memory;
    lom_sea_desc desc = lom_scene_sea(source->site->waves);
    state->site = source->site;
    state->device = source->device;
    state->sea = lom_create_sea(&desc, source->device, error);
    if (state->sea == NULL)
        return false;
    size_t largest = 0;
    const lom_sea_desc *resolved = lom_describe_sea(state->sea);
    for (int i = 0; i < resolved->cascade_count; i++) {
        size_t size = (size_t)resolved->cascade[i].size;
        largest = size > largest ? size : largest;
    }
    state->moments = lom_allocate(largest * largest, 4 * sizeof *state->moments, error);
    return state->moments != NULL;
}

static void unload(void *memory)
{
    struct state *state = memory;
    for (int i = 0; i < LOM_SURFACE_CASCADES; i++)
        for (int k = 0; k < 3; k++)
            lom_release_texture(state->device, state->field[i][k]);
    lom_free_sea(state->sea);
    lom_release(state->moments);
}

/* By cascade: what records call its fields. */
static const char *const labels[LOM_SURFACE_CASCADES][3] = {
    { "displacement 0", "derivatives 0", "moments 0" },
    { "displacement 1", "derivatives 1", "moments 1" },
    { "displacement 2", "derivatives 2", "moments 2" },
    { "displacement 3", "derivatives 3", "moments 3" },
};

static bool fill_field(const struct state *state, lom_texture **field, const char *label, int size, const float *pixels)
{
    const lom_texture_desc desc = { .width = size,
                                    .height = size,
                                    .format = LOM_FORMAT_RGBA32F,
                                    .pixels = pixels,
                                    .mips = LOM_MIPS_ALL,
                                    .label = label };
    return lom_renew_texture(state->device, field, &desc);
}

/* Moments of the samples of a cascade, by all workers. */
struct moments {
    float *moments;
    lom_sea_cascade cascade;
    float threshold, fresh;
};

enum { SAMPLES = 8192 }; /* that a worker takes at a time */

/* Adds to the fourth of each four what breaks at this moment, in parts `fresh`; the largest stays. */
static void add_foam(void *context, size_t first, size_t end)
{
    const struct moments *m = context;
    for (size_t i = first; i < end; i++) {
        float below = (m->threshold - m->cascade.jacobian[i]) * 4 * m->fresh;
        float bounded = below < 0 ? 0 : below < m->fresh ? below : m->fresh;
        if (bounded > m->moments[4 * i + 3])
            m->moments[4 * i + 3] = bounded;
    }
}

static void add_slopes(void *context, size_t first, size_t end)
{
    const struct moments *m = context;
    for (size_t i = first; i < end; i++) {
        float sx = m->cascade.derivatives[4 * i], sz = m->cascade.derivatives[4 * i + 1];
        m->moments[4 * i] = sx * sx;
        m->moments[4 * i + 1] = sz * sz;
        m->moments[4 * i + 2] = sx * sz;
    }
}

static void clear(void *context, size_t first, size_t end)
{
    const struct moments *m = context;
    memset(m->moments + 4 * first, 0, (end - first) * 4 * sizeof *m->moments);
}

/* One of these for all samples; `fresh`: how much of the foam of this moment is left. */
static void run_samples(const struct state *state, int cascade, lom_range_work *work, float fresh)
{
    lom_sea_cascade c = lom_view_cascade(state->sea, cascade);
    struct moments m = { state->moments, c, (float)state->site->foam->threshold, fresh };
    lom_share_work(state->device, (size_t)c.size * (size_t)c.size, SAMPLES, work, &m);
}

static bool find_foam(struct state *state, int cascade, double time, lom_error *error)
{
    const lom_water_foam *foam = state->site->foam;
    for (int m = MOMENTS; foam->amount > 0 && m > 0; m--) {
        double then = time - foam->window * m / (MOMENTS + 1);
        if (!lom_advance_cascade(state->sea, state->device, cascade, LOM_SEA_JACOBIAN, then, error))
            return false;
        run_samples(state, cascade, add_foam, 1 - (float)m / (MOMENTS + 1));
    }
    return true;
}

static bool fill_cascade(struct state *state, struct lom_waves_uniform *out, int cascade, double time, lom_error *error)
{
    struct lom_cascade_uniform *u = &out->cascade[cascade];
    lom_texture **held = state->field[cascade];
    run_samples(state, cascade, clear, 0);
    if (!find_foam(state, cascade, time, error) ||
        !lom_advance_cascade(state->sea, state->device, cascade, LOM_SEA_ALL & ~(unsigned)places, time, error))
        return false;
    lom_sea_cascade c = lom_view_cascade(state->sea, cascade);
    if (state->site->foam->amount > 0)
        run_samples(state, cascade, add_foam, 1);
    run_samples(state, cascade, add_slopes, 1);
    const float *const pixels[3] = { c.displacement, c.derivatives, state->moments };
    for (int i = 0; i < 3; i++)
        if (!fill_field(state, &held[i], labels[cascade][i], c.size, pixels[i]))
            return lom_check_device(state->device, error);
    *u = (struct lom_cascade_uniform){ held[0], held[1], held[2], .inverse_length = (float)(1 / c.length) };
    for (int i = 0; i < 2; i++) {
        double repetitions = (out->origin[2 * i] - state->site->middle[i]) / c.length;
        u->shift[i] = (float)(0.5 / c.size + (repetitions - lom_double_floor(repetitions)));
    }
    return true;
}

static void bound(const void *memory, struct lom_waves_uniform *out, double time)
{
    (void)time;
    const struct state *state = memory;
    const lom_sea_desc *desc = lom_describe_sea(state->sea);
    for (int i = 0; i < desc->cascade_count; i++) {
        float bound = (float)(1.001 * lom_view_cascade(state->sea, i).bound);
        out->lowest -= bound;
        out->highest += bound;
        out->reach += 1.4142137f * (float)desc->choppiness * bound;
    }
}

static bool place(void *memory, struct lom_waves_uniform *out, double time, lom_error *error)
{
    struct state *state = memory;
    for (int i = 0; i < lom_describe_sea(state->sea)->cascade_count; i++) {
        if (!lom_advance_cascade(state->sea, state->device, i, places, time, error))
            return false;
        lom_sea_cascade c = lom_view_cascade(state->sea, i);
        out->lowest += c.lowest;
        out->highest += c.highest;
        out->reach += 1.4142137f * c.reach;
    }
    return true;
}

static bool fill(void *memory, struct lom_waves_uniform *out, double time, lom_error *error)
{
    struct state *state = memory;
    const lom_sea_desc *desc = lom_describe_sea(state->sea);
    out->cascade_count = desc->cascade_count;
    out->period = (float)desc->cascade[0].length;
    for (int i = 0; i < desc->cascade_count; i++)
        if (!fill_cascade(state, out, i, time, error))
            return false;
    return true;
}

/* The height of a cascade's samples at a rest position, to the nearest sample. */
static const float *sample_at(const lom_sea_cascade *c, double x, double z)
{
    double s = x / c->length, t = z / c->length;
    int column = lom_int_of((s - lom_double_floor(s)) * c->size), row = lom_int_of((t - lom_double_floor(t)) * c->size);
    column = column < c->size ? column : c->size - 1;
    row = row < c->size ? row : c->size - 1;
    return c->displacement + 4 * ((size_t)row * (size_t)c->size + (size_t)column);
}

static double height(const void *memory, const struct lom_waves_uniform *waves, double x, double z)
{
    (void)waves;
    const struct state *state = memory;
    const lom_sea *sea = state->sea;
    x -= state->site->middle[0];
    z -= state->site->middle[1];
    double rest_x = x, rest_z = z, height = 0;
    for (int step = 0; step < 4; step++) {
        double dx = 0, dz = 0;
        height = 0;
        for (int i = 0; i < lom_describe_sea(sea)->cascade_count; i++) {
            lom_sea_cascade c = lom_view_cascade(sea, i);
            const float *p = sample_at(&c, rest_x, rest_z);
            dx += (double)p[0];
            height += (double)p[1];
            dz += (double)p[2];
        }
        rest_x = x - dx;
        rest_z = z - dz;
    }
    return height;
}

static void report(const void *memory, const struct lom_wave_moment *moment, struct lom_wave_report *out)
{
    const lom_sea *sea = ((const struct state *)memory)->sea;
    int calm = 0, count = lom_describe_sea(sea)->cascade_count;
    for (int i = 0; i < count; i++)
        calm += lom_view_cascade(sea, i).waves == 0;
    out->says = true;
    out->runs = moment->why == NULL && calm < count;
    if (moment->why != NULL)
        snprintf(out->text, sizeof out->text, "%s: %s", moment->why,
                 moment->known == LOM_WAVES_BOUNDED ? "no cascade is advanced"
                                                    : "their places tell, no more of them is made");
    else if (calm < count)
        snprintf(out->text, sizeof out->text, "%d of %d cascades are advanced; %d have no waves", count - calm, count,
                 calm);
    else
        snprintf(out->text, sizeof out->text, "none of %d cascades has waves", count);
}

const struct lom_wave_kind lom_sea_waves = { .step = "waves",
                                             .size = sizeof(struct state),
                                             .advances = true,
                                             .exists = exists,
                                             .load = load,
                                             .free = unload,
                                             .bound = bound,
                                             .place = place,
                                             .fill = fill,
                                             .height = height,
                                             .stage = LOM_WAVES_AT_FILLING,
                                             .report = report };
