/* lom/transfer.h - transfer functions: what each value of a medium looks like, and marches that show it. */
#ifndef LOM_TRANSFER_H
#define LOM_TRANSFER_H

#include <lom/march.h>

LOM_API_BEGIN
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

enum { LOM_MAX_TRANSFER = 16 };

typedef struct lom_transfer_point {
    double value;      /* 0..1 */
    double extinction; /* 0..1, in parts of the medium's */
    double color[3];   /* linear, not negative */
} lom_transfer_point;

/* A transfer function: piecewise linear in the value, with colours that are weighted by the extinction beside them, so
 * that what is clear tints nothing (C. Wittenbrink, T. Malzbender, M. Goss, Opacity-weighted color interpolation for
 * volume sampling, 1998). Made by lom_make_transfer_function, read only. */
typedef struct lom_transfer_function {
    int count;                              /* of points, from value 0 to value 1; 0: there is none */
    float value[LOM_MAX_TRANSFER + 2];      /* never falling */
    float channel[4][LOM_MAX_TRANSFER + 2]; /* red, green and blue times extinction; extinction */
    bool empty_is_clear;                    /* value 0 has no extinction: what is empty can be skipped */
} lom_transfer_function;

/* From 1 to LOM_MAX_TRANSFER points whose values do not fall; below the first and above the last it is constant. Two of
 * one value are a step: the value itself is with the second. False, with a sentence, for numbers out of range. */
bool lom_make_transfer_function(const lom_transfer_point *points, size_t count, lom_transfer_function *transfer,
                                lom_error *error);

/* Channel k of it at a value, which is cut to 0..1. */
float lom_transfer_at(const lom_transfer_function *transfer, float value, int k);

/* For lom_transfer_between: how much of low..high lies in interval i of a transfer function, and where in the interval
 * the middle of that lies (0..1). */
LOM_INLINE lom_float lom_transfer_part(const lom_transfer_function *t, int i, lom_float low, lom_float high,
                                       lom_float *weight)
{
    lom_float from = lom_max(low, lom_splat(t->value[i])), to = lom_min(high, lom_splat(t->value[i + 1]));
    float width = t->value[i + 1] - t->value[i];
    *weight = ((from - t->value[i]) + (to - t->value[i])) * (width > 0 ? 0.5f / width : 0.0f);
    return lom_max(to - from, lom_splat(0.0f));
}

/* The mean of the four channels over a way on which the value goes evenly from a to b, both in 0..1: the pre-integrated
 * function (K. Engel, M. Kraus, T. Ertl, High-quality pre-integrated volume rendering, 2001), in closed form: in each
 * interval the mean of a linear function is its middle's. Where |b - a| < 2^-20 it is the function at their middle. x, y
 * and z are colours times extinction, w is the extinction. */
LOM_INLINE lom_float4 lom_transfer_between(const lom_transfer_function *t, lom_float a, lom_float b)
{
    lom_float low = lom_min(a, b), high = lom_max(a, b), middle = (low + high) * 0.5f;
    lom_mask narrow = high - low < 0x1p-20f;
    lom_float sum[4] = { { 0 } }, inverse = 1.0f / lom_select(narrow, lom_splat(1.0f), high - low);
    for (int i = 0; i + 1 < t->count; i++) {
        lom_float weight, part = lom_transfer_part(t, i, low, high, &weight) * inverse;
        float width = t->value[i + 1] - t->value[i];
        lom_mask here = narrow & (middle >= t->value[i]);
        weight = lom_select(narrow, (middle - t->value[i]) * (width > 0 ? 1.0f / width : 0.0f), weight);
        for (int k = 0; k < 4; k++) {
            const float *c = t->channel[k];
            lom_float mean = weight * (c[i + 1] - c[i]) + c[i];
            sum[k] = lom_select(narrow, lom_select(here, mean, sum[k]), sum[k] + part * mean);
        }
    }
    lom_float4 mean = { sum[0], sum[1], sum[2], sum[3] };
    return mean;
}

typedef enum lom_volume_look {
    LOM_LOOK_SCATTERED = 0, /* colour is what is left of the light that a place scatters, as of a cloud */
    LOM_LOOK_SURFACE,       /* Lambert's cosine between the light and the gradient of the value (M. Levoy, Display of
                             * surfaces from volume data, 1988), turned to the eye */
    LOM_LOOK_GLOWING        /* colour is the radiance of a place, whatever shines on it */
} lom_volume_look;

typedef struct lom_transfer_desc {
    const lom_transfer_function *transfer;
    lom_volume_look look;
    float sun[3], sky[3], ground[3]; /* radiance: of scattered light where a place sees all of each; of a white surface
                                      * that faces the sun, sees only sky, sees only ground */
    float size[3];                   /* of the box, metres */
    float to_light[3];               /* unit vector in the box's axes, of which y is up */
} lom_transfer_desc;

typedef struct lom_transfer_result {
    lom_float3 color; /* times opacity: what comes towards the eye */
    lom_float transmittance;
    lom_float distance; /* as in lom_medium_result */
} lom_transfer_result;

/* Radiance along rays through a medium seen by a transfer function, with the steps of lom_march_medium: values are taken
 * at both ends of a step, and between them the function is integrated exactly as if the value went evenly from the one
 * to the other. So a medium of one value, and one that is linear along the ray, are exact at any step, steps of the
 * function among them; elsewhere the value is off by at most twice what lom_medium_step was asked for, and an integral of
 * a function of slope s by s times it. Within a step nothing hides the colours of one part from another: they are off by
 * at most their range times half the square of the step's opacity. What is sent is at most the largest colour times
 * light, in parts of 1 - transmittance. medium->walk evaluates every step, with the same bytes. count may be NULL. */
void LOM_WIDE(lom_march_transfer)(lom_transfer_result *out, const lom_medium_rays *rays, const lom_medium_desc *medium,
                                  const lom_transfer_desc *desc, lom_march_count *count);

/* Optical depth of a medium seen by a transfer function between two distances along rays, by `steps` such steps; the
 * noise counts as its mean, as in lom_medium_depth. */
void LOM_WIDE(lom_transfer_depth)(lom_float *depth, const lom_medium_rays *rays, const lom_medium_desc *medium,
                                  const lom_transfer_function *transfer, int steps);

#pragma GCC diagnostic pop
LOM_API_END

#endif
