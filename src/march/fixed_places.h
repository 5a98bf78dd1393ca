/* Where a packet of rays is in a volume, in whole parts of a voxel, and in which cells. In: rays; out: the places of a
 * step, and for LOM_LANES steps at once in how many cells the packet is.
 *
 * A place on an axis is a float in [2^23, 2^24), whose bits are those of 2^23 and the number of parts from the first
 * voxel's centre: adding rounds to whole parts, and the number is split into a cell and a weight without a conversion.
 * A voxel has 2^15 parts, or 2^14 in volumes of more than 256 voxels a side.
 *
 * Rounding never turns two numbers round: so with the least start and the least step of all lanes, and the same
 * operations, one gets a place that no lane is before, and with the greatest one that none is behind. Which cells a packet
 * is in is found for a vector of steps by these two, ahead of the steps, so that branches on it are known early. */
#ifndef LOM_MARCH_FIXED_PLACES_H
#define LOM_MARCH_FIXED_PLACES_H

#include "bundle.h"

enum { FIRST_PLACE = 0x4b000000 }; /* the bits of 2^23 */

struct places {
    lom_int x, y, z;
};

struct fixed_rays {
    const lom_volume *volume;
    lom_float3 start, step;        /* at step i: start + i step */
    float least[2][3], most[2][3]; /* of starts and of steps */
    bool bounded;                  /* no lane is beyond what floats hold */
    float offset[3];               /* whole parts from a sample to what shades it */
    float last[3];                 /* the place of the last voxel */
    int bits;                      /* a voxel has 2^bits parts */
};

/* To nearest, up to 2^24, from where on it leads out of every volume. */
LOM_INLINE float whole_parts(double x)
{
    const double cut = x > -0x1p24 ? x < 0x1p24 ? x : 0x1p24 : -0x1p24;
    return (float)lom_int_of(cut + (cut < 0 ? -0.5 : 0.5));
}

/* Lanes that are not active go where one that is goes: they keep nobody from sharing. */
LOM_INLINE lom_float with_all(lom_float x, lom_mask active, int lane)
{
    return lom_select(active, x, lom_splat(x[lane]));
}

static inline void fix_axis(struct fixed_rays *f, int axis, lom_float *start, lom_float *step, int size)
{
    const float parts = (float)(1 << f->bits), scale = (float)size * parts, first = 0x1p23f;
    const lom_mask all = lom_splat_int(-1);
    *start = *start * scale + (first - 0.5f * parts);
    *step *= scale;
    bounds(*start, all, &f->least[0][axis], &f->most[0][axis]);
    bounds(*step, all, &f->least[1][axis], &f->most[1][axis]);
    f->bounded &= lom_all((lom_abs(*start) < 0x1p60f) & (lom_abs(*step) < 0x1p60f));
    f->last[axis] = first + (float)(size - 1) * parts;
}

static inline struct fixed_rays fix_rays(const lom_march_rays *rays, const lom_march_desc *desc)
{
    const lom_volume *v = desc->volume;
    const bool large = v->width > 256 || v->height > 256 || v->depth > 256;
    const uint32_t active = lom_bits(rays->active);
    const int lane = active != 0 ? __builtin_ctz(active) : 0;
    struct fixed_rays f = { .volume = v, .bits = large ? 14 : 15, .bounded = true };
    f.start = (lom_float3){ with_all(rays->start.x, rays->active, lane), with_all(rays->start.y, rays->active, lane),
                            with_all(rays->start.z, rays->active, lane) };
    f.step = (lom_float3){ with_all(rays->step.x, rays->active, lane), with_all(rays->step.y, rays->active, lane),
                           with_all(rays->step.z, rays->active, lane) };
    fix_axis(&f, 0, &f.start.x, &f.step.x, v->width);
    fix_axis(&f, 1, &f.start.y, &f.step.y, v->height);
    fix_axis(&f, 2, &f.start.z, &f.step.z, v->depth);
    const int size[3] = { v->width, v->height, v->depth };
    for (int i = 0; i < 3; i++)
        f.offset[i] = whole_parts((double)desc->light_offset[i] * (double)(size[i] << f.bits));
    return f;
}

