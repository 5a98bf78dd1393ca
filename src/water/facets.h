/* Rough water, over lanes (Cox and Munk 1954): slopes too small to be seen are normally distributed about the mean
 * slope with the covariance of wave_lanes.h. In: a point of the surface. Out: what such facets mirror of the sun and of
 * lamps; of all else, seen_facets.h. */
#ifndef LOM_WATER_FACETS_H
#define LOM_WATER_FACETS_H

#include "base/numbers.h"
#include "shading/lamp.h"
#include "water/optics.h"
#include "water/surface.h"

struct lom_surface_point {
    lom_float x, y, w;  /* window position and reach (shading/eye.h) */
    lom_float3 offset;  /* on the surface */
    lom_float3 path;    /* to it from where its ray starts */
    lom_float3 to_eye;  /* unit length */
    lom_float distance; /* to the eye */
    lom_float3 normal;  /* mean, upwards */
    struct lom_wave_slopes slopes;
};

/* The horizontal direction (x, z) to the eye, how long it is of the unit vector, and the variance of slopes along it.
 */
struct lom_view_slope {
    lom_float x, z, flat, variance;
};

LOM_INLINE struct lom_view_slope lom_view_slope_of(const struct lom_surface_point *p)
{
    const struct lom_wave_slopes *w = &p->slopes;
    lom_float flat = lom_sqrt(p->to_eye.x * p->to_eye.x + p->to_eye.z * p->to_eye.z);
    lom_float inverse = 1.0f / lom_max(flat, lom_splat(1e-6f));
    lom_float c = p->to_eye.x * inverse, s = p->to_eye.z * inverse;
    lom_float variance = lom_max(w->vxx * c * c + 2.0f * w->vxz * c * s + w->vzz * s * s, (lom_float){ 0 });
    return (struct lom_view_slope){ c, s, flat, variance };
}

/* Lambda of Smith's shadowing for normal slopes (Walter et al. 2007, equation 24, their rational fit). */
LOM_INLINE lom_float lom_smith_lambda(lom_float cosine, lom_float variance)
{
    lom_float sine = lom_sqrt(lom_max(1.0f - cosine * cosine, (lom_float){ 0 }));
    lom_float a = lom_max(cosine, lom_splat(1e-3f)) / lom_max(sine * lom_sqrt(2.0f * variance), lom_splat(1e-6f));
    lom_float fit = (1.0f - 1.259f * a + 0.396f * a * a) / (3.535f * a + 2.181f * a * a);
    return lom_select(a < 1.6f, fit, (lom_float){ 0 });
}

LOM_INLINE lom_float lom_surface_fresnel(const struct lom_surface_uniforms *u, lom_float cosine)
{
    lom_float c = lom_saturate(cosine);
    if (u->fresnel == LOM_FRESNEL_DOT)
        return lom_fresnel_dot(c);
    if (u->fresnel == LOM_FRESNEL_SCHLICK && u->eta < 1)
        return lom_fresnel_schlick(c, u->eta);
    return lom_fresnel_exact(c, lom_splat(u->eta));
}

/* A light in the facets, over its colour: E F p G / (4 cos h_y^4), p the density of slopes at the one that mirrors the
 * light to the eye (Ross, Dion, Potvin 2005; Bruneton, Neyret, Holzschuch 2010), E = pi times the light's colour.
 * False: there is none. */
LOM_INLINE bool lom_facets_mirror(const struct lom_surface_uniforms *u, const struct lom_surface_point *p,
                                  lom_float3 to_light, lom_float *radiance)
{
    lom_float3 h = lom_normalize3(lom_add3(p->to_eye, to_light));
    lom_float hy = lom_max(h.y, lom_splat(0.02f)), up = 1.0f / p->normal.y;
    lom_float dx = h.x / hy - p->normal.x * up, dz = h.z / hy - p->normal.z * up;
    lom_float disc = lom_splat(5e-6f); /* the sun is no point: half its angle, squared; nor is a lamp */
    lom_float vxx = p->slopes.vxx + disc, vzz = p->slopes.vzz + disc, vxz = p->slopes.vxz;
    lom_float determinant = lom_max(vxx * vzz - vxz * vxz, lom_splat(2e-11f));
    lom_float square = (vzz * dx * dx - 2.0f * vxz * dx * dz + vxx * dz * dz) / determinant;
    lom_mask bright = square < 40.0f;
    if (!lom_any(bright))
        return false;
    lom_float density = lom_fade(-0.5f * square) / ((float)lom_two_pi * lom_sqrt(determinant));
    lom_float variance = 0.5f * (vxx + vzz);
    lom_float seen = lom_max(lom_dot3(p->normal, p->to_eye), lom_splat(0.02f));
    lom_float lit = lom_max(lom_dot3(p->normal, to_light), lom_splat(1e-3f));
    lom_float shadow = 1.0f / (1.0f + lom_smith_lambda(seen, variance) + lom_smith_lambda(lit, variance));
    lom_float f = lom_surface_fresnel(u, lom_dot3(h, p->to_eye)), square_y = hy * hy;
    lom_float mirrored = (float)lom_pi * u->glitter * f * density * shadow / (4.0f * seen * square_y * square_y);
    *radiance = lom_select(bright, lom_min(mirrored, lom_splat(1e4f)), (lom_float){ 0 });
    return true;
}

/* The sun in the facets, where neither clouds nor terrain nor entities hide it. */
LOM_INLINE lom_float3 lom_glitter(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    lom_float3 none = { { 0 }, { 0 }, { 0 } };
    lom_float radiance;
    if (!(u->light.to_light[1] > 0) || u->side < 0 || !(u->glitter > 0) ||
        !lom_facets_mirror(u, p, lom_uniform3(u->light.to_light), &radiance))
        return none;
    radiance = radiance * lom_light_share(&u->light, p->offset);
    return lom_scale3(lom_uniform3(u->light.color), lom_open_water_share(&u->entity_shadow, p->offset, radiance));
}

/* Lamps above it in the facets, one after the other. */
LOM_INLINE lom_float3 lom_lamp_glitter(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    lom_float3 light = { { 0 }, { 0 }, { 0 } }, to_lamp;
    lom_float share, radiance;
    if (u->side < 0 || !(u->glitter > 0))
        return light;
    struct lom_lamp_walk walk = lom_walk_lamps(&u->light, p->offset, lom_splat3(0, 0, 0));
    lom_float lamps = lom_listed_lamps(&walk);
    LOM_NAME_VALUE(lamps);
    for (const struct lom_lamp_uniform *lamp = lom_next_lamp(&walk); lamp != NULL; lamp = lom_next_lamp(&walk)) {
        if (!lom_lamp_share(&walk, lamp, &to_lamp, &share) || !lom_facets_mirror(u, p, to_lamp, &radiance))
            continue;
        share = lom_select(to_lamp.y > 0.0f, share * radiance, (lom_float){ 0 });
        light = lom_add3(light, lom_scale3(lom_uniform3(lamp->specular), share));
        LOM_NAME_BY(lamp->name, share);
    }
    return light;
}

#endif
