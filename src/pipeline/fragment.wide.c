/* Stage 6 of 7: fragment. In: a packet of fragments from the queue, of one triangle or of several. Out: shaded colours,
 * on to the output stage. Varyings are f0 + b1 (f1 - f0) + b2 (f2 - f0), b perspective-correct by true division,
 * clamped to the hull of the vertex values.
 *
 * Invariant: a lane's values do not depend on which fragments share its packet; a packet of one triangle broadcasts its
 * rows where a mixed one picks them, with the same arithmetic. */
#include "pipeline/mark_edges.h"
#include "pipeline/run_shader.h"

#include <lom/lanes_mathematics.h>

struct rows { /* the vertices of the packet's triangles */
    const float *base;
    int32_t row[3][LOM_LANES]; /* of each triangle */
    lom_int lane[3];           /* of each lane, where the packet has several */
    lom_int which;
    int triangles;
};

/* Few rows that many lanes share go to them by permutations; else every lane loads its own, from a place that is looked
 * up once a packet. */
enum { PICKS = LOM_LANES == 16 };

/* What lom_pick_rows reads past the last triangle is the first one's. */
static void find_rows(const struct lom_chunk *chunk, const struct lom_packet *packet, struct rows *rows)
{
    rows->base = chunk->rows;
    rows->which = packet->which;
    rows->triangles = packet->triangles;
    for (int i = 0; i < packet->triangles; i++) {
        const lom_primitive *p = &chunk->primitives[packet->triangle[i]];
        for (int k = 0; k < 3; k++)
            rows->row[k][i] = (int32_t)p->row[k];
    }
    for (int i = packet->triangles; (i & 3) != 0; i++)
        for (int k = 0; k < 3; k++)
            rows->row[k][i] = rows->row[k][0];
    for (int k = 0; k < 3 && packet->triangles > 1 && !PICKS; k++)
        rows->lane[k] = lom_gather_int(rows->row[k], packet->which);
}

LOM_INLINE lom_float4 load_rows(const struct rows *rows, int k, int offset)
{
    if (rows->triangles > 1)
        return PICKS ? lom_pick_rows(rows->base + offset, rows->row[k], rows->triangles, rows->which)
                     : lom_gather_rows(rows->base + offset, rows->lane[k]);
    const float *row = rows->base + rows->row[k][0] + offset;
    return (lom_float4){ lom_splat(row[0]), lom_splat(row[1]), lom_splat(row[2]), lom_splat(row[3]) };
}

struct weights { /* of the three vertices, screen-space times 1/w; b1 and b2 perspective-correct */
    lom_float one_over_w[3], sum, b1, b2;
};

static struct weights find_weights(const struct lom_packet *packet, const struct rows *rows, bool quads)
{
    struct weights p;
    for (int k = 0; k < 3; k++)
        p.one_over_w[k] = load_rows(rows, k, 0).w;
    lom_float p1 = packet->l[1] * p.one_over_w[1], p2 = packet->l[2] * p.one_over_w[2];
    p.sum = packet->l[0] * p.one_over_w[0] + p1 + p2;
    if (quads) { /* helpers lie outside the triangle, where 1/w may pass through 0 */
        lom_float least = lom_min(p.one_over_w[0], lom_min(p.one_over_w[1], p.one_over_w[2]));
        p.sum = lom_max(p.sum, least);
    }
    p.b1 = p1 / p.sum;
    p.b2 = p2 / p.sum;
    return p;
}

/* The steps of the weights l1 and l2 of lines, a pixel right and down. */
static void find_line_steps(const struct lom_chunk *chunk, const struct lom_packet *packet, lom_float4 *step)
{
    float steps[LOM_LANES][4];
    int32_t row[LOM_LANES] = { 0 };
    for (int i = 0; i < packet->triangles; i++) {
        lom_triangle t;
        lom_find_line(chunk, &chunk->primitives[packet->triangle[i]], &t);
        steps[i][0] = t.step_x1 * t.inverse_area;
        steps[i][1] = t.step_y1 * t.inverse_area;
        steps[i][2] = steps[i][3] = 0;
        row[i] = 4 * i;
    }
    *step = lom_gather_rows(steps[0], lom_gather_int(row, packet->which));
}

/* The same of triangles: the steps of the edge functions over the area, as lom_find_triangle has them; double holds the
 * area. */
static void find_steps(const struct rows *rows, lom_float4 *step)
{
    lom_int x[3], y[3];
    for (int k = 0; k < 3; k++) {
        lom_float4 header = load_rows(rows, k, 0);
        x[k] = lom_as_int(header.x) - (k > 0 ? x[0] : lom_splat_int(0));
        y[k] = lom_as_int(header.y) - (k > 0 ? y[0] : lom_splat_int(0));
    }
    lom_float area = lom_narrow(lom_to_double(x[1]) * lom_to_double(y[2]) - lom_to_double(y[1]) * lom_to_double(x[2]));
    lom_mask turned = area < 0.0f;
    lom_float inverse = 1.0f / lom_abs(area), scale = lom_splat(SUBPIXELS);
    *step = (lom_float4){ lom_to_float((y[2] ^ turned) - turned) * scale * inverse,
                          lom_to_float((x[2] ^ ~turned) - ~turned) * scale * inverse,
                          lom_to_float((y[1] ^ ~turned) - ~turned) * scale * inverse,
                          lom_to_float((x[1] ^ turned) - turned) * scale * inverse };
}

