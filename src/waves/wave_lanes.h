/* The waves of a surface, over lanes. In: a rest position (x, z), less an origin, and the size of what is sampled
 * there; out: where the surface is above it, how steep, and how rough below that size. A surface is the sum of
 * trochoids (Gerstner) and of the cascades of a sea; either may be absent.
 *
 * A trochoid of wave vector k, amplitude a and phase f, with t = k.(x, z) + f: height a cos t; horizontal displacement
 * -b k/|k| sin t with b <= a, which narrows the crests (Gerstner 1809; Fournier and Reeves 1986). Signs and names of
 * derivatives are those of lom/sea.h.
 *
 * Invariant: what a filter takes from the slopes it adds to their covariance (Olano and Baker 2010, LEAN mapping: the
 * mean square less the squared mean), so that a far surface is as rough as a near one. */
#ifndef LOM_WAVES_WAVE_LANES_H
#define LOM_WAVES_WAVE_LANES_H

#include "shading/matrix.h"

#include <lom/waves.h>

enum { LOM_SURFACE_CASCADES = 4 };
enum { LOM_WAVES_A_PERIOD = 6 }; /* of the longest trochoids, as of the peak's waves in the patch of a sea */
enum { LOM_FOAM_MOMENTS = 4 };   /* of the window, at which trochoids are looked at */

struct lom_trochoid_uniform {
    float kx, kz;                        /* rad/m */
    float phase;                         /* radians at the origin at this time */
    float amplitude, across_x, across_z; /* metres: a, and b k/|k| */
    float turn[LOM_FOAM_MOMENTS][2]; /* cosine and sine of by how much the phase was larger at each moment of foam */
};

struct lom_cascade_uniform {
    const lom_texture *displacement; /* dx, h, dz, xz */
    const lom_texture *derivatives;  /* sx, sz, xx, zz */
    const lom_texture *moments;      /* sx^2, sz^2, sx sz, foam */
    float inverse_length, shift[2];  /* s = x inverse_length + shift[0], less whole repetitions */
};

/* Ripples of a normal map that a flow carries, in two phases: each drifts for a period and starts again where its
 * weight is 0. */
struct lom_river_uniform {
    const lom_texture *field; /* velocities in parts of the mean speed; NULL: no flow */
    const lom_texture *ripples;
    float corner[2], scale[2]; /* of the field over x and z */
    float inverse_tile, steepness;
    float drift[2], weight[2], jump[2][2];            /* metres at speed 1; shares; offsets in repetitions */
    bool carries_foam;                                /* the field holds it, behind the velocities */
    float foam_drift[2], foam_jump[2][2], foam_share; /* of its pattern: metres at speed 1, metres, share of phase 1 */
};

/* Ripples of a normal map on water that has no waves of its own: the map drifts, and the flow map moves its lookups. */
struct lom_ripple_uniform {
    const lom_texture *normals; /* NULL: no ripples */
    const lom_texture *flow;    /* or NULL: they stand still */
    float inverse_tile, shift[2], move, steepness;
};

/* A region whose surface is computed (waves/shallow_surface.h): a texel a cell. */
struct lom_shallow_uniform {
    const lom_texture *surface, *moments; /* NULL: there is none */
    float corner[2], scale[2];            /* s = (x - corner[0]) scale[0] */
};

/* Waves that come to a shore (waves/surf.h), by maps over it. */
struct lom_surf_uniform {
    const lom_texture *waves;    /* phase, kx, kz, amplitude; NULL: there are none */
    const lom_texture *shapes;   /* r cos f, r sin f, how much the wave breaks */
    const lom_texture *curls[2]; /* halves of struct lom_surf_curl_cell; NULL: waves spill */
    float corner[2], last[2];    /* x and z of the first and of the last cell */
    float scale[2], half[2];     /* a place is at (x - corner) scale + half */
    float time, rate;            /* w t in radians, less whole turns; w in rad/s */
    float swing;                 /* g / w^2, where the water takes foam along; else 0 */
    float variation, group_time[2], group_rate[2], group_share[2], group_along[2][2];
    double origin[2]; /* of the places */
};

/* The way of a body in the time before, the newest place first, in runs of steps: where its bow was, how far it has come
 * since, and how much foam of that time is left. */
enum { LOM_WAKE_STEPS = 8, LOM_WAKE_RUNS = 12 };
struct lom_wake_place {
    float x, z, way, foam;
};
struct lom_wake_run {
    struct lom_wake_place place[LOM_WAKE_STEPS + 1];
    float low[2], high[2]; /* no foam of the run is outside, but for the size of what is sampled */
};
struct lom_wake_track {
    struct lom_wake_run run[LOM_WAKE_RUNS];
    float half[2]; /* of the body's waterline, metres: along, and across with the foam at its sides */
};
struct lom_wakes_uniform {
    const struct lom_wake_track *tracks;
    int count; /* 0: there are none */
    bool is_carried;
};

