/* Numbers for tests that try many, the same in every run. */
#ifndef LOM_TESTS_CHANCE_H
#define LOM_TESTS_CHANCE_H

#include <stdint.h>

/* In [0, 1). */
static inline float unit(void)
{
    static uint32_t state = 5;
    state = state * 1664525u + 1013904223u;
    return (float)(state >> 8) * 0x1p-24f;
}

/* In 0 to count - 1. */
static inline int below(int count)
{
    return (int)(unit() * (float)count);
}

#endif
