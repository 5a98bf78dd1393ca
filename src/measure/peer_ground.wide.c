/* Shaders of terrain and sky. In: the terrain's vertices, its colour and normal textures; the corners of a cube; out:
 * colours as bench/peers/README.md defines them. */
#include "peer_shaders.h"

enum { NORMAL = 0, POSITION = 3, S = 6, T = 7, GROUND_VARYINGS = 8, DOME_VARYINGS = 3 };

static void ground_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_ground *ground = uniforms;
    lom_peer_write3(out->varying + NORMAL, in->attribute[1]);
    lom_peer_write3(out->varying + POSITION, in->attribute[0]);
    out->varying[S] = in->attribute[2].x * 16.0f;
    out->varying[T] = in->attribute[2].y * 16.0f;
    out->position = lom_peer_transform(ground->to_clip, in->attribute[0], 1);
}

static void clipped_ground_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_ground *ground = uniforms;
    lom_float4 p = in->attribute[0];
    ground_vertex(out, in, uniforms);
    out->distance[0] = p.x * ground->clip[0] + p.y * ground->clip[1] + p.z * ground->clip[2] + ground->clip[3];
}

static void ground_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_ground *ground = uniforms;
    lom_float s = in->varying[S], t = in->varying[T];
    lom_float3 light = lom_peer_vector(ground->light);
    lom_float4 albedo = lom_sample(ground->albedo, s, t, lom_lod(ground->albedo, in, S, T));
    lom_float4 bump = lom_sample(ground->normals, s, t, lom_lod(ground->normals, in, S, T));
    lom_float3 along = { bump.x * 2.0f - 1.0f, (lom_float){ 0 }, bump.y * 2.0f - 1.0f };
    lom_float3 up = lom_normalize3(lom_peer_read3(in->varying + NORMAL));
    lom_float3 n = lom_normalize3(lom_add3(lom_scale3(up, bump.z * 2.0f - 1.0f), along));
    lom_float3 v = lom_normalize3(lom_sub3(lom_peer_vector(ground->eye), lom_peer_read3(in->varying + POSITION)));
    lom_float towards = lom_dot3(n, light);
    /* reflect(-L, n) . v = (2 (n . L) n - L) . v */
    lom_float mirrored = 2.0f * towards * lom_dot3(n, v) - lom_dot3(light, v);
    lom_float diffuse = 0.25f + 0.75f * lom_peer_positive(towards);
    lom_float specular = 0.15f * lom_peer_square(lom_peer_positive(mirrored), 4);
    out->color[0] = (lom_float4){ albedo.x * diffuse + specular, albedo.y * diffuse + specular,
                                  albedo.z * diffuse + specular, lom_splat(1) };
}

/* (p, 0) is a direction; z = w puts it on the far plane. */
static void dome_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_dome *dome = uniforms;
    lom_peer_write3(out->varying, in->attribute[0]);
    out->position = lom_peer_transform(dome->to_clip, in->attribute[0], 0);
    out->position.z = out->position.w;
}

static void dome_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_dome *dome = uniforms;
    out->color[0] = lom_sample_cube(dome->cube, lom_peer_read3(in->varying), (lom_float){ 0 });
    out->color[0].w = lom_splat(1);
}

LOM_SHADER(lom_peer_ground_shader, ground_vertex, ground_fragment, .attributes = 3, .varyings = GROUND_VARYINGS,
           .reads = LOM_VARYINGS(0, GROUND_VARYINGS), .differentiates = 1u << S | 1u << T, .colors = 1,
           .uniforms_size = sizeof(lom_peer_ground))
LOM_SHADER(lom_peer_clipped_ground_shader, clipped_ground_vertex, ground_fragment, .attributes = 3,
           .varyings = GROUND_VARYINGS, .clip_distances = 1, .reads = LOM_VARYINGS(0, GROUND_VARYINGS),
           .differentiates = 1u << S | 1u << T, .colors = 1, .uniforms_size = sizeof(lom_peer_ground))
LOM_SHADER(lom_peer_dome_shader, dome_vertex, dome_fragment, .attributes = 1, .varyings = DOME_VARYINGS,
           .reads = LOM_VARYINGS(0, DOME_VARYINGS), .colors = 1, .uniforms_size = sizeof(lom_peer_dome))
