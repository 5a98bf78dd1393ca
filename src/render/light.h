/* Phong's reflection over lanes: ambient + light (diffuse N.L + specular (R.E)^s), for a surface of a scene, and the
 * air in front of it. The ambient light is a hemisphere's: a mix of the sky's and the ground's by the cosine between
 * the normal and up. */
#ifndef LOM_RENDER_LIGHT_H
#define LOM_RENDER_LIGHT_H

#include "render/surface.h"

/* What does not depend on the texture, and what is multiplied by it. */
struct lom_lit {
    lom_float3 textured, highlight;
};

/* The sunlight at a point in parts of the sun's: what the waves above it focus, fading in below the level and out at
 * the borders of the map. */
LOM_INLINE lom_float lom_caustic_light(const struct lom_view_uniform *view, lom_float3 world)
{
    const struct lom_caustics_uniform *c = &view->caustics;
    lom_float one = lom_splat(1.0f);
    if (c->map == NULL || !lom_any(world.y < c->level))
        return one;
    lom_float s = (world.x - c->corner[0]) * c->scale, t = (world.z - c->corner[1]) * c->scale;
    lom_float border = lom_min(lom_min(s, one - s), lom_min(t, one - t));
    lom_float share = lom_saturate(border * 10.0f) * lom_saturate((c->level - world.y) * 3.0f) * c->strength;
    lom_float3 away = lom_sub3(world, lom_uniform3(view->eye));
    lom_float texels = lom_sqrt(lom_dot3(away, away)) * c->lod_scale;
    lom_float light = lom_sample(c->map, s, t, lom_log2(lom_max(texels, one))).x;
    return lom_max(lom_mix(one, light, share), (lom_float){ 0 });
}

/* The share of the sunlight that entities let through to a place with this normal (entity_shadow.wide.c). */
void LOM_WIDE(lom_entity_light)(const struct lom_view_uniform *view, const lom_float3 *world, const lom_float3 *normal,
                                lom_float *share);

/* sky: the share of the sky that the place sees. */
LOM_INLINE struct lom_lit lom_light_surface(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                            lom_float3 world, lom_float3 normal, lom_float sky)
{
    const struct lom_light_uniform *light = &view->light;
    lom_float share = lom_light_share(light, world), facing = lom_lambert(light, normal);
    if (view->entity_shadow[0].map != NULL && /* the far one is only there with it */
        lom_any(facing * share > 0.0f)) {
        lom_float open;
        LOM_WIDE(lom_entity_light)(view, &world, &normal, &open);
        share = share * open;
    }
    lom_float lambert = facing * share * lom_caustic_light(view, world);
    struct lom_lit lit;
    lom_float3 ambient = lom_mix3(lom_uniform3(light->ground), lom_uniform3(light->ambient), 0.5f + 0.5f * normal.y);
    lit.textured = lom_add3(lom_mul3(lom_scale3(ambient, sky), lom_uniform3(m->ambient)),
                            lom_scale3(lom_mul3(lom_uniform3(light->color), lom_uniform3(m->diffuse)), lambert));
    lit.highlight = lom_splat3(0, 0, 0);
    if (m->specular[0] != 0 || m->specular[1] != 0 || m->specular[2] != 0) {
        lom_float3 to_eye = lom_normalize3(lom_sub3(lom_uniform3(view->eye), world));
        lom_float specular = lom_phong_specular(light, normal, to_eye, m->shininess) * share;
        lit.highlight = lom_scale3(lom_mul3(lom_uniform3(light->color), lom_uniform3(m->specular)), specular);
    }
    return lit;
}

/* The colour of a fragment at a place of the world. */
LOM_INLINE void lom_finish_surface(lom_fragment *out, const struct lom_view_uniform *view, lom_float3 world,
                                   lom_float3 color)
{
    color = lom_apply_haze(&view->haze, view->light.to_light, view->eye, world, color);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

/* The face's normal towards the eye, from the derivatives of the world position: d/dy x d/dx on a screen whose y points
 * down, turned to the side of the interpolated normal. */
LOM_INLINE lom_float3 lom_face_normal(const lom_varyings *in, int world, lom_float3 normal)
{
    lom_float3 dx = { lom_dx(in, world), lom_dx(in, world + 1), lom_dx(in, world + 2) };
    lom_float3 dy = { lom_dy(in, world), lom_dy(in, world + 1), lom_dy(in, world + 2) };
    lom_float3 face = lom_normalize3(lom_cross3(dy, dx));
    lom_float side = lom_select(lom_dot3(face, normal) < 0.0f, lom_splat(-1.0f), lom_splat(1.0f));
    return lom_scale3(face, side);
}

#endif
