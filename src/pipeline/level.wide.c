/* Levels of detail of textures by varyings, for shaders (stage 6 of 7). In: a packet's varyings. Out: lom_lod_of of their
 * derivatives. Where those are the same in all packets of a triangle (facet.wide.c) a level is found for the first of
 * them. Invariant: a level does not depend on whether it was known. */
#include "image/level_of_detail.h"
#include "pipeline/packet.h"

void LOM_WIDE(lom_find_level)(const lom_texture *texture, const lom_varyings *in, int s, int t, lom_float *lod)
{
    struct lom_known_levels *known = in->levels;
    for (int i = 0; known != NULL && i < known->count; i++)
        if (known->of[i].texture == texture && known->of[i].s == s && known->of[i].t == t) {
            *lod = lom_splat(known->of[i].lod);
            return;
        }
    const lom_float derivative[4] = { lom_dx(in, s), lom_dx(in, t), lom_dy(in, s), lom_dy(in, t) };
    *lod = sample_lod(texture, derivative);
    if (known != NULL && known->count < KNOWN_LEVELS)
        known->of[known->count++] = (struct lom_known_level){ texture, s, t, (*lod)[0] };
}
