/* Decompression of DEFLATE (RFC 1951), zlib (RFC 1950) and gzip (RFC 1952). In: compressed bytes; out: decompressed
 * bytes. Invariant: nothing is read behind the input or written behind the output's limit, whatever the input says. */
#include "base/reserve.h"
#include "inflate.h"

#include <string.h>

typedef lom_inflate_reader reader;
typedef lom_inflate_code code;

static bool fail(const reader *in, const char *what)
{
    return lom_fail(in->error, LOM_ERROR_INPUT, "%s: byte %zu of the compressed data: %s.", in->name,
                    in->at - (in->count > 0 ? (size_t)in->count / 8 : 0), what);
}

static bool fail_end(const reader *in)
{
    return fail(in, "the data ends in the middle");
}

/* ---- bits ---- */

/* At least 56 bits, or all that there are: enough for a length, a distance and their extra bits (48). */
static inline void refill(reader *in)
{
    if (in->size - in->at >= 8) {
        in->bits |= load_64_little(in->data + in->at) << in->count; /* bits above count are set again to the same */
        int bytes = (63 - in->count) / 8;
        in->at += (size_t)bytes;
        in->count += bytes * 8;
        return;
    }
    while (in->count <= 56 && in->at < in->size) {
        in->bits |= (uint64_t)in->data[in->at++] << in->count;
        in->count += 8;
    }
}

static inline uint32_t take(reader *in, int bits)
{
    uint32_t value = (uint32_t)(in->bits & ((UINT64_C(1) << bits) - 1));
    in->bits >>= bits;
    in->count -= bits;
    return value;
}

/* ---- Huffman codes ---- */

static uint32_t reverse(uint32_t value, int bits)
{
    uint32_t reversed = 0;
    for (int i = 0; i < bits; i++)
        reversed |= (value >> i & 1) << (bits - 1 - i);
    return reversed;
}

/* Complete codes only, but for a single code of one bit and no code at all (RFC 1951, section 3.2.7). */
static bool build(code *c, const uint8_t *lengths, int symbols, bool allow_single)
{
    uint16_t offset[INFLATE_MOST_BITS + 2] = { 0 };
    uint32_t next[INFLATE_MOST_BITS + 2] = { 0 };
    memset(c->count, 0, sizeof c->count);
    for (int i = 0; i < symbols; i++)
        c->count[lengths[i]]++;
    int used = symbols - c->count[0];
    c->count[0] = 0;
    int left = 1;
    for (int bits = 1; bits <= INFLATE_MOST_BITS; bits++) {
        left = left * 2 - c->count[bits];
        if (left < 0)
            return false;
        offset[bits + 1] = (uint16_t)(offset[bits] + c->count[bits]);
        next[bits + 1] = (next[bits] + c->count[bits]) << 1;
    }
    if (left > 0 && !(allow_single && (used == 0 || (used == 1 && c->count[1] == 1))))
        return false;
    memset(c->fast, 0, sizeof c->fast);
    for (int i = 0; i < symbols; i++) {
        int bits = lengths[i];
        if (bits == 0)
            continue;
        c->symbol[offset[bits]++] = (uint16_t)i;
        uint32_t number = next[bits]++;
        if (bits <= INFLATE_FAST_BITS)
            for (uint32_t at = reverse(number, bits); at < 1u << INFLATE_FAST_BITS; at += 1u << bits)
                c->fast[at] = (uint16_t)(i * 16 + bits);
    }
    return true;
}

/* Bit after bit: at each length the codes are [first, first + count). */
unsigned lom_find_long_code(const code *c, uint64_t next)
{
    int number = 0, first = 0, index = 0;
    for (int bits = 1; bits <= INFLATE_MOST_BITS; bits++, next >>= 1) {
        number |= (int)(next & 1);
        int count = c->count[bits];
        if (number - first < count)
            return (unsigned)c->symbol[index + number - first] * 16 + (unsigned)bits;
        index += count;
        first = (first + count) << 1;
        number <<= 1;
    }
    return 0;
}

