/* Shader of the water. In: the water's plane, pictures of what it reflects and refracts; out: colour and opacity as
 * bench/peers/README.md defines them. Invariant: window coordinates are computed as there, with y up, and turned over
 * only where a picture is looked up. */
#include "peer_shaders.h"

#include <lom/lanes_mathematics.h>

enum { POSITION = 0, S = 3, T = 4, LAKE_VARYINGS = 5 };

static void lake_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_lake *lake = uniforms;
    lom_peer_write3(out->varying + POSITION, in->attribute[0]);
    out->varying[S] = in->attribute[1].x * 8.0f;
    out->varying[T] = in->attribute[1].y * 8.0f;
    out->position = lom_peer_transform(lake->to_clip, in->attribute[0], 1);
}

/* Normal of the waves; the coordinates of its texture are themselves displaced by a texture, so their derivatives are
 * differences within the quad. */
static lom_float3 wave_normal(const lom_peer_lake *lake, lom_float s, lom_float t, lom_float2 *offset)
{
    lom_float dsdx = lom_quad_dx(s), dtdx = lom_quad_dx(t), dsdy = lom_quad_dy(s), dtdy = lom_quad_dy(t);
    lom_float4 d = lom_sample(lake->dudv, s, t, lom_lod_of(lake->dudv, dsdx, dtdx, dsdy, dtdy));
    lom_float4 m = lom_sample(lake->normals, s, t, lom_lod_of(lake->normals, dsdx, dtdx, dsdy, dtdy));
    offset->x = (d.x * 2.0f - 1.0f) * 0.02f;
    offset->y = (d.y * 2.0f - 1.0f) * 0.02f;
    lom_float3 n = { m.x * 2.0f - 1.0f, (m.z * 2.0f - 1.0f) * 2.0f, m.y * 2.0f - 1.0f };
    return lom_normalize3(n);
}

static lom_float3 lake_color(const lom_peer_lake *lake, lom_float2 at, lom_float3 n, lom_float3 v, lom_float depth)
{
    static const float deep[3] = { 0.02f, 0.10f, 0.18f }, tint[3] = { 0.0f, 0.3f, 0.5f }, sun[3] = { 1, 0.95f, 0.8f };
    lom_float3 light = lom_peer_vector(lake->light);
    lom_float4 reflected = lom_sample(lake->reflection, at.x, at.y, (lom_float){ 0 });
    lom_float4 refracted = lom_sample(lake->refraction, at.x, at.y, (lom_float){ 0 });
    lom_float facing = lom_dot3(v, n), grazing = 1.0f - lom_peer_positive(facing);
    lom_float fresnel = grazing * grazing * grazing;
    lom_float clear = lom_exp(-0.25f * lom_peer_positive(depth));
    /* reflect(-L, n) . v = 2 (n . L) (n . v) - L . v */
    lom_float mirrored = 2.0f * lom_dot3(n, light) * facing - lom_dot3(light, v);
    lom_float glint = 0.6f * (lom_peer_square(lom_peer_positive(mirrored), 6) * lom_saturate(depth * 0.5f));
    const lom_float above[3] = { reflected.x, reflected.y, reflected.z };
    const lom_float below[3] = { refracted.x, refracted.y, refracted.z };
    lom_float color[3];
    for (int k = 0; k < 3; k++) {
        lom_float water = lom_mix(lom_splat(deep[k]), below[k], clear);
        water = lom_mix(water, above[k], fresnel);
        color[k] = water + (tint[k] - water) * 0.15f + sun[k] * glint;
    }
    return (lom_float3){ color[0], color[1], color[2] };
}

static void lake_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_lake *lake = uniforms;
    lom_float s = in->varying[S], t = in->varying[T];
    /* the pixel's centre is C.xy / C.w * 0.5 + 0.5 in texture coordinates, here with y down */
    lom_float2 window = { in->x * lake->per_width, in->y * lake->per_height };
    lom_float depth = lom_peer_linear_depth(lake->near_plane, lake->far_plane,
                                            lom_sample_depth(lake->refraction_depth, window.x, window.y)) -
                      lom_peer_linear_depth(lake->near_plane, lake->far_plane, in->z);
    lom_float4 d = lom_sample(lake->dudv, s + lake->move, t, lom_lod(lake->dudv, in, S, T));
    lom_float2 offset;
    lom_float3 n = wave_normal(lake, s + d.x * 0.1f, t + (d.y * 0.1f + lake->move), &offset);
    lom_float shallow = lom_saturate(depth * 0.5f);
    lom_float low = lom_splat(0.001f), high = lom_splat(0.999f);
    lom_float2 at = { lom_clamp(window.x + offset.x * shallow, low, high),
                      lom_clamp(window.y - offset.y * shallow, low, high) };
    lom_float3 v = lom_normalize3(lom_sub3(lom_peer_vector(lake->eye), lom_peer_read3(in->varying + POSITION)));
    lom_float3 color = lake_color(lake, at, n, v, depth);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_saturate(depth * 2.0f) };
}

LOM_SHADER(lom_peer_lake_shader, lake_vertex, lake_fragment, .attributes = 2, .varyings = LAKE_VARYINGS,
           .reads = LOM_VARYINGS(0, LAKE_VARYINGS), .differentiates = 1u << S | 1u << T, .reads_position = true,
           .quads = true, .colors = 1, .uniforms_size = sizeof(lom_peer_lake))
