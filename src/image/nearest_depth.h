/* The nearest texel of level 0 alone, of a picture of depths that ends at its edges or has a border there: what passes read of
 * the depth that others drew, shadow maps among them. In: coordinates over lanes. Out: depths.
 *
 * Invariant: the general sampler, which defines it, does the same operations among others. */
#ifndef LOM_IMAGE_NEAREST_DEPTH_H
#define LOM_IMAGE_NEAREST_DEPTH_H

#include "sample_lanes.h"

LOM_INLINE bool sample_has_edges(lom_wrap wrap)
{
    return wrap == LOM_WRAP_CLAMP || wrap == LOM_WRAP_BORDER;
}

LOM_INLINE bool sample_is_nearest_depth(const lom_texture *texture)
{
    return texture->storage == LOM_STORAGE_R32F && texture->nearest_within[0] && texture->nearest_within[1] &&
           texture->level_count == 1 && sample_has_edges(texture->sampler.wrap_s) &&
           sample_has_edges(texture->sampler.wrap_t);
}

/* The number of the nearest texel of an axis, plus one. */
LOM_INLINE lom_int sample_nearest_of_axis(lom_float c, lom_float size, lom_wrap wrap)
{
    if (wrap == LOM_WRAP_BORDER)
        return lom_bounded_to_int(lom_clamp(lom_floor(sample_wrap(c, LOM_WRAP_BORDER) * size), lom_splat(-1.0f), size) +
                                  1.0f);
    return lom_bounded_to_int(lom_min(lom_floor(lom_saturate(c) * size), size - 1.0f) + 1.0f);
}

LOM_INLINE lom_float sample_nearest_depth(const lom_texture *texture, lom_float s, lom_float t)
{
    const sample_place place = sample_place_of_level(texture, 0);
    const lom_int column = sample_nearest_of_axis(s, place.width, texture->sampler.wrap_s);
    const lom_int row = sample_nearest_of_axis(t, place.height, texture->sampler.wrap_t);
    return lom_gather(texture->texels, place.offset + row * place.pitch + column) + 0.0f;
}

#endif
