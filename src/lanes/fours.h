/* Four words from each of several places, and lanes of two registers by their numbers: what lanes that share a few rows of
 * memory read of them. */
#ifndef LOM_LANES_FOURS_H
#define LOM_LANES_FOURS_H

#include <lom/lanes.h>

/* Four words from each place, one after the other: lane 4 k + i is from[k][i]. */
LOM_INLINE lom_int lom_defined_load_fours(const int32_t *const from[LOM_LANES / 4])
{
    lom_int x;
    for (int i = 0; i < LOM_LANES; i++)
        x[i] = from[i / 4][i % 4];
    return x;
}

LOM_INLINE lom_int lom_load_fours(const int32_t *const from[LOM_LANES / 4])
{
#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES
    __m128i t[4];
    for (int i = 0; i < 4; i++)
        t[i] = _mm_loadu_si128((const __m128i *)(const void *)from[i]);
    __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256(t[0]), t[1], 1);
    __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256(t[2]), t[3], 1);
    return (lom_int)_mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
#else
    return lom_defined_load_fours(from);
#endif
}

/* Word k of `count` in every lane of x[k]. */
LOM_INLINE void lom_defined_spread(const int32_t *from, int count, lom_int *x)
{
    for (int k = 0; k < count; k++)
        x[k] = lom_splat_int(from[k]);
}

/* The same of words that were just computed, a multiple of 4: vectors are filled from memory while the arithmetic goes on;
 * with 4 lanes by shuffles. */
LOM_INLINE void lom_spread(int32_t *from, int count, lom_int *x)
{
#if LOM_LANES == 4 && defined __x86_64__ && !defined LOM_NO_OVERRIDES
    for (int k = 0; k < count; k += 4) {
        __m128i four = _mm_loadu_si128((const __m128i *)(const void *)(from + k));
        x[k] = (lom_int)_mm_shuffle_epi32(four, 0x00);
        x[k + 1] = (lom_int)_mm_shuffle_epi32(four, 0x55);
        x[k + 2] = (lom_int)_mm_shuffle_epi32(four, 0xaa);
        x[k + 3] = (lom_int)_mm_shuffle_epi32(four, 0xff);
    }
#else
    __asm__("" : "+m"(*(int32_t(*)[count])from)); /* gcc would take them out of registers one by one */
    lom_defined_spread(from, count, x);
#endif
}

/* Lanes which[i] of low and, counted on, of high; 0 <= which[i] < 2 LOM_LANES. */
LOM_INLINE lom_int lom_defined_permute_two(lom_int low, lom_int high, lom_int which)
{
    lom_int result;
    for (int i = 0; i < LOM_LANES; i++)
        result[i] = which[i] < LOM_LANES ? low[which[i]] : high[which[i] - LOM_LANES];
    return result;
}

LOM_INLINE lom_int lom_permute_two(lom_int low, lom_int high, lom_int which)
{
#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES
    return (lom_int)_mm512_permutex2var_epi32((__m512i)low, (__m512i)which, (__m512i)high);
#else
    return lom_defined_permute_two(low, high, which);
#endif
}

#endif
