/* The clear sky: single scattering by air and haze, in light of three wavelengths. */
#ifndef LOM_SKY_ATMOSPHERE_H
#define LOM_SKY_ATMOSPHERE_H

#include <lom/geometry.h>

enum { LOM_SKY_STEPS = 256 };

/* Everything that depends on the height of the sun, once; then any direction is a look-up. */
typedef struct lom_atmosphere {
    lom_vec3 sun;                        /* unit vector towards it */
    double air[LOM_SKY_STEPS + 1][3];    /* light scattered by air into a ray, without the phase; by sqrt(sine) */
    double haze[LOM_SKY_STEPS + 1][3];   /* the same by haze */
    double around[LOM_SKY_STEPS + 1][3]; /* what has been scattered more than once, evenly from all sides */
    double sunlight[3];                  /* part of the sun's light that arrives a few kilometres up */
} lom_atmosphere;

void lom_fill_atmosphere(lom_atmosphere *atmosphere, lom_vec3 sun, double haziness);
/* Radiance for a sun of irradiance 1 from a unit direction; below the horizon that of the horizon. */
void lom_atmosphere_at(const lom_atmosphere *atmosphere, lom_vec3 direction, double radiance[3]);

#endif
