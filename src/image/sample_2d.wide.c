/* Samplers of 2D textures and the level of detail. In: coordinates over lanes; out: filtered texels. One function a
 * storage, so that nothing is decided per texel. */
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

/* P(m) = (m - 1) (1 + (2 - m) Q(m)), Q of degree 3 through Chebyshev nodes of [1, 2]: 4.9e-5 from log2(m). */
void LOM_WIDE(lom_lod_lanes)(const lom_texture *texture, const lom_float derivative[4], lom_float *lod)
{
    float width = (float)texture->level[0].width, height = (float)texture->level[0].height;
    lom_float sx = derivative[0] * width, tx = derivative[1] * height;
    lom_float sy = derivative[2] * width, ty = derivative[3] * height;
    lom_float along_x = sx * sx + tx * tx, along_y = sy * sy + ty * ty;
    lom_float low = lom_splat(0x1p-126f), high = lom_splat(0x1.fffffep127f);
    lom_float square = lom_max(lom_clamp(along_x, low, high), lom_clamp(along_y, low, high));
    lom_int bits = lom_as_int(square);
    lom_float exponent = lom_to_float((bits >> 23) - 127);
    lom_float m = lom_as_float((bits & 0x7fffff) | 0x3f800000);
    lom_float q = ((-0.04487395526f * m + 0.2851550624f) * m - 0.7052662739f) * m + 0.9074037454f;
    *lod = (exponent + (m - 1.0f) * (1.0f + (2.0f - m) * q)) * 0.5f;
}
