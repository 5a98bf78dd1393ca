/* The waves of a site one place at a time, in double, as a closed form of place and time: what a thing that stands in the
 * water meets there. Nothing is stepped, no device is needed.
 *
 * Each is a train of progressive waves: at the surface, where one stands h over the level, the water moves along its way
 * by u = h g k / w (linear theory: h w / tanh(kd), with w^2 = g k tanh(kd)). Trochoids and surf are all there; of a sea
 * the strongest waves are, LOM_MOST_TRAINS of them; a river adds its flow. Shallow water is no closed form and left out. */
#ifndef LOM_WAVES_WAVE_TRAINS_H
#define LOM_WAVES_WAVE_TRAINS_H

#include "waves/wave_site.h"

enum { LOM_MOST_TRAINS = 256 };

struct lom_wave_trains {
    lom_trochoid trains[LOM_MOST_TRAINS]; /* room for LOM_MAX_WAVES trochoids */
    int count;
    double middle[2];        /* places of trains are counted from there */
    struct lom_surf_map map; /* cells NULL: there is no surf */
    lom_water_surf surf;
    lom_image *river; /* RG32F over `size` metres about the world's origin, in parts of `flow`; NULL: there is none */
    double size[2], flow, fastest; /* flow, fastest: m/s */
};

/* How the water is at a place: over its level, metres, and its speed at the surface along x and z, m/s. */
struct lom_water_motion {
    double height, velocity[2];
};

/* False without memory. Freed with lom_free_wave_trains, also after a failure. */
bool lom_find_wave_trains(struct lom_wave_trains *trains, const struct lom_wave_site *site, lom_error *error);
void lom_free_wave_trains(struct lom_wave_trains *trains);
struct lom_water_motion lom_water_motion_at(const struct lom_wave_trains *trains, double x, double z, double time);
/* No motion is higher, or faster, anywhere at any time. */
struct lom_water_motion lom_bound_water_motion(const struct lom_wave_trains *trains);

/* trochoids.c: number (direction . (x, z)) + 2 pi phase - rate time, without whole turns. */
double lom_trochoid_phase(const lom_trochoid *wave, double x, double z, double time);

#endif
