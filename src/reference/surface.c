/* The water's surface. In: rays, places, times. Out: where a ray crosses the surface, the normal and the depth there. A
 * plane is met exactly; any other height field by equal steps with bisection at the first change of side. */
#include "base/numbers.h"
#include "reference/wave_surface.h"

static bool has_water(const lom_reference_water *w)
{
    return w->low[0] <= w->high[0];
}

static bool covers(const lom_reference_water *w, double x, double z)
{
    return x >= w->low[0] && x <= w->high[0] && z >= w->low[1] && z <= w->high[1];
}

static double height_at(const lom_reference_water *w, double x, double z, double time)
{
    return w->height == NULL ? w->lowest : w->height(w->context, x, z, time);
}

bool lom_is_over_water(const lom_reference *reference, lom_vec3 place)
{
    return has_water(&reference->water) && covers(&reference->water, place.x, place.z);
}

double lom_water_above(const lom_reference *reference, lom_vec3 place, double time)
{
    const lom_reference_water *w = &reference->water;
    if (!lom_is_over_water(reference, place) || place.y >= w->highest)
        return 0;
    return lom_larger(height_at(w, place.x, place.z, time) - place.y, 0);
}

/* ---- crossing ---- */

/* The part of low..high in which origin + t direction is between two planes across an axis. */
static bool cut_interval(double origin, double direction, double from, double to, double *low, double *high)
{
    if (direction == 0)
        return origin >= from && origin <= to;
    double a = (from - origin) / direction, b = (to - origin) / direction;
    *low = lom_larger(a < b ? a : b, *low);
    *high = lom_smaller(a < b ? b : a, *high);
    return *low <= *high;
}

static bool hit_plane(const lom_reference_water *w, const struct lom_ray *ray, bool from_below, double low, double high,
                      double *t)
{
    double at = (w->lowest - ray->origin.y) / ray->direction.y;
    if (ray->direction.y == 0 || from_below != (ray->direction.y > 0) || !(at > low && at < high) ||
        !covers(w, ray->origin.x + ray->direction.x * at, ray->origin.z + ray->direction.z * at))
        return false;
    *t = at;
    return true;
}

/* How far the ray's point at t is above the surface. */
static double above(const lom_reference_water *w, const struct lom_ray *ray, double time, double t)
{
    lom_vec3 p = along(ray->origin, ray->direction, t);
    return p.y - height_at(w, p.x, p.z, time);
}

static double bisect(const lom_reference_water *w, const struct lom_ray *ray, double time, double from, double to,
                     bool from_above)
{
    for (int i = 0; i < 64; i++) {
        double middle = from + (to - from) / 2;
        if (middle <= from || middle >= to)
            break;
        if ((above(w, ray, time, middle) > 0) == from_above)
            from = middle;
        else
            to = middle;
    }
    return from;
}

/* A ray that starts on the wrong side, within rounding of the surface, first comes over to its own. */
static bool hit_field(const lom_reference_water *w, const struct lom_ray *ray, double time, bool from_below, double low,
                      double high, double *t)
{
    enum { STEPS = 1 << 22 }; /* beyond them a ray that grazes endless waves is taken to miss */
    const lom_vec3 o = ray->origin, d = ray->direction;
    if (!cut_interval(o.y, d.y, w->lowest, w->highest, &low, &high) ||
        !cut_interval(o.x, d.x, w->low[0], w->high[0], &low, &high) ||
        !cut_interval(o.z, d.z, w->low[1], w->high[1], &low, &high))
        return false;
    bool own_side = (above(w, ray, time, low) > 0) != from_below;
    double last = low;
    for (int i = 1; i < STEPS && last < high; i++) {
        double next = lom_smaller(low + i * w->step, high);
        bool there = (above(w, ray, time, next) > 0) != from_below;
        if (own_side && !there) {
            *t = bisect(w, ray, time, last, next, !from_below);
            return true;
        }
        own_side = there;
        last = next;
    }
    return false;
}

