/* Shaders of sprites, foliage, gradients, draws and textured. In: scattered meshes whose normals hold colours, a cube,
 * the window's strip; out: colours as bench/peers/README.md defines them. */
#include "peer_shaders.h"

enum { RED = 0, GREEN, BLUE, S, T, CARD_VARYINGS };
enum { COLORS = 1u << RED | 1u << GREEN | 1u << BLUE, COORDINATES = 1u << S | 1u << T };

static lom_float4 opaque(lom_float3 color)
{
    return (lom_float4){ color.x, color.y, color.z, lom_splat(1) };
}

static lom_float3 times(lom_float4 texel, lom_float3 color)
{
    return (lom_float3){ texel.x * color.x, texel.y * color.y, texel.z * color.z };
}

/* Positions in clip coordinates. */
static void gradient_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float4 p = in->attribute[0];
    lom_peer_write3(out->varying, in->attribute[1]);
    out->position = (lom_float4){ p.x, p.y, p.z, lom_splat(1) };
}

static void gradient_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = opaque(lom_peer_read3(in->varying));
}

static void sprite_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    gradient_vertex(out, in, uniforms);
    out->varying[S] = in->attribute[2].x;
    out->varying[T] = in->attribute[2].y;
}

static void sprite_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_card *card = uniforms;
    lom_float4 texel = lom_sample(card->texture, in->varying[S], in->varying[T], lom_lod(card->texture, in, S, T));
    out->color[0] = opaque(times(texel, lom_peer_read3(in->varying)));
    out->color[0].w = texel.w;
}

static void card_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_card *card = uniforms;
    sprite_vertex(out, in, uniforms);
    out->position = lom_peer_transform(card->to_clip, in->attribute[0], 1);
}

static void card_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_card *card = uniforms;
    lom_float s = in->varying[S], t = in->varying[T];
    lom_float4 texel = lom_sample(card->texture, s, t, lom_lod(card->texture, in, S, T));
    out->discard = texel.w < 0.5f;
    lom_float3 color = times(texel, lom_peer_read3(in->varying));
    out->color[0] = opaque(lom_scale3(color, 0.5f + 0.5f * t));
}

static void box_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_colored_box *box = uniforms;
    lom_float4 p = in->attribute[0];
    out->varying[0] = 0.6f + 0.4f * p.y;
    p.x = p.x * box->size + box->centre[0];
    p.y = p.y * box->size + box->centre[1];
    p.z = p.z * box->size + box->centre[2];
    out->position = lom_peer_transform(box->to_clip, p, 1);
}

static void box_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_colored_box *box = uniforms;
    out->color[0] = opaque(lom_scale3(lom_peer_vector(box->color), in->varying[0]));
}

enum { LAYER_S = 0, LAYER_T, LAYER_VARYINGS };

static void layer_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_peer_layer *layer = uniforms;
    lom_float x = lom_to_float((in->vertex & 1) * 2 - 1), y = lom_to_float((in->vertex >> 1) * 2 - 1);
    lom_float wide = x * layer->aspect;
    out->varying[LAYER_S] = wide * layer->along[0] - y * layer->along[1];
    out->varying[LAYER_T] = wide * layer->along[1] + y * layer->along[0];
    out->position = (lom_float4){ x, y, lom_splat(layer->z), lom_splat(1) };
}

static void layer_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_peer_layer *layer = uniforms;
    out->color[0] = lom_sample(layer->texture, in->varying[LAYER_S], in->varying[LAYER_T],
                               lom_lod(layer->texture, in, LAYER_S, LAYER_T));
    out->color[0].w = lom_splat(0.25f);
}

LOM_SHADER(lom_peer_gradient_shader, gradient_vertex, gradient_fragment, .attributes = 2, .varyings = BLUE + 1,
           .reads = COLORS, .colors = 1)
LOM_SHADER(lom_peer_sprite_shader, sprite_vertex, sprite_fragment, .attributes = 3, .varyings = CARD_VARYINGS,
           .reads = COLORS | COORDINATES, .differentiates = COORDINATES, .colors = 1,
           .uniforms_size = sizeof(lom_peer_card))
LOM_SHADER(lom_peer_card_shader, card_vertex, card_fragment, .attributes = 3, .varyings = CARD_VARYINGS,
           .reads = COLORS | COORDINATES, .differentiates = COORDINATES, .discards = true, .colors = 1,
           .uniforms_size = sizeof(lom_peer_card))
LOM_SHADER(lom_peer_box_shader, box_vertex, box_fragment, .attributes = 1, .varyings = 1, .reads = 1u << 0, .colors = 1,
           .uniforms_size = sizeof(lom_peer_colored_box))
LOM_SHADER(lom_peer_layer_shader, layer_vertex, layer_fragment, .varyings = LAYER_VARYINGS,
           .reads = 1u << LAYER_S | 1u << LAYER_T, .differentiates = 1u << LAYER_S | 1u << LAYER_T, .colors = 1,
           .uniforms_size = sizeof(lom_peer_layer))
