/* The oracle of phases: the part of a turn that products and quotients of doubles are, in integers of 128 bits. A double
 * is a whole number times a power of two, so nothing is rounded but 1 / (2 pi), to 384 bits, and each result, once. */
#ifndef LOM_TESTS_ORACLE_TURNS_H
#define LOM_TESTS_ORACLE_TURNS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

typedef unsigned __int128 uint128;

/* A part of a turn, most significant word first: whole turns have run over. */
enum { TURN_WORDS = 6 };
typedef struct turn {
    uint64_t word[TURN_WORDS];
} turn;

static const turn radian = { { 0x28be60db9391054a, 0x7f09d5f47d4d3770, 0x36d8a5664f10e410, 0x7f9458eaf7aef158,
                               0x6dc91b8e909374b8, 0x01924bba82746487 } };
static const turn half_turn = { { UINT64_C(1) << 63 } };

static inline turn turn_times(turn t, uint64_t whole)
{
    uint64_t carry = 0;
    for (int i = TURN_WORDS - 1; i >= 0; i--) {
        const uint128 product = (uint128)t.word[i] * whole + carry;
        t.word[i] = (uint64_t)product;
        carry = (uint64_t)(product >> 64);
    }
    return t;
}

static inline turn turn_halved(turn t, int times)
{
    for (; times > 0; times--)
        for (int i = TURN_WORDS - 1; i >= 0; i--)
            t.word[i] = t.word[i] >> 1 | (i > 0 ? t.word[i - 1] << 63 : 0);
    return t;
}

/* a = whole 2^exponent, without its sign. */
static inline uint64_t whole_of(double a, int *exponent)
{
    const double part = frexp(fabs(a), exponent);
    *exponent -= 53;
    return (uint64_t)(part * 0x1p53);
}

/* -1/2 <= result < 1/2, rounded once. */
static inline double turn_value(turn t, bool negative)
{
    const __int128 top = (__int128)((uint128)t.word[0] << 64 | t.word[1]);
    return (double)top * 0x1p-128 * (negative ? -1 : 1);
}

/* The part of a turn that the product of `factors` units is. A unit is halved before it is multiplied, while it has no
 * whole turns. */
static inline double part_of_product(turn unit, const double *factor, int factors)
{
    uint64_t whole[4];
    int exponent = 0, one;
    bool negative = false;
    for (int i = 0; i < factors; i++) {
        whole[i] = whole_of(factor[i], &one);
        exponent += one;
        negative ^= factor[i] < 0;
    }
    unit = turn_halved(unit, exponent < 0 ? -exponent : 0);
    for (int i = 0; i < factors; i++)
        unit = turn_times(unit, whole[i]);
    for (; exponent > 0; exponent--)
        unit = turn_times(unit, 2);
    return turn_value(unit, negative);
}

/* That of a b / (c d) turns, 0 <= result < 1: by the remainder, doubled as often as the powers of two say. */
static inline double part_of_quotient(double a, double b, double c, double d)
{
    int exponent[4], shift;
    uint128 over = (uint128)whole_of(a, &exponent[0]) * whole_of(b, &exponent[1]);
    uint128 under = (uint128)whole_of(c, &exponent[2]) * whole_of(d, &exponent[3]);
    shift = exponent[0] + exponent[1] - exponent[2] - exponent[3];
    double part;
    if (shift < -20) { /* far below a turn */
        part = ldexp((double)over / (double)under, shift);
    } else {
        for (; shift < 0; shift++)
            under *= 2;
        for (over %= under; shift > 0; shift--)
            over = 2 * over % under;
        part = (double)over / (double)under;
    }
    part = (a < 0) ^ (b < 0) ^ (c < 0) ^ (d < 0) ? 1 - part : part;
    return part < 1 ? part : 0;
}

/* By how much one part of a turn is beside another, at most 1/2. */
static inline double turns_apart(double a, double b)
{
    const double apart = a - b;
    return fabs(apart - floor(apart + 0.5));
}

#endif
