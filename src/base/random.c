/* Counter-based random numbers. In: a key (what the number is for) and a counter (which one); out: bits that are a pure
 * function of the two, so that any pixel, voxel or frame can be made alone and in any order. */
#include <lom/base.h>

#include "base/numbers.h"
#include "philox.h"

static void random_block(uint64_t key, uint64_t counter, uint64_t bits[2])
{
    uint32_t words[4];
    philox_4x32((const uint32_t[4]){ (uint32_t)counter, (uint32_t)(counter >> 32), 0, 0 },
                (const uint32_t[2]){ (uint32_t)key, (uint32_t)(key >> 32) }, words);
    bits[0] = words[0] | (uint64_t)words[1] << 32;
    bits[1] = words[2] | (uint64_t)words[3] << 32;
}

uint64_t lom_random_bits(uint64_t key, uint64_t counter)
{
    uint64_t bits[2];
    random_block(key, counter, bits);
    return bits[0];
}

double lom_random_uniform(uint64_t key, uint64_t counter)
{
    return (double)(lom_random_bits(key, counter) >> 11) * 0x1p-53;
}

/* G. Box, M. Muller: A note on the generation of random normal deviates (1958). The radius takes a uniform number in
 * (0, 1], so that its logarithm is finite: |normal| <= sqrt(2 * 53 * ln 2) = 8.58. */
void lom_random_normal(uint64_t key, uint64_t counter, double normal[2])
{
    uint64_t bits[2];
    random_block(key, counter, bits);
    double u = (double)((bits[0] >> 11) + 1) * 0x1p-53;
    double angle = lom_two_pi * ((double)(bits[1] >> 11) * 0x1p-53);
    double radius = lom_double_sqrt(-2.0 * lom_double_log(u));
    normal[0] = radius * lom_double_cos(angle);
    normal[1] = radius * lom_double_sin(angle);
}