/* d(b)/dx from b = l_i/w_i / sum: (d(l_i)/dx / w_i - b d(sum)/dx) / sum. */
static void find_slopes(const struct lom_chunk *chunk, const struct lom_packet *packet, const struct rows *rows,
                        const struct weights *p, lom_varyings *in)
{
    lom_float4 step;
    if (chunk->draw->lines)
        find_line_steps(chunk, packet, &step);
    else
        find_steps(rows, &step);
    lom_float a = step.x * p->one_over_w[1], b = step.z * p->one_over_w[2];
    lom_float sum_x = a + b - (step.x + step.z) * p->one_over_w[0];
    in->dx[0] = (a - p->b1 * sum_x) / p->sum;
    in->dx[1] = (b - p->b2 * sum_x) / p->sum;
    a = step.y * p->one_over_w[1];
    b = step.w * p->one_over_w[2];
    lom_float sum_y = a + b - (step.y + step.w) * p->one_over_w[0];
    in->dy[0] = (a - p->b1 * sum_y) / p->sum;
    in->dy[1] = (b - p->b2 * sum_y) / p->sum;
}

LOM_INLINE void interpolate(lom_float f0, lom_float f1, lom_float f2, const struct weights *p, int v, bool slope,
                            lom_varyings *in)
{
    lom_float d1 = f1 - f0, d2 = f2 - f0;
    lom_float low = lom_min(f0, lom_min(f1, f2)), high = lom_max(f0, lom_max(f1, f2));
    in->varying[v] = lom_clamp(f0 + p->b1 * d1 + p->b2 * d2, low, high);
    if (slope) {
        in->delta[0][v] = d1;
        in->delta[1][v] = d2;
    }
}

static void interpolate_varyings(const lom_shader *shader, const struct rows *rows, const struct weights *p,
                                 lom_varyings *in)
{
    for (int v = 0; v < shader->varyings; v += 4) {
        if ((shader->reads >> v & 15) == 0)
            continue;
        int offset = ROW_HEADER + v;
        lom_float4 f0 = load_rows(rows, 0, offset), f1 = load_rows(rows, 1, offset), f2 = load_rows(rows, 2, offset);
        uint32_t reads = shader->reads >> v, slopes = shader->differentiates >> v;
        if (reads & 1)
            interpolate(f0.x, f1.x, f2.x, p, v, slopes & 1, in);
        if (reads & 2)
            interpolate(f0.y, f1.y, f2.y, p, v + 1, slopes & 2, in);
        if (reads & 4)
            interpolate(f0.z, f1.z, f2.z, p, v + 2, slopes & 4, in);
        if (reads & 8)
            interpolate(f0.w, f1.w, f2.w, p, v + 3, slopes & 8, in);
    }
}

/* Those that are linear in the window: with its weights. */
static __attribute__((noinline)) void interpolate_linear(const lom_shader *shader, const struct rows *rows,
                                                         const struct lom_packet *packet, lom_varyings *in)
{
    struct weights p = { .b1 = packet->l[1], .b2 = packet->l[2] };
    for (int v = 0; v < shader->varyings; v++) {
        if ((shader->screen_linear & shader->reads) >> v & 1) {
            const int offset = ROW_HEADER + (v & ~3);
            const lom_float4 f0 = load_rows(rows, 0, offset), f1 = load_rows(rows, 1, offset),
                             f2 = load_rows(rows, 2, offset);
            const lom_float a[4] = { f0.x, f0.y, f0.z, f0.w }, b[4] = { f1.x, f1.y, f1.z, f1.w },
                            c[4] = { f2.x, f2.y, f2.z, f2.w };
            interpolate(a[v & 3], b[v & 3], c[v & 3], &p, v, false, in);
        }
    }
}

/* A value of each triangle of the packet to the lanes that are of it. */
LOM_INLINE lom_int spread(const struct lom_packet *packet, const int32_t *value)
{
    return packet->triangles == 1 ? lom_splat_int(value[0]) : lom_gather_int(value, packet->which);
}

static void copy_flat_varyings(const lom_shader *shader, const struct lom_chunk *chunk, const struct lom_packet *packet,
                               lom_varyings *in)
{
    const float *row[LOM_LANES];
    for (int i = 0; i < packet->triangles; i++) {
        const lom_primitive *p = &chunk->primitives[packet->triangle[i]];
        row[i] = chunk->rows + p->row[p->state >> TRIANGLE_PROVOKING & 3] + ROW_HEADER;
    }
    for (uint32_t flat = shader->flat & ((UINT32_C(1) << shader->varyings) - 1); flat != 0; flat &= flat - 1) {
        int v = __builtin_ctz(flat);
        int32_t value[LOM_LANES];
        for (int i = 0; i < packet->triangles; i++)
            memcpy(&value[i], row[i] + v, sizeof value[i]);
        in->varying[v] = lom_as_float(spread(packet, value));
        in->delta[0][v] = in->delta[1][v] = (lom_float){ 0 };
    }
}

