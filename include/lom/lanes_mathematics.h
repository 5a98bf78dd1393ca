/* lom/lanes_mathematics.h - exp, log, pow, sin ... of lanes.
 *
 * In and out: lom_float, any bits in every lane; a lane's result depends on that lane alone. Every function but
 * lom_pow_integer is within 1 ulp for every argument, denormals, infinities and huge angles included; the special cases
 * are those of C11's Annex F; every NaN result is the quiet NaN 0x7fc00000. Only + - * / and square root of IEEE 754,
 * conversions and integer operations are used, in one order: the same bits at every width, on every machine.
 *
 * The arithmetic is in lanes of double. exp costs 1.2 (4 lanes) to 1.4 times (16 lanes) what it costs in float with the
 * corrections that 1 ulp takes there (bench/results/lane-mathematics.md); in return the conversion back rounds once,
 * into denormals and infinities as well, and pow needs no other arithmetic than exp.
 *
 * Each polynomial interpolates its function at the Chebyshev points of the reduced interval, which is within a few
 * per cent of the best one (Trefethen, "Approximation theory and practice", ch. 16); its error stands beside it. It was
 * computed with 60 digits, then rounded to double.
 */
#ifndef LOM_LANES_MATHEMATICS_H
#define LOM_LANES_MATHEMATICS_H

#include <lom/lanes.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

typedef int64_t lom_long __attribute__((vector_size(LOM_LANES * 8)));
typedef uint64_t lom_ulong __attribute__((vector_size(LOM_LANES * 8)));

/* ---- parts ---- */

#define LOM_NEAREST 0x1.8p52 /* adding it rounds |x| < 2^51 to an integer, which is left in the low bits */

LOM_INLINE lom_double lom_widen(lom_float x)
{
    return __builtin_convertvector(x, lom_double);
}

LOM_INLINE lom_float lom_narrow(lom_double x)
{
    return __builtin_convertvector(x, lom_float);
}

LOM_INLINE lom_long lom_widen_mask(lom_mask mask)
{
    return __builtin_convertvector(mask, lom_long);
}

LOM_INLINE lom_double lom_select_double(lom_long mask, lom_double a, lom_double b)
{
    return (lom_double)((mask & (lom_long)a) | (~mask & (lom_long)b));
}

/* In two halves, each of which is a register: gcc spreads what is wider by way of memory where it leaves a loop. */
LOM_INLINE lom_double lom_splat_double(double value)
{
    typedef double lom_half_double __attribute__((vector_size(LOM_LANES * 4)));
    const lom_half_double zero = { 0 };
    union {
        lom_half_double half[2];
        lom_double whole;
    } both;
    both.half[0] = both.half[1] = value - zero;
    return both.whole;
}

/* The quiet NaN where x is NaN, otherwise y. */
LOM_INLINE lom_float lom_keep_nan(lom_float x, lom_float y)
{
    return lom_select(x == x, y, lom_splat(__builtin_nanf("")));
}

/* result[i] = function(x[i]) in the lanes of mask. Rare arguments go this way; never inlined, so that the common path
 * keeps its registers. */
static __attribute__((noinline, cold, unused)) void lom_each_lane(lom_float *result, const lom_float *x, uint32_t mask,
                                                                  double (*function)(double))
{
    for (int i = 0; i < LOM_LANES; i++)
        if (mask >> i & 1)
            (*result)[i] = (float)function((*x)[i]);
}

/* The same for two arguments. */
static __attribute__((noinline, cold, unused)) void lom_each_lane2(lom_float *result, const lom_float *x,
                                                                   const lom_float *y, uint32_t mask,
                                                                   double (*function)(double, double))
{
    for (int i = 0; i < LOM_LANES; i++)
        if (mask >> i & 1)
            (*result)[i] = (float)function((*x)[i], (*y)[i]);
}

/* 2^y - 1 = s (1 + p) - 1 with s = 2^n, n nearest to y, for |y| < 1000. Error of 1 + p below 2^-27.9, of p the same
 * relative to p, which is exact at 0. */
LOM_INLINE void lom_exp2_parts(lom_double y, lom_double *s, lom_double *p)
{
    lom_double t = y + LOM_NEAREST;
    lom_double r = y - (t - LOM_NEAREST);
    lom_double q = 0x1.5f0890162a90ap-10 + r * 0x1.4413896e1ad27p-13;
    q = 0x1.3b2a53045179ap-7 + r * q;
    q = 0x1.c6af6cdbbdcc7p-5 + r * q;
    q = 0x1.ebfbe00e63baep-3 + r * q;
    q = 0x1.62e4302fc626ep-1 + r * q;
    *p = r * q;
    *s = (lom_double)(((lom_long)t << 52) + INT64_C(0x3ff0000000000000));
}

