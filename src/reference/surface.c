/* The water's surface. In: rays, places, times. Out: where a ray crosses the surface, the normal and the depth there. A
 * plane is met exactly; any other height field by equal steps with bisection at the first change of side. */
#include "reference/world.h"

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

double lom_water_above(const lom_reference *world, lom_vec3 place, double time)
{
    const lom_reference_water *w = &world->water;
    if (!has_water(w) || !covers(w, place.x, place.z) || place.y >= w->highest)
        return 0;
    return at_least(height_at(w, place.x, place.z, time) - place.y, 0);
}

/* ---- crossing ---- */

/* The part of low..high in which origin + t direction is between two planes across an axis. */
static bool cut_interval(double origin, double direction, double from, double to, double *low, double *high)
{
    if (direction == 0)
        return origin >= from && origin <= to;
    double a = (from - origin) / direction, b = (to - origin) / direction;
    *low = at_least(a < b ? a : b, *low);
    *high = at_most(a < b ? b : a, *high);
    return *low <= *high;
}

static bool hit_plane(const lom_reference_water *w, const struct lom_ray *ray, double low, double high, double *t)
{
    double at = (w->lowest - ray->origin.y) / ray->direction.y;
    if (ray->direction.y == 0 || !(at > low && at < high) ||
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

static bool hit_field(const lom_reference_water *w, const struct lom_ray *ray, double time, double low, double high,
                      double *t)
{
    enum { STEPS = 1 << 22 }; /* beyond them a ray that grazes endless waves is taken to miss */
    const lom_vec3 o = ray->origin, d = ray->direction;
    if (!cut_interval(o.y, d.y, w->lowest, w->highest, &low, &high) ||
        !cut_interval(o.x, d.x, w->low[0], w->high[0], &low, &high) ||
        !cut_interval(o.z, d.z, w->low[1], w->high[1], &low, &high))
        return false;
    bool from_above = above(w, ray, time, low) > 0;
    double last = low;
    for (int i = 1; i < STEPS && last < high; i++) {
        double next = at_most(low + i * w->step, high);
        if ((above(w, ray, time, next) > 0) != from_above) {
            *t = bisect(w, ray, time, last, next, from_above);
            return true;
        }
        last = next;
    }
    return false;
}

bool lom_hit_water(const lom_reference *world, const struct lom_ray *ray, double time, double low, double high,
                   double *t)
{
    const lom_reference_water *w = &world->water;
    if (!has_water(w))
        return false;
    return w->height == NULL ? hit_plane(w, ray, low, high, t) : hit_field(w, ray, time, low, high, t);
}

/* ---- normals ---- */

/* The normal map's y and z are swapped because the surface faces up, and its up component is scaled; both maps drift
 * with time, and the flow map displaces the normals by a tenth of a repetition (docs/scene.md, [water]). */
static lom_vec3 mapped_normal(const lom_reference *world, lom_vec3 place, double time)
{
    const lom_water_params *w = &world->scene->water;
    double u = place.x / w->tile, v = place.z / w->tile;
    if (world->flow_map != LOM_NO_PICTURE) {
        double moved = time * w->flow_speed;
        moved -= lom_double_floor(moved);
        lom_vec3 drift = lom_sample_picture(&world->pictures[world->flow_map].picture, u + moved, v);
        u += drift.x * 0.1;
        v += drift.y * 0.1 + moved;
    }
    lom_vec3 texel = lom_sample_picture(&world->pictures[world->normal_map].picture, u, v);
    return unit((lom_vec3){ texel.x * 2 - 1, texel.z * w->normal_up, texel.y * 2 - 1 });
}

lom_vec3 lom_water_normal(const lom_reference *world, lom_vec3 place, double time)
{
    const lom_reference_water *w = &world->water;
    if (w->slope != NULL) {
        double slope[2];
        w->slope(w->context, place.x, place.z, time, slope);
        return unit((lom_vec3){ -slope[0], 1, -slope[1] });
    }
    if (world->normal_map == LOM_NO_PICTURE)
        return (lom_vec3){ 0, 1, 0 };
    return mapped_normal(world, place, time);
}