/* The next symbol, -1 when no code fits. in->count below 0 afterwards means that the data ended. */
static inline int decode(reader *in, const code *c)
{
    unsigned entry = lom_find_code(c, in->bits);
    take(in, (int)(entry & 15));
    return entry != 0 ? (int)(entry >> 4) : -1;
}

/* ---- output ---- */

enum { FIRST = 65536 }; /* bytes */

static bool make_room(const reader *in, lom_inflated *out, size_t wanted)
{
    if (wanted > out->limit - out->size)
        return lom_fail(in->error, LOM_ERROR_LIMIT, "%s: the compressed data holds more than %zu bytes.", in->name,
                        out->limit);
    if (wanted <= out->capacity - out->size)
        return true;
    size_t needed = out->size + wanted > FIRST ? out->size + wanted : FIRST;
    if (!lom_reserve(&out->data, &out->capacity, needed, 1, in->error))
        return false;
    if (out->capacity > out->limit)
        out->capacity = out->limit; /* nothing is written beyond it */
    return true;
}

static void copy_match(lom_inflated *out, size_t length, size_t distance)
{
    uint8_t *to = out->data + out->size;
    const uint8_t *from = to - distance;
    out->size += length;
    if (distance >= length) {
        memcpy(to, from, length);
    } else if (distance == 1) {
        memset(to, from[0], length);
    } else {
        for (size_t i = 0; i < length; i++) /* overlapping: what was just written is read again */
            to[i] = from[i];
    }
}

/* ---- blocks ---- */

static bool inflate_stored(reader *in, lom_inflated *out)
{
    take(in, in->count % 8);
    in->at -= (size_t)in->count / 8; /* whole bytes go back */
    in->bits = 0;
    in->count = 0;
    if (in->size - in->at < 4)
        return fail_end(in);
    const uint8_t *p = in->data + in->at;
    size_t length = (size_t)p[0] | (size_t)p[1] << 8;
    if (((size_t)p[2] | (size_t)p[3] << 8) != (length ^ 0xffff))
        return fail(in, "the length of a stored block and its complement do not agree");
    in->at += 4;
    if (in->size - in->at < length)
        return fail_end(in);
    if (!make_room(in, out, length))
        return false;
    if (length != 0)
        memcpy(out->data + out->size, in->data + in->at, length);
    out->size += length;
    in->at += length;
    return true;
}

const uint16_t lom_inflate_length_base[INFLATE_LENGTHS] = { 3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                            15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                            67, 83, 99, 115, 131, 163, 195, 227, 258 };
const uint8_t lom_inflate_length_extra[INFLATE_LENGTHS] = { 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                            2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0 };
const uint16_t lom_inflate_distance_base[INFLATE_DISTANCES] = { 1,    2,    3,    4,     5,     7,    9,    13,
                                                                17,   25,   33,   49,    65,    97,   129,  193,
                                                                257,  385,  513,  769,   1025,  1537, 2049, 3073,
                                                                4097, 6145, 8193, 12289, 16385, 24577 };
const uint8_t lom_inflate_distance_extra[INFLATE_DISTANCES] = { 0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                                6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13 };

static bool inflate_codes(reader *in, const code *literals, const code *distances, size_t start, lom_inflated *out)
{
    for (;;) {
        if (!out->plain)
            lom_inflate_fast(in, literals, distances, start, out);
        refill(in);
        int symbol = decode(in, literals);
        if (in->count < 0)
            return fail_end(in);
        if (symbol >= 0 && symbol < INFLATE_END) {
            if (out->size == out->capacity && !make_room(in, out, 1))
                return false;
            out->data[out->size++] = (uint8_t)symbol;
            continue;
        }
        if (symbol == INFLATE_END)
            return true;
        unsigned number = (unsigned)symbol - INFLATE_FIRST_LENGTH; /* -1, no code, is beyond every code */
        if (number >= INFLATE_LENGTHS)
            return fail(in, "there is no such code for a literal or a length");
        size_t length = lom_inflate_length_base[number] + take(in, lom_inflate_length_extra[number]);
        symbol = decode(in, distances);
        if (symbol < 0 || symbol >= INFLATE_DISTANCES)
            return in->count < 0 ? fail_end(in) : fail(in, "there is no such code for a distance");
        size_t distance = lom_inflate_distance_base[symbol] + take(in, lom_inflate_distance_extra[symbol]);
        if (in->count < 0)
            return fail_end(in);
        if (distance > out->size - start)
            return fail(in, "a distance reaches before the start of the data");
        if (length > out->capacity - out->size && !make_room(in, out, length))
            return false;
        copy_match(out, length, distance);
    }
}

