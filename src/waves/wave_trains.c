/* Waves of a site in closed form (wave_trains.h). In: its parameters and its bed. Out: height and velocity of the water at
 * a place and a time. Invariant: a function of both and of the site alone. */
#include "waves/wave_trains.h"

#include "base/numbers.h"
#include "waves/river.h"
#include "waves/sea_desc.h"
#include "waves/sea_state.h"

static const double gravity = 9.80665;

/* ---- the strongest waves of a sea ---- */

/* Into trains by falling amplitude; of equal ones the first stays before. */
static void insert(struct lom_wave_trains *trains, const lom_trochoid *wave)
{
    int at = trains->count < LOM_MOST_TRAINS ? trains->count++ : LOM_MOST_TRAINS - 1;
    for (; at > 0 && trains->trains[at - 1].amplitude < wave->amplitude; at--)
        trains->trains[at] = trains->trains[at - 1];
    trains->trains[at] = *wave;
}

/* Of h = sum of H exp(i k.p) the waves h0(k) and conj(h0(-k)) of -k and k make 2 |h0| cos(k.p - w t + arg h0). Those of
 * the first cascade, which has the longest, are the strongest but for a few. */
static bool find_sea(struct lom_wave_trains *trains, const lom_water_waves *waves, lom_error *error)
{
    const lom_sea_desc desc = lom_scene_sea(waves);
    lom_sea sea = { .desc = desc };
    if (!lom_resolve_sea(&desc, &sea.desc, error))
        return false;
    if (sea.desc.calm)
        return true;
    sea.spectrum = lom_sea_spectrum(&sea.desc);
    const int half = sea.desc.cascade[0].size / 2;
    const double step = lom_two_pi / sea.desc.cascade[0].length;
    for (int m = 1 - half; m < half; m++)
        for (int n = 1 - half; n < half; n++) {
            double h0[2];
            lom_wave_amplitude(&sea, 0, n, m, h0);
            const double size = 2 * lom_double_sqrt(h0[0] * h0[0] + h0[1] * h0[1]);
            if (!(size > 0) ||
                (trains->count == LOM_MOST_TRAINS && size <= trains->trains[LOM_MOST_TRAINS - 1].amplitude))
                continue;
            const double length = lom_double_sqrt((double)n * n + (double)m * m), number = step * length;
            insert(trains, &(lom_trochoid){
                               .direction = { n / length, m / length },
                               .number = number,
                               .rate = lom_dispersion(number, sea.spectrum.depth, sea.spectrum.gravity),
                               .phase = lom_double_atan2(h0[1], h0[0]) / lom_two_pi,
                               .amplitude = size,
                           });
        }
    return true;
}

/* ---- a river ---- */

static bool find_flow(struct lom_wave_trains *trains, const struct lom_wave_site *site, lom_error *error)
{
    enum { CELLS = LOM_RIVER_CELLS };
    double *depth = lom_allocate((size_t)CELLS * CELLS, sizeof *depth, error);
    if (depth == NULL)
        return false;
    lom_find_river_depths(site, depth);
    trains->river = lom_make_river(depth, CELLS, site->waves->direction, error);
    lom_release(depth);
    trains->flow = site->waves->speed;
    for (int i = 0; i < 2; i++)
        trains->size[i] = site->bed.heights != NULL ? site->bed.size[i] : site->size[i];
    for (int i = 0; trains->river != NULL && i < CELLS * CELLS; i++) {
        const float *v = lom_image_pixel(trains->river, i % CELLS, i / CELLS, 0);
        const double x = (double)v[0], z = (double)v[1];
        trains->fastest = lom_larger(trains->fastest, trains->flow * lom_double_sqrt(x * x + z * z));
    }
    return trains->river != NULL;
}

