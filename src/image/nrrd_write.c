/* NRRD files, written: an image with depth as a gzip-encoded volume, little-endian. In: 8-bit, 16-bit or 32-bit float
 * samples. Out: the same bytes on every machine. */
#include "codec.h"

#include "bytes.h"
#include "zip.h"

#include <stdio.h>
#include <string.h>

enum { EFFORT = 16 };

/* The samples, little-endian. */
static uint8_t *order_samples(const lom_image *image, int bytes, lom_error *error)
{
    size_t size = lom_image_size(image);
    uint8_t *ordered = lom_allocate(size, 1, error);
    if (ordered == NULL)
        return NULL;
    for (size_t i = 0; i < size; i += (size_t)bytes) {
        uint32_t word = image->pixels[i];
        if (bytes == 2)
            word = *(const uint16_t *)(image->pixels + i);
        else if (bytes == 4)
            memcpy(&word, image->pixels + i, sizeof word);
        for (int b = 0; b < bytes; b++)
            ordered[i + (size_t)b] = (uint8_t)(word >> 8 * b);
    }
    return ordered;
}

lom_bytes lom_encode_nrrd(const lom_image *image, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    lom_bytes file = { 0 };
    if (info->is_depth || (info->is_float && info->bits != 32)) {
        lom_fail(error, LOM_ERROR_USAGE, "NRRD is written with 8 or 16 bits or 32-bit floats, not %s.", info->name);
        return file;
    }
    char header[256], channels[16] = "";
    if (info->channels > 1)
        snprintf(channels, sizeof channels, "%d ", info->channels);
    int length = snprintf(
        header, sizeof header, "NRRD0004\ntype: %s\ndimension: %d\nsizes: %s%d %d %d\n%s%sencoding: gzip\n\n",
        info->is_float     ? "float"
        : info->bits == 16 ? "uint16"
                           : "uint8",
        info->channels > 1 ? 4 : 3, channels, image->width, image->height, image->depth,
        info->channels > 1 ? "kinds: vector domain domain domain\n" : "", info->bits > 8 ? "endian: little\n" : "");
    uint8_t *ordered = order_samples(image, info->bits / 8, error);
    lom_bytes packed = { 0 };
    if (ordered != NULL)
        packed = lom_deflate_gzip(ordered, lom_image_size(image), EFFORT, error);
    if (packed.data != NULL)
        file.data = lom_allocate((size_t)length + packed.size, 1, error);
    if (file.data != NULL) {
        file.size = (size_t)length + packed.size;
        memcpy(file.data, header, (size_t)length);
        memcpy(file.data + length, packed.data, packed.size);
    }
    lom_release(ordered);
    lom_release(packed.data);
    return file;
}
