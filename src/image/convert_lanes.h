/* The conversions of convert.h over lanes: the same results for every float, by operations that exist at every width.
 * Derivations stand at each function; tests/image/test_convert_lanes.wide.c compares all 2^32 floats. */
#ifndef LOM_IMAGE_CONVERT_LANES_H
#define LOM_IMAGE_CONVERT_LANES_H

#include <lom/lanes.h>

#include "convert.h"

/* round(c * largest) of c in [0, 1], for largest = 255, 65535 or 16777215 = m - 1 with m a power of two.
 *
 * q = trunc(fl(c largest)) is the result or one less, or (product rounded up across an integer) already the result.
 * The residual c largest - q = (m c - q) - c decides: m c is exact; a = m c - q is exact, because it is a multiple of
 * the unit of m c (or of 1) and not larger than a few of it; where a is in [1/4, 1] the difference a - 1/2 is exact
 * (Sterbenz), elsewhere its rounding cannot cross c. So (a - 1/2 >= c) is exactly "residual >= 1/2".
 *
 * AVX-512 rounds a product towards zero by itself, which crosses no float: p is at least k + 1/2 exactly where c largest
 * is, and so is the sum at least k + 1. Only above 2^23 is k + 1/2 no float; there, with largest = 2^24 - 1, c largest is
 * m c - c, an integer less a c above 1/2, whose rounding is its truncation. */
LOM_INLINE lom_int lom_unorm_of_unit_lanes(lom_float c, float largest)
{
#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES
    enum { TO_ZERO = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC };
    __m512 p = _mm512_mul_round_ps((__m512)c, _mm512_set1_ps(largest), TO_ZERO);
    return lom_bounded_to_int((lom_float)_mm512_add_round_ps(p, _mm512_set1_ps(0.5f), TO_ZERO));
#else
    lom_int q = lom_bounded_to_int(c * largest);
    lom_float a = c * (largest + 1.0f) - lom_to_float(q);
    return q - (a - 0.5f >= c);
#endif
}

/* The same of x clamped to [0, 1], NaN 0. */
LOM_INLINE lom_int lom_unorm_of_lanes(lom_float x, float largest)
{
    return lom_unorm_of_unit_lanes(lom_saturate(x), largest);
}

/* The quotient v / largest, correctly rounded; 0 <= v <= largest <= 2^24. */
LOM_INLINE lom_float lom_float_of_unorm_lanes(lom_int v, float largest)
{
    return lom_to_float(v) / largest;
}

/* The sRGB code (0..255) of linear light, correctly rounded; NaN 0. See srgb_tables.c. */
LOM_INLINE lom_int lom_srgb8_of_lanes(lom_float x)
{
    lom_int bits = lom_as_int(lom_clamp(x, lom_splat(0x1p-13f), lom_splat(0x1.fffffep-1f)));
    lom_int entry = lom_gather_int((const int32_t *)lom_srgb_codes, (bits >> 16) - (114 << 7));
    return (entry + (bits & 0xffff)) >> 16;
}

/* Linear light of sRGB codes 0..255, correctly rounded. */
LOM_INLINE lom_float lom_float_of_srgb8_lanes(lom_int code)
{
    return lom_gather(lom_srgb_linear, code);
}

/* Nearest half (ties to even) in the low 16 bits; 65520 and above infinity, NaN 0x7e00. A magnitude below 2^-14 is
 * rounded by adding 1/2, whose unit is 2^-24, the least half. */
LOM_INLINE lom_int lom_half_of_lanes(lom_float x)
{
    lom_int sign = (lom_as_int(x) >> 16) & 0x8000;
    lom_float magnitude = lom_abs(x);
    lom_uint bits = (lom_uint)magnitude; /* unsigned: a NaN's bits carry into the sign */
    lom_int normal = (lom_int)((bits + 0xfff + ((bits >> 13) & 1)) >> 13) - (112 << 10);
    lom_int small = lom_as_int(magnitude + 0.5f) - lom_as_int(lom_splat(0.5f));
    lom_int half = lom_select_int(magnitude < 0x1p-14f, small, normal);
    half = lom_select_int(magnitude >= 65520.0f, lom_splat_int(0x7c00), half) | sign;
    return lom_select_int(x == x, half, lom_splat_int(0x7e00));
}

/* Exact, of the low 16 bits (the others are 0): the exponent field is moved and its bias corrected by a product with a
 * power of two, which also normalises denormals. */
LOM_INLINE lom_float lom_float_of_half_lanes(lom_int half)
{
    lom_int magnitude = (half & 0x7fff) << 13;
    lom_float scaled = lom_as_float(magnitude) * 0x1p112f;
    lom_int special = (lom_int)(magnitude >= (0x7c00 << 13)) & 0x7f800000;
    lom_int sign = half << 16 & lom_splat_int(INT32_MIN);
    return lom_as_float(lom_as_int(scaled) | special | sign);
}

#endif
