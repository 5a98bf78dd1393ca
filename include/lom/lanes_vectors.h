/* lom/lanes_vectors.h - vectors of three and four lanes, and matrices that are the same in every lane: what follows from
 * the operations of lom/lanes.h, which includes this. */
#ifndef LOM_LANES_VECTORS_H
#define LOM_LANES_VECTORS_H

#include <lom/lanes.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/* ---- three components ---- */

LOM_INLINE lom_float3 lom_splat3(float x, float y, float z)
{
    lom_float3 v = { lom_splat(x), lom_splat(y), lom_splat(z) };
    return v;
}

LOM_INLINE lom_float3 lom_add3(lom_float3 a, lom_float3 b)
{
    lom_float3 sum = { a.x + b.x, a.y + b.y, a.z + b.z };
    return sum;
}

LOM_INLINE lom_float3 lom_sub3(lom_float3 a, lom_float3 b)
{
    lom_float3 difference = { a.x - b.x, a.y - b.y, a.z - b.z };
    return difference;
}

LOM_INLINE lom_float3 lom_mul3(lom_float3 a, lom_float3 b)
{
    lom_float3 product = { a.x * b.x, a.y * b.y, a.z * b.z };
    return product;
}

LOM_INLINE lom_float3 lom_scale3(lom_float3 a, lom_float factor)
{
    lom_float3 scaled = { a.x * factor, a.y * factor, a.z * factor };
    return scaled;
}

LOM_INLINE lom_float3 lom_mix3(lom_float3 a, lom_float3 b, lom_float t)
{
    lom_float3 mixed = { lom_mix(a.x, b.x, t), lom_mix(a.y, b.y, t), lom_mix(a.z, b.z, t) };
    return mixed;
}

/* (a.x b.x + a.y b.y) + a.z b.z */
LOM_INLINE lom_float lom_dot3(lom_float3 a, lom_float3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

LOM_INLINE lom_float3 lom_cross3(lom_float3 a, lom_float3 b)
{
    lom_float3 cross = { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
    return cross;
}

/* a / |a|; zero (and what underflows in the square) stays zero. */
LOM_INLINE lom_float3 lom_normalize3(lom_float3 a)
{
    lom_float square = lom_dot3(a, a);
    lom_float inverse = lom_select(square > 0.0f, 1.0f / lom_sqrt(square), lom_splat(0.0f));
    return lom_scale3(a, inverse);
}

/* incident - 2 (n . incident) n, n of unit length */
LOM_INLINE lom_float3 lom_reflect3(lom_float3 incident, lom_float3 n)
{
    return lom_sub3(incident, lom_scale3(n, 2.0f * lom_dot3(n, incident)));
}

/* The squared cosine of the refracted ray, by Snell's law 1 - eta^2 (1 - c^2). Written so that it is c^2 for eta = 1,
 * and its root then c: light passes straight, to the bit. */
LOM_INLINE lom_float lom_refracted_square(lom_float cosine, lom_float eta)
{
    return (1.0f - eta) * (1.0f + eta) + (eta * cosine) * (eta * cosine);
}

/* What goes on of a ray of light through a surface (Snell's law): d and n of unit length, eta the index of refraction of
 * the side that n points to over the other's; d may come from either side. refracted: eta d + (eta c - t) n, c the cosine
 * to the normal and t that behind. The mask is clear where all light is reflected (then refracted is d). A normal of
 * length zero bends nothing, and eta = 1 leaves d as it is, to the bit. */
LOM_INLINE lom_mask lom_refract3(lom_float3 d, lom_float3 n, lom_float eta, lom_float3 *refracted)
{
    lom_float cosine = -lom_dot3(d, n);
    lom_mask behind = cosine < 0.0f, no_normal = lom_dot3(n, n) == 0.0f;
    lom_float ratio = lom_select(behind, 1.0f / eta, eta);
    lom_float c = lom_abs(cosine), square = lom_refracted_square(c, ratio);
    lom_mask passes = (square >= 0.0f) & ~no_normal;
    lom_float t = lom_sqrt(lom_select(passes, square, lom_splat(0.0f)));
    lom_float along = lom_select(passes, ratio, lom_splat(1.0f));
    lom_float across = lom_select(passes, ratio * c - t, lom_splat(0.0f));
    across = lom_select(behind, -across, across);
    *refracted = lom_add3(lom_scale3(d, along), lom_scale3(n, across));
    return passes | no_normal;
}

/* ---- matrices that are the same in every lane ---- */

/* As uniforms hold it: m[row][column], for column vectors; lom_round_matrix of lom/geometry.h makes it of a lom_mat4.
 */
typedef struct lom_matrix_uniform {
    float m[4][4];
} lom_matrix_uniform;

/* row (p, 1): ((p.x row[0] + p.y row[1]) + p.z row[2]) + row[3] */
LOM_INLINE lom_float lom_transform_row(const float row[4], lom_float3 p)
{
    return p.x * row[0] + p.y * row[1] + p.z * row[2] + row[3];
}

/* m (p, 1): a place, for example to clip space. */
LOM_INLINE lom_float4 lom_transform4(const lom_matrix_uniform *m, lom_float3 p)
{
    lom_float4 q = { lom_transform_row(m->m[0], p), lom_transform_row(m->m[1], p), lom_transform_row(m->m[2], p),
                     lom_transform_row(m->m[3], p) };
    return q;
}

/* m (v, 0): how m (p, 1) changes when p moves by v. */
LOM_INLINE lom_float4 lom_turn4(const lom_matrix_uniform *m, lom_float3 v)
{
    lom_float4 q = { v.x * m->m[0][0] + v.y * m->m[0][1] + v.z * m->m[0][2],
                     v.x * m->m[1][0] + v.y * m->m[1][1] + v.z * m->m[1][2],
                     v.x * m->m[2][0] + v.y * m->m[2][1] + v.z * m->m[2][2],
                     v.x * m->m[3][0] + v.y * m->m[3][1] + v.z * m->m[3][2] };
    return q;
}

/* The upper three rows of m (p, 1): a place, m affine. */
LOM_INLINE lom_float3 lom_transform3(const lom_matrix_uniform *m, lom_float3 p)
{
    lom_float3 q = { lom_transform_row(m->m[0], p), lom_transform_row(m->m[1], p), lom_transform_row(m->m[2], p) };
    return q;
}

/* The upper 3x3 of m times v: a direction. */
LOM_INLINE lom_float3 lom_rotate3(const lom_matrix_uniform *m, lom_float3 v)
{
    lom_float3 q = { v.x * m->m[0][0] + v.y * m->m[0][1] + v.z * m->m[0][2],
                     v.x * m->m[1][0] + v.y * m->m[1][1] + v.z * m->m[1][2],
                     v.x * m->m[2][0] + v.y * m->m[2][1] + v.z * m->m[2][2] };
    return q;
}

/* row v: ((v.x row[0] + v.y row[1]) + v.z row[2]) + v.w row[3] */
LOM_INLINE lom_float lom_dot_row4(const float row[4], lom_float4 v)
{
    return v.x * row[0] + v.y * row[1] + v.z * row[2] + v.w * row[3];
}

/* m v */
LOM_INLINE lom_float4 lom_multiply4(const lom_matrix_uniform *m, lom_float4 v)
{
    lom_float4 product = { lom_dot_row4(m->m[0], v), lom_dot_row4(m->m[1], v), lom_dot_row4(m->m[2], v),
                           lom_dot_row4(m->m[3], v) };
    return product;
}

#pragma GCC diagnostic pop

#endif
