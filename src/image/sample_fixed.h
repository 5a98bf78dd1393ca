/* Sampling in fixed point: the footprints of sample_lanes.h, their texels mixed as lom/fixed.h says. For 8-bit storage;
 * everything is inline and takes the kind and storage as constants. In 15 bits a byte is 128 times itself and linear
 * light l of an sRGB code is round(32767 l). */
#ifndef LOM_IMAGE_SAMPLE_FIXED_H
#define LOM_IMAGE_SAMPLE_FIXED_H

#include "lanes/mix_bytes.h"
#include "sample_lanes.h"

#include <lom/fixed.h>

/* Red and blue, green and alpha. */
typedef struct sample_pairs {
    lom_pairs rb, ga;
} sample_pairs;

LOM_INLINE lom_int sample_linear15(lom_int code)
{
    return lom_bounded_to_int(lom_float_of_srgb8_lanes(code) * LOM_FIXED_LINEAR + 0.5f);
}

LOM_INLINE sample_pairs sample_decode_pairs(lom_int texel)
{
    lom_int red = sample_linear15(texel & 255), green = sample_linear15(texel >> 8 & 255);
    lom_int blue = sample_linear15(texel >> 16 & 255);
    return (sample_pairs){ (lom_pairs)(red | blue << 16), (lom_pairs)(green | (texel >> 1 & 0x7f800000)) };
}

LOM_INLINE sample_pairs sample_mix_pairs(sample_pairs a, sample_pairs b, lom_pairs weight)
{
    return (sample_pairs){ lom_mix_pairs(a.rb, b.rb, weight), lom_mix_pairs(a.ga, b.ga, weight) };
}

/* Texels index and index + 1 after the one numbered `from`, mixed. Decoded ones are two words each: four in a row. */
LOM_INLINE sample_pairs sample_mix_two(const lom_texture *texture, size_t from, lom_storage storage, bool srgb,
                                       lom_int index, lom_pairs weight)
{
    if (storage == LOM_STORAGE_RGBA32F) {
        lom_float4 words = lom_gather_rows((const float *)texture->decoded + 2 * from, index + index);
        return sample_mix_pairs((sample_pairs){ (lom_pairs)words.x, (lom_pairs)words.y },
                                (sample_pairs){ (lom_pairs)words.z, (lom_pairs)words.w }, weight);
    }
    lom_int a, b;
    lom_gather_pairs_by(texture->gathers, (const int32_t *)texture->texels + from, index, &a, &b);
    if (srgb)
        return sample_mix_pairs(sample_decode_pairs(a), sample_decode_pairs(b), weight);
    return (sample_pairs){ lom_mix_even_bytes(a, b, weight), lom_mix_odd_bytes(a, b, weight) };
}

LOM_INLINE sample_pairs sample_square_pairs(const lom_texture *texture, lom_storage storage, bool srgb, lom_int index,
                                            lom_int pitch, lom_pairs s, lom_pairs t)
{
    return sample_mix_pairs(sample_mix_two(texture, 0, storage, srgb, index, s),
                            sample_mix_two(texture, 0, storage, srgb, index + pitch, s), t);
}

/* As sample_square_apart. */
__attribute__((noinline, unused)) static void sample_square_pairs_apart(const lom_texture *texture, lom_storage storage,
                                                                        bool srgb, const lom_int *index,
                                                                        const sample_footprint *print,
                                                                        sample_pairs *out)
{
    lom_pairs s = lom_weight_pairs(print->s), t = lom_weight_pairs(print->t);
    if (storage == LOM_STORAGE_RGBA32F)
        *out = sample_square_pairs(texture, LOM_STORAGE_RGBA32F, true, *index, print->pitch, s, t);
    else
        *out = srgb ? sample_square_pairs(texture, LOM_STORAGE_RGBA8, true, *index, print->pitch, s, t)
                    : sample_square_pairs(texture, LOM_STORAGE_RGBA8, false, *index, print->pitch, s, t);
}

LOM_INLINE sample_pairs sample_level_pairs(const lom_texture *texture, lom_texture_kind kind, lom_storage storage,
                                           bool srgb, const sample_point *point, const sample_place *place)
{
    sample_footprint print = sample_footprint_of(texture, kind, point, place);
    if (kind != LOM_TEXTURE_3D && kind != LOM_TEXTURE_2D_ARRAY)
        return sample_square_pairs(texture, storage, srgb, print.index, print.pitch, lom_weight_pairs(print.s),
                                   lom_weight_pairs(print.t));
    sample_pairs front, back;
    lom_int behind = print.index + print.slice;
    sample_square_pairs_apart(texture, storage, srgb, &print.index, &print, &front);
    if (kind == LOM_TEXTURE_2D_ARRAY)
        return front;
    sample_square_pairs_apart(texture, storage, srgb, &behind, &print, &back);
    return sample_mix_pairs(front, back, lom_weight_pairs(print.r));
}

/* The quotients n / 32640 and n / 32767 of whole numbers up to that, correctly rounded, as n high + n low: n high is
 * exact, high having 9 bits or one. The sum before its rounding is within 2^-38 of the quotient's size, which is never
 * so near to the middle of two floats (tests/image/test_sample_fixed.wide.c has all n). */
LOM_INLINE lom_float sample_share(lom_float n, bool light)
{
    const float high = light ? 0x1p-15f : 0x1.01p-15f, low = light ? 0x1.0002p-30f : 0x1.010102p-31f;
    return n * high + n * low;
}

