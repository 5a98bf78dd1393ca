/* A volume of density as the reference holds it: voxels as numbers, in a box. */
#ifndef LOM_REFERENCE_VOLUME_H
#define LOM_REFERENCE_VOLUME_H

#include "reference/vectors.h"

#include <lom/reference.h>

struct lom_reference_volume {
    int size[3];
    float *density; /* x, then y, then z */
    float *detail;  /* likewise, detail_side voxels a side; NULL: none */
    int detail_side;
    double detail_strength, detail_size;
    double low[3], high[3];
    double voxels[3];  /* a metre along each axis */
    double extinction; /* 1/m where the density is 1 */
    double greatest;   /* extinction anywhere in it */
    lom_vec3 albedo;
    lom_reference_phase phase;
    lom_transfer_point transfer[LOM_MAX_TRANSFER];
    size_t transfer_count; /* 0: none */
    lom_volume_look look;
};

/* The part of from..to in which origin + t d is in the box; false when there is none. The box is closed on its low and
 * open on its high sides for rays along it: of two boxes that share a face, one has the rays in that face. */
bool lom_cross_volume(const lom_reference_volume *volume, lom_vec3 origin, lom_vec3 d, double *from, double *to);

/* Density and extinction at a place in the box. */
double lom_volume_density(const lom_reference_volume *volume, lom_vec3 place);
double lom_volume_extinction(const lom_reference_volume *volume, lom_vec3 place);
/* Against the gradient of the density there, by differences over two voxels, towards where d comes from; of unit length,
 * or 0 where the density is even. */
lom_vec3 lom_volume_normal(const lom_reference_volume *volume, lom_vec3 place, lom_vec3 d);

/* transfer.c: what is no transfer function, told in a sentence. */
bool lom_check_transfer_points(const lom_transfer_point *points, size_t count, lom_error *error);
/* Extinction in parts of the volume's (the density without a function), and what is left of light that it meets. */
double lom_seen_extinction(const lom_reference_volume *volume, double density);
lom_vec3 lom_seen_color(const lom_reference_volume *volume, double density);
/* The mean of the extinction over densities from a to b. */
double lom_mean_extinction(const lom_reference_volume *volume, double a, double b);

#endif
