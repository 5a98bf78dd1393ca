/* Where water throws drops: waves of surf at steep ground, and the fast places of a river. Found once; where a drop is at
 * a time is then a closed form, as of other emitters.
 *
 * A wave of amplitude a and number k in water of depth d moves the water at its crest by u = a w / tanh(kd), at most by its
 * own speed c = w/k, where it breaks. Ground that stops it turns that speed upwards, and the crest stands a over the
 * level: by Bernoulli's law drops leave the level with v = sqrt(u^2 + 2 g a). */
#ifndef LOM_SPRAY_HITS_H
#define LOM_SPRAY_HITS_H

#include "spray/spray.h"
#include "waves/wave_site.h"

struct lom_hit_place {
    double place[2], level;  /* x, z and y of the water's edge */
    double way[2];           /* unit vector of the waves or of the flow */
    double width;            /* metres across it */
    double amplitude, speed; /* of the wave, m and its c in m/s; of a river 0 and the flow's */
    double swing;            /* w / tanh(kd), 1/s */
    double phase;            /* of the wave there, radians */
    double arrival;          /* s, 0 <= arrival < period: when a front is there */
};

struct lom_hits {
    struct lom_hit_place *places; /* NULL: there are none */
    double *sum;                  /* of weights, up to each of them */
    size_t count, capacity;
    double period, fastest;  /* s, 0: water throws drops at all times; m/s of the largest waves */
    double low[3], high[3];  /* of the places */
    struct lom_surf_map map; /* without cells */
    lom_water_surf surf;     /* the site's */
};

/* The places of a spray's source in the rectangle of its segment. False without memory; freed with lom_free_hits. */
bool lom_find_hits(struct lom_hits *hits, const lom_spray *spray, const struct lom_wave_site *site, lom_error *error);
void lom_free_hits(struct lom_hits *hits);
/* Speed with which the wave of this size (of lom_surf_size) throws its fastest drops. */
double lom_hit_speed(const struct lom_hit_place *place, double size);
/* lom_place_range of drops that begin there; alpha is 0 of those that wait for a wave. The emitter was checked. */
void lom_place_hits(const struct lom_hits *hits, const lom_emitter *emitter, double kick, double time, size_t first,
                    size_t end, lom_particle *particles);
/* lom_bound_emitter of them. */
void lom_bound_hits(const struct lom_hits *hits, const lom_emitter *emitter, double kick, double low[3],
                    double high[3]);

#endif
