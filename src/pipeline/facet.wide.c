/* Stage 6 of 7 for triangles with several packets. In: a packet of one triangle, or whole windows of one. Out: shaded colours,
 * on to the output stage. What fragments need of the triangle's vertices is found once for the packets that follow one
 * another (a facet).
 *
 * Windows take every step together, values, shader, output: their chains of instructions overlap, where those of one
 * packet wait for one another.
 *
 * Invariant: varyings are those of fragment.wide.c, by the same arithmetic. */
#include "pipeline/values.h"

static float lesser(float a, float b)
{
    return a < b ? a : b;
}

static float greater(float a, float b)
{
    return a > b ? a : b;
}

static bool is_negative_zero(float x)
{
    return x == 0 && __builtin_signbit(x);
}

/* What the slopes of the weights are made of. Where all 1/w are 1 the sums are 0, and k - b 0 is k: b is finite where a
 * pixel is covered, and k is not -0. */
static void fill_slopes(struct lom_facet *facet, const lom_triangle *t)
{
    const float *one_over_w = facet->value + ONE_OVER_W;
    const float step[2][2] = { { t->step_x1 * t->inverse_area, t->step_x2 * t->inverse_area },
                               { t->step_y1 * t->inverse_area, t->step_y2 * t->inverse_area } };
    facet->level = one_over_w[0] == 1 && one_over_w[1] == 1 && one_over_w[2] == 1;
    for (int axis = 0; axis < 2; axis++) {
        float *k = facet->slope[axis];
        facet->value[STEPS + axis] = step[axis][0];
        facet->value[STEPS + 2 + axis] = step[axis][1];
        k[0] = step[axis][0] * one_over_w[1];
        k[1] = step[axis][1] * one_over_w[2];
        k[2] = k[0] + k[1] - (step[axis][0] + step[axis][1]) * one_over_w[0];
        facet->level &= k[2] == 0 && !is_negative_zero(k[0]) && !is_negative_zero(k[1]);
    }
}

/* A varying of the triangle: its words, and what of it is the same for all packets. Clamped to f..f a weighted sum is f,
 * but for the sign of a zero. */
static void fill_value(struct lom_facet *facet, int v, const float f[3], float *to, lom_varyings *in)
{
    to[VALUE] = f[0];
    to[DELTA1] = f[1] - f[0];
    to[DELTA2] = f[2] - f[0];
    to[LOWEST] = lesser(f[0], lesser(f[1], f[2]));
    to[HIGHEST] = greater(f[0], greater(f[1], f[2]));
    in->varying[v] = lom_splat(f[0]);
    in->delta[0][v] = lom_splat(to[DELTA1]);
    in->delta[1][v] = lom_splat(to[DELTA2]);
    bool same = f[0] == f[1] && f[0] == f[2];
    for (int k = 0; k < 3; k++)
        same &= !is_negative_zero(f[k]);
    facet->varies |= (uint32_t)!same << v;
}

LOM_INLINE lom_varyings *varyings_of(struct lom_facet *facet, int packet)
{
    return varyings_in(facet->varyings, packet);
}

static __attribute__((noinline)) void fill_facet(struct lom_tile *tile, const lom_primitive *p)
{
    const lom_shader *shader = tile->draw->desc.shader;
    struct lom_facet *facet = &tile->facet;
    lom_varyings *in = varyings_of(facet, 0);
    float *to = facet->value;
    const float *row[3], *provoking;
    lom_triangle t;
    lom_find_triangle(tile->chunk, p, &t);
    facet->primitive = p;
    facet->filled = 1;
    facet->varies = 0;
    facet->levels.count = 0;
    in->levels = NULL;
    for (int k = 0; k < 3; k++) {
        row[k] = tile->chunk->rows + p->row[k] + ROW_HEADER;
        to[ONE_OVER_W + k] = row[k][-1];
    }
    provoking = row[p->state >> TRIANGLE_PROVOKING & 3];
    in->front = lom_splat_int(-(int32_t)(p->state >> TRIANGLE_FRONT & 1));
    fill_slopes(facet, &t);
    to += VALUES;
    uint32_t declared = (UINT32_C(1) << shader->varyings) - 1;
    for (uint32_t reads = shader->reads & declared; reads != 0; reads &= reads - 1, to += VALUE_WORDS) {
        int v = __builtin_ctz(reads);
        const float f[3] = { row[0][v], row[1][v], row[2][v] };
        if (shader->flat >> v & 1) {
            in->varying[v] = lom_splat(provoking[v]);
            in->delta[0][v] = in->delta[1][v] = (lom_float){ 0 };
        } else
            fill_value(facet, v, f, to, in);
    }
}

