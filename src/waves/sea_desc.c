/* The description of a sea. In: what a user or a scene gave; out: every default filled in and every range checked. */
#include "base/numbers.h"
#include "base/double_parts.h"
#include "base/range.h"
#include "waves/sea_desc.h"

/* 0 becomes `initial`; everything else has to be finite and within low .. high. */
static bool resolve_number(double *value, double initial, double low, double high, const char *what, lom_error *error)
{
    if (*value == 0)
        *value = initial;
    return lom_check_range(*value, low, high, error, "The sea's %s", what);
}

static bool resolve_weather(lom_sea_desc *sea, lom_error *error)
{
    if ((unsigned)sea->spectrum > LOM_SPECTRUM_PHILLIPS)
        return lom_fail(error, LOM_ERROR_USAGE, "The sea has no spectrum of number %d.", (int)sea->spectrum);
    if ((unsigned)sea->spreading > LOM_SPREADING_DONELAN_BANNER)
        return lom_fail(error, LOM_ERROR_USAGE, "The sea has no spreading of number %d.", (int)sea->spreading);
    if (sea->wind_level != NULL) {
        const lom_wind_level *level = lom_find_wind_level(sea->wind_level, error);
        if (level == NULL)
            return false;
        sea->wind_speed = level->speed;
        sea->calm = sea->calm || level->speed == 0;
        sea->wind_level = level->name;
    }
    if (sea->spreading == LOM_SPREADING_AUTO)
        sea->spreading =
            sea->spectrum == LOM_SPECTRUM_PHILLIPS ? LOM_SPREADING_COSINE_SQUARED : LOM_SPREADING_HASSELMANN;
    return resolve_number(&sea->wind_speed, 8, 0.1, 100, "wind in m/s", error) &&
           resolve_number(&sea->wind_direction, 0, -1e6, 1e6, "wind direction in radians", error) &&
           resolve_number(&sea->fetch, 1e5, 1, 1e8, "fetch in metres", error) &&
           resolve_number(&sea->peak_enhancement, 3.3, 1, 20, "peak enhancement", error) &&
           resolve_number(&sea->spreading_exponent, 0, 0, 100, "spreading exponent", error) &&
           resolve_number(&sea->depth, 0, 0, 1e6, "depth in metres", error) &&
           resolve_number(&sea->gravity, 9.80665, 1e-3, 1000, "gravity in m/s^2", error) &&
           resolve_number(&sea->height_scale, 1, 1e-6, 1000, "height scale", error) &&
           resolve_number(&sea->shortest_wave, 0, 0, 1e6, "shortest wave in metres", error) &&
           (sea->heights_only || resolve_number(&sea->choppiness, 1, 1e-6, 10, "choppiness", error));
}

static bool resolve_size(lom_cascade_desc *c, int number, lom_error *error)
{
    if (c->size == 0)
        c->size = 256;
    if (c->size < 16 || c->size > 2048 || (c->size & (c->size - 1)) != 0)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "Cascade %d has %d samples a side, which is not a power of two within 16..2048.", number,
                        c->size);
    return true;
}

/* Where the bands end is chosen last: a sixth of the next patch, so that the next one has six of its longest waves. */
static bool resolve_band(lom_sea_desc *sea, int i, lom_error *error)
{
    lom_cascade_desc *c = &sea->cascade[i];
    if (c->longest == 0)
        c->longest = i == 0 ? DOUBLE_INFINITY : sea->cascade[i - 1].shortest;
    if (c->shortest == 0) {
        double end = i + 1 < sea->cascade_count ? sea->cascade[i + 1].length / 6 : 0, finest = 2 * c->length / c->size;
        c->shortest = end > finest ? end : finest;
    }
    if (!(c->longest > 0) || !(c->shortest > 0) || !(c->shortest < DOUBLE_INFINITY))
        return lom_fail(error, LOM_ERROR_USAGE, "Cascade %d has no wavelengths: they have to be positive.", i);
    if (i > 0 && c->longest > sea->cascade[i - 1].shortest)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "Cascade %d has waves up to %g m, but those from %g m on belong to the cascade before.", i,
                        c->longest, sea->cascade[i - 1].shortest);
    return true;
}

bool lom_resolve_sea(const lom_sea_desc *desc, lom_sea_desc *resolved, lom_error *error)
{
    lom_sea_desc sea = desc != NULL ? *desc : (lom_sea_desc){ .cascade_count = 0 };
    if (!resolve_weather(&sea, error))
        return false;
    if (sea.heights_only)
        sea.choppiness = 0;
    if (sea.cascade_count == 0)
        sea.cascade_count = 3;
    if (sea.cascade_count < 1 || sea.cascade_count > LOM_MAX_CASCADES)
        return lom_fail(error, LOM_ERROR_USAGE, "A sea has 1 to %d cascades, not %d.", LOM_MAX_CASCADES,
                        sea.cascade_count);
    lom_wave_spectrum spectrum = lom_sea_spectrum(&sea);
    double length = 350;
    if (spectrum.peak > 0)
        length = 6 * 2 * lom_pi * sea.gravity / (spectrum.peak * spectrum.peak);
    for (int i = 0; i < sea.cascade_count; i++) {
        lom_cascade_desc *c = &sea.cascade[i];
        double before = i == 0 ? length : sea.cascade[i - 1].length / 6.854;
        if (!resolve_size(c, i, error) ||
            !resolve_number(&c->length, before, 1e-3, 1e6, "patch length in metres", error))
            return false;
        if (c->seed == 0)
            c->seed = lom_random_bits(sea.seed, (uint64_t)i + 1);
    }
    for (int i = 0; i < sea.cascade_count; i++)
        if (!resolve_band(&sea, i, error))
            return false;
    *resolved = sea;
    return true;
}

/* Where 0 means none in a scene and the default in a description, it becomes the flag that says none. */
lom_sea_desc lom_scene_sea(const lom_water_waves *w)
{
    lom_sea_desc desc = { .spectrum = (lom_spectrum_kind)w->spectrum,
                          .wind_level = w->wind_level,
                          .wind_speed = w->wind_speed < 0.1 ? 0 : w->wind_speed,
                          .calm = (w->wind_level == NULL && w->wind_speed < 0.1) || w->height_scale < 1e-6,
                          .wind_direction = w->direction,
                          .fetch = w->fetch,
                          .depth = w->depth,
                          .height_scale = w->height_scale < 1e-6 ? 1 : w->height_scale,
                          .choppiness = w->choppiness,
                          .heights_only = w->choppiness < 1e-6,
                          .seed = (uint64_t)w->seed,
                          .cascade_count = w->cascades };
    for (int i = 0; i < w->cascades; i++)
        desc.cascade[i].size = w->size;
    desc.cascade[0].length = w->patch;
    return desc;
}
