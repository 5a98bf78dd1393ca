/* Colours to bytes that are narrowed (lanes/channels.h): lom_unorm_of_lanes without the clamp at 0 where narrowing is one. */
#ifndef LOM_IMAGE_NARROWED_UNORM_H
#define LOM_IMAGE_NARROWED_UNORM_H

#include "image/convert_lanes.h"
#include "lanes/channels.h"

/* lom_unorm_of_lanes(x, 255), or a number below 0 in place of 0 with LOM_OVERRIDES_CHANNELS: by the same operations
 * (lom_unorm_of_unit_lanes), whose results below 0 are not above 0, and whose product with NaN is NaN. */
LOM_INLINE lom_int lom_narrowed_unorm8_of_lanes(lom_float x)
{
#ifndef LOM_OVERRIDES_CHANNELS
    return lom_unorm_of_lanes(x, 255.0f);
#elif LOM_LANES == 16
    enum { TO_ZERO = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC };
    __m512 p = _mm512_mul_round_ps(_mm512_min_ps(_mm512_set1_ps(1), (__m512)x), _mm512_set1_ps(255), TO_ZERO);
    return to_narrowed((lom_float)_mm512_add_round_ps(p, _mm512_set1_ps(0.5f), TO_ZERO));
#else
    lom_float c = (lom_float)_mm256_min_ps(_mm256_set1_ps(1), (__m256)x);
    lom_int q = to_narrowed(c * 255.0f);
    lom_float a = c * 256.0f - lom_to_float(q);
    return q - (a - 0.5f >= c);
#endif
}

#endif
