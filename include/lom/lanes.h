/* lom/lanes.h - lanes: LOM_LANES values side by side, and the one meaning of every operation on them.
 *
 * lom_float, lom_int and lom_uint are GNU C vectors, so + - * / & | ^ ~ << >> and unary - work on them as they are:
 * arithmetic wraps for integers and is correctly rounded for floats. A comparison of floats or ints gives a lom_mask:
 * -1 (all bits) in a lane where it holds, 0 elsewhere; any comparison with NaN except != is false. There is no ?: on
 * vectors: use lom_select.
 *
 * The functions named lom_defined_* are the specification: plain C, the same on every machine. Where a measurement says
 * that an instruction does the same faster, lom/lanes_x86.h or lanes_wasm.h overrides the name without _defined; a test
 * holds every override to its definition bit for bit. Everything here is inline: vectors cross object files by pointer only.
 *
 * LOM_LANES is 4, 8 or 16 and comes from the compiler's command line (4 when it does not).
 */
#ifndef LOM_LANES_H
#define LOM_LANES_H

#include <lom/base.h>

#include <string.h>

#ifndef LOM_LANES
#define LOM_LANES 4
#endif
#if LOM_LANES != 4 && LOM_LANES != 8 && LOM_LANES != 16
#error "LOM_LANES is 4, 8 or 16."
#endif
#ifndef LOM_VARIANT
#define LOM_VARIANT 4
#endif
#define LOM_PASTE_EXPANDED(name, variant) name##_##variant
#define LOM_PASTE(name, variant)          LOM_PASTE_EXPANDED(name, variant)
/* The name of a function that exists once for each way lanes are built: LOM_WIDE(f) is f_4, f_8, f_16, f_8_plain ... */
#define LOM_WIDE(name) LOM_PASTE(name, LOM_VARIANT)
/* The place of each variant in a table of them: 4, 8, 16 lanes, then 8 and 16 lowered; last the 4 lanes that also record
 * what they do (-DLOM_RECORD), which draw nothing but watched passes (lom/record.h). */
enum {
    LOM_SLOT_4 = 0,
    LOM_SLOT_8,
    LOM_SLOT_16,
    LOM_SLOT_8_plain,
    LOM_SLOT_16_plain,
    LOM_SLOT_4_recorded,
    LOM_VARIANTS
};
/* LOM_EACH_VARIANT(X, name) is X(name, variant) for each way lanes are built: 4, 8 and 16, and on x86-64, where the 8
 * and 16 are of AVX2 and AVX-512, both once more lowered to the baseline. A build with fewer defines its own (make
 * VARIANTS="4 8"); 4 is always of them. */
#ifndef LOM_EACH_VARIANT
#ifdef __x86_64__
#define LOM_EACH_VARIANT(X, name) X(name, 4) X(name, 8) X(name, 16) X(name, 8_plain) X(name, 16_plain)
#else
#define LOM_EACH_VARIANT(X, name) X(name, 4) X(name, 8) X(name, 16)
#endif
#endif

/* Lowered lanes (LOM_LOWERED), which the machine has no vectors for, are many instructions an operation, so there the
 * compiler weighs every copy: a program without it would be twice the size (bench/results/limits.md). */
#ifdef LOM_LOWERED
#define LOM_INLINE static inline __attribute__((unused))
#else
#define LOM_INLINE static inline __attribute__((always_inline, unused))
#endif

/* Vectors wider than the machine's are passed between functions in ways that compilers have changed; here all are
 * inline. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

typedef float lom_float __attribute__((vector_size(LOM_LANES * 4)));
typedef int32_t lom_int __attribute__((vector_size(LOM_LANES * 4)));
typedef uint32_t lom_uint __attribute__((vector_size(LOM_LANES * 4)));
typedef double lom_double __attribute__((vector_size(LOM_LANES * 8)));
typedef lom_int lom_mask;
typedef int16_t lom_pairs __attribute__((vector_size(LOM_LANES * 4))); /* two numbers a lane, the halves of its word */