/* ---- normals ---- */

/* The normal map's y and z are swapped because the surface faces up, and its up component is scaled; both maps drift
 * with time, and the flow map displaces the normals by a tenth of a repetition (docs/scene.md, [water]). */
static lom_vec3 mapped_normal(const lom_reference *reference, lom_vec3 place, double time)
{
    const lom_water_params *w = &reference->scene->water;
    double u = (place.x - w->position[0]) / w->tile, v = (place.z - w->position[1]) / w->tile;
    if (reference->flow_map != LOM_NO_PICTURE) {
        double moved = time * w->flow_speed;
        moved -= lom_double_floor(moved);
        lom_vec3 drift = lom_sample_picture(&reference->pictures[reference->flow_map].picture, u + moved, v);
        u += drift.x * 0.1;
        v += drift.y * 0.1 + moved;
    }
    lom_vec3 texel = lom_sample_picture(&reference->pictures[reference->normal_map].picture, u, v);
    return unit((lom_vec3){ texel.x * 2 - 1, texel.z * w->normal_up, texel.y * 2 - 1 });
}

static lom_vec3 normal_of_slope(const double slope[2])
{
    return unit((lom_vec3){ -slope[0], 1, -slope[1] });
}

/* Ripples finer than any pixel have normal slopes of so much deviation about those of a normal. What a ray along -v sees of
 * a facet is in proportion to v.n / n.y (Ross, Dion, Potvin 2005), which is a + b x: x the slope along v in deviations. */
struct ripples {
    double a, b, flat; /* flat: the length of v without y */
    double deviation;
};

static struct ripples find_ripples(lom_vec3 normal, lom_vec3 v, double roughness)
{
    const double deviation = lom_double_sqrt(roughness / 2), flat = lom_double_sqrt(v.x * v.x + v.z * v.z);
    return (struct ripples){ dot(v, normal) / normal.y, deviation * flat, flat, deviation };
}

/* The area below the normal density up to x, and the density. */
static double normal_area(double x)
{
    return 0.5 * (1 + lom_double_erf(x * 0.7071067811865476));
}

static double normal_density(double x)
{
    return 0.3989422804014327 * lom_double_exp(-0.5 * x * x);
}

static bool is_flat(const struct ripples *r)
{
    return !(r->b > 1e-9 * lom_magnitude(r->a));
}

/* The mean of max(a + b x, 0). */
static double shown_area(const struct ripples *r)
{
    const double c = r->a / (is_flat(r) ? 1 : r->b);
    return is_flat(r) ? lom_larger(r->a, 0) : r->a * normal_area(c) + r->b * normal_density(c);
}

/* The x whose share of the density n(x) (c + x), x > -c, is the share that `drawn` has of the normal density n. The
 * integral is c (N(x) - N(-c)) + n(c) - n(x); it is inverted by Newton's steps between two bounds that close in. */
static double lean_towards(double drawn, double c)
{
    const double whole = c * normal_area(c) + normal_density(c), wanted = normal_area(drawn) * whole;
    const double hidden = c * normal_area(-c) - normal_density(c);
    double low = lom_larger(-c, -9), high = 9, x = lom_smaller(lom_larger(drawn, low), high);
    for (int i = 0; i < 60; i++) {
        const double density = normal_density(x), over = c * normal_area(x) - density - hidden - wanted;
        if (over > 0)
            high = x;
        else
            low = x;
        double next = x - over / (density * (c + x));
        if (!(next > low && next < high))
            next = low + (high - low) / 2;
        if (lom_magnitude(next - x) < 1e-12)
            return next;
        x = next;
    }
    return x;
}

