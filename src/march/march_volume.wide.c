/* Rays through a volume, LOM_LANES at a time. In: rays and what a sample means; out: their opacity and colour.
 * Invariant: skipping leaves out only steps at which every ray's density is exactly 0; such a step adds 0 to both. */
#include "fixed_cells.h"
#include "lanes/notes.h"
#include "near_cells.h"

/* The bundle as one ray with a width, in cells: every ray stays within `spread` of the centre, which moves by at most
 * `speed` a step (both as the largest of the three axes). */
typedef struct bundle {
    float start[3], step[3];
    float spread, speed, per_speed;
} bundle;

/* The least and the greatest value of the lanes that are set: halves against halves, which order does not matter to. */
static void bounds(lom_float x, lom_mask lanes, float *low, float *high)
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
static void bound_axis(bundle *b, int axis, lom_float start, lom_float step, int size, int steps, lom_mask lanes)
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

static bundle make_bundle(const lom_march_rays *rays, const lom_march_desc *desc, lom_mask lanes)
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
static int empty_steps(const bundle *b, const lom_volume *volume, int i)
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
static bool is_near(const bundle *b, int steps)
{
    bool near = b->spread + b->speed * (float)steps < 4096.0f;
    for (int axis = 0; axis < 3; axis++)
        near = near && b->start[axis] > -4096.0f && b->start[axis] < 4096.0f;
    return near;
}

/* Where every ray has left the unit cube for good, in steps; with nothing in the outermost voxels all beyond is empty.
 * A ray leaves through the far face of each axis it moves along; one step more than enough covers the rounding. */
static int last_step(const lom_march_rays *rays, const lom_march_desc *desc, lom_mask lanes)
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

/* What a volume holds at a place, by both arithmetics. */
typedef struct sampler {
    const lom_volume *volume;
    bool fixed;
} sampler;

LOM_INLINE lom_float sample_density(sampler s, const struct spot *spot)
{
    lom_int low, high;
    load_densities(s.volume, spot, &low, &high);
    if (!s.fixed)
        return lom_mix_corners(low, high, spot->place);
    struct fixed_place at = fix_place(spot->place);
    return fixed_corners(low, high, &at);
}

/* Colour, and the density of sample_density. */
LOM_INLINE lom_float3 sample_all(sampler s, const struct spot *spot, lom_float *density)
{
    lom_int corner[8];
    load_corners(s.volume, spot, corner);
    if (!s.fixed)
        return mix_corners(corner, spot->place, density);
    struct fixed_place at = fix_place(spot->place);
    return fixed_mix_all(corner, &at, density);
}

/* The steps that can matter: all, or with skips those before every ray has left an empty border. */
static int steps_to_look_at(const lom_march_rays *rays, const lom_march_desc *desc, bool skips)
{
    int last = skips && desc->volume->empty_border ? last_step(rays, desc, rays->active) : desc->steps;
    return last < desc->steps ? last : desc->steps;
}

LOM_INLINE void march(bool fixed, lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                      lom_march_count *count)
{
    const sampler from = { desc->volume, fixed };
    lom_float3 offset = lom_splat3(desc->light_offset[0], desc->light_offset[1], desc->light_offset[2]);
    lom_float4 sum = { 0 };
    lom_mask alive = rays->active;
    LOM_NOTE(LOM_NOTE_RAY, desc->volume, (lom_float){ 0 }, lom_splat((float)desc->steps), lom_splat(1.0f));
    bundle b = { 0 };
    bool skips = !desc->walk && lom_any(alive);
    if (skips) {
        b = make_bundle(rays, desc, alive);
        skips = is_near(&b, desc->steps);
    }
    int last = steps_to_look_at(rays, desc, skips), i = 0;
    uint64_t sampled = 0;
    bool was_empty = true;
    for (; i < last && lom_any(alive); i++) {
        if (skips && was_empty) {
            int empty = empty_steps(&b, desc->volume, i);
            if (empty != 0) {
                i += empty - 1;
                continue;
            }
        }
        sampled++;
        lom_float3 p = lom_add3(rays->start, lom_scale3(rays->step, lom_splat((float)i)));
        struct spot at = find_spot(desc->volume, p);
        lom_float density;
        lom_float3 color;
        if (skips && was_empty) { /* what follows what is not empty seldom is: then both at once */
            density = sample_density(from, &at);
            was_empty = !lom_any((density > 0.0f) & alive);
            if (was_empty)
                continue;
        }
        color = sample_all(from, &at, &density);
        was_empty = !lom_any((density > 0.0f) & alive);
        struct spot over = find_spot(desc->volume, lom_add3(p, offset));
        lom_float above = sample_density(from, &over);
        lom_float seen = (1.0f - sum.w) * (density * desc->absorption);
        seen = lom_as_float(lom_as_int(seen) & alive);
        LOM_NOTE(LOM_NOTE_STEP, desc->volume, lom_splat((float)i), lom_splat(1.0f), density, lom_as_float(alive));
        lom_float lit = 1.0f - desc->shade * above;
        sum.x += seen * (color.x * lit);
        sum.y += seen * (color.y * lit);
        sum.z += seen * (color.z * lit);
        sum.w += seen;
        LOM_NOTE(LOM_NOTE_LIGHT, desc->volume, seen, 1.0f - sum.w, lit, lit, lit);
        alive &= ~(sum.w > desc->opaque);
    }
    *out = sum;
    if (count != NULL) {
        count->walked += (uint64_t)(last < desc->steps && i >= last ? desc->steps : i);
        count->sampled += sampled;
    }
}

static void march_in_float(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                           lom_march_count *count)
{
    march(false, out, rays, desc, count);
}

static void march_fixed(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc, lom_march_count *count)
{
    march(true, out, rays, desc, count);
}

void LOM_WIDE(lom_march_volume)(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                                lom_march_count *count)
{
    (desc->filtering == LOM_FILTERING_FIXED ? march_fixed : march_in_float)(out, rays, desc, count);
}