typedef struct lom_float2 {
    lom_float x, y;
} lom_float2;
typedef struct lom_float3 {
    lom_float x, y, z;
} lom_float3;
typedef struct lom_float4 {
    lom_float x, y, z, w;
} lom_float4;

/* ---- making vectors ---- */

LOM_INLINE lom_float lom_splat(float value)
{
    lom_float zero = { 0 };
    return value - zero; /* value - 0 keeps -0 and NaN */
}

LOM_INLINE lom_int lom_splat_int(int32_t value)
{
    lom_int zero = { 0 };
    return value - zero;
}

LOM_INLINE lom_uint lom_splat_uint(uint32_t value)
{
    lom_uint zero = { 0 };
    return value - zero;
}

/* 0, 1, 2 ... LOM_LANES - 1 */
LOM_INLINE lom_int lom_lane_index(void)
{
#if LOM_LANES == 4
    lom_int index = { 0, 1, 2, 3 };
#elif LOM_LANES == 8
    lom_int index = { 0, 1, 2, 3, 4, 5, 6, 7 };
#else
    lom_int index = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 };
#endif
    return index;
}

/* The same bits as another type. */
LOM_INLINE lom_int lom_as_int(lom_float x)
{
    return (lom_int)x;
}

LOM_INLINE lom_float lom_as_float(lom_int x)
{
    return (lom_float)x;
}

/* ---- memory: unaligned, LOM_LANES consecutive values ---- */

LOM_INLINE lom_float lom_load(const float *from)
{
    lom_float x;
    memcpy(&x, from, sizeof x);
    return x;
}

LOM_INLINE lom_int lom_load_int(const int32_t *from)
{
    lom_int x;
    memcpy(&x, from, sizeof x);
    return x;
}

LOM_INLINE void lom_store(float *to, lom_float x)
{
    memcpy(to, &x, sizeof x);
}

LOM_INLINE void lom_store_int(int32_t *to, lom_int x)
{
    memcpy(to, &x, sizeof x);
}

/* ---- definitions ---- */

/* a where the mask is set, b where it is clear: bits are copied, NaN included. */
LOM_INLINE lom_float lom_defined_select(lom_mask mask, lom_float a, lom_float b)
{
    return (lom_float)((mask & (lom_int)a) | (~mask & (lom_int)b));
}

LOM_INLINE lom_int lom_defined_select_int(lom_mask mask, lom_int a, lom_int b)
{
    return (mask & a) | (~mask & b);
}

/* a < b ? a : b, so b when either is NaN and when both are zeros. */
LOM_INLINE lom_float lom_defined_min(lom_float a, lom_float b)
{
    return lom_defined_select(a < b, a, b);
}

/* a > b ? a : b, so b when either is NaN and when both are zeros. */
LOM_INLINE lom_float lom_defined_max(lom_float a, lom_float b)
{
    return lom_defined_select(a > b, a, b);
}

/* Correctly rounded; NaN below 0; -0 of -0. */
LOM_INLINE lom_float lom_defined_sqrt(lom_float x)
{
    lom_float root;
    for (int i = 0; i < LOM_LANES; i++)
        root[i] = __builtin_sqrtf(x[i]);
    return root;
}

/* Towards zero, of what the caller has bounded to [-2147483648, 2147483520]: one instruction, without a result outside.
 */
LOM_INLINE lom_int lom_bounded_to_int(lom_float x)
{
    return __builtin_convertvector(x, lom_int);
}

/* Towards zero; clamped to [-2147483648, 2147483520]; NaN gives 0. */
LOM_INLINE lom_int lom_defined_to_int(lom_float x)
{
    lom_float number = lom_defined_select(x == x, x, lom_splat(0.0f));
    lom_float bounded = lom_defined_min(lom_defined_max(number, lom_splat(-2147483648.0f)), lom_splat(2147483520.0f));
    return lom_bounded_to_int(bounded);
}

/* Correctly rounded. */
LOM_INLINE lom_float lom_to_float(lom_int x)
{
    return __builtin_convertvector(x, lom_float);
}

