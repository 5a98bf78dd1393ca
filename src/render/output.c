/* The finished picture. In: what was drawn. Out: an image in the scene's output format, or rows in the caller's memory,
 * with exposure and curve (tone.h), encoded once. */
#include "image/bare_image.h"
#include "image/convert.h"
#include "image/texture.h"
#include "lanes/variants.h"
#include "pipeline/device.h"
#include "pipeline/share_work.h"
#include "render/targets.h"
#include "render/tone.h"

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

/* How a scene's light becomes its picture. */
struct encoding {
    const lom_output *output;
    struct lom_tone tone;
    bool is_toned;
    lom_pixel_order order;
};

static struct encoding encoding_of(const lom_output *output, lom_pixel_order order)
{
    return (struct encoding){ output, lom_make_tone(output), lom_is_toned(output), order };
}

/* A pixel in a format of more than 8 bits, at any address; where the next one is to be. */
static uint8_t *put_deep(const lom_output *output, const float light[3], uint8_t *to)
{
    const bool srgb = output->transfer == LOM_TRANSFER_SRGB;
    if (output->format == LOM_OUTPUT_RGB32F) {
        memcpy(to, light, 3 * sizeof *light);
        return to + 3 * sizeof *light;
    }
    for (int c = 0; c < 3; c++) {
        double value = light[c] > 0 ? light[c] < 1 ? light[c] : 1 : 0;
        uint16_t deep = (uint16_t)lom_count_of((srgb ? encode_srgb(value) : value) * 65535 + 0.5, 65535);
        memcpy(to, &deep, sizeof deep);
        to += sizeof deep;
    }
    return to;
}

static uint32_t encode_texel(bool srgb, const float light[3])
{
    uint32_t texel = 0;
    for (int c = 0; c < 3; c++)
        texel |= (srgb ? lom_srgb8_of(light[c]) : lom_unorm_of((double)light[c], 255)) << 8 * c;
    return texel;
}

/* Red in the lowest byte of the texel. */
static inline uint8_t *put_texel(uint32_t texel, lom_pixel_order order, uint8_t *to)
{
    const int step = order == LOM_ORDER_OUTPUT ? 3 : 4, red = order == LOM_ORDER_BGRX ? 2 : 0;
    to[red] = (uint8_t)texel;
    to[1] = (uint8_t)(texel >> 8);
    to[2 - red] = (uint8_t)(texel >> 16);
    if (step == 4)
        to[3] = 255;
    return to + step;
}

/* A row of linear light, `channels` floats a pixel. */
static void encode_row(const struct encoding *e, const float *linear, int channels, int count, uint8_t *row)
{
    const bool srgb = e->output->transfer == LOM_TRANSFER_SRGB;
    for (int i = 0; i < count; i++, linear += channels) {
        float light[3];
        for (int c = 0; c < 3; c++)
            light[c] = e->is_toned ? lom_tone_of(&e->tone, linear[c]) : linear[c];
        if (e->output->format == LOM_OUTPUT_RGB8)
            row = put_texel(encode_texel(srgb, light), e->order, row);
        else
            row = put_deep(e->output, light, row);
    }
}

lom_format lom_format_of_output(const lom_output *output)
{
    if (output->format != LOM_OUTPUT_RGB8)
        return output->format == LOM_OUTPUT_RGB16 ? LOM_FORMAT_RGB16 : LOM_FORMAT_RGB32F;
    return output->transfer == LOM_TRANSFER_SRGB ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8;
}

/* Pixels in 8 bits, encoded already; where the next one is to be. */
static uint8_t *copy_row(const uint32_t *restrict from, int count, lom_pixel_order order, uint8_t *restrict to)
{
    for (int i = 0; i < count; i++)
        to = put_texel(from[i], order, to);
    return to;
}