/* log2 x for positive, finite x: x = 2^k z, z in [sqrt(1/2), sqrt 2), and with s = (z - 1)/(z + 1), |s| <= 0.1716,
 * log2 z = 2/ln2 (s + s^3/3 + s^5/5 + ...). Relative error below 2^-37.8, near 1 too, since k is 0 there. */
LOM_INLINE lom_double lom_log2_parts(lom_double x)
{
    const int64_t start = INT64_C(0x3fe6a09e00000000); /* bits near sqrt(1/2) */
    lom_long offset = (lom_long)x - start;
    lom_ulong biased = (lom_ulong)(offset + (INT64_C(1024) << 52)) >> 52;
    lom_double k = (lom_double)(biased | UINT64_C(0x4330000000000000)) - (0x1p52 + 1024); /* 2^52 + biased */
    lom_double z = (lom_double)((offset & INT64_C(0x000fffffffffffff)) + start);
    lom_double s = (z - 1.0) / (z + 1.0);
    lom_double u = s * s;
    lom_double q = 0x1.a58dccf36a746p-2 + u * 0x1.5ce3c1cf29785p-2;
    q = 0x1.27777f49cf406p-1 + u * q;
    q = 0x1.ec709d13bbdb4p-1 + u * q;
    q = 0x1.71547652bed17p+1 + u * q;
    return k + s * q;
}

/* ---- exponentials ---- */

/* 2^x: infinity from 128 on, 0 from -150 down. Error below 0.57 ulp. */
LOM_INLINE lom_float lom_exp2(lom_float x)
{
    lom_double s, p;
    lom_exp2_parts(lom_widen(lom_clamp(x, lom_splat(-151.0f), lom_splat(129.0f))), &s, &p);
    return lom_keep_nan(x, lom_narrow(s + s * p));
}

/* e^x. x log2 e in double is off by 2^-46 at most. Error below 0.57 ulp. */
LOM_INLINE lom_float lom_exp(lom_float x)
{
    lom_double s, p;
    lom_float bounded = lom_clamp(x, lom_splat(-105.0f), lom_splat(89.0f));
    lom_exp2_parts(lom_widen(bounded) * 0x1.71547652b82fep+0, &s, &p);
    return lom_keep_nan(x, lom_narrow(s + s * p));
}

/* e^x, and 0 from -87 on, where it would soon be denormal: for what fades, such as light in water and normal densities. Some
 * processors take a hundred times as long for denormal numbers. */
LOM_INLINE lom_float lom_fade(lom_float x)
{
    return lom_select(x <= -87.0f, lom_splat(0.0f), lom_exp(lom_select(x <= -87.0f, lom_splat(0.0f), x)));
}

/* e^x - 1, without loss near 0: for optical depths, 1 - e^-d = -lom_expm1(-d). Error below 0.75 ulp. */
LOM_INLINE lom_float lom_expm1(lom_float x)
{
    lom_double s, p;
    lom_float bounded = lom_clamp(x, lom_splat(-105.0f), lom_splat(89.0f));
    lom_exp2_parts(lom_widen(bounded) * 0x1.71547652b82fep+0, &s, &p);
    return lom_keep_nan(x, lom_copysign(lom_narrow(s * p + (s - 1.0)), x)); /* keeps -0 */
}

/* tanh |x| = e/(e + 2) with e = e^(2 |x|) - 1. Error below 0.75 ulp. */
LOM_INLINE lom_float lom_tanh(lom_float x)
{
    lom_double s, p;
    lom_float bounded = lom_min(lom_abs(x), lom_splat(20.0f)); /* 1 - tanh 20 < 2^-56 */
    lom_exp2_parts(lom_widen(bounded) * 0x1.71547652b82fep+1, &s, &p);
    lom_double e = s * p + (s - 1.0);
    return lom_keep_nan(x, lom_copysign(lom_narrow(e / (e + 2.0)), x));
}

/* ---- logarithms ---- */

