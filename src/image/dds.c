/* DDS files (Microsoft, Programming Guide for DDS, with DDS_HEADER, DDS_PIXELFORMAT and DDS_HEADER_DXT10). In: a header
 * of 128 bytes, 20 more where the four-character code is DX10, and surfaces: single texels or blocks, little-endian,
 * rows on bytes. Out: a picture, a volume, a cube or an array with its mip levels. What numbers mean (sRGB, alpha
 * multiplied beforehand) is left to the caller, as of every picture file; typeless formats are read as unsigned
 * normalised ones. Written are single texels with the long header, all levels and slices. Invariant: a header whose fields contradict each other is refused. */
#include "codec.h"

#include "bytes.h"
#include "coded_picture.h"

#include <string.h>

enum { HEADER = 128, LONG_HEADER = 148 };
enum { PIXELS_HAVE_ALPHA = 0x1, ONLY_ALPHA = 0x2, CODED = 0x4, COLORS = 0x40, LUMINANCE = 0x20000 };
enum { CUBE = 0x200, ALL_FACES = 0xfc00, VOLUME = 0x200000 };
enum { DIMENSION_3D = 4, MISC_CUBE = 4 };

#define CODE(text)                                                                                                     \
    ((uint32_t)(text)[0] | (uint32_t)(text)[1] << 8 | (uint32_t)(text)[2] << 16 | (uint32_t)(text)[3] << 24)

/* A coding, the codes that legacy headers give it (four characters or a number of D3DFORMAT) and those of DXGI_FORMAT. */
static const struct row {
    const char *codes[2];
    uint8_t number, dxgi[3];
    lom_texel_coding coding;
} rows[] = {
    { { "DXT1" }, 0, { 71, 72, 70 }, { LOM_FORMAT_RGBA8, 4, 8, lom_decode_bc1, { 0 } } },
    { { "DXT3", "DXT2" }, 0, { 74, 75, 73 }, { LOM_FORMAT_RGBA8, 4, 16, lom_decode_bc2, { 0 } } },
    { { "DXT5", "DXT4" }, 0, { 77, 78, 76 }, { LOM_FORMAT_RGBA8, 4, 16, lom_decode_bc3, { 0 } } },
    { { "BC4U", "ATI1" }, 0, { 80, 79 }, { LOM_FORMAT_R8, 4, 8, lom_decode_bc4, { 0 } } },
    { { "BC4S" }, 0, { 81 }, { LOM_FORMAT_R32F, 4, 8, lom_decode_bc4_signed, { 0 } } },
    { { "BC5U", "ATI2" }, 0, { 83, 82 }, { LOM_FORMAT_RG8, 4, 16, lom_decode_bc5, { 0 } } },
    { { "BC5S" }, 0, { 84 }, { LOM_FORMAT_RG32F, 4, 16, lom_decode_bc5_signed, { 0 } } },
    { { NULL }, 0, { 61, 60 }, { LOM_FORMAT_R8, 1, 1, NULL, { 0 } } },
    { { NULL }, 0, { 49, 48 }, { LOM_FORMAT_RG8, 1, 2, NULL, { 0 } } },
    { { NULL }, 0, { 28, 29, 27 }, { LOM_FORMAT_RGBA8, 1, 4, NULL, { 0 } } },
    { { NULL }, 0, { 87, 91, 90 }, { LOM_FORMAT_RGBA8, 1, 4, NULL, { 0xff0000, 0xff00, 0xff, 0xff000000 } } },
    { { NULL }, 0, { 88, 93, 92 }, { LOM_FORMAT_RGB8, 1, 4, NULL, { 0xff0000, 0xff00, 0xff, 0 } } },
    { { NULL }, 0, { 65 }, { LOM_FORMAT_RGBA8, 1, 1, NULL, { 0, 0, 0, 0xff } } },
    { { NULL }, 0, { 56, 53 }, { LOM_FORMAT_R16, 1, 2, NULL, { 0 } } },
    { { NULL }, 0, { 35, 33 }, { LOM_FORMAT_RG16, 1, 4, NULL, { 0 } } },
    { { NULL }, 36, { 11, 9 }, { LOM_FORMAT_RGBA16, 1, 8, NULL, { 0 } } },
    { { NULL }, 111, { 54 }, { LOM_FORMAT_R16F, 1, 2, NULL, { 0 } } },
    { { NULL }, 112, { 34 }, { LOM_FORMAT_RG16F, 1, 4, NULL, { 0 } } },
    { { NULL }, 113, { 10 }, { LOM_FORMAT_RGBA16F, 1, 8, NULL, { 0 } } },
    { { NULL }, 114, { 41 }, { LOM_FORMAT_R32F, 1, 4, NULL, { 0 } } },
    { { NULL }, 115, { 16 }, { LOM_FORMAT_RG32F, 1, 8, NULL, { 0 } } },
    { { NULL }, 0, { 6 }, { LOM_FORMAT_RGB32F, 1, 12, NULL, { 0 } } },
    { { NULL }, 116, { 2 }, { LOM_FORMAT_RGBA32F, 1, 16, NULL, { 0 } } },
};

