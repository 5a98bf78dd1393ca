/* lom/fixed.h - filtering in fixed point: numbers of 15 bits, two a lane, mixed by weights of 15 bits.
 *
 * A number is an integer from 0 to 2^15 - 1. A weight t in [0, 1] counts as T / 2^15, T = round(2^15 t), ties to even,
 * and mix(a, b, t) = a + ((b - a) T + 2^14 >> 15). So
 * - the result lies between a and b: (b - a) T / 2^15 does, and rounding is monotone and keeps integers;
 * - weight 0 gives a, weight 1 gives b, and mix(a, b, t) = mix(b, a, 1 - t) where 1 - t is exact: the second's T is
 *   2^15 - T, and b + ((a - b) (2^15 - T) + 2^14 >> 15) = b + (a - b) + ((b - a) T + 2^14 >> 15);
 * - one mix is off by at most half a unit for its own rounding and |b - a| 2^-16 for its weight's; what a and b were
 *   off by comes through with weights that sum to 1. So n nested mixes of numbers in [0, U] are off by at most
 *   n (U 2^-16 + 1/2) units: n 2^-15 of the range at U = 2^15.
 * Weights are held negated, -T in [-2^15, 0], since both ends fit into 16 bits so.
 *
 * 8 bits become 15 by 128 times: 0..32640.
 */
#ifndef LOM_FIXED_H
#define LOM_FIXED_H

#include <lom/lanes.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/* The arithmetic of filters: of samplers, and of marches through volumes and media. */
typedef enum lom_filtering {
    LOM_FILTERING_FLOAT = 0, /* 24 bits; what references are compared with */
    LOM_FILTERING_FIXED,     /* 15 bits, this header's */
    LOM_FILTERING_COUNT
} lom_filtering;

#define LOM_FIXED_BYTE   32640.0f /* 255 in 15 bits */
#define LOM_FIXED_LINEAR 32767.0f /* linear light 1 in 15 bits */

/* -round(2^15 t) in both halves, 0 <= t <= 1: the unit of floats in [2^8, 2^9) is 2^-15, and 1.5 2^8 is a multiple of
 * 2^16 of them. */
LOM_INLINE lom_pairs lom_weight_pairs(lom_float t)
{
    return lom_twice(lom_as_int(0x1.8p8f - t));
}

LOM_INLINE lom_pairs lom_mix_pairs(lom_pairs a, lom_pairs b, lom_pairs negated_weight)
{
    return a + lom_multiply_pairs(a - b, negated_weight);
}

/* Four bytes of a word as numbers of 15 bits: the first and third, the second and fourth. */
LOM_INLINE lom_pairs lom_even_bytes(lom_int word)
{
    return (lom_pairs)((word & 0x00ff00ff) << 7);
}

LOM_INLINE lom_pairs lom_odd_bytes(lom_int word)
{
    return (lom_pairs)(word >> 1 & 0x7f807f80);
}

/* The numbers in the lower and upper halves, which are not negative. */
LOM_INLINE lom_float lom_lower_of_pairs(lom_pairs x)
{
    return lom_to_float((lom_int)x & 0xffff);
}

LOM_INLINE lom_float lom_upper_of_pairs(lom_pairs x)
{
    return lom_to_float((lom_int)x >> 16);
}

#pragma GCC diagnostic pop

#endif
