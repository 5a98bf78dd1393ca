/* Shader of the cloud. In: the front faces of a cube around a volume; out: its colour, times its opacity, along each
 * ray, as bench/peers/README.md defines it. */
#include "peer_shaders.h"

enum { X, Y, Z, VARYINGS };

static void puff_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_puff *puff = uniforms;
    lom_float4 p = { in->attribute[0].x * 0.5f, in->attribute[0].y * 0.5f, in->attribute[0].z * 0.5f, lom_splat(1) };
    out->varying[X] = p.x + 0.5f;
    out->varying[Y] = p.y + 0.5f;
    out->varying[Z] = p.z + 0.5f;
    out->position = lom_peer_transform(puff->to_clip, p, 1);
}

static void puff_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_puff *puff = uniforms;
    lom_march_rays rays = { .start = lom_peer_read3(in->varying), .active = in->covered };
    lom_float3 along = lom_normalize3(lom_sub3(rays.start, lom_peer_vector(puff->eye)));
    rays.step = lom_scale3(along, lom_splat(0.0154f));
    LOM_WIDE(lom_march_volume)(&out->color[0], &rays, &puff->march, NULL);
}

LOM_SHADER(lom_peer_puff_shader, puff_vertex, puff_fragment, .attributes = 1, .varyings = VARYINGS,
           .reads = LOM_VARYINGS(X, 3), .colors = 1, .uniforms_size = sizeof(lom_peer_puff))
