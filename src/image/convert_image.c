/* Whole pictures from one format to another: rows decoded to double, channels matched, rows encoded.
 * Compiled for speed. */
#include "convert_rows.h"

#include <string.h>

/* One channel becomes grey, three become their Rec. 709 luminance (ITU-R BT.709, item 3.2) in linear light. */
static void match_channels(int from, int to, double (*rgba)[4], size_t count)
{
    if (from == 1 && to >= 3)
        for (size_t i = 0; i < count; i++)
            rgba[i][1] = rgba[i][2] = rgba[i][0];
    if (from >= 3 && to == 1)
        for (size_t i = 0; i < count; i++)
            rgba[i][0] = 0.2126 * rgba[i][0] + 0.7152 * rgba[i][1] + 0.0722 * rgba[i][2];
}

/* Whether bytes stay what they are, since colours of both formats mean the same. */
static bool keeps_bytes(const lom_format_info *from, const lom_format_info *to)
{
    return from->bits == 8 && to->bits == 8 && from->is_srgb == to->is_srgb && from->channels >= 3 && to->channels >= 3;
}

static void copy_colors(const uint8_t *in, int from, uint8_t *out, int to, size_t count)
{
    for (size_t i = 0; i < count; i++, in += from, out += to) {
        out[0] = in[0];
        out[1] = in[1];
        out[2] = in[2];
        if (to == 4)
            out[3] = 255; /* three channels are opaque */
    }
}

static lom_image *convert_level(const lom_image *image, lom_format format, lom_error *error)
{
    const lom_format_info *from = lom_describe_format(image->format), *to = lom_describe_format(format);
    if (from == NULL || to == NULL) {
        lom_fail(error, LOM_ERROR_USAGE, "There is no conversion from format %d to format %d.", (int)image->format,
                 (int)format);
        return NULL;
    }
    lom_image *out = lom_create_image(image->width, image->height, image->depth, format, error);
    if (out == NULL)
        return NULL;
    out->slices = image->slices;
    if (format == image->format) {
        memcpy(out->pixels, image->pixels, lom_image_size(image));
        return out;
    }
    if (keeps_bytes(from, to)) {
        copy_colors(image->pixels, from->channels, out->pixels, to->channels,
                    lom_image_size(out) / lom_format_size(format));
        return out;
    }
    size_t width = (size_t)image->width, rows = (size_t)image->height * (size_t)image->depth;
    double(*rgba)[4] = lom_allocate(width, sizeof *rgba, error);
    if (rgba == NULL) {
        lom_free_image(out);
        return NULL;
    }
    size_t step_in = width * lom_format_size(image->format), step_out = width * lom_format_size(format);
    for (size_t y = 0; y < rows; y++) {
        lom_decode_row(image->format, image->pixels + y * step_in, width, rgba);
        match_channels(from->channels, to->channels, rgba, width);
        lom_encode_row(format, (const double(*)[4])rgba, width, out->pixels + y * step_out);
    }
    lom_release(rgba);
    return out;
}

static lom_image *convert(const lom_image *image, lom_format format, lom_error *error)
{
    lom_image *first = convert_level(image, format, error), *last = first;
    while (last != NULL && image->smaller != NULL) {
        image = image->smaller;
        last = last->smaller = convert_level(image, format, error);
    }
    if (last != NULL)
        return first;
    lom_free_image(first);
    return NULL;
}

lom_image *lom_convert_image(const lom_image *image, lom_format format, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_image *converted = convert(image, format, error);
    lom_leave_float_state(&state);
    return converted;
}
