/* Floating values as integers: towards zero, the nearest value in range for what lies outside, 0 for NaN. The oracle
 * shifts the bits of the double, so it has no conversion of its own. */
#include "check.h"

#include <lom/base.h>

#include <string.h>

/* The magnitude cut towards zero, at most 2^64 - 1. */
static uint64_t whole_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    int exponent = (int)(bits >> 52 & 0x7ff) - 1023;
    uint64_t mantissa = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52;
    if (exponent < 0)
        return 0;
    if (exponent > 63)
        return UINT64_MAX;
    return exponent > 52 ? mantissa << (exponent - 52) : mantissa >> (52 - exponent);
}

static int64_t bounded(double x, int64_t least, int64_t most)
{
    uint64_t whole = whole_of(x);
    if (x != x)
        return 0;
    if (x < 0)
        return whole >= (uint64_t)most + 1 ? least : -(int64_t)whole;
    return whole > (uint64_t)most ? most : (int64_t)whole;
}

static void compare(double x)
{
    static const size_t most[] = { 0, 1, 255, 65535, 16777216, INT32_MAX, UINT32_MAX, SIZE_MAX };
    CHECK(lom_int_of(x) == bounded(x, INT32_MIN, INT32_MAX), "%a gives %ld", x, (long)lom_int_of(x));
    CHECK(lom_int64_of(x) == bounded(x, INT64_MIN, INT64_MAX), "%a gives %lld", x, (long long)lom_int64_of(x));
    for (size_t i = 0; i < sizeof most / sizeof *most; i++) {
        uint64_t whole = x > 0 && x == x ? whole_of(x) : 0, right = whole < most[i] ? whole : most[i];
        CHECK(lom_count_of(x, most[i]) == right, "%a of at most %zu gives %zu", x, most[i], lom_count_of(x, most[i]));
    }
}

static double of_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Every power of two, the doubles next to it, halves and NaN, of either sign. */
static void conversions_at_edges(void)
{
    for (uint64_t sign = 0; sign < 2; sign++)
        for (uint64_t exponent = 0; exponent < 2048; exponent++)
            for (uint64_t step = 0; step < 9; step++)
                compare(of_bits(((sign << 63 | exponent << 52) + step - 4) ^ (step == 8 ? UINT64_C(1) << 51 : 0)));
    static const double near[] = { 0.5,          0.99999999999999989, 1.5,          254.5,        255.5,       65535.5,
                                   2147483646.5, 2147483647.5,        2147483648.5, 4294967294.5, 4294967295.5 };
    for (size_t i = 0; i < sizeof near / sizeof *near; i++) {
        compare(near[i]);
        compare(-near[i]);
    }
}

static void conversions_anywhere(void)
{
    for (uint64_t i = 0; i < 300000; i++) {
        compare(of_bits(lom_random_bits(1, i)));
        compare((lom_random_uniform(2, i) - 0.5) * 9e9);
        compare((lom_random_uniform(3, i) - 0.5) * 4e19);
    }
}

static void conversions_that_are_named(void)
{
    const double infinity = __builtin_inf(), nan = __builtin_nan("");
    CHECK(lom_int_of(nan) == 0 && lom_int64_of(nan) == 0 && lom_count_of(nan, 9) == 0, "NaN");
    CHECK(lom_int_of(infinity) == INT32_MAX && lom_int_of(-infinity) == INT32_MIN, "infinity as int");
    CHECK(lom_int64_of(infinity) == INT64_MAX && lom_int64_of(-infinity) == INT64_MIN, "infinity as int64_t");
    CHECK(lom_count_of(infinity, 9) == 9 && lom_count_of(-infinity, 9) == 0, "infinity as a count");
    CHECK(lom_int_of(-1.9) == -1 && lom_int64_of(-1.9) == -1 && lom_count_of(-1.9, 9) == 0, "below 0");
    CHECK(lom_int_of(1e282) == INT32_MAX && lom_int_of((double)3e38f) == INT32_MAX, "large");
}

int main(int argc, char **argv)
{
    RUN(conversions_that_are_named);
    RUN(conversions_at_edges);
    RUN(conversions_anywhere);
    return check_result();
}
