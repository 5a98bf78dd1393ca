/* Philox 4x32 with 10 rounds: a bijection of 128-bit counters for each 64-bit key whose outputs pass BigCrush
 * (J. Salmon, M. Moraes, R. Dror, D. Shaw: Parallel random numbers: as easy as 1, 2, 3. SC 2011, section 4.3).
 * In: counter and key; out: four words that depend on every bit of both. */
#ifndef LOM_BASE_PHILOX_H
#define LOM_BASE_PHILOX_H

#include <stdint.h>

enum { PHILOX_ROUNDS = 10 };

static inline void philox_4x32(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4])
{
    uint32_t a = counter[0], b = counter[1], c = counter[2], d = counter[3];
    uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < PHILOX_ROUNDS; round++) {
        uint64_t p = (uint64_t)a * 0xd2511f53u; /* the two multipliers of the paper, found by its search */
        uint64_t q = (uint64_t)c * 0xcd9e8d57u;
        a = (uint32_t)(q >> 32) ^ b ^ k0;
        b = (uint32_t)q;
        c = (uint32_t)(p >> 32) ^ d ^ k1;
        d = (uint32_t)p;
        k0 += 0x9e3779b9u; /* Weyl sequences: the golden ratio and sqrt(3) - 1 */
        k1 += 0xbb67ae85u;
    }
    out[0] = a;
    out[1] = b;
    out[2] = c;
    out[3] = d;
}

#endif
