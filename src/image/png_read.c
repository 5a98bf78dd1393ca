/* PNG files, read: chunks -> compressed data -> filtered rows -> samples. In: a whole file; out: an image of 8 or 16
 * bits (fewer bits are scaled to 8; a palette gives its colours; a transparent colour or palette gives alpha).
 * Invariant: all sizes are checked against the limits and against the data that is there before memory is asked for. */
#include "codec.h"

#include "bytes.h"
#include "png.h"
#include "zip.h"

#include <string.h>

typedef struct png {
    const char *name;
    uint32_t width, height;
    int depth, type, interlaced;
    int samples;      /* of a pixel in the file */
    int palette_size; /* colours; 0 without a palette */
    uint8_t palette[256][4];
    bool transparent; /* a tRNS chunk was there */
    uint32_t key[3];  /* its colour, when there is no palette */
    uint8_t *data;    /* all IDAT chunks, one after the other */
    size_t size;
    bool header, data_ended, ended;
    lom_error *error;
} png;

/* The seven passes of Adam7 and, as the eighth, the only one of a plain picture. */
static const struct pass {
    uint8_t x, y, dx, dy;
} passes[8] = {
    { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 },
    { 0, 2, 2, 4 }, { 1, 0, 2, 2 }, { 0, 1, 1, 2 }, { 0, 0, 1, 1 },
};

static bool fail(const png *p, size_t at, const char *what)
{
    return lom_fail(p->error, LOM_ERROR_INPUT, "%s: byte %zu: %s.", p->name, at, what);
}

/* ---- chunks ---- */

static bool read_header(png *p, const uint8_t *data, size_t length, size_t at)
{
    static const struct {
        int type, samples, depths; /* a bit for each depth: 1, 2, 4, 8, 16 */
    } types[] = { { PNG_GRAY, 1, 1 | 2 | 4 | 8 | 16 },
                  { PNG_RGB, 3, 8 | 16 },
                  { PNG_PALETTE, 1, 1 | 2 | 4 | 8 },
                  { PNG_GRAY_ALPHA, 2, 8 | 16 },
                  { PNG_RGB_ALPHA, 4, 8 | 16 } };
    if (p->header || length != 13)
        return fail(p, at, "the header chunk is repeated or of a wrong length");
    p->header = true;
    p->width = load_32_big(data);
    p->height = load_32_big(data + 4);
    p->depth = data[8];
    p->type = data[9];
    p->interlaced = data[12];
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (types[i].type == p->type && p->depth != 0 && (p->depth & (p->depth - 1)) == 0 &&
            (types[i].depths & p->depth) != 0)
            p->samples = types[i].samples;
    if (p->samples == 0)
        return fail(p, at, "there is no such colour type and depth");
    if (data[10] != 0 || data[11] != 0 || data[12] > 1)
        return fail(p, at, "there is no such compression, filter or interlace method");
    return true;
}

static bool read_palette(png *p, const uint8_t *data, size_t length, size_t at)
{
    if (p->palette_size != 0 || p->size != 0)
        return fail(p, at, "the palette is repeated or behind the picture's data");
    if (length == 0 || length % 3 != 0 || length > 768)
        return fail(p, at, "the palette has a wrong length");
    if (p->type == PNG_GRAY || p->type == PNG_GRAY_ALPHA)
        return fail(p, at, "a gray picture has a palette");
    p->palette_size = (int)length / 3;
    for (int i = 0; i < p->palette_size; i++) {
        memcpy(p->palette[i], data + 3 * i, 3);
        p->palette[i][3] = 255;
    }
    return true;
}

static bool read_transparency(png *p, const uint8_t *data, size_t length, size_t at)
{
    if (p->type == PNG_PALETTE) {
        if (p->palette_size == 0 || length > (size_t)p->palette_size || length == 0)
            return fail(p, at, "there are more transparencies than colours in the palette");
        for (size_t i = 0; i < length; i++)
            p->palette[i][3] = data[i];
    } else {
        if ((p->type != PNG_GRAY && p->type != PNG_RGB) || length != 2 * (size_t)p->samples)
            return fail(p, at, "the transparent colour does not fit the colour type");
        for (int i = 0; i < p->samples; i++) /* only the low bits count (section 11.3.2.1) */
            p->key[i] = load_16_big(data + 2 * i) & ((1u << p->depth) - 1);
    }
    if (p->transparent || p->size != 0)
        return fail(p, at, "the transparency is repeated or behind the picture's data");
    p->transparent = true;
    return true;
}

