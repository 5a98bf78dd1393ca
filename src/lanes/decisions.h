/* Questions that are asked once for all lanes, and fractions, where a vector between a comparison and its mask register
 * costs: gcc makes one of every comparison at 16 lanes. */
#ifndef LOM_LANES_DECISIONS_H
#define LOM_LANES_DECISIONS_H

#include <lom/lanes.h>

LOM_INLINE bool lom_defined_any_positive(lom_float x)
{
    return lom_any(x > 0.0f);
}

LOM_INLINE bool lom_defined_all_equal(lom_int x, int32_t y)
{
    return lom_all(x == lom_splat_int(y));
}

/* x - floor(x), and 0 where that rounds to 1 or is no number. */
LOM_INLINE lom_float lom_defined_repeated(lom_float x)
{
    lom_float c = x - lom_floor(x);
    return lom_select(c < 1.0f, c, (lom_float){ 0 });
}

#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES

LOM_INLINE bool lom_any_positive(lom_float x)
{
    return _mm512_cmp_ps_mask((__m512)x, _mm512_setzero_ps(), _CMP_GT_OQ) != 0;
}

LOM_INLINE bool lom_all_equal(lom_int x, int32_t y)
{
    return _mm512_cmpneq_epi32_mask((__m512i)x, _mm512_set1_epi32(y)) == 0;
}

/* A table of what numbers become by their kinds, four bits each: 8, which is 0, of either NaN and of 1; 0, nothing else,
 * of all others. */
LOM_INLINE lom_float lom_repeated(lom_float x)
{
    const __m512 c = (__m512)(x - lom_floor(x));
    return (lom_float)_mm512_fixupimm_ps(c, c, _mm512_set1_epi32(0x8088), 0);
}

#else

LOM_INLINE bool lom_any_positive(lom_float x)
{
    return lom_defined_any_positive(x);
}

LOM_INLINE bool lom_all_equal(lom_int x, int32_t y)
{
    return lom_defined_all_equal(x, y);
}

LOM_INLINE lom_float lom_repeated(lom_float x)
{
    return lom_defined_repeated(x);
}

#endif

#endif