/* The value of a logarithm: l where x is positive and finite; -infinity at 0, NaN below. */
LOM_INLINE lom_float lom_log_special(lom_float x, lom_float l)
{
    lom_float infinity = lom_splat(__builtin_inff());
    l = lom_select(x < infinity, l, infinity);
    l = lom_select(x == 0.0f, -infinity, l);
    return lom_select(x >= 0.0f, l, lom_splat(__builtin_nanf("")));
}

LOM_INLINE lom_float lom_log2(lom_float x)
{
    return lom_log_special(x, lom_narrow(lom_log2_parts(lom_widen(x))));
}

LOM_INLINE lom_float lom_log(lom_float x)
{
    return lom_log_special(x, lom_narrow(lom_log2_parts(lom_widen(x)) * 0x1.62e42fefa39efp-1));
}

/* ---- powers ---- */

/* x^y, C's cases. Error below 0.6 ulp. Lanes with a negative x (or -0), with infinities or NaN take a slower way. */
LOM_INLINE lom_float lom_pow(lom_float x, lom_float y)
{
    lom_double l = lom_log2_parts(lom_widen(x)) * lom_widen(y);
    lom_float rough = lom_narrow(l);
    lom_mask inside = (rough > -151.0f) & (rough < 129.0f);
    lom_double bound = lom_widen(lom_clamp(rough, lom_splat(-151.0f), lom_splat(129.0f)));
    lom_double s, p;
    lom_exp2_parts(lom_select_double(lom_widen_mask(inside), l, bound), &s, &p);
    lom_float power = lom_narrow(s + s * p);

    lom_float infinity = lom_splat(__builtin_inff());
    lom_float at_zero = lom_select(y > 0.0f, lom_splat(0.0f), lom_select(y < 0.0f, infinity, lom_splat(1.0f)));
    power = lom_select((lom_int)x == 0, at_zero, power);
    lom_mask usual = ((lom_int)x >= 0) & (x < infinity) & (lom_abs(y) < infinity);
    uint32_t unusual = lom_bits(~usual);
    if (__builtin_expect(unusual != 0, 0)) {
        lom_float given_x = x, given_y = y, result = power;
        lom_each_lane2(&result, &given_x, &given_y, unusual, lom_double_pow);
        power = result;
    }
    return power;
}

/* x^n by squaring, from the low bit of n up: x^13 = (x x^4) x^8; n = 0 gives 1; 1/x^-n for n < 0. For a constant n,
 * such as a shininess, it unrolls to a handful of products. Relative error at most |n| 2^-24 (each of the products
 * rounds, and squaring doubles what came before); products of denormals lose more. */
LOM_INLINE lom_float lom_pow_integer(lom_float x, int n)
{
    unsigned rest = n < 0 ? 0u - (unsigned)n : (unsigned)n;
    lom_float power = lom_splat(1.0f), square = x;
    while (rest != 0) {
        if (rest & 1)
            power = power * square;
        rest >>= 1;
        if (rest != 0)
            square = square * square;
    }
    return n < 0 ? 1.0f / power : power;
}

/* ---- angles ---- */

#define LOM_FAST_ANGLE 131072.0f /* below, n has 17 bits; n times the first 33 bits of pi is exact */

/* (-1)^n sin r for x = n pi + r + offset pi, as sign ^ that; |r| <= pi/2. Error below 2^-33. */
LOM_INLINE lom_float lom_shifted_sin(lom_float x, double offset, int64_t sign)
{
    lom_double wide = lom_widen(x);
    lom_double t = (wide * 0x1.45f306dc9c883p-2 - offset) + LOM_NEAREST;
    lom_double n = (t - LOM_NEAREST) + offset;
    lom_double r = (wide - n * 0x1.921fb544p+1) - n * 0x1.0b4611a626331p-33;
    lom_double u = r * r;
    lom_double q = 0x1.7196917ff9c49p-19 + u * -0x1.9db1cc2a4cb87p-26;
    q = -0x1.a01905ba4208ap-13 + u * q;
    q = 0x1.11110fdaaf87bp-7 + u * q;
    q = -0x1.555555546053p-3 + u * q;
    lom_double value = r * (1.0 + u * q); /* keeps -0 */
    return lom_narrow((lom_double)((lom_long)value ^ (lom_long)((lom_ulong)t << 63) ^ sign));
}

/* sin x and cos x: angles below 131072 in double; larger ones by the exact reduction of lom_double_sin, a lane at a
 * time. Error below 0.51 ulp. */
