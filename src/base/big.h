/* Non-negative integers of a bounded size, as much as number_parse.c and number_print.c need: limbs of 32 bits, the
 * least first, `count` of them without leading zeros. The bound: parsing keeps at most 801 digits of numbers
 * above 10^-324, so powers of ten stay below 10^1125 < 2^3738 and the others within a factor of 2 of them; printing
 * stays below 2^1200. */
#ifndef LOM_BASE_BIG_H
#define LOM_BASE_BIG_H

#include <stdint.h>

enum { BIG_LIMBS = 128 };

typedef struct big {
    int count;
    uint32_t limb[BIG_LIMBS];
} big;

static inline void big_set(big *a, uint64_t value)
{
    a->limb[0] = (uint32_t)value;
    a->limb[1] = (uint32_t)(value >> 32);
    a->count = a->limb[1] != 0 ? 2 : a->limb[0] != 0;
}

/* a = a * factor + addend */
static inline void big_multiply_add(big *a, uint32_t factor, uint32_t addend)
{
    uint64_t carry = addend;
    for (int i = 0; i < a->count; i++) {
        carry += (uint64_t)a->limb[i] * factor;
        a->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry != 0)
        a->limb[a->count++] = (uint32_t)carry;
}

static inline void big_multiply_power_of_ten(big *a, int exponent)
{
    for (; exponent >= 9; exponent -= 9)
        big_multiply_add(a, 1000000000, 0);
    for (; exponent > 0; exponent--)
        big_multiply_add(a, 10, 0);
}

static inline void big_shift_left(big *a, int bits)
{
    int limbs = bits / 32, rest = bits % 32;
    if (a->count == 0 || bits == 0)
        return;
    uint32_t high = 0;
    for (int i = a->count - 1; i >= 0; i--) {
        uint64_t wide = (uint64_t)a->limb[i] << rest;
        a->limb[i + limbs + 1] = high | (uint32_t)(wide >> 32);
        high = (uint32_t)wide;
    }
    a->limb[limbs] = high;
    for (int i = 0; i < limbs; i++)
        a->limb[i] = 0;
    a->count += limbs + 1;
    if (a->limb[a->count - 1] == 0)
        a->count--;
}

/* Below 0, 0 or above 0 as a < b, a = b or a > b. */
static inline int big_compare(const big *a, const big *b)
{
    if (a->count != b->count)
        return a->count < b->count ? -1 : 1;
    for (int i = a->count - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

/* a = a - b, for a >= b */
static inline void big_subtract(big *a, const big *b)
{
    int64_t borrow = 0;
    for (int i = 0; i < a->count; i++) {
        borrow += (int64_t)a->limb[i] - (i < b->count ? b->limb[i] : 0);
        a->limb[i] = (uint32_t)borrow;
        borrow >>= 32; /* 0 or -1 */
    }
    while (a->count > 0 && a->limb[a->count - 1] == 0)
        a->count--;
}

/* a = a + b */
static inline void big_add(big *a, const big *b)
{
    uint64_t carry = 0;
    int count = a->count > b->count ? a->count : b->count;
    for (int i = 0; i < count; i++) {
        carry += i < a->count ? a->limb[i] : 0;
        carry += i < b->count ? b->limb[i] : 0;
        a->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    a->count = count;
    if (carry != 0)
        a->limb[a->count++] = (uint32_t)carry;
}

static inline int big_bits(const big *a)
{
    return a->count == 0 ? 0 : 32 * a->count - __builtin_clz(a->limb[a->count - 1]);
}

#endif
