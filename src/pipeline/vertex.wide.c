/* Stage 1 of 7: vertex. In: a chunk's range (or list) of vertex numbers. Out: for each a row {x, y, depth, 1/w,
 * varyings, distances}, its clip position and its outcode. Invariant: a row is a function of the vertex alone. */
#include "pipeline/project.h"
#include "pipeline/record.h"
#include "pipeline/stage_rows.h"
#include "pipeline/variants.h"

/* Signed comparison of numbers with the highest bit turned over is unsigned comparison of the numbers. */
static const int32_t turned = INT32_MIN;

void LOM_WIDE(lom_find_extremes)(const uint32_t *index, size_t count, uint32_t *low, uint32_t *high)
{
    lom_int least = lom_splat_int((int32_t)index[0] ^ turned), most = least;
    size_t i = 0;
    for (; i + LOM_LANES <= count; i += LOM_LANES) {
        lom_int x = lom_load_int((const int32_t *)index + i) ^ turned;
        least = lom_min_int(least, x);
        most = lom_max_int(most, x);
    }
    *low = *high = index[0];
    for (int lane = 0; lane < LOM_LANES && i > 0; lane++) {
        uint32_t a = (uint32_t)(least[lane] ^ turned), b = (uint32_t)(most[lane] ^ turned);
        *low = a < *low ? a : *low;
        *high = b > *high ? b : *high;
    }
    for (; i < count; i++) {
        *low = index[i] < *low ? index[i] : *low;
        *high = index[i] > *high ? index[i] : *high;
    }
}

void LOM_WIDE(lom_rebase_indices)(const uint32_t *index, size_t count, uint32_t base, uint32_t *rebased)
{
    size_t i = 0;
    for (; i + LOM_LANES <= count; i += LOM_LANES)
        lom_store_int((int32_t *)rebased + i, lom_load_int((const int32_t *)index + i) - (int32_t)base);
    for (; i < count; i++)
        rebased[i] = index[i] - base;
}

/* LOM_LANES vertex numbers of a chunk from `first` on, the last one repeated past its end. */
struct numbers {
    uint32_t number[LOM_LANES], largest;
};

static struct numbers find_numbers(const struct lom_chunk *chunk, size_t first)
{
    struct numbers n;
    size_t left = chunk->vertex_count - first;
    lom_int row = lom_min_int(lom_lane_index(), lom_splat_int(left < LOM_LANES ? (int32_t)left - 1 : LOM_LANES - 1));
    if (!chunk->listed) {
        uint32_t start = chunk->vertex_base + (uint32_t)first;
        lom_store_int((int32_t *)n.number, row + (int32_t)start);
        n.largest = start + (uint32_t)row[LOM_LANES - 1];
        return n;
    }
    n.largest = 0;
    for (int i = 0; i < LOM_LANES; i++) {
        n.number[i] = chunk->assembly->vertex_list[chunk->first_row + first + (size_t)row[i]];
        n.largest = n.number[i] > n.largest ? n.number[i] : n.largest;
    }
    return n;
}

/* The vertices as four floats each; every read stays inside attribute->size. */
static void fetch_floats(const lom_attribute *attribute, const struct numbers *n, int components, lom_float4 *out)
{
    float copies[LOM_LANES][4];
    const float *rows[LOM_LANES];
    const uint8_t *data = attribute->data;
    bool aligned = (uintptr_t)data % 4 == 0 && attribute->stride % 4 == 0;
    bool whole = aligned && (size_t)n->largest * attribute->stride + 16 <= attribute->size;
    for (int i = 0; i < LOM_LANES; i++) {
        const uint8_t *source = data + (size_t)n->number[i] * attribute->stride;
        if (!whole) {
            memset(copies[i], 0, sizeof copies[i]);
            memcpy(copies[i], source, (size_t)components * 4);
        }
        rows[i] = whole ? (const float *)(const void *)source : copies[i];
    }
    *out = lom_load_rows(rows, 0);
    if (components < 2)
        out->y = (lom_float){ 0 };
    if (components < 3)
        out->z = (lom_float){ 0 };
    if (components < 4)
        out->w = lom_splat(1.0f);
}

