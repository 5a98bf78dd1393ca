/* Samplers of 3D textures: two squares of texels a sample, mixed along r. */
#include "sample_lanes.h"

static void sample_rgba8(const lom_texture *texture, sample_point point, lom_float lod, lom_float4 *out)
{
    *out = sample_texture(texture, LOM_TEXTURE_3D, LOM_STORAGE_RGBA8, false, point, lod);
}

static void sample_srgb8(const lom_texture *texture, sample_point point, lom_float lod, lom_float4 *out)
{
    *out = sample_texture(texture, LOM_TEXTURE_3D, LOM_STORAGE_RGBA8, true, point, lod);
}

static void sample_r32f(const lom_texture *texture, sample_point point, lom_float lod, lom_float4 *out)
{
    *out = sample_texture(texture, LOM_TEXTURE_3D, LOM_STORAGE_R32F, false, point, lod);
}

static void sample_rgba32f(const lom_texture *texture, sample_point point, lom_float lod, lom_float4 *out)
{
    *out = sample_texture(texture, LOM_TEXTURE_3D, LOM_STORAGE_RGBA32F, false, point, lod);
}

void LOM_WIDE(lom_sample_3d_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                   lom_float4 *out)
{
    sample_point point = { .s = sample_wrap(at->x, texture->sampler.wrap_s),
                           .t = sample_wrap(at->y, texture->sampler.wrap_t),
                           .r = sample_wrap(at->z, texture->sampler.wrap_r) };
    switch (texture->storage) {
    case LOM_STORAGE_RGBA8:
        (texture->srgb ? sample_srgb8 : sample_rgba8)(texture, point, *lod, out);
        break;
    case LOM_STORAGE_R32F:
        sample_r32f(texture, point, *lod, out);
        break;
    case LOM_STORAGE_RGBA32F:
        sample_rgba32f(texture, point, *lod, out);
        break;
    }
}
