/* Rows of two pictures in their common format. In: images of any two formats. Out: doubles, interleaved channels, in
 * steps of the wider unsigned normalised format or as plain numbers. Invariant: a sample becomes the same number
 * whichever picture it stands in, and every format's numbers are held without loss. Compiled for speed. */
#include "compare.h"
#include "convert.h"

#include <string.h>

bool lom_find_common_format(const lom_image *a, const lom_image *b, lom_common_format *common, lom_error *error)
{
    const lom_format_info *fa = lom_describe_format(a->format), *fb = lom_describe_format(b->format);
    if (fa == NULL || fb == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "A picture without a pixel format cannot be compared.");
    bool alpha = fa->channels % 2 == 0 || fb->channels % 2 == 0;
    common->colors = fa->channels > 2 || fb->channels > 2 ? 3 : 1;
    common->channels = common->colors + alpha;
    common->is_float = fa->is_float || fb->is_float || fa->is_srgb != fb->is_srgb;
    int bits_a = a->format == LOM_FORMAT_DEPTH24 ? 24 : fa->bits,
        bits_b = b->format == LOM_FORMAT_DEPTH24 ? 24 : fb->bits;
    /* 2^24 - 1 is 65793 * 255 but no multiple of 65535: 24 and 16 bits meet in floats */
    if (!common->is_float && bits_a != bits_b && bits_a + bits_b == 40)
        common->is_float = true;
    common->bits = common->is_float ? 32 : bits_a > bits_b ? bits_a : bits_b;
    common->peak = common->is_float ? 1 : (double)((UINT32_C(1) << common->bits) - 1);
    return true;
}

bool lom_require_same_size(const lom_image *a, const lom_image *b, lom_error *error)
{
    if (a->width == b->width && a->height == b->height && a->depth == b->depth)
        return true;
    return lom_fail(error, LOM_ERROR_USAGE, "Pictures of %d x %d x %d and %d x %d x %d pixels cannot be compared.",
                    a->width, a->height, a->depth, b->width, b->height, b->depth);
}

double lom_srgb_decode_double(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : lom_double_pow((encoded + 0.055) / 1.055, 2.4);
}

double lom_srgb_encode_double(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * lom_double_pow(linear, 1 / 2.4) - 0.055;
}

/* One sample as it is stored: a number of steps, or a float. */
static double stored_sample(const lom_format_info *info, const uint8_t *address)
{
    uint16_t word16;
    uint32_t word32;
    float single;
    switch (info->bits) {
    case 8:
        return *address;
    case 16:
        memcpy(&word16, address, sizeof word16);
        return info->is_float ? (double)lom_float_of_half(word16) : word16;
    default:
        memcpy(&word32, address, sizeof word32);
        memcpy(&single, address, sizeof single);
        return info->is_float ? (double)single : (double)(word32 & 0xffffff);
    }
}

/* What turns stored samples into common ones. */
struct mapping {
    double scale;   /* steps to common steps: 257 from 8 to 16 bits, exact */
    double divisor; /* not 0: to floats, rounded to float as lom_convert_image does. The quotient of integers below 2^24
                     * is never near enough to the middle of two floats for the second rounding to matter. */
    bool decode;    /* sRGB, but not alpha */
};

static double map_sample(double stored, const struct mapping *mapping, bool is_color)
{
    if (mapping->divisor == 0)
        return stored * mapping->scale;
    if (mapping->decode && is_color) /* only samples of 8 bits are sRGB-encoded */
        return (double)lom_srgb_linear[lom_count_of(stored, UINT8_MAX)];
    return (double)(float)(stored / mapping->divisor);
}

/* Stored numbers that are the common ones already: the usual case, and two loops that vectorise. */
static void widen_row(const uint8_t *address, size_t count, int bits, double *out)
{
    if (bits == 8) {
        for (size_t i = 0; i < count; i++)
            out[i] = address[i];
        return;
    }
    for (size_t i = 0; i < count; i++) {
        uint16_t word;
        memcpy(&word, address + 2 * i, sizeof word);
        out[i] = word;
    }
}

void lom_read_common_row(const lom_image *image, const lom_common_format *common, int y, int z, double *out)
{
    const lom_format_info *info = lom_describe_format(image->format);
    double steps = image->format == LOM_FORMAT_DEPTH24 ? 0xffffff : info->bits == 8 ? 255 : 65535;
    struct mapping mapping = { .scale = 1 };
    if (common->is_float && !info->is_float)
        mapping = (struct mapping){ .divisor = steps, .decode = info->is_srgb };
    else if (!common->is_float)
        mapping.scale = common->peak / steps;
    size_t bytes = (size_t)info->bits / 8;
    int colors = info->channels > 2 ? 3 : 1;
    bool has_alpha = info->channels % 2 == 0;
    const uint8_t *address = lom_image_pixel(image, 0, y, z);
    if (!common->is_float && info->bits == common->bits && info->channels == common->channels && info->bits <= 16) {
        widen_row(address, (size_t)image->width * (size_t)info->channels, info->bits, out);
        return;
    }
    for (int x = 0; x < image->width; x++, out += common->channels) {
        for (int c = 0; c < colors; c++, address += bytes)
            out[c] = map_sample(stored_sample(info, address), &mapping, true);
        for (int c = colors; c < common->colors; c++)
            out[c] = out[0];
        if (common->channels > common->colors)
            out[common->colors] = has_alpha ? map_sample(stored_sample(info, address), &mapping, false) : common->peak;
        address += has_alpha ? bytes : 0;
    }
}

/* The sums of a block of places, in registers while the taps go by; taps are added in order at every place. */
enum { BLOCK = 8 };

void lom_filter_row(const double *in, int width, const double *weight, int taps, double *out)
{
    int x = 0;
    for (; x + BLOCK <= width; x += BLOCK) {
        double sum[BLOCK] = { 0 };
        for (int k = 0; k < taps; k++)
            for (int i = 0; i < BLOCK; i++)
                sum[i] += weight[k] * in[x + k + i];
        memcpy(out + x, sum, sizeof sum);
    }
    for (; x < width; x++) {
        out[x] = 0;
        for (int k = 0; k < taps; k++)
            out[x] += weight[k] * in[x + k];
    }
}

void lom_filter_column(const double *const *rows, int width, const double *weight, int taps, double *out)
{
    int x = 0;
    for (; x + BLOCK <= width; x += BLOCK) {
        double sum[BLOCK] = { 0 };
        for (int k = 0; k < taps; k++)
            for (int i = 0; i < BLOCK; i++)
                sum[i] += weight[k] * rows[k][x + i];
        memcpy(out + x, sum, sizeof sum);
    }
    for (; x < width; x++) {
        out[x] = 0;
        for (int k = 0; k < taps; k++)
            out[x] += weight[k] * rows[k][x];
    }
}