static void fetch_bytes(const lom_attribute *attribute, const struct numbers *n, lom_float4 *out)
{
    for (int i = 0; i < LOM_LANES; i++) {
        const uint8_t *source = (const uint8_t *)attribute->data + (size_t)n->number[i] * attribute->stride;
        out->x[i] = (float)source[0] / 255.0f;
        out->y[i] = (float)source[1] / 255.0f;
        out->z[i] = (float)source[2] / 255.0f;
        out->w[i] = (float)source[3] / 255.0f;
    }
}

/* An attribute of instances is one value for all of the chunk's vertices. */
static void find_instanced(const struct lom_chunk *chunk, lom_attribute attribute[LOM_MAX_ATTRIBUTES])
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    for (int a = 0; a < desc->shader->attributes; a++) {
        attribute[a] = desc->attribute[a];
        if (desc->divisor[a] == 0 || attribute[a].kind == LOM_ATTRIBUTE_NONE)
            continue;
        size_t offset = (size_t)(chunk->instance / desc->divisor[a]) * attribute[a].stride;
        attribute[a].data = (const uint8_t *)attribute[a].data + offset;
        attribute[a].size -= offset;
        attribute[a].stride = 0;
    }
}

static void fetch(const lom_attribute *attributes, int count, const struct numbers *n, lom_attributes *in)
{
    for (int a = 0; a < count; a++) {
        const lom_attribute *attribute = &attributes[a];
        lom_float4 *out = &in->attribute[a];
        switch (attribute->kind) {
        case LOM_ATTRIBUTE_NONE:
            *out = (lom_float4){ .w = lom_splat(1.0f) };
            break;
        case LOM_ATTRIBUTE_UNORM8X4:
            fetch_bytes(attribute, n, out);
            break;
        default:
            fetch_floats(attribute, n, (int)attribute->kind - LOM_ATTRIBUTE_FLOAT1 + 1, out);
        }
    }
}

/* Not finite, or so large that arithmetic on it would not stay finite. */
LOM_INLINE lom_mask is_wild(lom_float x)
{
    return ~(lom_abs(x) <= 0x1p124f); /* FLT_MAX / 16 */
}

/* Outcodes of clip positions, as the planes of lom_clip_triangle see them. A position on the rounded edge of the guard
 * band has its code: the band's exact edge may lie before it. Those before the edge are exactly inside, and so is what
 * their quotients round to: lom_clip_triangle leaves them and their rows as they are. */
static lom_int classify(const struct lom_pass *pass, const struct lom_draw *draw, lom_float4 p)
{
    lom_float near_distance, far_distance;
    if (pass->desc.clip_range == LOM_CLIP_ZERO_TO_W) {
        near_distance = p.w - p.z;
        far_distance = p.z;
    } else {
        near_distance = p.z + p.w;
        far_distance = p.w - p.z;
    }
    struct lom_guard guard = lom_guard_of(&draw->desc.viewport);
    lom_mask out = (lom_abs(p.x) >= p.w * guard.x) | (lom_abs(p.y) >= p.w * guard.y);
    return ((near_distance < 0.0f) & CODE_NEAR) | ((far_distance < 0.0f) & CODE_FAR) | (out & CODE_GUARD) |
           ((p.w < LOM_SMALLEST_W) & CODE_W) |
           ((is_wild(p.x) | is_wild(p.y) | is_wild(p.z) | is_wild(p.w)) & CODE_INVALID);
}

/* Perspective division, viewport, snapping (to nearest even) of positions that need no clipping; the rest gets zeros.
 */
