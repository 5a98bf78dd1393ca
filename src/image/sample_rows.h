/* Sampling of plain textures (texture.h) of four floats a texel, one or several of the same levels and wraps at the same
 * place: wraps, levels, places and weights are found once for all. Texels are mixed as they lie, the channels of a lane
 * side by side, and made columns when all mixing is done (lanes/row_pairs.h).
 *
 * Invariant: bit for bit what sample_lanes.h gives of each by itself; each float has the same operations there. */
#ifndef LOM_IMAGE_SAMPLE_ROWS_H
#define LOM_IMAGE_SAMPLE_ROWS_H

#include "lanes/row_pairs.h"
#include "sample_lanes.h"

/* The squares of texels that the lanes mix of a level: where their upper and their lower pairs begin, in floats (a texture
 * has less than 2^31 of them), and the weights of the second texel and of the lower pair. */
typedef struct sample_squares_of_level {
    int32_t upper[LOM_LANES], lower[LOM_LANES];
    lom_float s, t;
} sample_squares_of_level;

LOM_INLINE void sample_find_squares(const lom_texture *texture, lom_float s, lom_float t, lom_int level,
                                    sample_squares_of_level *out)
{
    const sample_place place = sample_place_of_levels(texture, level);
    lom_int column = sample_split(s * place.width + 0.5f, &out->s);
    lom_int line = sample_split(t * place.height + 0.5f, &out->t);
    lom_int index = (place.offset + line * place.pitch + column) * 4;
    lom_store_places(out->upper, index);
    lom_store_places(out->lower, index + place.pitch * 4);
}

/* Rows of texels in four registers for each of three textures, and the weights of each float. */
typedef struct sample_row_registers {
    lom_float s[4], t[4], fraction[4], row[3][4];
} sample_row_registers;

/* Register i of the level's rows; `next`: it is mixed into what the level above gave. */
LOM_INLINE void sample_mix_register(const lom_texture *const texture[], int count,
                                    const sample_squares_of_level *square, int i, bool next, sample_row_registers *r)
{
    for (int k = 0; k < count; k++) {
        lom_float a, b, c, d;
        lom_load_row_pairs(texture[k]->texels, square->upper, i, &a, &b);
        lom_load_row_pairs(texture[k]->texels, square->lower, i, &c, &d);
        lom_float value = lom_mix(lom_mix(a, b, r->s[i]), lom_mix(c, d, r->s[i]), r->t[i]);
        if (next) /* as sample_mix_next */
            value = lom_select(r->fraction[i] > 0.0f, lom_mix(r->row[k][i], value, r->fraction[i]), r->row[k][i]);
        r->row[k][i] = value;
    }
}

/* Written out, since compilers keep a loop of so much, and its registers in memory. */
LOM_INLINE void sample_mix_level(const lom_texture *const texture[], int count, lom_float s, lom_float t, lom_int level,
                                 bool next, sample_row_registers *r)
{
    sample_squares_of_level square;
    sample_find_squares(texture[0], s, t, level, &square);
    lom_spread_to_rows(square.s, r->s);
    lom_spread_to_rows(square.t, r->t);
    sample_mix_register(texture, count, &square, 0, next, r);
    sample_mix_register(texture, count, &square, 1, next, r);
    sample_mix_register(texture, count, &square, 2, next, r);
    sample_mix_register(texture, count, &square, 3, next, r);
}

/* Whether plain textures of one storage have the same levels in the same places, and are looked up alike. The layout of
 * all levels follows from that of the first. */
LOM_INLINE bool sample_are_alike(const lom_texture *a, const lom_texture *b)
{
    const lom_level_row *x = &a->row[0], *y = &b->row[0];
    return a->plain && b->plain && a->storage == b->storage && a->level_count == b->level_count &&
           x->width == y->width && x->height == y->height && x->pitch == y->pitch && x->offset == y->offset &&
           a->sampler.wrap_s == b->sampler.wrap_s && a->sampler.wrap_t == b->sampler.wrap_t &&
           a->sampler.lod_bias == b->sampler.lod_bias && a->lod_min == b->lod_min && a->lod_max == b->lod_max;
}

/* Of `count` textures that are alike, one or three. */
LOM_INLINE void sample_rows(const lom_texture *const texture[], int count, const lom_float2 *at, const lom_float *lod,
                            lom_float4 *out)
{
    const lom_texture *first = texture[0];
    const lom_sampler_desc *sampler = &first->sampler;
    lom_float s = sample_wrap(at->x, sampler->wrap_s), t = sample_wrap(at->y, sampler->wrap_t), fraction = { 0 };
    lom_int level = { 0 };
    if (first->level_count > 1) {
        lom_float chosen = sample_choose_plainly(first, lod);
        level = lom_bounded_to_int(chosen);
        fraction = lom_min(chosen - lom_to_float(level), lom_splat(SAMPLE_LARGEST_WEIGHT));
    }
    sample_row_registers r;
    sample_mix_level(texture, count, s, t, level, false, &r);
    if (lom_any_positive(fraction)) {
        lom_spread_to_rows(fraction, r.fraction);
        level = lom_min_int(level + 1, lom_splat_int(first->level_count - 1));
        sample_mix_level(texture, count, s, t, level, true, &r);
    }
    for (int k = 0; k < count; k++)
        out[k] = sample_finish(LOM_STORAGE_RGBA32F, false, lom_columns_of_rows(r.row[k]));
}

#endif
