/* The finished picture. In: what was drawn. Out: an image in the scene's output format, encoded once. */
#include "image/texture.h"
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

/* A row of linear light, `channels` floats a pixel, in a format of more than 8 bits. */
static void encode_row(const lom_output *output, const float *linear, int channels, int count, void *row)
{
    bool srgb = output->transfer == LOM_TRANSFER_SRGB;
    uint16_t *deep = row;
    float *whole = row;
    for (int i = 0; i < count; i++, linear += channels)
        for (int c = 0; c < 3; c++) {
            if (output->format == LOM_OUTPUT_RGB32F) {
                *whole++ = linear[c];
                continue;
            }
            double value = linear[c] > 0 ? linear[c] < 1 ? linear[c] : 1 : 0;
            *deep++ = (uint16_t)lom_count_of((srgb ? encode_srgb(value) : value) * 65535 + 0.5, 65535);
        }
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

static lom_format output_format(const lom_output *output)
{
    if (output->format != LOM_OUTPUT_RGB8)
        return output->format == LOM_OUTPUT_RGB16 ? LOM_FORMAT_RGB16 : LOM_FORMAT_RGB32F;
    return output->transfer == LOM_TRANSFER_SRGB ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8;
}

lom_image *lom_output_target(const lom_scene *scene, const lom_texture *drawn, lom_error *error)
{
    const lom_output *output = &scene->output;
    lom_format format = output_format(output);
    int width = lom_texture_width(drawn), height = lom_texture_height(drawn);
    if (output->format == LOM_OUTPUT_RGB8) {
        lom_image *image = lom_read_texture(drawn, 0, 0, error);
        return image != NULL ? drop_alpha(image, format) : NULL;
    }
    lom_image *image = lom_create_image(width, height, 1, format, error);
    for (int y = 0; image != NULL && y < height; y++)
        encode_row(output, lom_texel(drawn, 0, 0, y, 0), 4, width, lom_image_pixel(image, 0, y, 0));
    return image;
}

lom_image *lom_output_image(const lom_scene *scene, lom_image *drawn, lom_error *error)
{
    const lom_output *output = &scene->output;
    lom_format format = output_format(output);
    if (drawn == NULL)
        return NULL;
    if (output->format != LOM_OUTPUT_RGB16) {
        lom_image *image = lom_convert_image(drawn, format, error);
        lom_free_image(drawn);
        return image;
    }
    lom_image *image = lom_create_image(drawn->width, drawn->height, 1, format, error);
    for (int y = 0; image != NULL && y < image->height; y++)
        encode_row(output, lom_image_pixel(drawn, 0, y, 0), 3, image->width, lom_image_pixel(image, 0, y, 0));
    lom_free_image(drawn);
    return image;
}
