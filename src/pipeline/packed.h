/* Entries of a tile's list, LOM_LANES at a time: pixels of small triangles that are drawn together. */
#ifndef LOM_PIPELINE_PACKED_H
#define LOM_PIPELINE_PACKED_H

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

/* Edge functions 1 and 2 of the entries' triangles at the centres of their pixels, and what they change. */
struct entry_edges {
    lom_int e1, e2, area, step1, step2;
    lom_float inverse;
};

LOM_INLINE struct entry_edges find_entry_edges(const struct lom_list *list, const struct packed *p)
{
    lom_float4 edge = load_slots(list->slots, SLOT_STEP1, p->first, p->which);
    lom_float4 plane = load_slots(list->slots, SLOT_AREA, p->first, p->which);
    lom_int at = lom_make_pair(p->code >> CODE_X & 63, p->code >> CODE_Y & 63);
    struct entry_edges e = {
        .step1 = lom_as_int(edge.x), .step2 = lom_as_int(edge.y), .area = lom_as_int(plane.x), .inverse = plane.y
    };
    e.e1 = lom_as_int(edge.z) + (lom_dot_pairs(at, e.step1) << SUBPIXEL_BITS);
    e.e2 = lom_as_int(edge.w) + (lom_dot_pairs(at, e.step2) << SUBPIXEL_BITS);
    return e;
}

/* Weights, of which l[0] is found only where somebody reads it. */
LOM_INLINE void weigh_entries(const struct entry_edges *e, lom_float l[3])
{
    l[0] = lom_to_float(e->area - e->e1 - e->e2) * e->inverse;
    l[1] = lom_to_float(e->e1) * e->inverse;
    l[2] = lom_to_float(e->e2) * e->inverse;
}

LOM_INLINE void weigh(const struct lom_list *list, const struct packed *p, lom_float l[3])
{
    struct entry_edges e = find_entry_edges(list, p);
    weigh_entries(&e, l);
}

/* The edge functions at places that lie so far from the centres: pairs of sixteenths of a pixel. */
LOM_INLINE struct entry_edges move_entries(struct entry_edges e, lom_int sixteenths)
{
    e.e1 += lom_dot_pairs(sixteenths, e.step1) << (SUBPIXEL_BITS - 4);
    e.e2 += lom_dot_pairs(sixteenths, e.step2) << (SUBPIXEL_BITS - 4);
    return e;
}

/* The depths of the entries' triangles: at vertex 0, what the others add, the range. */
struct entry_depth {
    lom_float at, by1, by2, low, high;
};

LOM_INLINE struct entry_depth find_entry_depth(const struct lom_list *list, const struct packed *p)
{
    lom_float4 plane = load_slots(list->slots, SLOT_AREA, p->first, p->which);
    lom_float4 more = load_slots(list->slots, SLOT_DEPTH1, p->first, p->which);
    return (struct entry_depth){ plane.z, more.x, more.y, plane.w, more.z };
}

LOM_INLINE lom_float interpolate_entries(const struct entry_depth *d, const lom_float l[3])
{
    return lom_clamp(d->at + l[1] * d->by1 + l[2] * d->by2, d->low, d->high);
}

LOM_INLINE lom_float find_depth_lanes(const struct lom_list *list, const struct packed *p, const lom_float l[3])
{
    struct entry_depth d = find_entry_depth(list, p);
    return interpolate_entries(&d, l);
}

/* What the test leaves in tile memory, which is the same whether a fragment passed or not. */
typedef enum { DEPTH_STAYS, DEPTH_LESSER, DEPTH_GREATER, DEPTH_REPLACED } depth_rule;

LOM_INLINE depth_rule rule_of(const struct lom_draw *draw)
{
    static const depth_rule rules[] = {
        [LOM_COMPARE_NEVER] = DEPTH_STAYS,           [LOM_COMPARE_LESS] = DEPTH_LESSER,
        [LOM_COMPARE_EQUAL] = DEPTH_STAYS,           [LOM_COMPARE_LESS_EQUAL] = DEPTH_LESSER,
        [LOM_COMPARE_GREATER] = DEPTH_GREATER,       [LOM_COMPARE_NOT_EQUAL] = DEPTH_REPLACED,
        [LOM_COMPARE_GREATER_EQUAL] = DEPTH_GREATER, [LOM_COMPARE_ALWAYS] = DEPTH_REPLACED
    };
    return draw->depth_write && !draw->late_depth ? rules[draw->compare] : DEPTH_STAYS;
}

/* Where pixels have several samples an entry has more than its code, tile->sampled->list: the samples that it is written to,
 * and above those the ones that its triangle covers, of which some may have failed the early depth test. */
enum { ENTRY_COVERED = 16 };

/* Entries of the slots from `slot` on, as far as there is room, which cover a sample that passes the early depth test
 * (pack_samples.wide.c); the next slot. */
int LOM_WIDE(lom_cover_samples)(struct lom_tile *tile, int slot);
/* What shading an entry needs of the list there, from entry `at` on: the weights at the place of shading, samples and places,
 * and, with draw->late_depth, depths at the samples, which are written to `depth`. */
void LOM_WIDE(lom_fill_entry_samples)(const struct lom_tile *tile, const struct packed *p, int at,
                                      struct lom_packet *packet, lom_float depth[LOM_MAX_SAMPLES]);

#endif
