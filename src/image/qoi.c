/* QOI files (D. Szablewski, The Quite OK Image Format, 2022: qoiformat.org/qoi-specification.pdf), read and written.
 * In and out: RGB or RGBA of 8 bits; gray is written as three equal channels. A pixel is a run of the one before it, a
 * difference from it, one of 64 that were seen, or written out. Invariant: a file that ends early, or says more pixels
 * than the picture has, is refused; nothing is allocated before the declared size fits the bytes that are there.
 *
 * The header's two flags say what the samples mean and change none of them. Channels (3 or 4) are those of the image;
 * the colour space is read whichever it is, as of every picture file, and written as sRGB with linear alpha. */
#include "codec.h"

#include "bytes.h"

#include <string.h>

enum { QOI_HEADER = 14, QOI_END = 8, LONGEST_RUN = 62, LINEAR = 1 };
enum { OP_INDEX = 0x00, OP_DIFFERENCE = 0x40, OP_LUMA = 0x80, OP_RUN = 0xc0, OP_RGB = 0xfe, OP_RGBA = 0xff };

static const uint8_t end_marker[QOI_END] = { 0, 0, 0, 0, 0, 0, 0, 1 };

typedef struct qoi_pixel {
    uint8_t r, g, b, a;
} qoi_pixel;

static unsigned slot_of(qoi_pixel p)
{
    return (p.r * 3u + p.g * 5u + p.b * 7u + p.a * 11u) % 64;
}

static bool same_pixel(qoi_pixel p, qoi_pixel q)
{
    return p.r == q.r && p.g == q.g && p.b == q.b && p.a == q.a;
}

/* ---- read ---- */

typedef struct qoi_reader {
    const uint8_t *at, *end; /* the operations, without the end marker */
    qoi_pixel seen[64], pixel;
} qoi_reader;

static size_t length_of(uint8_t operation)
{
    return operation == OP_RGBA ? 5 : operation == OP_RGB ? 4 : (operation & 0xc0) == OP_LUMA ? 2 : 1;
}

/* Reads one operation: the pixel, and how often it stands there. 0: the file ends within it. */
static size_t read_operation(qoi_reader *in)
{
    const uint8_t *p = in->at;
    qoi_pixel *pixel = &in->pixel;
    size_t count = 1, left = (size_t)(in->end - p);
    if (left == 0 || left < length_of(p[0]))
        return 0;
    in->at += length_of(p[0]);
    if (p[0] == OP_RGB || p[0] == OP_RGBA) {
        *pixel = (qoi_pixel){ p[1], p[2], p[3], p[0] == OP_RGBA ? p[4] : pixel->a };
    } else if ((p[0] & 0xc0) == OP_INDEX) {
        *pixel = in->seen[p[0]];
    } else if ((p[0] & 0xc0) == OP_DIFFERENCE) {
        pixel->r = (uint8_t)(pixel->r + (p[0] >> 4 & 3) - 2);
        pixel->g = (uint8_t)(pixel->g + (p[0] >> 2 & 3) - 2);
        pixel->b = (uint8_t)(pixel->b + (p[0] & 3) - 2);
    } else if ((p[0] & 0xc0) == OP_LUMA) {
        int green = (p[0] & 63) - 32;
        pixel->r = (uint8_t)(pixel->r + green + (p[1] >> 4) - 8);
        pixel->g = (uint8_t)(pixel->g + green);
        pixel->b = (uint8_t)(pixel->b + green + (p[1] & 15) - 8);
    } else {
        count = (size_t)(p[0] & 63) + 1;
    }
    in->seen[slot_of(*pixel)] = *pixel;
    return count;
}

static bool read_pixels(qoi_reader *in, lom_image *image, const char *name, const uint8_t *data, lom_error *error)
{
    size_t size = lom_format_size(image->format), left = lom_image_size(image) / size;
    uint8_t *to = image->pixels;
    while (left > 0) {
        size_t offset = (size_t)(in->at - data), count = read_operation(in);
        if (count == 0)
            return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the file ends in the middle of the picture.", name,
                            offset);
        if (count > left)
            return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: a run goes beyond the end of the picture.", name,
                            offset);
        const uint8_t samples[4] = { in->pixel.r, in->pixel.g, in->pixel.b, in->pixel.a };
        for (left -= count; count > 0; count--, to += size)
            memcpy(to, samples, size);
    }
    if (memcmp(in->at, end_marker, QOI_END) != 0)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the picture does not end with its end marker.", name,
                        (size_t)(in->at - data));
    return true;
}

