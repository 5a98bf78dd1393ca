/* Between the two steps of compression: deflate.c finds matches and gives tokens, deflate_block.c writes them as blocks
 * of DEFLATE. */
#ifndef LOM_IMAGE_DEFLATE_H
#define LOM_IMAGE_DEFLATE_H

#include <lom/base.h>

enum {
    LOM_DEFLATE_WINDOW = 1 << 15,
    LOM_DEFLATE_TOKENS = 1 << 15,
    LOM_DEFLATE_LITERALS = 286,
    LOM_DEFLATE_DISTANCES = 30
};

/* Bits, the first one lowest, into memory that grows. */
typedef struct lom_bit_writer {
    uint8_t *data;
    size_t size, capacity;
    uint64_t bits;
    int count; /* bits waiting, at most 63 */
    lom_error *error;
} lom_bit_writer;

typedef struct lom_deflate_block {
    uint32_t tokens[LOM_DEFLATE_TOKENS]; /* a literal, or length << 16 | distance - 1 */
    int token_count;
    size_t start; /* the place in the input where the tokens begin */
    uint32_t literal_counts[LOM_DEFLATE_LITERALS], distance_counts[LOM_DEFLATE_DISTANCES];
    lom_bit_writer out;
} lom_deflate_block;

/* The symbol of a match length (257..285) and of a distance - 1 (0..29), with the number of their extra bits: both grow
 * with the binary logarithm and its next two bits or one (RFC 1951, section 3.2.5). */
static inline int lom_length_symbol(uint32_t length, int *extra)
{
    uint32_t rest = length - 3;
    int log = 31 - __builtin_clz(rest | 1);
    *extra = log >= 3 && length != 258 ? log - 2 : 0;
    if (length == 258)
        return 285;
    return rest < 8 ? 257 + (int)rest : 257 + (log - 1) * 4 + (int)(rest >> (log - 2) & 3);
}

static inline int lom_distance_symbol(uint32_t distance_less_1, int *extra)
{
    int log = 31 - __builtin_clz(distance_less_1 | 1);
    *extra = log >= 2 ? log - 1 : 0;
    return distance_less_1 < 4 ? (int)distance_less_1 : 2 * log + (int)(distance_less_1 >> (log - 1) & 1);
}

static inline void lom_deflate_literal(lom_deflate_block *block, uint8_t literal)
{
    block->tokens[block->token_count++] = literal;
    block->literal_counts[literal]++;
}

static inline void lom_deflate_match(lom_deflate_block *block, uint32_t length, uint32_t distance)
{
    int extra;
    block->tokens[block->token_count++] = length << 16 | (distance - 1);
    block->literal_counts[lom_length_symbol(length, &extra)]++;
    block->distance_counts[lom_distance_symbol(distance - 1, &extra)]++;
}

/* Writes the tokens up to input place `at` as a block when the buffer is full. False when memory is. */
bool lom_deflate_flush(lom_deflate_block *block, const uint8_t *data, size_t at, bool last);

static inline bool lom_deflate_flush_full(lom_deflate_block *block, const uint8_t *data, size_t at)
{
    return block->token_count < LOM_DEFLATE_TOKENS || lom_deflate_flush(block, data, at, false);
}

/* Writes the last block and fills up the byte; `trailer` more bytes fit behind. */
bool lom_deflate_finish(lom_deflate_block *block, const uint8_t *data, size_t size, size_t trailer);

bool lom_deflate_put_bytes(lom_bit_writer *out, const uint8_t *bytes, size_t size);

#endif