/* Bilinear between the cells, the first and the last of which are on the border. */
static void add_flow(const struct lom_wave_trains *trains, double x, double z, struct lom_water_motion *motion)
{
    enum { LAST = LOM_RIVER_CELLS - 1 };
    const double place[2] = { x, z };
    int cell[2];
    double part[2];
    for (int i = 0; i < 2; i++) {
        const double at = (place[i] / trains->size[i] + 0.5) * LAST, within = at > 0 ? lom_smaller(at, LAST) : 0;
        cell[i] = lom_int_of(lom_smaller(lom_double_floor(within), LAST - 1));
        part[i] = within - cell[i];
    }
    for (int corner = 0; corner < 4; corner++) {
        const int dx = corner & 1, dz = corner >> 1;
        const float *v = lom_image_pixel(trains->river, cell[0] + dx, cell[1] + dz, 0);
        const double weight = (dx ? part[0] : 1 - part[0]) * (dz ? part[1] : 1 - part[1]) * trains->flow;
        motion->velocity[0] += weight * (double)v[0];
        motion->velocity[1] += weight * (double)v[1];
    }
}

/* ---- all of them ---- */

bool lom_find_wave_trains(struct lom_wave_trains *trains, const struct lom_wave_site *site, lom_error *error)
{
    *trains = (struct lom_wave_trains){ .surf = *site->surf };
    for (int i = 0; i < 2; i++)
        trains->middle[i] = site->middle[i];
    if (site->bed.heights != NULL && !lom_make_site_surf(&trains->map, site, error))
        return false;
    switch (site->waves->kind) {
    case LOM_WAVES_GERSTNER:
        trains->count = lom_make_trochoids(site->waves, trains->trains, NULL, error);
        break;
    case LOM_WAVES_SEA:
        return find_sea(trains, site->waves, error);
    case LOM_WAVES_FLOW:
        return find_flow(trains, site, error);
    case LOM_WAVES_NONE:
        break;
    }
    return trains->count >= 0;
}

void lom_free_wave_trains(struct lom_wave_trains *trains)
{
    lom_free_surf_map(&trains->map);
    lom_free_image(trains->river);
    *trains = (struct lom_wave_trains){ .count = 0 };
}

/* A wave that breaks moves its water no faster than itself. */
static void add_surf(const struct lom_wave_trains *trains, double x, double z, double time,
                     struct lom_water_motion *motion)
{
    struct lom_surf_uniform moment;
    double shift[3];
    lom_fill_surf(&moment, &trains->map, &trains->surf, (double[2]){ 0, 0 }, time);
    lom_surf_shift(&trains->map, &moment, x, z, shift);
    const struct lom_surf_place at = lom_surf_place_at(&trains->map, x, z);
    const double number = lom_double_sqrt(at.k[0] * at.k[0] + at.k[1] * at.k[1]);
    const double rate = lom_two_pi / trains->surf.period;
    if (!(number > 0))
        return;
    const double speed = rate / number, u = shift[1] * gravity / speed;
    const double bounded = u > speed ? speed : u < -speed ? -speed : u;
    motion->height += shift[1];
    for (int i = 0; i < 2; i++)
        motion->velocity[i] += bounded * at.k[i] / number;
}

struct lom_water_motion lom_water_motion_at(const struct lom_wave_trains *trains, double x, double z, double time)
{
    struct lom_water_motion motion = { .height = 0 };
    for (int i = 0; i < trains->count; i++) {
        const lom_trochoid *t = &trains->trains[i];
        const double phase = lom_trochoid_phase(t, x - trains->middle[0], z - trains->middle[1], time);
        const double height = t->amplitude * lom_double_cos(phase), u = height * gravity * t->number / t->rate;
        motion.height += height;
        for (int k = 0; k < 2; k++)
            motion.velocity[k] += u * t->direction[k];
    }
    if (trains->map.cells != NULL)
        add_surf(trains, x, z, time, &motion);
    if (trains->river != NULL)
        add_flow(trains, x, z, &motion);
    return motion;
}

struct lom_water_motion lom_bound_water_motion(const struct lom_wave_trains *trains)
{
    struct lom_water_motion bound = { .velocity = { trains->fastest, 0 } };
    for (int i = 0; i < trains->count; i++) {
        const lom_trochoid *t = &trains->trains[i];
        bound.height += t->amplitude;
        bound.velocity[0] += t->amplitude * gravity * t->number / t->rate;
    }
    if (trains->map.cells != NULL) { /* no wave is faster than in deep water */
        bound.height += trains->map.highest * (1 + trains->surf.variation);
        bound.velocity[0] += gravity * trains->surf.period / lom_two_pi;
    }
    bound.velocity[1] = bound.velocity[0];
    return bound;
}
