/* Vectors and 4x4 matrices in double. In: numbers. Out: numbers, by + - * / and square root in a fixed order, so that
 * every machine gets the same bits. Column vectors, right-handed, m[row][column]. Compiled for speed. */
#include <lom/geometry.h>

lom_vec3 lom_vec3_add(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.x + b.x, a.y + b.y, a.z + b.z };
}

lom_vec3 lom_vec3_subtract(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.x - b.x, a.y - b.y, a.z - b.z };
}

lom_vec3 lom_vec3_scale(lom_vec3 a, double factor)
{
    return (lom_vec3){ a.x * factor, a.y * factor, a.z * factor };
}

double lom_vec3_dot(lom_vec3 a, lom_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

lom_vec3 lom_vec3_cross(lom_vec3 a, lom_vec3 b)
{
    return (lom_vec3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* A power of two by which a vector is multiplied so that its squares neither overflow nor vanish. */
static double safe_scale(lom_vec3 a)
{
    double x = __builtin_fabs(a.x), y = __builtin_fabs(a.y), z = __builtin_fabs(a.z);
    double largest = x > y ? x : y;
    largest = largest > z ? largest : z;
    if (largest > 0x1p+500)
        return 0x1p-600;
    return largest < 0x1p-400 ? 0x1p+600 : 1;
}

double lom_vec3_length(lom_vec3 a)
{
    double scale = safe_scale(a);
    lom_vec3 b = lom_vec3_scale(a, scale);
    return __builtin_sqrt(lom_vec3_dot(b, b)) / scale;
}

lom_vec3 lom_vec3_normalize(lom_vec3 a)
{
    lom_vec3 b = lom_vec3_scale(a, safe_scale(a));
    double length = __builtin_sqrt(lom_vec3_dot(b, b));
    if (!(length > 0 && length < __builtin_inf()))
        return (lom_vec3){ 0, 0, 0 };
    return (lom_vec3){ b.x / length, b.y / length, b.z / length };
}

lom_mat4 lom_identity(void)
{
    return (lom_mat4){ { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } };
}

lom_mat4 lom_multiply(const lom_mat4 *a, const lom_mat4 *b)
{
    lom_mat4 product;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            product.m[i][j] =
                a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] + a->m[i][2] * b->m[2][j] + a->m[i][3] * b->m[3][j];
    return product;
}

lom_mat4 lom_transpose(const lom_mat4 *m)
{
    lom_mat4 transposed;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            transposed.m[i][j] = m->m[j][i];
    return transposed;
}

lom_mat4 lom_translation(lom_vec3 offset)
{
    return (lom_mat4){ { { 1, 0, 0, offset.x }, { 0, 1, 0, offset.y }, { 0, 0, 1, offset.z }, { 0, 0, 0, 1 } } };
}

lom_mat4 lom_scaling(lom_vec3 factor)
{
    return (lom_mat4){ { { factor.x, 0, 0, 0 }, { 0, factor.y, 0, 0 }, { 0, 0, factor.z, 0 }, { 0, 0, 0, 1 } } };
}

/* Rz Ry Rx multiplied out. */
lom_mat4 lom_rotation(lom_vec3 radians)
{
    double sx = lom_double_sin(radians.x), cx = lom_double_cos(radians.x);
    double sy = lom_double_sin(radians.y), cy = lom_double_cos(radians.y);
    double sz = lom_double_sin(radians.z), cz = lom_double_cos(radians.z);
    return (lom_mat4){ { { cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx, 0 },
                         { sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx, 0 },
                         { -sy, cy * sx, cy * cx, 0 },
                         { 0, 0, 0, 1 } } };
}

lom_mat4 lom_model_matrix(lom_vec3 offset, lom_vec3 radians, lom_vec3 factor)
{
    lom_mat4 model = lom_rotation(radians);
    for (int i = 0; i < 3; i++) {
        model.m[i][0] *= factor.x;
        model.m[i][1] *= factor.y;
        model.m[i][2] *= factor.z;
    }
    model.m[0][3] = offset.x;
    model.m[1][3] = offset.y;
    model.m[2][3] = offset.z;
    return model;
}

/* p - 2 (n.p - d) n */
lom_mat4 lom_mirror(lom_vec3 normal, double distance)
{
    double n[3] = { normal.x, normal.y, normal.z };
    lom_mat4 mirror = lom_identity();
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            mirror.m[i][j] -= 2 * n[i] * n[j];
        mirror.m[i][3] = 2 * distance * n[i];
    }
    return mirror;
}

lom_vec3 lom_transform_direction(const lom_mat4 *m, lom_vec3 v)
{
    return (lom_vec3){ m->m[0][0] * v.x + m->m[0][1] * v.y + m->m[0][2] * v.z,
                       m->m[1][0] * v.x + m->m[1][1] * v.y + m->m[1][2] * v.z,
                       m->m[2][0] * v.x + m->m[2][1] * v.y + m->m[2][2] * v.z };
}

lom_vec3 lom_transform_point(const lom_mat4 *m, lom_vec3 p)
{
    return lom_vec3_add(lom_transform_direction(m, p), (lom_vec3){ m->m[0][3], m->m[1][3], m->m[2][3] });
}

void lom_transform_clip(const lom_mat4 *m, lom_vec3 p, double clip[4])
{
    for (int i = 0; i < 4; i++)
        clip[i] = m->m[i][0] * p.x + m->m[i][1] * p.y + m->m[i][2] * p.z + m->m[i][3];
}

lom_matrix_uniform lom_round_matrix(const lom_mat4 *m)
{
    lom_matrix_uniform rounded;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            rounded.m[row][column] = (float)m->m[row][column];
    return rounded;
}
