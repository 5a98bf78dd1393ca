/* Water whose slopes are normally distributed, by quadrature in double: what an eye sees of it that is far away. The oracle
 * of the far sea (C. Cox and W. Munk, J. Opt. Soc. Am. 44 (1954): the slopes and how they were measured; V. Ross, D. Dion
 * and G. Potvin, J. Opt. Soc. Am. A 22 (2005): which of them are seen). It shares nothing with lom.
 *
 * A facet of slopes (p, q) has the normal (-p, 1, -q) / sqrt(1 + p^2 + q^2). On a level square as much of it as the density
 * of its slopes says is such facets; an eye in the direction v sees of each in proportion to v.n / n_y, and of those that
 * face it alone. Shadowing by other facets that does not depend on the slope (B. Smith 1967) is divided out of a mean. What
 * is mirrored meets other facets on its way: walked_sky. */
#ifndef LOM_TESTS_ROUGH_WATER_H
#define LOM_TESTS_ROUGH_WATER_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct rough_water {
    double up, cross; /* variance of slopes along x and along z */
    double index;     /* of refraction */
} rough_water;

/* Clean sea and a wind in m/s at 12.5 m that blows along x: Cox and Munk's regression of 1954. */
static inline rough_water cox_munk(double wind)
{
    return (rough_water){ .up = 0.00316 * wind, .cross = 0.003 + 0.00192 * wind, .index = 1.34 };
}

/* Their regression for the sum of both, shared out evenly. */
static inline rough_water cox_munk_even(double wind)
{
    const double half = (0.003 + 0.00512 * wind) / 2;
    return (rough_water){ half, half, 1.34 };
}

static inline double slope_density(const rough_water *w, double p, double q)
{
    return exp(-0.5 * (p * p / w->up + q * q / w->cross)) / (6.283185307179586 * sqrt(w->up * w->cross));
}

/* Fresnel's equations for unpolarised light from the air. */
static inline double smooth_reflectance(double cosine, double index)
{
    const double inside = sqrt(1 - (1 - cosine * cosine) / (index * index));
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (inside - index * cosine) / (inside + index * cosine);
    return (s * s + p * p) / 2;
}

/* The mean over the slopes that the eye in the unit direction v sees of f(cosine of incidence, normal, context). */
typedef double of_facet(const double n[3], double cosine, const void *context);
static inline double seen_mean(const rough_water *w, const double v[3], of_facet *f, const void *context)
{
    enum { STEPS = 600 };
    double sum = 0, weights = 0;
    for (int i = 0; i < STEPS; i++)
        for (int k = 0; k < STEPS; k++) {
            const double p = (i + 0.5 - STEPS / 2) * 14 / STEPS * sqrt(w->up);
            const double q = (k + 0.5 - STEPS / 2) * 14 / STEPS * sqrt(w->cross), up = 1 / sqrt(1 + p * p + q * q);
            const double n[3] = { -p * up, up, -q * up }, cosine = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
            if (cosine <= 0)
                continue;
            const double weight = slope_density(w, p, q) * cosine / up;
            weights += weight;
            sum += weight * f(n, cosine, context);
        }
    return sum / weights;
}

static inline double reflectance_of_facet(const double n[3], double cosine, const void *context)
{
    const rough_water *w = context;
    (void)n;
    return smooth_reflectance(cosine, w->index);
}

/* What it mirrors of an even sky, by one reflection. */
static inline double mean_reflectance(const rough_water *w, const double v[3])
{
    return seen_mean(w, v, reflectance_of_facet, w);
}

/* Facets behind others, to those that are seen, for a direction of this cosine in which slopes have this variance (B.
 * Smith, IEEE Trans. Antennas Propag. 15 (1967)); those that are seen share 1 / (1 + it). */
static inline double hidden_facets(double cosine, double variance)
{
    const double a = cosine / sqrt(2 * variance * (1 - cosine * cosine));
    return cosine < 1 ? 0.5 * (exp(-a * a) / (a * 1.772453850905516) - erfc(a)) : 0;
}

