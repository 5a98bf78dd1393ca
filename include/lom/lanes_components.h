/* lom/lanes_components.h - for users' shaders: vectors of two and four lom_float, vectors of lom_int and lom_mask. Those of
 * three lom_float are in lom/lanes_vectors.h. */
#ifndef LOM_LANES_COMPONENTS_H
#define LOM_LANES_COMPONENTS_H

#include <lom/lanes_vectors.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

typedef struct lom_int2 {
    lom_int x, y;
} lom_int2;
typedef struct lom_int3 {
    lom_int x, y, z;
} lom_int3;
typedef struct lom_int4 {
    lom_int x, y, z, w;
} lom_int4;
typedef lom_int2 lom_mask2; /* a mask is 0 or -1 in every lane */
typedef lom_int3 lom_mask3;
typedef lom_int4 lom_mask4;

/* ---- floats: as those of three in lom/lanes_vectors.h ---- */

LOM_INLINE lom_float2 lom_splat2(float x, float y)
{
    lom_float2 result = { lom_splat(x), lom_splat(y) };
    return result;
}

LOM_INLINE lom_float2 lom_add2(lom_float2 a, lom_float2 b)
{
    lom_float2 result = { a.x + b.x, a.y + b.y };
    return result;
}

LOM_INLINE lom_float2 lom_sub2(lom_float2 a, lom_float2 b)
{
    lom_float2 result = { a.x - b.x, a.y - b.y };
    return result;
}

LOM_INLINE lom_float2 lom_mul2(lom_float2 a, lom_float2 b)
{
    lom_float2 result = { a.x * b.x, a.y * b.y };
    return result;
}

LOM_INLINE lom_float2 lom_scale2(lom_float2 a, lom_float factor)
{
    lom_float2 result = { a.x * factor, a.y * factor };
    return result;
}

LOM_INLINE lom_float2 lom_mix2(lom_float2 a, lom_float2 b, lom_float t)
{
    lom_float2 result = { lom_mix(a.x, b.x, t), lom_mix(a.y, b.y, t) };
    return result;
}

/* From the left to the right. */
LOM_INLINE lom_float lom_dot2(lom_float2 a, lom_float2 b)
{
    return a.x * b.x + a.y * b.y;
}

LOM_INLINE lom_float4 lom_splat4(float x, float y, float z, float w)
{
    lom_float4 result = { lom_splat(x), lom_splat(y), lom_splat(z), lom_splat(w) };
    return result;
}

LOM_INLINE lom_float4 lom_add4(lom_float4 a, lom_float4 b)
{
    lom_float4 result = { a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w };
    return result;
}

LOM_INLINE lom_float4 lom_sub4(lom_float4 a, lom_float4 b)
{
    lom_float4 result = { a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w };
    return result;
}

LOM_INLINE lom_float4 lom_mul4(lom_float4 a, lom_float4 b)
{
    lom_float4 result = { a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w };
    return result;
}

LOM_INLINE lom_float4 lom_scale4(lom_float4 a, lom_float factor)
{
    lom_float4 result = { a.x * factor, a.y * factor, a.z * factor, a.w * factor };
    return result;
}

LOM_INLINE lom_float4 lom_mix4(lom_float4 a, lom_float4 b, lom_float t)
{
    lom_float4 result = { lom_mix(a.x, b.x, t), lom_mix(a.y, b.y, t), lom_mix(a.z, b.z, t), lom_mix(a.w, b.w, t) };
    return result;
}

