/* Sampling over lanes: wrapped coordinates -> footprint (one index a sample and weights) -> filtered texels. Everything
 * is inline and takes the kind and storage as constants, so that each sampler of sample_*.wide.c is one straight
 * function. lom/texture.h defines what is computed; the apron of texture.h makes it one index for every wrap mode.
 *
 * Range: mix(a, b, f) = a + (b - a) f never leaves [a, b] for 0 <= f <= 1 - 2^-23: with u = 2^-24 each rounding is a
 * factor of at most 1 + u, and (1 + u)^2 (1 - 2u) < 1, so the rounded product is not larger than |b - a|, the exact sum
 * lies in [a, b], and rounding it is monotone. f = 0 gives a, and a = b gives a. */
#ifndef LOM_IMAGE_SAMPLE_LANES_H
#define LOM_IMAGE_SAMPLE_LANES_H

#include "convert_lanes.h"
#include "lanes/decisions.h"
#include "lanes/gathers.h"
#include "lanes/notes.h"
#include "texture.h"

#define SAMPLE_LARGEST_WEIGHT 0x1.fffffcp-1f /* 1 - 2^-23 */

/* Where the lanes' levels lie. offset: of texel (-1, -1) of slice 0, in 3D of slice -1. */
typedef struct sample_place {
    lom_float width, height, depth;
    lom_int pitch, slice, offset;
} sample_place;

/* What to sample: wrapped coordinates, the face of a cube or the layer of an array, and which lanes take the nearest
 * texel. */
typedef struct sample_point {
    lom_float s, t, r;
    lom_int face;
    bool some_nearest, all_nearest;
    lom_mask nearest;
} sample_point;

typedef struct sample_footprint {
    lom_int index, pitch, slice;
    lom_float s, t, r; /* weights of the second texel of each axis */
} sample_footprint;

/* ---- coordinates ---- */

/* A coordinate wrapped to what lom/texture.h calls c; a border coordinate stays as it is (bounded in texels later). */
LOM_INLINE lom_float sample_wrap(lom_float s, lom_wrap wrap)
{
    switch (wrap) {
    case LOM_WRAP_REPEAT:
        return lom_repeated(s); /* which would round to 1 for s in (-2^-25, 0), and be NaN for infinities */
    case LOM_WRAP_MIRROR: {
        lom_float half = lom_abs(s) * 0.5f;
        lom_float c = (half - lom_floor(half)) * 2.0f; /* in [0, 2), exact */
        return lom_max(lom_min(c, 2.0f - c), (lom_float){ 0 });
    }
    case LOM_WRAP_CLAMP:
        return lom_saturate(s);
    default:
        return lom_select(s == s, s, (lom_float){ 0 });
    }
}

/* The number k of the first texel plus one, and the weight of the second, of a place in texels, half a texel further. */
LOM_INLINE lom_int sample_split(lom_float x, lom_float *weight)
{
    lom_int k = lom_bounded_to_int(x);
    *weight = lom_min(x - lom_to_float(k), lom_splat(SAMPLE_LARGEST_WEIGHT));
    return k;
}

/* The same of c in [0, 1], with a border any number. */
LOM_INLINE lom_int sample_locate(lom_float c, lom_float size, bool border, const sample_point *point, lom_float *weight)
{
    lom_float x = c * size + 0.5f;
    if (border)
        x = lom_clamp(x, (lom_float){ 0 }, size + 1.0f);
    if (point->some_nearest) {
        lom_float low = lom_splat(border ? -1.0f : 0.0f), high = border ? size : size - 1.0f;
        lom_float texel = lom_clamp(lom_floor(c * size), low, high);
        x = lom_select(point->nearest, texel + 1.0f, x);
    }
    return sample_split(x, weight);
}

/* ---- levels ---- */

LOM_INLINE sample_place sample_place_of_level(const lom_texture *texture, int level)
{
    const lom_level *l = &texture->level[level];
    return (sample_place){
        lom_splat((float)l->width),       lom_splat((float)l->height),      lom_splat((float)l->depth),
        lom_splat_int((int32_t)l->pitch), lom_splat_int((int32_t)l->slice), lom_splat_int(texture->row[level].offset),
    };
}

