/* Rays through a volume, LOM_LANES at a time, in fixed point. In: rays and what a sample means; out: their opacity and
 * colour. Sums are float; of what is filtered 32640 stands for 1, in what each is multiplied with.
 * Invariant: skipping leaves out only steps at which every ray's density is exactly 0; such a step adds 0 to both. */
#include "march_fixed.h"

#include "fixed_volume.h"
#include "lanes/notes.h"

void LOM_WIDE(lom_march_fixed)(lom_float4 *out, const lom_march_rays *rays, const lom_march_desc *desc,
                               lom_march_count *count)
{
    const struct fixed_rays fixed = fix_rays(rays, desc);
    const struct steps steps = plan_steps(rays, desc);
    const float absorption = desc->absorption / LOM_FIXED_BYTE, shade = desc->shade / LOM_FIXED_BYTE;
    lom_float4 sum = { 0 };
    lom_mask alive = rays->active;
    LOM_NOTE(LOM_NOTE_RAY, desc->volume, (lom_float){ 0 }, lom_splat((float)desc->steps), lom_splat(1.0f));
    uint64_t sampled = 0;
    bool was_empty = true;
    struct plan plan = { .first = -LOM_LANES };
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
        if (i >= plan.first + LOM_LANES)
            plan_cells(&fixed, i, &plan);
        const int k = i - plan.first;
        lom_float3 p = place_at(&fixed, i), q = shading_place(&fixed, p);
        if (plan.within[k] == 0) {
            p = clamp_place(&fixed, p);
            q = clamp_place(&fixed, q);
        }
        const struct places at = places_of(p), over = places_of(q);
        if (steps.skips && was_empty) { /* what follows what is not empty seldom is: then both at once */
            was_empty = !lom_any((density_there(&fixed, &at, &plan.at, k) > 0.0f) & alive);
            if (was_empty)
                continue;
        }
        const lom_float4 all = all_there(&fixed, &at, &plan.at, k);
        was_empty = steps.skips && !lom_any((all.w > 0.0f) & alive);
        lom_float seen = (1.0f - sum.w) * (all.w * absorption);
        seen = lom_as_float(lom_as_int(seen) & alive);
        LOM_NOTE(LOM_NOTE_STEP, desc->volume, lom_splat((float)i), lom_splat(1.0f), all.w * (1 / LOM_FIXED_BYTE),
                 lom_as_float(alive));
        const lom_float lit = 1.0f - shade * density_there(&fixed, &over, &plan.over, k), light = seen * lit;
        sum.x += light * all.x;
        sum.y += light * all.y;
        sum.z += light * all.z;
        sum.w += seen;
        LOM_NOTE(LOM_NOTE_LIGHT, desc->volume, seen, 1.0f - sum.w, lit, lit, lit);
        alive &= ~(sum.w > desc->opaque);
    }
    const float byte = 1 / LOM_FIXED_BYTE;
    *out = (lom_float4){ sum.x * byte, sum.y * byte, sum.z * byte, sum.w };
    add_steps(count, &steps, desc, i, sampled);
}
