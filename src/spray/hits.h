/* Where water throws drops: waves of surf at steep ground, the fast places of a river, and waves and rivers at an entity
 * that stands or floats in them. Found once; where a drop is at a time is then a closed form, as of other emitters.
 *
 * A wave of amplitude a and number k in water of depth d moves the water at its crest by u = a w / tanh(kd), at most by its
 * own speed c = w/k, where it breaks. Ground that stops it turns that speed upwards, and the crest stands a over the
 * level: by Bernoulli's law drops leave the level with v = sqrt(u^2 + 2 g a). */
#ifndef LOM_SPRAY_HITS_H
#define LOM_SPRAY_HITS_H

#include "spray/spray.h"
#include "waves/wave_trains.h"

enum { LOM_HIT_SIDES = 32 }; /* ways that water may come, evenly apart */

struct lom_hit_place {
    double place[2], level;  /* x, z and y of the water's edge; of an entity less its own x and z */
    double way[2];           /* unit vector of the waves or of the flow; of an entity its normal, outwards */
    double width;            /* metres across it */
    double amplitude, speed; /* of the wave, m and its c in m/s; of a river 0 and the flow's */
    double swing;            /* w / tanh(kd), 1/s */
    double phase;            /* of the wave there, radians */
    double arrival;          /* s, 0 <= arrival < period: when a front is there */
    uint32_t met_from; /* a bit a side: of an entity, whether water that goes that way (lom_hit_way) meets it first */
};

struct lom_hits {
    struct lom_hit_place *places; /* NULL: there are none */
    double *sum;                  /* of weights, up to each of them */
    size_t count, capacity;
    double period, fastest;  /* s, 0: water throws drops at all times; m/s of the largest waves */
    double low[3], high[3];  /* of the places */
    struct lom_surf_map map; /* without cells */
    lom_water_surf surf;     /* the site's */
    /* ---- of an entity: 1 + its number; 0: the places are of the bed ---- */
    size_t followed;
    bool moves;
    double heading;                /* at the time 0 */
    struct lom_wave_trains trains; /* what it meets */
    void (*follow)(const void *scene, size_t followed, double time, double place[2], double *heading); /* the site's */
    const void *scene; /* that of the frame: set before each */
};

/* An entity in the water: its mesh as it stands at the time 0. */
struct lom_hit_body {
    const lom_mesh *mesh;
    lom_mat4 world_from_model;
    size_t followed; /* 1 + its number */
    bool moves;      /* it has key frames */
};

/* The places of a spray's source in the rectangle of its segment; of source "entity" those of a body, or none where that
 * is NULL. False without memory; freed with lom_free_hits. */
bool lom_find_hits(struct lom_hits *hits, const lom_spray *spray, const struct lom_wave_site *site,
                   const struct lom_hit_body *body, lom_error *error);
void lom_free_hits(struct lom_hits *hits);
/* Speed with which the wave of this size (of lom_surf_size) throws its fastest drops. */
double lom_hit_speed(const struct lom_hit_place *place, double size);
/* lom_place_range of drops that begin there; alpha is 0 of those that wait for a wave. The emitter was checked. */
void lom_place_hits(const struct lom_hits *hits, const lom_emitter *emitter, double kick, double time, size_t first,
                    size_t end, lom_particle *particles);
/* The place that has the share `at` of the weights. */
const struct lom_hit_place *lom_find_hit_place(const struct lom_hits *hits, double at);
/* How much there is of a drop after a share of its life, which was thrown by this speed. */
double lom_hit_alpha(double share, double speed);
/* lom_bound_emitter of them. */
void lom_bound_hits(const struct lom_hits *hits, const lom_emitter *emitter, double kick, double low[3],
                    double high[3]);

/* ---- entities: waterline.c, entity_hits.c ---- */

/* The unit vector of a side. */
void lom_hit_way(int side, double way[2]);
/* The pieces of a body's mesh at a level, in the world. */
bool lom_find_waterline(struct lom_hits *hits, const struct lom_hit_body *body, double level, lom_error *error);
bool lom_find_entity_hits(struct lom_hits *hits, const struct lom_wave_site *site, const struct lom_hit_body *body,
                          lom_error *error);
lom_particle lom_entity_hit_at(const struct lom_hits *hits, const lom_emitter *e, double kick, size_t index,
                               double time);

#endif
