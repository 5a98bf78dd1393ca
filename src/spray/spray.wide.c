/* The shaders of drops. In: sprites; the scene's depth is that of the pass. Out: light times opacity, and opacity. Invariant: what is drawn
 * of a drop falls to 0, without a step, at the edge of its disc, before what stands behind it and before the near
 * plane.
 */
#include "spray/spray.h"

enum { RED, GREEN, BLUE, OPACITY, SOFT, VARYINGS };

LOM_INLINE lom_float3 gather3(const float *from, lom_int at)
{
    return (lom_float3){ lom_gather(from, at), lom_gather(from, at + 1), lom_gather(from, at + 2) };
}

#define MEMBER(name) ((int)(offsetof(struct lom_sprite, name) / sizeof(float)))

/* 3 x^2 - 2 x^3 between 0 and 1. */
LOM_INLINE lom_float ramp(lom_float x)
{
    lom_float y = lom_saturate(x);
    return y * y * (3.0f - 2.0f * y);
}

/* A drop has the light and the depth of its middle. Before the near plane it has faded away. */
static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_spray_uniforms *u = uniforms;
    lom_int at = in->vertex * LOM_SPRITE_FLOATS;
    lom_float3 middle = gather3(u->sprites, at + MEMBER(middle));
    lom_float share = lom_gather(u->sprites, at + MEMBER(sun)) * lom_light_share(&u->light, middle);
    lom_float3 around =
        lom_scale3(lom_add3(lom_uniform3(u->light.ambient), lom_uniform3(u->light.ground)), lom_splat(0.5f));
    lom_float3 light = lom_add3(around, lom_scale3(lom_uniform3(u->light.color), share));
    light = lom_mul3(light, gather3(u->sprites, at + MEMBER(color)));
    light = lom_apply_haze(&u->haze, &u->eye, u->light.to_light, middle, light);
    lom_float soft = 1.0f / lom_gather(u->sprites, at + MEMBER(soft));
    out->position = lom_transform4(&u->clip_from_offset, middle);
    out->axis[0] = lom_turn4(&u->clip_from_offset, gather3(u->sprites, at + MEMBER(across)));
    out->axis[1] = lom_turn4(&u->clip_from_offset, gather3(u->sprites, at + MEMBER(along)));
    out->varying[RED] = light.x;
    out->varying[GREEN] = light.y;
    out->varying[BLUE] = light.z;
    lom_float before = lom_place_reach(&u->eye, middle, out->position.w) - lom_depth_reach(&u->eye, lom_splat(1.0f));
    out->varying[OPACITY] = lom_gather(u->sprites, at + MEMBER(opacity)) * ramp(before * soft);
    out->varying[SOFT] = soft;
}

/* (1 - r^2)^2: near to a Gaussian of standard deviation 0.43, and 0 with its slope at the edge. Softness compares the
 * reaches of what the depth holds and of the drop. */
static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_spray_uniforms *u = uniforms;
    lom_float s = in->st[0], t = in->st[1], disc = 1.0f - (s * s + t * t);
    lom_float reach = u->eye.parallel ? lom_depth_reach(&u->eye, in->z) : in->w;
    lom_float behind = lom_depth_reach(&u->eye, in->target_depth) - reach;
    lom_float opacity = in->varying[OPACITY] * (disc * disc) * ramp(behind * in->varying[SOFT]);
    out->color[0] =
        (lom_float4){ in->varying[RED] * opacity, in->varying[GREEN] * opacity, in->varying[BLUE] * opacity, opacity };
}

static void layer_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    out->position = (lom_float4){ 2.0f * s - 1.0f, 1.0f - 2.0f * t, { 0 }, lom_splat(1.0f) };
}

static void layer_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_spray_layer_uniforms *u = uniforms;
    lom_int x = lom_to_int(in->x - u->origin[0]), y = lom_to_int(in->y - u->origin[1]);
    out->color[0] = lom_fetch(u->layer, x, y, 0);
}

LOM_SHADER(lom_spray_shader, vertex, fragment, .varyings = VARYINGS, .reads = LOM_VARYINGS(0, VARYINGS),
           .reads_position = true, .colors = 1, .uniforms_size = sizeof(struct lom_spray_uniforms), .sprites = true,
           .round = true, .reads_depth = true)
LOM_SHADER(lom_spray_layer_shader, layer_vertex, layer_fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_spray_layer_uniforms))
