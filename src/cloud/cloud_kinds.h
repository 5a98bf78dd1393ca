/* How each kind of cloud is made: a function for each, in the table of cloud_kinds.c. Densities go to an R16 volume
 * that the caller has sized. */
#ifndef LOM_CLOUD_KINDS_H
#define LOM_CLOUD_KINDS_H

#include <lom/cloud.h>

typedef bool lom_cloud_maker(lom_image *volume, int variety, uint64_t seed, lom_error *error);

/* make_hemisphere.c: variety 1 multiplies by Perlin noise. */
lom_cloud_maker lom_make_hemisphere;
/* make_particles.c: varieties 0 Gaussian puffs, 1 Wyvill's falloff. */
lom_cloud_maker lom_make_particles;
/* make_automaton.c */
lom_cloud_maker lom_make_automaton;
/* make_formula.c: varieties 0 a ball, 1 the signal of Marschner and Lobb. */
lom_cloud_maker lom_make_formula;
/* make_body.c, make_layer.c: the variety is an index into their recipes. */
lom_cloud_maker lom_make_body, lom_make_layer;

/* Stores density x, clamped to [0, 1] and rounded. */
void lom_store_density(lom_image *volume, int x, int y, int z, double density);

/* The length of a box of a kind in parts of the kind's own (the cube root of their volumes' ratio), at most 1: a cloud
 * smaller than its kind keeps what light comes through it and how its detail looks, as `extinction` over, and
 * `detail_size` times, this. */
double lom_shrink_of_kind(const lom_cloud_kind *kind, const double size[3]);

#endif
