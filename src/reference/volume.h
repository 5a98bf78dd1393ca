/* A volume of density as the reference holds it: voxels as numbers, in a box. */
#ifndef LOM_REFERENCE_VOLUME_H
#define LOM_REFERENCE_VOLUME_H

#include "reference/vectors.h"

#include <lom/reference.h>

struct lom_reference_volume {
    int size[3];
    float *density; /* x, then y, then z */
    double low[3], high[3];
    double voxels[3];  /* a metre along each axis */
    double extinction; /* 1/m where the density is 1 */
    double greatest;   /* extinction anywhere in it */
    lom_vec3 albedo;
    lom_reference_phase phase;
};

/* The part of from..to in which origin + t d is in the box; false when there is none. The box is closed on its low and
 * open on its high sides for rays along it: of two boxes that share a face, one has the rays in that face. */
bool lom_cross_volume(const lom_reference_volume *volume, lom_vec3 origin, lom_vec3 d, double *from, double *to);

/* Extinction at a place in the box. */
double lom_volume_extinction(const lom_reference_volume *volume, lom_vec3 place);

#endif
