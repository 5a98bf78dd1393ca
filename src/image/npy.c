/* NPY files, arrays of NumPy (format version 1.0, numpy.lib.format), written alone. In: a picture. Out: an array of shape
 * (height, width) or (height, width, channels), little-endian, in C order: the top row first. */
#include "codec.h"

#include <stdio.h>
#include <string.h>

enum { ALIGNED = 64, MAGIC = 10 }; /* MAGIC: "\x93NUMPY", the version, the header's length in 16 bits */

/* The header, padded so that the data begin on 64 bytes; its length. */
static size_t print_header(const lom_image *image, char header[2 * ALIGNED])
{
    const lom_format_info *info = lom_describe_format(image->format);
    char channels[16] = "";
    if (info->channels > 1)
        snprintf(channels, sizeof channels, ", %d", info->channels);
    const char *type = info->is_float ? (info->bits == 16 ? "<f2" : "<f4") : info->bits == 8 ? "|u1" : "<u2";
    int length =
        snprintf(header + MAGIC, 2 * ALIGNED - MAGIC, "{'descr': '%s', 'fortran_order': False, 'shape': (%d, %d%s), }",
                 type, image->height, image->width, channels);
    size_t used = (size_t)length + MAGIC, size = (used + 1 + ALIGNED - 1) / ALIGNED * ALIGNED;
    memset(header + used, ' ', size - used);
    header[size - 1] = '\n';
    memcpy(header, "\x93NUMPY\x01", 8);
    header[7] = 0;
    header[8] = (char)(size - MAGIC);
    header[9] = 0;
    return size;
}

lom_bytes lom_encode_npy(const lom_image *image, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    char header[2 * ALIGNED];
    if (info->is_depth && !info->is_float) {
        lom_fail(error, LOM_ERROR_USAGE, "NPY holds no %s; convert the picture first.", info->name);
        return (lom_bytes){ 0 };
    }
    size_t start = print_header(image, header), size = lom_image_size(image), sample = (size_t)info->bits / 8;
    lom_bytes file = { .size = start + size };
    file.data = lom_allocate(file.size, 1, error);
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    memcpy(file.data, header, start);
    for (size_t i = 0; i < size; i += sample) {
        const uint8_t *from = image->pixels + i;
        uint16_t half = 0;
        uint32_t whole = 0;
        memcpy(&half, from, sample == 2 ? sizeof half : 0);
        memcpy(&whole, from, sample == 4 ? sizeof whole : 0);
        uint32_t bits = sample == 1 ? *from : sample == 2 ? half : whole;
        for (size_t k = 0; k < sample; k++)
            file.data[start + i + k] = (uint8_t)(bits >> 8 * k);
    }
    return file;
}
