/* Phong's reflection over lanes: ambient + light (diffuse N.L + specular (R.E)^s), for a surface of a scene. */
#ifndef LOM_RENDER_LIGHT_H
#define LOM_RENDER_LIGHT_H

#include "render/surface.h"

/* What does not depend on the texture, and what is multiplied by it. */
struct lom_lit {
    lom_float3 textured, highlight;
};

LOM_INLINE struct lom_lit lom_light_surface(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                            lom_float3 world, lom_float3 normal)
{
    const struct lom_light_uniform *light = &view->light;
    lom_float share = lom_light_share(light, world), lambert = lom_lambert(light, normal) * share;
    struct lom_lit lit;
    lit.textured = lom_add3(lom_mul3(lom_uniform3(light->ambient), lom_uniform3(m->ambient)),
                            lom_scale3(lom_mul3(lom_uniform3(light->color), lom_uniform3(m->diffuse)), lambert));
    lit.highlight = lom_splat3(0, 0, 0);
    if (m->specular[0] != 0 || m->specular[1] != 0 || m->specular[2] != 0) {
        lom_float3 to_eye = lom_normalize3(lom_sub3(lom_uniform3(view->eye), world));
        lom_float specular = lom_phong_specular(light, normal, to_eye, m->shininess) * share;
        lit.highlight = lom_scale3(lom_mul3(lom_uniform3(light->color), lom_uniform3(m->specular)), specular);
    }
    return lit;
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
