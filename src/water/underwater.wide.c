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

/* What is left of each colour on the way through the water, and what is added to it. */
struct column {
    lom_float3 left, added;
};

static struct column cross(const struct lom_medium_uniform *m, lom_float length, lom_float depth, lom_float down)
{
    lom_float below = lom_max(depth, (lom_float){ 0 }), l = lom_min(length, lom_splat(endless));
    struct lom_crossed c[3];
    for (int i = 0; i < 3; i++) {
        lom_float sun = lom_fade(-m->absorption[i] * m->slant * below);
        c[i] = lom_through_water(m->absorption[i], m->source[i], m->slant, sun, l, below, down);
    }
    return (struct column){ { c[0].left, c[1].left, c[2].left }, { c[0].added, c[1].added, c[2].added } };
}

static struct column water_before(const struct lom_underwater_uniforms *u, const lom_varyings *in)
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
    return cross(&u->medium, length, depth, down);
}

/* Of no light and of a light of 1 that went in: what comes out of the one, and how much more out of the other. */
static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_underwater_uniforms *u = uniforms;
    const struct column water = water_before(u, in);
    lom_float3 color = lom_add3(lom_scale3(water.left, lom_splat(0.0f)), water.added);
    if (u->multiplies)
        color = lom_sub3(lom_add3(water.left, water.added), color);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

LOM_SHADER(lom_underwater_shader, vertex, fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_underwater_uniforms))
