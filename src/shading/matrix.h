/* Matrices and vectors as uniforms, and transformations by them over lanes. */
#ifndef LOM_SHADING_MATRIX_H
#define LOM_SHADING_MATRIX_H

#include <lom/geometry.h>
#include <lom/lanes_mathematics.h>
#include <lom/pipeline.h>

struct lom_matrix_uniform {
    float m[4][4]; /* m[row][column], rounded once from double */
};

static inline struct lom_matrix_uniform lom_round_matrix(const lom_mat4 *m)
{
    struct lom_matrix_uniform u;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            u.m[row][column] = (float)m->m[row][column];
    return u;
}

LOM_INLINE lom_float3 lom_uniform3(const float v[3])
{
    return lom_splat3(v[0], v[1], v[2]);
}

LOM_INLINE lom_float lom_transform_row(const float row[4], lom_float3 p)
{
    return p.x * row[0] + p.y * row[1] + p.z * row[2] + row[3];
}

/* m (p, 1) */
LOM_INLINE lom_float4 lom_transform4(const struct lom_matrix_uniform *m, lom_float3 p)
{
    return (lom_float4){ lom_transform_row(m->m[0], p), lom_transform_row(m->m[1], p), lom_transform_row(m->m[2], p),
                         lom_transform_row(m->m[3], p) };
}

/* The upper three rows of m (p, 1). */
LOM_INLINE lom_float3 lom_transform3(const struct lom_matrix_uniform *m, lom_float3 p)
{
    return (lom_float3){ lom_transform_row(m->m[0], p), lom_transform_row(m->m[1], p), lom_transform_row(m->m[2], p) };
}

/* The upper 3x3 of m times v. */
LOM_INLINE lom_float3 lom_rotate3(const struct lom_matrix_uniform *m, lom_float3 v)
{
    return (lom_float3){ v.x * m->m[0][0] + v.y * m->m[0][1] + v.z * m->m[0][2],
                         v.x * m->m[1][0] + v.y * m->m[1][1] + v.z * m->m[1][2],
                         v.x * m->m[2][0] + v.y * m->m[2][1] + v.z * m->m[2][2] };
}

#endif
