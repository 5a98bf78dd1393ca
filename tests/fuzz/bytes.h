/* The input of a fuzz target as a row of decisions. Behind its end every decision is the first. */
#ifndef LOM_TESTS_FUZZ_BYTES_H
#define LOM_TESTS_FUZZ_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct fuzz_bytes {
    const uint8_t *data;
    size_t size;
} fuzz_bytes;

static inline unsigned take_byte(fuzz_bytes *in)
{
    if (in->size == 0)
        return 0;
    in->size--;
    return *in->data++;
}

/* 0 .. count - 1. */
static inline int take_choice(fuzz_bytes *in, int count)
{
    return (int)take_byte(in) % count;
}

static inline bool take_bool(fuzz_bytes *in)
{
    return take_byte(in) & 1;
}

static inline uint32_t take_word(fuzz_bytes *in)
{
    uint32_t word = 0;
    for (int i = 0; i < 4; i++)
        word = word << 8 | take_byte(in);
    return word;
}

/* Mostly small, sometimes where integers end, sometimes any. */
static inline int take_int(fuzz_bytes *in)
{
    static const int ends[] = { 0, -1, 1, INT32_MAX, INT32_MIN, INT32_MAX - 1, 32768, 32769, 65536, -32768, 16, 64 };
    unsigned byte = take_byte(in);
    if (byte < 0x80)
        return (int)byte % 48;
    if (byte < 0xf0)
        return ends[byte % (sizeof ends / sizeof *ends)];
    return (int)take_word(in);
}

/* Mostly within -4..4, sometimes where floats end, sometimes any, NaN and infinities among them. */
static inline float take_float(fuzz_bytes *in)
{
    static const float ends[] = { 0.0f,
                                  -0.0f,
                                  1.0f,
                                  -1.0f,
                                  0.5f,
                                  1e-45f,
                                  1e-38f,
                                  3.4e38f,
                                  -3.4e38f,
                                  8388608.5f,
                                  2147483648.0f,
                                  1e9f,
                                  -1e-20f,
                                  4294967296.0f,
                                  0.99999994f,
                                  __builtin_inff(),
                                  -__builtin_inff(),
                                  __builtin_nanf("") };
    unsigned byte = take_byte(in);
    if (byte < 0x90)
        return (float)((int)byte - 72) / 18;
    if (byte < 0xf0)
        return ends[byte % (sizeof ends / sizeof *ends)];
    uint32_t word = take_word(in);
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

#endif
