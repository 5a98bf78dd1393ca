/* What the plain and the fast loop of decompression share: the bits not yet used and the Huffman codes. */
#ifndef LOM_IMAGE_INFLATE_H
#define LOM_IMAGE_INFLATE_H

#include "bytes.h"
#include "zip.h"

enum { INFLATE_MOST_BITS = 15, INFLATE_FAST_BITS = 11, INFLATE_LITERALS = 288, INFLATE_DISTANCES = 30 };
enum { INFLATE_END = 256, INFLATE_FIRST_LENGTH = 257, INFLATE_LENGTHS = 29, INFLATE_LONGEST = 258 };

/* The bits not yet used, the next one lowest. Behind the end of the data zeros would follow; taking one is an error. */
typedef struct lom_inflate_reader {
    const char *name;
    const uint8_t *data;
    size_t size, at;
    uint64_t bits;
    int count;
    lom_error *error;
} lom_inflate_reader;

/* A canonical Huffman code: codes of one length are consecutive numbers, in the order of their symbols. */
typedef struct lom_inflate_code {
    uint16_t fast[1 << INFLATE_FAST_BITS]; /* by the next bits: symbol * 16 + length, 0 for a longer code or none */
    uint16_t count[INFLATE_MOST_BITS + 1]; /* codes of each length */
    uint16_t symbol[INFLATE_LITERALS];     /* by length, then by number */
} lom_inflate_code;

/* What symbol INFLATE_FIRST_LENGTH + i, or distance symbol i, stands for: base plus the number in its extra bits. */
extern const uint16_t lom_inflate_length_base[INFLATE_LENGTHS], lom_inflate_distance_base[INFLATE_DISTANCES];
extern const uint8_t lom_inflate_length_extra[INFLATE_LENGTHS], lom_inflate_distance_extra[INFLATE_DISTANCES];

/* A code longer than INFLATE_FAST_BITS, in the form of lom_find_code. */
unsigned lom_find_long_code(const lom_inflate_code *code, uint64_t next);

/* Symbol * 16 + length of the code that the next bits start with, 0 when no code fits. */
static inline unsigned lom_find_code(const lom_inflate_code *code, uint64_t next)
{
    unsigned entry = code->fast[next & ((1 << INFLATE_FAST_BITS) - 1)];
    return entry != 0 ? entry : lom_find_long_code(code, next);
}

/* Takes symbols and appends what they stand for, as lom_inflate's own loop does, for as long as neither the input nor
 * the room can end within a step. What ends a block or is wrong is left in the reader, untouched. */
void lom_inflate_fast(lom_inflate_reader *in, const lom_inflate_code *literals, const lom_inflate_code *distances,
                      size_t start, lom_inflated *out);

#endif
