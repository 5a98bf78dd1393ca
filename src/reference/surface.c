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

lom_vec3 lom_level_water_normal(const lom_reference *reference, const struct lom_crossing *c, double time)
{
    const lom_reference_water *w = &reference->water;
    if (w->slope != NULL) {
        double slope[2];
        w->slope(w->context, c->place.x, c->place.z, time, slope);
        return normal_of_slope(slope);
    }
    return reference->normal_map == LOM_NO_PICTURE ? (lom_vec3){ 0, 1, 0 } : mapped_normal(reference, c->place, time);
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
    c->facet =
        w->height != NULL && w->slope != NULL ? lom_level_water_normal(reference, c, time) : (lom_vec3){ 0, 1, 0 };
    return true;
}

bool lom_cross_water(const lom_reference *reference, const struct lom_ray *ray, double time, bool from_below,
                     double low, double high, struct lom_crossing *c)
{
    if (!meet_surface(reference, ray, time, from_below, low, high, c))
        return false;
    lom_meet_first_facet(reference, ray->direction, time, from_below, c);
    return true;
}
