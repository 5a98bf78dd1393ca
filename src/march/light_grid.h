/* One slice of the sweep that carries optical depth along sheared rays (light_grid.c); the arithmetic is over lanes.
 * Slices across x, whose voxels lie far apart, are swept in slabs that are transposed before and after (slab.c). */
#ifndef LOM_MARCH_LIGHT_GRID_H
#define LOM_MARCH_LIGHT_GRID_H

#include <lom/march.h>

/* A slice has `height` rows of `width` voxels; the rays (u, v) that pass it lie at x = u - whole_x + part_x. */
struct lom_slice {
    int width, height;
    int rays_across;
    int whole_x, whole_y; /* voxel x lies between the rays x + whole_x - 1 and x + whole_x */
    float part_x, part_y; /* [0, 1[ */
    float scale;          /* optical depth a density step of a slice's thickness */
    float forward;        /* Harris */
    const uint16_t *voxels;
    size_t voxel_pitch; /* from row to row */
    float *rows;        /* scratch: 4 rows of lom_row_pitch */
    float *carried;     /* rows of lom_ray_pitch: optical depth before the slice */
    uint16_t *shares;   /* of the sun */
    size_t share_pitch; /* lom_slab_pitch */
};

enum { LOM_MOST_LANES = 16, LOM_SLAB = 16 };

/* Floats from row to row of the scratch: a border of 1, and room for the lanes beyond the last value. */
static inline size_t lom_row_pitch(int width)
{
    return (size_t)width + 2 + LOM_MOST_LANES;
}

static inline size_t lom_ray_pitch(int rays_across)
{
    return (size_t)rays_across + 2 + LOM_MOST_LANES;
}

/* From row to row of what is swept in a slab. */
static inline size_t lom_slab_pitch(int width)
{
    return ((size_t)width + LOM_MOST_LANES - 1) / LOM_MOST_LANES * LOM_MOST_LANES;
}

typedef void lom_slice_sweep(const struct lom_slice *slice);

/* Adds the slice to the rays that pass it and stores what its voxels see. */
void LOM_WIDE(lom_sweep_slice)(const struct lom_slice *slice);

/* lom_sweep_sun with the slices swept by one of these: the bytes do not depend on which. */
bool lom_sweep_sun_by(lom_slice_sweep *sweep, lom_light_grid *grid, const lom_light_desc *desc, lom_error *error);

/* The voxels first <= x < first + count (at most LOM_SLAB), a slice across x after the other: a row of a slice is along
 * y, of lom_slab_pitch(height); its rows are along z. */
void lom_read_slab(const lom_light_grid *grid, int first, int count, uint16_t *slab);
/* The sun's shares of those voxels, in that order, into the grid. */
void lom_write_slab(lom_light_grid *grid, int first, int count, const uint16_t *shares);
/* The sun's shares of a row of voxels. */
static inline void lom_write_shares(int32_t *light, const uint16_t *shares, int count)
{
    for (int i = 0; i < count; i++)
        light[i] = (light[i] & ~0xffff) | shares[i];
}

#endif
