/* A polygon in space: its normal and its triangles. */
#ifndef LOM_GEOMETRY_POLYGON_H
#define LOM_GEOMETRY_POLYGON_H

#include <lom/geometry.h>

enum { LOM_POLYGON_CORNERS = 4096 };

struct lom_polygon {
    int count; /* 3..LOM_POLYGON_CORNERS corners */
    double point[LOM_POLYGON_CORNERS][3];
    /* scratch of lom_polygon_triangulate: corners in the plane, a ring of those left, how far they turn left,
     * and a corner in the triangle of each */
    double x[LOM_POLYGON_CORNERS], y[LOM_POLYGON_CORNERS], turn[LOM_POLYGON_CORNERS];
    int next[LOM_POLYGON_CORNERS], previous[LOM_POLYGON_CORNERS], witness[LOM_POLYGON_CORNERS];
};

/* Twice the area, along the normal; exactly cross(p1 - p0, p2 - p0) for a triangle. */
lom_vec3 lom_polygon_area(const struct lom_polygon *polygon);
/* Writes count - 2 triangles as corner numbers, always that many, turning like the polygon. A strictly convex polygon
 * becomes a fan around corner 0. */
void lom_polygon_triangulate(struct lom_polygon *polygon, uint32_t *triangles);

#endif
