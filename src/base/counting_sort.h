/* A stable counting sort of numbers by keys of 32 bits, digit by digit. Inline, so that the key of a caller is too. */
#ifndef LOM_BASE_COUNTING_SORT_H
#define LOM_BASE_COUNTING_SORT_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef uint32_t lom_key_of(const void *context, uint32_t number);

/* Puts the `count` numbers of from into to, those first whose key has the largest byte at `shift`; of equal ones the
 * first stays first. */
static inline void lom_sort_by_digit(lom_key_of *key, const void *context, const uint32_t *from, uint32_t *to,
                                     size_t count, int shift)
{
    size_t place[256] = { 0 };
    for (size_t i = 0; i < count; i++)
        place[key(context, from[i]) >> shift & 255]++;
    size_t next = 0;
    for (int digit = 256; digit-- > 0;) {
        size_t here = place[digit];
        place[digit] = next;
        next += here;
    }
    for (size_t i = 0; i < count; i++)
        to[place[key(context, from[i]) >> shift & 255]++] = from[i];
}

/* Sorts by `digits` (2 or 4) bytes of the key, the lowest first; scratch has room for count numbers. */
static inline void lom_sort_by_key(lom_key_of *key, const void *context, int digits, size_t count, uint32_t *order,
                                   uint32_t *scratch)
{
    for (int digit = 0; digit < digits; digit += 2) {
        lom_sort_by_digit(key, context, order, scratch, count, 8 * digit);
        lom_sort_by_digit(key, context, scratch, order, count, 8 * digit + 8);
    }
}

/* Bits that grow with a number, over both signs. */
static inline uint32_t lom_sorting_key(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits >> 31 != 0 ? ~bits : bits | 0x80000000u;
}

#endif
