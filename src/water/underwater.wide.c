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

/* The share of the sun's light that is there at a depth, of each colour; where all lanes have the same depth, a lane each. */
static void find_sun(const struct lom_medium_uniform *m, lom_float depth, bool same, lom_float sun[3])
{
    lom_float rate = { 0 };
    for (int i = 0; i < 3; i++)
        rate[i] = -m->absorption[i] * m->slant;
    lom_float lanes = lom_fade(rate * depth);
    for (int i = 0; i < 3; i++)
        sun[i] = same ? lom_splat(lanes[i]) : lom_fade(lom_splat(rate[i]) * depth);
}

/* Of no light and of a light of 1 that go in: what comes out of the one, and how much more out of the other. No light is 0
 * where what is left of it is a share, which then need not be known. */
static lom_float3 light_of(const struct lom_underwater_uniforms *u, lom_float length, lom_float depth, lom_float down)
{
    const struct lom_medium_uniform *m = &u->medium;
    lom_float below = lom_max(depth, (lom_float){ 0 }), l = lom_min(length, lom_splat(endless)), sun[3], light[3];
    find_sun(m, below, !u->eye.parallel, sun);
    for (int i = 0; i < 3; i++) {
        lom_float fall = lom_water_fall(m->absorption[i], m->slant, l, below, down), left = { 0 };
        lom_float added = lom_water_added(m->absorption[i], m->source[i], m->slant, sun[i], l, down);
        if (u->multiplies || !lom_all(fall <= 0.0f))
            left = lom_water_left(fall);
        lom_float dark = left * 0.0f + added;
        light[i] = u->multiplies ? left + added - dark : dark;
    }
    return (lom_float3){ light[0], light[1], light[2] };
}

static lom_float3 light_through(const struct lom_underwater_uniforms *u, const lom_varyings *in)
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
    return light_of(u, length, depth, down);
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_float3 color = light_through(uniforms, in);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

LOM_SHADER(lom_underwater_shader, vertex, fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_underwater_uniforms))
