/* Facets of the water's surface that are smaller than the geometry which rays meet: waves between the corners of its
 * triangles, and ripples. In: a crossing, the direction of a ray. Out: the facet that it meets, and those that it meets
 * before it has left them all. Invariant: the numbers that are drawn are those of the place.
 *
 * Directions are turned about (times -1) under water, so that facets face up on either side. */
#include "base/numbers.h"
#include "reference/wave_surface.h"

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

/* The geometry that rays meet is coarser than the water: waves that are shorter than its triangles, and ripples, are
 * normals n about the facet f. A ray along -v sees each by the area that it shows over its share of the facet's,
 * (n.v) / (n.f); those that are turned away hide behind others, and the facet shows no more than its own (Smith 1967;
 * Heitz 2014, section 3). One of so many waves of the place is taken with the probability of the share that its ripples
 * show in the mean (resampling: Talbot, Cline, Egbert 2005), and one of these by its own; the random numbers are those of
 * the key. spread: of the slopes of all of them about the facet's. */
static lom_vec3 seen_normal(const lom_reference *reference, const struct lom_crossing *c, lom_vec3 v, double time,
                            uint64_t key, struct lom_slope_spread *spread)
{
    enum { NORMALS = 16 };
    const double roughness = reference->water.roughness, x = c->facet.x / c->facet.y, z = c->facet.z / c->facet.y;
    lom_vec3 seen = reference->waves == NULL ? lom_level_water_normal(reference, c, time) : c->facet;
    double whole = 0;
    *spread = (struct lom_slope_spread){ roughness / 2, 0, roughness / 2 };
    for (uint64_t i = 0; reference->waves != NULL && i < NORMALS; i++) {
        const double part = ((double)i + lom_random_uniform(key, 2 * i)) / NORMALS - 0.5;
        const lom_vec3 n = lom_wave_surface_normal(reference->waves, c->rest, part);
        const struct ripples ripples = find_ripples(n, v, roughness);
        const double area = shown_area(&ripples) * n.y / lom_larger(dot(n, c->facet), 0.02);
        const double up = lom_larger(n.y, 0.1), along_x = n.x / up - x, along_z = n.z / up - z;
        whole += area;
        if (lom_random_uniform(key, 2 * i + 1) * whole < area)
            seen = n;
        spread->xx += along_x * along_x / NORMALS;
        spread->xz += along_x * along_z / NORMALS;
        spread->zz += along_z * along_z / NORMALS;
    }
    return ripple(seen, v, key, 2 * NORMALS, roughness);
}

void lom_meet_first_facet(const lom_reference *reference, lom_vec3 direction, double time, bool from_below,
                          struct lom_crossing *c)
{
    const uint64_t x = lom_hash_bytes(LOM_HASH_START, &c->place.x, sizeof c->place.x);
    c->key = lom_hash_bytes(x, &c->place.z, sizeof c->place.z);
    c->normal = seen_normal(reference, c, scaled(direction, from_below ? 1 : -1), time, c->key, &c->spread);
}

/* ---- from facet to facet ---- */

/* Smith's Lambda (B. Smith, IEEE Trans. Antennas Propag. 15 (1967)): facets behind others to those that are seen from a
 * unit direction above the facet's plane. Slopes along it vary by b about its own, as `up` counts: the direction's slope
 * less the facet's, times how flat it is. */
static double hidden_facets(double up, double b)
{
    const double t = up / (b * 1.4142135623730951);
    if (!(t < 6))
        return 0;
    const double tail = 0.5 * (1 - lom_double_erf(t));
    return lom_larger(lom_double_exp(-t * t) / (lom_larger(t, 1e-9) * 3.5449077018110318) - tail, 0);
}

/* The logarithm of the share of facets below a ray where it meets the next one; 0 or more: it has left them all. On its way
 * it passes by a share of those that it meets, the power of Lambda of how the shares below have grown; downwards Lambda is
 * -1 less that of the opposite direction (E. Heitz, J. Hanika, E. d'Eon, C. Dachsbacher, ACM Trans. Graph. 35 (2016)). */
static double next_height(const struct lom_facet_walk *walk, lom_vec3 u)
{
    const struct lom_crossing *c = walk->crossing;
    const double square = c->spread.xx * u.x * u.x + 2 * c->spread.xz * u.x * u.z + c->spread.zz * u.z * u.z;
    const double up = dot(u, c->facet) / c->facet.y, b = lom_double_sqrt(lom_larger(square, 0));
    const double lambda = up > 0 ? hidden_facets(up, b) : -1 - hidden_facets(-up, b);
    const double passed = lom_double_log(1 - lom_random_uniform(walk->key, 0));
    return lambda == 0 ? 0 : walk->height - passed / lambda;
}

static void turn_key(struct lom_facet_walk *walk)
{
    walk->key = lom_random_bits(walk->key, 1);
}

struct lom_facet_walk lom_enter_facets(const lom_reference *reference, const struct lom_crossing *c, lom_vec3 direction,
                                       double time, bool from_below)
{
    struct lom_facet_walk walk = { .reference = reference, .crossing = c, .time = time, .key = c->key };
    walk.side = from_below ? -1 : 1;
    turn_key(&walk);
    walk.height = next_height(&walk, scaled(direction, walk.side));
    return walk;
}

bool lom_meet_facet(struct lom_facet_walk *walk, lom_vec3 direction, lom_vec3 *normal)
{
    enum { MOST = 16 };
    struct lom_slope_spread unread;
    const lom_vec3 u = scaled(direction, walk->side);
    turn_key(walk);
    walk->height = next_height(walk, u);
    if (walk->height >= 0 || walk->met++ == MOST)
        return false;
    turn_key(walk);
    *normal = seen_normal(walk->reference, walk->crossing, scaled(u, -1), walk->time, walk->key, &unread);
    if (!(dot(*normal, u) < 0))
        *normal = walk->crossing->facet;
    return dot(*normal, u) < 0;
}