static bool read_data(png *p, const uint8_t *data, size_t length, size_t at)
{
    if (p->data_ended)
        return fail(p, at, "the picture's data is interrupted");
    if (p->type == PNG_PALETTE && p->palette_size == 0)
        return fail(p, at, "the palette is missing");
    if (length != 0)
        memcpy(p->data + p->size, data, length);
    p->size += length;
    return true;
}

static bool read_end(png *p, const uint8_t *data, size_t length, size_t at)
{
    (void)data;
    p->ended = true;
    return length == 0 || fail(p, at, "the end chunk is not empty");
}

static const struct {
    char type[5];
    bool (*read)(png *p, const uint8_t *data, size_t length, size_t at);
} chunks[] = {
    { "IHDR", read_header }, { "PLTE", read_palette }, { "tRNS", read_transparency },
    { "IDAT", read_data },   { "IEND", read_end },
};

/* One chunk whose type is at data[0]. What is not in the table is skipped when its name says that it may be. */
static bool read_chunk(png *p, const uint8_t *data, size_t length, size_t at)
{
    for (int i = 0; i < 4; i++)
        if ((data[i] | 32) < 'a' || (data[i] | 32) > 'z')
            return fail(p, at, "a chunk's type is not made of letters");
    bool is_data = memcmp(data, "IDAT", 4) == 0;
    if (p->size != 0 && !is_data)
        p->data_ended = true;
    if (!p->header && memcmp(data, "IHDR", 4) != 0)
        return fail(p, at, "the header chunk is not the first one");
    for (size_t i = 0; i < sizeof chunks / sizeof *chunks; i++) {
        if (memcmp(data, chunks[i].type, 4) != 0)
            continue;
        if (load_32_big(data + 4 + length) != lom_crc32(0, data, 4 + length))
            return fail(p, at, "the chunk's CRC is wrong");
        return chunks[i].read(p, data + 4, length, at);
    }
    bool ancillary = (data[0] & 32) != 0;
    return ancillary || fail(p, at, "a chunk of unknown type cannot be skipped");
}

static bool read_chunks(png *p, const uint8_t *data, size_t size)
{
    for (size_t at = PNG_SIGNATURE; !p->ended;) {
        if (size - at < PNG_CHUNK)
            return fail(p, size, "the file ends in the middle");
        size_t length = load_32_big(data + at);
        if (length > size - at - PNG_CHUNK)
            return fail(p, at, "the file ends in the middle of a chunk");
        if (!read_chunk(p, data + at + 4, length, at))
            return false;
        at += PNG_CHUNK + length;
    }
    return p->size != 0 || fail(p, size, "the picture has no data");
}

/* ---- rows ---- */

static uint32_t pass_width(const png *p, const struct pass *pass)
{
    return p->width > pass->x ? (p->width - pass->x + pass->dx - 1u) / pass->dx : 0;
}

static uint32_t pass_height(const png *p, const struct pass *pass)
{
    return p->height > pass->y ? (p->height - pass->y + pass->dy - 1u) / pass->dy : 0;
}

/* Bytes of a row without its filter byte: below 2^15 * 8 when the sizes are within the limits. */
static size_t row_size(const png *p, uint32_t width)
{
    return ((size_t)width * (size_t)(p->samples * p->depth) + 7) / 8;
}

static size_t filtered_size(const png *p)
{
    size_t total = 0;
    for (int i = p->interlaced ? 0 : 7; i < (p->interlaced ? 7 : 8); i++) {
        uint32_t width = pass_width(p, &passes[i]);
        if (width != 0)
            total += pass_height(p, &passes[i]) * (1 + row_size(p, width));
    }
    return total;
}

/* ---- samples ---- */

/* Sample i of a row, in 0 .. 2^depth - 1. */
static inline uint32_t sample(const uint8_t *row, size_t i, int depth)
{
    if (depth == 8)
        return row[i];
    if (depth == 16)
        return load_16_big(row + 2 * i);
    size_t bit = i * (size_t)depth;
    return row[bit / 8] >> (8 - (unsigned)depth - bit % 8) & ((1u << depth) - 1);
}

