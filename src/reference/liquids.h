/* Liquids of particles for rays: their surfaces at a frame's time, as triangles. */
#ifndef LOM_REFERENCE_LIQUIDS_H
#define LOM_REFERENCE_LIQUIDS_H

#include "reference/reference.h"

struct lom_ray_liquid {
    const lom_fluid_params *params;
    lom_vec3 *points, *normals; /* of the corners: normals of unit length, outwards */
    struct lom_ray_triangle *triangles;
    struct lom_ray_triangles front, back; /* as they are hit from outside and from inside; count 0: there is none */
    struct lom_ray_material material;     /* of what its matter sends back */
    double gap;                           /* metres: what is opaque and nearer behind its surface touches it */
};

struct lom_ray_liquids {
    struct lom_ray_liquid items[LOM_MAX_FLUIDS];
    size_t count;
};

/* Runs the scene's liquids to a time. What has been made is freed with lom_free_ray_liquids, also after a failure. */
bool lom_make_ray_liquids(struct lom_ray_liquids *liquids, const lom_reference *reference, double time, int threads,
                          lom_error *error);
void lom_free_ray_liquids(struct lom_ray_liquids *liquids);

/* Where a ray comes through a surface: into a liquid or, from inside one, out of it. */
struct lom_liquid_crossing {
    double t;
    lom_vec3 place, normal, facet; /* outwards; the normal is the interpolated one, turned to face the ray's side */
};
/* The nearest at low < t < high of those that lead into a liquid, or out of the one that it is in; NULL: none. */
const struct lom_ray_liquid *lom_cross_liquid(const struct lom_ray_liquids *liquids, const struct lom_ray *ray,
                                              const struct lom_ray_liquid *inside, double low, double high,
                                              struct lom_liquid_crossing *crossing);

#endif
