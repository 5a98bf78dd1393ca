/* Stage 5 of 7 for small triangles, packed. In: triangles of a tile that are drawn together. Out: the fragments that
 * pass the early depth test, LOM_LANES of any triangles at a time, to the fragment stage.
 *
 * Invariant: weights and depths are those of early.wide.c and raster.wide.c, which draw the same triangles one by one;
 * fragments at one pixel are tested in their order. */
#include "lanes/pair_products.h"
#include "pipeline/slots.h"

LOM_INLINE int slot_of(int32_t code)
{
    return (int)((uint32_t)code >> CODE_TRIANGLE);
}

/* Entries from `at` on, before `end`: as many as there are lanes, or as lie in so many slots. */
LOM_INLINE struct packed take(const struct lom_list *list, int at, int end)
{
    const int32_t *code = list->code + at;
    struct packed p = { .code = lom_load_int(code), .first = slot_of(code[0]), .count = LOM_LANES };
    int last = at + LOM_LANES <= end ? slot_of(code[LOM_LANES - 1]) : p.first + LOM_LANES;
    if (last - p.first >= LOM_LANES) {
        for (p.count = 1; at + p.count < end && p.count < LOM_LANES && slot_of(code[p.count]) < p.first + LOM_LANES;)
            p.count++;
        last = slot_of(code[p.count - 1]);
        p.code = lom_select_int(lom_lane_index() < p.count, p.code, lom_splat_int(code[p.count - 1]));
    }
    p.which = (lom_int)((lom_uint)p.code >> CODE_TRIANGLE) - p.first;
    p.triangles = last - p.first + 1;
    return p;
}

LOM_INLINE lom_int pixel_of(lom_int code)
{
    return code & ((1 << CODE_X) - 1);
}

/* Weights, of which l[0] is found only where somebody reads it. */
LOM_INLINE void weigh(const struct lom_list *list, const struct packed *p, lom_float l[3])
{
    lom_float4 edge = load_slots(list->slots, SLOT_STEP1, p->first, p->which);
    lom_float4 plane = load_slots(list->slots, SLOT_AREA, p->first, p->which);
    lom_int at = lom_make_pair(p->code >> CODE_X & 63, p->code >> CODE_Y & 63);
    lom_int e1 = lom_as_int(edge.z) + (lom_dot_pairs(at, lom_as_int(edge.x)) << SUBPIXEL_BITS);
    lom_int e2 = lom_as_int(edge.w) + (lom_dot_pairs(at, lom_as_int(edge.y)) << SUBPIXEL_BITS);
    l[0] = lom_to_float(lom_as_int(plane.x) - e1 - e2) * plane.y;
    l[1] = lom_to_float(e1) * plane.y;
    l[2] = lom_to_float(e2) * plane.y;
}

LOM_INLINE lom_float find_depth_lanes(const struct lom_list *list, const struct packed *p, const lom_float l[3])
{
    lom_float4 plane = load_slots(list->slots, SLOT_AREA, p->first, p->which);
    lom_float4 more = load_slots(list->slots, SLOT_DEPTH1, p->first, p->which);
    return lom_clamp(plane.z + l[1] * more.x + l[2] * more.y, plane.w, more.z);
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
    return draw->depth_write && !draw->late_depth ? rules[draw->compare] : DEPTH_STAYS;
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

/* The lanes that pass; lanes that are no entries repeat the last one that is, and change nothing. */
LOM_INLINE lom_mask test_depths(struct lom_tile *tile, lom_int place, lom_float depth)
{
    const struct lom_draw *draw = tile->draw;
    lom_float units = lom_depth_units(tile->pass, depth), old;
    int32_t pixel[LOM_LANES];
    lom_store_int(pixel, place);
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
        old = lom_gather(tile->depth, place);
        break;
    }
    return lom_compare_depth(draw->compare, units, old);
}

/* Leaves of the entries that are not tested yet those that pass. */
static void test_entries(struct lom_tile *tile)
{
    struct lom_list *list = &tile->list;
    int passed = list->tested;
    for (int at = list->tested, step; at < list->count; at += step) {
        struct packed p = take(list, at, list->count);
        lom_float l[3];
        weigh(list, &p, l);
        lom_mask covered = test_depths(tile, pixel_of(p.code), find_depth_lanes(list, &p, l));
        covered &= lom_lane_index() < p.count;
        step = p.count;
        lom_int next = lom_load_int(list->code + at + step); /* the store of a whole packet may reach them */
        lom_compress((float *)list->code + passed, covered, lom_as_float(p.code));
        lom_store_int(list->code + at + step, next);
        passed += (int)lom_count(covered);
    }
    list->count = passed;
}

static void shade(struct lom_tile *tile, const struct packed *p)
{
    const struct lom_list *list = &tile->list;
    struct lom_packet packet;
    weigh(list, p, packet.l);
    packet.depth = (lom_float){ 0 };
    if (tile->draw->queues_depth)
        packet.depth = find_depth_lanes(list, p, packet.l);
    packet.which = p->which;
    packet.triangles = p->triangles;
    packet.covered = lom_lane_index() < p->count;
    packet.places.block = false;
    lom_store_int(packet.places.pixel, pixel_of(p->code));
#if LOM_LANES > 4
    LOM_WIDE(lom_shade_slots)(tile, p, &packet);
#else
    for (int i = 0; i < p->triangles; i++)
        packet.triangle[i] = (int32_t)list->number[p->first + i];
    LOM_WIDE(lom_shade_packet)(tile, &packet);
#endif
}

/* Shades the entries, the last ones only where they fill a packet or `all` are asked for; those that are left come first
 * then. */
static void shade_entries(struct lom_tile *tile, bool all)
{
    struct lom_list *list = &tile->list;
    int at = 0;
    while (list->count - at >= LOM_LANES || (all && at < list->count)) {
        struct packed p = take(list, at, list->count);
        shade(tile, &p);
        at += p.count;
    }
    list->count -= at;
    lom_store_int(list->code, lom_load_int(list->code + at));
}

/* Entries that are left keep their triangles, in slots of their own. */
static void keep_triangles(struct lom_list *list)
{
    int slot = -1, last = -1;
    for (int i = 0; i < list->count; i++) {
        int old = slot_of(list->code[i]);
        slot += old != last;
        last = old;
        list->number[slot] = list->number[old];
        list->code[i] = (list->code[i] & ((1 << CODE_TRIANGLE) - 1)) | (int32_t)((uint32_t)slot << CODE_TRIANGLE);
    }
    list->triangles = slot + 1;
}

void LOM_WIDE(lom_drain_list)(struct lom_tile *tile, bool all)
{
    struct lom_list *list = &tile->list;
    bool shades = tile->draw->desc.shader->fragment[tile->draw->variant] != NULL;
    if (list->triangles == 0)
        return;
    if (tile->queue.count > 0 && shades)
        LOM_WIDE(lom_flush)(tile);
    LOM_WIDE(lom_fill_slots)(tile);
#if LOM_LANES > 4
    if (shades)
        LOM_WIDE(lom_fill_values)(tile);
#endif
    int slot = list->kept;
    while (slot < list->triangles) {
        int before = list->count;
        list->tested = before;
        slot = LOM_WIDE(lom_cover_slots)(tile, slot);
        if (tile->tests_early)
            test_entries(tile);
        tile->fragments += (uint64_t)(list->count - before);
        if (tile->rejects_early)
            test_entries(tile);
        if (shades)
            shade_entries(tile, false);
        else
            list->count = 0;
    }
    if (shades && all)
        shade_entries(tile, true);
    keep_triangles(list);
    list->kept = list->triangles;
}
