/* A sea for rays. In: the scene's [water.waves], a time. Out: its cascades, read in double. Invariant: a place is read
 * from the samples that every model of water draws, so that an error against the reference is the model's and not the
 * spectrum's. */
#include "reference/wave_surface.h"

#include "waves/sea_desc.h"

bool lom_make_ray_sea(struct lom_wave_surface *surface, const lom_water_params *water, double time, double *shortest,
                      lom_error *error)
{
    if (water->waves.kind != LOM_WAVES_SEA)
        return true;
    lom_sea_desc desc = lom_scene_sea(&water->waves);
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    if (device == NULL)
        return lom_fail(error, LOM_ERROR_MEMORY, "There is no memory for the reference's sea.");
    surface->sea = lom_create_sea(&desc, device, error);
    bool done = surface->sea != NULL && lom_advance_sea(surface->sea, device, time, error);
    lom_close_device(device);
    surface->cascade_count =
        done && !lom_describe_sea(surface->sea)->calm ? lom_describe_sea(surface->sea)->cascade_count : 0;
    for (int i = 0; i < surface->cascade_count; i++) {
        surface->cascade[i] = lom_view_cascade(surface->sea, i);
        *shortest = surface->cascade[i].shortest;
    }
    return done;
}

/* Between two neighbours along a row or a column that repeats after `size` samples. */
struct between {
    size_t low, high;
    double part;
};

static struct between find_between(double place, double length, int size)
{
    double turns = place / length, at = (turns - lom_double_floor(turns)) * size;
    int low = lom_int_of(at);
    low = low < size ? low : 0;
    return (struct between){ (size_t)low, (size_t)(low + 1 < size ? low + 1 : 0), at - lom_double_floor(at) };
}

static void add_cascade(struct lom_wave_place *p, const lom_sea_cascade *c, double x, double z)
{
    struct between across = find_between(x, c->length, c->size), down = find_between(z, c->length, c->size);
    const size_t pitch = (size_t)c->size;
    const size_t sample[4] = { down.low * pitch + across.low, down.low * pitch + across.high,
                               down.high * pitch + across.low, down.high * pitch + across.high };
    const double weight[4] = { (1 - across.part) * (1 - down.part), across.part * (1 - down.part),
                               (1 - across.part) * down.part, across.part * down.part };
    double *const displacement[4] = { &p->dx, &p->dy, &p->dz, &p->xz };
    double *const derivative[4] = { &p->sx, &p->sz, &p->xx, &p->zz };
    for (int corner = 0; corner < 4; corner++)
        for (int i = 0; i < 4; i++) {
            *displacement[i] += weight[corner] * (double)c->displacement[4 * sample[corner] + (size_t)i];
            *derivative[i] += weight[corner] * (double)c->derivatives[4 * sample[corner] + (size_t)i];
        }
}

void lom_add_sea(struct lom_wave_place *place, const struct lom_wave_surface *surface, double x, double z)
{
    for (int i = 0; i < surface->cascade_count; i++)
        add_cascade(place, &surface->cascade[i], x, z);
}
