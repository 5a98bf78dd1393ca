/* sin, cos, tan in double. In: any double; out: within 1 ulp (0.55 for sin and cos), for arguments of every size.
 * Invariant: the same bits on every machine (double_parts.h).
 *
 * Reduction: x = n pi/2 + r, |r| <= pi/4, r a pair. Below 2^19, pi/2 is subtracted in parts of 33 + 33 + 33 + 53 bits,
 * the first three times n exact (Cody and Waite, "Software manual for the elementary functions", 1980): the error is
 * below 2^-135, and no double comes nearer than 2^-61 to a multiple of pi/2 (Muller, "Elementary functions", 2006,
 * 10.2). Above, 192 bits of 2/pi, from the first one that matters modulo 4, are multiplied with the mantissa in
 * integers (Payne and Hanek, "Radian reduction for trigonometric functions", 1983): error below 2^-137.
 *
 * sin r and cos r are their Taylor series, to r^17/17! and r^18/18! (the rest is below 2^-62). */
#include "base/double_parts.h"

static const uint64_t TWO_OVER_PI[20] = {
    /* floor(2/pi * 2^1280), first word first */
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561, 0xb7246e3a424dd2e0,
    0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41, 0x3991d639835339f4,
    0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d,
    0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d,
};

static const lom_pair MINUS_SIXTH = { -0x1.5555555555555p-3, -0x1.5555555555555p-57 };
static const lom_pair HALF_PI = { 0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54 };

/* a * b: the high word returned, the low one in *low. */
static uint64_t multiply_words(uint64_t a, uint64_t b, uint64_t *low)
{
    uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    uint64_t low_product = a0 * b0;
    uint64_t middle = a1 * b0 + (low_product >> 32);
    uint64_t cross = a0 * b1 + (uint32_t)middle;
    *low = cross << 32 | (uint32_t)low_product;
    return a1 * b1 + (middle >> 32) + (cross >> 32);
}

/* 64 bits of 2/pi from bit first on (bit 0 is worth 1/2). */
static uint64_t two_over_pi_bits(int first)
{
    int word = first / 64, shift = first % 64;
    uint64_t bits = TWO_OVER_PI[word] << shift;
    if (shift != 0)
        bits |= TWO_OVER_PI[word + 1] >> (64 - shift);
    return bits;
}

/* word[0] ... word[count - 1], first word most significant, shifted left by 0 <= shift < 64. */
static void shift_left(uint64_t *word, int count, int shift)
{
    for (int i = 0; i < count && shift != 0; i++)
        word[i] = word[i] << shift | (i + 1 < count ? word[i + 1] >> (64 - shift) : 0);
}

/* f = word / 2^256 * 4 as a pair, where the top two bits are 0; from its first 106 bits. No double is
 * nearer to a multiple of pi/2 than f = 2^-61.6 (Muller, "Elementary functions", 10.2), so word[0] is not 0. */
static lom_pair fraction_pair(uint64_t word[4])
{
    int zeros = __builtin_clzll(word[0]), exponent = 2 - zeros;
    shift_left(word, 4, zeros);
    double hi = (double)(word[0] >> 11);
    double lo = (double)((word[0] & 0x7ff) << 42 | word[1] >> 22);
    return fast_two_sum(hi * power_of_two(exponent - 53), lo * power_of_two(exponent - 106));
}

/* Payne-Hanek for 2^19 <= a < infinity: returns r and the quadrant n mod 4. */
static lom_pair reduce_large(double a, int *quadrant)
{
    uint64_t bits = double_bits(a);
    uint64_t mantissa = (bits & (UINT64_MAX >> 12)) | UINT64_C(1) << 52;
    int e = (int)(bits >> 52) - 1075; /* a = mantissa * 2^e, e >= -33 */
    int first = e > 2 ? e - 2 : 0;    /* the bits of 2/pi before it give multiples of 4 */
    uint64_t product[4], low1, low2, high1, high2;

    product[2] = multiply_words(mantissa, two_over_pi_bits(first + 128), &product[3]);
    high1 = multiply_words(mantissa, two_over_pi_bits(first + 64), &low1);
    high2 = multiply_words(mantissa, two_over_pi_bits(first), &low2);
    product[2] += low1;
    high1 += product[2] < low1; /* high1 < 2^53: no overflow */
    product[1] = high1 + low2;
    product[0] = high2 + (product[1] < low2);

    /* The product is worth 2^(e - first - 192); after the shift its first two bits are n mod 4, the others a fraction.
     */
    int shift = 62 + e - first; /* 29 to 64 */
    if (shift == 64) {
        memmove(product, product + 1, 3 * sizeof product[0]);
        product[3] = 0;
    } else {
        shift_left(product, 4, shift);
    }
    *quadrant = (int)(product[0] >> 62);
    bool above_half = product[0] >> 61 & 1;
    if (above_half) { /* f - 1, by the complement: one unit of 2^-254 does not matter */
        *quadrant = (*quadrant + 1) & 3;
        for (int i = 0; i < 4; i++)
            product[i] = ~product[i];
    }
    product[0] &= UINT64_MAX >> 2;
    lom_pair r = pair_multiply(fraction_pair(product), HALF_PI);
    return above_half ? pair_negate(r) : r;
}

