/* Stage 6 of 7 for triangles of which something is found before their fragments are. In: fragments of small triangles
 * that are drawn together, and those triangles' slots; or a packet of one triangle. Out: shaded colours, on to the output
 * stage. What fragments need of a triangle's vertices is found once a slot, for LOM_LANES triangles at a time, or once
 * for the packets of one triangle: fragment.wide.c, which is plainer, finds it again for each packet.
 *
 * Invariant: varyings are those of fragment.wide.c, by the same arithmetic. */
#include "pipeline/mark_edges.h"
#include "pipeline/run_shader.h"
#include "pipeline/slots.h"

/* Words of a triangle's values; then, for each varying that is read, VALUE_WORDS. */
enum { ONE_OVER_W = LIST_ONE_OVER_W, FACING = 3, STEPS = 4, VALUES = LIST_HEADER };
enum { VALUE = 0, DELTA1, DELTA2, LOWEST, HIGHEST, VALUE_WORDS = LIST_VALUE };

/* ---- from values to varyings ---- */

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

/* All that a shader gets of values, and the position's z. */
LOM_INLINE void find_varyings(const struct values *v, const lom_shader *shader, const struct lom_packet *packet,
                              bool quads, lom_varyings *in)
{
    struct weights w = find_weights(v, packet->l, quads);
    interpolate(v, shader, &w, in);
    if (shader->screen_linear != 0)
        interpolate_linear(v, shader, packet->l, in);
    if (shader->differentiates != 0 && v->facet != NULL) {
        find_slope_of_facet(v->facet, 0, &w, in->dx);
        find_slope_of_facet(v->facet, 1, &w, in->dy);
        in->levels = w.whole ? &v->facet->levels : NULL;
    } else if (shader->differentiates != 0) {
        find_slope(load_value(v, STEPS), load_value(v, STEPS + 2), &w, in->dx);
        find_slope(load_value(v, STEPS + 1), load_value(v, STEPS + 3), &w, in->dy);
    }
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

/* ---- one triangle ---- */

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

_Static_assert(sizeof(lom_varyings) <= LARGEST_VARYINGS, "a facet holds a packet's varyings");

LOM_INLINE lom_varyings *varyings_of(struct lom_facet *facet)
{
    return (lom_varyings *)(void *)facet->varyings;
}

static __attribute__((noinline)) void fill_facet(struct lom_tile *tile, const lom_primitive *p)
{
    const lom_shader *shader = tile->draw->desc.shader;
    struct lom_facet *facet = &tile->facet;
    lom_varyings *in = varyings_of(facet);
    float *to = facet->value;
    const float *row[3], *provoking;
    lom_triangle t;
    lom_find_triangle(tile->chunk, p, &t);
    facet->primitive = p;
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
    lom_varyings *in = varyings_of(&tile->facet);
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

void LOM_WIDE(lom_shade_window)(struct lom_tile *tile, int32_t number, int base, const lom_float l[PARTS][3])
{
    struct lom_packet packet;
    turn_facet(tile, number);
    packet.triangle[0] = number;
    packet.triangles = 1;
    packet.covered = lom_splat_int(-1);
    packet.depth = (lom_float){ 0 };
    packet.places.block = true;
    for (int part = 0; part < PARTS; part++) {
        for (int k = 0; k < 3; k++)
            packet.l[k] = l[part][k];
        lom_store_int(packet.places.pixel, lom_load_int(tile->offset + part * LOM_LANES) + base);
        shade_with_facet(tile, &packet);
    }
}

/* ---- slots ---- */

#if LOM_LANES > 4 /* SLOTS_BY_WORD: at 4 lanes a slot's words would be more than the vertices' rows */

LOM_INLINE void store_value(struct lom_list *list, int word, int slot, lom_float x)
{
    lom_store(list->value + word * SLOT_PITCH + slot, x);
}

/* Where the rows of the vertices of LOM_LANES triangles begin, and that of the provoking one. */
struct vertex_rows {
    lom_int row[3], provoking;
};

static void fill_varying(struct lom_list *list, int word, int slot, const lom_float f[3], bool flat,
                         lom_float provoking)
{
    if (flat) {
        store_value(list, word + VALUE, slot, provoking);
        return;
    }
    store_value(list, word + VALUE, slot, f[0]);
    store_value(list, word + DELTA1, slot, f[1] - f[0]);
    store_value(list, word + DELTA2, slot, f[2] - f[0]);
    store_value(list, word + LOWEST, slot, lom_min(f[0], lom_min(f[1], f[2])));
    store_value(list, word + HIGHEST, slot, lom_max(f[0], lom_max(f[1], f[2])));
}

/* The varyings that are read, four of a row at a time. */
static void fill_varyings(struct lom_tile *tile, const struct vertex_rows *v, int slot)
{
    const lom_shader *shader = tile->draw->desc.shader;
    int word = VALUES;
    for (int first = 0; first < shader->varyings; first += 4) {
        uint32_t reads = shader->reads >> first & 15, flat = shader->flat >> first & reads;
        const float *from = tile->chunk->rows + ROW_HEADER + first;
        if (reads == 0)
            continue;
        lom_float4 a = lom_gather_rows(from, v->row[0]), b = lom_gather_rows(from, v->row[1]),
                   c = lom_gather_rows(from, v->row[2]), last = { a.x, a.y, a.z, a.w };
        if (flat != 0)
            last = lom_gather_rows(from, v->provoking);
        const lom_float f[4][3] = { { a.x, b.x, c.x }, { a.y, b.y, c.y }, { a.z, b.z, c.z }, { a.w, b.w, c.w } };
        const lom_float provoking[4] = { last.x, last.y, last.z, last.w };
        for (int k = 0; k < 4; k++)
            if (reads >> k & 1) {
                fill_varying(&tile->list, word, slot, f[k], flat >> k & 1, provoking[k]);
                word += VALUE_WORDS;
            }
    }
}

/* The steps of the weights: those of the edge functions over the area, both of which are in the slots. */
static void fill_steps(struct lom_list *list, int slot)
{
    const float *from = list->slots + slot;
    lom_float scale = lom_splat(SUBPIXELS), inverse = lom_load(from + SLOT_INVERSE * SLOT_PITCH);
    for (int i = 0; i < 2; i++) {
        lom_int pair = lom_load_int((const int32_t *)from + (SLOT_STEP1 + i) * SLOT_PITCH);
        store_value(list, STEPS + 2 * i, slot, lom_to_float(pair << 16 >> 16) * scale * inverse);
        store_value(list, STEPS + 2 * i + 1, slot, lom_to_float(pair >> 16) * scale * inverse);
    }
}

/* LOM_LANES slots; the words are those of lom_primitive. 1/w is there already. */
static void fill_packet(struct lom_tile *tile, int slot)
{
    struct lom_list *list = &tile->list;
    const float *words = (const float *)(const void *)tile->chunk->primitives;
    lom_int at = lom_load_int((const int32_t *)list->number + slot) * (int32_t)(sizeof(lom_primitive) / 4);
    lom_float4 last = lom_gather_rows(words, at);
    struct vertex_rows v = { .row = { lom_as_int(last.x), lom_as_int(last.y), lom_as_int(last.z) } };
    lom_int state = lom_as_int(last.w), provoking = state >> TRIANGLE_PROVOKING & 3;
    v.provoking = lom_select_int(provoking == 0, v.row[0], lom_select_int(provoking == 1, v.row[1], v.row[2]));
    store_value(list, FACING, slot, lom_as_float(-(state >> TRIANGLE_FRONT & 1)));
    if (tile->draw->desc.shader->differentiates != 0 || tile->draw->marks_edges)
        fill_steps(list, slot);
    fill_varyings(tile, &v, slot);
}

void LOM_WIDE(lom_fill_values)(struct lom_tile *tile)
{
    for (int slot = 0; slot < tile->list.triangles; slot += LOM_LANES)
        fill_packet(tile, slot);
}

void LOM_WIDE(lom_shade_slots)(struct lom_tile *tile, const struct packed *p, const struct lom_packet *packet)
{
    const lom_shader *shader = tile->draw->desc.shader;
    const struct values values = { tile->list.value + p->first, p->which, NULL };
    lom_varyings in;
    in.levels = NULL;
    find_varyings(&values, shader, packet, false, &in);
    if (shader->reads_position) {
        in.x = lom_to_float((p->code >> CODE_X & 63) + tile->x) + 0.5f;
        in.y = lom_to_float((p->code >> CODE_Y & 63) + tile->y) + 0.5f;
    }
    if (tile->draw->marks_edges) /* what clip distances cut is in no slot */
        mark_edges(tile, &values, packet, false);
    lom_run_shader(tile, packet, &in);
}

#endif
