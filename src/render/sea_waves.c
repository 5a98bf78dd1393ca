/* The cascades of a sea as textures. In: the scene's wind, a time. Out: what shaders look up: displacements,
 * derivatives, and second moments with the foam of a fixed window. Any frame alone has the same. */
#include "render/renderer.h"
#include "waves/sea_desc.h"

enum { places = LOM_SEA_HEIGHT | LOM_SEA_DISPLACEMENT };
enum { MOMENTS = 3 }; /* of the window before this one, at which foam is looked for */

bool lom_load_sea(lom_renderer *renderer, lom_error *error)
{
    const lom_water_waves *w = &renderer->scene->water.waves;
    if (w->kind != LOM_WAVES_SEA)
        return true;
    lom_sea_desc desc = lom_scene_sea(w);
    renderer->sea = lom_create_sea(&desc, renderer->device, error);
    return renderer->sea != NULL;
}

static lom_texture *make_field(lom_renderer *r, int size, const float *pixels)
{
    return lom_make_texture(
        r->device,
        &(lom_texture_desc){
            .width = size, .height = size, .format = LOM_FORMAT_RGBA32F, .pixels = pixels, .mips = LOM_MIPS_ALL });
}

/* Adds to the fourth of each four what breaks at this moment, in parts `fresh`; the largest stays. */
static void add_foam(float *moments, const lom_sea_cascade *c, float threshold, float fresh)
{
    for (int i = 0; i < c->size * c->size; i++) {
        float below = (threshold - c->jacobian[i]) * 4 * fresh;
        float bounded = below < 0 ? 0 : below < fresh ? below : fresh;
        if (bounded > moments[4 * i + 3])
            moments[4 * i + 3] = bounded;
    }
}

static bool find_foam(lom_renderer *r, int cascade, float *moments, double time, lom_error *error)
{
    const lom_water_foam *foam = &r->scene->water.foam;
    for (int m = MOMENTS; foam->amount > 0 && m > 0; m--) {
        double then = time - foam->window * m / (MOMENTS + 1);
        if (!lom_advance_cascade(r->sea, r->device, cascade, LOM_SEA_JACOBIAN, then, error))
            return false;
        lom_sea_cascade c = lom_view_cascade(r->sea, cascade);
        add_foam(moments, &c, (float)foam->threshold, 1 - (float)m / (MOMENTS + 1));
    }
    return true;
}

static bool fill_cascade(lom_renderer *r, struct lom_waves_uniform *out, int cascade, float *moments, double time,
                         lom_error *error)
{
    struct lom_cascade_uniform *u = &out->cascade[cascade];
    lom_texture **held = r->sea_fields[cascade];
    if (!find_foam(r, cascade, moments, time, error) ||
        !lom_advance_cascade(r->sea, r->device, cascade, LOM_SEA_ALL & ~(unsigned)places, time, error))
        return false;
    lom_sea_cascade c = lom_view_cascade(r->sea, cascade);
    if (r->scene->water.foam.amount > 0)
        add_foam(moments, &c, (float)r->scene->water.foam.threshold, 1);
    for (int i = 0; i < c.size * c.size; i++) {
        float sx = c.derivatives[4 * i], sz = c.derivatives[4 * i + 1];
        moments[4 * i] = sx * sx;
        moments[4 * i + 1] = sz * sz;
        moments[4 * i + 2] = sx * sz;
    }
    const float *const pixels[3] = { c.displacement, c.derivatives, moments };
    for (int i = 0; i < 3; i++) {
        lom_release_texture(r->device, held[i]);
        held[i] = make_field(r, c.size, pixels[i]);
        if (held[i] == NULL)
            return lom_fail(error, lom_device_error(r->device)->code, "%s", lom_device_error(r->device)->text);
    }
    *u = (struct lom_cascade_uniform){ held[0], held[1], held[2], (float)(1 / c.length), 0.5f / (float)c.size };
    return true;
}

void lom_bound_sea(const lom_renderer *renderer, struct lom_waves_uniform *out)
{
    const lom_sea_desc *desc = renderer->sea != NULL ? lom_describe_sea(renderer->sea) : NULL;
    for (int i = 0; desc != NULL && i < desc->cascade_count; i++) {
        float bound = (float)(1.001 * lom_view_cascade(renderer->sea, i).bound);
        out->lowest -= bound;
        out->highest += bound;
        out->reach += 1.4142137f * (float)desc->choppiness * bound;
    }
}

bool lom_place_sea(lom_renderer *renderer, struct lom_waves_uniform *out, double time, lom_error *error)
{
    int count = renderer->sea != NULL ? lom_describe_sea(renderer->sea)->cascade_count : 0;
    for (int i = 0; i < count; i++) {
        if (!lom_advance_cascade(renderer->sea, renderer->device, i, places, time, error))
            return false;
        lom_sea_cascade c = lom_view_cascade(renderer->sea, i);
        out->lowest += c.lowest;
        out->highest += c.highest;
        out->reach += 1.4142137f * c.reach;
    }
    return true;
}

bool lom_fill_sea(lom_renderer *renderer, struct lom_waves_uniform *out, double time, lom_error *error)
{
    if (renderer->sea == NULL)
        return true;
    const lom_sea_desc *desc = lom_describe_sea(renderer->sea);
    out->cascade_count = desc->cascade_count;
    for (int i = 0; i < desc->cascade_count; i++) {
        size_t count = (size_t)desc->cascade[i].size * (size_t)desc->cascade[i].size;
        float *moments = lom_allocate(count, 4 * sizeof *moments, error);
        bool done = moments != NULL && fill_cascade(renderer, out, i, moments, time, error);
        lom_release(moments);
        if (!done)
            return false;
    }
    return true;
}

/* The height of a cascade's samples at a rest position, to the nearest sample. */
static const float *sample_at(const lom_sea_cascade *c, double x, double z)
{
    double s = x / c->length, t = z / c->length;
    int column = (int)((s - lom_double_floor(s)) * c->size), row = (int)((t - lom_double_floor(t)) * c->size);
    column = column < c->size ? column : c->size - 1;
    row = row < c->size ? row : c->size - 1;
    return c->displacement + 4 * ((size_t)row * (size_t)c->size + (size_t)column);
}

double lom_sea_height(const lom_renderer *renderer, double x, double z)
{
    double rest_x = x, rest_z = z, height = 0;
    if (renderer->sea == NULL)
        return 0;
    for (int step = 0; step < 4; step++) {
        double dx = 0, dz = 0;
        height = 0;
        for (int i = 0; i < lom_describe_sea(renderer->sea)->cascade_count; i++) {
            lom_sea_cascade c = lom_view_cascade(renderer->sea, i);
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
