/* Rays through a volume, LOM_LANES at a time, in float. In: rays and what a sample means; out: their opacity and colour.
 * Invariant: skipping leaves out only steps at which every ray's density is exactly 0; such a step adds 0 to both. */
#include "bundle.h"
#include "lanes/notes.h"
#include "march_fixed.h"
#include "near_cells.h"

static lom_float sample_density(const lom_volume *volume, const struct spot *spot)
{
    lom_int low, high;
    load_densities(volume, spot, &low, &high);
    return lom_mix_corners(low, high, spot->place);
}

static void march_in_float(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                           lom_march_count *count)
{
    const lom_float3 offset = lom_splat3(desc->light_offset[0], desc->light_offset[1], desc->light_offset[2]);
    const struct steps steps = plan_steps(rays, desc);
    lom_float4 sum = { 0 };
    lom_mask alive = rays->active;
    LOM_NOTE(LOM_NOTE_RAY, desc->volume, (lom_float){ 0 }, lom_splat((float)desc->steps), lom_splat(1.0f));
    uint64_t sampled = 0;
    bool was_empty = true;
    int i = 0;
    for (; i < steps.last && lom_any(alive); i++) {
        if (steps.skips && was_empty) {
            int empty = empty_steps(&steps.rays, desc->volume, i);
            if (empty != 0) {
                i += empty - 1;
                continue;
            }
        }
        sampled++;
        lom_float3 p = lom_add3(rays->start, lom_scale3(rays->step, lom_splat((float)i)));
        struct spot at = find_spot(desc->volume, p);
        lom_float density;
        if (steps.skips && was_empty) { /* what follows what is not empty seldom is: then both at once */
            density = sample_density(desc->volume, &at);
            was_empty = !lom_any((density > 0.0f) & alive);
            if (was_empty)
                continue;
        }
        lom_int corner[8];
        load_corners(desc->volume, &at, corner);
        lom_float3 color = mix_corners(corner, at.place, &density);
        was_empty = !lom_any((density > 0.0f) & alive);
        struct spot over = find_spot(desc->volume, lom_add3(p, offset));
        lom_float above = sample_density(desc->volume, &over);
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
    add_steps(count, &steps, desc, i, sampled);
}

void LOM_WIDE(lom_march_volume)(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                                lom_march_count *count)
{
    (desc->filtering == LOM_FILTERING_FIXED ? LOM_WIDE(lom_march_fixed) : march_in_float)(out, rays, desc, count);
}
