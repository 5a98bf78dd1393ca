/* Samplers of 3D textures: two squares of texels a sample, mixed along r. How texels are held is asked while it runs, so
 * that one function does for all. */
#include "sample_fixed.h"

void LOM_WIDE(lom_sample_3d_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                   lom_float4 *out)
{
    sample_point point;
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    point.r = sample_wrap(at->z, texture->sampler.wrap_r);
    lom_storage storage = texture->decoded != NULL ? LOM_STORAGE_RGBA32F : texture->storage;
    *out = sample_by(texture->fixed, texture, LOM_TEXTURE_3D, storage, texture->srgb, &point, *lod);
}
