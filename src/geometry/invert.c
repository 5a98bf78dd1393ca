/* The inverse of a 4x4 matrix: Gauss and Jordan with complete pivoting after equilibration (Golub and Van Loan, Matrix
 * Computations, 3.4 and 3.5.2). In: any matrix. Out: its inverse, or false and zeros; never an entry that is not
 * finite. */
#include <lom/geometry.h>

#include <string.h>

/* 2^-floor(log2 value), within 2^-1000..2^1000; 1 for 0. A power of two, so that scaling by it does not round. */
static double reciprocal_power(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int exponent = (int)(bits >> 52 & 2047) - 1023;
    if (value == 0)
        return 1;
    exponent = exponent < -1000 ? -1000 : exponent > 1000 ? 1000 : exponent;
    bits = (uint64_t)(1023 - exponent) << 52;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Scales columns, then rows, so that the largest of each is about 1: a model matrix with tiny or uneven scales is then
 * told from a singular one. False when an entry is not finite. */
static bool equilibrate(double a[4][4], double row_scale[4], double column_scale[4])
{
    for (int j = 0; j < 4; j++) {
        double largest = 0;
        for (int i = 0; i < 4; i++) {
            double size = __builtin_fabs(a[i][j]);
            if (!(size < __builtin_inf()))
                return false;
            largest = size > largest ? size : largest;
        }
        column_scale[j] = reciprocal_power(largest);
        for (int i = 0; i < 4; i++)
            a[i][j] *= column_scale[j];
    }
    for (int i = 0; i < 4; i++) {
        double largest = 0;
        for (int j = 0; j < 4; j++)
            largest = __builtin_fabs(a[i][j]) > largest ? __builtin_fabs(a[i][j]) : largest;
        row_scale[i] = reciprocal_power(largest);
        for (int j = 0; j < 4; j++)
            a[i][j] *= row_scale[i];
    }
    return true;
}

static void swap_rows(double a[4][4], int i, int k)
{
    double row[4];
    memcpy(row, a[i], sizeof row);
    memmove(a[i], a[k], sizeof row);
    memcpy(a[k], row, sizeof row);
}

/* Brings the largest entry of the rows and columns from step on to (step, step); order follows the columns. */
static void bring_pivot(double a[4][4], double b[4][4], int order[4], int step)
{
    int row = step, column = step;
    for (int i = step; i < 4; i++)
        for (int j = step; j < 4; j++)
            if (__builtin_fabs(a[i][j]) > __builtin_fabs(a[row][column])) {
                row = i;
                column = j;
            }
    swap_rows(a, step, row);
    swap_rows(b, step, row);
    for (int i = 0; i < 4; i++) {
        double entry = a[i][step];
        a[i][step] = a[i][column];
        a[i][column] = entry;
    }
    int index = order[step];
    order[step] = order[column];
    order[column] = index;
}

/* Turns a into the identity and b (the identity at first) into its inverse, whose row i belongs to row order[i]. */
static bool eliminate(double a[4][4], double b[4][4], int order[4])
{
    const double rounding = 0x1p-49; /* 8 ulp of entries of about 1: what four steps leave of an exact 0 */
    for (int step = 0; step < 4; step++) {
        bring_pivot(a, b, order, step);
        double pivot = a[step][step];
        if (!(__builtin_fabs(pivot) > rounding))
            return false;
        for (int j = 0; j < 4; j++) {
            a[step][j] /= pivot;
            b[step][j] /= pivot;
        }
        for (int i = 0; i < 4; i++) {
            double factor = a[i][step];
            for (int j = 0; i != step && j < 4; j++) {
                a[i][j] -= factor * a[step][j];
                b[i][j] -= factor * b[step][j];
            }
        }
    }
    return true;
}

static bool invert_general(const lom_mat4 *m, lom_mat4 *inverse)
{
    lom_mat4 a = *m, b = lom_identity();
    double row_scale[4], column_scale[4];
    int order[4] = { 0, 1, 2, 3 };
    if (!equilibrate(a.m, row_scale, column_scale) || !eliminate(a.m, b.m, order))
        return false;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            inverse->m[order[i]][j] = b.m[i][j] * column_scale[order[i]] * row_scale[j];
    return true;
}

static bool all_finite(const lom_mat4 *m)
{
    bool finite = true;
    for (int i = 0; i < 16; i++)
        finite = finite && __builtin_fabs(m->m[i / 4][i % 4]) < __builtin_inf();
    return finite;
}

/* (A t; 0 1) has the inverse (A' -A' t; 0 1): a translation, however large, then takes no part in the elimination. */
bool lom_invert(const lom_mat4 *m, lom_mat4 *inverse)
{
    lom_mat4 linear = *m, result;
    bool affine = m->m[3][0] == 0 && m->m[3][1] == 0 && m->m[3][2] == 0 && m->m[3][3] == 1;
    lom_vec3 offset = { 0, 0, 0 };
    if (affine) {
        offset = (lom_vec3){ m->m[0][3], m->m[1][3], m->m[2][3] };
        linear.m[0][3] = linear.m[1][3] = linear.m[2][3] = 0;
    }
    bool regular = invert_general(&linear, &result);
    if (regular && affine) {
        lom_vec3 back = lom_transform_direction(&result, offset);
        result.m[0][3] = -back.x;
        result.m[1][3] = -back.y;
        result.m[2][3] = -back.z;
    }
    regular = regular && all_finite(&result);
    *inverse = regular ? result : (lom_mat4){ { { 0 } } };
    return regular;
}

bool lom_normal_matrix(const lom_mat4 *model, lom_mat4 *normal)
{
    lom_mat4 linear = *model;
    for (int i = 0; i < 3; i++)
        linear.m[i][3] = linear.m[3][i] = 0;
    linear.m[3][3] = 1;
    bool regular = lom_invert(&linear, &linear);
    *normal = lom_transpose(&linear);
    return regular;
}
