/* The wrappings of compressed data, read: zlib (RFC 1950) and gzip (RFC 1952). In: a whole file or stream; out: its
 * content, whose checksum was right. */
#include "zip.h"

#include "bytes.h"

#include <string.h>

bool lom_inflate_zlib(const char *name, const uint8_t *data, size_t size, uint8_t *out, size_t out_size,
                      lom_error *error)
{
    /* method 8 (DEFLATE), a window of at most 2^15, no preset dictionary, header divisible by 31 */
    if (size < 2 || (data[0] & 15) != 8 || data[0] >> 4 > 7 || (data[1] & 32) != 0 || load_16_big(data) % 31 != 0)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 0 of the compressed data: this is no zlib header.", name);
    lom_inflated inflated = { .data = out, .capacity = out_size, .limit = out_size };
    size_t at = 2;
    if (!lom_inflate(name, data, size, &at, 0, &inflated, error))
        return false;
    if (inflated.size != out_size)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: the compressed data holds %zu bytes instead of %zu.", name,
                        inflated.size, out_size);
    if (size - at < 4)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: the compressed data ends before its checksum.", name);
    if (load_32_big(data + at) != lom_adler32(1, out, out_size))
        return lom_fail(error, LOM_ERROR_INPUT, "%s: the Adler-32 checksum of the decompressed data is wrong.", name);
    return true;
}

/* ---- gzip ---- */

enum { HEADER_CRC = 2, EXTRA = 4, FILE_NAME = 8, COMMENT = 16, RESERVED = 0xe0 };

static bool skip_text(const uint8_t *data, size_t size, size_t *at)
{
    const uint8_t *end = *at < size ? memchr(data + *at, 0, size - *at) : NULL;
    if (end == NULL)
        return false;
    *at = (size_t)(end - data) + 1;
    return true;
}

/* Moves *at behind the header of a member; false when there is none. */
static bool skip_header(const uint8_t *data, size_t size, size_t *at)
{
    const uint8_t *p = data + *at;
    if (size - *at < 10 || p[0] != 0x1f || p[1] != 0x8b || p[2] != 8 || (p[3] & RESERVED) != 0)
        return false;
    int flags = p[3];
    *at += 10;
    if (flags & EXTRA) {
        if (size - *at < 2)
            return false;
        size_t length = data[*at] + (size_t)data[*at + 1] * 256;
        if (size - *at - 2 < length)
            return false;
        *at += 2 + length;
    }
    if ((flags & FILE_NAME) && !skip_text(data, size, at))
        return false;
    if ((flags & COMMENT) && !skip_text(data, size, at))
        return false;
    if (flags & HEADER_CRC) {
        if (size - *at < 2)
            return false;
        *at += 2;
    }
    return true;
}

static bool inflate_member(const char *name, const uint8_t *data, size_t size, size_t *at, lom_inflated *out,
                           lom_error *error)
{
    size_t header = *at, start = out->size;
    if (!skip_header(data, size, at))
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: this is no gzip header.", name, header);
    if (!lom_inflate(name, data, size, at, start, out, error))
        return false;
    if (size - *at < 8)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the file ends before its checksum.", name, *at);
    size_t length = out->size - start;
    if (load_32_little(data + *at) != lom_crc32(0, length != 0 ? out->data + start : out->data, length) ||
        load_32_little(data + *at + 4) != (uint32_t)length)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the checksum or size of the decompressed data is wrong.",
                        name, *at);
    *at += 8;
    return true;
}

lom_bytes lom_inflate_gzip(const char *name, const uint8_t *data, size_t size, size_t limit, lom_error *error)
{
    lom_inflated out = { .limit = limit };
    size_t at = 0;
    bool good = true;
    do {
        good = inflate_member(name, data, size, &at, &out, error);
    } while (good && size - at >= 2 && data[at] == 0x1f && data[at + 1] == 0x8b); /* zeros may pad the end */
    if (good && out.data == NULL)
        out.data = lom_allocate(1, 1, error);
    if (!good) {
        lom_release(out.data);
        return (lom_bytes){ 0 };
    }
    return (lom_bytes){ out.data, out.size };
}
