/* Rows of linear light to 8-bit codes, LOM_LANES pixels at a time. In: four floats a pixel. Out: a word a pixel, red in its
 * lowest byte. Invariant: a code is that of lom_tone_of and then of convert.h, whatever the light. */
#include "image/convert_lanes.h"
#include "render/tone.h"

#include <lom/lanes_mathematics.h>

/* The least float that is not below x > 0. */
static float least_above(double x)
{
    const float near = (float)x;
    return (double)near < x ? lom_float_of_bits(lom_bits_of_float(near) + 1) : near;
}

/* lom_tone_of: the curve in double, rounded once. Its tests are made of floats, as which they come out the same: rounding
 * takes nothing across 1, and `white` is the least float from white on. */
LOM_INLINE lom_float tone_of(const struct lom_tone *t, float white, lom_float light)
{
    const lom_float lit = light * t->scale, one = lom_splat(1.0f);
    if (!t->is_curved)
        return lit;
    const lom_double x = lom_widen(lit);
    const lom_double above = x * (lom_splat_double(t->a) * x + lom_splat_double(t->b));
    const lom_double below = x * (lom_splat_double(t->c) * x + lom_splat_double(t->d)) + lom_splat_double(t->e);
    const lom_float y = lom_narrow(above / below);
    const lom_float toned = lom_select((y < 1.0f) & (lit < white), y, one);
    return lom_select(lit > 0.0f, toned, (lom_float){ 0 });
}

LOM_INLINE lom_int code_of(const struct lom_tone *t, float white, bool srgb, lom_float light)
{
    const lom_float toned = tone_of(t, white, light);
    return srgb ? lom_srgb8_of_lanes(toned) : lom_unorm_of_lanes(toned, 255.0f);
}

LOM_INLINE void encode(const struct lom_tone *t, bool srgb, const float *light, size_t count, uint32_t *texels)
{
    const lom_int at = lom_lane_index() * 4;
    const float white = least_above(t->white);
    for (size_t i = 0; i < count; i += LOM_LANES) {
        const lom_float4 pixels = lom_gather_rows(light + 4 * i, at);
        const lom_int red = code_of(t, white, srgb, pixels.x), green = code_of(t, white, srgb, pixels.y);
        lom_store_int((int32_t *)texels + i, red | green << 8 | code_of(t, white, srgb, pixels.z) << 16);
    }
}

void LOM_WIDE(lom_encode_light)(const struct lom_tone *tone, bool srgb, const float *light, size_t count,
                                uint32_t *texels)
{
    if (srgb)
        encode(tone, true, light, count, texels);
    else
        encode(tone, false, light, count, texels);
}
