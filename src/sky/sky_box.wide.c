/* The sky's shaders. In: a triangle over the whole screen at reversed depth 0. Out: the cube in the ray's direction.
 * The direction is linear over the screen (w is 1), so interpolation is exact up to rounding. */
#include "sky/sky_uniforms.h"

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_sky_uniforms *sky = uniforms;
    lom_float x = in->attribute[0].x, y = in->attribute[0].y;
    out->position = (lom_float4){ x, y, { 0 }, lom_splat(1.0f) };
    for (int i = 0; i < 3; i++)
        out->varying[i] = x * sky->direction[i][0] + y * sky->direction[i][1] + sky->direction[i][2];
}

static void box_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_sky_uniforms *sky = uniforms;
    lom_float3 direction = { in->varying[0], in->varying[1], in->varying[2] };
    lom_float4 texel = lom_sample_cube(sky->box, direction, (lom_float){ 0 });
    out->color[0] =
        (lom_float4){ texel.x * sky->color[0], texel.y * sky->color[1], texel.z * sky->color[2], lom_splat(1.0f) };
}

static void color_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_sky_uniforms *sky = uniforms;
    (void)in;
    out->color[0] =
        (lom_float4){ lom_splat(sky->color[0]), lom_splat(sky->color[1]), lom_splat(sky->color[2]), lom_splat(1.0f) };
}

LOM_SHADER(lom_sky_box_shader, vertex, box_fragment, .attributes = 1, .varyings = 3, .reads = 7, .colors = 1,
           .uniforms_size = sizeof(struct lom_sky_uniforms))
LOM_SHADER(lom_sky_color_shader, vertex, color_fragment, .attributes = 1, .varyings = 3, .colors = 1,
           .uniforms_size = sizeof(struct lom_sky_uniforms))
