/* Huffman codes for writing: their lengths from counted symbols, and the codes from the lengths. */
#ifndef LOM_IMAGE_HUFFMAN_H
#define LOM_IMAGE_HUFFMAN_H

#include <stdint.h>

enum { LOM_HUFFMAN_SYMBOLS = 288 };

/* The lengths of an optimal prefix code of `symbols` symbols with these frequencies, none longer than limit bits; 0 for
 * unused symbols. At least two symbols get a code, so that the code is complete. */
void lom_huffman_lengths(const uint32_t *frequencies, int symbols, int limit, uint8_t *lengths);

/* The canonical codes of these lengths (RFC 1951, section 3.2.2), reversed as they are written from the lowest bit. */
void lom_huffman_codes(const uint8_t *lengths, int symbols, uint16_t *codes);

#endif
