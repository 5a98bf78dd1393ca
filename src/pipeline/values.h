/* From the values of triangles to the varyings of their fragments: what slots (interpolate.wide.c) and facets
 * (facet.wide.c) share. */
#ifndef LOM_PIPELINE_VALUES_H
#define LOM_PIPELINE_VALUES_H

#include "pipeline/mark_edges.h"
#include "pipeline/run_shader.h"
#include "pipeline/slots.h"

/* Words of a triangle's values; then, for each varying that is read, VALUE_WORDS. */
enum { ONE_OVER_W = LIST_ONE_OVER_W, FACING = 3, STEPS = 4, VALUES = LIST_HEADER };
enum { VALUE = 0, DELTA1, DELTA2, LOWEST, HIGHEST, VALUE_WORDS = LIST_VALUE };

/* The values of a packet's triangles: the first word of its first slot, or of the facet of its only one. */
struct values {
    const float *words;
    lom_int which;
    struct lom_facet *facet; /* NULL: slots */
};

LOM_INLINE lom_float load_value(const struct values *v, int word)
{
    return v->facet != NULL ? lom_splat(v->words[word]) : lom_permute(lom_load(v->words + word * SLOT_PITCH), v->which);
}

struct weights { /* of the three vertices, screen-space times 1/w; b1 and b2 perspective-correct */
    lom_float one_over_w[3], sum, b1, b2;
    bool whole; /* the sum is 1 in all lanes of a level facet: what is divided by it is itself */
};

/* In a level facet, where 1/w is 1, the weights sum to 1 but for their rounding: in all lanes of most packets of triangles
 * whose area is near a power of two, in four of five of a window of 1280x720, in two of five of 61x67. */
LOM_INLINE bool is_whole(const struct values *v, lom_float sum)
{
    return v->facet != NULL && v->facet->level && lom_all(sum == lom_splat(1.0f));
}

LOM_INLINE struct weights find_weights(const struct values *v, const lom_float l[3], bool quads)
{
    struct weights w;
    bool level = v->facet != NULL && v->facet->level; /* 1/w is 1 */
    lom_float p[3];
    for (int k = 0; k < 3; k++) {
        w.one_over_w[k] = level ? lom_splat(1.0f) : load_value(v, ONE_OVER_W + k);
        p[k] = level ? l[k] : l[k] * w.one_over_w[k];
    }
    w.sum = p[0] + p[1] + p[2];
    if (quads) /* helpers lie outside the triangle, where 1/w may pass through 0 */
        w.sum = lom_max(w.sum, lom_min(w.one_over_w[0], lom_min(w.one_over_w[1], w.one_over_w[2])));
    w.whole = is_whole(v, w.sum);
    w.b1 = w.whole ? p[1] : p[1] / w.sum;
    w.b2 = w.whole ? p[2] : p[2] / w.sum;
    return w;
}

/* d(b)/dx from b = l_i/w_i / sum: (d(l_i)/dx / w_i - b d(sum)/dx) / sum. */
LOM_INLINE void find_slope(lom_float step1, lom_float step2, const struct weights *w, lom_float slope[2])
{
    lom_float a = step1 * w->one_over_w[1], b = step2 * w->one_over_w[2];
    lom_float sum = a + b - (step1 + step2) * w->one_over_w[0];
    slope[0] = (a - w->b1 * sum) / w->sum;
    slope[1] = (b - w->b2 * sum) / w->sum;
}

/* The same where all but b and the sum of the weights is the triangle's. */
LOM_INLINE void find_slope_of_facet(const struct lom_facet *facet, int axis, const struct weights *w,
                                    lom_float slope[2])
{
    const float *k = facet->slope[axis];
    if (w->whole) {
        slope[0] = lom_splat(k[0]);
        slope[1] = lom_splat(k[1]);
        return;
    }
    slope[0] = facet->level ? k[0] / w->sum : (k[0] - w->b1 * k[2]) / w->sum;
    slope[1] = facet->level ? k[1] / w->sum : (k[1] - w->b2 * k[2]) / w->sum;
}

