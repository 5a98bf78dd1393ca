/* PPM, PGM (binary) and PAM files, written. In: an image of 8 or 16 bits; out: a whole file, 16-bit samples with the
 * high byte first, as netpbm wants them. */
#include "codec.h"

#include "bytes.h"

#include <stdio.h>
#include <string.h>

enum { HEADER = 160 };

/* Copies `used` channels of every pixel, each once (or the first one `repeat` times). */
static void put_samples(const lom_image *image, int used, int repeat, uint8_t *to)
{
    const lom_format_info *info = lom_describe_format(image->format);
    size_t count = (size_t)image->width * (size_t)image->height, bytes = (size_t)info->bits / 8;
    const uint8_t *from = image->pixels;
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < used * repeat; c++, to += bytes) {
            const uint8_t *sample = from + (size_t)(c / repeat) * bytes;
            uint16_t wide;
            if (bytes == 1) {
                *to = *sample;
            } else {
                memcpy(&wide, sample, sizeof wide);
                store_16_big(to, wide);
            }
        }
        from += bytes * (size_t)info->channels;
    }
}

static lom_bytes encode(const lom_image *image, const char *header, int used, int repeat, lom_error *error)
{
    size_t length = strlen(header), sample = (size_t)lom_describe_format(image->format)->bits / 8;
    size_t body = (size_t)image->width * (size_t)image->height * (size_t)(used * repeat) * sample;
    lom_bytes file = { lom_allocate(length + body, 1, error), length + body };
    if (file.data == NULL)
        return (lom_bytes){ 0 };
    memcpy(file.data, header, length);
    if (used == lom_describe_format(image->format)->channels && sample == 1 && repeat == 1)
        memcpy(file.data + length, image->pixels, body);
    else
        put_samples(image, used, repeat, file.data + length);
    return file;
}

/* 8 or 16 bits, not floats; the number of channels, 0 after a failure. */
static int channels_of(const lom_image *image, const char *kind, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    if (!info->is_float && info->bits <= 16)
        return info->channels;
    lom_fail(error, LOM_ERROR_USAGE, "%s holds 8 or 16 bits a sample, not %s; convert the picture first.", kind,
             info->name);
    return 0;
}

static unsigned maximum_of(const lom_image *image)
{
    return lom_describe_format(image->format)->bits == 16 ? 65535 : 255;
}

lom_bytes lom_encode_ppm(const lom_image *image, lom_error *error)
{
    char header[HEADER];
    int channels = channels_of(image, "PPM", error);
    if (channels == 0)
        return (lom_bytes){ 0 };
    snprintf(header, sizeof header, "P6\n%d %d\n%u\n", image->width, image->height, maximum_of(image));
    return encode(image, header, channels >= 3 ? 3 : 1, channels >= 3 ? 1 : 3, error);
}

lom_bytes lom_encode_pgm(const lom_image *image, lom_error *error)
{
    char header[HEADER];
    int channels = channels_of(image, "PGM", error);
    if (channels >= 3)
        lom_fail(error, LOM_ERROR_USAGE, "PGM holds gray pictures, not %s; convert the picture first.",
                 lom_describe_format(image->format)->name);
    if (channels == 0 || channels >= 3)
        return (lom_bytes){ 0 };
    snprintf(header, sizeof header, "P5\n%d %d\n%u\n", image->width, image->height, maximum_of(image));
    return encode(image, header, 1, 1, error);
}

lom_bytes lom_encode_pam(const lom_image *image, lom_error *error)
{
    static const char *const types[] = { "GRAYSCALE", "GRAYSCALE_ALPHA", "RGB", "RGB_ALPHA" };
    char header[HEADER];
    int channels = channels_of(image, "PAM", error);
    if (channels == 0)
        return (lom_bytes){ 0 };
    snprintf(header, sizeof header, "P7\nWIDTH %d\nHEIGHT %d\nDEPTH %d\nMAXVAL %u\nTUPLTYPE %s\nENDHDR\n", image->width,
             image->height, channels, maximum_of(image), types[channels - 1]);
    return encode(image, header, channels, 1, error);
}
