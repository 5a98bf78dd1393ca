/* Overrides of the lane operations by WebAssembly's instructions for vectors of 128 bits, for 4 lanes; included by
 * lom/lanes.h only. Every function here gives, bit for bit, what lom_defined_* of lom/lanes.h gives (the test of the
 * operations runs under node, tests/house/test_wasm.sh). Chosen where clang does not find the instruction by itself. */
#include <lom/lanes.h> /* before the guard, so that it includes the rest of this file, whichever of the two comes first */
#ifndef LOM_LANES_WASM_H
#define LOM_LANES_WASM_H

#if LOM_LANES == 4
#include <wasm_simd128.h>

#define LOM_OVERRIDES_ARITHMETIC
#define LOM_OVERRIDES_ROUNDING
#define LOM_OVERRIDES_PAIRS
#define LOM_OVERRIDES_TO_DOUBLE

LOM_INLINE lom_float lom_select(lom_mask mask, lom_float a, lom_float b)
{
    return (lom_float)wasm_v128_bitselect((v128_t)a, (v128_t)b, (v128_t)mask);
}

LOM_INLINE lom_int lom_select_int(lom_mask mask, lom_int a, lom_int b)
{
    return (lom_int)wasm_v128_bitselect((v128_t)a, (v128_t)b, (v128_t)mask);
}

/* pmin(x, y) is y < x ? y : x, pmax(x, y) is x < y ? y : x. */
LOM_INLINE lom_float lom_min(lom_float a, lom_float b)
{
    return (lom_float)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}

LOM_INLINE lom_float lom_max(lom_float a, lom_float b)
{
    return (lom_float)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}

LOM_INLINE lom_float lom_sqrt(lom_float x)
{
    return (lom_float)wasm_f32x4_sqrt((v128_t)x);
}

/* The instruction gives 0 for NaN and 2^31 - 1 above; the largest float below 2^31 is what lanes stop at. */
LOM_INLINE lom_int lom_to_int(lom_float x)
{
    return (lom_int)wasm_i32x4_trunc_sat_f32x4(wasm_f32x4_pmin((v128_t)x, wasm_f32x4_const_splat(2147483520.0f)));
}

LOM_INLINE lom_double lom_to_double(lom_int x)
{
    return __builtin_convertvector(x, lom_double);
}

LOM_INLINE uint32_t lom_bits(lom_mask mask)
{
    return wasm_i32x4_bitmask((v128_t)mask);
}

/* The instruction saturates -1 times -1, whose product here is -1: all bits of 0x7fff are turned over there. */
LOM_INLINE lom_pairs lom_multiply_pairs(lom_pairs x, lom_pairs y)
{
    v128_t a = (v128_t)x, b = (v128_t)y, least = wasm_i16x8_const_splat(INT16_MIN);
    v128_t both = wasm_v128_and(wasm_i16x8_eq(a, least), wasm_i16x8_eq(b, least));
    return (lom_pairs)wasm_v128_xor(wasm_i16x8_q15mulr_sat(a, b), both);
}

LOM_INLINE lom_float lom_floor(lom_float x)
{
    return (lom_float)wasm_f32x4_floor((v128_t)x);
}

LOM_INLINE lom_float lom_round(lom_float x)
{
    return (lom_float)wasm_f32x4_nearest((v128_t)x);
}

LOM_INLINE void lom_gather_pairs(const int32_t *from, lom_int index, lom_int *first, lom_int *second)
{
    v128_t low = wasm_v128_load64_lane(from + index[1], wasm_v128_load64_zero(from + index[0]), 1);
    v128_t high = wasm_v128_load64_lane(from + index[3], wasm_v128_load64_zero(from + index[2]), 1);
    *first = (lom_int)wasm_i32x4_shuffle(low, high, 0, 2, 4, 6);
    *second = (lom_int)wasm_i32x4_shuffle(low, high, 1, 3, 5, 7);
}

LOM_INLINE lom_float4 lom_transpose_rows(v128_t a, v128_t b, v128_t c, v128_t d)
{
    v128_t low = wasm_i32x4_shuffle(a, b, 0, 4, 1, 5), high = wasm_i32x4_shuffle(a, b, 2, 6, 3, 7);
    v128_t next_low = wasm_i32x4_shuffle(c, d, 0, 4, 1, 5), next_high = wasm_i32x4_shuffle(c, d, 2, 6, 3, 7);
    lom_float4 columns = { (lom_float)wasm_i64x2_shuffle(low, next_low, 0, 2),
                           (lom_float)wasm_i64x2_shuffle(low, next_low, 1, 3),
                           (lom_float)wasm_i64x2_shuffle(high, next_high, 0, 2),
                           (lom_float)wasm_i64x2_shuffle(high, next_high, 1, 3) };
    return columns;
}

LOM_INLINE lom_float4 lom_load_rows(const float *const rows[LOM_LANES], size_t offset)
{
    return lom_transpose_rows(wasm_v128_load(rows[0] + offset), wasm_v128_load(rows[1] + offset),
                              wasm_v128_load(rows[2] + offset), wasm_v128_load(rows[3] + offset));
}

LOM_INLINE lom_float4 lom_gather_rows(const float *from, lom_int index)
{
    const float *rows[4] = { from + index[0], from + index[1], from + index[2], from + index[3] };
    return lom_load_rows(rows, 0);
}

LOM_INLINE void lom_scatter_rows(float *to, lom_int index, lom_float4 x)
{
    lom_float4 rows = lom_transpose_rows((v128_t)x.x, (v128_t)x.y, (v128_t)x.z, (v128_t)x.w);
    wasm_v128_store(to + index[0], (v128_t)rows.x);
    wasm_v128_store(to + index[1], (v128_t)rows.y);
    wasm_v128_store(to + index[2], (v128_t)rows.z);
    wasm_v128_store(to + index[3], (v128_t)rows.w);
}

#endif

#endif