LOM_INLINE lom_float4 sample_finish_pairs(bool srgb, sample_pairs x)
{
    return (lom_float4){ sample_share(lom_lower_of_pairs(x.rb), srgb), sample_share(lom_lower_of_pairs(x.ga), srgb),
                         sample_share(lom_upper_of_pairs(x.rb), srgb), sample_share(lom_upper_of_pairs(x.ga), false) };
}

LOM_INLINE lom_float4 sample_texture_fixed(const lom_texture *texture, lom_texture_kind kind, lom_storage storage,
                                           bool srgb, sample_point *point, lom_float lod)
{
    lom_float chosen = sample_choose(texture, point, lod);
    lom_int level = lom_bounded_to_int(chosen);
    lom_float fraction = chosen - lom_to_float(level);
    SAMPLE_NOTE(texture, kind, point, lod, chosen);
    sample_place place = sample_place_of_levels(texture, level);
    sample_pairs value = sample_level_pairs(texture, kind, storage, srgb, point, &place);
    if (lom_any_positive(fraction)) {
        place = sample_place_of_levels(texture, lom_min_int(level + 1, lom_splat_int(texture->level_count - 1)));
        sample_pairs next = sample_level_pairs(texture, kind, storage, srgb, point, &place);
        value = sample_mix_pairs(value, next, lom_weight_pairs(fraction));
    }
    return sample_finish_pairs(srgb, value);
}

/* ---- both arithmetics, every storage ---- */

LOM_INLINE lom_float4 sample_by(bool fixed, const lom_texture *texture, lom_texture_kind kind, lom_storage storage,
                                bool srgb, sample_point *point, lom_float lod)
{
    lom_float4 value = fixed ? sample_texture_fixed(texture, kind, storage, srgb, point, lod)
                             : sample_texture(texture, kind, storage, srgb, point, lod);
    LOM_NOTE(LOM_NOTE_RESULT, texture, value.x, value.y, value.z, value.w);
    return value;
}

#define SAMPLE_STORAGE(function, coordinates, sample, fixed, storage, srgb)                                            \
    static void function(const lom_texture *texture, const coordinates *at, lom_float lod, lom_float4 *out)            \
    {                                                                                                                  \
        *out = sample(fixed, storage, srgb, texture, at, lod);                                                         \
    }

/* The sampler `name`, a declarator, of one kind of texture: `sample`(fixed, storage, srgb, texture, at, lod), inline, as
 * one straight function for each way that texels are held and filtered, and the choice between them, once a call. Where
 * nobody waits (widths that are lowered, records) it is one small function that asks while it runs. */
#if defined LOM_LOWERED || defined LOM_RECORD
#define SAMPLE_EVERY_STORAGE(name, coordinates, sample)                                                                \
    name(const lom_texture *texture, const coordinates *at, const lom_float *lod, lom_float4 *out)                     \
    {                                                                                                                  \
        lom_storage storage = texture->decoded != NULL ? LOM_STORAGE_RGBA32F : texture->storage;                       \
        *out = sample(texture->fixed, storage, texture->srgb, texture, at, *lod);                                      \
    }
#else
#define SAMPLE_EVERY_STORAGE(name, coordinates, sample)                                                                \
    SAMPLE_STORAGE(sample_rgba8, coordinates, sample, false, LOM_STORAGE_RGBA8, false)                                 \
    SAMPLE_STORAGE(sample_srgb8, coordinates, sample, false, LOM_STORAGE_RGBA8, true)                                  \
    SAMPLE_STORAGE(sample_decoded, coordinates, sample, false, LOM_STORAGE_RGBA32F, true)                              \
    SAMPLE_STORAGE(sample_r32f, coordinates, sample, false, LOM_STORAGE_R32F, false)                                   \
    SAMPLE_STORAGE(sample_rgba32f, coordinates, sample, false, LOM_STORAGE_RGBA32F, false)                             \
    SAMPLE_STORAGE(fixed_rgba8, coordinates, sample, true, LOM_STORAGE_RGBA8, false)                                   \
    SAMPLE_STORAGE(fixed_srgb8, coordinates, sample, true, LOM_STORAGE_RGBA8, true)                                    \
    SAMPLE_STORAGE(fixed_decoded, coordinates, sample, true, LOM_STORAGE_RGBA32F, true)                                \
    name(const lom_texture *texture, const coordinates *at, const lom_float *lod, lom_float4 *out)                     \
    {                                                                                                                  \
        bool fixed = texture->fixed, decoded = texture->decoded != NULL;                                               \
        switch (texture->storage) {                                                                                    \
        case LOM_STORAGE_RGBA8:                                                                                        \
            (decoded         ? (fixed ? fixed_decoded : sample_decoded)                                                \
             : texture->srgb ? (fixed ? fixed_srgb8 : sample_srgb8)                                                    \
                             : (fixed ? fixed_rgba8 : sample_rgba8))(texture, at, *lod, out);                          \
            break;                                                                                                     \
        case LOM_STORAGE_R32F:                                                                                         \
            sample_r32f(texture, at, *lod, out);                                                                       \
            break;                                                                                                     \
        case LOM_STORAGE_RGBA32F:                                                                                      \
            sample_rgba32f(texture, at, *lod, out);                                                                    \
            break;                                                                                                     \
        }                                                                                                              \
    }
#endif

#endif