/* Exact. */
LOM_INLINE lom_double lom_defined_to_double(lom_int x)
{
    lom_double y;
    for (int i = 0; i < LOM_LANES; i++)
        y[i] = x[i];
    return y;
}

/* The largest integer not above x; -0, infinities and NaN as they are. */
LOM_INLINE lom_float lom_defined_floor(lom_float x)
{
    lom_float magnitude = (lom_float)((lom_int)x & 0x7fffffff);
    lom_mask small = magnitude < 8388608.0f; /* larger floats are integers; NaN is not small */
    lom_float whole = lom_to_float(lom_defined_to_int(lom_defined_select(small, x, lom_splat(0.0f))));
    lom_float down = whole - (lom_float)((whole > x) & (lom_int)lom_splat(1.0f));
    lom_int sign = (lom_int)x & INT32_MIN;
    return lom_defined_select(small, (lom_float)((lom_int)down | sign), x);
}

/* To the nearest integer, ties to even; sign kept. */
LOM_INLINE lom_float lom_defined_round(lom_float x)
{
    lom_float magnitude = (lom_float)((lom_int)x & 0x7fffffff);
    lom_mask small = magnitude < 8388608.0f;
    lom_float rounded = (magnitude + 8388608.0f) - 8388608.0f; /* the unit of floats in [2^23, 2^24) is 1 */
    lom_int sign = (lom_int)x & INT32_MIN;
    return lom_defined_select(small, (lom_float)((lom_int)rounded | sign), x);
}

/* Bit i is set when lane i of the mask is. */
LOM_INLINE uint32_t lom_defined_bits(lom_mask mask)
{
    uint32_t bits = 0;
    for (int i = 0; i < LOM_LANES; i++)
        bits |= (uint32_t)(mask[i] & 1) << i;
    return bits;
}

/* (x y + 2^14) >> 15 of each number: the product of two numbers of 15 bits after the point, to nearest, halves up; -1
 * times -1 gives -1. */
LOM_INLINE lom_pairs lom_defined_multiply_pairs(lom_pairs x, lom_pairs y)
{
    lom_int a = (lom_int)x, b = (lom_int)y;
    lom_int low = ((a << 16 >> 16) * (b << 16 >> 16) + 0x4000) >> 15, high = ((a >> 16) * (b >> 16) + 0x4000) >> 15;
    return (lom_pairs)((low & 0xffff) | high << 16);
}

/* The low 16 bits of each lane in both halves. */
LOM_INLINE lom_pairs lom_defined_twice(lom_int x)
{
    return (lom_pairs)((x & 0xffff) | x << 16);
}

/* from[index[i]] in lane i. Every lane is read: indices must be inside. */
LOM_INLINE lom_float lom_defined_gather(const float *from, lom_int index)
{
    lom_float x;
    for (int i = 0; i < LOM_LANES; i++)
        x[i] = from[index[i]];
    return x;
}

LOM_INLINE lom_int lom_defined_gather_int(const int32_t *from, lom_int index)
{
    lom_int x;
    for (int i = 0; i < LOM_LANES; i++)
        x[i] = from[index[i]];
    return x;
}

/* Neighbours: from[index[i]] and from[index[i] + 1] in lane i. */
LOM_INLINE void lom_defined_gather_pairs(const int32_t *from, lom_int index, lom_int *first, lom_int *second)
{
    lom_int a = { 0 }, b = { 0 };
    for (int i = 0; i < LOM_LANES; i++) {
        a[i] = from[index[i]];
        b[i] = from[index[i] + 1];
    }
    *first = a;
    *second = b;
}

/* Four consecutive floats at rows[i] + offset, transposed: lane i of member k is the k-th float of row i. */
LOM_INLINE lom_float4 lom_defined_load_rows(const float *const rows[LOM_LANES], size_t offset)
{
    lom_float4 x = { { 0 }, { 0 }, { 0 }, { 0 } };
    for (int i = 0; i < LOM_LANES; i++) {
        const float *row = rows[i] + offset;
        x.x[i] = row[0];
        x.y[i] = row[1];
        x.z[i] = row[2];
        x.w[i] = row[3];
    }
    return x;
}