/* A packet of the facet's triangle; l is its weights. */
LOM_INLINE void shade_with_facet(struct lom_tile *tile, const struct lom_packet *packet)
{
    const lom_shader *shader = tile->draw->desc.shader;
    const struct values values = { tile->facet.value, { 0 }, &tile->facet };
    lom_varyings *in = varyings_of(&tile->facet, 0);
    if (shader->reads != 0 || shader->reads_position)
        find_varyings(&values, shader, packet, shader->quads, in);
    if (shader->reads_position)
        lom_find_position(tile, &packet->places, in);
    if (tile->draw->marks_edges)
        mark_edges(tile, &values, packet, tile->facet.primitive->state >> TRIANGLE_CLIP != 0);
    lom_run_shader(tile, packet, in);
}

LOM_INLINE void turn_facet(struct lom_tile *tile, int32_t number)
{
    const lom_primitive *p = &tile->chunk->primitives[number];
    if (tile->facet.primitive != p)
        fill_facet(tile, p);
}

void LOM_WIDE(lom_shade_facet)(struct lom_tile *tile, const struct lom_packet *packet)
{
    turn_facet(tile, packet->triangle[0]);
    shade_with_facet(tile, packet);
}

/* ---- whole windows ---- */

/* What is the same in all packets, to the varyings of a packet that had no other one of the triangle. */
static void copy_constants(struct lom_facet *facet, const lom_shader *shader, int packet)
{
    const lom_varyings *from = varyings_of(facet, 0);
    lom_varyings *in = varyings_of(facet, packet);
    uint32_t declared = (UINT32_C(1) << shader->varyings) - 1;
    in->levels = NULL;
    in->front = from->front;
    in->covered = lom_splat_int(-1);
    for (uint32_t same = shader->reads & declared & ~facet->varies; same != 0; same &= same - 1)
        in->varying[__builtin_ctz(same)] = from->varying[__builtin_ctz(same)];
    for (uint32_t slopes = shader->differentiates; slopes != 0; slopes &= slopes - 1) {
        int v = __builtin_ctz(slopes);
        in->delta[0][v] = from->delta[0][v];
        in->delta[1][v] = from->delta[1][v];
    }
}

/* interpolate() of all packets, a varying after the other. */
LOM_INLINE void interpolate_windows(struct lom_facet *facet, const lom_shader *shader, lom_float b[WINDOWS_PACKETS][2],
                                    int count)
{
    const float *value = facet->value + VALUES;
    uint32_t declared = (UINT32_C(1) << shader->varyings) - 1;
    for (uint32_t reads = shader->reads & declared; reads != 0; reads &= reads - 1, value += VALUE_WORDS) {
        int v = __builtin_ctz(reads);
        if (!(facet->varies >> v & 1))
            continue;
        const lom_float f = lom_splat(value[VALUE]), d1 = lom_splat(value[DELTA1]), d2 = lom_splat(value[DELTA2]);
        const lom_float low = lom_splat(value[LOWEST]), high = lom_splat(value[HIGHEST]);
        for (int i = 0; i < count; i++)
            varyings_of(facet, i)->varying[v] = lom_clamp(f + b[i][0] * d1 + b[i][1] * d2, low, high);
    }
}

/* find_varyings() of all packets, of a shader that does not read positions. */
static void find_windows_varyings(struct lom_facet *facet, const lom_shader *shader, const struct lom_windows *windows)
{
    const struct values values = { facet->value, { 0 }, facet };
    lom_float b[WINDOWS_PACKETS][2];
    for (int i = 0; i < windows->count; i++) {
        const struct weights w = find_weights(&values, windows->l[i], shader->quads);
        b[i][0] = w.b1;
        b[i][1] = w.b2;
        if (shader->differentiates != 0)
            find_slopes(&values, &w, varyings_of(facet, i));
    }
    interpolate_windows(facet, shader, b, windows->count);
    for (int i = 0; i < windows->count && shader->screen_linear != 0; i++)
        interpolate_linear(&values, shader, windows->l[i], varyings_of(facet, i));
}

void LOM_WIDE(lom_shade_windows)(struct lom_tile *tile, const struct lom_windows *windows)
{
    const lom_shader *shader = tile->draw->desc.shader;
    lom_fragment_function *shade = shader->fragment[tile->draw->variant];
    turn_facet(tile, windows->number);
    varyings_of(&tile->facet, 0)->covered = lom_splat_int(-1);
    for (; tile->facet.filled < windows->count; tile->facet.filled++)
        copy_constants(&tile->facet, shader, tile->facet.filled);
    if (shader->reads != 0)
        find_windows_varyings(&tile->facet, shader, windows);
    for (int i = 0; i < windows->count; i++) {
        lom_fragment *out = fragment_in(&tile->together, i);
        out->depth = (lom_float){ 0 };
        out->discard = (lom_mask){ 0 };
        shade(out, varyings_of(&tile->facet, i), tile->uniforms);
    }
    tile->packets += (uint64_t)windows->count;
    LOM_WIDE(lom_write_windows)(tile, windows);
}