struct lom_waves_uniform {
    double origin[3]; /* the place in the world that places are counted from */
    struct lom_river_uniform river;
    struct lom_ripple_uniform ripples;
    struct lom_shallow_uniform shallow;
    struct lom_surf_uniform surf;
    struct lom_wakes_uniform wakes;
    int trochoid_count, cascade_count;
    struct lom_trochoid_uniform trochoid[LOM_MAX_WAVES];
    struct lom_cascade_uniform cascade[LOM_SURFACE_CASCADES];
    float period;          /* metres after which the pattern of trochoids and cascades seems to repeat; 0: never */
    float level;           /* y at rest, less the origin's */
    float lowest, highest; /* bounds of h, metres from the level */
    float reach;           /* bound of |(dx, dz)| */
    float foam_threshold;  /* the Jacobian below which trochoids break; 0: none of them does, or there is no foam */
    float foam_window;     /* seconds that the foam lasts */
};

/* The trochoids of the water at a time in seconds, for places less `origin` (x, z): phases to 2^-51 of their
 * turns for |time| and |origin| up to 1e9; and the bounds of their sum. The horizontal amplitudes b = steepness min(a, 1 / (n k)) of n waves
 * keep the sum of b k at most 1, which is where the first loop would close: the Jacobian of the displacement never
 * falls below 0. */
void lom_fill_trochoids(struct lom_waves_uniform *out, const lom_water_waves *waves, const lom_water_foam *foam,
                        const double origin[2], double time);
/* Both phases of a flow at a time, for ripples that repeat after `tile` metres and places less `origin`: a period is as
 * long as the mean speed takes for a third of it. Closed in time. */
void lom_fill_river_phases(struct lom_river_uniform *river, double speed, double tile, const double origin[2],
                           double time);
/* The height over the point (x, z) itself, less the origin, in double: the rest position is found by iteration. */
double lom_trochoid_height(const struct lom_waves_uniform *waves, double x, double z);

struct lom_wave_shift {
    lom_float dx, h, dz;
};

/* Two vectors of the rest plane: from a sample to its neighbours. */
struct lom_footprint {
    lom_float ax, az, bx, bz;
};

struct lom_wave_slopes {
    lom_float sx, sz, xx, zz, xz;
    lom_float vxx, vzz, vxz;           /* covariance of the slopes that are too small to be seen */
    lom_float foam;                    /* 0 none .. 1 */
    lom_float drift_x, drift_z;        /* metres that the water there has come, with the foam on it */
    lom_float again, again_x, again_z; /* the share of a second phase of the foam's pattern, and its way instead */
    lom_mask overturns;                /* where a wave plunges: its upper side may look down */
};

/* The level of a texture of `scale` repetitions a metre for a footprint. */
LOM_INLINE lom_float lom_wave_lod(const lom_texture *texture, const struct lom_footprint *f, float scale)
{
    return lom_lod_of(texture, f->ax * scale, f->az * scale, f->bx * scale, f->bz * scale);
}

/* Where the water is that rests at (x, z), less (x, 0, z) and the level; what is smaller than the footprint is left
 * out. One function a width, so that no shader has a copy. */
void LOM_WIDE(lom_displace_lanes)(const struct lom_waves_uniform *waves, const lom_float *x, const lom_float *z,
                                  const struct lom_footprint *f, struct lom_wave_shift *shift);
void LOM_WIDE(lom_find_slopes_lanes)(const struct lom_waves_uniform *waves, const lom_float *x, const lom_float *z,
                                     const struct lom_footprint *f, struct lom_wave_slopes *slopes);
/* Both, bit for bit: the sine and cosine of a trochoid are found once. */
void LOM_WIDE(lom_find_waves_lanes)(const struct lom_waves_uniform *waves, const lom_float *x, const lom_float *z,
                                    const struct lom_footprint *f, struct lom_wave_shift *shift,
                                    struct lom_wave_slopes *slopes);

LOM_INLINE struct lom_wave_shift lom_displace(const struct lom_waves_uniform *waves, lom_float x, lom_float z,
                                              const struct lom_footprint *f)
{
    struct lom_wave_shift shift;
    LOM_WIDE(lom_displace_lanes)(waves, &x, &z, f, &shift);
    return shift;
}

LOM_INLINE struct lom_wave_slopes lom_find_slopes(const struct lom_waves_uniform *waves, lom_float x, lom_float z,
                                                  const struct lom_footprint *f)
{
    struct lom_wave_slopes slopes;
    LOM_WIDE(lom_find_slopes_lanes)(waves, &x, &z, f, &slopes);
    return slopes;
}

/* The cross product of the tangents (1 + xx, sx, xz) and (xz, sz, 1 + zz), upwards but where a wave overturns;
 * straight up where it vanishes. */
LOM_INLINE lom_float3 lom_wave_normal(const struct lom_wave_slopes *w)
{
    lom_float a = 1.0f + w->xx, b = 1.0f + w->zz;
    lom_float3 n = { w->xz * w->sz - w->sx * b, a * b - w->xz * w->xz, w->xz * w->sx - w->sz * a };
    lom_float least = lom_splat(0.02f); /* a fold shows its upper side */
    if (lom_any(w->overturns))
        least =
            lom_select(w->overturns & (lom_abs(n.x) + lom_abs(n.y) + lom_abs(n.z) > 1e-3f), lom_splat(-1e6f), least);
    n.y = lom_max(n.y, least);
    return lom_normalize3(n);
}

#endif