/* The level, counted up to. What waits for a number waits for the level of detail, the longest chain of operations of a
 * sample; branches are foreseen, so that places are found and texels loaded before it is known. The empty statement
 * keeps the compiler from seeing through the sum. */
LOM_INLINE int sample_foreseen_level(int level)
{
    int counted = 0;
    while (counted < level) {
        counted++;
        __asm__ volatile("" : "+r"(counted));
    }
    return counted;
}

LOM_INLINE sample_place sample_place_of_levels(const lom_texture *texture, lom_int level)
{
    enum { ROW_WORDS = sizeof(lom_level_row) / sizeof(float) };
    if (lom_all_equal(level, level[0]))
        return sample_place_of_level(texture, sample_foreseen_level(level[0]));
    lom_float4 row = lom_gather_rows(&texture->row[0].width, level * ROW_WORDS);
    lom_int depth = lom_max_int(lom_splat_int(texture->level[0].depth) >> level, lom_splat_int(1));
    lom_int pitch = lom_as_int(row.z), slice = pitch * (lom_bounded_to_int(row.y) + 2);
    return (sample_place){ row.x, row.y, lom_to_float(depth), pitch, slice, lom_as_int(row.w) };
}

LOM_INLINE sample_footprint sample_footprint_of(const lom_texture *texture, lom_texture_kind kind,
                                                const sample_point *point, const sample_place *place)
{
    const lom_sampler_desc *sampler = &texture->sampler;
    bool flat = kind != LOM_TEXTURE_CUBE;
    sample_footprint print;
    print.pitch = place->pitch;
    print.slice = place->slice;
    lom_int x = sample_locate(point->s, place->width, flat && sampler->wrap_s == LOM_WRAP_BORDER, point, &print.s);
    lom_int y = sample_locate(point->t, place->height, flat && sampler->wrap_t == LOM_WRAP_BORDER, point, &print.t);
    print.index = place->offset + y * place->pitch + x;
    if (kind == LOM_TEXTURE_CUBE || kind == LOM_TEXTURE_2D_ARRAY)
        print.index += point->face * place->slice;
    if (kind == LOM_TEXTURE_3D)
        print.index +=
            sample_locate(point->r, place->depth, sampler->wrap_r == LOM_WRAP_BORDER, point, &print.r) * place->slice;
    LOM_NOTE(LOM_NOTE_FOOTPRINT, texture, lom_as_float(print.index), print.s, print.t,
             kind == LOM_TEXTURE_3D ? print.r : (lom_float){ 0 });
    return print;
}

/* ---- texels ---- */

/* Channels as they are filtered: RGBA8 as r, 256 g, 65536 b, a (a mask and no shift; the power of two is divided out at
 * the end, exactly), sRGB as linear light with a in 0..255 (RGBA8: by table; RGBA32F: texture->decoded), floats as they
 * are. */
LOM_INLINE lom_float4 sample_unpack(bool srgb, lom_int texel)
{
    lom_float alpha = lom_to_float((lom_int)((lom_uint)texel >> 24));
    if (srgb)
        return (lom_float4){ lom_float_of_srgb8_lanes(texel & 255), lom_float_of_srgb8_lanes(texel >> 8 & 255),
                             lom_float_of_srgb8_lanes(texel >> 16 & 255), alpha };
    return (lom_float4){ lom_to_float(texel & 0xff), lom_to_float(texel & 0xff00), lom_to_float(texel & 0xff0000),
                         alpha };
}

LOM_INLINE lom_float4 sample_texel(const lom_texture *texture, lom_storage storage, bool srgb, lom_int index)
{
    if (storage == LOM_STORAGE_R32F)
        return (lom_float4){ .x = lom_gather(texture->texels, index) };
    if (storage == LOM_STORAGE_RGBA32F) {
        const float *base = srgb ? texture->decoded : texture->texels, *rows[LOM_LANES];
        for (int i = 0; i < LOM_LANES; i++)
            rows[i] = base + (size_t)(uint32_t)index[i] * 4;
        return lom_load_rows(rows, 0);
    }
    return sample_unpack(srgb, lom_gather_int(texture->texels, index));
}

