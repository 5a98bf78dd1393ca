/* Levels of detail over lanes, from how coordinates change from a pixel to the next (lom/texture.h: lom_lod_of). */
#ifndef LOM_IMAGE_LEVEL_OF_DETAIL_H
#define LOM_IMAGE_LEVEL_OF_DETAIL_H

#include "texture.h"

/* Within what has a logarithm; NaN is the least. */
LOM_INLINE lom_float sample_bounded(lom_float square)
{
    return lom_clamp(square, lom_splat(0x1p-126f), lom_splat(0x1.fffffep127f));
}

/* The squares of the changes along x and y, in texels of level 0. */
LOM_INLINE void sample_squares(const lom_texture *texture, const lom_float derivative[4], lom_float *along_x,
                               lom_float *along_y)
{
    float width = texture->row[0].width, height = texture->row[0].height;
    lom_float sx = derivative[0] * width, tx = derivative[1] * height;
    lom_float sy = derivative[2] * width, ty = derivative[3] * height;
    *along_x = sample_bounded(sx * sx + tx * tx);
    *along_y = sample_bounded(sy * sy + ty * ty);
}

/* P(m) = (m - 1) (1 + (2 - m) Q(m)), Q of degree 3 through Chebyshev nodes of [1, 2]: 4.9e-5 from log2(m). */
LOM_INLINE lom_float sample_half_log2(lom_float square)
{
    lom_int bits = lom_as_int(square);
    lom_float exponent = lom_to_float((bits >> 23) - 127);
    lom_float m = lom_as_float((bits & 0x7fffff) | 0x3f800000);
    lom_float q = ((-0.04487395526f * m + 0.2851550624f) * m - 0.7052662739f) * m + 0.9074037454f;
    return (exponent + (m - 1.0f) * (1.0f + (2.0f - m) * q)) * 0.5f;
}

/* lom_lod_of */
LOM_INLINE lom_float sample_lod(const lom_texture *texture, const lom_float derivative[4])
{
    lom_float along_x, along_y;
    sample_squares(texture, derivative, &along_x, &along_y);
    return sample_half_log2(lom_max(along_x, along_y));
}

#endif
