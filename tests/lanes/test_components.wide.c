/* Vectors by component, matrices of lanes, refraction. Oracles: the same in scalars a component and lane at a time;
 * integers, in which matrices of small whole numbers are exact: Leibniz's sum over permutations for determinants, minors
 * of it for inverses; Snell's law. Proves: every component and lane is that of its scalars; products, determinants and
 * inverses are exact where floats are; a singular matrix has an inverse of zeros; angles before and behind a surface
 * agree, and reflection is total where Snell's law has no solution. */
#include <lom/lom.h>

#include "check.h"

#include <math.h>

static lom_float some(uint64_t key, float step)
{
    lom_float x = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        x[i] = (float)((int)(lom_random_bits(key, (uint64_t)i) % 17) - 8) * step;
    return x;
}

static bool same(lom_float a, lom_float b)
{
    return lom_all(a == b);
}

#define SAME_INT(a, b) CHECK(lom_all((a) == (b)), "trial %d", (int)trial)

static void components(void)
{
    for (uint64_t trial = 0; trial < 50; trial++) {
        uint64_t k = trial * 16;
        lom_float4 a = { some(k, 0.5f), some(k + 1, 0.5f), some(k + 2, 0.5f), some(k + 3, 0.5f) };
        lom_float4 b = { some(k + 4, 0.5f), some(k + 5, 0.5f), some(k + 6, 0.5f), some(k + 7, 0.5f) };
        lom_float3 a3 = { a.x, a.y, a.z }, b3 = { b.x, b.y, b.z };
        lom_float2 a2 = { a.x, a.y }, b2 = { b.x, b.y };
        CHECK(same(lom_dot2(a2, b2), a.x * b.x + a.y * b.y) &&
                  same(lom_dot4(a, b), a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w),
              "dot");
        CHECK(same(lom_add4(a, b).w, a.w + b.w) && same(lom_sub4(a, b).w, a.w - b.w) &&
                  same(lom_mul4(a, b).z, a.z * b.z) && same(lom_scale4(a, b.x).w, a.w * b.x) &&
                  same(lom_mix4(a, b, b.x).y, lom_mix(a.y, b.y, b.x)),
              "four");
        CHECK(same(lom_add2(a2, b2).y, a.y + b.y) && same(lom_sub2(a2, b2).y, a.y - b.y) &&
                  same(lom_mul2(a2, b2).x, a.x * b.x) && same(lom_scale2(a2, b.x).y, a.y * b.x) &&
                  same(lom_mix2(a2, b2, b.x).y, lom_mix(a.y, b.y, b.x)),
              "two");
        lom_int4 p = lom_to_int4(a), q = lom_to_int4(b);
        lom_int3 p3 = lom_to_int3(a3), q3 = lom_to_int3(b3);
        lom_int2 p2 = lom_to_int2(a2), q2 = lom_to_int2(b2);
        SAME_INT(p.w, lom_to_int(a.w));
        SAME_INT(p3.z, p.z);
        SAME_INT(p2.y, p.y);
        CHECK(same(lom_to_float4(p).w, lom_to_float(p.w)) && same(lom_to_float3(p3).z, lom_to_float(p.z)) &&
                  same(lom_to_float2(p2).y, lom_to_float(p.y)),
              "to float");
        SAME_INT(lom_add_int4(p, q).w, p.w + q.w);
        SAME_INT(lom_sub_int3(p3, q3).z, p.z - q.z);
        SAME_INT(lom_mul_int2(p2, q2).y, p.y * q.y);
        SAME_INT(lom_min_int4(p, q).x, lom_min_int(p.x, q.x));
        SAME_INT(lom_max_int3(p3, q3).y, lom_max_int(p.y, q.y));
        lom_mask4 less = lom_less4(a, b), equal = lom_equal4(a, b), most = lom_less_equal4(a, b);
        SAME_INT(less.w, a.w < b.w);
        SAME_INT(equal.z, a.z == b.z);
        SAME_INT(lom_or4(less, equal).y, most.y);
        SAME_INT(lom_and4(less, equal).x, lom_splat_int(0));
        SAME_INT(lom_not4(less).x, a.x >= b.x);
        SAME_INT(lom_less3(a3, b3).z, a.z < b.z);
        SAME_INT(lom_less_equal2(a2, b2).x, a.x <= b.x);
        SAME_INT(lom_less_int4(p, q).w, p.w < q.w);
        SAME_INT(lom_equal_int3(p3, q3).z, p.z == q.z);
        SAME_INT(lom_any_of4(less), (a.x < b.x) | (a.y < b.y) | (a.z < b.z) | (a.w < b.w));
        SAME_INT(lom_all_of4(less), (a.x < b.x) & (a.y < b.y) & (a.z < b.z) & (a.w < b.w));
        SAME_INT(lom_any_of3(lom_less3(a3, b3)), (a.x < b.x) | (a.y < b.y) | (a.z < b.z));
        SAME_INT(lom_all_of2(lom_less2(a2, b2)), (a.x < b.x) & (a.y < b.y));
        CHECK(same(lom_select4(less, a, b).w, lom_select(less.w, a.w, b.w)) &&
                  same(lom_min4(a, b).y, lom_min(a.y, b.y)) && same(lom_max3(a3, b3).z, lom_max(a.z, b.z)) &&
                  same(lom_min2(a2, b2).y, lom_min(a.y, b.y)),
              "select");
        SAME_INT(lom_select_int4(less, p, q).z, lom_select_int(less.z, p.z, q.z));
    }
    lom_int3 numbers = lom_splat_int3(1, -2, INT32_MIN);
    CHECK(numbers.y[LOM_LANES - 1] == -2 && lom_sub_int3(numbers, lom_splat_int3(0, 0, 1)).z[0] == INT32_MAX, "splat");
    CHECK(lom_splat4(1, 2, 3, 4).w[0] == 4 && lom_splat2(1, 2).y[0] == 2 && lom_splat_int4(1, 2, 3, 4).w[0] == 4 &&
              lom_splat_int2(1, 2).y[0] == 2,
          "splat");
}