/* x = n pi/2 + r for finite x; *quadrant = n mod 4. */
static lom_pair reduce(double x, int *quadrant)
{
    double a = magnitude(x);
    lom_pair r;
    if (a <= 0x1.921fb54442d18p-1) {
        *quadrant = 0;
        return (lom_pair){ x, 0 };
    }
    if (a < 0x1p19) {
        double n = nearest(a * 0x1.45f306dc9c883p-1);
        *quadrant = lom_int_of(n) & 3;
        r = two_sum(a - n * 0x1.921fb544p+0, -(n * 0x1.0b4611a6p-34));
        r = pair_add(r, (lom_pair){ -(n * 0x1.3198a2ep-69), -(n * 0x1.b839a252049c1p-104) });
    } else {
        r = reduce_large(a, quadrant);
    }
    if (is_negative(x)) {
        *quadrant = -*quadrant & 3;
        return pair_negate(r);
    }
    return r;
}

/* sin r = r + (-r^3/3! + (r^5 (1/5! - ...) + lo cos r)), r^3/3! in a pair; 1 - r^2/2 is enough for the factor of lo. */
static lom_pair sin_parts(lom_pair r)
{
    static const double coefficient[] = { 1.0 / 120,        -1.0 / 5040,          1.0 / 362880,         -1.0 / 39916800,
                                          1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000 };
    lom_pair square = two_product(r.hi, r.hi);
    lom_pair cube = pair_multiply(pair_multiply(square, (lom_pair){ r.hi, 0 }), MINUS_SIXTH);
    double tail = r.hi * (square.hi * square.hi) * polynomial(square.hi, coefficient, 7);
    lom_pair sum = fast_two_sum(r.hi, cube.hi);
    return fast_two_sum(sum.hi, sum.lo + (cube.lo + (tail + r.lo * (1 - 0.5 * square.hi))));
}

/* cos r = 1 - r^2/2 + (r^4 (1/4! - ...) - lo sin r), r^2 in a pair. */
static lom_pair cos_parts(lom_pair r)
{
    static const double coefficient[] = {
        1.0 / 24,        -1.0 / 720,         1.0 / 40320,          -1.0 / 3628800,
        1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000, -1.0 / 6402373705728000
    };
    lom_pair square = two_product(r.hi, r.hi);
    lom_pair sum = fast_two_sum(1, -0.5 * square.hi);
    double tail = square.hi * square.hi * polynomial(square.hi, coefficient, 8);
    return fast_two_sum(sum.hi, sum.lo + (tail - (0.5 * square.lo + r.lo * r.hi)));
}

/* sin(x + shift pi/2) */
static double shifted_sin(double x, int shift)
{
    if (!(magnitude(x) < DOUBLE_INFINITY))
        return double_nan();
    int quadrant;
    lom_pair r = reduce(x, &quadrant);
    quadrant += shift;
    lom_pair value = quadrant & 1 ? cos_parts(r) : sin_parts(r);
    double sum = value.hi + value.lo;
    return quadrant & 2 ? -sum : sum;
}

double lom_double_sin(double x)
{
    if (magnitude(x) < 0x1p-28)
        return x; /* x^3/6 is below half an ulp */
    return shifted_sin(x, 0);
}

double lom_double_cos(double x)
{
    return shifted_sin(x, 1);
}

double lom_double_tan(double x)
{
    if (magnitude(x) < 0x1p-28)
        return x; /* x^3/3 is below half an ulp */
    if (!(magnitude(x) < DOUBLE_INFINITY))
        return double_nan();
    int quadrant;
    lom_pair r = reduce(x, &quadrant);
    lom_pair s = sin_parts(r), c = cos_parts(r);
    lom_pair t = quadrant & 1 ? pair_negate(pair_divide(c, s)) : pair_divide(s, c);
    return t.hi + t.lo;
}