static lom_float4 project(const struct lom_pass *pass, const struct lom_draw *draw, lom_float4 p, lom_int codes)
{
    struct lom_projection f = lom_projection_of(pass, draw);
    lom_mask inside = (codes & (CODE_CLIP | CODE_INVALID)) == 0;
    lom_float w = lom_select(inside, p.w, lom_splat(1.0f));
    lom_float one_over_w = 1.0f / w;
    lom_float x = lom_select(inside, p.x, (lom_float){ 0 }) / w * f.x_scale + f.x_offset;
    lom_float y = lom_select(inside, p.y, (lom_float){ 0 }) / w * f.y_scale + f.y_offset;
    lom_float z = lom_select(inside, p.z, (lom_float){ 0 }) / w * f.z_scale + f.z_offset;
    z = lom_clamp(z, lom_splat(f.z_low), lom_splat(f.z_high));
    return (lom_float4){ lom_as_float(lom_to_int(lom_round(x))), lom_as_float(lom_to_int(lom_round(y))), z,
                         one_over_w };
}

static void write_distances(const struct lom_draw *draw, lom_vertex *vertex, float *row, lom_int at, lom_int *codes)
{
    lom_float bound = lom_splat(LOM_LARGEST_DISTANCE);
    for (int i = 0; i < draw->distances; i++) {
        lom_float d = vertex->distance[i];
        *codes |= (d != d) & CODE_INVALID;
        *codes |= (d < 0.0f) & (1 << i);
        vertex->distance[i] = lom_clamp(d, -bound, bound);
    }
    for (int i = 0; i < draw->distances; i += 4)
        lom_scatter_rows(row + draw->distance_offset + i, at,
                         (lom_float4){ vertex->distance[i], vertex->distance[i + 1], vertex->distance[i + 2],
                                       vertex->distance[i + 3] });
}

/* A sprite's half sides in pixels, y down: the derivative of x / w along an axis is (axis.x - (x / w) axis.w) / w. */
static void write_axes(const struct lom_pass *pass, const struct lom_draw *draw, const lom_vertex *vertex, float *row,
                       lom_int at, lom_int codes)
{
    struct lom_projection f = lom_projection_of(pass, draw);
    lom_mask inside = (codes & (CODE_CLIP | CODE_INVALID)) == 0;
    lom_float w = lom_select(inside, vertex->position.w, lom_splat(1.0f)), side[4];
    lom_float x = vertex->position.x / w, y = vertex->position.y / w;
    for (int i = 0; i < 2; i++) {
        const lom_float4 *axis = &vertex->axis[i];
        side[2 * i] = (axis->x - x * axis->w) / w * (f.x_scale / SUBPIXELS);
        side[2 * i + 1] = (axis->y - y * axis->w) / w * (f.y_scale / SUBPIXELS);
    }
    lom_scatter_rows(row + draw->axis_offset, at, (lom_float4){ side[0], side[1], side[2], side[3] });
}

/* Half the side of a point's square: a whole number of 1/512 of a pixel. */
static void write_size(const struct lom_draw *draw, lom_float size, float *row, lom_int at)
{
    enum { LARGEST_SIZE = 32768 };
    size = lom_select(size > 0.0f, lom_min(size, lom_splat(LARGEST_SIZE)), (lom_float){ 0 });
    lom_float half = lom_round(size * SUBPIXELS) * (0.5f / SUBPIXELS);
    lom_scatter_rows(row + draw->axis_offset, at, (lom_float4){ half, { 0 }, { 0 }, half });
}

static void write_codes(struct lom_chunk *chunk, size_t first, lom_int codes)
{
    if (!lom_any(codes != 0)) {
        memset(chunk->assembly->codes + first, 0, LOM_LANES * sizeof chunk->assembly->codes[0]);
        return;
    }
    for (int i = 0; i < LOM_LANES; i++) {
        chunk->assembly->codes[first + (size_t)i] = (uint16_t)codes[i];
        chunk->any_code |= (unsigned)codes[i];
    }
}