LOM_INLINE lom_float4 sample_mix(lom_storage storage, lom_float4 a, lom_float4 b, lom_float t)
{
    if (storage == LOM_STORAGE_R32F)
        return (lom_float4){ .x = lom_mix(a.x, b.x, t) };
    return (lom_float4){ lom_mix(a.x, b.x, t), lom_mix(a.y, b.y, t), lom_mix(a.z, b.z, t), lom_mix(a.w, b.w, t) };
}

/* Texels index and index + 1. */
LOM_INLINE void sample_pair(const lom_texture *texture, lom_storage storage, bool srgb, lom_int index,
                            lom_float4 *first, lom_float4 *second)
{
    if (storage == LOM_STORAGE_RGBA32F) {
        *first = sample_texel(texture, storage, srgb, index);
        *second = sample_texel(texture, storage, srgb, index + 1);
        return;
    }
    lom_int a, b;
    lom_gather_pairs_by(texture->gathers, texture->texels, index, &a, &b);
    *first = storage == LOM_STORAGE_R32F ? (lom_float4){ .x = lom_as_float(a) } : sample_unpack(srgb, a);
    *second = storage == LOM_STORAGE_R32F ? (lom_float4){ .x = lom_as_float(b) } : sample_unpack(srgb, b);
}

LOM_INLINE lom_float4 sample_square(const lom_texture *texture, lom_storage storage, bool srgb, lom_int index,
                                    const sample_footprint *print)
{
    lom_int below = index + print->pitch;
    lom_float4 a, b, c, d;
    sample_pair(texture, storage, srgb, index, &a, &b);
    sample_pair(texture, storage, srgb, below, &c, &d);
    return sample_mix(storage, sample_mix(storage, a, b, print->s), sample_mix(storage, c, d, print->s), print->t);
}

/* The same as a function of its own, of storages chosen while it runs: 3D textures and arrays call it up to four times a
 * sample, and written out for each they would be 150 kB more of the program (bench/results/limits.md). */
__attribute__((noinline, unused)) static void sample_square_apart(const lom_texture *texture, lom_storage storage,
                                                                  bool srgb, const lom_int *index,
                                                                  const sample_footprint *print, lom_float4 *out)
{
    if (storage == LOM_STORAGE_R32F)
        *out = sample_square(texture, LOM_STORAGE_R32F, false, *index, print);
    else if (storage == LOM_STORAGE_RGBA32F)
        *out = srgb ? sample_square(texture, LOM_STORAGE_RGBA32F, true, *index, print)
                    : sample_square(texture, LOM_STORAGE_RGBA32F, false, *index, print);
    else
        *out = srgb ? sample_square(texture, LOM_STORAGE_RGBA8, true, *index, print)
                    : sample_square(texture, LOM_STORAGE_RGBA8, false, *index, print);
}

LOM_INLINE lom_float4 sample_level(const lom_texture *texture, lom_texture_kind kind, lom_storage storage, bool srgb,
                                   const sample_point *point, const sample_place *place)
{
    sample_footprint print = sample_footprint_of(texture, kind, point, place);
    if (point->all_nearest)
        return sample_texel(texture, storage, srgb, print.index);
    if (kind != LOM_TEXTURE_3D && kind != LOM_TEXTURE_2D_ARRAY)
        return sample_square(texture, storage, srgb, print.index, &print);
    lom_float4 front, back;
    lom_int behind = print.index + print.slice;
    sample_square_apart(texture, storage, srgb, &print.index, &print, &front);
    if (kind == LOM_TEXTURE_2D_ARRAY)
        return front;
    sample_square_apart(texture, storage, srgb, &behind, &print, &back);
    return sample_mix(storage, front, back, print.r);
}

