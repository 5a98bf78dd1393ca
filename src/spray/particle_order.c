/* The order of blending. In: depths. Out: numbers of particles, far to near. Invariant: a function of the depths alone;
 * equal keys keep the order of their numbers, since each counting sort is stable. */
#include <lom/particles.h>

#include <string.h>

enum { DIGITS = 256 };

/* The bits of a positive float grow with it: its exponent and the first 8 bits of its fraction are a key of 16 bits. */
static uint32_t depth_key(float depth)
{
    uint32_t bits;
    if (!(depth > 0))
        return 0;
    memcpy(&bits, &depth, sizeof bits);
    return bits >> 15;
}

static void sort_by_digit(const float *depth, const uint32_t *from, uint32_t *to, size_t count, int shift)
{
    size_t place[DIGITS] = { 0 };
    for (size_t i = 0; i < count; i++)
        place[depth_key(depth[from[i]]) >> shift & (DIGITS - 1)]++;
    size_t next = 0;
    for (int digit = DIGITS; digit-- > 0;) {
        size_t here = place[digit];
        place[digit] = next;
        next += here;
    }
    for (size_t i = 0; i < count; i++)
        to[place[depth_key(depth[from[i]]) >> shift & (DIGITS - 1)]++] = from[i];
}

void lom_order_particles(const float *depth, size_t count, uint32_t *order, uint32_t *scratch)
{
    for (size_t i = 0; i < count; i++)
        order[i] = (uint32_t)i;
    sort_by_digit(depth, order, scratch, count, 0);
    sort_by_digit(depth, scratch, order, count, 8);
}
