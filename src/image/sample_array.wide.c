/* Samplers of 2D arrays: a 2D texture a layer. As for 3D textures, how texels are held is asked while it runs. */
#include "sample_fixed.h"

void LOM_WIDE(lom_sample_array_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                      lom_float4 *out)
{
    lom_float last = lom_splat((float)(texture->layers - 1));
    sample_point point;
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    point.face = lom_bounded_to_int(lom_clamp(lom_round(at->z), (lom_float){ 0 }, last));
    lom_storage storage = texture->decoded != NULL ? LOM_STORAGE_RGBA32F : texture->storage;
    *out = sample_by(texture->fixed, texture, LOM_TEXTURE_2D_ARRAY, storage, texture->srgb, &point, *lod);
}
