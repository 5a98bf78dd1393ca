/* KTX files of version 1 (Khronos, KTX File Format Specification, version 1, 2013). In: a header of 64 bytes in either
 * byte order, pairs of keys and values, and levels, each behind its size: single texels, rows on 4 bytes, or blocks.
 * Out: a picture, a volume, a cube or an array with its mip levels. The first row is the top one, as the specification
 * prefers, unless the key KTXorientation says T=u. Invariant: a level's size is what its header makes it. */
#include "codec.h"

#include "bytes.h"
#include "coded_picture.h"

#include <string.h>

enum { HEADER = 64, ROW_UNIT = 4 };

/* Compressed: glInternalFormat of EXT_texture_compression_s3tc, EXT_texture_sRGB and OpenGL 3.0 (RGTC). */
static const struct {
    uint32_t number;
    lom_texel_coding coding;
} compressed[] = {
    { 0x83f0, { LOM_FORMAT_RGB8, 4, 8, lom_decode_bc1_rgb, { 0 } } },
    { 0x83f1, { LOM_FORMAT_RGBA8, 4, 8, lom_decode_bc1, { 0 } } },
    { 0x83f2, { LOM_FORMAT_RGBA8, 4, 16, lom_decode_bc2, { 0 } } },
    { 0x83f3, { LOM_FORMAT_RGBA8, 4, 16, lom_decode_bc3, { 0 } } },
    { 0x8c4c, { LOM_FORMAT_RGB8, 4, 8, lom_decode_bc1_rgb, { 0 } } },
    { 0x8c4d, { LOM_FORMAT_RGBA8, 4, 8, lom_decode_bc1, { 0 } } },
    { 0x8c4e, { LOM_FORMAT_RGBA8, 4, 16, lom_decode_bc2, { 0 } } },
    { 0x8c4f, { LOM_FORMAT_RGBA8, 4, 16, lom_decode_bc3, { 0 } } },
    { 0x8dbb, { LOM_FORMAT_R8, 4, 8, lom_decode_bc4, { 0 } } },
    { 0x8dbc, { LOM_FORMAT_R32F, 4, 8, lom_decode_bc4_signed, { 0 } } },
    { 0x8dbd, { LOM_FORMAT_RG8, 4, 16, lom_decode_bc5, { 0 } } },
    { 0x8dbe, { LOM_FORMAT_RG32F, 4, 16, lom_decode_bc5_signed, { 0 } } },
};

/* Single texels: glType, the format of one channel (those of two to four follow it). */
static const struct {
    uint32_t number, size;
    lom_format format;
} types[] = {
    { 0x1401, 1, LOM_FORMAT_R8 },   /* GL_UNSIGNED_BYTE */
    { 0x1403, 2, LOM_FORMAT_R16 },  /* GL_UNSIGNED_SHORT */
    { 0x140b, 2, LOM_FORMAT_R16F }, /* GL_HALF_FLOAT */
    { 0x1406, 4, LOM_FORMAT_R32F }, /* GL_FLOAT */
};

/* glFormat. Where masks say so the channels are in another order, which is read of bytes only. */
static const struct {
    uint32_t number;
    int stored, channels;
    uint32_t mask[4];
} formats[] = {
    { 0x1903, 1, 1, { 0 } },                                  /* GL_RED */
    { 0x1909, 1, 1, { 0 } },                                  /* GL_LUMINANCE */
    { 0x1906, 1, 4, { 0, 0, 0, 0xff } },                      /* GL_ALPHA */
    { 0x8227, 2, 2, { 0 } },                                  /* GL_RG */
    { 0x190a, 2, 2, { 0 } },                                  /* GL_LUMINANCE_ALPHA */
    { 0x1907, 3, 3, { 0 } },                                  /* GL_RGB */
    { 0x80e0, 3, 3, { 0xff0000, 0xff00, 0xff, 0 } },          /* GL_BGR */
    { 0x1908, 4, 4, { 0 } },                                  /* GL_RGBA */
    { 0x80e1, 4, 4, { 0xff0000, 0xff00, 0xff, 0xff000000 } }, /* GL_BGRA */
};

static uint32_t load(const lom_coded_picture *p, size_t at)
{
    return p->is_big ? load_32_big(p->data + at) : load_32_little(p->data + at);
}

static bool find_compressed(lom_coded_picture *p, uint32_t number)
{
    for (size_t i = 0; i < sizeof compressed / sizeof *compressed; i++)
        if (compressed[i].number == number) {
            p->coding = compressed[i].coding;
            return true;
        }
    return false;
}

