/* The finished picture. In: what was drawn. Out: an image in the scene's output format, encoded once. */
#include "render/targets.h"

/* IEC 61966-2-1 of linear light, in double. */
static double encode_srgb(double x)
{
    if (!(x > 0))
        return 0;
    if (x >= 1)
        return 1;
    return x <= 0.0031308 ? 12.92 * x : 1.055 * lom_double_pow(x, 1 / 2.4) - 0.055;
}

static lom_image *encode_16(const lom_image *linear, bool srgb, lom_error *error)
{
    lom_image *out = lom_create_image(linear->width, linear->height, 1, LOM_FORMAT_RGB16, error);
    if (out == NULL)
        return NULL;
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            const float *from = lom_image_pixel(linear, x, y, 0);
            uint16_t *to = lom_image_pixel(out, x, y, 0);
            for (int c = 0; c < 3; c++) {
                double value = from[c] > 0 ? from[c] < 1 ? from[c] : 1 : 0;
                to[c] = (uint16_t)lom_count_of((srgb ? encode_srgb(value) : value) * 65535 + 0.5, 65535);
            }
        }
    return out;
}

/* Four bytes a pixel become three in the same memory. */
static lom_image *drop_alpha(lom_image *image, lom_format format)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    uint8_t *to = image->pixels;
    const uint8_t *from = image->pixels;
    for (size_t i = 0; i < count; i++, from += 4, to += 3) {
        uint8_t r = from[0], g = from[1], b = from[2];
        to[0] = r;
        to[1] = g;
        to[2] = b;
    }
    image->format = format;
    return image;
}

lom_image *lom_output_image(const lom_scene *scene, lom_image *drawn, lom_error *error)
{
    const lom_output *output = &scene->output;
    bool srgb = output->transfer == LOM_TRANSFER_SRGB;
    lom_image *out = NULL;
    if (drawn == NULL)
        return NULL;
    if (drawn->format == (srgb ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8) && output->format == LOM_OUTPUT_RGB8)
        return drop_alpha(drawn, srgb ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8);
    if (output->format == LOM_OUTPUT_RGB8)
        out = lom_convert_image(drawn, srgb ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8, error);
    else if (output->format == LOM_OUTPUT_RGB16)
        out = encode_16(drawn, srgb, error);
    else
        out = lom_convert_image(drawn, LOM_FORMAT_RGB32F, error);
    lom_free_image(drawn);
    return out;
}
