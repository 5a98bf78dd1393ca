/* The surface of shallow water as shaders look it up. */
#ifndef LOM_WAVES_SHALLOW_SURFACE_H
#define LOM_WAVES_SHALLOW_SURFACE_H

#include "base/threads.h"

#include <lom/shallow.h>

/* A texel a cell. surface: height over `level`, its slopes along x and z, foam; moments: squares and product of the
 * slopes, 0. A dry cell has the heights of the wet ones around it, but never above 5 cm (times lom_shallow_film)
 * below the beds around it, so that the terrain cuts the surface where the water ends. Foam is where water runs
 * faster than its waves (the Froude number from 0.7 on). fades: heights and slopes fall to 0 over the outermost
 * cells. Writes the lowest and the highest height, bounded by 1000 m; with `carried`, foam is that instead. Rows are
 * shared by a pool's workers, where it is not NULL. Returns how many cells are wet. */
enum { LOM_SHALLOW_BOUND = 1000 };
int lom_fill_shallow_surface(const lom_shallow_view *view, lom_pool *pool, double level, bool fades,
                             const float *carried, float (*surface)[4], float (*moments)[4], float bounds[2]);

/* By what thicknesses are multiplied from which on water is wet, or carries foam, so that a model of a lake is as wet
 * as the lake: the power of two at or below the cell (metres, 1e-3..1e5) over 0.25, for which they are given. */
double lom_shallow_film(double cell);

/* Foam that water of this speed (m/s) makes in this depth (metres, above 0), 0 none .. 1: none below a Froude number of
 * 0.7. */
double lom_froude_foam(double speed, double depth);
/* Foam that water makes in a cell, 0 none .. 1. */
double lom_shallow_froude_foam(const lom_shallow_view *view, int x, int z);

/* The texel over a place in cells from the region's corner, between cell middles; the nearest ones outside. */
void lom_sample_shallow_surface(const lom_shallow_view *view, const float (*surface)[4], double x, double z,
                                double texel[4]);

#endif
