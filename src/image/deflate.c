/* Compression to DEFLATE (RFC 1951) in zlib or gzip wrapping. In: bytes; out: a stream that decompresses to them. First
 * step: LZ77 matches into a buffer of tokens (this file); second: each full buffer becomes a block (deflate_block.c).
 * Invariant: the output is a function of the input and the effort alone. */
#include "deflate.h"

#include "bytes.h"
#include "zip.h"

#include <string.h>

enum {
    HASH_BITS = 15,
    LEAST_MATCH = 4, /* matches of 3 bytes rarely pay in filtered pixels */
    MOST_MATCH = 258,
    GOOD_MATCH = 32, /* long enough not to look for a longer one at the next byte */
    INSERT_ALL = 64, /* of a longer match only the last places are remembered */
    INSERT_LAST = 8,
    WINDOW_MASK = LOM_DEFLATE_WINDOW - 1
};

/* Places are stored + 1, so that 0 says "none". A chain leads from the newest place of a hash to older ones; entries
 * are overwritten after one window. */
typedef struct matcher {
    const uint8_t *data;
    size_t size;
    int effort;
    uint32_t head[1 << HASH_BITS];
    uint32_t chain[LOM_DEFLATE_WINDOW];
} matcher;

typedef struct match {
    uint32_t length, distance;
} match;

static inline uint32_t hash_at(const matcher *m, size_t at)
{
    return load_32_little(m->data + at) * 2654435761u >> (32 - HASH_BITS); /* Knuth, TAOCP 3, section 6.4 */
}

static inline void insert(matcher *m, size_t at)
{
    if (m->size - at < LEAST_MATCH)
        return;
    uint32_t hash = hash_at(m, at);
    m->chain[at & WINDOW_MASK] = m->head[hash];
    m->head[hash] = (uint32_t)at + 1;
}

static inline uint32_t common_length(const uint8_t *a, const uint8_t *b, uint32_t most)
{
    uint32_t length = 0;
    for (; length + 8 <= most; length += 8) {
        uint64_t difference = load_64_little(a + length) ^ load_64_little(b + length);
        if (difference != 0)
            return length + (uint32_t)__builtin_ctzll(difference) / 8;
    }
    while (length < most && a[length] == b[length])
        length++;
    return length;
}

/* Takes the place `distance` before `here` when it matches longer than best. A short match far away costs as much as
 * its literals, and is not taken. best->length is at least LEAST_MATCH - 1 and below most. */
static inline void try_distance(const uint8_t *here, size_t distance, uint32_t most, match *best)
{
    const uint8_t *there = here - distance;
    if (there[best->length] != here[best->length] || load_32_little(there) != load_32_little(here))
        return;
    uint32_t length = common_length(here, there, most);
    bool pays = length > 5 || distance <= (length == 4 ? 1024 : 8192);
    if (length > best->length && pays)
        *best = (match){ length, (uint32_t)distance };
}

/* The longest match at `at` with a place before it, if longer than `beat` bytes; else distance 0. Nearer places
 * come first, and a farther one must be longer. */
static match find(const matcher *m, size_t at, uint32_t beat)
{
    match best = { beat > LEAST_MATCH - 1 ? beat : LEAST_MATCH - 1, 0 };
    size_t rest = m->size - at;
    if (rest <= best.length)
        return best;
    uint32_t most = rest < MOST_MATCH ? (uint32_t)rest : MOST_MATCH;
    const uint8_t *here = m->data + at;
    uint32_t place = m->head[hash_at(m, at)];
    for (int tries = m->effort; place != 0 && tries > 0 && best.length < most; tries--) {
        size_t distance = at - (place - 1);
        if (distance > LOM_DEFLATE_WINDOW)
            break;
        try_distance(here, distance, most, &best);
        uint32_t older = m->chain[(place - 1) & WINDOW_MASK];
        if (older >= place) /* overwritten by a newer place of another chain */
            break;
        place = older;
    }
    return best;
}

/* Remembers the places inside a match: all of a short one; of a long one the last ones, where a run that goes on finds
 * itself at the same small distance again. */
static void insert_match(matcher *m, size_t at, uint32_t length)
{
    for (uint32_t i = length <= INSERT_ALL ? 1 : length - INSERT_LAST; i < length; i++)
        insert(m, at + i);
}

/* Lazy evaluation: a match is given up for a literal when the next byte starts a longer one. */
static bool compress(matcher *m, lom_deflate_block *block)
{
    size_t at = 0;
    match now = { 0, 0 };
    while (at < m->size) {
        if (now.distance == 0)
            now = find(m, at, 0);
        insert(m, at);
        bool lazy = now.distance != 0 && now.length < GOOD_MATCH && at + 1 < m->size;
        match next = lazy ? find(m, at + 1, now.length) : (match){ 0, 0 };
        if (now.distance == 0 || next.distance != 0) {
            lom_deflate_literal(block, m->data[at++]);
            now = next;
        } else {
            insert_match(m, at, now.length);
            lom_deflate_match(block, now.length, now.distance);
            at += now.length;
            now.distance = 0;
        }
        if (!lom_deflate_flush_full(block, m->data, at))
            return false;
    }
    return true;
}

/* header: the bytes of the wrapping before the stream; trailer: room asked for behind it. */
static lom_bytes deflate(const uint8_t *data, size_t size, int effort, const uint8_t *header, size_t header_size,
                         size_t trailer_size, lom_error *error)
{
    if (size >= UINT32_MAX) {
        lom_fail(error, LOM_ERROR_LIMIT, "%zu bytes are more than 2^32 - 2, which is the most to compress at once.",
                 size);
        return (lom_bytes){ 0 };
    }
    lom_deflate_block *block = lom_allocate(1, sizeof *block, error);
    matcher *m = lom_allocate(1, sizeof *m, error);
    lom_bytes out = { 0 };
    if (block != NULL && m != NULL) {
        m->data = data;
        m->size = size;
        m->effort = effort;
        block->out.error = error;
        if (lom_deflate_put_bytes(&block->out, header, header_size) && compress(m, block) &&
            lom_deflate_finish(block, data, size, trailer_size))
            out = (lom_bytes){ block->out.data, block->out.size };
        else
            lom_release(block->out.data);
    }
    lom_release(m);
    lom_release(block);
    return out;
}

lom_bytes lom_deflate_zlib(const uint8_t *data, size_t size, int effort, lom_error *error)
{
    static const uint8_t header[2] = { 0x78, 0x9c }; /* DEFLATE, window 2^15, default level; divisible by 31 */
    lom_bytes out = deflate(data, size, effort, header, sizeof header, 4, error);
    if (out.data != NULL) {
        store_32_big(out.data + out.size, lom_adler32(1, data, size));
        out.size += 4;
    }
    return out;
}

lom_bytes lom_deflate_gzip(const uint8_t *data, size_t size, int effort, lom_error *error)
{
    static const uint8_t header[10] = { 0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 255 }; /* no name, no time, unknown system */
    lom_bytes out = deflate(data, size, effort, header, sizeof header, 8, error);
    if (out.data != NULL) {
        store_32_little(out.data + out.size, lom_crc32(0, data, size));
        store_32_little(out.data + out.size + 4, (uint32_t)size);
        out.size += 8;
    }
    return out;
}
