/* The finished picture. In: what was drawn. Out: an image in the scene's output format, or rows in the caller's memory,
 * encoded once. */
#include "image/texture.h"
#include "pipeline/share_work.h"
#include "render/targets.h"

#include <string.h>

/* IEC 61966-2-1 of linear light, in double. */
static double encode_srgb(double x)
{
    if (!(x > 0))
        return 0;
    if (x >= 1)
        return 1;
    return x <= 0.0031308 ? 12.92 * x : 1.055 * lom_double_pow(x, 1 / 2.4) - 0.055;
}

/* A row of linear light, `channels` floats a pixel, in a format of more than 8 bits. The row may lie at any address. */
static void encode_row(const lom_output *output, const float *linear, int channels, int count, uint8_t *row)
{
    bool srgb = output->transfer == LOM_TRANSFER_SRGB;
    for (int i = 0; i < count; i++, linear += channels)
        for (int c = 0; c < 3; c++) {
            if (output->format == LOM_OUTPUT_RGB32F) {
                memcpy(row, &linear[c], sizeof linear[c]);
                row += sizeof linear[c];
                continue;
            }
            double value = linear[c] > 0 ? linear[c] < 1 ? linear[c] : 1 : 0;
            uint16_t deep = (uint16_t)lom_count_of((srgb ? encode_srgb(value) : value) * 65535 + 0.5, 65535);
            memcpy(row, &deep, sizeof deep);
            row += sizeof deep;
        }
}

static lom_format output_format(const lom_output *output)
{
    if (output->format != LOM_OUTPUT_RGB8)
        return output->format == LOM_OUTPUT_RGB16 ? LOM_FORMAT_RGB16 : LOM_FORMAT_RGB32F;
    return output->transfer == LOM_TRANSFER_SRGB ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8;
}

/* A row of texels, red in the lowest byte. */
static void copy_row(const uint32_t *restrict from, int count, lom_pixel_order order, uint8_t *restrict to)
{
    const int step = order == LOM_ORDER_OUTPUT ? 3 : 4, red = order == LOM_ORDER_BGRX ? 2 : 0;
    for (int i = 0; i < count; i++, to += step) {
        to[red] = (uint8_t)from[i];
        to[1] = (uint8_t)(from[i] >> 8);
        to[2 - red] = (uint8_t)(from[i] >> 16);
        if (step == 4)
            to[3] = 255;
    }
}

struct writing {
    const lom_output *output;
    const lom_texture *drawn;
    lom_pixel_order order;
    uint8_t *pixels;
    size_t pitch;
};

static void write_rows(void *context, size_t first, size_t end)
{
    const struct writing *w = context;
    const int width = lom_texture_width(w->drawn);
    for (size_t y = first; y < end; y++) {
        const void *from = lom_texel(w->drawn, 0, 0, (int)y, 0);
        if (w->output->format == LOM_OUTPUT_RGB8)
            copy_row(from, width, w->order, w->pixels + y * w->pitch);
        else
            encode_row(w->output, from, 4, width, w->pixels + y * w->pitch);
    }
}

void lom_output_rows(const lom_scene *scene, lom_device *device, const lom_texture *drawn, lom_pixel_order order,
                     void *pixels, size_t pitch)
{
    enum { ROWS = 16 };
    struct writing writing = { &scene->output, drawn, order, pixels, pitch };
    lom_share_work(device, (size_t)lom_texture_height(drawn), ROWS, write_rows, &writing);
}

lom_image *lom_output_target(const lom_scene *scene, lom_device *device, const lom_texture *drawn, lom_error *error)
{
    const lom_format format = output_format(&scene->output);
    lom_image *image = lom_create_image(lom_texture_width(drawn), lom_texture_height(drawn), 1, format, error);
    if (image != NULL)
        lom_output_rows(scene, device, drawn, LOM_ORDER_OUTPUT, image->pixels,
                        (size_t)image->width * lom_format_size(format));
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

bool lom_output_traced(const lom_scene *scene, lom_image *drawn, lom_pixel_order order, void *pixels, size_t pitch,
                       lom_error *error)
{
    lom_image *image = lom_output_image(scene, drawn, error);
    if (image == NULL)
        return false;
    const size_t bytes = (size_t)image->width * lom_format_size(image->format);
    uint8_t *row = pixels;
    for (int y = 0; y < image->height; y++, row += pitch) {
        const uint8_t *from = lom_image_pixel(image, 0, y, 0);
        if (order == LOM_ORDER_OUTPUT) {
            memcpy(row, from, bytes);
            continue;
        }
        const int red = order == LOM_ORDER_BGRX ? 2 : 0;
        for (int x = 0; x < image->width; x++, from += 3) {
            const uint8_t texel[4] = { from[red], from[1], from[2 - red], 255 };
            memcpy(row + 4 * (size_t)x, texel, 4);
        }
    }
    lom_free_image(image);
    return true;
}
