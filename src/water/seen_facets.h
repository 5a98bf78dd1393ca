/* What an eye sees of rough water, over lanes. In: a point of the surface with its slopes and their covariance. Out:
 * the share of light that its facets mirror, and the mean facets that mirror and that let light through.
 *
 * Slopes m towards the eye are normally distributed about that of the mean normal, m0 + s a with a standard deviation
 * s. The eye, at the unit vector v, sees a facet by the area that it shows, (n.v) / n_y = v_y + |v_xz| m = S (x + a),
 * S = |v_xz| s, and not those that are turned away: the density of what it sees is (x + a)+ phi(a) / Z. Light is the
 * mean over that density; it is found by Gauss's quadrature of two nodes, which is exact for polynomials of a of
 * degree 3. */
#ifndef LOM_WATER_SEEN_FACETS_H
#define LOM_WATER_SEEN_FACETS_H

#include "water/facets.h"

/* The nodes a and their weights. */
struct lom_slope_pair {
    lom_float at[2], weight[2];
};

/* For x >= 0. Moments of (x + a)+ phi(a), in P = Phi(x) and p = phi(x), by parts: x P + p, P, x P + 2 p, 3 P - x p. The
 * nodes are the mean m plus h -+ sqrt(h^2 + v), v the variance, h half of the third central moment over v. Phi is taken
 * as 1 / (1 + e^(-x (1.5976 + 0.07056 x^2))), which is within 2e-4 of it (Page 1977). */
LOM_INLINE struct lom_slope_pair lom_slope_pair_of(lom_float x)
{
    const float root_two_pi = 2.5066283f;
    lom_float square = x * x, p = lom_exp(-0.5f * square) / root_two_pi;
    lom_float below = 1.0f / (1.0f + lom_exp(-x * (1.5976f + 0.07056f * square)));
    lom_float inverse = 1.0f / (x * below + p);
    lom_float mean = below * inverse, second = (x * below + 2.0f * p) * inverse;
    lom_float third = (3.0f * below - x * p) * inverse;
    lom_float variance = second - mean * mean;
    lom_float half = 0.5f * (third - 3.0f * mean * second + 2.0f * mean * mean * mean) / variance;
    lom_float away = lom_sqrt(half * half + variance), high = 0.5f * (1.0f - half / away);
    return (struct lom_slope_pair){ { mean + half - away, mean + half + away }, { 1.0f - high, high } };
}

/* What is left of a share of light that a facet mirrors, by the sine of where to: other facets stand in its way but
 * for (1 + Lambda(v)) / (1 + Lambda(v) + Lambda(r)), which those leave open that are no higher than what the eye sees
 * (Ross, Dion, Potvin 2005), or all of them, where it goes down. What meets them is mirrored up by the same share and
 * sends for the rest what the water sends here. */
LOM_INLINE lom_float lom_unhidden_share(lom_float share, lom_float seen_lambda, lom_float up, lom_float variance)
{
    const lom_float none = { 0 };
    lom_float lambda = lom_smith_lambda(lom_max(up, none), variance);
    lom_float open = lom_select(up > 0.0f, (1.0f + seen_lambda) / (1.0f + seen_lambda + lambda), none);
    return share * (open + (1.0f - open) * share);
}

struct lom_seen_facets {
    lom_float share;               /* of the light that they mirror */
    lom_float3 mirroring, passing; /* unit normals, upwards: means by what they mirror and by the rest */
};

/* The facet of a slope towards the eye, and across. */
LOM_INLINE lom_float3 lom_facet_of_slope(const struct lom_view_slope *view, lom_float toward, lom_float across)
{
    return lom_normalize3(
        (lom_float3){ toward * view->x - across * view->z, lom_splat(1.0f), toward * view->z + across * view->x });
}