/* From the left to the right. */
LOM_INLINE lom_float lom_dot4(lom_float4 a, lom_float4 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

/* ---- component by component ---- */

/* The functions name2, name3 and name4 of vectors a and b: `of`(a.x, b.x) and so on. */
#define LOM_BY_COMPONENT(name, result, given, of)                                                                      \
    LOM_INLINE result##2 name##2(given##2 a, given##2 b)                                                               \
    {                                                                                                                  \
        result##2 out = { of(a.x, b.x), of(a.y, b.y) };                                                                \
        return out;                                                                                                    \
    }                                                                                                                  \
    LOM_INLINE result##3 name##3(given##3 a, given##3 b)                                                               \
    {                                                                                                                  \
        result##3 out = { of(a.x, b.x), of(a.y, b.y), of(a.z, b.z) };                                                  \
        return out;                                                                                                    \
    }                                                                                                                  \
    LOM_INLINE result##4 name##4(given##4 a, given##4 b)                                                               \
    {                                                                                                                  \
        result##4 out = { of(a.x, b.x), of(a.y, b.y), of(a.z, b.z), of(a.w, b.w) };                                    \
        return out;                                                                                                    \
    }

/* ... and of one vector, and of what all its components make together. */
#define LOM_OF_COMPONENTS(name, result, given, of)                                                                     \
    LOM_INLINE result##2 name##2(given##2 a)                                                                           \
    {                                                                                                                  \
        result##2 out = { of(a.x), of(a.y) };                                                                          \
        return out;                                                                                                    \
    }                                                                                                                  \
    LOM_INLINE result##3 name##3(given##3 a)                                                                           \
    {                                                                                                                  \
        result##3 out = { of(a.x), of(a.y), of(a.z) };                                                                 \
        return out;                                                                                                    \
    }                                                                                                                  \
    LOM_INLINE result##4 name##4(given##4 a)                                                                           \
    {                                                                                                                  \
        result##4 out = { of(a.x), of(a.y), of(a.z), of(a.w) };                                                        \
        return out;                                                                                                    \
    }

LOM_INLINE lom_mask lom_less_lanes(lom_float a, lom_float b)
{
    return a < b;
}

LOM_INLINE lom_mask lom_less_equal_lanes(lom_float a, lom_float b)
{
    return a <= b;
}

LOM_INLINE lom_mask lom_equal_lanes(lom_float a, lom_float b)
{
    return a == b;
}

LOM_INLINE lom_mask lom_less_int_lanes(lom_int a, lom_int b)
{
    return a < b;
}

LOM_INLINE lom_mask lom_equal_int_lanes(lom_int a, lom_int b)
{
    return a == b;
}

LOM_INLINE lom_int lom_add_int_lanes(lom_int a, lom_int b)
{
    return a + b;
}

LOM_INLINE lom_int lom_sub_int_lanes(lom_int a, lom_int b)
{
    return a - b;
}

LOM_INLINE lom_int lom_mul_int_lanes(lom_int a, lom_int b)
{
    return a * b;
}

LOM_INLINE lom_mask lom_and_lanes(lom_mask a, lom_mask b)
{
    return a & b;
}

LOM_INLINE lom_mask lom_or_lanes(lom_mask a, lom_mask b)
{
    return a | b;
}

LOM_INLINE lom_mask lom_not_lanes(lom_mask a)
{
    return ~a;
}

/* Floats: less, at most and equal (a NaN is none of them), the smaller and the larger as by lom_min and lom_max. */
LOM_BY_COMPONENT(lom_less, lom_mask, lom_float, lom_less_lanes)
LOM_BY_COMPONENT(lom_less_equal, lom_mask, lom_float, lom_less_equal_lanes)
LOM_BY_COMPONENT(lom_equal, lom_mask, lom_float, lom_equal_lanes)
LOM_BY_COMPONENT(lom_min, lom_float, lom_float, lom_min)
LOM_BY_COMPONENT(lom_max, lom_float, lom_float, lom_max)
/* Ints, which wrap round. */
LOM_BY_COMPONENT(lom_less_int, lom_mask, lom_int, lom_less_int_lanes)
LOM_BY_COMPONENT(lom_equal_int, lom_mask, lom_int, lom_equal_int_lanes)
LOM_BY_COMPONENT(lom_add_int, lom_int, lom_int, lom_add_int_lanes)
LOM_BY_COMPONENT(lom_sub_int, lom_int, lom_int, lom_sub_int_lanes)
LOM_BY_COMPONENT(lom_mul_int, lom_int, lom_int, lom_mul_int_lanes)
LOM_BY_COMPONENT(lom_min_int, lom_int, lom_int, lom_min_int)
LOM_BY_COMPONENT(lom_max_int, lom_int, lom_int, lom_max_int)
/* Masks. */
LOM_BY_COMPONENT(lom_and, lom_mask, lom_mask, lom_and_lanes)
LOM_BY_COMPONENT(lom_or, lom_mask, lom_mask, lom_or_lanes)
LOM_OF_COMPONENTS(lom_not, lom_mask, lom_mask, lom_not_lanes)
/* Towards 0 as by lom_to_int, and back. */
LOM_OF_COMPONENTS(lom_to_int, lom_int, lom_float, lom_to_int)
LOM_OF_COMPONENTS(lom_to_float, lom_float, lom_int, lom_to_float)

#undef LOM_BY_COMPONENT
#undef LOM_OF_COMPONENTS

/* Lanes of which any, and all, of the two components are set. */
LOM_INLINE lom_mask lom_any_of2(lom_mask2 a)
{
    return a.x | a.y;
}

LOM_INLINE lom_mask lom_all_of2(lom_mask2 a)
{
    return a.x & a.y;
}

LOM_INLINE lom_int2 lom_splat_int2(int32_t x, int32_t y)
{
    lom_int2 result = { lom_splat_int(x), lom_splat_int(y) };
    return result;
}

LOM_INLINE lom_float2 lom_select2(lom_mask2 mask, lom_float2 a, lom_float2 b)
{
    lom_float2 result = { lom_select(mask.x, a.x, b.x), lom_select(mask.y, a.y, b.y) };
    return result;
}

LOM_INLINE lom_int2 lom_select_int2(lom_mask2 mask, lom_int2 a, lom_int2 b)
{
    lom_int2 result = { lom_select_int(mask.x, a.x, b.x), lom_select_int(mask.y, a.y, b.y) };
    return result;
}

/* Lanes of which any, and all, of the three components are set. */
LOM_INLINE lom_mask lom_any_of3(lom_mask3 a)
{
    return a.x | a.y | a.z;
}

LOM_INLINE lom_mask lom_all_of3(lom_mask3 a)
{
    return a.x & a.y & a.z;
}

LOM_INLINE lom_int3 lom_splat_int3(int32_t x, int32_t y, int32_t z)
{
    lom_int3 result = { lom_splat_int(x), lom_splat_int(y), lom_splat_int(z) };
    return result;
}

LOM_INLINE lom_float3 lom_select3(lom_mask3 mask, lom_float3 a, lom_float3 b)
{
    lom_float3 result = { lom_select(mask.x, a.x, b.x), lom_select(mask.y, a.y, b.y), lom_select(mask.z, a.z, b.z) };
    return result;
}

LOM_INLINE lom_int3 lom_select_int3(lom_mask3 mask, lom_int3 a, lom_int3 b)
{
    lom_int3 result = { lom_select_int(mask.x, a.x, b.x), lom_select_int(mask.y, a.y, b.y),
                        lom_select_int(mask.z, a.z, b.z) };
    return result;
}

/* Lanes of which any, and all, of the four components are set. */
LOM_INLINE lom_mask lom_any_of4(lom_mask4 a)
{
    return a.x | a.y | a.z | a.w;
}

LOM_INLINE lom_mask lom_all_of4(lom_mask4 a)
{
    return a.x & a.y & a.z & a.w;
}

LOM_INLINE lom_int4 lom_splat_int4(int32_t x, int32_t y, int32_t z, int32_t w)
{
    lom_int4 result = { lom_splat_int(x), lom_splat_int(y), lom_splat_int(z), lom_splat_int(w) };
    return result;
}

LOM_INLINE lom_float4 lom_select4(lom_mask4 mask, lom_float4 a, lom_float4 b)
{
    lom_float4 result = { lom_select(mask.x, a.x, b.x), lom_select(mask.y, a.y, b.y), lom_select(mask.z, a.z, b.z),
                          lom_select(mask.w, a.w, b.w) };
    return result;
}

LOM_INLINE lom_int4 lom_select_int4(lom_mask4 mask, lom_int4 a, lom_int4 b)
{
    lom_int4 result = { lom_select_int(mask.x, a.x, b.x), lom_select_int(mask.y, a.y, b.y),
                        lom_select_int(mask.z, a.z, b.z), lom_select_int(mask.w, a.w, b.w) };
    return result;
}

#pragma GCC diagnostic pop

#endif
