/* The finished picture. In: what was drawn. Out: an image in the scene's output format, encoded once. */
#include "image/texture.h"
#include "pipeline/share_work.h"
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

static lom_format output_format(const lom_output *output)
{
    if (output->format != LOM_OUTPUT_RGB8)
        return output->format == LOM_OUTPUT_RGB16 ? LOM_FORMAT_RGB16 : LOM_FORMAT_RGB32F;
    return output->transfer == LOM_TRANSFER_SRGB ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8;
}

/* A row of four bytes a pixel without its alpha. */
static void drop_alpha(const uint8_t *restrict from, int count, uint8_t *restrict to)
{
    for (int i = 0; i < count; i++, from += 4, to += 3) {
        to[0] = from[0];
        to[1] = from[1];
        to[2] = from[2];
    }
}

struct writing {
    const lom_output *output;
    const lom_texture *drawn;
    lom_image *image;
};

static void write_rows(void *context, size_t first, size_t end)
{
    const struct writing *w = context;
    int width = w->image->width;
    for (size_t y = first; y < end; y++) {
        const void *from = lom_texel(w->drawn, 0, 0, (int)y, 0);
        void *to = lom_image_pixel(w->image, 0, (int)y, 0);
        if (w->output->format == LOM_OUTPUT_RGB8)
            drop_alpha(from, width, to);
        else
            encode_row(w->output, from, 4, width, to);
    }
}

lom_image *lom_output_target(const lom_scene *scene, lom_device *device, const lom_texture *drawn, lom_error *error)
{
    enum { ROWS = 16 };
    const lom_output *output = &scene->output;
    int width = lom_texture_width(drawn), height = lom_texture_height(drawn);
    lom_image *image = lom_create_image(width, height, 1, output_format(output), error);
    struct writing writing = { output, drawn, image };
    if (image != NULL)
        lom_share_work(device, (size_t)height, ROWS, write_rows, &writing);
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