lom_image *lom_decode_qoi(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    if (size < QOI_HEADER + QOI_END) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: byte %zu: the file ends in the header.", name, size);
        return NULL;
    }
    if ((data[12] != 3 && data[12] != 4) || data[13] > LINEAR) {
        lom_fail(error, LOM_ERROR_INPUT,
                 "%s: byte 12: QOI has 3 or 4 channels, not %d, and the colour spaces 0 and 1, "
                 "not %d.",
                 name, data[12], data[13]);
        return NULL;
    }
    size_t available = size - QOI_HEADER - QOI_END;
    lom_image *image = lom_create_declared(name, load_32_big(data + 4), load_32_big(data + 8),
                                           lom_unorm_format(data[12], 8), 8, LONGEST_RUN, available, error);
    if (image == NULL)
        return NULL;
    qoi_reader in = { .at = data + QOI_HEADER, .end = data + QOI_HEADER + available, .pixel = { 0, 0, 0, 255 } };
    if (!read_pixels(&in, image, name, data, error)) {
        lom_free_image(image);
        return NULL;
    }
    return image;
}

/* ---- write ---- */

typedef struct qoi_writer {
    uint8_t *data; /* NULL: only counts */
    size_t size;
} qoi_writer;

static void put(qoi_writer *out, int byte)
{
    if (out->data != NULL)
        out->data[out->size] = (uint8_t)byte;
    out->size++;
}

/* A difference of two samples, around 256: -128..127. */
static int difference(uint8_t to, uint8_t from)
{
    return (int)((to - from + 128u) & 255) - 128;
}

/* A pixel that is not the one before it and is not among those seen. */
static void put_pixel(qoi_writer *out, qoi_pixel p, qoi_pixel before)
{
    int r = difference(p.r, before.r), g = difference(p.g, before.g), b = difference(p.b, before.b);
    bool same_alpha = p.a == before.a;
    if (same_alpha && r >= -2 && r <= 1 && g >= -2 && g <= 1 && b >= -2 && b <= 1) {
        put(out, OP_DIFFERENCE | (r + 2) << 4 | (g + 2) << 2 | (b + 2));
    } else if (same_alpha && g >= -32 && g <= 31 && r - g >= -8 && r - g <= 7 && b - g >= -8 && b - g <= 7) {
        put(out, OP_LUMA | (g + 32));
        put(out, (r - g + 8) << 4 | (b - g + 8));
    } else {
        put(out, same_alpha ? OP_RGB : OP_RGBA);
        put(out, p.r);
        put(out, p.g);
        put(out, p.b);
        if (!same_alpha)
            put(out, p.a);
    }
}

static void put_run(qoi_writer *out, int *run)
{
    if (*run > 0)
        put(out, OP_RUN | (*run - 1));
    *run = 0;
}

static void put_pixels(qoi_writer *out, const lom_image *image)
{
    int channels = lom_describe_format(image->format)->channels;
    int green = channels >= 3 ? 1 : 0, blue = 2 * green, run = 0;
    size_t count = (size_t)image->width * (size_t)image->height;
    qoi_pixel seen[64] = { { 0, 0, 0, 0 } }, before = { 0, 0, 0, 255 };
    const uint8_t *from = image->pixels;
    for (size_t i = 0; i < count; i++, from += channels) {
        qoi_pixel p = { from[0], from[green], from[blue], channels % 2 == 0 ? from[channels - 1] : 255 };
        if (same_pixel(p, before)) {
            if (++run == LONGEST_RUN)
                put_run(out, &run);
            continue;
        }
        put_run(out, &run);
        if (same_pixel(p, seen[slot_of(p)]))
            put(out, OP_INDEX | (int)slot_of(p));
        else
            put_pixel(out, p, before);
        before = seen[slot_of(p)] = p;
    }
    put_run(out, &run);
    for (int i = 0; i < QOI_END; i++)
        put(out, end_marker[i]);
}

lom_bytes lom_encode_qoi(const lom_image *image, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    if (info->bits != 8) {
        lom_fail(error, LOM_ERROR_USAGE, "QOI holds 8 bits a sample, not %s; convert the picture first.", info->name);
        return (lom_bytes){ 0 };
    }
    qoi_writer out = { .size = QOI_HEADER };
    put_pixels(&out, image);
    lom_bytes file = { lom_allocate(out.size, 1, error), out.size };
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    memcpy(file.data, "qoif", 4);
    store_32_big(file.data + 4, (uint32_t)image->width);
    store_32_big(file.data + 8, (uint32_t)image->height);
    file.data[12] = info->channels % 2 == 0 ? 4 : 3;
    file.data[13] = 0;
    out = (qoi_writer){ file.data, QOI_HEADER };
    put_pixels(&out, image);
    return file;
}