typedef void encode_light(const struct lom_tone *tone, bool srgb, const float *light, size_t count, uint32_t *texels);
#define DECLARE(name, variant) encode_light lom_encode_light_##variant;
#define ENTRY(name, variant)   [LOM_SLOT_##variant] = lom_encode_light_##variant,
LOM_EACH_VARIANT(DECLARE, )
static encode_light *const encoders[LOM_VARIANTS] = { LOM_EACH_VARIANT(ENTRY, ) };

/* A row of four floats a pixel to 8 bits: whole packets of any width by lanes, the rest as it is defined. */
static void encode_bytes(const struct encoding *e, encode_light *by_lanes, const float *linear, int count, uint8_t *row)
{
    enum { PACKET = 16, PIXELS = 8 * PACKET };
    const bool srgb = e->output->transfer == LOM_TRANSFER_SRGB;
    uint32_t texels[PIXELS];
    while (count >= PACKET) {
        const int pixels = count < PIXELS ? count / PACKET * PACKET : PIXELS;
        by_lanes(&e->tone, srgb, linear, (size_t)pixels, texels);
        row = copy_row(texels, pixels, e->order, row);
        linear += 4 * pixels;
        count -= pixels;
    }
    encode_row(e, linear, 4, count, row);
}

struct writing {
    struct encoding encoding;
    encode_light *by_lanes;
    const lom_texture *drawn;
    lom_rect asked;
    uint8_t *pixels;
    size_t pitch;
};

static void write_rows(void *context, size_t first, size_t end)
{
    const struct writing *w = context;
    const int width = w->asked.width;
    for (size_t y = first; y < end; y++) {
        const void *from = lom_texel(w->drawn, 0, w->asked.x, w->asked.y + (int)y, 0);
        uint8_t *to = w->pixels + y * w->pitch;
        if (w->encoding.output->format != LOM_OUTPUT_RGB8)
            encode_row(&w->encoding, from, 4, width, to);
        else if (w->encoding.is_toned)
            encode_bytes(&w->encoding, w->by_lanes, from, width, to);
        else
            copy_row(from, width, w->encoding.order, to);
    }
}

void lom_output_rows(const lom_scene *scene, lom_device *device, const struct lom_targets *targets,
                     lom_pixel_order order, void *pixels, size_t pitch)
{
    enum { ROWS = 16 };
    struct writing writing = { encoding_of(&scene->output, order),
                               encoders[device->variant],
                               targets->of[LOM_TARGET_COLOR],
                               targets->asked,
                               pixels,
                               pitch };
    lom_share_work(device, (size_t)targets->asked.height, ROWS, write_rows, &writing);
}

lom_image *lom_output_target(const lom_scene *scene, lom_device *device, const struct lom_targets *targets,
                             lom_error *error)
{
    const lom_format format = lom_format_of_output(&scene->output);
    lom_image *image = lom_create_bare_image(targets->asked.width, targets->asked.height, 1, format, error);
    if (image != NULL)
        lom_output_rows(scene, device, targets, LOM_ORDER_OUTPUT, image->pixels,
                        (size_t)image->width * lom_format_size(format));
    return image;
}

lom_image *lom_output_image(const lom_scene *scene, lom_image *drawn, lom_error *error)
{
    const lom_output *output = &scene->output;
    lom_format format = lom_format_of_output(output);
    if (drawn == NULL)
        return NULL;
    if (output->format != LOM_OUTPUT_RGB16 && !lom_is_toned(output)) {
        lom_image *image = lom_convert_image(drawn, format, error);
        lom_free_image(drawn);
        return image;
    }
    const struct encoding encoding = encoding_of(output, LOM_ORDER_OUTPUT);
    lom_image *image = lom_create_image(drawn->width, drawn->height, 1, format, error);
    for (int y = 0; image != NULL && y < image->height; y++)
        encode_row(&encoding, lom_image_pixel(drawn, 0, y, 0), 3, image->width, lom_image_pixel(image, 0, y, 0));
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