/* Four consecutive floats from from[index[i]] on, transposed: lane i of member k is from[index[i] + k]. */
LOM_INLINE lom_float4 lom_defined_gather_rows(const float *from, lom_int index)
{
    lom_float4 x = { { 0 }, { 0 }, { 0 }, { 0 } };
    for (int i = 0; i < LOM_LANES; i++) {
        const float *row = from + index[i];
        x.x[i] = row[0];
        x.y[i] = row[1];
        x.z[i] = row[2];
        x.w[i] = row[3];
    }
    return x;
}

/* The same where lanes share few rows: lane i of member k is from[row[which[i]] + k], which[i] < count <= LOM_LANES.
 * Entries of row up to the next multiple of 4 after count name floats that can be read, too. */
LOM_INLINE lom_float4 lom_defined_pick_rows(const float *from, const int32_t *row, lom_int which)
{
    return lom_defined_gather_rows(from, lom_defined_gather_int(row, which));
}

/* The reverse: to[index[i] + k] from lane i of member k, in the order of the lanes. */
LOM_INLINE void lom_defined_scatter_rows(float *to, lom_int index, lom_float4 x)
{
    for (int i = 0; i < LOM_LANES; i++) {
        float *row = to + index[i];
        row[0] = x.x[i];
        row[1] = x.y[i];
        row[2] = x.z[i];
        row[3] = x.w[i];
    }
}

/* LOM_LANES / 2 values from each of two places, and back. */
LOM_INLINE lom_int lom_defined_load_halves(const int32_t *low, const int32_t *high)
{
    lom_int x = { 0 };
    for (int i = 0; i < LOM_LANES / 2; i++) {
        x[i] = low[i];
        x[i + LOM_LANES / 2] = high[i];
    }
    return x;
}

LOM_INLINE void lom_defined_store_halves(int32_t *low, int32_t *high, lom_int x)
{
    for (int i = 0; i < LOM_LANES / 2; i++) {
        low[i] = x[i];
        high[i] = x[i + LOM_LANES / 2];
    }
}

/* 2 LOM_LANES consecutive values as pairs: the first, third, fifth ... pair, and the others. */
LOM_INLINE void lom_defined_split_pairs(const int32_t *from, lom_int *even, lom_int *odd)
{
    lom_int a = { 0 }, b = { 0 };
    for (int i = 0; i < LOM_LANES; i++) {
        a[i] = from[2 * i - (i & 1)];
        b[i] = from[2 * i - (i & 1) + 2];
    }
    *even = a;
    *odd = b;
}

/* A store of what nobody reads soon: past the caches, where the machine can. `to` is aligned to the vector; another
 * thread sees it after lom_end_streams. */
LOM_INLINE void lom_defined_stream_int(int32_t *to, lom_int x)
{
    lom_store_int(to, x);
}

/* The lanes whose mask is set, side by side from `to` on, in lane order; up to LOM_LANES floats are written, those
 * after the last set lane with unspecified values. */
LOM_INLINE void lom_defined_compress(float *to, lom_mask mask, lom_float x)
{
    int count = 0;
    for (int i = 0; i < LOM_LANES; i++) {
        to[count] = x[i];
        count -= mask[i];
    }
}

/* x[which[i]] in lane i; 0 <= which[i] < LOM_LANES. */
LOM_INLINE lom_float lom_defined_permute(lom_float x, lom_int which)
{
    lom_float result;
    for (int i = 0; i < LOM_LANES; i++)
        result[i] = x[which[i]];
    return result;
}

/* ---- overrides: the same values by an instruction ---- */

#if defined __x86_64__ && !defined LOM_NO_OVERRIDES
#include <lom/lanes_x86.h>
#elif defined __wasm_simd128__ && !defined LOM_NO_OVERRIDES
#include <lom/lanes_wasm.h>
#endif