LOM_INLINE lom_float lom_sin(lom_float x)
{
    lom_float value = lom_shifted_sin(x, 0.0, 0);
    uint32_t large = lom_bits(~(lom_abs(x) < LOM_FAST_ANGLE));
    if (__builtin_expect(large != 0, 0)) {
        lom_float given = x, result = value;
        lom_each_lane(&result, &given, large, lom_double_sin);
        value = result;
    }
    return value;
}

LOM_INLINE lom_float lom_cos(lom_float x) /* cos((n + 1/2) pi + r) = -(-1)^n sin r */
{
    lom_float value = lom_shifted_sin(x, 0.5, INT64_MIN);
    uint32_t large = lom_bits(~(lom_abs(x) < LOM_FAST_ANGLE));
    if (__builtin_expect(large != 0, 0)) {
        lom_float given = x, result = value;
        lom_each_lane(&result, &given, large, lom_double_cos);
        value = result;
    }
    return value;
}

/* tan x = sin r/cos r, or -cos r/sin r for odd n, x = n pi/2 + r. Errors of sin r and cos r below 2^-35.8 and 2^-31.8.
 */
LOM_INLINE lom_float lom_tan(lom_float x)
{
    lom_double wide = lom_widen(x);
    lom_double t = wide * 0x1.45f306dc9c883p-1 + LOM_NEAREST;
    lom_double n = t - LOM_NEAREST;
    lom_double r = (wide - n * 0x1.921fb544p+0) - n * 0x1.0b4611a626331p-34;
    lom_double u = r * r;
    lom_double q = -0x1.a013a793b98cep-13 + u * 0x1.6dbe0838a06e9p-19;
    q = 0x1.11110def2e1c9p-7 + u * q;
    lom_double sine = r * (1.0 + u * (-0x1.555555545e0acp-3 + u * q));
    q = -0x1.6c0e087f57eebp-10 + u * 0x1.9a6f2bb019f5p-16;
    q = 0x1.55554cbb440f1p-5 + u * q;
    lom_double cosine = 1.0 + u * (-0x1.fffffffab1da6p-2 + u * q);
    lom_long odd = -((lom_long)t & 1);
    lom_float value = lom_narrow(lom_select_double(odd, -cosine, sine) / lom_select_double(odd, sine, cosine));

    uint32_t large = lom_bits(~(lom_abs(x) < LOM_FAST_ANGLE));
    if (__builtin_expect(large != 0, 0)) {
        lom_float given = x, result = value;
        lom_each_lane(&result, &given, large, lom_double_tan);
        value = result;
    }
    return value;
}

/* The angle in [0, pi] of the point (x, y), y = |y| >= 0, x = ax with its sign, finite. With q = min/max, or
 * (min - max)/(min + max) = tan(angle - pi/4) above tan(pi/8), |q| <= 0.4143; error of atan q below 2^-30.6. The point
 * (+-0, 0) counts as (+-1, 0). */
LOM_INLINE lom_float lom_upper_angle(lom_float y, lom_float ax, lom_mask x_negative)
{
    lom_mask steep = y > ax;
    lom_float low = lom_select(steep, ax, y), high = lom_select(steep, y, ax);
    high = lom_select(high == 0.0f, lom_splat(1.0f), high);
    lom_mask middle = low > high * 0.41421357f;
    lom_double n = lom_widen(low), d = lom_widen(high);
    lom_double of_n = lom_widen(lom_select(middle, low, lom_splat(0.0f)));
    lom_double of_d = lom_widen(lom_select(middle, high, lom_splat(0.0f)));
    lom_double q = (n - of_d) / (d + of_n);
    lom_double u = q * q;
    lom_double c = 0x1.b0f0ae6216a23p-4 + u * -0x1.edacbeb0f9099p-5;
    c = -0x1.23a0291bb57a2p-3 + u * c;
    c = 0x1.999012e9a122bp-3 + u * c;
    c = -0x1.55554396e96acp-2 + u * c;
    c = 0x1.fffffffa994f8p-1 + u * c;

    lom_long quarter = lom_widen_mask(middle), turned = lom_widen_mask(steep), mirrored = lom_widen_mask(x_negative);
    lom_double base = (lom_double)(quarter & (lom_long)lom_splat_double(0x1.921fb54442d18p-1));
    lom_double angle = base + q * c;
    base = (lom_double)(turned & (lom_long)lom_splat_double(0x1.921fb54442d18p+0));
    angle = base + (lom_double)((lom_long)angle ^ (turned & INT64_MIN));
    base = (lom_double)(mirrored & (lom_long)lom_splat_double(0x1.921fb54442d18p+1));
    angle = base + (lom_double)((lom_long)angle ^ (mirrored & INT64_MIN));
    return lom_narrow(angle);
}

