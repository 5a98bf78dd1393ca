/* The foam of wakes over lanes. In: the ways of bodies in the time before (wake_waves.c), rest positions, the size of what
 * is sampled there. Out: foam, and how far the water has spread with it. Part of wave_lanes.wide.c; invariant as there. */
#ifndef LOM_WAVES_WAKE_LANES_H
#define LOM_WAVES_WAKE_LANES_H

#include "waves/wave_lanes.h"

static const float wake_ends = 4;

/* The strongest foam that any step has at a place, and where the water with it was beside the way. */
struct wake_foam {
    lom_float foam, away_x, away_z;
};

/* Half the width of a wake `way` metres behind the bow: the waterline's ellipse to its middle, its width as far as the
 * stern, and then `spread` times that, the fourth root of the way in lengths of the body; nothing before the bow. */
static lom_float wake_half(const struct lom_wake_track *track, lom_float way, lom_float *spread)
{
    const float length = 2.0f * track->half[0];
    lom_float short_of = 1.0f - lom_min(way * (1.0f / track->half[0]), lom_splat(1.0f));
    lom_float hull = lom_sqrt(lom_max(1.0f - short_of * short_of, (lom_float){ 0 }));
    *spread = lom_sqrt(lom_sqrt(lom_max(way * (1.0f / length), lom_splat(1.0f))));
    return lom_min(track->half[1] * hull * *spread, way * wake_ends);
}

/* From place to place; beyond its ends a step reaches a quarter as far as to its sides, which closes the outer side of a
 * turn and no more. Lanes that are not near the run leave it out, whoever shares their packet. What is sampled is as much wider as half a pixel is across the way, and has as much less. */
static void add_wake_step(const struct lom_wake_track *track, const struct lom_wake_place *a, lom_mask near,
                          lom_float x, lom_float z, const struct lom_footprint *f, struct wake_foam *most)
{
    const struct lom_wake_place *b = a + 1;
    const float dx = b->x - a->x, dz = b->z - a->z, square = dx * dx + dz * dz;
    const float inverse = square > 0 ? 1 / square : 0;
    lom_float from_x = x - a->x, from_z = z - a->z;
    lom_float along = (from_x * dx + from_z * dz) * inverse, share = lom_saturate(along);
    lom_float beyond = (along - share) * (along - share) * (wake_ends * wake_ends * square);
    lom_float away_x = from_x - along * dx, away_z = from_z - along * dz, spread; /* across the way */
    lom_float half = wake_half(track, a->way + share * (b->way - a->way), &spread);
    lom_float across = lom_max(lom_abs(f->az * dx - f->ax * dz), lom_abs(f->bz * dx - f->bx * dz));
    lom_float wide = half + lom_sqrt(across * across * (0.25f * inverse)) + 1e-6f;
    lom_float square_off = (away_x * away_x + away_z * away_z + beyond) / (wide * wide);
    lom_float foam = (a->foam + share * (b->foam - a->foam)) * lom_saturate(2.0f - 2.0f * square_off) * (half / wide);
    lom_mask more = near & (foam > most->foam);
    lom_float moved = 1.0f - 1.0f / spread;
    most->foam = lom_select(more, foam, most->foam);
    most->away_x = lom_select(more, away_x * moved, most->away_x);
    most->away_z = lom_select(more, away_z * moved, most->away_z);
}

/* The foam of all wakes; where it is carried, its pattern has spread with the water from the width of the body. */
static void add_wakes(const struct lom_wakes_uniform *u, lom_float x, lom_float z, const struct lom_footprint *f,
                      struct lom_wave_slopes *w)
{
    struct wake_foam most = { { 0 }, { 0 }, { 0 } };
    lom_float reach_x = 0.5f * lom_max(lom_abs(f->ax), lom_abs(f->bx));
    lom_float reach_z = 0.5f * lom_max(lom_abs(f->az), lom_abs(f->bz));
    lom_float reach = reach_x + reach_z;
    for (int i = 0; i < u->count; i++)
        for (int k = 0; k < LOM_WAKE_RUNS; k++) {
            const struct lom_wake_run *run = &u->tracks[i].run[k];
            const lom_mask near = (x + reach > run->low[0]) & (x - reach < run->high[0]) & (z + reach > run->low[1]) &
                                  (z - reach < run->high[1]);
            if (!lom_any(near))
                continue;
            for (int s = 0; s < LOM_WAKE_STEPS; s++)
                add_wake_step(&u->tracks[i], &run->place[s], near, x, z, f, &most);
        }
    w->foam = w->foam + most.foam;
    if (!u->is_carried)
        return;
    w->drift_x = w->drift_x + most.away_x;
    w->drift_z = w->drift_z + most.away_z;
}

#endif
