/* Pairs of words by the processor's own gathers, where they are faster than loads (lom_has_fast_gathers). */
#ifndef LOM_LANES_GATHERS_H
#define LOM_LANES_GATHERS_H

#include <lom/lanes.h>

/* lom_gather_pairs; by gathers if these are asked for and the lanes have them. */
LOM_INLINE void lom_gather_pairs_by(bool gathers, const int32_t *from, lom_int index, lom_int *first, lom_int *second)
{
#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES
    if (gathers) {
        const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
        const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
        /* into zeros, not into whatever a register holds, for which it would wait */
        __m512i zero = _mm512_setzero_si512(), x = (__m512i)index;
        __m512i low = _mm512_mask_i32gather_epi64(zero, 0xff, _mm512_castsi512_si256(x), from, 4);
        __m512i high = _mm512_mask_i32gather_epi64(zero, 0xff, _mm512_extracti64x4_epi64(x, 1), from, 4);
        *first = (lom_int)_mm512_permutex2var_epi32(low, even, high);
        *second = (lom_int)_mm512_permutex2var_epi32(low, odd, high);
        return;
    }
#endif
    (void)gathers;
    lom_gather_pairs(from, index, first, second);
}

#endif
