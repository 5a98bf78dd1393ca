/* What an eye under water sees of everything: absorption over the way to it, and the light that the water adds. In: a
 * triangle over the screen, the depth of the finished frame. Out: twice the same triangle: what remains of the colour
 * (multiplied), then what is added. */
#include "water/surface_radiance.h"
#include "water/underwater.h"

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = lom_select(in->vertex == 1, lom_splat(3.0f), lom_splat(-1.0f));
    lom_float y = lom_select(in->vertex == 2, lom_splat(3.0f), lom_splat(-1.0f));
    out->position = (lom_float4){ x, y, lom_splat(0.5f), lom_splat(1.0f) };
}

/* The colour that comes out of the water when `beyond` went into it. */
static lom_float3 through(const struct lom_underwater_uniforms *u, const lom_varyings *in, float beyond)
{
    lom_float a = 2.0f * in->x * u->pixel[0] - 1.0f, b = 1.0f - 2.0f * in->y * u->pixel[1];
    lom_float3 start = { { 0 }, { 0 }, { 0 } };
    lom_float3 ray = { a * u->ray[0][0] + b * u->ray[0][1] + u->ray[0][2],
                       a * u->ray[1][0] + b * u->ray[1][1] + u->ray[1][2],
                       a * u->ray[2][0] + b * u->ray[2][1] + u->ray[2][2] };
    lom_float stored = lom_sample_depth(u->depth, (in->x - u->origin[0]) * u->crop_pixel[0],
                                        (in->y - u->origin[1]) * u->crop_pixel[1]);
    if (u->eye.parallel) {
        start = ray;
        ray = lom_uniform3(u->eye.along);
    }
    lom_float size = lom_sqrt(lom_dot3(ray, ray));
    lom_float length = lom_depth_reach(&u->eye, stored) * size;
    lom_float down = -ray.y / size, depth = u->depth_of_eye - start.y;
    /* Not further than the surface at rest: above it there is no water. */
    lom_mask rises = down < -1e-6f;
    lom_float leave = (depth + u->highest) / lom_select(rises, -down, lom_splat(1.0f));
    length = lom_select(rises, lom_min(length, leave), length);
    lom_float3 light = lom_splat3(beyond, beyond, beyond);
    return lom_cross_water(&u->medium, light, length, depth, down);
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_underwater_uniforms *u = uniforms;
    lom_float3 added = through(u, in, 0);
    if (u->multiplies)
        added = lom_sub3(through(u, in, 1), added);
    out->color[0] = (lom_float4){ added.x, added.y, added.z, lom_splat(1.0f) };
}

LOM_SHADER(lom_underwater_shader, vertex, fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_underwater_uniforms))
