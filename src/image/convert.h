/* One number from and to the stored forms: unsigned normalised, sRGB, half. Each conversion is correctly rounded (to
 * nearest, ties to even) for every input; NaN becomes 0 where the form has no NaN, infinities clamp, -0 becomes 0. */
#ifndef LOM_IMAGE_CONVERT_H
#define LOM_IMAGE_CONVERT_H

#include <lom/base.h>

#include <string.h>

enum { LOM_SRGB_BUCKETS = 13 * 128 };    /* 13 octaves below 1, 128 each */
extern const float lom_srgb_linear[256]; /* see srgb_tables.c */
extern const uint32_t lom_srgb_codes[LOM_SRGB_BUCKETS];

static inline uint32_t lom_bits_of_float(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float lom_float_of_bits(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* x clamped to [0, 1]; 0 for NaN and -0. */
static inline double lom_unit_of(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

/* round(x * largest) for x clamped to [0, 1]; largest is 2^n - 1, at most 2^24 - 1. The product of a float (24 bits)
 * and largest is exact in double, and so is its sum with 1/2 wherever the sum can reach an integer. The only tie is
 * x = 1/2 (k + 1/2 = x * largest asks for an odd divisor of 2 x), which rounds up to the even 2^(n-1). */
static inline uint32_t lom_unorm_of(double x, uint32_t largest)
{
    return (uint32_t)lom_count_of(lom_unit_of(x) * largest + 0.5, largest);
}

/* The sRGB code of linear light; correctly rounded for every float. */
static inline uint8_t lom_srgb8_of(float x)
{
    const float low = 0x1p-13f, high = 0x1.fffffep-1f; /* codes 0 and 255 */
    float bounded = x > low ? (x < high ? x : high) : low;
    uint32_t bits = lom_bits_of_float(bounded);
    uint32_t entry = lom_srgb_codes[(bits >> 16) - (114u << 7)];
    return (uint8_t)((entry + (bits & 0xffff)) >> 16);
}

/* The half nearest to x: 65520 and above is infinity (IEEE 754), NaN is 0x7e00 whatever its sign. */
static inline uint16_t lom_half_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    uint16_t sign = (uint16_t)(bits >> 48 & 0x8000);
    double magnitude = sign != 0 ? -x : x;
    if (x != x)
        return 0x7e00;
    if (magnitude >= 65520)
        return sign | 0x7c00;
    if (magnitude < 0x1p-14) /* the unit of doubles in [2^28, 2^29) is 2^-24, the least half */
        return (uint16_t)(sign | (uint16_t)lom_count_of((magnitude + 0x1p28 - 0x1p28) * 0x1p24, 0x400));
    bits &= INT64_MAX;
    bits += (UINT64_C(1) << 41) - 1 + (bits >> 42 & 1); /* half has 42 bits less: round to nearest even */
    return (uint16_t)(sign | (uint16_t)((bits >> 42) - ((uint64_t)(1023 - 15) << 10)));
}

/* Exact. */
static inline float lom_float_of_half(uint16_t half)
{
    uint32_t exponent = half >> 10 & 31, mantissa = half & 0x3ff, sign = (uint32_t)(half & 0x8000) << 16;
    if (exponent == 31)
        return lom_float_of_bits(sign | 0x7f800000 | mantissa << 13);
    if (exponent == 0)
        return lom_float_of_bits(lom_bits_of_float((float)mantissa * 0x1p-24f) | sign);
    return lom_float_of_bits(sign | (exponent + 112) << 23 | mantissa << 13);
}

#endif
