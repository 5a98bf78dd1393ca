/* The oracle of blending: factors and operations of lom/pipeline.h by their definitions, one channel at a time. */
#ifndef LOM_TESTS_ORACLE_BLENDING_H
#define LOM_TESTS_ORACLE_BLENDING_H

#include <lom/pipeline.h>

/* What the equations are made of, as rationals of 255 that the target's format holds. */
struct blend_terms {
    double source[4], target[4], second[4], constant[4];
};

static inline double least(double a, double b)
{
    return a < b ? a : b;
}

static inline double factor_of(lom_factor factor, const struct blend_terms *t, int c)
{
    const double factors[LOM_FACTOR_COUNT] = {
        [LOM_FACTOR_ONE] = 1,
        [LOM_FACTOR_SOURCE_COLOR] = t->source[c],
        [LOM_FACTOR_ONE_MINUS_SOURCE_COLOR] = 1 - t->source[c],
        [LOM_FACTOR_SOURCE_ALPHA] = t->source[3],
        [LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA] = 1 - t->source[3],
        [LOM_FACTOR_TARGET_COLOR] = t->target[c],
        [LOM_FACTOR_ONE_MINUS_TARGET_COLOR] = 1 - t->target[c],
        [LOM_FACTOR_TARGET_ALPHA] = t->target[3],
        [LOM_FACTOR_ONE_MINUS_TARGET_ALPHA] = 1 - t->target[3],
        [LOM_FACTOR_CONSTANT_COLOR] = t->constant[c],
        [LOM_FACTOR_ONE_MINUS_CONSTANT_COLOR] = 1 - t->constant[c],
        [LOM_FACTOR_CONSTANT_ALPHA] = t->constant[3],
        [LOM_FACTOR_ONE_MINUS_CONSTANT_ALPHA] = 1 - t->constant[3],
        [LOM_FACTOR_SOURCE_ALPHA_SATURATE] = c == 3 ? 1 : least(t->source[3], 1 - t->target[3]),
        [LOM_FACTOR_SECOND_COLOR] = t->second[c],
        [LOM_FACTOR_ONE_MINUS_SECOND_COLOR] = 1 - t->second[c],
        [LOM_FACTOR_SECOND_ALPHA] = t->second[3],
        [LOM_FACTOR_ONE_MINUS_SECOND_ALPHA] = 1 - t->second[3],
    };
    return factors[factor];
}

/* S F op D G of channel c. */
static inline double blend_equation(const lom_blend *how, const struct blend_terms *t, int c)
{
    double s = t->source[c], d = t->target[c];
    lom_blend_operation operation = c < 3 ? how->color_operation : how->alpha_operation;
    double f = factor_of(c < 3 ? how->source_color : how->source_alpha, t, c);
    double g = factor_of(c < 3 ? how->target_color : how->target_alpha, t, c);
    const double results[] = { s * f + d * g, s * f - d * g, d * g - s * f, s < d ? s : d, s > d ? s : d };
    return results[operation];
}

#endif
