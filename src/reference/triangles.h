/* Rays against triangles, in double: a bounding volume hierarchy and the watertight test at its leaves. */
#ifndef LOM_REFERENCE_TRIANGLES_H
#define LOM_REFERENCE_TRIANGLES_H

#include "reference/vectors.h"

struct lom_ray_triangle {
    uint32_t corner[3]; /* counter-clockwise from the front */
    uint32_t material;
};

struct lom_ray_node {
    double low[3], high[3];
    uint32_t first, count; /* count > 0: that many entries of order, from first; 0: children first and first + 1 */
    int32_t axis;          /* along which the children were divided: the first child is the lower one */
    int32_t depth;         /* of nodes above it */
};

/* What rays are traced against. The arrays of points and triangles belong to the caller. */
struct lom_ray_triangles {
    const lom_vec3 *points;
    const struct lom_ray_triangle *triangles;
    uint32_t count;
    bool inside_out; /* the back sides are hit instead of the front sides */
    uint32_t *order; /* of the triangles, leaf after leaf */
    struct lom_ray_node *nodes;
    uint32_t node_count;
};

/* Points on the ray are origin + t direction. */
struct lom_ray {
    lom_vec3 origin, direction;
};

struct lom_ray_hit {
    double t;
    uint32_t triangle;
    double weight[3]; /* barycentric coordinates of the corners; their sum is 1 within rounding */
};

/* Builds nodes and order over set->triangles: binned surface area heuristic (I. Wald, On fast Construction of SAH-based
 * Bounding Volume Hierarchies, RT 2007). The result depends on nothing but the triangles. */
bool lom_build_ray_triangles(struct lom_ray_triangles *set, lom_error *error);
void lom_free_ray_triangles(struct lom_ray_triangles *set);

/* The front side (or the back side, inside_out) of one triangle. Inclusive on its edges, with edge functions that are
 * exact negatives of one another for two triangles that share an edge: no ray passes between them (S. Woop, C. Benthin,
 * I. Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013). */
bool lom_hit_triangle(const struct lom_ray_triangles *set, const struct lom_ray *ray, uint32_t triangle,
                      struct lom_ray_hit *hit);

/* The nearest such side with low < t < hit->t, the lowest index of equally near ones; false, and *hit as it was, when
 * there is none. */
bool lom_hit_triangles(const struct lom_ray_triangles *set, const struct lom_ray *ray, double low,
                       struct lom_ray_hit *hit);

#endif
