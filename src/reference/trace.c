/* Rays through the scene. In: a loaded scene and a ray. Out: the radiance that comes back along it: that of the nearest
 * opaque surface or of the sky, and at each crossing of the water the reflected and the refracted share of both ways.
 *
 * Radiance is not divided by the squared index where it leaves the water, nor is what the ground below sends up thrown
 * back down again by the surface: in uniform light over white ground without absorption the two cancel, and each
 * without the other would be wrong by that much. */
#include "reference/liquids.h"

struct path {
    struct lom_ray ray;                  /* of unit direction */
    double low;                          /* nothing nearer than this is seen */
    int depth;                           /* crossings of water and liquids that may follow */
    const lom_reference *inside;         /* of the water that it is in, or NULL */
    const struct lom_ray_liquid *liquid; /* that it is in, or NULL; then `inside` does not count */
    lom_vec3 matter;                     /* what that sends back */
    bool by_water;                       /* it has met the water before, so it sees the sun's disc as well */
};

struct tracer {
    const lom_reference *reference;
    double time;
};

static const double FAR = 1e300;

static lom_vec3 follow(const struct tracer *tracer, const struct path *path);

/* Light from `beyond` after a way of t metres through water, from `depth` metres below the surface on. Each metre takes
 * a share a of it (Beer and Lambert) and adds a source exp(-a slant depth): the sunlight that comes down so far and is
 * scattered to here. Over the way, with rate = 1 + slant (metres down a metre), that is
 * source exp(-a slant depth) (1 - exp(-a t rate)) / rate; straight down without end it is source / (1 + slant), which
 * the water's color states. */
static lom_vec3 cross_medium(const struct tracer *tracer, const struct path *path, lom_vec3 beyond, double t)
{
    const lom_reference *reference = path->inside;
    const lom_reference_water *water = &reference->water;
    double slant = reference->slant, rate = 1 - slant * path->ray.direction.y;
    double depth = lom_water_above(reference, path->ray.origin, tracer->time);
    double *channel[3] = { &beyond.x, &beyond.y, &beyond.z };
    for (int i = 0; i < 3; i++) {
        double a = water->absorption[i], thickness = a * t;
        double source = water->color[i] * (1 + slant) * lom_double_exp(-a * slant * depth);
        double inner = __builtin_fabs(rate) < 1e-9 ? thickness : -lom_double_expm1(-thickness * rate) / rate;
        *channel[i] = *channel[i] * lom_double_exp(-thickness) + (source > 0 ? source * inner : 0);
    }
    return beyond;
}

/* What a directional light of radiance `light` on a white diffuse surface looks like as a disc of this radius: with
 * irradiance pi light, pi light / (pi sin^2 radius). */
static lom_vec3 sun_disc(const lom_reference *reference, lom_vec3 direction)
{
    double radius = reference->scene->quality.reference.sun, sine = lom_double_sin(radius);
    if (dot(direction, reference->to_light) < lom_double_cos(radius))
        return (lom_vec3){ 0, 0, 0 };
    return scaled(reference->light, reference->scene->water.optics.glitter / (sine * sine));
}

/* What is nearer to a lamp than its shadow begins does not hide its disc. */
static bool comes_within(const lom_reference *reference, const struct lom_placed_lamp *lamp, lom_vec3 to_lamp,
                         double distance, double far)
{
    const bool clears = lamp->lamp->shadow && reference->scene->quality.lamp_shadows > 0;
    return distance - (clears ? lom_lamp_clearance(lamp, scaled(to_lamp, -1)) : 0) <= far;
}

/* The lamps that a ray from the water sees as such discs, nearer than `far`. */
static lom_vec3 lamp_discs(const lom_reference *reference, const struct lom_ray *ray, double far)
{
    const double radius = reference->scene->quality.reference.sun, sine = lom_double_sin(radius);
    const double edge = lom_double_cos(radius), bright = reference->scene->water.optics.glitter / (sine * sine);
    lom_vec3 light = { 0, 0, 0 };
    for (size_t i = 0; i < reference->moment.lamp_count; i++) {
        const struct lom_placed_lamp *lamp = &reference->moment.lamps[i];
        lom_vec3 to_lamp;
        double distance, share = lom_lamp_share_at(lamp, ray->origin, &to_lamp, &distance);
        if (dot(ray->direction, to_lamp) >= edge && comes_within(reference, lamp, to_lamp, distance, far))
            light = along(light, vector(lamp->specular), bright * share);
    }
    return light;
}

/* d on the side of the plane that n points to: mirrored when it is not. */
static lom_vec3 kept_in_front(lom_vec3 d, lom_vec3 n)
{
    return dot(d, n) < 0 ? lom_reference_mirror(d, n) : d;
}

