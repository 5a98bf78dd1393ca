/* Where the light of each cell of a surface lands. In: waves, the sun, the heights of the bed. Out: a texel a cell. */
#include "water/caustics.h"
#include "water/optics.h"

static void vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = lom_select(in->vertex == 1, lom_splat(3.0f), lom_splat(-1.0f));
    lom_float y = lom_select(in->vertex == 2, lom_splat(3.0f), lom_splat(-1.0f));
    out->position = (lom_float4){ x, y, lom_splat(0.5f), lom_splat(1.0f) };
}

static lom_float bed_at(const struct lom_photon_uniforms *u, lom_float x, lom_float z)
{
    lom_float s = (x - u->bed_corner[0]) * u->bed_scale[0], t = (z - u->bed_corner[1]) * u->bed_scale[1];
    return u->bed_base + lom_sample(u->bed, s, t, (lom_float){ 0 }).x;
}

/* A cell of rest area A covers J A of the level, J the Jacobian of the displacement, and takes n.l / n_y of the sun's
 * light on it; still water l_y. The bed under a sloping ray is found by iteration. */
static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_photon_uniforms *u = uniforms;
    lom_float x = u->corner[0] + in->x * u->cell, z = u->corner[1] + in->y * u->cell, zero = { 0 };
    struct lom_footprint f = { lom_splat(u->cell), zero, zero, lom_splat(u->cell) };
    struct lom_wave_shift shift;
    struct lom_wave_slopes slopes;
    LOM_WIDE(lom_find_waves_lanes)(&u->waves, &x, &z, &f, &shift, &slopes);
    lom_float3 n = lom_wave_normal(&slopes), sun = lom_uniform3(u->to_light), ray;
    lom_mask passes = lom_refract3(lom_scale3(sun, lom_splat(-1.0f)), n, lom_splat(u->eta), &ray);
    lom_float3 p = { x + shift.dx, u->waves.level + shift.h, z + shift.dz };
    lom_float fall = lom_max(-ray.y, lom_splat(0.1f)), length = zero;
    for (int i = 0; i < 4; i++)
        length = lom_max(p.y - bed_at(u, p.x + ray.x * length, p.z + ray.z * length), zero) / fall;
    lom_float jacobian = (1.0f + slopes.xx) * (1.0f + slopes.zz) - slopes.xz * slopes.xz;
    lom_float weight = lom_clamp(jacobian * lom_dot3(n, sun) / (n.y * u->to_light[1]), zero, lom_splat(8.0f));
    lom_float scale = lom_splat(1.0f / u->cell);
    out->color[0] =
        (lom_float4){ (p.x + ray.x * length - u->corner[0]) * scale, (p.z + ray.z * length - u->corner[1]) * scale,
                      lom_select(passes, weight, zero), lom_splat(1.0f) };
}

LOM_SHADER(lom_photon_shader, vertex, fragment, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_photon_uniforms))
