/* Rows of pixels of any format from and to four doubles a pixel. Invariant: a double holds every sample of every format
 * closely enough that the one rounding into the target format is the rounding of the exact value: v / (2^n - 1) has a
 * periodic binary expansion of period n <= 24, so within 53 bits it never looks like a tie; sRGB codes are decoded to
 * the nearest float, from which all targets but 24-bit depth round as from the exact value (tested).
 * Compiled for speed. */
#include "convert_rows.h"
#include "convert.h"

typedef enum sample_form { FORM_UNORM8, FORM_SRGB8, FORM_UNORM16, FORM_HALF, FORM_FLOAT, FORM_UNORM24 } sample_form;

static sample_form form_of(lom_format format, int channel)
{
    const lom_format_info *info = lom_describe_format(format);
    if (info->bits == 8)
        return info->is_srgb && channel < 3 ? FORM_SRGB8 : FORM_UNORM8;
    if (info->bits == 16)
        return info->is_float ? FORM_HALF : FORM_UNORM16;
    return info->is_float ? FORM_FLOAT : FORM_UNORM24;
}

static uint16_t load_16(const uint8_t *from)
{
    uint16_t x;
    memcpy(&x, from, sizeof x);
    return x;
}

static uint32_t load_32(const uint8_t *from)
{
    uint32_t x;
    memcpy(&x, from, sizeof x);
    return x;
}

static double decode(sample_form form, const uint8_t *from)
{
    switch (form) {
    case FORM_UNORM8:
        return *from / 255.0;
    case FORM_SRGB8:
        return lom_srgb_linear[*from];
    case FORM_UNORM16:
        return load_16(from) / 65535.0;
    case FORM_HALF:
        return lom_float_of_half(load_16(from));
    case FORM_FLOAT:
        return lom_float_of_bits(load_32(from));
    case FORM_UNORM24:
        return (load_32(from) & 0xffffff) / 16777215.0;
    }
    return 0;
}

static void encode(sample_form form, double x, uint8_t *to)
{
    uint16_t x16;
    uint32_t x32;
    switch (form) {
    case FORM_UNORM8:
        *to = (uint8_t)lom_unorm_of(x, 255);
        return;
    case FORM_SRGB8:
        *to = lom_srgb8_of((float)x);
        return;
    case FORM_UNORM16:
        x16 = (uint16_t)lom_unorm_of(x, 65535);
        memcpy(to, &x16, sizeof x16);
        return;
    case FORM_HALF:
        x16 = lom_half_of(x);
        memcpy(to, &x16, sizeof x16);
        return;
    case FORM_FLOAT:
        x32 = x == x ? lom_bits_of_float((float)x) : 0x7fc00000;
        memcpy(to, &x32, sizeof x32);
        return;
    case FORM_UNORM24:
        x32 = lom_unorm_of(x, 16777215);
        memcpy(to, &x32, sizeof x32);
        return;
    }
}

void lom_decode_row(lom_format format, const void *from, size_t count, double (*rgba)[4])
{
    const lom_format_info *info = lom_describe_format(format);
    size_t sample = (size_t)info->bits / 8, pixel = lom_format_size(format);
    for (int c = 0; c < 4; c++) {
        if (c >= info->channels) {
            for (size_t i = 0; i < count; i++)
                rgba[i][c] = c == 3;
            continue;
        }
        sample_form form = form_of(format, c);
        const uint8_t *channel = (const uint8_t *)from + (size_t)c * sample;
        for (size_t i = 0; i < count; i++)
            rgba[i][c] = decode(form, channel + i * pixel);
    }
}

void lom_encode_row(lom_format format, const double (*rgba)[4], size_t count, void *to)
{
    const lom_format_info *info = lom_describe_format(format);
    size_t sample = (size_t)info->bits / 8, pixel = lom_format_size(format);
    for (int c = 0; c < info->channels; c++) {
        sample_form form = form_of(format, c);
        uint8_t *channel = (uint8_t *)to + (size_t)c * sample;
        bool unit = info->is_depth && info->is_float;
        for (size_t i = 0; i < count; i++)
            encode(form, unit ? lom_unit_of(rgba[i][c]) : rgba[i][c], channel + i * pixel);
    }
}