static inline void put_sample(uint8_t *to, int i, uint32_t value, int depth)
{
    if (depth == 16) {
        uint16_t wide = (uint16_t)value;
        memcpy(to + 2 * i, &wide, sizeof wide);
    } else {
        to[i] = (uint8_t)value;
    }
}

/* One pixel of a row to memory: scale takes 2^depth - 1 to 255 (depth 16 and 8: 1). */
static void put_pixel(const png *p, const uint8_t *row, size_t x, uint8_t *to)
{
    uint32_t scale = p->depth < 8 ? 255 / ((1u << p->depth) - 1) : 1;
    bool is_key = p->transparent;
    for (int i = 0; i < p->samples; i++) {
        uint32_t value = sample(row, x * (size_t)p->samples + (size_t)i, p->depth);
        is_key = is_key && value == p->key[i];
        put_sample(to, i, value * scale, p->depth);
    }
    if (p->transparent)
        put_sample(to, p->samples, is_key ? 0 : p->depth == 16 ? 65535 : 255, p->depth);
}

static bool put_row(const png *p, const uint8_t *row, uint32_t width, uint8_t *to, size_t step)
{
    if (p->type == PNG_PALETTE) {
        for (uint32_t x = 0; x < width; x++) {
            uint32_t color = sample(row, x, p->depth);
            if (color >= (uint32_t)p->palette_size)
                return false;
            memcpy(to + x * step, p->palette[color], p->transparent ? 4 : 3);
        }
    } else {
        for (uint32_t x = 0; x < width; x++)
            put_pixel(p, row, x, to + x * step);
    }
    return true;
}

static bool read_pass(const png *p, const struct pass *pass, uint8_t **rows, const uint8_t *zeros, lom_image *image)
{
    uint32_t width = pass_width(p, pass), height = pass_height(p, pass);
    size_t size = row_size(p, width), pixel = lom_format_size(image->format);
    size_t step = (size_t)(p->samples * p->depth + 7) / 8;
    const uint8_t *above = zeros;
    for (uint32_t y = 0; y < height && width != 0; y++) {
        uint8_t *row = *rows + 1;
        if (!lom_png_unfilter(row, above, size, step, row[-1]))
            return lom_fail(p->error, LOM_ERROR_INPUT, "%s: row %u has an unknown filter.", p->name, y);
        uint8_t *to = lom_image_pixel(image, pass->x, (int)(pass->y + y * pass->dy), 0);
        bool plain = p->depth == 8 && pass->dx == 1 && (size_t)p->samples == pixel && p->type != PNG_PALETTE;
        if (plain)
            memcpy(to, row, size);
        else if (!put_row(p, row, width, to, pixel * pass->dx))
            return lom_fail(p->error, LOM_ERROR_INPUT, "%s: row %u has a colour that is not in the palette.", p->name,
                            y);
        above = row;
        *rows += 1 + size;
    }
    return true;
}

/* ---- the picture ---- */

static bool read_pixels(const png *p, lom_image *image)
{
    size_t size = filtered_size(p);
    uint8_t *filtered = lom_allocate(size, 1, p->error);
    uint8_t *zeros = lom_allocate(row_size(p, p->width), 1, p->error);
    bool good =
        filtered != NULL && zeros != NULL && lom_inflate_zlib(p->name, p->data, p->size, filtered, size, p->error);
    uint8_t *rows = filtered;
    for (int i = p->interlaced ? 0 : 7; good && i < (p->interlaced ? 7 : 8); i++)
        good = read_pass(p, &passes[i], &rows, zeros, image);
    lom_release(filtered);
    lom_release(zeros);
    return good;
}

lom_image *lom_decode_png(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    png p = { .name = name, .error = error };
    lom_image *image = NULL;
    p.data = lom_allocate(size, 1, error);
    if (p.data != NULL && read_chunks(&p, data, size)) {
        int channels = (p.type == PNG_PALETTE ? 3 : p.samples) + p.transparent;
        lom_format format = lom_unorm_format(channels, p.depth == 16 ? 16 : 8);
        image = lom_create_declared(name, p.width, p.height, format, (uint64_t)(p.samples * p.depth), LOM_INFLATE_RATIO,
                                    p.size, error);
        if (image != NULL && !read_pixels(&p, image)) {
            lom_free_image(image);
            image = NULL;
        }
    }
    lom_release(p.data);
    return image;
}
