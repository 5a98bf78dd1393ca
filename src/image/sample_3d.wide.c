/* Samplers of 3D textures: two squares of texels a sample, mixed along r. */
#include "sample_fixed.h"

LOM_INLINE lom_float4 sample_as(bool fixed, lom_storage storage, bool srgb, const lom_texture *texture,
                                const lom_float3 *at, lom_float lod)
{
    sample_point point;
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    point.r = sample_wrap(at->z, texture->sampler.wrap_r);
    return sample_by(fixed, texture, LOM_TEXTURE_3D, storage, srgb, &point, lod);
}

SAMPLE_EVERY_STORAGE(lom_sample_3d_lanes, lom_float3, sample_as)
