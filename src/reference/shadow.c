/* Shadows. In: a place, the way to a light. Out: whether an opaque triangle stands on it; what is transparent throws no
 * shadow. */
#include "base/numbers.h"
#include "reference/reference.h"

/* What throws it. */
struct casters {
    bool ground, entities;
};

/* Whether one of them is hit from this side at low < t < high. */
static bool is_blocked(const lom_reference *reference, const struct lom_ray *ray, struct casters casters,
                       bool inside_out, double low, double high)
{
    struct lom_ray_triangles set = reference->opaque;
    struct lom_ray_hit hit = { .t = high };
    set.inside_out = inside_out;
    while (lom_hit_triangles(&set, ray, low, &hit)) {
        if (set.triangles[hit.triangle].material == LOM_TERRAIN_MATERIAL ? casters.ground : casters.entities)
            return true;
        low = hit.t;
        hit.t = high;
    }
    return false;
}

static bool is_open(const lom_reference *reference, const struct lom_ray *ray, struct casters casters, double high)
{
    /* past the triangle that it starts on, by more than places are rounded */
    const double from = lom_double_sqrt(dot(ray->origin, ray->origin));
    double low = 1e-6 * (1 + lom_smaller(from, 4096)) + 0x1p-46 * from;
    return !is_blocked(reference, ray, casters, false, low, high) &&
           !is_blocked(reference, ray, casters, true, low, high);
}

bool lom_sun_is_open(const lom_reference *reference, lom_vec3 place, double depth, lom_vec3 to_light)
{
    const lom_quality *quality = &reference->scene->quality;
    const struct casters casters = { quality->terrain_shadows, quality->entity_shadows > 0 };
    struct lom_ray ray = { place, to_light };
    if (!casters.ground && !casters.entities)
        return true;
    if (depth > 0) {
        double length = depth / to_light.y;
        if (!is_open(reference, &ray, casters, length))
            return false;
        ray = (struct lom_ray){ along(place, to_light, length), reference->to_light };
    }
    return is_open(reference, &ray, casters, 1e300);
}

double lom_ground_leaves_sun(const lom_reference *reference, lom_vec3 place)
{
    static const struct casters ground = { true, false };
    if (!reference->scene->quality.terrain_shadows || !(reference->to_light.y > 0))
        return 1;
    return is_open(reference, &(struct lom_ray){ place, reference->to_light }, ground, 1e300) ? 1 : 0;
}

bool lom_lamp_is_open(const lom_reference *reference, const struct lom_placed_lamp *lamp, lom_vec3 place,
                      lom_vec3 to_lamp, double distance)
{
    static const struct casters all = { true, true };
    if (!lamp->lamp->shadow || reference->scene->quality.lamp_shadows == 0)
        return true;
    const double clearance = lom_lamp_clearance(lamp, scaled(to_lamp, -1));
    return is_open(reference, &(struct lom_ray){ place, to_lamp }, all, distance - clearance);
}
