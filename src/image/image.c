/* Plain images in memory. In: sizes and a format; out: an image whose pixels are tightly packed, row 0 on top, samples
 * in the machine's byte order. Invariant: sizes are 1..LOM_MAX_SIZE and the bytes fit the limit, so that pixel
 * addresses never overflow. */
#include "base/reserve.h"
#include "image/bare_image.h"

#include <string.h>

lom_image *lom_create_bare_image(int width, int height, int depth, lom_format format, lom_error *error)
{
    uint64_t pixel = lom_format_size(format);
    if (width < 1 || height < 1 || depth < 1 || pixel == 0) {
        lom_fail(error, LOM_ERROR_USAGE, "There is no image of %d x %d x %d pixels of format %d.", width, height, depth,
                 (int)format);
        return NULL;
    }
    /* every factor is below 2^16 or is checked first, so the product stays below 2^64 */
    if (width > LOM_MAX_SIZE || height > LOM_MAX_SIZE || depth > LOM_MAX_SIZE ||
        (uint64_t)width * (uint64_t)height * (uint64_t)depth * pixel > LOM_MAX_IMAGE_BYTES) {
        lom_fail(error, LOM_ERROR_LIMIT,
                 "An image of %d x %d x %d pixels of %d bytes is larger than the limit of %d a side and 2^31 bytes.",
                 width, height, depth, (int)pixel, LOM_MAX_SIZE);
        return NULL;
    }
    lom_image *image = lom_allocate(1, sizeof *image, error);
    if (image == NULL)
        return NULL;
    *image = (lom_image){ .width = width, .height = height, .depth = depth, .format = format };
    image->pixels = lom_allocate_bare((size_t)width * (size_t)height * (size_t)depth, (size_t)pixel, error);
    if (image->pixels == NULL) {
        lom_release(image);
        return NULL;
    }
    return image;
}

lom_image *lom_create_image(int width, int height, int depth, lom_format format, lom_error *error)
{
    lom_image *image = lom_create_bare_image(width, height, depth, format, error);
    if (image != NULL)
        memset(image->pixels, 0, lom_image_size(image));
    return image;
}

void lom_free_image(lom_image *image)
{
    while (image != NULL) {
        lom_image *smaller = image->smaller;
        lom_release(image->pixels);
        lom_release(image);
        image = smaller;
    }
}

int lom_image_levels(const lom_image *image)
{
    int count = 1;
    while ((image = image->smaller) != NULL)
        count++;
    return count;
}

size_t lom_image_size(const lom_image *image)
{
    return (size_t)image->width * (size_t)image->height * (size_t)image->depth * lom_format_size(image->format);
}

void *lom_image_pixel(const lom_image *image, int x, int y, int z)
{
    size_t row = (size_t)z * (size_t)image->height + (size_t)y;
    return image->pixels + (row * (size_t)image->width + (size_t)x) * lom_format_size(image->format);
}

bool lom_reinterpret_image(lom_image *image, lom_format format, lom_error *error)
{
    const lom_format_info *from = lom_describe_format(image->format), *to = lom_describe_format(format);
    if (from == NULL || to == NULL || from->channels != to->channels || from->bits != to->bits)
        return lom_fail(error, LOM_ERROR_USAGE, "Pixels of format %s cannot be read as format %s.",
                        from != NULL ? from->name : "none", to != NULL ? to->name : "none");
    image->format = format;
    return true;
}

/* ---- the hash ---- */

static uint64_t hash_word(uint64_t hash, uint32_t word)
{
    const uint8_t bytes[4] = { (uint8_t)word, (uint8_t)(word >> 8), (uint8_t)(word >> 16), (uint8_t)(word >> 24) };
    return lom_hash_bytes(hash, bytes, sizeof bytes);
}

static uint64_t hash_samples_16(uint64_t hash, const uint8_t *samples, size_t size)
{
    for (size_t i = 0; i < size; i += 2) {
        uint16_t sample;
        memcpy(&sample, samples + i, sizeof sample);
        const uint8_t bytes[2] = { (uint8_t)sample, (uint8_t)(sample >> 8) };
        hash = lom_hash_bytes(hash, bytes, sizeof bytes);
    }
    return hash;
}

static uint64_t hash_samples_32(uint64_t hash, const uint8_t *samples, size_t size)
{
    for (size_t i = 0; i < size; i += 4) {
        uint32_t sample;
        memcpy(&sample, samples + i, sizeof sample);
        hash = hash_word(hash, sample);
    }
    return hash;
}

uint64_t lom_hash_image(const lom_image *image)
{
    const lom_format_info *info = lom_describe_format(image->format);
    uint64_t hash = LOM_HASH_START;
    hash = hash_word(hash, (uint32_t)image->width);
    hash = hash_word(hash, (uint32_t)image->height);
    hash = hash_word(hash, (uint32_t)image->depth);
    hash = hash_word(hash, (uint32_t)image->format);
    size_t size = lom_image_size(image);
    if (info->bits == 8)
        return lom_hash_bytes(hash, image->pixels, size);
    if (info->bits == 16)
        return hash_samples_16(hash, image->pixels, size);
    return hash_samples_32(hash, image->pixels, size);
}