static bool inflate_fixed(reader *in, size_t start, lom_inflated *out)
{
    uint8_t lengths[INFLATE_LITERALS];
    code literals, distances;
    for (int i = 0; i < INFLATE_LITERALS; i++)
        lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    build(&literals, lengths, INFLATE_LITERALS, false);
    memset(lengths, 5, 32);
    build(&distances, lengths, 32, false);
    return inflate_codes(in, &literals, &distances, start, out);
}

/* The lengths of both codes, written as one sequence, themselves run-length and Huffman coded (section 3.2.7). */
static bool read_lengths(reader *in, const code *c, uint8_t *lengths, int total)
{
    static const struct {
        uint8_t base, extra;
    } repeats[3] = { { 3, 2 }, { 3, 3 }, { 11, 7 } };
    for (int i = 0; i < total;) {
        refill(in);
        int symbol = decode(in, c);
        if (in->count < 0)
            return fail_end(in);
        if (symbol < 16) { /* and not below 0: the code is complete */
            lengths[i++] = (uint8_t)symbol;
            continue;
        }
        int times = repeats[symbol - 16].base + (int)take(in, repeats[symbol - 16].extra);
        if (in->count < 0)
            return fail_end(in);
        if ((symbol == 16 && i == 0) || times > total - i)
            return fail(in, "a repeated code length has nothing to repeat or too many places");
        memset(lengths + i, symbol == 16 ? lengths[i - 1] : 0, (size_t)times);
        i += times;
    }
    return true;
}

static bool inflate_dynamic(reader *in, size_t start, lom_inflated *out)
{
    static const uint8_t order[19] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
    uint8_t lengths[INFLATE_LITERALS + 32] = { 0 };
    code literals, distances;
    int literal_count = 257 + (int)take(in, 5);
    int distance_count = 1 + (int)take(in, 5);
    int order_count = 4 + (int)take(in, 4);
    for (int i = 0; i < order_count && in->count >= 0; i++) {
        refill(in);
        lengths[order[i]] = (uint8_t)take(in, 3);
    }
    if (in->count < 0)
        return fail_end(in);
    if (literal_count > 286 || distance_count > INFLATE_DISTANCES)
        return fail(in, "a block declares more codes than there are symbols");
    if (!build(&literals, lengths, 19, false))
        return fail(in, "the code of the code lengths is not complete");
    memset(lengths, 0, sizeof lengths);
    if (!read_lengths(in, &literals, lengths, literal_count + distance_count))
        return false;
    if (lengths[INFLATE_END] == 0)
        return fail(in, "a block has no code for its end");
    if (!build(&distances, lengths + literal_count, distance_count, true) ||
        !build(&literals, lengths, literal_count, true))
        return fail(in, "the code of a block is not complete");
    return inflate_codes(in, &literals, &distances, start, out);
}

bool lom_inflate(const char *name, const uint8_t *data, size_t size, size_t *at, size_t start, lom_inflated *out,
                 lom_error *error)
{
    reader in = { .name = name, .data = data, .size = size, .at = *at, .error = error };
    bool last = false;
    while (!last) {
        refill(&in);
        if (in.count < 3)
            return fail_end(&in);
        last = take(&in, 1) != 0;
        uint32_t kind = take(&in, 2);
        bool good = kind == 0   ? inflate_stored(&in, out)
                    : kind == 1 ? inflate_fixed(&in, start, out)
                    : kind == 2 ? inflate_dynamic(&in, start, out)
                                : fail(&in, "there is no such kind of block");
        if (!good)
            return false;
    }
    *at = in.at - (size_t)in.count / 8;
    return true;
}
