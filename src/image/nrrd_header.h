/* What an NRRD header says, between reading its lines (nrrd_header.c), finding out what its axes mean (nrrd_axes.c) and
 * reading its samples (nrrd_read.c). */
#ifndef LOM_IMAGE_NRRD_HEADER_H
#define LOM_IMAGE_NRRD_HEADER_H

#include <lom/image.h>

enum { NRRD_MOST_DIMENSIONS = 4 };

/* The value of a field as it stands in the file; length 0 when there is none. */
typedef struct nrrd_text {
    const char *start;
    size_t length;
} nrrd_text;

typedef struct nrrd_header {
    const char *name; /* of the file, for messages */
    lom_error *error;
    int line;
    uint32_t seen; /* a bit for each field that was read */
    int dimensions;
    uint64_t sizes[NRRD_MOST_DIMENSIONS];
    int size_count;
    int bytes; /* of a sample; 0: not given */
    bool is_float, is_big, has_endian, has_encoding, is_gzip;
    uint64_t line_skip, byte_skip;
    bool at_end; /* byte skip -1: the samples are the last bytes of the file */
    nrrd_text kinds, directions;
} nrrd_header;

/* Reads the lines from the magic to the empty one and moves *at behind it. False, and the reason, unless type,
 * dimension, sizes and encoding are there and agree. */
bool lom_read_nrrd_header(nrrd_header *header, const uint8_t *data, size_t size, size_t *at);

typedef struct nrrd_layout {
    int channels, width, height, depth;
} nrrd_layout;

/* Which axis holds channels and which ones space. False, and the reason, when an axis means what no image holds. */
bool lom_find_nrrd_layout(const nrrd_header *header, nrrd_layout *layout);

#endif
