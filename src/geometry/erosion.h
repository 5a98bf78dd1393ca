/* How landscapes form: height fields in doubles that rivers, screes and rain work on. Heights and cell sizes are in one
 * unit; rows from the north (-z). Every step visits cells in a fixed order. */
#ifndef LOM_GEOMETRY_EROSION_H
#define LOM_GEOMETRY_EROSION_H

#include <lom/base.h>

typedef struct lom_field {
    int size;    /* size x size values */
    double cell; /* the distance of two neighbours */
    double *values;
} lom_field;

/* A field of zeros; values is NULL on failure. Freed with lom_release(values). */
lom_field lom_create_field(int size, double cell, lom_error *error);
/* Catmull-Rom interpolation at (x, y) in cells, x = 0 at the first value; clamped at the border. */
double lom_field_at(const lom_field *field, double x, double y);
/* A field of twice the size over the same ground. */
lom_field lom_double_field(const lom_field *field, lom_error *error);

typedef struct lom_rivers {
    const double
        *uplift;     /* height gained in a unit of time, for each cell; 0 and below: open water, height kept at 0 */
    double incision; /* K of dh/dt = uplift - K sqrt(area) slope; area in parts of the whole field */
    double talus[2]; /* the steepest slope that stands: of soil at height 0, of rock at `rock_height` and above */
    double rock_height;
    double creep; /* part of the way to the mean of its neighbours that soil goes in a step; rock a fifth of it */
    double step;  /* of time */
    int steps;
    uint64_t seed;
} lom_rivers;

/* Uplift against the incision of rivers (the stream power law, with the implicit solution of Braun and Willett 2013,
 * in the order of a priority flood, Barnes et al. 2014), steep slopes cut to the talus. Everything drains into the open
 * water, of which there has to be some. False without memory. */
bool lom_erode_by_rivers(lom_field *height, const lom_rivers *rivers, lom_error *error);

typedef struct lom_rain {
    int drops;
    double water_level; /* drops end there */
    uint64_t seed;
} lom_rain;

/* Single drops that run down, take soil where they are fast and leave it where they are slow (after H. Beyer:
 * Implementation of a method for hydraulic erosion, 2015). The field has at least 256 cells a side. */
void lom_erode_by_rain(lom_field *height, const lom_rain *rain);

/* Material slides down wherever a slope is over the talus; `rounds` sweeps. */
void lom_erode_by_gravity(lom_field *height, double talus, int rounds);

#endif
