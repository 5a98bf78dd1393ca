/* The loop over the symbols of a block, fast. In: bits and codes; out: bytes. Invariant: it does what the plain loop of
 * inflate.c does, with everything that changes in registers and no check within a step; whatever needs one is left to
 * that loop.
 *
 * A step takes at most LITERALS_A_STEP literals of 15 bits from the 56 of the first refill, and a length and a distance
 * of 15 + 5 + 15 + 13 = 48 bits. Compiled for speed. */
#include "inflate.h"

#include <string.h>

enum { LITERALS_A_STEP = 3, MATCH_BITS = 48, BLOCK = 16 };
enum { MOST_READ = 16 /* two refills */, MOST_WRITTEN = LITERALS_A_STEP + INFLATE_LONGEST + BLOCK };

typedef struct bit_buffer {
    const uint8_t *next;
    uint64_t bits;
    int count;
} bit_buffer;

/* 56 to 63 bits; those above count are set again to the same. */
static inline void refill(bit_buffer *in)
{
    in->bits |= load_64_little(in->next) << in->count;
    in->next += (63 - in->count) / 8;
    in->count |= 56;
}

static inline void drop(bit_buffer *in, unsigned bits)
{
    in->bits >>= bits;
    in->count -= (int)bits;
}

static inline size_t take(bit_buffer *in, unsigned bits)
{
    size_t value = (size_t)(in->bits & ((UINT64_C(1) << bits) - 1));
    drop(in, bits);
    return value;
}

static inline bool is_literal(unsigned entry)
{
    return entry != 0 && entry < INFLATE_END * 16;
}

/* Writes up to BLOCK - 1 bytes behind the match as well. */
static inline void copy_match(uint8_t *to, size_t length, size_t distance)
{
    const uint8_t *from = to - distance;
    if (distance >= BLOCK) {
        for (size_t i = 0; i < length; i += BLOCK)
            memcpy(to + i, from + i, BLOCK);
    } else if (distance == 1) {
        memset(to, from[0], length);
    } else {
        for (size_t i = 0; i < length; i++) /* overlapping: what was just written is read again */
            to[i] = from[i];
    }
}

/* The match whose length symbol is in `entry`, appended; its length, or 0 and nothing done when it is none. */
static inline size_t take_match(bit_buffer *in, unsigned entry, const lom_inflate_code *distances, uint8_t *to,
                                size_t filled)
{
    bit_buffer ahead = *in;
    drop(&ahead, entry & 15);
    unsigned number = (entry >> 4) - INFLATE_FIRST_LENGTH;
    if (number >= INFLATE_LENGTHS)
        return 0;
    size_t length = lom_inflate_length_base[number] + take(&ahead, lom_inflate_length_extra[number]);
    unsigned far = lom_find_code(distances, ahead.bits);
    drop(&ahead, far & 15);
    if (far == 0 || far >> 4 >= INFLATE_DISTANCES)
        return 0;
    size_t distance = lom_inflate_distance_base[far >> 4] + take(&ahead, lom_inflate_distance_extra[far >> 4]);
    if (distance > filled)
        return 0;
    copy_match(to, length, distance);
    *in = ahead;
    return length;
}

void lom_inflate_fast(lom_inflate_reader *in, const lom_inflate_code *literals, const lom_inflate_code *distances,
                      size_t start, lom_inflated *out)
{
    if (in->size - in->at < MOST_READ || out->capacity - out->size < MOST_WRITTEN)
        return;
    bit_buffer buffer = { in->data + in->at, in->bits, in->count };
    const uint8_t *last_read = in->data + in->size - MOST_READ, *first = out->data + start;
    uint8_t *to = out->data + out->size, *last_written = out->data + out->capacity - MOST_WRITTEN;
    while (buffer.next <= last_read && to <= last_written) {
        refill(&buffer);
        unsigned entry = lom_find_code(literals, buffer.bits);
        for (int i = 0; i < LITERALS_A_STEP && is_literal(entry); i++) {
            *to++ = (uint8_t)(entry >> 4);
            drop(&buffer, entry & 15);
            entry = lom_find_code(literals, buffer.bits);
        }
        if (is_literal(entry))
            continue;
        if (buffer.count < MATCH_BITS) {
            refill(&buffer);
            entry = lom_find_code(literals, buffer.bits); /* it may have had too few bits */
        }
        size_t length = take_match(&buffer, entry, distances, to, (size_t)(to - first));
        if (length == 0)
            break;
        to += length;
    }
    in->at = (size_t)(buffer.next - in->data);
    in->bits = buffer.bits;
    in->count = buffer.count;
    out->size = (size_t)(to - out->data);
}
