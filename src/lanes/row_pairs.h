/* Rows of four floats side by side in registers, a row for each lane: register i of four holds the rows of the lanes i,
 * 4 + i, 8 + i ... in its fours of lanes. What is done to every float of a row alike needs no other order, and one
 * transposition at the end makes columns of them. */
#ifndef LOM_LANES_ROW_PAIRS_H
#define LOM_LANES_ROW_PAIRS_H

#include <lom/lanes.h>

/* The numbers of a lane each where rows begin, in memory, from which the machine takes its addresses one by one. */
LOM_INLINE void lom_store_places(int32_t at[LOM_LANES], lom_int index)
{
    lom_store_int(at, index);
    __asm__("" : "+m"(*(int32_t(*)[LOM_LANES])at)); /* gcc would take them out of the register */
}

/* Register i of the rows of four floats from from[at[k]] on, in lane k, and of those that follow them. */
LOM_INLINE void lom_defined_load_row_pairs(const float *from, const int32_t at[LOM_LANES], int i, lom_float *first,
                                           lom_float *second)
{
    lom_float a, b;
    for (int k = 0; k < LOM_LANES; k++) {
        a[k] = from[at[(k & ~3) + i] + (k & 3)];
        b[k] = from[at[(k & ~3) + i] + (k & 3) + 4];
    }
    *first = a;
    *second = b;
}

/* Every lane's number once for each float of its row: register i of four in y[i]. */
LOM_INLINE void lom_defined_spread_to_rows(lom_float x, lom_float y[4])
{
    for (int k = 0; k < 4 * LOM_LANES; k++)
        y[k / LOM_LANES][k % LOM_LANES] = x[(k % LOM_LANES & ~3) + k / LOM_LANES];
}

/* Member c: float c of every lane's row. */
LOM_INLINE lom_float4 lom_defined_columns_of_rows(const lom_float row[4])
{
    lom_float4 x = { { 0 }, { 0 }, { 0 }, { 0 } };
    for (int k = 0; k < LOM_LANES; k++) {
        x.x[k] = row[k & 3][k & ~3];
        x.y[k] = row[k & 3][(k & ~3) + 1];
        x.z[k] = row[k & 3][(k & ~3) + 2];
        x.w[k] = row[k & 3][(k & ~3) + 3];
    }
    return x;
}

#if defined LOM_HAS_AVX512 && !defined LOM_NO_OVERRIDES

/* A pair is one load; two registers of two pairs each are put in order by two shuffles. */
LOM_INLINE void lom_load_row_pairs(const float *from, const int32_t at[LOM_LANES], int i, lom_float *first,
                                   lom_float *second)
{
    __m512 low = _mm512_castps256_ps512(_mm256_loadu_ps(from + at[i]));
    __m512 high = _mm512_castps256_ps512(_mm256_loadu_ps(from + at[8 + i]));
    low = _mm512_insertf32x8(low, _mm256_loadu_ps(from + at[4 + i]), 1);
    high = _mm512_insertf32x8(high, _mm256_loadu_ps(from + at[12 + i]), 1);
    *first = (lom_float)_mm512_shuffle_f32x4(low, high, _MM_SHUFFLE(2, 0, 2, 0));
    *second = (lom_float)_mm512_shuffle_f32x4(low, high, _MM_SHUFFLE(3, 1, 3, 1));
}

LOM_INLINE void lom_spread_to_rows(lom_float x, lom_float y[4])
{
    y[0] = (lom_float)_mm512_permute_ps((__m512)x, 0x00);
    y[1] = (lom_float)_mm512_permute_ps((__m512)x, 0x55);
    y[2] = (lom_float)_mm512_permute_ps((__m512)x, 0xaa);
    y[3] = (lom_float)_mm512_permute_ps((__m512)x, 0xff);
}

LOM_INLINE lom_float4 lom_columns_of_rows(const lom_float row[4])
{
    __m512 t[4] = { (__m512)row[0], (__m512)row[1], (__m512)row[2], (__m512)row[3] };
    return lom_transpose_quarters(t);
}

#elif LOM_LANES == 8 && defined __AVX2__ && !defined LOM_NO_OVERRIDES

LOM_INLINE void lom_load_row_pairs(const float *from, const int32_t at[LOM_LANES], int i, lom_float *first,
                                   lom_float *second)
{
    __m256 low = _mm256_loadu_ps(from + at[i]), high = _mm256_loadu_ps(from + at[4 + i]);
    *first = (lom_float)_mm256_permute2f128_ps(low, high, 0x20);
    *second = (lom_float)_mm256_permute2f128_ps(low, high, 0x31);
}

LOM_INLINE void lom_spread_to_rows(lom_float x, lom_float y[4])
{
    y[0] = (lom_float)_mm256_permute_ps((__m256)x, 0x00);
    y[1] = (lom_float)_mm256_permute_ps((__m256)x, 0x55);
    y[2] = (lom_float)_mm256_permute_ps((__m256)x, 0xaa);
    y[3] = (lom_float)_mm256_permute_ps((__m256)x, 0xff);
}

LOM_INLINE lom_float4 lom_columns_of_rows(const lom_float row[4])
{
    __m256 t[4] = { (__m256)row[0], (__m256)row[1], (__m256)row[2], (__m256)row[3] };
    return lom_transpose_halves(t);
}

#elif LOM_LANES == 4 && defined __x86_64__ && !defined LOM_NO_OVERRIDES

LOM_INLINE void lom_load_row_pairs(const float *from, const int32_t at[LOM_LANES], int i, lom_float *first,
                                   lom_float *second)
{
    *first = lom_load(from + at[i]);
    *second = lom_load(from + at[i] + 4);
}

LOM_INLINE void lom_spread_to_rows(lom_float x, lom_float y[4])
{
    y[0] = (lom_float)_mm_shuffle_ps((__m128)x, (__m128)x, 0x00);
    y[1] = (lom_float)_mm_shuffle_ps((__m128)x, (__m128)x, 0x55);
    y[2] = (lom_float)_mm_shuffle_ps((__m128)x, (__m128)x, 0xaa);
    y[3] = (lom_float)_mm_shuffle_ps((__m128)x, (__m128)x, 0xff);
}

LOM_INLINE lom_float4 lom_columns_of_rows(const lom_float row[4])
{
    __m128 a = (__m128)row[0], b = (__m128)row[1], c = (__m128)row[2], d = (__m128)row[3];
    _MM_TRANSPOSE4_PS(a, b, c, d);
    lom_float4 columns = { (lom_float)a, (lom_float)b, (lom_float)c, (lom_float)d };
    return columns;
}

#else

LOM_INLINE void lom_load_row_pairs(const float *from, const int32_t at[LOM_LANES], int i, lom_float *first,
                                   lom_float *second)
{
    lom_defined_load_row_pairs(from, at, i, first, second);
}

LOM_INLINE void lom_spread_to_rows(lom_float x, lom_float y[4])
{
    lom_defined_spread_to_rows(x, y);
}

LOM_INLINE lom_float4 lom_columns_of_rows(const lom_float row[4])
{
    return lom_defined_columns_of_rows(row);
}

#endif

#endif
