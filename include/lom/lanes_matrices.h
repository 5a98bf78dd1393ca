/* lom/lanes_matrices.h - for users' shaders: square matrices of 2 to 4 that differ from lane to lane, m[row][column], for
 * column vectors. Those that are the same in every lane are in lom/lanes_vectors.h. */
#ifndef LOM_LANES_MATRICES_H
#define LOM_LANES_MATRICES_H

#include <lom/lanes_vectors.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

typedef struct lom_float2x2 {
    lom_float m[2][2];
} lom_float2x2;
typedef struct lom_float3x3 {
    lom_float m[3][3];
} lom_float3x3;
typedef struct lom_float4x4 {
    lom_float m[4][4];
} lom_float4x4;

/* A uniform's matrix in every lane. */
LOM_INLINE lom_float4x4 lom_splat4x4(const lom_matrix_uniform *m)
{
    lom_float4x4 out;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = lom_splat(m->m[i][j]);
    return out;
}

/* Of the n x n elements at a and b, row by row; n is a constant. Products are summed from the left to the right. */
LOM_INLINE void lom_multiply_square(int n, const lom_float *a, const lom_float *b, lom_float *out)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            lom_float sum = a[i * n] * b[j];
            for (int k = 1; k < n; k++)
                sum = sum + a[i * n + k] * b[k * n + j];
            out[i * n + j] = sum;
        }
}

LOM_INLINE void lom_transpose_square(int n, const lom_float *a, lom_float *out)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            out[j * n + i] = a[i * n + j];
}

/* The elements of out, an adjugate, over a determinant; zeros where that is 0 or NaN. */
LOM_INLINE void lom_divide_square(int n, lom_float determinant, lom_float *out)
{
    lom_mask regular = lom_abs(determinant) > 0.0f;
    for (int i = 0; i < n * n; i++)
        out[i] = lom_select(regular, out[i] / determinant, lom_splat(0.0f));
}

/* a b, m v, and the rows as columns. */
LOM_INLINE lom_float2x2 lom_multiply2x2(const lom_float2x2 *a, const lom_float2x2 *b)
{
    lom_float2x2 out;
    lom_multiply_square(2, a->m[0], b->m[0], out.m[0]);
    return out;
}

LOM_INLINE lom_float2 lom_apply2x2(const lom_float2x2 *m, lom_float2 v)
{
    lom_float2 out = { m->m[0][0] * v.x + m->m[0][1] * v.y, m->m[1][0] * v.x + m->m[1][1] * v.y };
    return out;
}

LOM_INLINE lom_float2x2 lom_transpose2x2(const lom_float2x2 *a)
{
    lom_float2x2 out;
    lom_transpose_square(2, a->m[0], out.m[0]);
    return out;
}

/* a b, m v, and the rows as columns. */
LOM_INLINE lom_float3x3 lom_multiply3x3(const lom_float3x3 *a, const lom_float3x3 *b)
{
    lom_float3x3 out;
    lom_multiply_square(3, a->m[0], b->m[0], out.m[0]);
    return out;
}

LOM_INLINE lom_float3 lom_apply3x3(const lom_float3x3 *m, lom_float3 v)
{
    lom_float3 out = { m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z,
                       m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z,
                       m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z };
    return out;
}

LOM_INLINE lom_float3x3 lom_transpose3x3(const lom_float3x3 *a)
{
    lom_float3x3 out;
    lom_transpose_square(3, a->m[0], out.m[0]);
    return out;
}

/* a b, m v, and the rows as columns. */
LOM_INLINE lom_float4x4 lom_multiply4x4(const lom_float4x4 *a, const lom_float4x4 *b)
{
    lom_float4x4 out;
    lom_multiply_square(4, a->m[0], b->m[0], out.m[0]);
    return out;
}

LOM_INLINE lom_float4 lom_apply4x4(const lom_float4x4 *m, lom_float4 v)
{
    lom_float4 out = { m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z + m->m[0][3] * v.w,
                       m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z + m->m[1][3] * v.w,
                       m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z + m->m[2][3] * v.w,
                       m->m[3][0] * v.x + m->m[3][1] * v.y + m->m[3][2] * v.z + m->m[3][3] * v.w };
    return out;
}

LOM_INLINE lom_float4x4 lom_transpose4x4(const lom_float4x4 *a)
{
    lom_float4x4 out;
    lom_transpose_square(4, a->m[0], out.m[0]);
    return out;
}

/* Determinants, and inverses: the adjugate over the determinant, zeros where that is 0 or NaN. */
LOM_INLINE lom_float lom_determinant2x2(const lom_float2x2 *a)
{
    return a->m[0][0] * a->m[1][1] - a->m[0][1] * a->m[1][0];
}

LOM_INLINE lom_float2x2 lom_inverse2x2(const lom_float2x2 *a)
{
    lom_float2x2 out;
    out.m[0][0] = a->m[1][1];
    out.m[0][1] = -a->m[0][1];
    out.m[1][0] = -a->m[1][0];
    out.m[1][1] = a->m[0][0];
    lom_divide_square(2, lom_determinant2x2(a), out.m[0]);
    return out;
}

/* Element (row, column) of the adjugate: the cofactor of (column, row). */
LOM_INLINE lom_float lom_adjugate3x3(const lom_float3x3 *a, int row, int column)
{
    int i = (column + 1) % 3, j = (column + 2) % 3, k = (row + 1) % 3, l = (row + 2) % 3;
    return a->m[i][k] * a->m[j][l] - a->m[i][l] * a->m[j][k];
}

LOM_INLINE lom_float lom_determinant3x3(const lom_float3x3 *a)
{
    return a->m[0][0] * lom_adjugate3x3(a, 0, 0) + a->m[0][1] * lom_adjugate3x3(a, 1, 0) +
           a->m[0][2] * lom_adjugate3x3(a, 2, 0);
}

LOM_INLINE lom_float3x3 lom_inverse3x3(const lom_float3x3 *a)
{
    lom_float3x3 out;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out.m[i][j] = lom_adjugate3x3(a, i, j);
    lom_divide_square(3, lom_determinant3x3(a), out.m[0]);
    return out;
}

/* The cofactor of (row, column): the determinant of what is left without them, with its sign. */
LOM_INLINE lom_float lom_cofactor4x4(const lom_float4x4 *a, int row, int column)
{
    lom_float3x3 left;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            left.m[i][j] = a->m[i + (i >= row)][j + (j >= column)];
    lom_float minor = lom_determinant3x3(&left);
    return (row + column) % 2 == 0 ? minor : -minor;
}

LOM_INLINE lom_float lom_determinant4x4(const lom_float4x4 *a)
{
    return a->m[0][0] * lom_cofactor4x4(a, 0, 0) + a->m[0][1] * lom_cofactor4x4(a, 0, 1) +
           a->m[0][2] * lom_cofactor4x4(a, 0, 2) + a->m[0][3] * lom_cofactor4x4(a, 0, 3);
}

LOM_INLINE lom_float4x4 lom_inverse4x4(const lom_float4x4 *a)
{
    lom_float4x4 out;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            out.m[i][j] = lom_cofactor4x4(a, j, i);
    lom_divide_square(4, lom_determinant4x4(a), out.m[0]);
    return out;
}

#pragma GCC diagnostic pop

#endif
