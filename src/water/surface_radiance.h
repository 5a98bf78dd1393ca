/* The light that a surface of water sends to the eye, over lanes. In: a point of it with its slopes and their
 * covariance; out: radiance = F reflected + (1 - F) transmitted + glitter, under foam.
 *
 * Rays are followed against pictures of the scene with depth; what they leave to is the sky above and bottomless water
 * below. The same function serves an eye below the surface: side and eta tell. */
#ifndef LOM_WATER_SURFACE_RADIANCE_H
#define LOM_WATER_SURFACE_RADIANCE_H

#include "base/numbers.h"
#include "water/picture_rays.h"
#include "water/seen_facets.h"

/* ---- the sky ---- */

LOM_INLINE lom_float3 lom_sky_radiance(const struct lom_sky_uniform *sky, lom_float3 d, lom_float variance)
{
    lom_float3 color = lom_uniform3(sky->color);
    if (sky->gradient.on)
        return lom_mul3(color, lom_sky_gradient(&sky->gradient, d));
    if (sky->box == NULL)
        return color;
    lom_float3 turned = { sky->cosine * d.x + sky->sine * d.z, d.y, sky->cosine * d.z - sky->sine * d.x };
    /* A lobe of standard deviation 2 s on texels of about 1.3 / size; not wider than its height above the horizon. */
    lom_float low = lom_abs(d.y) + 0.02f, bounded = lom_min(variance, 0.25f * low * low);
    lom_float lod = 0.5f * lom_log2(lom_max(bounded * (sky->size * sky->size), lom_splat(1.0f)));
    lom_float4 texel = lom_sample_cube(sky->box, turned, lod);
    return lom_mul3(color, (lom_float3){ texel.x, texel.y, texel.z });
}

/* The radiance that arrives from along d, on the side of the surface that `above` names, from a picture and what is
 * beyond it. */
LOM_INLINE lom_float3 lom_arriving(const struct lom_surface_uniforms *u, const struct lom_picture_uniform *picture,
                                   const struct lom_surface_point *p, lom_float3 d, bool above, bool followed,
                                   lom_float variance)
{
    lom_float3 color = { { 0 }, { 0 }, { 0 } };
    lom_float length = lom_splat(endless), share = { 0 };
    if (picture->color != NULL) {
        /* Nothing of the scene is farther from the point. Under water nothing is seen beyond 10 absorption lengths of
         * the clearest colour; water that is clearer than its scene is wide needs no more than twice the way. */
        lom_float range = p->distance + u->range;
        if (!above)
            range = lom_min(2.0f * range, lom_splat(10.0f / u->medium.absorption[2]));
        struct lom_hit met = { { 0 }, lom_splat(endless), { 0 }, { 0 } };
        if (followed)
            met = lom_follow_ray(u, picture, p, d, range);
        struct lom_hit hit = lom_displaced_lookup(u, picture, p, d, met.length);
        if (followed) {
            hit.length = lom_select(met.found, met.length, hit.length);
            hit.s = lom_select(met.found, met.s, hit.s);
            hit.t = lom_select(met.found, met.t, hit.t);
            hit.found = hit.found | met.found;
        }
        lom_float4 texel = lom_texel_of_hit(u, picture, p, hit, above, variance);
        share = lom_select(hit.found, texel.w, (lom_float){ 0 });
        color = lom_scale3((lom_float3){ texel.x, texel.y, texel.z },
                           lom_select(hit.found, lom_splat(1.0f), (lom_float){ 0 }));
        length = lom_select(share > 0.5f, hit.length, length);
    }
    if (!above)
        return lom_cross_water(&u->medium, color, length, -d.y);
    lom_float3 sky = lom_sky_radiance(&u->sky, d, variance);
    return lom_add3(color, lom_scale3(sky, 1.0f - share));
}

/* ---- all of it ---- */

/* Fills what follows from the point and its slopes. */
LOM_INLINE void lom_finish_point(const struct lom_surface_uniforms *u, struct lom_surface_point *p)
{
    p->path = lom_eye_path(&u->eye, p->offset);
    p->distance = lom_sqrt(lom_dot3(p->path, p->path));
    p->to_eye = lom_scale3(p->path, -1.0f / lom_max(p->distance, lom_splat(1e-30f)));
    p->slopes.vxx = p->slopes.vxx + 0.5f * u->roughness;
    p->slopes.vzz = p->slopes.vzz + 0.5f * u->roughness;
    p->normal = lom_wave_normal(&p->slopes);
}

LOM_INLINE lom_float3 lom_surface_radiance(const struct lom_surface_uniforms *u, const struct lom_surface_point *p,
                                           const struct lom_footprint *f)
{
    bool above = u->side > 0;
    lom_float variance = p->slopes.vxx + p->slopes.vzz;
    lom_float3 d = lom_scale3(p->to_eye, lom_splat(-1.0f));
    struct lom_seen_facets seen = above ? lom_see_above(u, p) : lom_see_mean(u, p);

    lom_float3 r = lom_reflect3(d, lom_facing_eye(u, p, seen.mirroring));
    r.y = u->side * lom_max(lom_abs(r.y), lom_splat(1e-3f));
    lom_float3 reflected = lom_arriving(u, &u->mirrored, p, lom_normalize3(r), above, u->marched, variance);

    lom_float3 bent = d;
    lom_float share = seen.share;
    if (u->bent || !above) {
        lom_mask passes = lom_refract3(d, lom_facing_eye(u, p, seen.passing), lom_splat(u->eta), &bent);
        share = lom_select(passes, share, lom_splat(1.0f));
    }
    lom_float3 transmitted = lom_arriving(u, &u->behind, p, bent, !above, u->bent, 0.25f * variance);

    lom_float3 glitter = lom_glitter(u, p);
    if (u->light.lamps != NULL)
        glitter = lom_add3(glitter, lom_lamp_glitter(u, p));
    lom_float3 color = lom_add3(lom_mix3(transmitted, reflected, share), glitter);
    LOM_NAME_VALUE(reflected);
    LOM_NAME_VALUE(transmitted);
    LOM_NAME_AS(reflected_share, share);
    LOM_NAME_VALUE(glitter);
    if (u->foam.pattern == NULL)
        return color;
    lom_float cover = lom_foam_cover(u, p, f);
    if (!lom_any(cover > 0.0f))
        return color;
    return lom_mix3(color, lom_foam_radiance(u, p), cover);
}

#endif
