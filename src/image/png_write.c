/* PNG files, written: samples -> filtered rows -> compressed data -> chunks. In: an image of 8 or 16 bits and 1..4
 * channels; out: a whole file. The bytes are a function of the picture alone. */
#include "codec.h"

#include "bytes.h"
#include "png.h"
#include "zip.h"

#include <string.h>

enum { EFFORT = 8 };

typedef struct filter_state {
    size_t size, step;
    uint8_t *row[2]; /* the row and the one above, as the file has them, with step zeros before each */
    uint8_t *candidate[PNG_FILTERS];
} filter_state;

/* ---- the five filters (section 9.2) ----
 * out[i] = row[i] - a prediction from the pixel to the left (step bytes before), above, and above to the left; step
 * zeros stand before both rows. */

static void filter_sub(uint8_t *restrict out, const uint8_t *restrict row, size_t size, size_t step)
{
    const uint8_t *left = row - step;
    for (size_t i = 0; i < size; i++)
        out[i] = (uint8_t)(row[i] - left[i]);
}

static void filter_up(uint8_t *restrict out, const uint8_t *restrict row, const uint8_t *restrict above, size_t size)
{
    for (size_t i = 0; i < size; i++)
        out[i] = (uint8_t)(row[i] - above[i]);
}

static void filter_average(uint8_t *restrict out, const uint8_t *restrict row, const uint8_t *restrict above,
                           size_t size, size_t step)
{
    const uint8_t *left = row - step;
    for (size_t i = 0; i < size; i++)
        out[i] = (uint8_t)(row[i] - ((left[i] + above[i]) >> 1));
}

static void filter_paeth(uint8_t *restrict out, const uint8_t *restrict row, const uint8_t *restrict above, size_t size,
                         size_t step)
{
    const uint8_t *left = row - step, *corner = above - step;
    for (size_t i = 0; i < size; i++)
        out[i] = (uint8_t)(row[i] - png_paeth(left[i], above[i], corner[i]));
}

/* The sum of the bytes as signed numbers without sign: the usual guess at what will compress best (section 12.8). */
static uint32_t magnitude(const uint8_t *bytes, size_t size)
{
    uint32_t sum = 0; /* at most 2^18 bytes of 128 */
    for (size_t i = 0; i < size; i++) {
        int value = (int8_t)bytes[i];
        sum += (uint32_t)(value < 0 ? -value : value);
    }
    return sum;
}

/* Writes the filter byte and the best of the candidates. A row equal to the one above needs no trial. */
static void filter_row(const filter_state *f, uint8_t *out)
{
    const uint8_t *row = f->row[0], *above = f->row[1];
    size_t size = f->size;
    if (memcmp(row, above, size) == 0) {
        out[0] = PNG_UP;
        memset(out + 1, 0, size);
        return;
    }
    memcpy(f->candidate[PNG_NONE], row, size);
    filter_sub(f->candidate[PNG_SUB], row, size, f->step);
    filter_up(f->candidate[PNG_UP], row, above, size);
    filter_average(f->candidate[PNG_AVERAGE], row, above, size, f->step);
    filter_paeth(f->candidate[PNG_PAETH], row, above, size, f->step);
    int best = PNG_NONE;
    uint32_t least = UINT32_MAX;
    for (int i = 0; i < PNG_FILTERS; i++) {
        uint32_t cost = magnitude(f->candidate[i], size);
        if (cost < least) {
            least = cost;
            best = i;
        }
    }
    out[0] = (uint8_t)best;
    memcpy(out + 1, f->candidate[best], size);
}

static void copy_row(uint8_t *to, const uint8_t *from, size_t size, int bits)
{
    if (bits == 8) {
        memcpy(to, from, size);
        return;
    }
    for (size_t i = 0; i < size; i += 2) {
        uint16_t sample;
        memcpy(&sample, from + i, sizeof sample);
        store_16_big(to + i, sample);
    }
}

