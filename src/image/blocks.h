/* Block compression, BC1 to BC5, decoded: 4 x 4 texels from 8 or 16 bytes.
 *
 * The codings are those of Khronos Data Format 1.3, chapters 18 (S3TC) and 19 (RGTC), which D3D calls BC1..BC5. Their
 * palettes are exact fractions of the stored end points (a 5-bit code counts as code/31, a 6-bit one as code/63, a byte
 * as byte/255, a signed byte as byte/127), and every texel is that fraction rounded once, to nearest: to 8 bits where
 * the end points are unsigned (the one tie there is, 127.5, becomes 128), to a float where they are signed. Graphics
 * cards are allowed to be off by a little; this is what they approximate.
 *
 * BC1: colour 0 above colour 1 as a 16-bit number: four colours, else three and black, which is transparent where the
 * coding has alpha. BC2, BC3: four colours always; alpha of 4 bits each, or as in BC4. BC4, BC5: one or two channels;
 * end 0 above end 1: eight values, else six, 0 (signed: -1) and 1. Signed -128 counts as -127 before anything else. */
#ifndef LOM_IMAGE_BLOCKS_H
#define LOM_IMAGE_BLOCKS_H

#include <stdint.h>

/* A block to 16 texels, row by row. */
typedef void lom_block_decoder(const uint8_t *block, void *texels);

lom_block_decoder lom_decode_bc1_rgb;    /* 3 bytes a texel: opaque */
lom_block_decoder lom_decode_bc1;        /* 4 */
lom_block_decoder lom_decode_bc2;        /* 4 */
lom_block_decoder lom_decode_bc3;        /* 4 */
lom_block_decoder lom_decode_bc4;        /* 1 */
lom_block_decoder lom_decode_bc5;        /* 2 */
lom_block_decoder lom_decode_bc4_signed; /* a float */
lom_block_decoder lom_decode_bc5_signed; /* 2 floats */

#endif
