/* What an eye sees of rough water, over lanes. In: a point of the surface with its slopes and their covariance. Out:
 * the share of light that its facets mirror, and the mean facets that mirror and that let light through.
 *
 * Slopes m towards the eye are normally distributed about that of the mean normal, m0 + s a with a standard deviation
 * s. The eye, at the unit vector v, sees a facet by the area that it shows, t = (n.v) / n_y = v_y + |v_xz| m =
 * S (x + a), S = |v_xz| s, and not those that are turned away: the density of what it sees is (x + a)+ phi(a) / Z(x).
 * Light is the mean over that density. Fresnel's share falls with t about as e^(-k t); with h = F e^(k t) the mean of F
 * is that of h over (x + a)+ phi(a) e^(-k t), which is such a density again, about x - k S and with a + k S for a. There
 * Gauss's quadrature of two nodes, exact where h is a polynomial of degree 3, is within 0.2 % of the mean for s up to 0.2,
 * where over the density itself it is off by 4.4 %. */
#ifndef LOM_WATER_SEEN_FACETS_H
#define LOM_WATER_SEEN_FACETS_H

#include "water/facets.h"

/* k: minus the logarithm of the share of water seen from above, so that h is 1 at both ends. */
#define LOM_FRESNEL_FALL 3.9f

/* Phi(x), within 2e-4 (Page 1977). */
LOM_INLINE lom_float lom_normal_area(lom_float x)
{
    return 1.0f / (1.0f + lom_fade(-x * (1.5976f + 0.07056f * (x * x))));
}

LOM_INLINE lom_float lom_normal_density(lom_float x)
{
    return 0.39894228f * lom_fade(-0.5f * (x * x));
}

/* The density (x + a)+ phi(a): its integral Z, its mean, and the nodes a with their weights. */
struct lom_shown_slopes {
    lom_float whole, mean, at[2], weight[2];
};

/* Moments by parts, in P = Phi(x) and p = phi(x): x P + p, P, x P + 2 p, 3 P - x p. The nodes are the mean m plus
 * h -+ sqrt(h^2 + v), v the variance, h half of the third central moment over v. */
LOM_INLINE struct lom_shown_slopes lom_shown_slopes_of(lom_float x)
{
    lom_float p = lom_normal_density(x), below = lom_normal_area(x);
    lom_float whole = x * below + p, inverse = 1.0f / whole;
    lom_float mean = below * inverse, second = (x * below + 2.0f * p) * inverse;
    lom_float third = (3.0f * below - x * p) * inverse;
    lom_float variance = second - mean * mean;
    lom_float half = 0.5f * (third - 3.0f * mean * second + 2.0f * mean * mean * mean) / variance;
    lom_float away = lom_sqrt(half * half + variance), high = 0.5f * (1.0f - half / away);
    return (struct lom_shown_slopes){ whole, mean, { mean + half - away, mean + half + away }, { 1.0f - high, high } };
}

/* The integrals of (y + a) phi(a) and of a times it, from -y to z > -y. */
struct lom_slope_part {
    lom_float area, moment;
};

