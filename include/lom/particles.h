/* lom/particles.h - drops of spray and of waterfalls whose places are closed forms of their number and the time: any
 * moment alone equals that moment of a run, in any order of calls; and the [[spray]] tables of a scene that are drawn
 * of them. Lengths are metres, times seconds, y is up. */
#ifndef LOM_PARTICLES_H
#define LOM_PARTICLES_H

#include <lom/base.h>

LOM_API_BEGIN

enum { LOM_MAX_PARTICLES = 1000000 };

/* Where particles begin, and how. All of them live at every time: the end of one life is the start of the next one,
 * and the particles' phases are spread evenly over the duration of a life. */
typedef struct lom_emitter {
    uint64_t seed;
    size_t count;       /* 0..LOM_MAX_PARTICLES */
    double from[3];     /* the two ends of the segment on which lives begin, |coordinate| <= 1e9 */
    double to[3];       /* (the lip of a fall) */
    double velocity[3]; /* mean at the start, m/s, |component| <= 1000 */
    double spread;      /* standard deviation of each horizontal component of it, m/s, 0..100 */
    double spread_up;   /* the same of the upward component */
    double wind[3];     /* velocity of the air, m/s, |component| <= 1000 */
    double drag;        /* 1/s, 0..1000: the rate at which a drop takes on the velocity of the air */
    double life;        /* s, 0.001..3600 */
    /* Jets, 0..LOM_MAX_PARTICLES; 0: every life begins anywhere on the segment. Else as many places of it at a time let
     * drops out, each for jet_time (s, 0.001..3600) within jet_width (metres, 0..1000; it tapers to the jet's ends),
     * with a velocity of their own that makes 0.8 of the spread; then the jet begins at another place. */
    int jets;
    double jet_time, jet_width;
} lom_emitter;

typedef struct lom_particle {
    double place[3];
    double velocity[3]; /* m/s */
    double share;       /* of its life that has passed, 0 <= share < 1 */
    double alpha;       /* 0 at birth and at death, 1 from a tenth of the life to nine tenths; continuous in time */
    int64_t life;       /* number of the life; negative before time 0 */
} lom_particle;

/* Writes place[3], and unless it is NULL now[3], the velocity there, of a drop age >= 0 seconds after it left `start`
 * with `velocity`. It falls at 9.80665 m/s^2 with Stokes drag, dv/dt = g - drag (v - wind), of which this is the exact
 * solution; drag 0 is the parabola. */
void lom_particle_flight(const double start[3], const double velocity[3], const double wind[3], double drag, double age,
                         double place[3], double now[3]);

/* Seconds in which a drop falls by `height` >= 0 from rest in still air; drag >= 0 as above. A fall from a lip to a
 * pool has this life. */
double lom_fall_time(double height, double drag);

/* All particles at a time, |time| <= 1e9, into particles[emitter->count]. False, with a sentence and nothing written,
 * when a number is out of its range or is no number. */
bool lom_place_particles(const lom_emitter *emitter, double time, lom_particle *particles, lom_error *error);

/* The order in which to blend: order[count] holds the numbers 0..count-1, largest depth first. Depths are compared by
 * sign, exponent and 8 bits of fraction (1 part in 256); equal ones keep the order of their numbers. A depth that is
 * negative, zero or no number counts as nearest. `scratch` has room for count numbers; depth, order and scratch do not
 * overlap. */
void lom_order_particles(const float *depth, size_t count, uint32_t *order, uint32_t *scratch);

/* ---- [[spray]] ---- */

/* Where drops of a spray begin. */
typedef enum lom_spray_source {
    LOM_SPRAY_SEGMENT, /* anywhere on the segment, at all times */
    LOM_SPRAY_SURF,    /* where and when waves of [surf] meet steep ground in the rectangle that the segment spans */
    LOM_SPRAY_RIVER,   /* where the river of [water.waves] runs faster than its waves, in that rectangle */
    LOM_SPRAY_ENTITY   /* where and when waves or a river meet an entity at its waterline, or it meets the water */
} lom_spray_source;

/* An emitter whose drops are drawn: each a round, soft spot of light, drawn out along its way. */
typedef struct lom_spray {
    bool present;
    const char *name; /* NULL when it has none; unique in the scene */
    bool visible;
    lom_spray_source source;
    const char *entity; /* of LOM_SPRAY_ENTITY: its name; else NULL */
    size_t followed;    /* 1 + its index; 0: none */
    double kick;        /* of surf, river and entity: speed of the fastest drops, in parts of the water's, 0..100 */
    int seed, count;
    double from[3], to[3], velocity[3], spread, spread_up, wind[3], drag; /* as of lom_emitter */
    int jets;
    double jet_time, jet_width;
    double life;     /* s; the reader has put the time of the fall here when the file gives a height */
    double height;   /* metres; 0: the file gives none */
    double bounce;   /* share of its speed that a drop keeps when it hits the ground, 0..1; 0: it falls through */
    double size[2];  /* radius at birth and at death, metres; linear between them */
    double stretch;  /* seconds of its way that a drop is drawn along; its light is spread over them */
    double color[3]; /* linear: the share of light that it sends on */
    double opacity;  /* of the middle of a drop that is not drawn out, 0..1 */
    double soft;     /* metres over which a drop fades before what stands behind it, and before the near plane */
    double forward;  /* of the lobe towards which drops throw the sun's light, 0..10 */
} lom_spray;

/* The emitter that a spray describes; its numbers are in their ranges when the scene's reader filled it. */
lom_emitter lom_spray_emitter(const lom_spray *spray);

/* A box that no drop leaves in its life: by the bounds of lom_random_normal. low[3], high[3]. */
void lom_bound_emitter(const lom_emitter *emitter, double low[3], double high[3]);

LOM_API_END

#endif
