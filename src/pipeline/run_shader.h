/* The second half of the fragment stage, which its files share: the shader on varyings that are found, and what follows. */
#ifndef LOM_PIPELINE_RUN_SHADER_H
#define LOM_PIPELINE_RUN_SHADER_H

#include "pipeline/packet.h"
#include "pipeline/record.h"

LOM_INLINE bool lom_tests_late(const struct lom_tile *tile)
{
    return tile->draw->late_depth && tile->depth != NULL;
}

/* Of the packet: places, depth, triangles and covered. */
LOM_INLINE void lom_call_shader(struct lom_tile *tile, const struct lom_packet *packet, lom_varyings *in,
                                lom_fragment *out)
{
    const struct lom_draw *draw = tile->draw;
    const lom_shader *shader = draw->desc.shader;
    if (shader->reads_depth)
        in->target_depth = lom_depth_of_units(
            tile->pass, lom_as_float(lom_load_places((const int32_t *)tile->depth, tile, &packet->places)));
    in->covered = packet->covered;
    out->depth = packet->depth;
    out->discard = (lom_mask){ 0 };
    shader->fragment[draw->variant](out, in, tile->uniforms);
    LOM_RECORD_HOOK(lom_record_shaded, tile, in, out);
    tile->packets++;
}

/* What follows it. */
LOM_INLINE void lom_write_shaded(struct lom_tile *tile, const struct lom_packet *packet, const lom_fragment *out)
{
    const struct lom_draw *draw = tile->draw;
    lom_mask mask = draw->desc.shader->discards ? packet->covered & ~out->discard : packet->covered;
    bool apart = packet->triangles == 1;
    if (LOM_RECORDS || lom_tests_late(tile) || (draw->blends && !apart))
        LOM_WIDE(lom_write_in_order)(tile, &packet->places, &mask, apart, out);
    else
        LOM_WIDE(lom_write_packet)(tile, &packet->places, &mask, out->color);
}

LOM_INLINE void lom_run_shader(struct lom_tile *tile, const struct lom_packet *packet, lom_varyings *in)
{
    lom_fragment out;
    if (tile->draw->sampled) {
        LOM_WIDE(lom_run_sampled)(tile, packet, in);
        return;
    }
    lom_call_shader(tile, packet, in, &out);
    lom_write_shaded(tile, packet, &out);
}

#endif
