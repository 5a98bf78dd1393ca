/* What the waves of a scene stand on: its parameters and its bed, without a device. */
#ifndef LOM_WAVES_WAVE_SITE_H
#define LOM_WAVES_WAVE_SITE_H

#include "waves/surf.h"

#include <lom/shallow.h>
#include <lom/waves.h>

/* The terrain's vertices: (columns + 1) x (rows + 1) heights over `base` (y) and over `size` (x, z) metres about the
 * world's origin, row by row. */
struct lom_bed {
    const float *heights; /* NULL: the scene has no terrain, and the bed is deep */
    int columns, rows;    /* quads */
    double size[2], base;
};

struct lom_wave_site {
    const lom_water_waves *waves;
    const lom_water_foam *foam;
    const lom_water_surf *surf;
    const lom_shallow_water *shallow;
    const lom_water_wake *wakes; /* `wake_count` of them */
    size_t wake_count;
    double level;           /* of the water at rest, y in metres */
    double middle[2];       /* of the water, x and z in metres: trochoids, seas and ripples are counted from there */
    double size[2];         /* of the water, metres */
    double tile, ripple_up; /* metres of one repetition of its ripples; the factor on their up component */
    bool is_rippled;        /* its normal map shows where it has no waves, */
    double ripple_speed;    /* and drifts by so many repetitions a second */
    struct lom_bed bed;
    /* Where entity number followed - 1 is at a time (x, z), and where its -z points, radians from +x towards +z. */
    void (*follow)(const void *scene, size_t followed, double time, double place[2], double *heading);
    const void *scene;
};

/* The height (y) of a bed that has heights, between its vertices; beyond its edge that of the edge. */
double lom_bed_height(const struct lom_bed *bed, double x, double z);
/* The height of the terrain between its vertices over the water's level; deep below it where there is none. */
double lom_bed_over_level(const struct lom_wave_site *site, double x, double z);

/* ---- surf ---- */

/* The maps of its surf over the bed, placed in the world; without cells where it has none. Freed with
 * lom_free_surf_map. */
bool lom_make_site_surf(struct lom_surf_map *map, const struct lom_wave_site *site, lom_error *error);

/* ---- shallow water ---- */

struct lom_shallow_region {
    lom_shallow *first, *now; /* before the first step; after the last one, or NULL. first NULL: there is none */
    double corner[2], cell;   /* x and z of its corner, metres */
    double lowest;            /* of its bed, metres from the level, or 0 */
    int columns, rows;
    uint64_t run;             /* steps, in all */
    float *foam, *foam_after; /* of each cell, carried up to `now`; NULL: it is not carried */
};

/* The region before its first step; nothing where the site has none. What has been made is freed with
 * lom_close_shallow_region, also after a failure. */
bool lom_open_shallow_region(struct lom_shallow_region *region, const struct lom_wave_site *site, lom_error *error);
void lom_close_shallow_region(struct lom_shallow_region *region);
/* shallow_foam.c: what a step does to the foam, after it: the water takes it along, it fades, and it is made where water is
 * faster than its waves and where a body has moved from place to place. */
void lom_carry_shallow_foam(struct lom_shallow_region *region, const struct lom_wave_site *site,
                            const lom_shallow_obstacle *bodies, const lom_shallow_obstacle *before);
/* Runs the steps from the start of [shallow] to a time: on from the last time, or from the beginning when that was
 * later. The state is that after all of them, so any moment alone is that of a run. */
bool lom_advance_shallow_region(struct lom_shallow_region *region, const struct lom_wave_site *site, double time,
                                lom_error *error);

#endif