/* Those above the water. Of slopes across the view the mean square is in the length of a facet's normal. */
LOM_INLINE struct lom_seen_facets lom_see_facets(const struct lom_surface_uniforms *u,
                                                 const struct lom_surface_point *p)
{
    const struct lom_view_slope view = lom_view_slope_of(p);
    const lom_float none = { 0 };
    lom_float inverse = 1.0f / p->normal.y, deviation = lom_sqrt(view.variance);
    lom_float toward = (p->normal.x * view.x + p->normal.z * view.z) * inverse;
    lom_float across = (p->normal.z * view.x - p->normal.x * view.z) * inverse;
    lom_float rest = 1.0f + across * across + lom_max(p->slopes.vxx + p->slopes.vzz - view.variance, none);
    lom_float area = lom_max(p->to_eye.y + view.flat * toward, none), change = view.flat * deviation;
    struct lom_slope_pair pair = lom_slope_pair_of(lom_min(area / lom_max(change, lom_splat(1e-6f)), lom_splat(1e4f)));
    lom_float lambda = lom_smith_lambda(p->to_eye.y, view.variance);
    lom_float share = none, mirroring = none, passing = none;
    for (int i = 0; i < 2; i++) {
        lom_float slope = toward + deviation * pair.at[i], square = rest + slope * slope;
        lom_float shown = lom_max(area + change * pair.at[i], none);
        lom_float one = lom_surface_fresnel(u, shown / lom_sqrt(square));
        one = lom_unhidden_share(one, lambda, 2.0f * shown / square - p->to_eye.y, view.variance);
        share = share + pair.weight[i] * one;
        mirroring = mirroring + pair.weight[i] * one * slope;
        passing = passing + pair.weight[i] * (1.0f - one) * slope;
    }
    mirroring = mirroring / lom_max(share, lom_splat(1e-6f));
    passing = passing / lom_max(1.0f - share, lom_splat(1e-6f));
    return (struct lom_seen_facets){ share, lom_facet_of_slope(&view, mirroring, across),
                                     lom_facet_of_slope(&view, passing, across) };
}

/* A normal turned to the eye's side of the water, and further where it points away from the eye: what is seen faces
 * it. */
LOM_INLINE lom_float3 lom_facing_eye(const struct lom_surface_uniforms *u, const struct lom_surface_point *p,
                                     lom_float3 normal)
{
    lom_float3 n = lom_scale3(normal, lom_splat(u->side));
    lom_float turn = lom_max(0.08f - lom_dot3(n, p->to_eye), (lom_float){ 0 });
    return lom_normalize3(lom_add3(n, lom_scale3(p->to_eye, turn)));
}

/* From below: the mean normal alone. */
LOM_INLINE struct lom_seen_facets lom_see_mean(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    lom_float cosine = lom_dot3(lom_facing_eye(u, p, p->normal), p->to_eye);
    return (struct lom_seen_facets){ lom_surface_fresnel(u, cosine), p->normal, p->normal };
}

/* From above. Where a wave overturns, slopes say nothing: the mean normal is the mirror there, too, and of what it
 * mirrors down the water sends back its share. */
LOM_INLINE struct lom_seen_facets lom_see_above(const struct lom_surface_uniforms *u, const struct lom_surface_point *p)
{
    struct lom_seen_facets seen = lom_see_facets(u, p);
    lom_mask over = p->slopes.overturns & (p->normal.y < 0.1f);
    if (!lom_any(over))
        return seen;
    const struct lom_seen_facets mean = lom_see_mean(u, p);
    const lom_float none = { 0 };
    lom_float3 mirrored = lom_reflect3(lom_scale3(p->to_eye, lom_splat(-1.0f)), lom_facing_eye(u, p, p->normal));
    seen.share = lom_select(over, lom_unhidden_share(mean.share, none, mirrored.y, none), seen.share);
    for (int i = 0; i < 2; i++) {
        lom_float3 *facet = i == 0 ? &seen.mirroring : &seen.passing;
        *facet = (lom_float3){ lom_select(over, p->normal.x, facet->x), lom_select(over, p->normal.y, facet->y),
                               lom_select(over, p->normal.z, facet->z) };
    }
    return seen;
}

#endif
