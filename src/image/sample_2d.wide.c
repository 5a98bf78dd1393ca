/* Samplers of 2D textures, the texels that they mix, and the level of detail. In: coordinates over lanes; out: texels. One
 * function a storage, so that nothing is decided per texel. */
#include "compare_lanes.h"
#include "level_of_detail.h"
#include "nearest_depth.h"
#include "sample_alike.h"
#include "sample_plain.h"
#include "sample_rows.h"

LOM_INLINE lom_float4 sample_as(bool fixed, lom_storage storage, bool srgb, const lom_texture *texture,
                                const lom_float2 *at, lom_float lod)
{
    sample_point point;
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    return sample_by(fixed, texture, LOM_TEXTURE_2D, storage, srgb, &point, lod);
}

SAMPLE_EVERY_STORAGE(static void sample_generally, lom_float2, sample_as)

#define SAMPLE_PLAIN(function, storage, srgb)                                                                          \
    static void function(const lom_texture *texture, const lom_float2 *at, const lom_float *lod, lom_float4 *out)      \
    {                                                                                                                  \
        sample_spot spot;                                                                                              \
        if (sample_find_spot(texture, at, lod, &spot))                                                                 \
            *out = sample_at_spot(texture, storage, srgb, &spot);                                                      \
        else                                                                                                           \
            sample_generally(texture, at, lod, out);                                                                   \
    }
SAMPLE_PLAIN(plain_rgba8, LOM_STORAGE_RGBA8, false)
SAMPLE_PLAIN(plain_srgb8, LOM_STORAGE_RGBA8, true)
SAMPLE_PLAIN(plain_decoded, LOM_STORAGE_RGBA32F, true)

static void plain_rgba32f(const lom_texture *texture, const lom_float2 *at, const lom_float *lod, lom_float4 *out)
{
    sample_rows(&texture, 1, at, lod, out);
}

void LOM_WIDE(lom_sample_lanes)(const lom_texture *texture, const lom_float2 *at, const lom_float *lod, lom_float4 *out)
{
    bool decoded = texture->decoded != NULL, plain = texture->plain && SAMPLE_PLAINLY;
    (!plain                                    ? sample_generally
     : texture->storage == LOM_STORAGE_RGBA32F ? plain_rgba32f
     : decoded                                 ? plain_decoded
     : texture->srgb                           ? plain_srgb8
                                               : plain_rgba8)(texture, at, lod, out);
}

void LOM_WIDE(lom_sample_three_lanes)(const lom_texture *const texture[3], const lom_float2 *at, const lom_float *lod,
                                      lom_float4 out[3])
{
    if (SAMPLE_PLAINLY && texture[0]->storage == LOM_STORAGE_RGBA32F && sample_are_alike(texture[0], texture[1]) &&
        sample_are_alike(texture[0], texture[2])) {
        sample_rows(texture, 3, at, lod, out);
        return;
    }
    for (int i = 0; i < 3; i++)
        LOM_WIDE(lom_sample_lanes)(texture[i], at, lod, &out[i]);
}

void LOM_WIDE(lom_sample_depth_lanes)(const lom_texture *texture, const lom_float2 *at, lom_float *out)
{
    lom_float4 value;
    lom_float lod = lom_splat(-1000.0f);
    if (SAMPLE_PLAINLY && sample_is_nearest_depth(texture)) {
        *out = sample_nearest_depth(texture, at->x, at->y);
        return;
    }
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
    *lod = sample_lod(texture, derivative);
}

/* ---- the four texels of a linear filter, not mixed ---- */

typedef struct four {
    sample_footprint print;
    lom_float4 texel[4]; /* left above, right above, left below, right below: decoded */
} four;

static lom_float4 decoded_texel(const lom_texture *texture, lom_int index)
{
    switch (texture->storage) {
    case LOM_STORAGE_R32F:
        return sample_finish(LOM_STORAGE_R32F, false, sample_texel(texture, LOM_STORAGE_R32F, false, index));
    case LOM_STORAGE_RGBA32F:
        return sample_finish(LOM_STORAGE_RGBA32F, false, sample_texel(texture, LOM_STORAGE_RGBA32F, false, index));
    default:
        if (texture->srgb)
            return sample_finish(LOM_STORAGE_RGBA8, true, sample_texel(texture, LOM_STORAGE_RGBA8, true, index));
        return sample_finish(LOM_STORAGE_RGBA8, false, sample_texel(texture, LOM_STORAGE_RGBA8, false, index));
    }
}

/* From a texel to the next of an axis: none where both lie beyond the border, of which there is one texel. */
static lom_int step_of(lom_float c, lom_float size, lom_wrap wrap)
{
    lom_float x = c * size + 0.5f;
    lom_mask beyond = (x < 0.0f) | (x >= size + 1.0f);
    return wrap == LOM_WRAP_BORDER ? beyond + 1 : lom_splat_int(1); /* a mask is -1 */
}

__attribute__((noinline)) static void find_four(const lom_texture *texture, const lom_float2 *at, bool nearest,
                                                four *found)
{
    sample_point point = { .some_nearest = nearest, .all_nearest = nearest, .nearest = lom_splat_int(-nearest) };
    point.s = sample_wrap(at->x, texture->sampler.wrap_s);
    point.t = sample_wrap(at->y, texture->sampler.wrap_t);
    sample_place place = sample_place_of_level(texture, 0);
    SAMPLE_NOTE(texture, LOM_TEXTURE_2D, (&point), (lom_float){ 0 }, (lom_float){ 0 });
    found->print = sample_footprint_of(texture, LOM_TEXTURE_2D, &point, &place);
    lom_int right = step_of(point.s, place.width, texture->sampler.wrap_s);
    lom_int below = step_of(point.t, place.height, texture->sampler.wrap_t) * place.pitch;
    for (int i = 0; i < 4; i++)
        found->texel[i] = decoded_texel(texture, found->print.index + (i & 1) * right + (i >> 1) * below);
}

static lom_float channel_of(const lom_float4 *texel, int channel)
{
    return channel == 0 ? texel->x : channel == 1 ? texel->y : channel == 2 ? texel->z : texel->w;
}

void LOM_WIDE(lom_sample_gather_lanes)(const lom_texture *texture, const lom_float2 *at, int channel, lom_float4 *out)
{
    four found;
    find_four(texture, at, false, &found);
    channel = channel > 0 && channel < 4 ? channel : 0;
    *out = (lom_float4){ channel_of(&found.texel[2], channel), channel_of(&found.texel[3], channel),
                         channel_of(&found.texel[1], channel), channel_of(&found.texel[0], channel) };
    LOM_NOTE(LOM_NOTE_RESULT, texture, out->x, out->y, out->z, out->w);
}

void LOM_WIDE(lom_sample_compare_lanes)(const lom_texture *texture, const lom_float2 *at, const lom_float *reference,
                                        lom_compare compare, lom_float *out)
{
    bool nearest = texture->nearest_within[0];
    four found;
    find_four(texture, at, nearest, &found);
    lom_float share[4];
    for (int i = 0; i < 4; i++)
        share[i] =
            lom_select(lom_compare_depth(compare, *reference, found.texel[i].x), lom_splat(1.0f), (lom_float){ 0 });
    *out = nearest ? share[0]
                   : lom_mix(lom_mix(share[0], share[1], found.print.s), lom_mix(share[2], share[3], found.print.s),
                             found.print.t);
    LOM_NOTE(LOM_NOTE_RESULT, texture, *out, (lom_float){ 0 }, (lom_float){ 0 }, (lom_float){ 0 });
}
