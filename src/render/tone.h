/* Exposure and tone curves: from the linear light that was drawn to the light of the picture. */
#ifndef LOM_RENDER_TONE_H
#define LOM_RENDER_TONE_H

#include <lom/lanes.h>
#include <lom/scene.h>

/* x = light * scale; without a curve that is the result. A curve is 0 up to 0 (and of NaN), 1 from `white` on, and
 * between them x (a x + b) / (x (c x + d) + e), at most 1: tone.c says whose. */
struct lom_tone {
    bool is_curved;
    float scale;
    double white, a, b, c, d, e;
};

/* Whether the scene asks for more than to be cut off at 1. */
bool lom_is_toned(const lom_output *output);
struct lom_tone lom_make_tone(const lom_output *output);
/* Of one of red, green and blue; rises with it. */
float lom_tone_of(const struct lom_tone *tone, float light);
/* The codes of `count` pixels of four floats, red in the lowest byte; count is a multiple of LOM_LANES (tone.wide.c). */
void LOM_WIDE(lom_encode_light)(const struct lom_tone *tone, bool srgb, const float *light, size_t count,
                                uint32_t *texels);

#endif
