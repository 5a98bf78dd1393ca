/* Blocks of DEFLATE. In: tokens and their counts; out: bits, in the cheapest of the three kinds of block (RFC 1951,
 * section 3.2.3). The size of each kind is computed before anything is written. */
#include "base/reserve.h"
#include "deflate.h"

#include "bytes.h"
#include "huffman.h"

#include <string.h>

enum { END_OF_BLOCK = 256, LENGTH_CODES = 19, MOST_STORED = 65535, STORED = 0, FIXED = 1, DYNAMIC = 2 };

typedef struct codes {
    uint8_t literal_length[LOM_HUFFMAN_SYMBOLS], distance_length[32];
    uint16_t literal[LOM_HUFFMAN_SYMBOLS], distance[32];
} codes;

/* The two sequences of lengths as they are written: run-length coded, each entry a symbol and its extra bits. */
typedef struct header {
    int literals, distances, order_count, entry_count;
    struct {
        uint8_t symbol, extra;
    } entries[LOM_HUFFMAN_SYMBOLS + 32];
    uint8_t length[LENGTH_CODES];
    uint16_t code[LENGTH_CODES];
    uint64_t cost;
} header;

static const uint8_t order[LENGTH_CODES] = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 };
static const uint8_t repeat_extra[LENGTH_CODES] = { [16] = 2, [17] = 3, [18] = 7 };

/* ---- bits ---- */

static bool reserve(lom_bit_writer *out, size_t wanted)
{
    return lom_reserve(&out->data, &out->capacity, out->size + wanted, 1, out->error);
}

/* At most 48 bits; 8 bytes of room. */
static inline void put(lom_bit_writer *out, uint64_t bits, int count)
{
    out->bits |= bits << out->count;
    out->count += count;
    if (out->count >= 16) {
        store_64_little(out->data + out->size, out->bits);
        int bytes = out->count / 8;
        out->size += (size_t)bytes;
        out->bits = bytes < 8 ? out->bits >> (8 * bytes) : 0;
        out->count -= 8 * bytes;
    }
}

static void fill_byte(lom_bit_writer *out)
{
    while (out->count > 0) {
        out->data[out->size++] = (uint8_t)out->bits;
        out->bits >>= 8;
        out->count -= 8;
    }
    out->count = 0;
    out->bits = 0;
}

bool lom_deflate_put_bytes(lom_bit_writer *out, const uint8_t *bytes, size_t size)
{
    if (!reserve(out, size + 8))
        return false;
    if (size != 0)
        memcpy(out->data + out->size, bytes, size);
    out->size += size;
    return true;
}

/* ---- costs and codes ---- */

static uint64_t token_cost(const lom_deflate_block *block, const codes *c)
{
    uint64_t cost = 0;
    for (int i = 0; i < LOM_DEFLATE_LITERALS; i++) {
        int extra = i > 264 && i < 285 ? (i - 261) / 4 : 0;
        cost += (uint64_t)block->literal_counts[i] * (uint64_t)(c->literal_length[i] + extra);
    }
    for (int i = 0; i < LOM_DEFLATE_DISTANCES; i++) {
        int extra = i > 3 ? i / 2 - 1 : 0;
        cost += (uint64_t)block->distance_counts[i] * (uint64_t)(c->distance_length[i] + extra);
    }
    return cost;
}