LOM_INLINE void interpolate(const struct values *values, const lom_shader *shader, const struct weights *w,
                            lom_varyings *in)
{
    int word = VALUES;
    uint32_t declared = (UINT32_C(1) << shader->varyings) - 1;
    for (uint32_t reads = shader->reads & declared; reads != 0; reads &= reads - 1, word += VALUE_WORDS) {
        int v = __builtin_ctz(reads);
        if (values->facet != NULL && !(values->facet->varies >> v & 1))
            continue;
        lom_float f = load_value(values, word + VALUE);
        if (shader->flat >> v & 1) {
            in->varying[v] = f;
            in->delta[0][v] = in->delta[1][v] = (lom_float){ 0 };
            continue;
        }
        lom_float d1 = load_value(values, word + DELTA1), d2 = load_value(values, word + DELTA2);
        in->varying[v] = lom_clamp(f + w->b1 * d1 + w->b2 * d2, load_value(values, word + LOWEST),
                                   load_value(values, word + HIGHEST));
        if (values->facet == NULL && shader->differentiates >> v & 1) {
            in->delta[0][v] = d1;
            in->delta[1][v] = d2;
        }
    }
}

/* Those that are linear in the window: with its weights. */
static __attribute__((noinline)) void interpolate_linear(const struct values *values, const lom_shader *shader,
                                                         const lom_float l[3], lom_varyings *in)
{
    int word = VALUES;
    uint32_t declared = (UINT32_C(1) << shader->varyings) - 1;
    for (uint32_t reads = shader->reads & declared; reads != 0; reads &= reads - 1, word += VALUE_WORDS) {
        int v = __builtin_ctz(reads);
        if ((shader->screen_linear & ~shader->flat) >> v & 1)
            in->varying[v] = lom_clamp(load_value(values, word + VALUE) + l[1] * load_value(values, word + DELTA1) +
                                           l[2] * load_value(values, word + DELTA2),
                                       load_value(values, word + LOWEST), load_value(values, word + HIGHEST));
    }
}

LOM_INLINE void find_slopes(const struct values *v, const struct weights *w, lom_varyings *in)
{
    if (v->facet != NULL) {
        find_slope_of_facet(v->facet, 0, w, in->dx);
        find_slope_of_facet(v->facet, 1, w, in->dy);
        in->levels = w->whole ? &v->facet->levels : NULL;
    } else {
        find_slope(load_value(v, STEPS), load_value(v, STEPS + 2), w, in->dx);
        find_slope(load_value(v, STEPS + 1), load_value(v, STEPS + 3), w, in->dy);
    }
}

/* All that a shader gets of values, and the position's z. */
LOM_INLINE void find_varyings(const struct values *v, const lom_shader *shader, const struct lom_packet *packet,
                              bool quads, lom_varyings *in)
{
    struct weights w = find_weights(v, packet->l, quads);
    interpolate(v, shader, &w, in);
    if (shader->screen_linear != 0)
        interpolate_linear(v, shader, packet->l, in);
    if (shader->differentiates != 0)
        find_slopes(v, &w, in);
    if (shader->reads_position) {
        in->z = packet->depth;
        in->w = 1.0f / w.sum;
        if (v->facet == NULL)
            in->front = lom_as_int(load_value(v, FACING));
    }
}

/* With draw->marks_edges. */
static __attribute__((noinline)) void mark_edges(struct lom_tile *tile, const struct values *v,
                                                 const struct lom_packet *packet, bool is_cut)
{
    const lom_float4 step = { load_value(v, STEPS), load_value(v, STEPS + 1), load_value(v, STEPS + 2),
                              load_value(v, STEPS + 3) };
    if (tile->draw->lines)
        LOM_WIDE(lom_mark_no_edges)(tile);
    else
        LOM_WIDE(lom_mark_edges)(tile, packet, &step, is_cut);
}

#endif