/* ---- a vector of steps ---- */

/* What a packet is in: the place of the lowest corner of its cells, that cell, and along which axes it is in two. */
struct cells_of_steps {
    int32_t corner[3][LOM_LANES], index[LOM_LANES];
    int32_t across[LOM_LANES]; /* bit i: along axis i; MANY_CELLS: in more than two somewhere */
};

enum { MANY_CELLS = 8 };

struct plan {
    int first;
    struct cells_of_steps at, over; /* of samples and of what shades them */
    int32_t within[LOM_LANES];      /* no lane is beyond the first and last voxel at either: not 0 */
};

/* Of places from low to high. */
static inline void find_cells(const struct fixed_rays *f, const lom_float low[3], const lom_float high[3],
                              struct cells_of_steps *cells)
{
    const lom_volume *v = f->volume;
    const int unit = 1 << f->bits;
    lom_int across = { 0 }, cell[3];
    for (int i = 0; i < 3; i++) {
        const lom_float first = lom_splat(0x1p23f), last = lom_splat(f->last[i]);
        const lom_int from = lom_as_int(lom_clamp(low[i], first, last)) & -unit;
        const lom_int to = lom_as_int(lom_clamp(high[i], first, last)) & -unit;
        across |= ((to != from) & (1 << i)) | ((to - from > unit) & MANY_CELLS);
        cell[i] = (from - FIRST_PLACE) >> f->bits;
        lom_store_int(cells->corner[i], from);
    }
    lom_store_int(cells->index, (cell[2] * (v->height + 1) + cell[1]) * (v->width + 1) + cell[0]);
    lom_store_int(cells->across, across);
}

/* Of LOM_LANES steps from `first` on. */
static __attribute__((noinline)) void plan_cells(const struct fixed_rays *f, int first, struct plan *plan)
{
    const lom_float step = lom_to_float(first + lom_lane_index());
    lom_float low[3], high[3], low_over[3], high_over[3];
    lom_mask within = lom_splat_int(f->bounded ? -1 : 0);
    for (int i = 0; i < 3; i++) {
        low[i] = f->least[0][i] + f->least[1][i] * step;
        high[i] = f->most[0][i] + f->most[1][i] * step;
        low_over[i] = low[i] + f->offset[i];
        high_over[i] = high[i] + f->offset[i];
        within &= (lom_min(low[i], low_over[i]) >= 0x1p23f) & (lom_max(high[i], high_over[i]) <= f->last[i]);
    }
    plan->first = first;
    find_cells(f, low, high, &plan->at);
    find_cells(f, low_over, high_over, &plan->over);
    lom_store_int(plan->within, within);
    if (!f->bounded)
        for (int i = 0; i < LOM_LANES; i++)
            plan->at.across[i] = plan->over.across[i] = MANY_CELLS;
}

/* ---- a step ---- */

LOM_INLINE lom_float3 place_at(const struct fixed_rays *f, int i)
{
    return lom_add3(f->start, lom_scale3(f->step, lom_splat((float)i)));
}

LOM_INLINE lom_float3 shading_place(const struct fixed_rays *f, lom_float3 p)
{
    return lom_add3(p, lom_splat3(f->offset[0], f->offset[1], f->offset[2]));
}

LOM_INLINE lom_float3 clamp_place(const struct fixed_rays *f, lom_float3 p)
{
    const lom_float first = lom_splat(0x1p23f);
    return (lom_float3){ lom_clamp(p.x, first, lom_splat(f->last[0])), lom_clamp(p.y, first, lom_splat(f->last[1])),
                         lom_clamp(p.z, first, lom_splat(f->last[2])) };
}

LOM_INLINE struct places places_of(lom_float3 p)
{
    return (struct places){ lom_as_int(p.x), lom_as_int(p.y), lom_as_int(p.z) };
}

#endif
