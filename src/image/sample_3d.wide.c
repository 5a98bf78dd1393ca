/* Samplers of 3D textures, two squares of texels a sample, mixed along r, and of 2D arrays, one square of a layer. How
 * texels are held and which of the two it is are asked while it runs, so that one function does for all. */
#include "sample_fixed.h"

__attribute__((noinline)) static void sample_slices(const lom_texture *texture, sample_point *point,
                                                    const lom_float *lod, lom_float4 *out)
{
    lom_texture_kind kind = texture->kind == LOM_TEXTURE_3D ? LOM_TEXTURE_3D : LOM_TEXTURE_2D_ARRAY;
    lom_storage storage = texture->decoded != NULL ? LOM_STORAGE_RGBA32F : texture->storage;
    *out = sample_by(texture->fixed, texture, kind, storage, texture->srgb, point, *lod);
}

static sample_point place(const lom_texture *texture, const lom_float3 *at)
{
    return (sample_point){ .s = sample_wrap(at->x, texture->sampler.wrap_s),
                           .t = sample_wrap(at->y, texture->sampler.wrap_t) };
}

void LOM_WIDE(lom_sample_3d_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                   lom_float4 *out)
{
    sample_point point = place(texture, at);
    point.r = sample_wrap(at->z, texture->sampler.wrap_r);
    sample_slices(texture, &point, lod, out);
}

void LOM_WIDE(lom_sample_array_lanes)(const lom_texture *texture, const lom_float3 *at, const lom_float *lod,
                                      lom_float4 *out)
{
    lom_float last = lom_splat((float)(texture->layers - 1));
    sample_point point = place(texture, at);
    point.face = lom_bounded_to_int(lom_clamp(lom_round(at->z), (lom_float){ 0 }, last));
    sample_slices(texture, &point, lod, out);
}
