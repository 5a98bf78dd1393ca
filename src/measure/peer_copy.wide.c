/* Shader of water that is drawn once: what a picture shows below a height, with its depth, into another of the same view.
 * In: window positions; out: texels of the picture. Invariant: near the height, where rounding might decide, nothing. */
#include "peer_shaders.h"

static void copy_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = lom_to_float((in->vertex & 1) * 2 - 1), y = lom_to_float((in->vertex >> 1) * 2 - 1);
    out->position = (lom_float4){ x, y, (lom_float){ 0 }, lom_splat(1) };
}

static void copy_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_copy *copy = uniforms;
    lom_int x = lom_to_int(in->x), y = lom_to_int(in->y);
    lom_float depth = lom_fetch(copy->depth, x, y, 0).x;
    lom_float away = lom_peer_linear_depth(copy->near_plane, copy->far_plane, depth);
    lom_float height = (copy->rise[0] + in->y * copy->rise[1]) * away + copy->eye_height;
    out->discard = ~((depth < 1.0f) & (height < copy->below));
    out->depth = depth;
    out->color[0] = lom_fetch(copy->color, x, y, 0);
}

LOM_SHADER(lom_peer_copy_shader, copy_vertex, copy_fragment, .reads_position = true, .discards = true,
           .writes_depth = true, .colors = 1, .uniforms_size = sizeof(lom_peer_copy))
