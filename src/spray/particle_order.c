/* The order of blending. In: depths. Out: numbers of particles, far to near. Invariant: a function of the depths alone;
 * equal keys keep the order of their numbers, since each counting sort is stable. */
#include "base/counting_sort.h"

#include <lom/particles.h>

/* The bits of a positive float grow with it: its exponent and the first 8 bits of its fraction are a key of 16 bits. */
static uint32_t depth_key(const void *depths, uint32_t number)
{
    const float depth = ((const float *)depths)[number];
    uint32_t bits;
    if (!(depth > 0))
        return 0;
    memcpy(&bits, &depth, sizeof bits);
    return bits >> 15;
}

void lom_order_particles(const float *depth, size_t count, uint32_t *order, uint32_t *scratch)
{
    for (size_t i = 0; i < count; i++)
        order[i] = (uint32_t)i;
    lom_sort_by_key(depth_key, depth, 2, count, order, scratch);
}
