/* Two signed 16-bit numbers a lane, and sums of their products: where factors are that small, one instruction on
 * processors whose baseline has none for products of 32 bits. */
#ifndef LOM_LANES_PAIR_PRODUCTS_H
#define LOM_LANES_PAIR_PRODUCTS_H

#include <lom/lanes.h>

/* low and high, each within int16_t. */
LOM_INLINE lom_int lom_make_pair(lom_int low, lom_int high)
{
    return (low & 0xffff) | high << 16;
}

/* low(a) low(b) + high(a) high(b); wraps where all four are -32768. */
LOM_INLINE lom_int lom_defined_dot_pairs(lom_int a, lom_int b)
{
    return (a << 16 >> 16) * (b << 16 >> 16) + (a >> 16) * (b >> 16);
}

LOM_INLINE lom_int lom_dot_pairs(lom_int a, lom_int b)
{
#if !defined __x86_64__ || defined LOM_NO_OVERRIDES
    return lom_defined_dot_pairs(a, b);
#elif LOM_LANES == 4
    return (lom_int)_mm_madd_epi16((__m128i)a, (__m128i)b);
#elif LOM_LANES == 8 && defined __AVX2__
    return (lom_int)_mm256_madd_epi16((__m256i)a, (__m256i)b);
#elif defined LOM_HAS_AVX512
    return (lom_int)_mm512_madd_epi16((__m512i)a, (__m512i)b);
#else
    return lom_defined_dot_pairs(a, b);
#endif
}

#endif