/* ---- liquids ---- */

/* What of the light is taken on the way, the liquid's matter sends back. */
static lom_vec3 cross_liquid(const struct path *path, lom_vec3 beyond, double t)
{
    const lom_vec3 left = lom_transmitted(path->liquid->params->absorption, t);
    return sum(product(beyond, left), product(path->matter, difference((lom_vec3){ 1, 1, 1 }, left)));
}

/* The reference of the water that a place is in; NULL: of none. */
static const lom_reference *water_at(const lom_reference *reference, lom_vec3 place, double time)
{
    for (size_t i = 0; i <= reference->other_count; i++)
        if (lom_water_above(lom_reference_with(reference, i), place, time) > 0)
            return lom_reference_with(reference, i);
    return NULL;
}

/* The two ways that a path goes on where it comes into a liquid or out of it, and the lights' picture on it. */
static lom_vec3 divide_liquid(const struct tracer *tracer, const struct path *path, const struct lom_ray_liquid *met,
                              const struct lom_liquid_crossing *c)
{
    const bool enters = path->liquid == NULL;
    const lom_reference *around = enters ? path->inside : water_at(tracer->reference, c->place, tracer->time);
    const double index = met->params->index / (around != NULL ? around->water.index : 1), side = enters ? 1 : -1;
    const lom_vec3 d = path->ray.direction, normal = scaled(c->normal, side), facet = scaled(c->facet, side);
    struct path next = { .depth = path->depth - 1, .inside = path->inside, .liquid = path->liquid };
    lom_vec3 matter = path->matter, light = { 0, 0, 0 }, bent;
    if (enters)
        matter =
            lom_shade_liquid(tracer->reference, &met->material, c->place, normal, scaled(d, -1), tracer->time, &light);
    next.matter = matter;
    const double share = lom_reference_fresnel(-dot(d, normal), enters ? index : 1 / index);
    if (share > 0) {
        next.ray = (struct lom_ray){ c->place, kept_in_front(lom_reference_mirror(d, normal), facet) };
        light = sum(light, scaled(follow(tracer, &next), share));
    }
    if (share < 1 && lom_reference_refract(d, normal, enters ? index : 1 / index, &bent)) {
        next.ray = (struct lom_ray){ c->place, kept_in_front(bent, scaled(facet, -1)) };
        next.liquid = enters ? met : NULL;
        next.inside = around;
        light = sum(light, scaled(follow(tracer, &next), 1 - share));
    }
    return light;
}

/* ---- water ---- */

/* A share of the light that a path finds on the same side of the water, or on the other. */
static lom_vec3 leave(const struct tracer *tracer, const struct path *path, const lom_reference *met, lom_vec3 place,
                      lom_vec3 direction, bool crosses, double share)
{
    const bool in_water = (path->inside != NULL) != crosses;
    struct path next = {
        .ray = { place, direction }, .depth = path->depth - 1, .inside = in_water ? met : NULL, .by_water = true
    };
    return share > 0 ? scaled(follow(tracer, &next), share) : (lom_vec3){ 0, 0, 0 };
}

/* The ways that a path goes on after the water's surface. What a facet mirrors may meet others before it leaves them all;
 * each lets its share through. What a facet would bend to before the geometry's is mirrored by that. */
static lom_vec3 divide(const struct tracer *tracer, const struct path *path, const lom_reference *met,
                       const struct lom_crossing *c)
{
    const bool in_water = path->inside != NULL;
    const double side = in_water ? -1 : 1, index = in_water ? 1 / met->water.index : met->water.index;
    const lom_vec3 behind = scaled(c->facet, -side);
    lom_vec3 d = path->ray.direction, normal = c->normal, light = { 0, 0, 0 }, bent;
    struct lom_facet_walk walk = lom_enter_facets(met, c, d, tracer->time, in_water);
    double left = 1;
    do {
        normal = scaled(normal, side);
        const double share = lom_reference_fresnel(-dot(d, normal), index);
        if (share < 1 && lom_reference_refract(d, normal, index, &bent))
            light =
                sum(light, leave(tracer, path, met, c->place, kept_in_front(bent, behind), true, left * (1 - share)));
        left *= share;
        d = lom_reference_mirror(d, normal);
    } while (lom_meet_facet(&walk, d, &normal));
    return sum(light, leave(tracer, path, met, c->place, kept_in_front(d, scaled(c->facet, side)), false, left));
}

