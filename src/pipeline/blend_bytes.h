/* Blending of 8-bit channels in exact integers, two channels of a pixel at a time: v = S F + D G, rounded once to
 * round(v / 255). */
#ifndef LOM_PIPELINE_BLEND_BYTES_H
#define LOM_PIPELINE_BLEND_BYTES_H

#include "image/narrowed_unorm.h"
#include "pipeline/packet.h"

struct equation {
    lom_factor source, target;
    lom_blend_operation operation;
};

LOM_INLINE struct equation equation_of(const lom_blend *blend, int c)
{
    if (c == 3)
        return (struct equation){ blend->source_alpha, blend->target_alpha, blend->alpha_operation };
    return (struct equation){ blend->source_color, blend->target_color, blend->color_operation };
}

/* A colour as four bytes. */
LOM_INLINE struct channels quantise(const lom_float4 *color)
{
    return narrow(lom_narrowed_unorm8_of_lanes(color->x), lom_narrowed_unorm8_of_lanes(color->y),
                  lom_narrowed_unorm8_of_lanes(color->z), lom_narrowed_unorm8_of_lanes(color->w));
}

/* What factors are made of, in one half of the channels: values, and the alpha of each in both of its channels. */
struct operands {
    pairs source, source_alpha, target, target_alpha;
    pairs second, second_alpha, constant, constant_alpha; /* only where the draw blends by them */
    pairs saturate;                                       /* likewise: SOURCE_ALPHA_SATURATE */
};

/* The factors that few draws have. */
LOM_INLINE pairs rare_factor(lom_factor factor, const struct operands *o)
{
    const pairs one = splat_pairs(255);
    switch (factor) {
    case LOM_FACTOR_CONSTANT_COLOR:
        return o->constant;
    case LOM_FACTOR_ONE_MINUS_CONSTANT_COLOR:
        return one - o->constant;
    case LOM_FACTOR_CONSTANT_ALPHA:
        return o->constant_alpha;
    case LOM_FACTOR_ONE_MINUS_CONSTANT_ALPHA:
        return one - o->constant_alpha;
    case LOM_FACTOR_SOURCE_ALPHA_SATURATE:
        return o->saturate;
    case LOM_FACTOR_SECOND_COLOR:
        return o->second;
    case LOM_FACTOR_ONE_MINUS_SECOND_COLOR:
        return one - o->second;
    case LOM_FACTOR_SECOND_ALPHA:
        return o->second_alpha;
    case LOM_FACTOR_ONE_MINUS_SECOND_ALPHA:
        return one - o->second_alpha;
    default:
        return (pairs){ 0 };
    }
}

/* A factor in units of 1/255, for one half of the channels. */
LOM_INLINE pairs byte_factor(lom_factor factor, const struct operands *o)
{
    const pairs one = splat_pairs(255);
    switch (factor) {
    case LOM_FACTOR_ZERO:
        return (pairs){ 0 };
    case LOM_FACTOR_ONE:
        return one;
    case LOM_FACTOR_SOURCE_COLOR:
        return o->source;
    case LOM_FACTOR_ONE_MINUS_SOURCE_COLOR:
        return one - o->source;
    case LOM_FACTOR_SOURCE_ALPHA:
        return o->source_alpha;
    case LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA:
        return one - o->source_alpha;
    case LOM_FACTOR_TARGET_COLOR:
        return o->target;
    case LOM_FACTOR_ONE_MINUS_TARGET_COLOR:
        return one - o->target;
    case LOM_FACTOR_TARGET_ALPHA:
        return o->target_alpha;
    case LOM_FACTOR_ONE_MINUS_TARGET_ALPHA:
        return one - o->target_alpha;
    default:
        return rare_factor(factor, o);
    }
}

LOM_INLINE pairs select_pairs(pairs mask, pairs a, pairs b)
{
    return (mask & a) | (~mask & b);
}

/* s + d, s - d or d - s within 0..255^2; a sum that wraps is smaller than its terms. */
LOM_INLINE pairs combine(lom_blend_operation operation, pairs s, pairs d)
{
    const pairs largest = splat_pairs(255 * 255);
    if (operation == LOM_BLEND_SUBTRACT)
        return (s - d) & (pairs)(s > d);
    if (operation == LOM_BLEND_REVERSE_SUBTRACT)
        return (d - s) & (pairs)(d > s);
    pairs sum = s + d;
    return select_pairs((pairs)(sum < s) | (pairs)(sum > largest), largest, sum);
}

LOM_INLINE pairs blend_half(struct equation e, const struct operands *o)
{
    if (e.operation == LOM_BLEND_MIN)
        return select_pairs((pairs)(o->source < o->target), o->source, o->target);
    if (e.operation == LOM_BLEND_MAX)
        return select_pairs((pairs)(o->source > o->target), o->source, o->target);
    return divide_by_255(
        combine(e.operation, o->source * byte_factor(e.source, o), o->target * byte_factor(e.target, o)));
}

/* The second source and the constant of draws that blend by them. */
struct rare_sources {
    struct channels second, constant;
};

LOM_INLINE bool needs_alpha_apart(struct equation color, struct equation alpha)
{
    return color.source != alpha.source || color.target != alpha.target || color.operation != alpha.operation ||
           color.source == LOM_FACTOR_SOURCE_ALPHA_SATURATE || color.target == LOM_FACTOR_SOURCE_ALPHA_SATURATE;
}

/* Of any equations. */
LOM_INLINE struct channels blend_bytes(const lom_blend *blend, struct channels source, struct channels target,
                                       const struct rare_sources *rare)
{
    struct equation color = equation_of(blend, 0), alpha = equation_of(blend, 3);
    const pairs one = splat_pairs(255);
    struct operands rb = { .source = source.rb, .source_alpha = alpha_of(source), .target = target.rb };
    rb.target_alpha = alpha_of(target);
    rb.saturate =
        select_pairs((pairs)(rb.source_alpha < one - rb.target_alpha), rb.source_alpha, one - rb.target_alpha);
    rb.second = rare->second.rb;
    rb.second_alpha = alpha_of(rare->second);
    rb.constant = rare->constant.rb;
    rb.constant_alpha = alpha_of(rare->constant);
    struct operands ga = rb;
    ga.source = source.ga;
    ga.target = target.ga;
    ga.second = rare->second.ga;
    ga.constant = rare->constant.ga;
    struct channels result = { blend_half(color, &rb), blend_half(color, &ga) };
    if (needs_alpha_apart(color, alpha)) {
        ga.saturate = one;
        result.ga = select_pairs(second_channels(), blend_half(alpha, &ga), result.ga);
    }
    return result;
}

/* What blend_bytes makes of OUTPUT_STRAIGHT: no sum is above 255^2. */
LOM_INLINE struct channels blend_straight(struct channels source, struct channels target)
{
    pairs alpha = alpha_of(source), rest = 255 - alpha;
    return (struct channels){ divide_by_255(source.rb * alpha + target.rb * rest),
                              divide_by_255(source.ga * alpha + target.ga * rest) };
}

/* What it makes of OUTPUT_MULTIPLIED: round((255 S + D G) / 255) is S + round(D G / 255), and the bound of 255^2 is one
 * of 255 after the division, which join_bounded has. */
LOM_INLINE struct channels blend_multiplied(struct channels source, struct channels target)
{
    pairs rest = 255 - alpha_of(source);
    return (struct channels){ source.rb + divide_by_255(target.rb * rest),
                              source.ga + divide_by_255(target.ga * rest) };
}

#endif