/* Error below 0.52 ulp. Above 2^100 the result is that of 2^100. */
LOM_INLINE lom_float lom_atan(lom_float x)
{
    lom_float bounded = lom_min(lom_abs(x), lom_splat(0x1p100f));
    lom_float angle = lom_upper_angle(bounded, lom_splat(1.0f), lom_splat_int(0));
    return lom_keep_nan(x, lom_copysign(angle, x));
}

/* The angle of the point (x, y) in [-pi, pi], C's cases for signed zeros and infinities. Error below 0.52 ulp. Lanes
 * with infinities or NaN take a slower way. */
LOM_INLINE lom_float lom_atan2(lom_float y, lom_float x)
{
    lom_float angle = lom_copysign(lom_upper_angle(lom_abs(y), lom_abs(x), (lom_int)x < 0), y);
    lom_float infinity = lom_splat(__builtin_inff());
    uint32_t unusual = lom_bits(~((lom_abs(x) < infinity) & (lom_abs(y) < infinity)));
    if (__builtin_expect(unusual != 0, 0)) {
        lom_float given_y = y, given_x = x, result = angle;
        lom_each_lane2(&result, &given_y, &given_x, unusual, lom_double_atan2);
        angle = result;
    }
    return angle;
}

/* asin of a in [0, 1/2], and asin sqrt((1 - a)/2) = acos(a)/2 for a in [1/2, 1]. Error below 2^-29.8. The root is that
 * of float (1 - a is exact there) and one step of Newton, off by 2^-48: clang 14 finds no vector instruction for the
 * root of 16 doubles and took 5 times as long. */
LOM_INLINE lom_double lom_asin_parts(lom_float a, lom_mask big)
{
    lom_double wide = lom_widen(a);
    lom_long mask = lom_widen_mask(big);
    lom_double u = lom_select_double(mask, 0.5 - 0.5 * wide, wide * wide);
    lom_float half = lom_select(big, 0.5f - 0.5f * a, lom_splat(0.0f));
    lom_float first = lom_sqrt(half);
    lom_float rest = lom_narrow(u - lom_widen(first) * lom_widen(first)) / (first + first + 0x1p-100f); /* 0 at a = 1 */
    lom_double root = lom_widen(first) + lom_widen(rest);
    lom_double v = lom_select_double(mask, root, wide);
    lom_double q = 0x1.18f91e79712c6p-6 + u * 0x1.13fed3dd245c1p-5;
    q = 0x1.fd8da2554dd34p-6 + u * q;
    q = 0x1.6d5bb95f8e653p-5 + u * q;
    q = 0x1.333430fcff28ep-4 + u * q;
    q = 0x1.555554e435732p-3 + u * q;
    return v + v * (u * q);
}

/* Error below 0.53 ulp; NaN outside [-1, 1]. */
LOM_INLINE lom_float lom_asin(lom_float x)
{
    lom_float a = lom_abs(x);
    lom_mask big = a > 0.5f;
    lom_double part = lom_asin_parts(lom_min(a, lom_splat(1.0f)), big);
    lom_double angle = lom_select_double(lom_widen_mask(big), 0x1.921fb54442d18p+0 - (part + part), part);
    return lom_select(a <= 1.0f, lom_copysign(lom_narrow(angle), x), lom_splat(__builtin_nanf("")));
}

/* Error below 0.53 ulp; NaN outside [-1, 1]. */
LOM_INLINE lom_float lom_acos(lom_float x)
{
    lom_float a = lom_abs(x);
    lom_mask big = a > 0.5f;
    lom_long wide_big = lom_widen_mask(big), negative = lom_widen_mask((lom_int)x < 0);
    lom_double part = lom_asin_parts(lom_min(a, lom_splat(1.0f)), big);
    lom_double acute = lom_select_double(wide_big, part + part, 0x1.921fb54442d18p+0 - part); /* acos |x| */
    lom_double angle = lom_select_double(negative, 0x1.921fb54442d18p+1 - acute, acute);
    return lom_select(a <= 1.0f, lom_narrow(angle), lom_splat(__builtin_nanf("")));
}

#pragma GCC diagnostic pop

#endif