LOM_INLINE struct lom_slope_part lom_part_of_slopes(lom_float y, lom_float z)
{
    lom_float between = lom_normal_area(z) - lom_normal_area(-y), edge = lom_normal_density(z);
    return (struct lom_slope_part){ lom_max(y * between + lom_normal_density(y) - edge, (lom_float){ 0 }),
                                    between - (y + z) * edge };
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

/* What other facets hide of the light that is mirrored is taken to be all of it up to some t, where it goes up by a few
 * of ten times s, and what meets them there to be mirrored up by the share of another cosine, S. The four numbers are
 * fitted to the walk of light among facets with Smith's shadowing (Heitz, Hanika, d'Eon, Dachsbacher 2016; the test's
 * tests/rough_water.h): with them the share of a whole sky is within 1 % of that walk, for slopes of Cox and Munk's winds
 * from 1 to 18 m/s from 40 to 89 degrees from upright; below it is nothing. */
struct lom_hidden_facets {
    lom_float up_to, lost; /* t; 1 - S */
};

LOM_INLINE struct lom_hidden_facets lom_hidden_facets_of(const struct lom_surface_uniforms *u, lom_float seen_y,
                                                         lom_float deviation, lom_float square)
{
    lom_float up = lom_max(seen_y, lom_splat(1e-6f)), higher = 0.67f * deviation * up / (up + 0.33f * deviation);
    lom_float again = lom_surface_fresnel(u, 0.49f * deviation + 0.11f * up);
    return (struct lom_hidden_facets){ 0.5f * up * square + higher, 1.0f - again };
}

/* Those above the water. Of slopes across the view the mean square is in the length of a facet's normal. */
LOM_INLINE struct lom_seen_facets lom_see_facets(const struct lom_surface_uniforms *u,
                                                 const struct lom_surface_point *p)
{
    const struct lom_view_slope view = lom_view_slope_of(p);
    const lom_float none = { 0 };
    lom_float inverse = 1.0f / p->normal.y, s = lom_sqrt(view.variance);
    lom_float toward = (p->normal.x * view.x + p->normal.z * view.z) * inverse;
    lom_float across = (p->normal.z * view.x - p->normal.x * view.z) * inverse;
    lom_float rest = 1.0f + across * across + lom_max(p->slopes.vxx + p->slopes.vzz - view.variance, none);
    lom_float area = lom_max(p->to_eye.y + view.flat * toward, none), change = view.flat * s;
    lom_float steep = 1.0f / lom_max(change, lom_splat(1e-6f)), fall = LOM_FRESNEL_FALL * change;
    lom_float x = lom_min(area * steep, lom_splat(1e4f));

    struct lom_shown_slopes shown = lom_shown_slopes_of(x), mirrors = lom_shown_slopes_of(x - fall);
    lom_float share = none, slopes = none;
    for (int i = 0; i < 2; i++) {
        lom_float a = mirrors.at[i] - fall, slope = toward + s * a;
        lom_float cosine = lom_max(area + change * a, none) / lom_sqrt(rest + slope * slope);
        lom_float h = lom_surface_fresnel(u, cosine) * lom_exp(fall * (a + 0.5f * fall));
        share = share + mirrors.weight[i] * h;
        slopes = slopes + mirrors.weight[i] * h * slope;
    }
    struct lom_hidden_facets hidden = lom_hidden_facets_of(u, p->to_eye.y, s, rest + toward * toward);
    struct lom_slope_part part = lom_part_of_slopes(x - fall, (hidden.up_to - area) * steep + fall);
    lom_float lost = share * hidden.lost / mirrors.whole;
    slopes = slopes - lost * (part.area * (toward - s * fall) + s * part.moment);
    share = share - lost * part.area;

    lom_float scale = mirrors.whole / shown.whole;
    share = share * scale;
    slopes = slopes * scale;
    lom_float passing = toward + s * shown.mean - slopes;
    return (
        struct lom_seen_facets){ share, lom_facet_of_slope(&view, slopes / lom_max(share, lom_splat(1e-6f)), across),
                                 lom_facet_of_slope(&view, passing / lom_max(1.0f - share, lom_splat(1e-6f)), across) };
}

/* The least cosine of what is seen of a wave that is turned away: that of the mean facet that an eye sees along the level, s
 * sqrt(pi / 2), for Cox and Munk's (1954) clean sea in a wind of 1 m/s, whose slopes have s^2 = 0.00406. Where waves hide
 * their backs and where a sheet ends it stands for what a pixel shows beside them.
 *
 * Level water may face the eye less, as much as it does: an eye sees facets by the area that they show, so that those whose
 * slopes are spread evenly about the level lean to it in the mean, and none of their means faces it less than the level. */
#define LOM_LEAST_FACING 0.08f

/* A normal turned to the eye's side of the water, and further where it points away from the eye: what is seen faces
 * it. */
LOM_INLINE lom_float3 lom_facing_eye(const struct lom_surface_uniforms *u, const struct lom_surface_point *p,
                                     lom_float3 normal)
{
    lom_float3 n = lom_scale3(normal, lom_splat(u->side));
    lom_float least = lom_min(lom_abs(p->to_eye.y), lom_splat(LOM_LEAST_FACING));
    lom_float turn = lom_max(least - lom_dot3(n, p->to_eye), (lom_float){ 0 });
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
    lom_float3 mirrored = lom_reflect3(lom_scale3(p->to_eye, lom_splat(-1.0f)), lom_facing_eye(u, p, p->normal));
    lom_float again = lom_select(mirrored.y > 0.0f, lom_splat(1.0f), mean.share);
    seen.share = lom_select(over, mean.share * again, seen.share);
    for (int i = 0; i < 2; i++) {
        lom_float3 *facet = i == 0 ? &seen.mirroring : &seen.passing;
        *facet = (lom_float3){ lom_select(over, p->normal.x, facet->x), lom_select(over, p->normal.y, facet->y),
                               lom_select(over, p->normal.z, facet->z) };
    }
    return seen;
}

#endif