/* ---- matrices ---- */

/* Leibniz: the sum over all permutations of rows, of n x n whole numbers in rows of 4. */
static int64_t leibniz(int n, int64_t m[4][4])
{
    int64_t sum = 0;
    for (int code = 0; code < 256; code++) {
        int to[4] = { code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 }, seen = 0, swaps = 0;
        bool beyond = false;
        int64_t product = 1;
        for (int i = 0; i < n; i++) {
            beyond = beyond || to[i] >= n;
            seen |= 1 << to[i];
            for (int j = 0; j < i; j++)
                swaps += to[j] > to[i];
            product *= m[i][to[i] < n ? to[i] : 0];
        }
        for (int i = n; i < 4; i++)
            beyond = beyond || to[i] != 0;
        if (!beyond && seen == (1 << n) - 1)
            sum += swaps % 2 == 0 ? product : -product;
    }
    return sum;
}

/* The cofactor of (row, column). */
static int64_t cofactor(int n, int64_t m[4][4], int row, int column)
{
    int64_t left[4][4] = { { 0 } };
    for (int i = 0; i < n - 1; i++)
        for (int j = 0; j < n - 1; j++)
            left[i][j] = m[i + (i >= row)][j + (j >= column)];
    return leibniz(n - 1, left) * ((row + column) % 2 == 0 ? 1 : -1);
}

/* What a function of n x n made, against the whole numbers of each lane. */
static void check_square(int n, int trial, const lom_float *a, const lom_float *b, const lom_float *product,
                         const lom_float *transposed, const lom_float *inverse, lom_float determinant)
{
    for (int lane = 0; lane < LOM_LANES; lane++) {
        int64_t x[4][4] = { { 0 } }, y[4][4] = { { 0 } };
        for (int i = 0; i < n * n; i++) {
            x[i / n][i % n] = (int64_t)a[i][lane];
            y[i / n][i % n] = (int64_t)b[i][lane];
        }
        int64_t d = leibniz(n, x);
        CHECK(determinant[lane] == (float)d, "%d x %d trial %d: determinant %g", n, n, trial,
              (double)determinant[lane]);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                int64_t sum = 0;
                for (int k = 0; k < n; k++)
                    sum += x[i][k] * y[k][j];
                float want = d == 0 ? 0 : (float)cofactor(n, x, j, i) / (float)d;
                CHECK(product[i * n + j][lane] == (float)sum && transposed[j * n + i][lane] == (float)x[i][j],
                      "%d x %d trial %d: (%d, %d)", n, n, trial, i, j);
                CHECK(inverse[i * n + j][lane] == want, "%d x %d trial %d: inverse (%d, %d) %g not %g", n, n, trial, i,
                      j, (double)inverse[i * n + j][lane], (double)want);
            }
    }
}

