/* Vectors in double, inline: what every ray does many times. Plain formulas, for magnitudes of scenes (1e-100 to
 * 1e100).
 */
#ifndef LOM_REFERENCE_VECTORS_H
#define LOM_REFERENCE_VECTORS_H

#include <lom/geometry.h>

static inline lom_vec3 vector(const double v[3])
{
    return (lom_vec3){ v[0], v[1], v[2] };
}

static inline lom_vec3 sum(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline lom_vec3 difference(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline lom_vec3 scaled(lom_vec3 a, double factor)
{
    return (lom_vec3){ a.x * factor, a.y * factor, a.z * factor };
}

/* a + b t */
static inline lom_vec3 along(lom_vec3 a, lom_vec3 b, double t)
{
    return (lom_vec3){ a.x + b.x * t, a.y + b.y * t, a.z + b.z * t };
}

/* Component by component. */
static inline lom_vec3 product(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.x * b.x, a.y * b.y, a.z * b.z };
}

static inline double dot(lom_vec3 a, lom_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline lom_vec3 cross(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static inline double length(lom_vec3 a)
{
    return lom_double_sqrt(dot(a, a));
}

/* Unit length; the zero vector stays what it is. */
static inline lom_vec3 unit(lom_vec3 a)
{
    double size = length(a);
    return size > 0 ? scaled(a, 1 / size) : a;
}

/* a0 b[0] + a1 b[1] + a2 b[2]: a value at the corners of a triangle, at barycentric coordinates. */
static inline lom_vec3 blended(lom_vec3 a0, lom_vec3 a1, lom_vec3 a2, const double b[3])
{
    return (lom_vec3){ a0.x * b[0] + a1.x * b[1] + a2.x * b[2], a0.y * b[0] + a1.y * b[1] + a2.y * b[2],
                       a0.z * b[0] + a1.z * b[1] + a2.z * b[2] };
}

/* x clamped to [0, 1]; 0 for NaN. */
static inline double unit_interval(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

#endif