static void find_position(const struct lom_tile *tile, const struct lom_packet *packet, const struct weights *p,
                          lom_varyings *in)
{
    int32_t front[LOM_LANES];
    lom_find_position(tile, &packet->places, in);
    in->z = packet->depth;
    in->w = 1.0f / p->sum;
    for (int i = 0; i < packet->triangles; i++)
        front[i] = -(int32_t)(tile->chunk->primitives[packet->triangle[i]].state >> TRIANGLE_FRONT & 1);
    in->front = spread(packet, front);
}

/* Depth test and write after the shader, for lanes at different pixels. */
static lom_mask late_depth(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, lom_float depth)
{
    const struct lom_draw *draw = tile->draw;
    int32_t *memory = (int32_t *)tile->depth;
    lom_float number = lom_select(depth == depth, depth, (lom_float){ 0 });
    lom_float units = lom_depth_units(tile->pass, lom_saturate(number));
    lom_float stored = lom_as_float(lom_load_places(memory, tile, places));
    lom_mask passed = mask & lom_compare_depth(draw->compare, units, stored);
    LOM_RECORD_HOOK(lom_record_late, tile, &units, &stored, &mask, &passed);
    if (draw->depth_write)
        lom_store_places(memory, tile, places, passed, lom_as_int(units));
    return passed;
}

/* Fragments of one packet may lie at one pixel; they land in lane order, which is submission order. What reads the
 * target (blending, late depth) goes in rounds of different pixels. */
void LOM_WIDE(lom_write_in_order)(struct lom_tile *tile, const struct lom_places *places, const lom_mask *shaded,
                                  bool apart, const lom_fragment *out)
{
    lom_mask mask = *shaded;
    const struct lom_draw *draw = tile->draw;
    bool late = lom_tests_late(tile);
    bool rounds = (late || draw->blends || LOM_RECORDS) && !apart;
    while (lom_any(mask)) {
        lom_mask round = rounds ? lom_first_at_pixels(tile, places->pixel, mask) : mask;
        mask &= ~round;
        if (late)
            round = late_depth(tile, places, round, out->depth);
        LOM_RECORD_HOOK(lom_record_write_begins, tile, places, &round);
        LOM_WIDE(lom_write_packet)(tile, places, &round, out->color);
        LOM_RECORD_HOOK(lom_record_write_ends, tile, places, &round, out->color);
    }
}

/* With draw->marks_edges. */
static __attribute__((noinline)) void mark_edges(struct lom_tile *tile, const struct lom_packet *packet)
{
    const lom_shader *shader = tile->draw->desc.shader;
    struct rows rows;
    lom_float4 step;
    if (tile->draw->lines) {
        LOM_WIDE(lom_mark_no_edges)(tile);
        return;
    }
    find_rows(tile->chunk, packet, &rows);
    find_steps(&rows, &step);
    LOM_WIDE(lom_mark_edges)(tile, packet, &step, shader->clip_distances != 0);
}

static __attribute__((noinline)) void shade_plainly(struct lom_tile *tile, const struct lom_packet *packet)
{
    const struct lom_chunk *chunk = tile->chunk;
    const lom_shader *shader = tile->draw->desc.shader;
    lom_varyings in;
    in.levels = NULL;
    LOM_RECORD_HOOK(lom_record_packet, tile, packet);
    if (shader->reads != 0 || shader->reads_position) {
        struct rows rows;
        find_rows(chunk, packet, &rows);
        struct weights p = find_weights(packet, &rows, shader->quads);
        interpolate_varyings(shader, &rows, &p, &in);
        if (shader->differentiates != 0)
            find_slopes(chunk, packet, &rows, &p, &in);
        if (shader->screen_linear != 0)
            interpolate_linear(shader, &rows, packet, &in);
        if (shader->flat != 0)
            copy_flat_varyings(shader, chunk, packet, &in);
        if (shader->reads_position)
            find_position(tile, packet, &p, &in);
        LOM_RECORD_HOOK(lom_record_weights, tile, &p.b1, &p.b2);
    }
    if (tile->draw->marks_edges)
        mark_edges(tile, packet);
    lom_run_shader(tile, packet, &in);
}

/* Whether the packet may be one of several of a triangle. */
LOM_INLINE bool has_facet(const struct lom_tile *tile, const struct lom_packet *packet)
{
    return packet->triangles == 1 && !tile->pass->one_by_one &&
           lom_kind_of(&tile->chunk->primitives[packet->triangle[0]]) != TRIANGLE_WINDOW;
}

void LOM_WIDE(lom_shade_packet)(struct lom_tile *tile, const struct lom_packet *packet)
{
    if (has_facet(tile, packet))
        LOM_WIDE(lom_shade_facet)(tile, packet);
    else
        shade_plainly(tile, packet);
}
