/* Rays through the scene. In: a loaded scene and a ray. Out: the radiance that comes back along it: that of the nearest
 * opaque surface or of the sky, and at each crossing of the water the reflected and the refracted share of both ways.
 *
 * Radiance is not divided by the squared index where it leaves the water, nor is what the ground below sends up thrown
 * back down again by the surface: in uniform light over white ground without absorption the two cancel, and each
 * without the other would be wrong by that much. */
#include "reference/world.h"

struct path {
    struct lom_ray ray; /* of unit direction */
    double low;         /* nothing nearer than this is seen */
    int depth;          /* crossings of water that may follow */
    bool in_water;
    bool by_water; /* it has met the water before, so it sees the sun's disc as well */
};

struct tracer {
    const lom_reference *world;
    double time;
};

static const double FAR = 1e300;

static lom_vec3 follow(const struct tracer *tracer, const struct path *path);

/* Beer and Lambert: light exp(-a t) + color (1 - exp(-a t)), what is lost replaced by the glow of endless depths. */
static lom_vec3 absorb(const lom_reference_water *water, lom_vec3 light, double t)
{
    double *channel[3] = { &light.x, &light.y, &light.z };
    for (int i = 0; i < 3; i++) {
        double thickness = water->absorption[i] * t;
        *channel[i] = *channel[i] * lom_double_exp(-thickness) - water->color[i] * lom_double_expm1(-thickness);
    }
    return light;
}

/* What a directional light of radiance `light` on a white diffuse surface looks like as a disc of this radius: with
 * irradiance pi light, pi light / (pi sin^2 radius). */
static lom_vec3 sun_disc(const lom_reference *world, lom_vec3 direction)
{
    double radius = world->scene->quality.reference.sun, sine = lom_double_sin(radius);
    if (dot(direction, world->to_light) < lom_double_cos(radius))
        return (lom_vec3){ 0, 0, 0 };
    return scaled(world->light, 1 / (sine * sine));
}

/* The ways that a path goes on after the water's surface at t. A facet of the normal map that is turned away from the
 * ray stands for a wave that hides it: it reflects all, like the plane. What a facet would send through the surface the
 * wrong way is mirrored back at the plane. */
static lom_vec3 divide(const struct tracer *tracer, const struct path *path, double t)
{
    const lom_reference_water *water = &tracer->world->water;
    double side = path->in_water ? -1 : 1, index = path->in_water ? 1 / water->index : water->index;
    lom_vec3 place = along(path->ray.origin, path->ray.direction, t), d = path->ray.direction;
    lom_vec3 normal = scaled(lom_water_normal(tracer->world, place, tracer->time), side);
    struct path next = *path;
    double height =
        water->height == NULL ? water->lowest : water->height(water->context, place.x, place.z, tracer->time);
    double margin = water->height == NULL ? 0 : 1e-9 * side;
    next.low = 0;
    next.depth--;
    next.by_water = true;
    next.ray.origin = (lom_vec3){ place.x, height + margin, place.z };
    double cosine = -dot(d, normal), share = cosine > 0 ? lom_reference_fresnel(cosine, index) : 1;
    next.ray.direction = cosine > 0 ? lom_reference_mirror(d, normal) : (lom_vec3){ d.x, -d.y, d.z };
    if (water->height == NULL && next.ray.direction.y * side < 0)
        next.ray.direction.y = -next.ray.direction.y;
    lom_vec3 light = { 0, 0, 0 };
    if (share > 0)
        light = scaled(follow(tracer, &next), share);
    if (share < 1 && lom_reference_refract(d, normal, index, &next.ray.direction)) {
        if (water->height == NULL && next.ray.direction.y * side > 0)
            next.ray.direction.y = -next.ray.direction.y;
        next.ray.origin.y = height - margin;
        next.in_water = !path->in_water;
        light = along(light, follow(tracer, &next), 1 - share);
    }
    return light;
}

static lom_vec3 follow(const struct tracer *tracer, const struct path *path)
{
    const lom_reference *world = tracer->world;
    struct lom_ray_hit hit = { .t = FAR };
    bool opaque = lom_hit_triangles(&world->opaque, &path->ray, path->low, &hit);
    double length = hit.t;
    lom_vec3 light;
    if (path->depth > 0 && lom_hit_water(world, &path->ray, tracer->time, path->low, hit.t, &length)) {
        light = divide(tracer, path, length);
    } else if (opaque) {
        light = lom_shade_hit(world, &path->ray, &hit, tracer->time);
    } else {
        light = lom_sky_light(world, path->ray.direction);
        if (path->by_water)
            light = sum(light, sun_disc(world, path->ray.direction));
    }
    return path->in_water ? absorb(&world->water, light, length) : light;
}

lom_vec3 lom_radiance_along(const lom_reference *world, struct lom_ray ray, double near_distance, double time,
                            int depth)
{
    struct tracer tracer = { world, time };
    struct path path = { .ray = { ray.origin, unit(ray.direction) },
                         .low = near_distance,
                         .depth = depth,
                         .in_water = lom_water_above(world, ray.origin, time) > 0 };
    return follow(&tracer, &path);
}

lom_vec3 lom_trace_ray(const lom_reference *reference, lom_vec3 origin, lom_vec3 direction, double near_distance,
                       double time, int depth)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_vec3 light = lom_radiance_along(reference, (struct lom_ray){ origin, direction }, near_distance, time, depth);
    lom_leave_float_state(&state);
    return light;
}
