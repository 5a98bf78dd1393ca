/* Stage 5 of 7 for small triangles, packed. In: the pixels that small triangles cover, a code each, in order. Out:
 * those that pass the early depth test, LOM_LANES of any triangles at a time, to the fragment stage or into the queue.
 *
 * Invariant: weights and depths are those of early.wide.c and raster.wide.c, which draw the same triangles one by one;
 * fragments at one pixel are tested in their order. */
#include "pipeline/window.h"

enum { WORDS = sizeof(lom_triangle) / sizeof(float) };

/* LOM_LANES entries of the list with what was found of them. */
struct packed {
    lom_int pixel, x, y; /* place in tile memory; pixel of the tile */
    lom_int which;       /* a lane's triangle, counted from the packet's first */
    const int32_t *row;  /* where the triangles' records begin, in words */
    int triangles;
    lom_float l[3], depth;
};

/* An edge function of small triangles: the first record's words and the steps. Positions in pixels from the record's
 * first are below 2^7 and steps over 256 below 2^14: their products and sum are exact in float, and the sum is an
 * integer below 2^22. */
LOM_INLINE lom_int edge_at(lom_float start, lom_float step_x, lom_float step_y, lom_float x, lom_float y)
{
    const float unit = 1.0f / SUBPIXELS;
    lom_float steps = x * (step_x * unit) + y * (step_y * unit);
    return lom_as_int(start) + (lom_bounded_to_int(steps) << SUBPIXEL_BITS);
}

LOM_INLINE void weigh(const struct lom_tile *tile, struct packed *p)
{
    const float *words = (const float *)(const void *)tile->chunk->triangles;
    lom_float4 step = lom_pick_rows(words, p->row, p->triangles, p->which);
    lom_float4 plane = lom_pick_rows(words + 4, p->row, p->triangles, p->which);
    lom_float4 start = lom_pick_rows(words + 8, p->row, p->triangles, p->which);
    lom_int first = lom_as_int(start.w);
    lom_float x = lom_to_float(p->x - (first & 0xfffe)), y = lom_to_float(p->y - (first >> 16 & 0xfffe));
    lom_int e1 = edge_at(start.y, step.x, step.y, x, y), e2 = edge_at(start.z, step.z, step.w, x, y);
    p->l[0] = lom_to_float(lom_as_int(start.x) - e1 - e2) * plane.x;
    p->l[1] = lom_to_float(e1) * plane.x;
    p->l[2] = lom_to_float(e2) * plane.x;
    lom_float z0 = plane.y, z1 = z0 + plane.z, z2 = z0 + plane.w;
    lom_float low = lom_min(lom_min(z0, z1), z2), high = lom_max(lom_max(z0, z1), z2);
    p->depth = lom_clamp(z0 + p->l[1] * plane.z + p->l[2] * plane.w, low, high);
}

/* What the test leaves in tile memory, which is the same whether a fragment passed or not. */
typedef enum { DEPTH_STAYS, DEPTH_LESSER, DEPTH_GREATER, DEPTH_REPLACED } depth_rule;

static depth_rule rule_of(const struct lom_draw *draw)
{
    static const depth_rule rules[] = {
        [LOM_COMPARE_NEVER] = DEPTH_STAYS,           [LOM_COMPARE_LESS] = DEPTH_LESSER,
        [LOM_COMPARE_EQUAL] = DEPTH_STAYS,           [LOM_COMPARE_LESS_EQUAL] = DEPTH_LESSER,
        [LOM_COMPARE_GREATER] = DEPTH_GREATER,       [LOM_COMPARE_NOT_EQUAL] = DEPTH_REPLACED,
        [LOM_COMPARE_GREATER_EQUAL] = DEPTH_GREATER, [LOM_COMPARE_ALWAYS] = DEPTH_REPLACED
    };
    return draw->depth_write ? rules[draw->compare] : DEPTH_STAYS;
}

/* Leaves depths in memory, one after the other, since two may go to one place; gives what was there before. */
LOM_INLINE lom_float exchange(float *memory, const int32_t *pixel, lom_float depth, depth_rule rule)
{
    float old[LOM_LANES], z[LOM_LANES];
    lom_store(z, depth);
    for (int i = 0; i < LOM_LANES; i++) {
        float *at = memory + pixel[i];
        old[i] = *at;
        *at = rule == DEPTH_LESSER    ? z[i] < old[i] ? z[i] : old[i]
                 : rule == DEPTH_GREATER ? z[i] > old[i] ? z[i] : old[i]
                                         : z[i];
    }
    return lom_load(old);
}

