/* The targets of a frame's passes, and the finished picture. In: sizes. Out: textures; the picture in the scene's
 * output format, encoded once. */
#include "pipeline/check_device.h"
#include "render/renderer.h"
#include "water/water_models.h"

static int scaled(int size, double scale)
{
    int result = lom_int_of(size * scale + 0.5);
    return result < 1 ? 1 : result;
}

static lom_texture *make_target(lom_renderer *renderer, int width, int height, lom_format format, lom_mips mips)
{
    lom_sampler_desc sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP };
    if (format == LOM_FORMAT_DEPTH32F)
        sampler.magnify = sampler.minify = LOM_FILTER_NEAREST;
    return lom_make_texture(
        renderer->device,
        &(lom_texture_desc){ .width = width, .height = height, .format = format, .mips = mips, .sampler = sampler });
}

static void release_targets(lom_renderer *r)
{
    lom_texture **targets[] = { &r->targets.color,
                                &r->targets.depth,
                                &r->targets.mask,
                                &r->targets.reflection,
                                &r->targets.reflection_depth,
                                &r->targets.refraction,
                                &r->targets.refraction_depth,
                                &r->targets.spray };
    if (r->targets.reflection_depth == r->targets.refraction_depth)
        r->targets.reflection_depth = NULL;
    if (r->targets.mask == r->targets.refraction)
        r->targets.mask = NULL;
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++) {
        lom_release_texture(r->device, *targets[i]);
        *targets[i] = NULL;
    }
}

/* What the eye sees is 8-bit sRGB, unless the output asks for more than 8 bits. */
static lom_format color_format(const lom_scene *scene)
{
    if (scene->output.format != LOM_OUTPUT_RGB8)
        return LOM_FORMAT_RGBA32F;
    return scene->output.transfer == LOM_TRANSFER_SRGB ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8;
}

static void make_water_targets(lom_renderer *r, int width, int height)
{
    const lom_scene *scene = r->scene;
    int reflection_width = scaled(width, scene->quality.reflection_scale),
        reflection_height = scaled(height, scene->quality.reflection_scale);
    int refraction_width = scaled(width, scene->quality.refraction_scale),
        refraction_height = scaled(height, scene->quality.refraction_scale);
    /* Rough water mirrors a blurred picture. */
    lom_mips levels = lom_water_models[scene->quality.water].has_waves ? LOM_MIPS_ALL : LOM_MIPS_NONE;
    r->targets.reflection = make_target(r, reflection_width, reflection_height, color_format(scene), levels);
    r->targets.refraction = make_target(r, refraction_width, refraction_height, color_format(scene), LOM_MIPS_NONE);
    r->targets.refraction_depth =
        make_target(r, refraction_width, refraction_height, LOM_FORMAT_DEPTH32F, LOM_MIPS_NONE);
    /* The mask is read before that picture is drawn. */
    bool same = r->targets.drawn_width == refraction_width && r->targets.drawn_height == refraction_height &&
                color_format(scene) != LOM_FORMAT_RGBA32F;
    r->targets.mask =
        same ? r->targets.refraction
             : make_target(r, r->targets.drawn_width, r->targets.drawn_height, LOM_FORMAT_R8, LOM_MIPS_NONE);
    /* The planar lake never looks up how far away what it mirrors is, and draws that picture first. */
    bool shared = !lom_water_models[scene->quality.water].has_waves && reflection_width == refraction_width &&
                  reflection_height == refraction_height;
    r->targets.reflection_depth =
        shared ? r->targets.refraction_depth
               : make_target(r, reflection_width, reflection_height, LOM_FORMAT_DEPTH32F, LOM_MIPS_NONE);
}

bool lom_make_targets(lom_renderer *r, int width, int height, int target_width, int target_height, lom_error *error)
{
    if (r->targets.color != NULL && r->targets.width == width && r->targets.height == height &&
        r->targets.drawn_width == target_width && r->targets.drawn_height == target_height)
        return true;
    release_targets(r);
    r->targets.width = width;
    r->targets.height = height;
    r->targets.drawn_width = target_width;
    r->targets.drawn_height = target_height;
    r->targets.color = make_target(r, target_width, target_height, color_format(r->scene), LOM_MIPS_NONE);
    r->targets.depth = make_target(r, target_width, target_height, LOM_FORMAT_DEPTH32F, LOM_MIPS_NONE);
    if (r->spray.sprites != NULL)
        r->targets.spray = make_target(r, target_width, target_height, LOM_FORMAT_RGBA32F, LOM_MIPS_NONE);
    if (r->scene->water.present && r->scene->water.enabled)
        make_water_targets(r, width, height);
    return lom_check_device(r->device, error);
}

uint64_t lom_target_bytes(const lom_scene *scene, int width, int height, int target_width, int target_height)
{
    uint64_t color = lom_format_size(color_format(scene)), depth = 4;
    uint64_t bytes = (uint64_t)target_width * (uint64_t)target_height * (2 * color + depth); /* and the picture */
    if (!scene->water.present || !scene->water.enabled)
        return bytes;
    const double scales[] = { scene->quality.reflection_scale, scene->quality.refraction_scale };
    for (int i = 0; i < 2; i++)
        bytes += (uint64_t)scaled(width, scales[i]) * (uint64_t)scaled(height, scales[i]) * (color + depth);
    return bytes;
}

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
