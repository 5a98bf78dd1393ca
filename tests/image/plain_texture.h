/* Random textures whose levels are also decoded to double, for the tests of the samplers. */
#ifndef LOM_TESTS_PLAIN_TEXTURE_H
#define LOM_TESTS_PLAIN_TEXTURE_H

#include "check.h"

#include <math.h>

#include "image/texture.h"

static lom_error error;

static inline double random_unit(uint64_t key, uint64_t i)
{
    return lom_random_uniform(key, i);
}

/* A texture as the oracle sees it: decoded levels. */
typedef struct plain_texture {
    lom_texture_desc desc;
    lom_texture *texture;
    int levels, width[16], height[16], depth[16];
    double (*texel[16])[4];
    double border[4];
} plain_texture;

static inline double decode_srgb(double v)
{
    return (float)(v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
}

static inline void decode_level(plain_texture *p, int level)
{
    lom_image *image = lom_read_texture(p->texture, level, -1, &error);
    const lom_format_info *info = lom_describe_format(image->format);
    size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->depth;
    lom_format wide = info->is_float ? LOM_FORMAT_RGBA32F : LOM_FORMAT_RGBA16;
    p->width[level] = image->width;
    p->height[level] = image->height;
    p->depth[level] = image->depth;
    p->texel[level] = malloc(count * sizeof **p->texel);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 4; c++) {
            double x = c == 3;
            const uint8_t *at = image->pixels + i * lom_format_size(image->format) + (size_t)(c * info->bits / 8);
            uint16_t half = 0;
            float single = 0;
            if (c < info->channels && info->bits == 8)
                x = info->is_srgb && c < 3 ? decode_srgb(*at / 255.0) : *at / 255.0;
            if (c < info->channels && info->bits == 16 && wide == LOM_FORMAT_RGBA16) {
                memcpy(&half, at, sizeof half);
                x = (float)(half / 65535.0);
            }
            if (c < info->channels && info->bits == 32) {
                memcpy(&single, at, sizeof single);
                x = single;
            }
            p->texel[level][i][c] = x;
        }
    lom_free_image(image);
}

static inline void fill_random(const lom_format_info *info, uint8_t *pixels, size_t count)
{
    for (size_t i = 0; i < count * (size_t)info->channels; i++) {
        uint64_t bits = lom_random_bits(11, i);
        uint16_t half = (uint16_t)bits;
        float single = (float)(lom_random_uniform(12, i) * 4 - 2);
        if (info->bits == 8)
            pixels[i] = (uint8_t)bits;
        else if (info->bits == 16)
            memcpy(pixels + i * 2, &half, 2);
        else
            memcpy(pixels + i * 4, &single, 4);
    }
}

/* Of the descriptor's pixels. */
static inline plain_texture make_plain_of(lom_texture_desc desc)
{
    plain_texture p = { .desc = desc };
    p.texture = lom_create_texture(&desc, &error);
    CHECK(p.texture != NULL, "%s", error.text);
    p.levels = lom_texture_levels(p.texture);
    for (int i = 0; i < p.levels; i++)
        decode_level(&p, i);
    const lom_format_info *info = lom_describe_format(desc.format);
    for (int c = 0; c < 4; c++) {
        double b = desc.sampler.border[c]; /* the tests use 0 and 1, which every format holds */
        p.border[c] = c < info->channels || info->bits == 8 || info->channels > 1 ? b : c == 3;
    }
    return p;
}

static inline plain_texture make_plain(lom_texture_desc desc)
{
    int layers = desc.kind == LOM_TEXTURE_CUBE ? 6 : desc.kind == LOM_TEXTURE_3D ? desc.depth : 1;
    size_t count = (size_t)desc.width * (size_t)desc.height * (size_t)layers;
    uint8_t *pixels = malloc(count * 16);
    fill_random(lom_describe_format(desc.format), pixels, count);
    desc.pixels = pixels;
    plain_texture p = make_plain_of(desc);
    free(pixels);
    return p;
}

static inline void free_plain(plain_texture *p)
{
    for (int i = 0; i < p->levels; i++)
        free(p->texel[i]);
    lom_free_texture(p->texture);
}

static inline lom_float4 sample_any(const plain_texture *p, lom_float3 at, lom_float lod)
{
    return p->desc.kind == LOM_TEXTURE_3D ? lom_sample_3d(p->texture, at.x, at.y, at.z, lod)
                                          : lom_sample(p->texture, at.x, at.y, lod);
}

static const lom_format plain_formats[] = { LOM_FORMAT_RGBA8,   LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R32F,
                                            LOM_FORMAT_RGBA32F, LOM_FORMAT_R8,         LOM_FORMAT_RGB8_SRGB,
                                            LOM_FORMAT_RG16 };

#endif