#ifndef LOM_OVERRIDES_ARITHMETIC
LOM_INLINE lom_float lom_select(lom_mask mask, lom_float a, lom_float b)
{
    return lom_defined_select(mask, a, b);
}
LOM_INLINE lom_int lom_select_int(lom_mask mask, lom_int a, lom_int b)
{
    return lom_defined_select_int(mask, a, b);
}
LOM_INLINE lom_float lom_min(lom_float a, lom_float b)
{
    return lom_defined_min(a, b);
}
LOM_INLINE lom_float lom_max(lom_float a, lom_float b)
{
    return lom_defined_max(a, b);
}
LOM_INLINE lom_float lom_sqrt(lom_float x)
{
    return lom_defined_sqrt(x);
}
LOM_INLINE lom_int lom_to_int(lom_float x)
{
    return lom_defined_to_int(x);
}
LOM_INLINE uint32_t lom_bits(lom_mask mask)
{
    return lom_defined_bits(mask);
}
LOM_INLINE lom_pairs lom_multiply_pairs(lom_pairs x, lom_pairs y)
{
    return lom_defined_multiply_pairs(x, y);
}
LOM_INLINE lom_float4 lom_load_rows(const float *const rows[LOM_LANES], size_t offset)
{
    return lom_defined_load_rows(rows, offset);
}
LOM_INLINE lom_float4 lom_gather_rows(const float *from, lom_int index)
{
    return lom_defined_gather_rows(from, index);
}
LOM_INLINE void lom_scatter_rows(float *to, lom_int index, lom_float4 x)
{
    lom_defined_scatter_rows(to, index, x);
}
#endif
#ifndef LOM_OVERRIDES_TWICE
LOM_INLINE lom_pairs lom_twice(lom_int x)
{
    return lom_defined_twice(x);
}
#endif
#ifndef LOM_OVERRIDES_TO_DOUBLE
LOM_INLINE lom_double lom_to_double(lom_int x)
{
    return lom_defined_to_double(x);
}
#endif
#ifndef LOM_OVERRIDES_HALVES
LOM_INLINE lom_int lom_load_halves(const int32_t *low, const int32_t *high)
{
    return lom_defined_load_halves(low, high);
}
LOM_INLINE void lom_store_halves(int32_t *low, int32_t *high, lom_int x)
{
    lom_defined_store_halves(low, high, x);
}
#endif
#ifndef LOM_OVERRIDES_STREAMS
LOM_INLINE void lom_split_pairs(const int32_t *from, lom_int *even, lom_int *odd)
{
    lom_defined_split_pairs(from, even, odd);
}
LOM_INLINE void lom_stream_int(int32_t *to, lom_int x)
{
    lom_defined_stream_int(to, x);
}
LOM_INLINE void lom_end_streams(void)
{
}
#endif
#ifndef LOM_OVERRIDES_ROUNDING
LOM_INLINE lom_float lom_floor(lom_float x)
{
    return lom_defined_floor(x);
}
LOM_INLINE lom_float lom_round(lom_float x)
{
    return lom_defined_round(x);
}
#endif
#ifndef LOM_OVERRIDES_COMPRESS
LOM_INLINE void lom_compress(float *to, lom_mask mask, lom_float x)
{
    lom_defined_compress(to, mask, x);
}
#endif
#ifndef LOM_OVERRIDES_PERMUTE
LOM_INLINE lom_float lom_permute(lom_float x, lom_int which)
{
    return lom_defined_permute(x, which);
}
#endif
#ifndef LOM_OVERRIDES_GATHER
LOM_INLINE lom_float lom_gather(const float *from, lom_int index)
{
    return lom_defined_gather(from, index);
}
LOM_INLINE lom_int lom_gather_int(const int32_t *from, lom_int index)
{
    return lom_defined_gather_int(from, index);
}
#endif
#ifndef LOM_OVERRIDES_PAIRS
LOM_INLINE void lom_gather_pairs(const int32_t *from, lom_int index, lom_int *first, lom_int *second)
{
    lom_defined_gather_pairs(from, index, first, second);
}
#endif
#ifndef LOM_OVERRIDES_PICK
LOM_INLINE lom_float4 lom_pick_rows(const float *from, const int32_t *row, int count, lom_int which)
{
    (void)count;
    return lom_gather_rows(from, lom_gather_int(row, which));
}
#endif