static bool find_single(lom_coded_picture *p, uint32_t type, uint32_t size, uint32_t format)
{
    for (size_t t = 0; t < sizeof types / sizeof *types; t++)
        for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
            bool masked = (formats[f].mask[0] | formats[f].mask[3]) != 0;
            if (types[t].number != type || types[t].size != size || formats[f].number != format || (masked && size > 1))
                continue;
            lom_format made = (lom_format)((int)types[t].format + formats[f].channels - 1);
            p->coding = (lom_texel_coding){ made, 1, formats[f].stored * (int)size, NULL, { 0 } };
            memcpy(p->coding.mask, formats[f].mask, sizeof p->coding.mask);
            return true;
        }
    return false;
}

static bool find_coding(lom_coded_picture *p, lom_error *error)
{
    uint32_t type = load(p, 16), size = load(p, 20), format = load(p, 24), internal = load(p, 28);
    if (type == 0 && format == 0 ? find_compressed(p, internal) : find_single(p, type, size, format))
        return true;
    return lom_fail(error, LOM_ERROR_INPUT,
                    "%s: byte 16: texels of type 0x%x (%u bytes), format 0x%x and internal format 0x%x are not read.",
                    p->name, type, size, format, internal);
}

static bool read_sizes(lom_coded_picture *p, lom_error *error)
{
    uint32_t height = load(p, 40), depth = load(p, 44), elements = load(p, 48), faces = load(p, 52);
    uint32_t levels = load(p, 56);
    if ((faces != 1 && faces != 6) || (elements > 0) + (depth > 0) + (faces == 6) > 1)
        return lom_fail(error, LOM_ERROR_INPUT,
                        "%s: byte 44: a texture of depth %u with %u elements of %u faces is not read.", p->name, depth,
                        elements, faces);
    p->width = load(p, 36);
    p->height = height > 0 ? height : 1;
    p->depth = faces == 6 ? 6 : elements > 0 ? elements : depth > 0 ? depth : 1;
    p->slices = faces == 6 ? LOM_SLICES_CUBE : elements > 0 ? LOM_SLICES_LAYERS : LOM_SLICES_VOLUME;
    p->levels = levels > 0 ? levels : 1;
    return true;
}

/* The pairs of keys and values: which row comes first. */
static bool read_pairs(lom_coded_picture *p, lom_error *error)
{
    static const char key[] = "KTXorientation";
    uint32_t bytes = load(p, 60);
    size_t at = HEADER, end = HEADER + (size_t)bytes;
    if (bytes > p->size - HEADER)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 60: the file ends in the keys and values.", p->name);
    while (end - at >= 4) {
        size_t length = load(p, at), padded = (length + 3) / 4 * 4;
        const uint8_t *text = p->data + at + 4;
        if (length > end - at - 4)
            return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: a key and its value go beyond their end.", p->name,
                            at);
        if (length >= sizeof key + 7 && memcmp(text, key, sizeof key) == 0)
            p->from_below = memcmp(text + sizeof key + 3, ",T=u", 4) == 0;
        at += padded < end - at - 4 ? 4 + padded : end - at;
    }
    p->start = end;
    return true;
}

/* What each level's size says: of a cube the bytes of one face. */
static bool check_level_sizes(const lom_coded_picture *p, lom_error *error)
{
    for (int level = 0; level < (int)p->levels; level++) {
        size_t at = p->start + lom_coded_offset(p, level, 0) - 4;
        uint64_t slices = p->slices == LOM_SLICES_CUBE ? 1 : (uint64_t)lom_coded_slices(p, level);
        if (load(p, at) != slices * lom_coded_slice_bytes(p, level))
            return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: level %d has %.0f bytes, not %u.", p->name, at,
                            level, (double)(slices * lom_coded_slice_bytes(p, level)), load(p, at));
    }
    return true;
}

lom_image *lom_decode_ktx(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    lom_coded_picture picture = { .name = name, .data = data, .size = size, .before_level = 4, .row_unit = ROW_UNIT };
    if (size < HEADER) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the file ends in the header.", name, size);
        return NULL;
    }
    picture.is_big = load_32_big(data + 12) == 0x04030201;
    if (!picture.is_big && load_32_little(data + 12) != 0x04030201) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: byte 12: this byte order is neither of the two.", name);
        return NULL;
    }
    bool done = find_coding(&picture, error) && read_sizes(&picture, error) && read_pairs(&picture, error) &&
                lom_check_coded_picture(&picture, error) && check_level_sizes(&picture, error);
    return done ? lom_read_coded_picture(&picture, error) : NULL;
}
