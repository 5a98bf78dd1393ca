/* Shaders of fill, blend, mesh and depth. In: a strip made from vertex numbers, or a lit mesh; out: colours as
 * bench/peers/README.md defines them. */
#include "peer_shaders.h"

enum { NORMAL = 0, POSITION = 3, LIT_VARYINGS = 6 };

static lom_float4 window_corner(lom_int vertex, float z)
{
    lom_float x = lom_to_float((vertex & 1) * 2 - 1), y = lom_to_float((vertex >> 1) * 2 - 1);
    return (lom_float4){ x, y, lom_splat(z), lom_splat(1) };
}

static void flat_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_flat *flat = uniforms;
    out->position = window_corner(in->vertex, flat->z);
}

static void flat_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_flat *flat = uniforms;
    (void)in;
    out->color[0] = (lom_float4){ lom_splat(flat->color[0]), lom_splat(flat->color[1]), lom_splat(flat->color[2]),
                                  lom_splat(flat->color[3]) };
}

static void show_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = window_corner(in->vertex, 0);
}

static void show_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_show *show = uniforms;
    lom_float4 texel = lom_fetch(show->depth, lom_to_int(in->x), lom_to_int(in->y), 0);
    lom_float shown = 1.0f - (1.0f - texel.x) * 4.0f;
    out->color[0] = (lom_float4){ shown, shown, shown, lom_splat(1) };
}

static void depth_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_depth *depth = uniforms;
    out->position = lom_peer_transform(depth->to_clip, in->attribute[0], 1);
}

static void lit_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_lit *lit = uniforms;
    lom_peer_write3(out->varying + NORMAL, in->attribute[1]);
    lom_peer_write3(out->varying + POSITION, in->attribute[0]);
    out->position = lom_peer_transform(lit->to_clip, in->attribute[0], 1);
}

static void lit_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_lit *lit = uniforms;
    lom_float3 light = lom_peer_vector(lit->light);
    lom_float3 n = lom_normalize3(lom_peer_read3(in->varying + NORMAL));
    lom_float3 v = lom_normalize3(lom_sub3(lom_peer_vector(lit->eye), lom_peer_read3(in->varying + POSITION)));
    lom_float3 half = lom_normalize3(lom_add3(light, v));
    lom_float diffuse = 0.15f + 0.85f * lom_peer_positive(lom_dot3(n, light));
    lom_float specular = 0.5f * lom_peer_square(lom_peer_positive(lom_dot3(n, half)), 5);
    out->color[0] =
        (lom_float4){ 0.8f * diffuse + specular, 0.3f * diffuse + specular, 0.2f * diffuse + specular, lom_splat(1) };
}

LOM_SHADER(lom_peer_flat_shader, flat_vertex, flat_fragment, .colors = 1, .uniforms_size = sizeof(lom_peer_flat))
LOM_SHADER(lom_peer_show_shader, show_vertex, show_fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(lom_peer_show))
LOM_SHADER(lom_peer_lit_shader, lit_vertex, lit_fragment, .attributes = 2, .varyings = LIT_VARYINGS,
           .reads = LOM_VARYINGS(0, LIT_VARYINGS), .colors = 1, .uniforms_size = sizeof(lom_peer_lit))
LOM_DEPTH_SHADER(lom_peer_depth_shader, depth_vertex, .attributes = 1, .uniforms_size = sizeof(lom_peer_depth))