enum { ROWS = sizeof rows / sizeof *rows };

static bool has_code(const struct row *row, uint32_t code)
{
    for (int k = 0; k < 2 && row->codes[k] != NULL; k++)
        if (code == CODE(row->codes[k]))
            return true;
    return code != 0 && code == row->number;
}

static bool find_code(lom_coded_picture *p, uint32_t code, lom_error *error)
{
    for (int i = 0; i < ROWS; i++)
        if (has_code(&rows[i], code)) {
            p->coding = rows[i].coding;
            return true;
        }
    return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 84: the code 0x%08x is none of the formats that are read.",
                    p->name, code);
}

static bool find_dxgi(lom_coded_picture *p, uint32_t number, lom_error *error)
{
    for (int i = 0; i < ROWS; i++)
        for (int k = 0; k < 3; k++)
            if (number != 0 && number == rows[i].dxgi[k]) {
                p->coding = rows[i].coding;
                return true;
            }
    return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 128: DXGI format %u is none of those that are read%s.", p->name,
                    number, number >= 94 && number <= 99 ? " (BC6H and BC7 are not)" : "");
}

/* Bits in a row, at most 8. */
static bool is_channel(uint32_t mask)
{
    uint32_t lowest = mask & -mask;
    return mask == 0 || (mask / lowest <= 255 && (mask / lowest & (mask / lowest + 1)) == 0);
}

/* Texels whose channels are named by masks. */
static bool find_masks(lom_coded_picture *p, uint32_t flags, lom_error *error)
{
    uint32_t bits = load_32_little(p->data + 88), mask[4],
             all = bits < 32 ? (UINT32_C(1) << bits % 32) - 1 : UINT32_MAX;
    bool gray = (flags & LUMINANCE) != 0, alpha = (flags & (PIXELS_HAVE_ALPHA | ONLY_ALPHA)) != 0;
    for (int c = 0; c < 4; c++) {
        mask[c] = load_32_little(p->data + 92 + 4 * c);
        if ((c < 3 && (flags & (COLORS | LUMINANCE)) == 0) || (c == 3 && !alpha))
            mask[c] = 0;
        if (!is_channel(mask[c]) || (mask[c] & ~all) != 0)
            return lom_fail(error, LOM_ERROR_INPUT,
                            "%s: byte %d: a mask of 0x%08x is no channel of at most 8 bits of a texel of %u.", p->name,
                            92 + 4 * c, mask[c], bits);
    }
    if (bits == 0 || bits > 32 || bits % 8 != 0 || (mask[0] | mask[3]) == 0)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 88: texels of %u bits with these masks are not read.",
                        p->name, bits);
    int channels = gray ? (alpha ? 2 : 1) : alpha ? 4 : 3;
    p->coding = (lom_texel_coding){ lom_unorm_format(channels, 8), 1, (int)bits / 8, NULL, { mask[0] } };
    if (gray)
        p->coding.mask[1] = mask[3];
    else
        memcpy(p->coding.mask, mask, sizeof mask);
    return true;
}

static bool read_long_header(lom_coded_picture *p, lom_error *error)
{
    p->start = LONG_HEADER;
    if (p->size < LONG_HEADER)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the file ends in the header.", p->name, p->size);
    uint32_t layers = load_32_little(p->data + 140), dimension = load_32_little(p->data + 132);
    bool cube = load_32_little(p->data + 136) & MISC_CUBE;
    if (dimension < 2 || dimension > DIMENSION_3D || layers == 0 ||
        ((cube || dimension == DIMENSION_3D) && layers != 1) || (cube && dimension == DIMENSION_3D))
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 132: %u elements of dimension %u%s are not read.", p->name,
                        layers, dimension, cube ? ", cubes," : "");
    p->depth = cube ? 6 : dimension == DIMENSION_3D ? load_32_little(p->data + 24) : layers;
    p->slices = cube ? LOM_SLICES_CUBE : layers > 1 ? LOM_SLICES_LAYERS : LOM_SLICES_VOLUME;
    return find_dxgi(p, load_32_little(p->data + 128), error);
}

static bool read_short_header(lom_coded_picture *p, uint32_t flags, uint32_t code, lom_error *error)
{
    uint32_t caps = load_32_little(p->data + 112);
    bool cube = (caps & CUBE) != 0, volume = (caps & VOLUME) != 0;
    if (cube && (volume || (caps & ALL_FACES) != ALL_FACES))
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte 112: a cube has six faces and no depth.", p->name);
    p->start = HEADER;
    p->depth = cube ? 6 : volume ? load_32_little(p->data + 24) : 1;
    p->slices = cube ? LOM_SLICES_CUBE : LOM_SLICES_VOLUME;
    return (flags & CODED) != 0 ? find_code(p, code, error) : find_masks(p, flags, error);
}

