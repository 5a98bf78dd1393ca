/* Sampling of plain textures (texture.h), where all lanes take one level or the same two, as near large triangles: one
 * pitch and one size a level, two pointers for the rows of a square, nothing to ask about filters.
 *
 * Invariant: bit for bit what sample_fixed.h gives, which takes packets of several levels. */
#ifndef LOM_IMAGE_SAMPLE_PLAIN_H
#define LOM_IMAGE_SAMPLE_PLAIN_H

#include "sample_fixed.h"

/* Records want the notes of the general functions, and widths that are lowered are to be small. */
#if defined LOM_RECORD || defined LOM_LOWERED
enum { SAMPLE_PLAINLY = false };
#else
enum { SAMPLE_PLAINLY = true };
#endif

/* sample_level_pairs. The largest float below 1 is the same weight as 1 - 2^-23. */
LOM_INLINE sample_pairs sample_plain_level(const lom_texture *texture, lom_storage storage, bool srgb, lom_float s,
                                           lom_float t, int level)
{
    const lom_level_row *row = &texture->row[level];
    lom_float x = s * row->width + 0.5f, y = t * row->height + 0.5f;
    lom_int column = lom_bounded_to_int(x), line = lom_bounded_to_int(y);
    lom_pairs right = lom_weight_pairs(x - lom_to_float(column)), down = lom_weight_pairs(y - lom_to_float(line));
    lom_int index = line * row->pitch + column;
    size_t from = (size_t)row->offset;
    sample_pairs a, b, c, d;
    sample_two_pairs(texture, from, storage, srgb, index, &a, &b);
    sample_two_pairs(texture, from + (size_t)row->pitch, storage, srgb, index, &c, &d);
    return sample_mix_pairs(sample_mix_pairs(a, b, right), sample_mix_pairs(c, d, right), down);
}

/* False, and nothing is done, when the lanes take different levels. */
LOM_INLINE bool sample_plain(const lom_texture *texture, lom_storage storage, bool srgb, const lom_float2 *at,
                             const lom_float *lod, lom_float4 *out)
{
    int last = texture->level_count - 1, first = 0;
    lom_float fraction = { 0 };
    if (last > 0) {
        const lom_float chosen = sample_choose_plainly(texture, lod);
        lom_int level = lom_bounded_to_int(chosen);
        first = sample_foreseen_level(level[0]);
        if (!lom_all(level == first))
            return false;
        fraction = chosen - lom_to_float(level);
    }
    lom_float s = sample_wrap(at->x, texture->sampler.wrap_s), t = sample_wrap(at->y, texture->sampler.wrap_t);
    sample_pairs value = sample_plain_level(texture, storage, srgb, s, t, first);
    if (last > 0 && lom_any(fraction > 0.0f)) {
        sample_pairs next = sample_plain_level(texture, storage, srgb, s, t, first < last ? first + 1 : last);
        value = sample_mix_pairs(value, next, lom_weight_pairs(fraction));
    }
    *out = sample_finish_pairs(srgb, value);
    return true;
}

#endif
