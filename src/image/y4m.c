/* YUV4MPEG2 (the mjpegtools' format): 8-bit Y'CbCr 4:4:4 frames one after another. In: the size and rate, then images
 * of 8-bit sRGB-encoded colour; out: the header, then each frame. BT.601 in the limited range, by integers, correctly
 * rounded. */
#include <lom/image.h>

#include <stdio.h>
#include <string.h>

lom_bytes lom_encode_y4m_header(int width, int height, int frames, int seconds, lom_error *error)
{
    if (width < 1 || height < 1 || width > LOM_MAX_SIZE || height > LOM_MAX_SIZE || frames < 1 || seconds < 1) {
        lom_fail(error, LOM_ERROR_USAGE, "There is no video of %d x %d pixels and %d:%d frames a second.", width,
                 height, frames, seconds);
        return (lom_bytes){ 0 };
    }
    enum { MOST = 128 };
    lom_bytes header = { .data = lom_allocate(MOST, 1, error) };
    if (header.data != NULL)
        header.size = (size_t)snprintf((char *)header.data, MOST, "YUV4MPEG2 W%d H%d F%d:%d Ip A1:1 C444\n", width,
                                       height, frames, seconds);
    return header;
}

/* offset + numerator / denominator, rounded to nearest (half up); numerator above -offset * denominator */
static uint8_t rounded(int offset, int numerator, int denominator)
{
    return (uint8_t)((2 * (offset * denominator + numerator) + denominator) / (2 * denominator));
}

/* BT.601, section 3.5: luma is E = 0.299 R + 0.587 G + 0.114 B; Y' = 16 + 219 E, Cb = 128 + 224 (B - E) / 1.772 and
 * Cr = 128 + 224 (R - E) / 1.402 of colours in 0..1. Thousandths keep every number whole, below 2^28. */
static void convert(int r, int g, int b, uint8_t *y, uint8_t *cb, uint8_t *cr)
{
    int luma = 299 * r + 587 * g + 114 * b;
    *y = rounded(16, 219 * luma / 3, 1000 * 255 / 3);
    *cb = rounded(128, 224 / 4 * (1000 * b - luma), 1772 * 255 / 4);
    *cr = rounded(128, 224 / 2 * (1000 * r - luma), 1402 * 255 / 2);
}

lom_bytes lom_encode_y4m_frame(const lom_image *image, lom_error *error)
{
    static const char start[] = "FRAME\n";
    const lom_format_info *info = lom_describe_format(image->format);
    if (info->bits != 8 || image->depth != 1) {
        lom_fail(error, LOM_ERROR_USAGE, "A video frame is a picture of 8 bits a sample, not %s of depth %d.",
                 info->name, image->depth);
        return (lom_bytes){ 0 };
    }
    size_t plane = (size_t)image->width * (size_t)image->height, length = sizeof start - 1;
    lom_bytes frame = { lom_allocate(length + 3 * plane, 1, error), length + 3 * plane };
    if (frame.data == NULL)
        return (lom_bytes){ 0 };
    memcpy(frame.data, start, length);
    uint8_t *to = frame.data + length;
    const uint8_t *from = image->pixels;
    size_t green = info->channels >= 3 ? 1 : 0, blue = 2 * green; /* gray is all three */
    for (size_t i = 0; i < plane; i++, from += info->channels)
        convert(from[0], from[green], from[blue], to + i, to + plane + i, to + 2 * plane + i);
    return frame;
}
