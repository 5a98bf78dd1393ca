/* PFM files (P. Debevec): 32-bit floats, gray ("Pf") or RGB ("PF"), the bottom row first. In and out: an image of R32F
 * or RGB32F, its top row first. The sign of the header's scale is the byte order (negative: little-endian); its size
 * has no agreed meaning and is not used. */
#include "codec.h"

#include "bytes.h"
#include "text_reader.h"

#include <stdio.h>
#include <string.h>

static bool read_scale(text_reader *in, double *scale)
{
    text_skip_space(in);
    size_t used = lom_parse_double((const char *)in->data + in->at, in->size - in->at, scale);
    if (used == 0 || *scale == 0)
        return text_fail(in, "there should be a scale other than 0");
    in->at += used;
    return true;
}

lom_image *lom_decode_pfm(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    enum { MOST_SIZE = 1000000000 };
    text_reader in = { data, size, 2, name, error };
    uint32_t width = 0, height = 0;
    double scale;
    unsigned channels = data[1] == 'F' ? 3 : 1;
    if (!text_end_kind(&in) || !text_read_number(&in, MOST_SIZE, &width) ||
        !text_read_number(&in, MOST_SIZE, &height) || !read_scale(&in, &scale) ||
        !text_end_header(&in, (uint64_t)width * height * channels * 4))
        return NULL;
    lom_format format = channels == 3 ? LOM_FORMAT_RGB32F : LOM_FORMAT_R32F;
    lom_image *image = lom_create_declared(name, width, height, format, 32 * channels, 1, size - in.at, error);
    if (image == NULL)
        return NULL;
    const uint8_t *from = data + in.at;
    for (uint32_t y = height; y-- > 0;) {
        uint8_t *to = lom_image_pixel(image, 0, (int)y, 0);
        for (uint32_t i = 0; i < width * channels; i++, from += 4, to += 4) {
            uint32_t bits = scale < 0 ? load_32_little(from) : load_32_big(from);
            memcpy(to, &bits, sizeof bits);
        }
    }
    return image;
}

lom_bytes lom_encode_pfm(const lom_image *image, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    if (!info->is_float || info->bits != 32) {
        lom_fail(error, LOM_ERROR_USAGE, "PFM holds 32-bit floats, not %s; convert the picture first.", info->name);
        return (lom_bytes){ 0 };
    }
    char header[64];
    size_t used = info->channels >= 3 ? 3 : 1, pixel = lom_format_size(image->format); /* alpha is dropped */
    int length =
        snprintf(header, sizeof header, "%s\n%d %d\n-1.0\n", used == 3 ? "PF" : "Pf", image->width, image->height);
    lom_bytes file = { .size = (size_t)length + (size_t)image->width * (size_t)image->height * used * 4 };
    file.data = lom_allocate(file.size, 1, error);
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    memcpy(file.data, header, (size_t)length);
    uint8_t *to = file.data + length;
    for (int y = image->height - 1; y >= 0; y--) {
        const uint8_t *from = lom_image_pixel(image, 0, y, 0);
        for (int x = 0; x < image->width; x++, from += pixel) {
            for (size_t c = 0; c < used; c++, to += 4) {
                uint32_t bits;
                memcpy(&bits, from + 4 * c, sizeof bits);
                store_32_little(to, bits);
            }
        }
    }
    return file;
}
