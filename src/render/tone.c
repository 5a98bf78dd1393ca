/* Exposure and tone curves. In: output.exposure, curve and white, linear light. Out: linear light that a picture can show.
 * Each curve is a quotient of two polynomials, so one function serves all. Invariant: it rises, from 0 at 0 to at most 1,
 * and has a value for NaN and the infinities; red, green and blue are on their own. */
#include "render/tone.h"

#include <lom/base.h>

bool lom_is_toned(const lom_output *output)
{
    return output->exposure != 0 || output->curve != LOM_CURVE_CLAMP;
}

static double quotient(const struct lom_tone *t, double x)
{
    return x * (t->a * x + t->b) / (x * (t->c * x + t->d) + t->e);
}

/* Reinhard, Stark, Shirley, Ferwerda, Photographic Tone Reproduction for Digital Images, SIGGRAPH 2002, eq. 4, with
 * L_white = white, of each colour: x (1 + x / white^2) / (1 + x). It is 1 at white, and x itself for white = 1. */
static void set_reinhard(struct lom_tone *t)
{
    t->a = 1 / (t->white * t->white);
    t->b = t->d = t->e = 1;
}

/* Hable, Uncharted 2: HDR Lighting, GDC 2010, with the constants that he published after it ("Filmic Tonemapping
 * Operators", filmicworlds.com): h(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F, divided by h(white). On one
 * denominator, D E - D F E / F is 0, so 0 goes to 0 without rounding. */
static void set_filmic(struct lom_tone *t)
{
    static const double A = 0.15, B = 0.50, C = 0.10, D = 0.20, E = 0.02, F = 0.30;
    t->a = A * (1 - E / F);
    t->b = B * (C - E / F);
    t->c = A;
    t->d = B;
    t->e = D * F;
    const double at_white = quotient(t, t->white);
    t->a /= at_white;
    t->b /= at_white;
}

/* Narkowicz, "ACES Filmic Tone Mapping Curve", knarkowicz.wordpress.com, 2016: a fit of the reference and output transform
 * of ACES. It has a white of its own: 1 is passed where 0.08 x^2 - 0.56 x - 0.14 = 0, at 7.242. */
static void set_aces(struct lom_tone *t)
{
    t->a = 2.51;
    t->b = 0.03;
    t->c = 2.43;
    t->d = 0.59;
    t->e = 0.14;
    t->white = 7.25;
}

struct lom_tone lom_make_tone(const lom_output *output)
{
    static void (*const set[])(struct lom_tone *) = {
        [LOM_CURVE_REINHARD] = set_reinhard, [LOM_CURVE_FILMIC] = set_filmic, [LOM_CURVE_ACES] = set_aces
    };
    struct lom_tone tone = { .is_curved = output->curve != LOM_CURVE_CLAMP,
                             .scale = (float)lom_double_exp2(output->exposure),
                             .white = output->white };
    if (tone.is_curved)
        set[output->curve](&tone);
    return tone;
}

float lom_tone_of(const struct lom_tone *tone, float light)
{
    const float x = light * tone->scale;
    if (!tone->is_curved)
        return x;
    if (!(x > 0))
        return 0;
    if ((double)x >= tone->white)
        return 1;
    const double y = quotient(tone, (double)x);
    return y < 1 ? (float)y : 1;
}
