/* The sky's shaders. In: a triangle over the whole screen at reversed depth 0. Out: the cube in the ray's direction.
 * The direction is linear over the screen (w is 1), so interpolation is exact up to rounding. */
#include "sky/sky_uniforms.h"

enum { X, Y, Z, SKY_VARYINGS };
enum { S, T, SUN_VARYINGS };

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_sky_uniforms *sky = uniforms;
    lom_float x = in->attribute[0].x, y = in->attribute[0].y;
    out->position = (lom_float4){ x, y, { 0 }, lom_splat(1.0f) };
    for (int i = 0; i < 3; i++)
        out->varying[X + i] = x * sky->direction[i][0] + y * sky->direction[i][1] + sky->direction[i][2];
}

static void box_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_sky_uniforms *sky = uniforms;
    lom_float3 direction = { in->varying[X], in->varying[Y], in->varying[Z] };
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

static void gradient_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_sky_uniforms *sky = uniforms;
    lom_float3 direction = { in->varying[X], in->varying[Y], in->varying[Z] };
    direction = lom_scale3(direction, 1.0f / lom_sqrt(lom_dot3(direction, direction)));
    lom_float3 color = lom_sky_gradient(&sky->gradient, direction);
    out->color[0] =
        (lom_float4){ color.x * sky->color[0], color.y * sky->color[1], color.z * sky->color[2], lom_splat(1.0f) };
}

/* Infinitely far: a way alone, so that its depth is 0. */
static void sun_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_sun_uniforms *sun = uniforms;
    const float(*m)[4] = sun->clip_from_direction.m;
    lom_int first = (in->vertex & 3) * 3;
    lom_float x = lom_gather(&sun->corner[0][0], first), y = lom_gather(&sun->corner[0][0], first + 1),
              z = lom_gather(&sun->corner[0][0], first + 2);
    out->position = (lom_float4){ x * m[0][0] + y * m[0][1] + z * m[0][2],
                                  x * m[1][0] + y * m[1][1] + z * m[1][2],
                                  { 0 },
                                  x * m[3][0] + y * m[3][1] + z * m[3][2] };
    out->varying[S] = lom_to_float(in->vertex & 1);
    out->varying[T] = lom_to_float(1 - (in->vertex >> 1));
}

static void sun_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_sun_uniforms *sun = uniforms;
    lom_float light = lom_sample(sun->picture, in->varying[S], in->varying[T], (lom_float){ 0 }).x;
    out->color[0] =
        (lom_float4){ light * sun->color[0], light * sun->color[1], light * sun->color[2], (lom_float){ 0 } };
}

LOM_SHADER(lom_sky_gradient_shader, vertex, gradient_fragment, .attributes = 1, .varyings = SKY_VARYINGS,
           .reads = LOM_VARYINGS(X, 3), .colors = 1, .uniforms_size = sizeof(struct lom_sky_uniforms))
LOM_SHADER(lom_sun_shader, sun_vertex, sun_fragment, .varyings = SUN_VARYINGS, .reads = LOM_VARYINGS(S, 2), .colors = 1,
           .uniforms_size = sizeof(struct lom_sun_uniforms))
LOM_SHADER(lom_sky_box_shader, vertex, box_fragment, .attributes = 1, .varyings = SKY_VARYINGS,
           .reads = LOM_VARYINGS(X, 3), .colors = 1, .uniforms_size = sizeof(struct lom_sky_uniforms))
LOM_SHADER(lom_sky_color_shader, vertex, color_fragment, .attributes = 1, .varyings = SKY_VARYINGS, .colors = 1,
           .uniforms_size = sizeof(struct lom_sky_uniforms))