static void matrices_of_whole_numbers(void)
{
    for (int trial = 0; trial < 200; trial++) {
        lom_float a[16], b[16];
        for (uint64_t i = 0; i < 16; i++) {
            a[i] = some(1000 + 32 * (uint64_t)trial + i, 1);
            b[i] = some(1016 + 32 * (uint64_t)trial + i, 1);
        }
        if (trial % 4 == 0) /* singular: a row twice */
            for (int i = 0; i < 4; i++)
                a[4 + i] = a[i];
        lom_float2x2 a2, b2;
        lom_float3x3 a3, b3;
        lom_float4x4 a4, b4;
        memcpy(&a2, a, sizeof a2);
        memcpy(&b2, b, sizeof b2);
        memcpy(&a3, a, sizeof a3);
        memcpy(&b3, b, sizeof b3);
        memcpy(&a4, a, sizeof a4);
        memcpy(&b4, b, sizeof b4);
        lom_float2x2 p2 = lom_multiply2x2(&a2, &b2), t2 = lom_transpose2x2(&a2), i2 = lom_inverse2x2(&a2);
        lom_float3x3 p3 = lom_multiply3x3(&a3, &b3), t3 = lom_transpose3x3(&a3), i3 = lom_inverse3x3(&a3);
        lom_float4x4 p4 = lom_multiply4x4(&a4, &b4), t4 = lom_transpose4x4(&a4), i4 = lom_inverse4x4(&a4);
        check_square(2, trial, a, b, p2.m[0], t2.m[0], i2.m[0], lom_determinant2x2(&a2));
        check_square(3, trial, a, b, p3.m[0], t3.m[0], i3.m[0], lom_determinant3x3(&a3));
        check_square(4, trial, a, b, p4.m[0], t4.m[0], i4.m[0], lom_determinant4x4(&a4));
        /* m v is the first column of m (v, ...) */
        lom_float2 v2 = { b2.m[0][0], b2.m[1][0] };
        lom_float3 v3 = { b3.m[0][0], b3.m[1][0], b3.m[2][0] };
        lom_float4 v4 = { b4.m[0][0], b4.m[1][0], b4.m[2][0], b4.m[3][0] };
        CHECK(same(lom_apply2x2(&a2, v2).y, p2.m[1][0]) && same(lom_apply3x3(&a3, v3).z, p3.m[2][0]) &&
                  same(lom_apply3x3(&a3, v3).x, p3.m[0][0]) && same(lom_apply4x4(&a4, v4).w, p4.m[3][0]) &&
                  same(lom_apply4x4(&a4, v4).y, p4.m[1][0]),
              "trial %d: m v", trial);
    }
}

static void odd_matrices(void)
{
    lom_float2x2 bad = { { { lom_splat(NAN), lom_splat(1) }, { lom_splat(1), lom_splat(1) } } };
    CHECK(lom_inverse2x2(&bad).m[0][0][0] == 0 && lom_inverse2x2(&bad).m[1][1][0] == 0, "NaN has no inverse");
    lom_matrix_uniform u = { { { 1, 2, 3, 4 }, { 5, 6, 7, 8 }, { 9, 10, 11, 12 }, { 0, 0, 0, 1 } } };
    lom_float4x4 m = lom_splat4x4(&u);
    lom_float4 v = lom_splat4(1, -1, 2, 3), a = lom_multiply4(&u, v), b = lom_apply4x4(&m, v);
    CHECK(same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.w, b.w), "a uniform in every lane");
}

/* ---- refraction ---- */

static void snell(void)
{
    const lom_float3 n = lom_splat3(0, 1, 0);
    for (int i = 0; i < 90; i++)
        for (int k = 0; k < 3; k++) {
            static const double etas[3] = { 1 / 1.33, 1.33, 1 };
            double angle = i * 3.14159265358979 / 180, eta = etas[k], sine = sin(angle) * eta;
            lom_float3 d = lom_splat3((float)sin(angle), (float)-cos(angle), 0), out;
            lom_mask passes = lom_refract3(d, n, lom_splat((float)eta), &out);
            if (fabs(sine - 1) < 1e-3)
                continue;
            CHECK(lom_all(passes) == (sine < 1) && lom_any(passes) == (sine < 1), "%d degrees, %g", i, eta);
            CHECK(sine > 1 || (fabs((double)out.x[0] - sine) < 1e-6 &&
                               fabs((double)out.y[0] + sqrt(1 - sine * sine)) < 1e-5 && out.z[0] == 0),
                  "%d degrees, %g: (%g, %g)", i, eta, (double)out.x[0], (double)out.y[0]);
            CHECK(sine < 1 || (out.x[0] == d.x[0] && out.y[0] == d.y[0]), "%d degrees, %g: all is reflected", i, eta);
        }
}

int main(int argc, char **argv)
{
    RUN(components);
    RUN(matrices_of_whole_numbers);
    RUN(odd_matrices);
    RUN(snell);
    return check_result();
}
