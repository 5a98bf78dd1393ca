/* Reflection over lanes: ambient + light (diffuse N.L + specular (R.E)^s) of the sun and of each lamp, by Phong's model or
 * another (reflection.h), for what is opaque in a scene, and the air in front of it. The ambient light is a hemisphere's: a mix of the sky's and the ground's by the cosine between
 * the normal and up. */
#ifndef LOM_SHADING_PHONG_H
#define LOM_SHADING_PHONG_H

#include "shading/view_uniform.h"

/* What does not depend on the texture, and what is multiplied by it. */
struct lom_lit {
    lom_float3 textured, highlight;
};

/* sky: the share of the sky that the place sees. exponent: of the highlight; NULL: the material's shininess. One function a
 * width, so that no shader has a copy. */
void LOM_WIDE(lom_phong_light_lanes)(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                     const lom_float3 *offset, const lom_float3 *normal, const lom_float *sky,
                                     const lom_float *exponent, struct lom_lit *lit);

LOM_INLINE struct lom_lit lom_phong_light(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                          lom_float3 offset, lom_float3 normal, lom_float sky)
{
    struct lom_lit lit;
    LOM_WIDE(lom_phong_light_lanes)(view, m, &offset, &normal, &sky, NULL, &lit);
    return lit;
}

/* The colour of a fragment at an offset from the eye. */
LOM_INLINE void lom_finish_opaque(lom_fragment *out, const struct lom_view_uniform *view, lom_float3 offset,
                                  lom_float3 color)
{
    color = lom_apply_haze(&view->haze, &view->eye, view->light.to_light, offset, color);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

/* The face's normal towards the eye, from the derivatives of its offset: d/dy x d/dx on a screen whose y points
 * down, turned to the side of the interpolated normal. */
LOM_INLINE lom_float3 lom_face_normal(const lom_varyings *in, int offset, lom_float3 normal)
{
    lom_float3 dx = { lom_dx(in, offset), lom_dx(in, offset + 1), lom_dx(in, offset + 2) };
    lom_float3 dy = { lom_dy(in, offset), lom_dy(in, offset + 1), lom_dy(in, offset + 2) };
    lom_float3 face = lom_normalize3(lom_cross3(dy, dx));
    lom_float side = lom_select(lom_dot3(face, normal) < 0.0f, lom_splat(-1.0f), lom_splat(1.0f));
    return lom_scale3(face, side);
}

#endif
