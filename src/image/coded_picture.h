/* Pictures whose header says how their texels are stored and in which order: what DDS and KTX have in common. */
#ifndef LOM_IMAGE_CODED_PICTURE_H
#define LOM_IMAGE_CODED_PICTURE_H

#include "blocks.h"

#include <lom/image.h>

/* How texels are stored. */
typedef struct lom_texel_coding {
    lom_format format;         /* of the picture that comes out */
    int side;                  /* of a block, in texels: 4, or 1 for single texels */
    int size;                  /* bytes of one in the file */
    lom_block_decoder *decode; /* NULL: single texels */
    /* Where the channels of a single texel lie in the little-endian number that its bytes are: at most 8 bits each, in a
     * row; an absent colour is 0. All absent: samples as in the picture, in the file's byte order. */
    uint32_t mask[4];
} lom_texel_coding;

/* What a header declares; the sizes may be anything. */
typedef struct lom_coded_picture {
    const char *name;
    const uint8_t *data; /* the whole file */
    size_t size, start;  /* its bytes, and where the texels begin */
    lom_texel_coding coding;
    uint64_t width, height, depth; /* depth: slices of level 0 */
    lom_slices slices;
    uint64_t levels;
    bool by_slice;         /* a slice with all of its levels, then the next; else a level with all of its slices */
    unsigned before_level; /* bytes that are not texels, before each level */
    unsigned row_unit;     /* rows of single texels fill a multiple of so many bytes */
    bool is_big;           /* big-endian samples */
    bool from_below;       /* the last row comes first */
} lom_coded_picture;

/* Slices of a level: those of a volume halve. */
int lom_coded_slices(const lom_coded_picture *picture, int level);
/* Where the texels of a slice of a level begin, from `start`, and the bytes of one; sizes are 1..LOM_MAX_SIZE. */
uint64_t lom_coded_offset(const lom_coded_picture *picture, int level, int slice);
uint64_t lom_coded_slice_bytes(const lom_coded_picture *picture, int level);

/* Whether the sizes and levels are possible, and the bytes of all texels are there; false with a sentence. */
bool lom_check_coded_picture(const lom_coded_picture *picture, lom_error *error);
/* The picture with its levels, checked so; NULL on failure. */
lom_image *lom_read_coded_picture(const lom_coded_picture *picture, lom_error *error);

#endif