static void write_packet(const struct lom_pass *pass, struct lom_chunk *chunk, size_t first, lom_vertex *vertex)
{
    const struct lom_draw *draw = chunk->draw;
    lom_int at = lom_lane_index() * draw->row_floats;
    float *row = chunk->rows + first * (size_t)draw->row_floats;
    lom_int codes = classify(pass, draw, vertex->position);
    if (draw->clamps_points)
        codes &= ~(CODE_NEAR | CODE_FAR);
    lom_scatter_rows(chunk->assembly->clip + first * 4, lom_lane_index() * 4, vertex->position);
    lom_scatter_rows(row, at, project(pass, draw, vertex->position, codes));
    for (int v = 0; v < draw->desc.shader->varyings; v += 4)
        lom_scatter_rows(
            row + ROW_HEADER + v, at,
            (lom_float4){ vertex->varying[v], vertex->varying[v + 1], vertex->varying[v + 2], vertex->varying[v + 3] });
    write_distances(draw, vertex, row, at, &codes);
    if (draw->desc.topology == LOM_SPRITES)
        write_axes(pass, draw, vertex, row, at, codes);
    else if (draw->sprites)
        write_size(draw, vertex->point_size, row, at);
    write_codes(chunk, first, codes);
}

/* Rows between stages: apart, so that the loop of all other draws stays as it is without them. */
__attribute__((noinline)) static void take_made(const struct lom_chunk *chunk, size_t first, lom_vertex *vertex)
{
    load_vertex(chunk->draw, chunk->made_rows, lanes_from(first, chunk->vertex_count), vertex);
}

__attribute__((noinline)) static void keep(const struct lom_chunk *chunk, size_t first, const lom_vertex *vertex)
{
    store_vertex(chunk->draw, chunk->kept_rows + first * (size_t)chunk->draw->stage_pitch, vertex);
}

/* The vertices at hand. */
static void shade_range(const struct lom_pass *pass, struct lom_chunk *chunk, const lom_attribute *attributes,
                        lom_attributes *in, lom_vertex *vertex)
{
    const struct lom_draw *draw = chunk->draw;
    lom_vertex_function *shade = draw->desc.shader->vertex[draw->variant];
    for (size_t first = 0; first < chunk->vertex_count; first += LOM_LANES) {
        if (chunk->needed != NULL && !chunk->needed[first / NEEDED_VERTICES])
            continue;
        if (__builtin_expect(chunk->made_rows != NULL, 0))
            take_made(chunk, first, vertex);
        else {
            chunk->vertices_shaded += chunk->vertex_count - first < LOM_LANES ? chunk->vertex_count - first : LOM_LANES;
            struct numbers n = find_numbers(chunk, first);
            memcpy(&in->vertex, n.number, sizeof n.number);
            fetch(attributes, draw->desc.shader->attributes, &n, in);
            vertex->point_size = lom_splat(1);
            LOM_RECORD_HOOK(lom_record_attributes, in, draw->desc.shader->attributes);
            shade(vertex, in, chunk->uniforms);
        }
        if (__builtin_expect(chunk->kept_rows != NULL, 0))
            keep(chunk, first, vertex);
        else
            write_packet(pass, chunk, chunk->first_row + first, vertex);
    }
}

void LOM_WIDE(lom_shade_vertices)(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    const struct lom_draw *draw = chunk->draw;
    lom_vertex vertex;
    lom_attributes in;
    lom_attribute own[LOM_MAX_ATTRIBUTES];
    const lom_attribute *attributes = draw->instanced ? own : draw->desc.attribute;
    if (draw->instanced)
        find_instanced(chunk, own);
    memset(&vertex, 0, sizeof vertex);
    memset(&in, 0, sizeof in);
    in.instance = lom_splat_int(chunk->instance);
    const size_t parts = chunk->parts != NULL ? chunk->part_count : 1;
    for (size_t part = 0; part < parts; part++) {
        if (chunk->parts != NULL)
            lom_begin_part(pass, chunk, part);
        shade_range(pass, chunk, attributes, &in, &vertex);
    }
}
