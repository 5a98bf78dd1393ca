/* Sampling of plain textures (texture.h): where the lanes look, then the texels there. Where all lanes take one level or
 * the same two, as near large triangles, there are one pitch and one size a level, two pointers for the rows of a square,
 * nothing to ask about filters; lanes of small triangles are apart by one level at most, nearly always.
 *
 * Invariant: bit for bit what sample_fixed.h gives, which takes packets of any levels. */
#ifndef LOM_IMAGE_SAMPLE_PLAIN_H
#define LOM_IMAGE_SAMPLE_PLAIN_H

#include "sample_fixed.h"

/* Records want the notes of the general functions, and widths that are lowered are to be small. */
#if defined LOM_RECORD || defined LOM_LOWERED
enum { SAMPLE_PLAINLY = false };
#else
enum { SAMPLE_PLAINLY = true };
#endif

/* Where lanes look in a level: the first texels of their squares, counted from texel `from` on, those below, and the
 * weights of the second column and row. The largest float below 1 is the same weight as 1 - 2^-23. */
typedef struct sample_window {
    size_t from, pitch; /* one pitch for all lanes, or an index of their own for what is below */
    lom_int index, below;
    lom_pairs right, down;
} sample_window;

/* Where they look in a texture: in the first window or, where it mixes, between both. Lanes that are apart take one of two
 * neighbouring levels each, and so in the second window. */
typedef struct sample_spot {
    bool apart, mixes;
    sample_window window[2];
    lom_pairs part; /* of the second window */
} sample_spot;

LOM_INLINE lom_int sample_look(sample_window *to, lom_float s, lom_float t, lom_float width, lom_float height,
                               lom_int pitch)
{
    lom_float x = s * width + 0.5f, y = t * height + 0.5f;
    lom_int column = lom_bounded_to_int(x), line = lom_bounded_to_int(y);
    to->right = lom_weight_pairs(x - lom_to_float(column));
    to->down = lom_weight_pairs(y - lom_to_float(line));
    return line * pitch + column;
}

LOM_INLINE void sample_look_at_level(sample_window *to, const lom_level_row *row, lom_float s, lom_float t)
{
    to->index = sample_look(to, s, t, lom_splat(row->width), lom_splat(row->height), lom_splat_int(row->pitch));
    to->from = (size_t)row->offset;
    to->pitch = (size_t)row->pitch;
}

LOM_INLINE void sample_look_at_levels(sample_window *to, const lom_level_row *row, const lom_level_row *next,
                                      lom_mask upper, lom_float s, lom_float t)
{
    lom_float width = lom_select(upper, lom_splat(next->width), lom_splat(row->width));
    lom_float height = lom_select(upper, lom_splat(next->height), lom_splat(row->height));
    lom_int pitch = lom_select_int(upper, lom_splat_int(next->pitch), lom_splat_int(row->pitch));
    lom_int offset = lom_select_int(upper, lom_splat_int(next->offset), lom_splat_int(row->offset));
    to->index = sample_look(to, s, t, width, height, pitch) + offset;
    to->below = to->index + pitch;
}

/* Whether any lane takes a level beyond the first, or part of it; NaN takes the least. */
LOM_INLINE bool sample_is_minified(const lom_texture *texture, const lom_float *lod)
{
    return texture->level_min > 0 || lom_any_positive(*lod + texture->sampler.lod_bias);
}

/* False, and nothing is found, when the lanes take levels that are no neighbours. */
LOM_INLINE bool sample_find_spot(const lom_texture *texture, const lom_float2 *at, const lom_float *lod,
                                 sample_spot *spot)
{
    int last = texture->level_count - 1, first = 0;
    lom_mask upper = { 0 };
    spot->apart = spot->mixes = false;
    if (last > 0 && sample_is_minified(texture, lod)) {
        const lom_float chosen = sample_choose_plainly(texture, lod);
        lom_int level = lom_bounded_to_int(chosen);
        const lom_float fraction = chosen - lom_to_float(level);
        spot->mixes = lom_any_positive(fraction);
        spot->part = lom_weight_pairs(fraction);
        first = level[0];
        spot->apart = !lom_all_equal(level, first);
        first = sample_foreseen_level(first - (spot->apart && lom_any(level < first)));
        if (spot->apart) {
            upper = level == first + 1;
            if (!lom_all(upper | (level == first)))
                return false;
        }
    }
    const lom_level_row *row = &texture->row[first], *next = row + (first < last), *second = next + (first + 1 < last);
    lom_float s = sample_wrap(at->x, texture->sampler.wrap_s), t = sample_wrap(at->y, texture->sampler.wrap_t);
    if (spot->apart) {
        sample_look_at_levels(&spot->window[0], row, next, upper, s, t);
        if (spot->mixes)
            sample_look_at_levels(&spot->window[1], next, second, upper, s, t);
    } else {
        sample_look_at_level(&spot->window[0], row, s, t);
        if (spot->mixes)
            sample_look_at_level(&spot->window[1], next, s, t);
    }
    return true;
}

/* sample_level_pairs. */
LOM_INLINE sample_pairs sample_in_window(const lom_texture *texture, lom_storage storage, bool srgb, bool apart,
                                         const sample_window *w)
{
    sample_pairs upper = sample_mix_two(texture, apart ? 0 : w->from, storage, srgb, w->index, w->right);
    sample_pairs lower =
        sample_mix_two(texture, apart ? 0 : w->from + w->pitch, storage, srgb, apart ? w->below : w->index, w->right);
    return sample_mix_pairs(upper, lower, w->down);
}

LOM_INLINE lom_float4 sample_at_windows(const lom_texture *texture, lom_storage storage, bool srgb, bool apart,
                                        const sample_spot *spot)
{
    sample_pairs value = sample_in_window(texture, storage, srgb, apart, &spot->window[0]);
    if (spot->mixes)
        value = sample_mix_pairs(value, sample_in_window(texture, storage, srgb, apart, &spot->window[1]), spot->part);
    return sample_finish_pairs(srgb, value);
}

LOM_INLINE lom_float4 sample_at_spot(const lom_texture *texture, lom_storage storage, bool srgb,
                                     const sample_spot *spot)
{
    return spot->apart ? sample_at_windows(texture, storage, srgb, true, spot)
                       : sample_at_windows(texture, storage, srgb, false, spot);
}

#endif
