/* lom/waves.h - the parameters of every kind of waves, as the scene file gives them, and trochoids in closed form. A
 * sea of thousands of waves is lom/sea.h, water that flows over a bed lom/shallow.h. */
#ifndef LOM_WAVES_H
#define LOM_WAVES_H

#include <lom/sea.h>
#include <lom/shallow.h>

LOM_API_BEGIN

/* ---- [water.waves] ---- */

enum { LOM_MAX_WAVES = 64 };

typedef enum lom_waves_kind {
    LOM_WAVES_NONE,
    LOM_WAVES_GERSTNER,
    LOM_WAVES_SEA,
    LOM_WAVES_FLOW /* a river: ripples of the normal map, carried by a flow that the terrain and the level make */
} lom_waves_kind;

/* The waves on the surface. Gerstner: `count` trochoids of geometrically spaced lengths about one direction. Sea: the
 * cascades of lom/sea.h. An angle is measured from +x towards +z and says where the waves travel to. */
typedef struct lom_water_waves {
    bool present;
    lom_waves_kind kind;
    double direction; /* radians */
    int seed;
    double height;              /* Gerstner: four standard deviations of the surface, metres */
    double length[2];           /* Gerstner: the longest and the shortest wave, metres */
    int count;                  /* Gerstner: 1..LOM_MAX_WAVES */
    double steepness;           /* Gerstner: 0 sines .. 1 the sum of all waves touches a cusp somewhere, never a loop */
    double spread;              /* Gerstner: standard deviation of the waves' directions, radians */
    lom_spectrum_kind spectrum; /* sea */
    const char *wind_level;     /* sea: a name of the Beaufort scale, or NULL: wind_speed */
    double wind_speed;          /* sea: m/s at 10 m */
    double fetch, depth;        /* sea: metres; depth 0 is deep water */
    double height_scale;        /* sea: factor on the heights */
    double choppiness;          /* sea: factor on the horizontal displacement */
    int cascades, size;         /* sea: how many, and samples a side of each */
    double speed;               /* flow: its mean, m/s */
    double cell;                /* displaced: pixels between the vertices of the mesh */
    double patch;               /* sea: metres of the largest cascade; 0: six peak wavelengths */
} lom_water_waves;

/* ---- [water.foam]: what waves leave where they break ---- */

typedef struct lom_water_foam {
    bool present;
    double amount;      /* 0: no foam .. 1 */
    double threshold;   /* Jacobian below which waves break */
    double window;      /* seconds that foam lasts: it is the decaying sum of what broke in them */
    bool carried;       /* it goes with the water: that of surf to and fro, that of shallow water where it flows */
    double shore_depth; /* metres of water that the shore's foam reaches to; 0: none */
    double tile;        /* metres of one repetition of its pattern */
} lom_water_foam;

/* ---- [surf] ---- */

/* Waves that come in to a shore: one period, whose crests turn and rise over the bed and break. */
/* How waves of surf break: LOM_SURF_AUTO by the slope of the bed. */
typedef enum lom_surf_breaking { LOM_SURF_SPILLING, LOM_SURF_PLUNGING, LOM_SURF_AUTO } lom_surf_breaking;

typedef struct lom_water_surf {
    bool present;
    double height;    /* metres where they reach the terrain; 0: there are none */
    double period;    /* seconds */
    double direction; /* radians, as of lom_water_waves */
    double variation; /* of the heights, in groups of crests and along them: 0 none .. 0.9 */
    int breaking;     /* lom_surf_breaking */
    double plunging;  /* where they plunge, how far: 0 not at all .. 1 */
} lom_water_surf;

/* ---- [[wake]]: foam that a body leaves where it moves through the water ---- */

enum { LOM_MAX_WAKES = 16 };

typedef struct lom_water_wake {
    bool present;
    const char *entity; /* that leaves it */
    double heading;     /* where its bow is: radians from the entity's own +x to its +z */
    double half[2];     /* half axes of its waterline, metres: along and across */
    size_t followed;    /* number of the entity, plus one */
} lom_water_wake;

/* ---- [shallow]: the surface as a height field that flows over the terrain (lom/shallow.h) ---- */

typedef struct lom_shallow_spring {
    bool present;
    double position[2], radius; /* x and z, metres */
    double rate;                /* m^3/s */
} lom_shallow_spring;

typedef struct lom_shallow_body {
    bool present;
    const char *entity; /* that it goes with, or NULL */
    double position[2], half[2], draft;
    double heading;               /* radians from +x to +z: of the world, or of the entity that it goes with */
    double time, duration, every; /* of dipping in, seconds; duration 0: it is always in the water */
    size_t followed;              /* number of the entity, plus one; 0: none */
} lom_shallow_body;

typedef struct lom_shallow_water {
    bool present;
    double position[2], size[2]; /* of the region; the reader has put the water's here when the file gives none */
    int cells;                   /* along the longer side */
    double start;                /* seconds: when it stands still at the level */
    double step, friction, implicitness;
    lom_shallow_edge edge;
    lom_shallow_spring *springs;
    size_t spring_count;
    lom_shallow_body *bodies;
    size_t body_count;
} lom_shallow_water;

/* ---- trochoids: the waves of kind "gerstner", for programs ---- */

/* One wave. With t = number (direction . (x, z)) + 2 pi phase - rate time, the water at rest at (x, z) stands
 * amplitude cos t above the level and -across sin t along the direction from its place: a circle when both are equal
 * (Gerstner 1809), an ellipse when across is less (Fournier and Reeves 1986). */
typedef struct lom_trochoid {
    double direction[2]; /* unit vector, x and z */
    double number;       /* rad/m */
    double rate;         /* rad/s: sqrt(9.80665 number), that of deep water */
    double phase;        /* turns, 0 <= phase < 1 */
    double amplitude;    /* metres */
    double across;       /* metres, 0 <= across <= amplitude */
} lom_trochoid;

/* The sum of across times number over all waves is where crests stand: below 1 they are round, at 1 they touch a cusp
 * where all of them meet, above 1 they would loop. */
typedef struct lom_trochoid_report {
    double asked;     /* the sum that height and steepness ask for */
    double steepness; /* the sum that the waves have: at most 1 */
    int limited;      /* waves whose horizontal motion is less than what was asked for */
} lom_trochoid_report;

/* The trochoids that `waves` describes (height 0..100, lengths 1e-3..1e5 with the longest first, count
 * 1..LOM_MAX_WAVES, steepness 0..1, finite angles), into out[0 .. count - 1]; report may be NULL. Returns how many:
 * waves->count, or 0 where the height is 0; -1, with a sentence and nothing written, when a number is out of its range
 * or is none. */
int lom_make_trochoids(const lom_water_waves *waves, lom_trochoid out[LOM_MAX_WAVES], lom_trochoid_report *report,
                       lom_error *error);

typedef struct lom_trochoid_point {
    double place[3];  /* metres, y from the level */
    double normal[3]; /* unit vector, y above or at 0 */
    double jacobian;  /* of the horizontal motion: the area of a piece of water in parts of its area at rest, never
                         below 0 for the waves of lom_make_trochoids */
} lom_trochoid_point;

/* Where the water is that rests at (x, z), in double, for |x|, |z| <= 1e7 and |time| <= 1e9. A wave's phase is rounded
 * by less than 1e-15 (number (|x| + |z|) + rate |time|) radians: 1e-8 m of a wave of 10 m, 1 m high, at 10^7 m. */
lom_trochoid_point lom_trochoids_at(const lom_trochoid *trochoids, int count, double x, double z, double time);

LOM_API_END

#endif
