/* Which steps of a packet's rays through a volume are looked at. In: rays and what a sample means; out: how many steps
 * matter, and how many from one on are empty. Invariant: what is left out are steps at which every ray's density is
 * exactly 0. */
#ifndef LOM_MARCH_BUNDLE_H
#define LOM_MARCH_BUNDLE_H

#include "base/numbers.h"

#include <lom/march.h>

#include <assert.h>

/* The bundle as one ray with a width, in cells: every ray stays within `spread` of the centre, which moves by at most
 * `speed` a step (both as the largest of the three axes). */
typedef struct bundle {
    float start[3], step[3];
    float spread, speed, per_speed;
} bundle;

/* The least and the greatest value of the lanes that are set: halves against halves, which order does not matter to. */
static inline void bounds(lom_float x, lom_mask lanes, float *low, float *high)
{
    const float infinity = __builtin_inff();
    float least[LOM_LANES], most[LOM_LANES];
    lom_store(least, lom_select(lanes, x, lom_splat(infinity)));
    lom_store(most, lom_select(lanes, x, lom_splat(-infinity)));
    for (int half = LOM_LANES / 2; half > 0; half /= 2)
        for (int i = 0; i < half; i++) {
            least[i] = least[i] < least[i + half] ? least[i] : least[i + half];
            most[i] = most[i] > most[i + half] ? most[i] : most[i + half];
        }
    *low = least[0];
    *high = most[0];
}

/* The distance of rays from their centre is a convex function of the step: largest at the first or the last. */
static inline void bound_axis(bundle *b, int axis, lom_float start, lom_float step, int size, int steps, lom_mask lanes)
{
    float low, high, last = (float)(steps - 1), scale = (float)size;
    bounds(step, lanes, &low, &high);
    float middle_step = (low + high) * 0.5f;
    float fastest = -low > high ? -low : high;
    bounds(start, lanes, &low, &high);
    float middle = (low + high) * 0.5f;
    float first_spread = (high - low) * 0.5f;
    bounds((start - middle) + last * (step - middle_step), lanes, &low, &high);
    float last_spread = -low > high ? -low : high;
    float spread = (first_spread > last_spread ? first_spread : last_spread) * scale;
    b->start[axis] = middle * scale - 0.5f;
    b->step[axis] = middle_step * scale;
    b->spread = spread > b->spread ? spread : b->spread;
    b->speed = fastest * scale > b->speed ? fastest * scale : b->speed;
}

static inline bundle make_bundle(const lom_march_rays *rays, const lom_march_desc *desc, lom_mask lanes)
{
    bundle b = { .speed = 0x1p-20f };
    bound_axis(&b, 0, rays->start.x, rays->step.x, desc->volume->width, desc->steps, lanes);
    bound_axis(&b, 1, rays->start.y, rays->step.y, desc->volume->height, desc->steps, lanes);
    bound_axis(&b, 2, rays->start.z, rays->step.z, desc->volume->depth, desc->steps, lanes);
    b.per_speed = 0.99999f / b.speed; /* below 1 / speed, whatever is rounded: fewer steps are as safe */
    return b;
}

/* How many steps from i on are empty for the whole bundle. Two points a apart lie in cells at most floor(a) + 1 apart;
 * a ray k steps on is at most spread + k speed from where the centre is now; cells nearer than `distance` are empty. So
 * the k with spread + k speed < distance - 1 are; 0.01 of a cell is far more than the rounding of the positions. */
static inline int empty_steps(const bundle *b, const lom_volume *volume, int i)
{
    const int size[3] = { volume->width, volume->height, volume->depth };
    int cell[3];
    for (int axis = 0; axis < 3; axis++) {
        float along = b->start[axis] + (float)i * b->step[axis], most = (float)(size[axis] - 1);
        along = along > 0 ? along : 0;
        cell[axis] = lom_int_of(along < most ? along : most);
    }
    int index = (cell[2] * (size[1] + 1) + cell[1]) * (size[0] + 1) + cell[0];
    float room = (float)volume->distance[index] - 1.01f - b->spread;
    return room >= 0 ? 1 + lom_int_of(room * b->per_speed) : 0;
}

/* Whether every position is within 8192 cells, where float rounding is far below the margin above; false for NaN. */
static inline bool is_near(const bundle *b, int steps)
{
    bool near = b->spread + b->speed * (float)steps < 4096.0f;
    for (int axis = 0; axis < 3; axis++)
        near = near && b->start[axis] > -4096.0f && b->start[axis] < 4096.0f;
    return near;
}

/* Where every ray has left the unit cube for good, in steps; with nothing in the outermost voxels all beyond is empty.
 * A ray leaves through the far face of each axis it moves along; one step more than enough covers the rounding. */
static inline int last_step(const lom_march_rays *rays, const lom_march_desc *desc, lom_mask lanes)
{
    const lom_float start[3] = { rays->start.x, rays->start.y, rays->start.z };
    const lom_float step[3] = { rays->step.x, rays->step.y, rays->step.z };
    lom_float leave = lom_splat((float)desc->steps);
    for (int i = 0; i < 3; i++) {
        lom_float face = lom_select(step[i] > 0.0f, lom_splat(1.0f), (lom_float){ 0 });
        lom_float at = (face - start[i]) / step[i];
        leave = lom_select(lom_abs(step[i]) > 1e-6f, lom_min(at, leave), leave);
    }
    float low, high;
    bounds(leave, lanes, &low, &high);
    return high > 0 ? (high < (float)desc->steps ? lom_int_of(high) + 2 : desc->steps) : 1;
}

/* The steps to look at: of all, those before every ray has left an empty border; and whether what is empty is skipped. */
struct steps {
    bundle rays;
    bool skips;
    int last;
};

static inline struct steps plan_steps(const lom_march_rays *rays, const lom_march_desc *desc)
{
    assert(desc->opaque >= 0); /* else rays would end at steps that others beside them skip */
    struct steps steps = { .skips = !desc->walk && lom_any(rays->active), .last = desc->steps };
    if (steps.skips) {
        steps.rays = make_bundle(rays, desc, rays->active);
        steps.skips = is_near(&steps.rays, desc->steps);
    }
    if (steps.skips && desc->volume->empty_border) {
        int last = last_step(rays, desc, rays->active);
        steps.last = last < desc->steps ? last : desc->steps;
    }
    return steps;
}

/* A march that stopped before step i, and took so many samples. */
static inline void add_steps(lom_march_count *count, const struct steps *steps, const lom_march_desc *desc, int i,
                             uint64_t sampled)
{
    if (count == NULL)
        return;
    count->walked += (uint64_t)(steps->last < desc->steps && i >= steps->last ? desc->steps : i);
    count->sampled += sampled;
}

#endif