static inline double variance_towards(const rough_water *w, const double v[3])
{
    const double flat = v[0] * v[0] + v[2] * v[2];
    return flat > 0 ? (w->up * v[0] * v[0] + w->cross * v[2] * v[2]) / flat : w->up;
}

static inline double next_uniform(uint64_t *state)
{
    *state ^= *state << 13; /* xorshift (Marsaglia 2003) */
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
}

/* A facet that is seen from the unit direction v, which may be from below: slopes are drawn, and taken by the area that
 * they show. */
static inline double draw_facet(const rough_water *w, const double v[3], uint64_t *state, double n[3])
{
    const double steepest = sqrt(variance_towards(w, v) * (1 - v[1] * v[1])), most = v[1] + 6 * steepest;
    for (;;) {
        const double r = sqrt(-2 * log(next_uniform(state))), turn = 6.283185307179586 * next_uniform(state);
        const double p = r * cos(turn) * sqrt(w->up), q = r * sin(turn) * sqrt(w->cross);
        const double area = v[1] - v[0] * p - v[2] * q, up = 1 / sqrt(1 + p * p + q * q);
        if (!(area > 0 && next_uniform(state) * most <= area))
            continue;
        n[0] = -p * up;
        n[1] = up;
        n[2] = -q * up;
        return area * up;
    }
}

/* How much of an even sky it mirrors, light that goes from facet to facet included: a walk back along it (E. Heitz, J.
 * Hanika, E. d'Eon and C. Dachsbacher, ACM Trans. Graph. 35 (2016), section 4). Heights are those of a share `below` of
 * the facets; a ray goes on between facets by Smith's Lambda, which below the level is -1 less that of the opposite
 * direction, and has left when it passes all. What goes into the water is lost. */
static inline double walked_sky(const rough_water *w, const double v[3], int walks)
{
    uint64_t state = 88172645463325252u;
    double sum = 0;
    for (int i = 0; i < walks; i++) {
        double from[3] = { v[0], v[1], v[2] }, n[3], below = 1, light = 1;
        for (int bounce = 0; bounce < 30; bounce++) {
            const double sine = -from[1], variance = variance_towards(w, from), left = 1 - next_uniform(&state);
            const double lambda = sine > 0 ? hidden_facets(sine, variance) : -1 - hidden_facets(-sine, variance);
            if (sine > 0 && (lambda <= 0 || left <= pow(below, lambda)))
                break;
            below = fmin(fmax(below / pow(left, 1 / lambda), 1e-300), 1);
            const double cosine = draw_facet(w, from, &state, n);
            light *= smooth_reflectance(cosine, w->index);
            for (int k = 0; k < 3; k++)
                from[k] = from[k] - 2 * cosine * n[k]; /* minus the mirrored direction */
        }
        sum += light / walks;
    }
    return sum;
}

/* What it mirrors of a distant light of irradiance 1 from the unit direction l: F P / (4 v_y h_y^4) of the facet h that
 * mirrors it, P the density of its slopes, less what other facets hide from the eye and, where `shadowed`, from the light. */
static inline double mirrored_light(const rough_water *w, const double v[3], const double l[3], bool shadowed)
{
    const double h[3] = { v[0] + l[0], v[1] + l[1], v[2] + l[2] };
    const double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]), y = h[1] / length;
    const double cosine = (v[0] * h[0] + v[1] * h[1] + v[2] * h[2]) / length;
    if (!(y > 0 && cosine > 0 && v[1] > 0))
        return 0;
    const double hidden = hidden_facets(v[1], variance_towards(w, v));
    const double shade = shadowed ? hidden_facets(l[1], variance_towards(w, l)) : 0;
    return smooth_reflectance(cosine, w->index) * slope_density(w, -h[0] / h[1], -h[2] / h[1]) /
           (4 * v[1] * y * y * y * y * (1 + hidden + shade));
}

#endif