/* The lanes that pass; lanes that are none repeat the last one that is, and change nothing. */
LOM_INLINE lom_mask test_depths(struct lom_tile *tile, const struct packed *p)
{
    const struct lom_draw *draw = tile->draw;
    lom_float units = lom_depth_units(tile->pass, p->depth), old;
    int32_t pixel[LOM_LANES];
    lom_store_int(pixel, p->pixel);
    switch (rule_of(draw)) {
    case DEPTH_LESSER:
        old = exchange(tile->depth, pixel, units, DEPTH_LESSER);
        break;
    case DEPTH_GREATER:
        old = exchange(tile->depth, pixel, units, DEPTH_GREATER);
        break;
    case DEPTH_REPLACED:
        old = exchange(tile->depth, pixel, units, DEPTH_REPLACED);
        break;
    default:
        old = lom_gather(tile->depth, p->pixel);
        break;
    }
    return lom_compare_depth(draw->compare, units, old);
}

static void shade(struct lom_tile *tile, const struct packed *p, lom_mask covered)
{
    struct lom_packet packet;
    for (int k = 0; k < 3; k++)
        packet.l[k] = p->l[k];
    packet.depth = p->depth;
    packet.which = p->which;
    packet.triangles = p->triangles;
    for (int i = 0; i < p->triangles; i++)
        packet.triangle[i] = p->row[i] / WORDS;
    packet.covered = covered;
    packet.places.block = false;
    lom_store_int(packet.places.pixel, p->pixel);
    LOM_WIDE(lom_shade_packet)(tile, &packet);
}

static void enqueue(struct lom_tile *tile, const struct packed *p, lom_mask covered)
{
    struct lom_fragments f;
    for (int k = 0; k < 3; k++)
        f.l[k] = p->l[k];
    f.depth = p->depth;
    f.pixel = p->pixel;
    f.triangle = (lom_int)((lom_uint)lom_gather_int(p->row, p->which) / WORDS);
    f.taken = f.covered = covered;
    LOM_WIDE(lom_enqueue)(tile, &f);
}

/* Entries `at` to `end` (one past the last) of the list. */
LOM_INLINE void run_packed(struct lom_tile *tile, int at, int end, bool tests, bool shades)
{
    const struct lom_list *list = &tile->list;
    lom_int code = lom_load_int(list->code + at);
    int count = end - at < LOM_LANES ? end - at : LOM_LANES;
    int first = (int)((uint32_t)list->code[at] >> CODE_TRIANGLE);
    int last = (int)((uint32_t)list->code[at + count - 1] >> CODE_TRIANGLE);
    struct packed p = { .pixel = code & ((1 << CODE_X) - 1),
                        .x = (code >> CODE_X & 63) + tile->x,
                        .y = (code >> CODE_Y & 63) + tile->y,
                        .which = (lom_int)((lom_uint)code >> CODE_TRIANGLE) - first,
                        .row = list->row + first,
                        .triangles = last - first + 1 };
    weigh(tile, &p);
    lom_mask covered = lom_lane_index() < count;
    if (tests)
        covered &= test_depths(tile, &p);
    uint32_t passed = lom_count(covered);
    tile->fragments += passed;
    if (!shades || passed == 0)
        return;
    if ((int)passed == count && count == LOM_LANES && tile->queue.count == 0)
        shade(tile, &p, covered);
    else
        enqueue(tile, &p, covered);
}

void LOM_WIDE(lom_drain_list)(struct lom_tile *tile)
{
    struct lom_list *list = &tile->list;
    bool shades = tile->draw->desc.shader->fragment[tile->draw->variant] != NULL;
    if (list->count == 0)
        return;
    lom_store_int(list->code + list->count, lom_splat_int(list->code[list->count - 1]));
    for (int i = 0; i < 4; i++) /* lom_pick_rows reads on to a multiple of 4 */
        list->row[list->triangles + i] = list->row[0];
    for (int at = 0; at < list->count; at += LOM_LANES)
        run_packed(tile, at, list->count, tile->tests_early, shades);
    list->count = list->triangles = 0;
}
