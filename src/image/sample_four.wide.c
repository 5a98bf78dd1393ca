/* The four texels of a linear filter, not mixed: gathered, or compared first (lom/texture.h: lom_sample_gather,
 * lom_sample_compare). Level 0 of 2D textures. */
#include "compare_lanes.h"
#include "sample_lanes.h"

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
