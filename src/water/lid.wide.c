/* The shader of a lid. In: a rectangle. Out: its depth, and no colour. */
#include "water/lid.h"

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_lid_uniforms *u = uniforms;
    lom_mask right = (in->vertex & 1) != 0, far = (in->vertex & 2) != 0;
    lom_float3 offset = { lom_select(right, lom_splat(u->high[0]), lom_splat(u->low[0])), lom_splat(u->level),
                          lom_select(far, lom_splat(u->high[1]), lom_splat(u->low[1])) };
    out->position = lom_transform4(&u->clip_from_offset, offset);
}

LOM_DEPTH_SHADER(lom_lid_shader, vertex, .uniforms_size = sizeof(struct lom_lid_uniforms))