/* From filtered numbers to values; adding 0 makes -0 positive, whichever of a texel and a mixture of it came out. */
LOM_INLINE lom_float4 sample_finish(lom_storage storage, bool srgb, lom_float4 x)
{
    if (storage == LOM_STORAGE_R32F)
        return (lom_float4){ x.x + 0.0f, (lom_float){ 0 }, (lom_float){ 0 }, lom_splat(1.0f) };
    if (srgb)
        return (lom_float4){ x.x, x.y, x.z, x.w / 255.0f };
    if (storage == LOM_STORAGE_RGBA32F)
        return (lom_float4){ x.x + 0.0f, x.y + 0.0f, x.z + 0.0f, x.w + 0.0f };
    return (lom_float4){ x.x / 255.0f, x.y / (255.0f * 256.0f), x.z / (255.0f * 65536.0f), x.w / 255.0f };
}

/* ---- the whole ---- */

/* Which of the lanes' texels and levels: fills the nearest flags of point; lod comes back as a level, 0 where
 * magnified, at most the last. */
LOM_INLINE lom_float sample_choose(const lom_texture *texture, sample_point *point, lom_float lod)
{
    lom_float bounded =
        lom_clamp(lod + texture->sampler.lod_bias, lom_splat(texture->lod_min), lom_splat(texture->lod_max));
    lom_mask minified = bounded > 0.0f;
    const bool *within = texture->nearest_within;
    point->some_nearest = within[0] || within[1];
    point->all_nearest = within[0] && within[1];
    point->nearest = lom_select_int(minified, lom_splat_int(-within[1]), lom_splat_int(-within[0]));
    lom_float last = lom_splat((float)(texture->level_count - 1));
    if (texture->nearest_between)
        bounded = lom_ceil(bounded + 0.5f) - 1.0f;
    else if (!texture->linear_between)
        return (lom_float){ 0 };
    return lom_select(minified, lom_min(bounded, last), (lom_float){ 0 });
}

/* The same of a plain texture (texture.h) of several levels, whose lanes all take the square of texels. */
LOM_INLINE lom_float sample_choose_plainly(const lom_texture *texture, const lom_float *lod)
{
    return lom_clamp(*lod + texture->sampler.lod_bias, lom_splat(texture->level_min), lom_splat(texture->level_max));
}

/* For records: where a sampler looks, and which levels it chose. */
#define SAMPLE_NOTE(texture, kind, point, lod, chosen)                                                                 \
    LOM_NOTE(LOM_NOTE_LOOKUP, texture, point->s, point->t, kind == LOM_TEXTURE_3D ? point->r : (lom_float){ 0 }, lod,  \
             chosen,                                                                                                   \
             kind == LOM_TEXTURE_CUBE || kind == LOM_TEXTURE_2D_ARRAY ? lom_as_float(point->face) : (lom_float){ 0 })

/* A lane of one level takes nothing of a next one: none of a float that is infinite would be no number, and -0 would be 0. */
LOM_INLINE lom_float4 sample_mix_next(lom_storage storage, lom_float4 value, lom_float4 next, lom_float fraction)
{
    const lom_float4 mixed = sample_mix(storage, value, next, fraction);
    const lom_mask some = fraction > 0.0f;
    if (storage == LOM_STORAGE_RGBA8)
        return mixed;
    return (lom_float4){ lom_select(some, mixed.x, value.x), lom_select(some, mixed.y, value.y),
                         lom_select(some, mixed.z, value.z), lom_select(some, mixed.w, value.w) };
}

LOM_INLINE lom_float4 sample_texture(const lom_texture *texture, lom_texture_kind kind, lom_storage storage, bool srgb,
                                     sample_point *point, lom_float lod)
{
    lom_float chosen = sample_choose(texture, point, lod);
    lom_int level = lom_bounded_to_int(chosen);
    lom_float fraction = lom_min(chosen - lom_to_float(level), lom_splat(SAMPLE_LARGEST_WEIGHT));
    SAMPLE_NOTE(texture, kind, point, lod, chosen);
    sample_place place = sample_place_of_levels(texture, level);
    lom_float4 value = sample_level(texture, kind, storage, srgb, point, &place);
    if (lom_any_positive(fraction)) {
        place = sample_place_of_levels(texture, lom_min_int(level + 1, lom_splat_int(texture->level_count - 1)));
        lom_float4 next = sample_level(texture, kind, storage, srgb, point, &place);
        value = sample_mix_next(storage, value, next, fraction);
    }
    return sample_finish(storage, srgb, value);
}

#endif