/* ---- what follows from them ---- */

LOM_INLINE bool lom_any(lom_mask mask)
{
    return lom_bits(mask) != 0;
}

LOM_INLINE bool lom_all(lom_mask mask)
{
    return lom_bits(mask) == (uint32_t)((UINT64_C(1) << LOM_LANES) - 1);
}

/* How many of the lowest 16 bits are set. Where the machine has no instruction for it, by adding neighbours. */
LOM_INLINE uint32_t lom_count_bits(uint32_t bits)
{
#if defined __POPCNT__ || defined __wasm__
    return (uint32_t)__builtin_popcount(bits & 0xffff);
#else
    bits &= 0xffff;
    bits -= bits >> 1 & 0x5555;
    bits = (bits & 0x3333) + (bits >> 2 & 0x3333);
    bits = (bits + (bits >> 4)) & 0x0f0f;
    return (bits + (bits >> 8)) & 31;
#endif
}

/* How many lanes are set. */
LOM_INLINE uint32_t lom_count(lom_mask mask)
{
    return lom_count_bits(lom_bits(mask));
}

/* The mask whose lane i is set when bit i is. */
LOM_INLINE lom_mask lom_mask_of_bits(uint32_t bits)
{
    lom_int one = lom_splat_int(1) << lom_lane_index();
    return (lom_splat_int((int32_t)bits) & one) != 0;
}
#ifndef LOM_OVERRIDES_EXTREMES
LOM_INLINE lom_int lom_min_int(lom_int a, lom_int b)
{
    return lom_select_int(a < b, a, b);
}

LOM_INLINE lom_int lom_max_int(lom_int a, lom_int b)
{
    return lom_select_int(a > b, a, b);
}
#endif
/* |x|; NaN keeps its payload. */
LOM_INLINE lom_float lom_abs(lom_float x)
{
    return (lom_float)((lom_int)x & 0x7fffffff);
}

/* The magnitude of x with the sign of y. */
LOM_INLINE lom_float lom_copysign(lom_float x, lom_float y)
{
    return (lom_float)(((lom_int)x & 0x7fffffff) | ((lom_int)y & INT32_MIN));
}

/* min(max(x, low), high): low for NaN; low <= high. */
LOM_INLINE lom_float lom_clamp(lom_float x, lom_float low, lom_float high)
{
    return lom_min(lom_max(x, low), high);
}

/* Clamped to [0, 1]: 0 for NaN. */
LOM_INLINE lom_float lom_saturate(lom_float x)
{
    return lom_clamp(x, lom_splat(0.0f), lom_splat(1.0f));
}

/* x - floor(x), kept below 1 (it would round to 1 for x in (-2^-25, 0)): in [0, 1); NaN for NaN and infinities. */
LOM_INLINE lom_float lom_fraction(lom_float x)
{
    lom_float fraction = x - lom_floor(x);
    return lom_select(fraction >= 1.0f, lom_splat(0.0f), fraction);
}

LOM_INLINE lom_float lom_ceil(lom_float x)
{
    return -lom_floor(-x);
}

/* a + (b - a) t */
LOM_INLINE lom_float lom_mix(lom_float a, lom_float b, lom_float t)
{
    return a + (b - a) * t;
}

/* t = clamp((x - low) / (high - low), 0, 1); t t (3 - 2 t) */
LOM_INLINE lom_float lom_smoothstep(lom_float low, lom_float high, lom_float x)
{
    lom_float t = lom_saturate((x - low) / (high - low));
    return t * t * (3.0f - 2.0f * t);
}

#pragma GCC diagnostic pop

#include <lom/lanes_vectors.h>

#endif
