/* Waves that come in from the open water to a shore: how a train of one period shoals, turns and breaks over a bed,
 * worked out once as maps over the bed. Any moment then follows from the maps and the time.
 *
 * With w = 2 pi / period, depth d: w^2 = g k tanh(k d) gives the wave number k; the phase is the eikonal |grad theta| =
 * k, so crests turn to the shore as k grows; the flux of energy H^2 c_g is kept along the rays (in shallow water H
 * d^1/4 then is constant: Green's law) until H > 0.78 d (McCowan 1894), from where on waves lose K/d of what their flux
 * is above that of the stable height 0.4 d, K = 0.15 (Dally, Dean, Dalrymple 1985). */
#ifndef LOM_WAVES_SURF_H
#define LOM_WAVES_SURF_H

#include "waves/wave_lanes.h"

struct lom_surf_desc {
    int width, height;   /* of the grid, 4..4097 */
    double spacing[2];   /* metres from column to column (x) and from row to row (z) */
    const double *depth; /* metres of water at rest, negative on land */
    lom_water_surf surf;
};

/* A cell of the maps. */
struct lom_surf_cell {
    float phase, kx, kz, amplitude;     /* theta in radians, its gradient in rad/m, half the height in metres */
    float skew, lean, breaking, unused; /* r cos f and r sin f of the wave's shape; 0 whole .. 1 breaking */
};

/* How a wave plunges there (waves/surf_curl.h). */
struct lom_surf_curl_cell {
    float since, strength, lead, crest; /* radians since it began to break, negative before; 0 not at all .. 1; how much
                                           earlier a wave breaks that is twice as high, radians; the crest's angle */
    float span, top, drop, unused;      /* radians from crest to the trough ahead; height of the crest over the level
                                           and over that trough, in amplitudes */
};

struct lom_surf_map {
    int width, height;
    double corner[2], spacing[2]; /* of the first cell in the world, metres: the caller's to set */
    double along[2];              /* unit vector along the crests where they come in */
    double length;                /* metres from crest to crest there */
    double highest;               /* largest height, metres */
    double breaking_depth;        /* largest depth in which a wave breaks; 0: none does */
    double farthest;              /* metres that a curl is thrown ahead, of a wave of mean height */
    double plunging_slope[2];     /* least and largest Iribarren number of waves that plunge; 0: none does */
    struct lom_surf_cell *cells;
    struct lom_surf_curl_cell *curls; /* NULL: waves spill */
};

/* The wave number (rad/m) of waves of this angular frequency (rad/s) in water of this depth (m), both above 0: Newton's
 * method on w^2 = g k tanh(k d). */
double lom_wave_number(double frequency, double depth);
/* Their group velocity, m/s: c/2 (1 + 2kd / sinh 2kd). */
double lom_group_velocity(double frequency, double depth);

/* Makes the maps. False when memory runs out; freed with lom_free_surf_map. */
bool lom_make_surf_map(struct lom_surf_map *map, const struct lom_surf_desc *desc, lom_error *error);
void lom_free_surf_map(struct lom_surf_map *map);

/* What the shaders need at a time for places less origin (x, z), but for the textures. */
void lom_fill_surf(struct lom_surf_uniform *out, const struct lom_surf_map *map, const lom_water_surf *surf,
                   const double origin[2], double time);
/* Surf at a place of the world: what the maps have there; beyond them the phase goes on straight. */
struct lom_surf_place {
    double phase, k[2], amplitude, skew, lean;
};
struct lom_surf_place lom_surf_place_at(const struct lom_surf_map *map, double x, double z);
/* By how much the wave at a place with this phase is higher than the mean, in its group, at a time of lom_fill_surf. */
double lom_surf_size(const struct lom_surf_uniform *moment, double phase, double x, double z);
/* How far the water is that rests at a place of the world, metres along x, up and along z, in double, at a time of
 * lom_fill_surf: up alone where waves spill. */
void lom_surf_shift(const struct lom_surf_map *map, const struct lom_surf_uniform *moment, double x, double z,
                    double shift[3]);
/* Height over a place of the world, metres, in double, at a time of lom_fill_surf; of a wave that overturns the upper
 * one. */
double lom_surf_height(const struct lom_surf_map *map, const struct lom_surf_uniform *moment, double x, double z);

#endif