static void make_fixed(codes *c)
{
    for (int i = 0; i < LOM_HUFFMAN_SYMBOLS; i++)
        c->literal_length[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    memset(c->distance_length, 5, sizeof c->distance_length);
    lom_huffman_codes(c->literal_length, LOM_HUFFMAN_SYMBOLS, c->literal);
    lom_huffman_codes(c->distance_length, 32, c->distance);
}

static void make_dynamic(const lom_deflate_block *block, codes *c)
{
    memset(c, 0, sizeof *c);
    lom_huffman_lengths(block->literal_counts, LOM_DEFLATE_LITERALS, 15, c->literal_length);
    lom_huffman_lengths(block->distance_counts, LOM_DEFLATE_DISTANCES, 15, c->distance_length);
    lom_huffman_codes(c->literal_length, LOM_DEFLATE_LITERALS, c->literal);
    lom_huffman_codes(c->distance_length, LOM_DEFLATE_DISTANCES, c->distance);
}

static void add_entry(header *h, int symbol, int extra)
{
    h->entries[h->entry_count].symbol = (uint8_t)symbol;
    h->entries[h->entry_count++].extra = (uint8_t)extra;
}

/* One run of equal lengths: zeros by symbol 18 (11..138) and 17 (3..10), others once and then by 16 (3..6). */
static void add_run(header *h, int length, int times)
{
    if (length != 0) {
        add_entry(h, length, 0);
        times--;
    }
    while (times >= 3) {
        int most = length != 0 ? 6 : times >= 11 ? 138 : 10;
        int run = times < most ? times : most;
        if (length != 0)
            add_entry(h, 16, run - 3);
        else
            add_entry(h, run >= 11 ? 18 : 17, run >= 11 ? run - 11 : run - 3);
        times -= run;
    }
    for (; times > 0; times--)
        add_entry(h, length, 0);
}

static void make_header(const codes *c, header *h)
{
    uint8_t lengths[LOM_DEFLATE_LITERALS + LOM_DEFLATE_DISTANCES];
    uint32_t counts[LENGTH_CODES] = { 0 };
    *h = (header){ .literals = LOM_DEFLATE_LITERALS, .distances = LOM_DEFLATE_DISTANCES, .order_count = LENGTH_CODES };
    while (h->literals > 257 && c->literal_length[h->literals - 1] == 0)
        h->literals--;
    while (h->distances > 1 && c->distance_length[h->distances - 1] == 0)
        h->distances--;
    int total = h->literals + h->distances;
    memcpy(lengths, c->literal_length, (size_t)h->literals);
    memcpy(lengths + h->literals, c->distance_length, (size_t)h->distances);
    for (int i = 0, end; i < total; i = end) {
        for (end = i + 1; end < total && lengths[end] == lengths[i]; end++)
            ;
        add_run(h, lengths[i], end - i);
    }
    for (int i = 0; i < h->entry_count; i++)
        counts[h->entries[i].symbol]++;
    lom_huffman_lengths(counts, LENGTH_CODES, 7, h->length);
    lom_huffman_codes(h->length, LENGTH_CODES, h->code);
    while (h->order_count > 4 && h->length[order[h->order_count - 1]] == 0)
        h->order_count--;
    h->cost = 14 + 3 * (uint64_t)h->order_count;
    for (int i = 0; i < h->entry_count; i++)
        h->cost += (uint64_t)(h->length[h->entries[i].symbol] + repeat_extra[h->entries[i].symbol]);
}

/* ---- writing ---- */

static void write_header(lom_bit_writer *out, const header *h)
{
    put(out, (uint64_t)h->literals - 257, 5);
    put(out, (uint64_t)h->distances - 1, 5);
    put(out, (uint64_t)h->order_count - 4, 4);
    for (int i = 0; i < h->order_count; i++)
        put(out, h->length[order[i]], 3);
    for (int i = 0; i < h->entry_count; i++) {
        int symbol = h->entries[i].symbol;
        put(out, h->code[symbol], h->length[symbol]);
        put(out, h->entries[i].extra, repeat_extra[symbol]);
    }
}

static void write_tokens(lom_bit_writer *out, const lom_deflate_block *block, const codes *c)
{
    for (int i = 0; i < block->token_count; i++) {
        uint32_t token = block->tokens[i], length = token >> 16, distance = token & 0xffff;
        if (length == 0) {
            put(out, c->literal[token], c->literal_length[token]);
            continue;
        }
        int extra, count;
        int symbol = lom_length_symbol(length, &extra);
        uint64_t bits = c->literal[symbol];
        count = c->literal_length[symbol];
        bits |= (uint64_t)((length - 3) & ((1u << extra) - 1)) << count;
        count += extra;
        symbol = lom_distance_symbol(distance, &extra);
        bits |= (uint64_t)c->distance[symbol] << count;
        count += c->distance_length[symbol];
        bits |= (uint64_t)(distance & ((1u << extra) - 1)) << count;
        count += extra;
        put(out, bits, count);
    }
    put(out, c->literal[END_OF_BLOCK], c->literal_length[END_OF_BLOCK]);
}

static bool write_stored(lom_bit_writer *out, const uint8_t *data, size_t size, bool last)
{
    do {
        size_t piece = size < MOST_STORED ? size : MOST_STORED;
        put(out, last && piece == size, 3);
        fill_byte(out);
        const uint8_t lengths[4] = { (uint8_t)piece, (uint8_t)(piece >> 8), (uint8_t)~piece, (uint8_t)(~piece >> 8) };
        if (!lom_deflate_put_bytes(out, lengths, sizeof lengths) || !lom_deflate_put_bytes(out, data, piece))
            return false;
        data += piece;
        size -= piece;
    } while (size != 0);
    return true;
}

bool lom_deflate_flush(lom_deflate_block *block, const uint8_t *data, size_t at, bool last)
{
    codes fixed, dynamic;
    header h;
    lom_bit_writer *out = &block->out;
    block->literal_counts[END_OF_BLOCK] = 1;
    make_fixed(&fixed);
    make_dynamic(block, &dynamic);
    make_header(&dynamic, &h);
    uint64_t size = at - block->start;
    uint64_t stored_cost = (size / MOST_STORED + 1) * 40 + 8 * size;
    uint64_t fixed_cost = token_cost(block, &fixed), dynamic_cost = h.cost + token_cost(block, &dynamic);
    uint64_t cost = fixed_cost < dynamic_cost ? fixed_cost : dynamic_cost;
    bool stored = stored_cost < cost; /* reserves its own room */
    bool good = reserve(out, (size_t)(stored ? 0 : cost) / 8 + 32);
    if (good && stored) {
        good = write_stored(out, data + block->start, (size_t)size, last);
    } else if (good) {
        bool is_fixed = fixed_cost <= dynamic_cost;
        put(out, (uint64_t)(is_fixed ? FIXED : DYNAMIC) << 1 | last, 3);
        if (!is_fixed)
            write_header(out, &h);
        write_tokens(out, block, is_fixed ? &fixed : &dynamic);
    }
    block->token_count = 0;
    block->start = at;
    memset(block->literal_counts, 0, sizeof block->literal_counts);
    memset(block->distance_counts, 0, sizeof block->distance_counts);
    return good;
}

bool lom_deflate_finish(lom_deflate_block *block, const uint8_t *data, size_t size, size_t trailer)
{
    if (!lom_deflate_flush(block, data, size, true) || !reserve(&block->out, trailer + 8))
        return false;
    fill_byte(&block->out);
    return true;
}