/* All rows, filtered, each with its filter byte before it; NULL on failure. */
static uint8_t *filter_image(const lom_image *image, size_t row_size, lom_error *error)
{
    enum { PAD = 64 };
    size_t stride = row_size + PAD;
    uint8_t *filtered = lom_allocate((size_t)image->height, row_size + 1, error);
    uint8_t *buffer = lom_allocate(2 + PNG_FILTERS, stride, error);
    if (filtered != NULL && buffer != NULL) {
        filter_state f = { .size = row_size, .step = lom_format_size(image->format) };
        f.row[0] = buffer + PAD;
        f.row[1] = buffer + stride + PAD;
        for (int i = 0; i < PNG_FILTERS; i++)
            f.candidate[i] = buffer + (size_t)(2 + i) * stride;
        for (int y = 0; y < image->height; y++) {
            copy_row(f.row[0], lom_image_pixel(image, 0, y, 0), row_size, lom_describe_format(image->format)->bits);
            filter_row(&f, filtered + (size_t)y * (row_size + 1));
            uint8_t *swap = f.row[0];
            f.row[0] = f.row[1];
            f.row[1] = swap;
        }
    } else {
        lom_release(filtered);
        filtered = NULL;
    }
    lom_release(buffer);
    return filtered;
}

/* ---- chunks ---- */

static uint8_t *put_chunk(uint8_t *to, const char *type, const uint8_t *data, size_t size)
{
    store_32_big(to, (uint32_t)size);
    memcpy(to + 4, type, 4);
    if (size != 0)
        memcpy(to + 8, data, size);
    store_32_big(to + 8 + size, lom_crc32(0, to + 4, size + 4));
    return to + PNG_CHUNK + size;
}

static lom_bytes assemble(const uint8_t header[13], lom_bytes data, lom_error *error)
{
    static const uint8_t signature[PNG_SIGNATURE] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    enum { MOST_IN_CHUNK = 1 << 30 }; /* a chunk's length is below 2^31 */
    size_t pieces = (data.size + MOST_IN_CHUNK - 1) / MOST_IN_CHUNK;
    lom_bytes file = { .size = PNG_SIGNATURE + PNG_CHUNK * (2 + pieces) + 13 + data.size };
    file.data = lom_allocate(file.size, 1, error);
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    memcpy(file.data, signature, PNG_SIGNATURE);
    uint8_t *to = put_chunk(file.data + PNG_SIGNATURE, "IHDR", header, 13);
    for (size_t at = 0; at < data.size; at += MOST_IN_CHUNK) {
        size_t size = data.size - at < MOST_IN_CHUNK ? data.size - at : MOST_IN_CHUNK;
        to = put_chunk(to, "IDAT", data.data + at, size);
    }
    put_chunk(to, "IEND", NULL, 0);
    return file;
}

lom_bytes lom_encode_png(const lom_image *image, lom_error *error)
{
    static const uint8_t types[4] = { PNG_GRAY, PNG_GRAY_ALPHA, PNG_RGB, PNG_RGB_ALPHA };
    const lom_format_info *info = lom_describe_format(image->format);
    if (info->is_float || info->bits > 16) {
        lom_fail(error, LOM_ERROR_USAGE, "PNG holds 8 or 16 bits a sample, not %s; convert the picture first.",
                 info->name);
        return (lom_bytes){ 0 };
    }
    size_t row_size = (size_t)image->width * lom_format_size(image->format);
    uint8_t *filtered = filter_image(image, row_size, error);
    if (filtered == NULL)
        return (lom_bytes){ 0 };
    lom_bytes data = lom_deflate_zlib(filtered, (row_size + 1) * (size_t)image->height, EFFORT, error);
    lom_release(filtered);
    if (data.data == NULL)
        return (lom_bytes){ 0 };
    uint8_t header[13] = { 0 };
    store_32_big(header, (uint32_t)image->width);
    store_32_big(header + 4, (uint32_t)image->height);
    header[8] = (uint8_t)info->bits;
    header[9] = types[info->channels - 1];
    lom_bytes file = assemble(header, data, error);
    lom_release(data.data);
    return file;
}
