/* Mixes of bytes that are numbers of 15 bits only on the way (lom/fixed.h). */
#ifndef LOM_LANES_MIX_BYTES_H
#define LOM_LANES_MIX_BYTES_H

#include <lom/fixed.h>

/* lom_mix_pairs of the first and third bytes of two words, and of the second and fourth. */
LOM_INLINE lom_pairs lom_defined_mix_even_bytes(lom_int a, lom_int b, lom_pairs negated_weight)
{
    return lom_mix_pairs(lom_even_bytes(a), lom_even_bytes(b), negated_weight);
}

LOM_INLINE lom_pairs lom_defined_mix_odd_bytes(lom_int a, lom_int b, lom_pairs negated_weight)
{
    return lom_mix_pairs(lom_odd_bytes(a), lom_odd_bytes(b), negated_weight);
}

#if ((LOM_LANES == 8 && defined __AVX2__) || defined LOM_HAS_AVX512) && !defined LOM_NO_OVERRIDES

/* Products of two bytes a half with -128 and 0, and their sum, are one instruction in place of a shift and an and;
 * +128 is no signed byte. With A = -128 a and B = -128 b a mix is multiply(B - A, weight) - A. */
LOM_INLINE lom_pairs lom_negated_bytes(lom_int word, int16_t factors)
{
#if LOM_LANES == 16
    return (lom_pairs)_mm512_maddubs_epi16((__m512i)word, _mm512_set1_epi16(factors));
#else
    return (lom_pairs)_mm256_maddubs_epi16((__m256i)word, _mm256_set1_epi16(factors));
#endif
}

LOM_INLINE lom_pairs lom_mix_negated(lom_pairs a, lom_pairs b, lom_pairs negated_weight)
{
    return lom_multiply_pairs(b - a, negated_weight) - a;
}

LOM_INLINE lom_pairs lom_mix_even_bytes(lom_int a, lom_int b, lom_pairs negated_weight)
{
    return lom_mix_negated(lom_negated_bytes(a, 0x0080), lom_negated_bytes(b, 0x0080), negated_weight);
}

LOM_INLINE lom_pairs lom_mix_odd_bytes(lom_int a, lom_int b, lom_pairs negated_weight)
{
    return lom_mix_negated(lom_negated_bytes(a, INT16_MIN), lom_negated_bytes(b, INT16_MIN), negated_weight);
}

#else

LOM_INLINE lom_pairs lom_mix_even_bytes(lom_int a, lom_int b, lom_pairs negated_weight)
{
    return lom_defined_mix_even_bytes(a, b, negated_weight);
}

LOM_INLINE lom_pairs lom_mix_odd_bytes(lom_int a, lom_int b, lom_pairs negated_weight)
{
    return lom_defined_mix_odd_bytes(a, b, negated_weight);
}

#endif

#endif
