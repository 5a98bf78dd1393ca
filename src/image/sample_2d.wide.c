/* Samplers of 2D textures and the level of detail. In: coordinates over lanes; out: filtered texels. One function a
 * storage, so that nothing is decided per texel. */
#include "level_of_detail.h"
#include "sample_fixed.h"

LOM_INLINE lom_float4 sample_as(bool fixed, lom_storage storage, bool srgb, const lom_texture *texture,
                                const lom_float2 *at, lom_float lod)
{
    sample_point point;
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    return sample_by(fixed, texture, LOM_TEXTURE_2D, storage, srgb, &point, lod);
}

SAMPLE_EVERY_STORAGE(lom_sample_lanes, lom_float2, sample_as)

void LOM_WIDE(lom_sample_depth_lanes)(const lom_texture *texture, const lom_float2 *at, lom_float *out)
{
    lom_float4 value;
    lom_float lod = lom_splat(-1000.0f);
    LOM_WIDE(lom_sample_lanes)(texture, at, &lod, &value);
    *out = value.x;
}

void LOM_WIDE(lom_fetch_lanes)(const lom_texture *texture, const lom_int *x, const lom_int *y, int level,
                               lom_float4 *out)
{
    int last = texture->level_count - 1;
    const lom_level *l = &texture->level[level < 0 ? 0 : level > last ? last : level];
    lom_int zero = { 0 };
    lom_int column = lom_min_int(lom_max_int(*x, zero), lom_splat_int(l->width - 1));
    lom_int row = lom_min_int(lom_max_int(*y, zero), lom_splat_int(l->height - 1));
    lom_int index = row * (int32_t)l->pitch + column + (int32_t)l->offset;
    LOM_NOTE(LOM_NOTE_TEXEL, texture, lom_as_float(column), lom_as_float(row), lom_splat((float)(l - texture->level)));
    if (texture->storage == LOM_STORAGE_R32F)
        *out = sample_finish(LOM_STORAGE_R32F, false, sample_texel(texture, LOM_STORAGE_R32F, false, index));
    else if (texture->storage == LOM_STORAGE_RGBA32F)
        *out = sample_finish(LOM_STORAGE_RGBA32F, false, sample_texel(texture, LOM_STORAGE_RGBA32F, false, index));
    else if (texture->srgb)
        *out = sample_finish(LOM_STORAGE_RGBA8, true, sample_texel(texture, LOM_STORAGE_RGBA8, true, index));
    else
        *out = sample_finish(LOM_STORAGE_RGBA8, false, sample_texel(texture, LOM_STORAGE_RGBA8, false, index));
    LOM_NOTE(LOM_NOTE_RESULT, texture, out->x, out->y, out->z, out->w);
}

void LOM_WIDE(lom_lod_lanes)(const lom_texture *texture, const lom_float derivative[4], lom_float *lod)
{
    lom_float along_x, along_y;
    sample_squares(texture, derivative, &along_x, &along_y);
    *lod = sample_half_log2(lom_max(along_x, along_y));
}
