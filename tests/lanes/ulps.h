/* Lane functions behind pointers, and how far their results are from double ones, in ulps of float. */
#ifndef LOM_TESTS_ULPS_H
#define LOM_TESTS_ULPS_H

#include <lom/lanes_mathematics.h>

#include <math.h>
#include <stdlib.h>

typedef void unary_lanes(lom_float *result, const lom_float *x);
typedef void binary_lanes(lom_float *result, const lom_float *x, const lom_float *y);

/* The functions of one argument in lom/lanes_mathematics.h. */
#define UNARY(X) X(exp) X(exp2) X(expm1) X(tanh) X(log) X(log2) X(sin) X(cos) X(tan) X(asin) X(acos) X(atan)
#define WRAP(name)                                                                                                     \
    static __attribute__((noinline)) void lanes_##name(lom_float *result, const lom_float *x)                          \
    {                                                                                                                  \
        *result = lom_##name(*x);                                                                                      \
    }
UNARY(WRAP)

enum { QUIET_NAN = 0x7fc00000 };

static inline bool every_float_is_visited(void)
{
    const char *exhaustive = getenv("LOM_EXHAUSTIVE");
    return exhaustive != NULL && exhaustive[0] == '1';
}

static inline float float_of(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline uint32_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* The distance of got from want in ulps of float at want; 2^128 rounds to infinity as IEEE 754 says. A wrong sign of
 * zero or a NaN with other bits is infinitely wrong. */
static inline double error_in_ulps(float got, double want)
{
    if (isnan(want))
        return bits_of(got) == QUIET_NAN ? 0 : INFINITY;
    float rounded = (float)want;
    if (isnan(got) || (signbit(got) != 0) != (signbit(want) != 0))
        return INFINITY;
    if (isinf(got) || isinf(rounded))
        return got == rounded || fabs(want) >= 0x1.fffffep127 ? 0 : INFINITY;
    uint64_t bits;
    memcpy(&bits, &want, sizeof bits);
    int exponent = (int)(bits >> 52 & 2047) - 1023;
    bits = (uint64_t)((exponent < -126 ? -126 : exponent) - 23 + 1023) << 52; /* the ulp */
    double ulp;
    memcpy(&ulp, &bits, sizeof ulp);
    return fabs(got - want) / ulp;
}

#endif