lom_image *lom_decode_dds(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    if (size < HEADER || load_32_little(data + 4) != 124 || load_32_little(data + 76) != 32) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: byte %d: this is no header of DDS, or the file ends in it.", name,
                 size < HEADER ? (int)size : 4);
        return NULL;
    }
    uint32_t levels = load_32_little(data + 28), flags = load_32_little(data + 80), code = load_32_little(data + 84);
    lom_coded_picture picture = { .name = name,
                                  .data = data,
                                  .size = size,
                                  .width = load_32_little(data + 16),
                                  .height = load_32_little(data + 12),
                                  .levels = levels > 0 ? levels : 1,
                                  .row_unit = 1 };
    bool done = (flags & CODED) != 0 && code == CODE("DX10") ? read_long_header(&picture, error)
                                                             : read_short_header(&picture, flags, code, error);
    picture.by_slice = picture.slices != LOM_SLICES_VOLUME;
    return done && lom_check_coded_picture(&picture, error) ? lom_read_coded_picture(&picture, error) : NULL;
}

/* ---- write ---- */

/* DXGI_FORMAT of samples as an image holds them; 0: none. */
static uint32_t number_of(lom_format format)
{
    const lom_format_info *info = lom_describe_format(format);
    if (info == NULL)
        return 0;
    if (info->is_srgb)
        format = (lom_format)(format - (LOM_FORMAT_R8_SRGB - LOM_FORMAT_R8));
    for (int i = 0; i < ROWS; i++) {
        const lom_texel_coding *coding = &rows[i].coding;
        if (coding->format == format && coding->side == 1 && (coding->mask[0] | coding->mask[3]) == 0)
            return rows[i].dxgi[info->is_srgb && rows[i].dxgi[0] == 28];
    }
    return 0;
}

static void write_header(uint8_t *file, const lom_image *image, uint32_t number)
{
    uint32_t levels = (uint32_t)lom_image_levels(image), depth = (uint32_t)image->depth;
    bool cube = image->slices == LOM_SLICES_CUBE, volume = image->slices == LOM_SLICES_VOLUME && depth > 1;
    const struct {
        int at;
        uint32_t word;
    } fields[] = {
        { 4, 124 },
        { 8, 0x1007u | (levels > 1 ? 0x20000u : 0) | (volume ? 0x800000u : 0) },
        { 12, (uint32_t)image->height },
        { 16, (uint32_t)image->width },
        { 24, volume ? depth : 0 },
        { 28, levels },
        { 76, 32 },
        { 80, CODED },
        { 84, CODE("DX10") },
        { 108, 0x1000u | (levels > 1  ? 0x400008u
                          : depth > 1 ? 8u
                                      : 0) },
        { 112, cube     ? CUBE | ALL_FACES
               : volume ? VOLUME
                        : 0 },
        { 128, number },
        { 132, volume ? DIMENSION_3D : DIMENSION_3D - 1 },
        { 136, cube ? MISC_CUBE : 0 },
        { 140, cube || volume ? 1 : depth },
    };
    memcpy(file, "DDS ", 4);
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        store_32_little(file + fields[i].at, fields[i].word);
}

/* Samples of an image in the file's byte order; returns what is behind them. */
static uint8_t *write_samples(const lom_image *image, int first_slice, int slices, uint8_t *to)
{
    size_t bytes = (size_t)lom_describe_format(image->format)->bits / 8;
    size_t count = lom_image_size(image) / (size_t)image->depth * (size_t)slices / bytes;
    const uint8_t *from = lom_image_pixel(image, 0, 0, first_slice);
    for (size_t i = 0; i < count; i++, from += bytes, to += bytes) {
        uint32_t sample = from[0];
        if (bytes == 2) {
            uint16_t word;
            memcpy(&word, from, 2);
            sample = word;
        } else if (bytes == 4) {
            memcpy(&sample, from, 4);
        }
        for (size_t b = 0; b < bytes; b++)
            to[b] = (uint8_t)(sample >> 8 * b);
    }
    return to;
}

static lom_bytes encode(const lom_image *image, lom_error *error)
{
    uint32_t number = number_of(image->format);
    size_t size = LONG_HEADER;
    if (number == 0) {
        lom_fail(error, LOM_ERROR_USAGE, "DDS holds no samples of format %d; convert the picture first.",
                 (int)image->format);
        return (lom_bytes){ 0 };
    }
    for (const lom_image *level = image; level != NULL; level = level->smaller)
        size += lom_image_size(level);
    lom_bytes file = { lom_allocate(size, 1, error), size };
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    write_header(file.data, image, number);
    uint8_t *to = file.data + LONG_HEADER;
    bool by_slice = image->slices != LOM_SLICES_VOLUME;
    for (int slice = 0; slice < (by_slice ? image->depth : 1); slice++)
        for (const lom_image *level = image; level != NULL; level = level->smaller)
            to = write_samples(level, slice, by_slice ? 1 : level->depth, to);
    return file;
}

/* Of three channels there is no such format for most bits: they get an opaque alpha. */
lom_bytes lom_encode_dds(const lom_image *image, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    if (info == NULL || info->channels != 3)
        return encode(image, error);
    lom_image *wide = lom_convert_image(image, (lom_format)(image->format + 1), error);
    lom_bytes file = wide != NULL ? encode(wide, error) : (lom_bytes){ 0 };
    lom_free_image(wide);
    return file;
}
