/* Compressed data: DEFLATE (RFC 1951) in its zlib (RFC 1950) and gzip (RFC 1952) wrappings, and their checksums.
 * `name` is the file's name for messages, which count the bytes of the compressed data from 0. */
#ifndef LOM_IMAGE_ZIP_H
#define LOM_IMAGE_ZIP_H

#include <lom/base.h>

/* DEFLATE gives at most 258 bytes for 2 bits: a declared size beyond this many times the compressed one is a lie. */
enum { LOM_INFLATE_RATIO = 1032 };

/* Where decompressed bytes go. data has capacity bytes, of which size are filled; when capacity is below limit, data is
 * from lom_allocate (or NULL) and is enlarged as needed. */
typedef struct lom_inflated {
    uint8_t *data;
    size_t size, capacity, limit;
    bool plain; /* symbol after symbol, never by the fast loop: the same bytes, for tests */
} lom_inflated;

/* Decompresses one DEFLATE stream at data[*at], moves *at behind it and appends to out. Matches reach back to
 * out->data[start] at most. More than out->limit bytes is LOM_ERROR_LIMIT, anything malformed LOM_ERROR_INPUT. */
bool lom_inflate(const char *name, const uint8_t *data, size_t size, size_t *at, size_t start, lom_inflated *out,
                 lom_error *error);

/* Decompresses a zlib stream that must hold exactly out_size bytes, checksum included. */
bool lom_inflate_zlib(const char *name, const uint8_t *data, size_t size, uint8_t *out, size_t out_size,
                      lom_error *error);

/* Decompresses all members of a gzip file, checksums included; at most limit bytes. data is NULL on failure. */
lom_bytes lom_inflate_gzip(const char *name, const uint8_t *data, size_t size, size_t limit, lom_error *error);

/* Compresses; the same bytes everywhere. effort is the number of earlier places tried for a match, 1..4096. data is
 * NULL on failure. */
lom_bytes lom_deflate_zlib(const uint8_t *data, size_t size, int effort, lom_error *error);
lom_bytes lom_deflate_gzip(const uint8_t *data, size_t size, int effort, lom_error *error);

/* CRC-32 (ISO 3309, as in PNG and gzip) of what was hashed so far (0 at first) and size more bytes. */
uint32_t lom_crc32(uint32_t crc, const void *data, size_t size);
/* Adler-32 (RFC 1950) of what was summed so far (1 at first) and size more bytes. */
uint32_t lom_adler32(uint32_t adler, const void *data, size_t size);

#endif