/* Light that comes from t along the path, as it is at its origin. */
static lom_vec3 carry(const struct tracer *tracer, const struct path *path, double t, lom_vec3 light)
{
    if (path->liquid != NULL)
        return cross_liquid(path, light, t);
    if (path->inside != NULL)
        return cross_medium(tracer, path, light, t);
    light = lom_light_through_haze(tracer->reference, &path->ray, t, light);
    return lom_light_through_clouds(tracer->reference, &path->ray, t, tracer->time, light);
}

/* The nearest side of a transparent face behind `low` and before hit->t. */
static bool find_layer(const lom_reference *reference, const struct path *path, double low, struct lom_ray_hit *hit)
{
    struct lom_ray_triangles back = reference->transparent;
    back.inside_out = true;
    bool front = lom_hit_triangles(&reference->transparent, &path->ray, low, hit);
    return lom_hit_triangles(&back, &path->ray, low, hit) || front;
}

/* `light` comes from t to the origin, through all transparent faces before t. Air and clouds let T(t) c + S(t) of a light c
 * through; a face of opacity a gives light c of its own: seen is T c + a S, over (1 - a) of what is seen behind it. */
static lom_vec3 through_layers(const struct tracer *tracer, const struct path *path, double t, lom_vec3 light)
{
    const lom_reference *reference = tracer->reference;
    const lom_vec3 none = { 0, 0, 0 };
    struct lom_ray_hit hit = { .t = t };
    lom_vec3 seen = none;
    double share = 1, low = path->low;
    if (reference->transparent.count == 0)
        return light;
    while (share > 0 && find_layer(reference, path, low, &hit)) {
        double opacity;
        lom_vec3 own = lom_shade_transparent(reference, &path->ray, &hit, tracer->time, &opacity);
        seen = along(seen, carry(tracer, path, hit.t, own), share);
        share *= 1 - opacity;
        seen = along(seen, carry(tracer, path, hit.t, none), -share);
        low = hit.t * (1 + 1e-9); /* on an edge both its triangles are hit, at places that rounding parts */
        hit.t = t;
    }
    return along(seen, light, share);
}

/* What is opaque, or the sky. */
static lom_vec3 end(const struct tracer *tracer, const struct path *path, const struct lom_ray_hit *hit)
{
    const lom_reference *reference = tracer->reference;
    if (hit->t < FAR)
        return lom_shade_hit(reference, &path->ray, hit, tracer->time);
    const lom_vec3 light = lom_sky_light(reference, path->ray.direction);
    return path->by_water ? sum(light, sun_disc(reference, path->ray.direction)) : light;
}

/* What is opaque and touches a liquid has no air before it. */
static bool touches(const struct path *path, const struct lom_ray_liquid *liquid, double out, double opaque)
{
    return path->liquid != NULL && opaque - out < liquid->gap;
}

static lom_vec3 follow(const struct tracer *tracer, const struct path *path)
{
    const lom_reference *reference = tracer->reference, *met = NULL;
    struct lom_ray_hit hit = { .t = FAR };
    lom_hit_triangles(&reference->opaque, &path->ray, path->low, &hit);
    struct lom_crossing crossing = { .t = hit.t };
    if (path->depth > 0 && path->liquid == NULL)
        met = lom_cross_waters(reference, &path->ray, tracer->time, path->inside, path->low, hit.t, &crossing);
    struct lom_liquid_crossing into = { .t = crossing.t };
    const struct lom_ray_liquid *liquid = NULL;
    if (path->depth > 0)
        liquid = lom_cross_liquid(reference->liquids, &path->ray, path->liquid, path->low, crossing.t, &into);
    lom_vec3 light;
    if (liquid != NULL && !touches(path, liquid, into.t, hit.t))
        light = divide_liquid(tracer, path, liquid, &into);
    else
        light = met != NULL && liquid == NULL ? divide(tracer, path, met, &crossing) : end(tracer, path, &hit);
    if (path->by_water && path->inside == NULL)
        light = sum(light, lamp_discs(reference, &path->ray, into.t));
    return through_layers(tracer, path, into.t, carry(tracer, path, into.t, light));
}

lom_vec3 lom_radiance_along(const lom_reference *reference, struct lom_ray ray, double near_distance, double time,
                            int depth, const lom_reference *inside)
{
    struct tracer tracer = { reference, time };
    struct path path = {
        .ray = { ray.origin, unit(ray.direction) }, .low = near_distance, .depth = depth, .inside = inside
    };
    return follow(&tracer, &path);
}

lom_vec3 lom_trace_ray(const lom_reference *reference, lom_vec3 origin, lom_vec3 direction, double near_distance,
                       double time, int depth)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_vec3 light = lom_radiance_along(reference, (struct lom_ray){ origin, direction }, near_distance, time, depth,
                                        water_at(reference, origin, time));
    lom_leave_float_state(&state);
    return light;
}