/* One of those that are seen, by random numbers. */
static lom_vec3 ripple(lom_vec3 normal, lom_vec3 v, uint64_t key, uint64_t number, double roughness)
{
    double slopes[2];
    if (!(roughness > 0))
        return normal;
    lom_random_normal(key, number, slopes);
    const struct ripples r = find_ripples(normal, v, roughness);
    double x = slopes[0], z = slopes[1];
    if (!is_flat(&r)) {
        const double towards = lean_towards(slopes[0], lom_larger(r.a / r.b, -5));
        x = (towards * v.x - slopes[1] * v.z) / r.flat;
        z = (towards * v.z + slopes[1] * v.x) / r.flat;
    }
    const double up = normal.y * r.deviation;
    return unit((lom_vec3){ normal.x + up * x, normal.y, normal.z + up * z });
}

static lom_vec3 level_normal(const lom_reference *reference, const struct lom_crossing *c, double time)
{
    const lom_reference_water *w = &reference->water;
    if (w->slope != NULL) {
        double slope[2];
        w->slope(w->context, c->place.x, c->place.z, time, slope);
        return normal_of_slope(slope);
    }
    return reference->normal_map == LOM_NO_PICTURE ? (lom_vec3){ 0, 1, 0 } : mapped_normal(reference, c->place, time);
}

/* The geometry that rays meet is coarser than the water: waves that are shorter than its triangles, and ripples, are
 * normals n about the facet f. A ray along -v sees each by the area that it shows over its share of the facet's,
 * (n.v) / (n.f); those that are turned away hide behind others, and the facet shows no more than its own (Smith 1967;
 * Heitz 2014, section 3). One of so many waves of the place is taken with the probability of the share that its ripples
 * show in the mean (resampling: Talbot, Cline, Egbert 2005), and one of these by its own; the random numbers are those of
 * the place. */
static lom_vec3 seen_normal(const lom_reference *reference, const struct lom_ray *ray, double time, bool from_below,
                            const struct lom_crossing *c)
{
    enum { NORMALS = 16 };
    const double roughness = reference->water.roughness;
    const lom_vec3 v = scaled(ray->direction, from_below ? 1 : -1);
    const uint64_t x = lom_hash_bytes(LOM_HASH_START, &c->place.x, sizeof c->place.x);
    const uint64_t place = lom_hash_bytes(x, &c->place.z, sizeof c->place.z);
    lom_vec3 seen = reference->waves == NULL ? level_normal(reference, c, time) : c->facet;
    double whole = 0;
    for (uint64_t i = 0; reference->waves != NULL && i < NORMALS; i++) {
        const double part = ((double)i + lom_random_uniform(place, 2 * i)) / NORMALS - 0.5;
        const lom_vec3 n = lom_wave_surface_normal(reference->waves, c->rest, part);
        const struct ripples ripples = find_ripples(n, v, roughness);
        const double area = shown_area(&ripples) * n.y / lom_larger(dot(n, c->facet), 0.02);
        whole += area;
        if (lom_random_uniform(place, 2 * i + 1) * whole < area)
            seen = n;
    }
    return ripple(seen, v, place, 2 * NORMALS, roughness);
}

static bool meet_surface(const lom_reference *reference, const struct lom_ray *ray, double time, bool from_below,
                         double low, double high, struct lom_crossing *c)
{
    const lom_reference_water *w = &reference->water;
    if (reference->waves != NULL)
        return lom_hit_wave_surface(reference->waves, ray, from_below, low, high, c);
    if (!has_water(w) || !(w->height == NULL ? hit_plane(w, ray, from_below, low, high, &c->t)
                                             : hit_field(w, ray, time, from_below, low, high, &c->t)))
        return false;
    c->place = along(ray->origin, ray->direction, c->t);
    c->place.y = height_at(w, c->place.x, c->place.z, time);
    c->facet = w->height != NULL && w->slope != NULL ? level_normal(reference, c, time) : (lom_vec3){ 0, 1, 0 };
    return true;
}

bool lom_cross_water(const lom_reference *reference, const struct lom_ray *ray, double time, bool from_below,
                     double low, double high, struct lom_crossing *c)
{
    if (!meet_surface(reference, ray, time, from_below, low, high, c))
        return false;
    c->normal = seen_normal(reference, ray, time, from_below, c);
    return true;
}
