/* One slice of the sweep that carries optical depth along sheared rays (light_grid.c); the arithmetic is over lanes. */
#ifndef LOM_MARCH_LIGHT_GRID_H
#define LOM_MARCH_LIGHT_GRID_H

#include <lom/march.h>

/* A slice has `height` rows of `width` voxels; the rays (u, v) that pass it lie at x = u - whole_x + part_x. */
struct lom_slice {
    int width, height;
    int rays_across, rays_down; /* of all rays */
    int whole_x, whole_y;       /* voxel x lies between the rays x + whole_x - 1 and x + whole_x */
    float part_x, part_y;       /* [0, 1[ */
    float scale;                /* optical depth a density step of a slice's thickness */
    float forward;              /* Harris */
    const uint16_t *voxels;
    size_t voxel_stride, row_stride;
    float *rows;    /* scratch: (height + 2) rows of width + 2 + LOM_MOST_LANES densities with a border of 0 */
    float *carried; /* rays_down rows of rays_across: optical depth before the slice */
    float *middle;  /* the same at the slice's middle */
    int32_t *light; /* of voxel (0, 0) */
    size_t light_voxel_stride, light_row_stride;
};

enum { LOM_MOST_LANES = 16 };

/* Floats from row to row of the scratch and of the rays. */
static inline size_t lom_slice_pitch(const struct lom_slice *slice)
{
    return (size_t)slice->width + 2 + LOM_MOST_LANES;
}

static inline size_t lom_ray_pitch(int rays_across)
{
    return (size_t)rays_across + 2 + LOM_MOST_LANES;
}

/* Adds the slice to the rays that pass it and stores what its voxels see. */
void LOM_WIDE(lom_sweep_slice)(const struct lom_slice *slice);

#endif
