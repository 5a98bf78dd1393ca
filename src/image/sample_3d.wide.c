/* Samplers of 3D textures: two squares of texels a sample, mixed along r. */
#include "sample_lanes.h"

LOM_INLINE void sample_as(lom_storage storage, bool srgb, const lom_texture *texture, const lom_float3 *at,
                          lom_float lod, lom_float4 *out)
{
    sample_point point;
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    point.r = sample_wrap(at->z, texture->sampler.wrap_r);
    *out = sample_texture(texture, LOM_TEXTURE_3D, storage, srgb, &point, lod);
}

static void sample_rgba8(const lom_texture *texture, const lom_float3 *at, lom_float lod, lom_float4 *out)
{
    sample_as(LOM_STORAGE_RGBA8, false, texture, at, lod, out);
}

static void sample_srgb8(const lom_texture *texture, const lom_float3 *at, lom_float lod, lom_float4 *out)
{
    sample_as(LOM_STORAGE_RGBA8, true, texture, at, lod, out);
}

static void sample_decoded(const lom_texture *texture, const lom_float3 *at, lom_float lod, lom_float4 *out)
{
    sample_as(LOM_STORAGE_RGBA32F, true, texture, at, lod, out);
}

static void sample_r32f(const lom_texture *texture, const lom_float3 *at, lom_float lod, lom_float4 *out)
{
    sample_as(LOM_STORAGE_R32F, false, texture, at, lod, out);
}

static void sample_rgba32f(const lom_texture *texture, const lom_float3 *at, lom_float lod, lom_float4 *out)
{
    sample_as(LOM_STORAGE_RGBA32F, false, texture, at, lod, out);
}

void LOM_WIDE(lom_sample_3d_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                   lom_float4 *out)
{
    switch (texture->storage) {
    case LOM_STORAGE_RGBA8:
        (texture->decoded != NULL ? sample_decoded
         : texture->srgb          ? sample_srgb8
                                  : sample_rgba8)(texture, at, *lod, out);
        break;
    case LOM_STORAGE_R32F:
        sample_r32f(texture, at, *lod, out);
        break;
    case LOM_STORAGE_RGBA32F:
        sample_rgba32f(texture, at, *lod, out);
        break;
    }
}
