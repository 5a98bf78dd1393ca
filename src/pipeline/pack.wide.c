/* Stage 5 of 7 for small triangles, packed. In: triangles of a tile that are drawn together. Out: the fragments that
 * pass the early depth test, LOM_LANES of any triangles at a time, to the fragment stage.
 *
 * Invariant: weights and depths are those of early.wide.c and raster.wide.c, which draw the same triangles one by one;
 * fragments at one pixel are tested in their order. */
#include "pipeline/packed.h"

/* Numbers as lanes, in registers: by memory the load of all would wait for the stores of each. */
LOM_INLINE lom_float join_lanes(const float x[LOM_LANES])
{
#if LOM_LANES == 16
    return (lom_float){ x[0], x[1], x[2],  x[3],  x[4],  x[5],  x[6],  x[7],
                        x[8], x[9], x[10], x[11], x[12], x[13], x[14], x[15] };
#elif LOM_LANES == 8
    return (lom_float){ x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7] };
#else
    return (lom_float){ x[0], x[1], x[2], x[3] };
#endif
}

/* Leaves depths in memory, one after the other, since two may go to one place; gives what was there before. */
LOM_INLINE lom_float exchange(float *memory, lom_int place, lom_float depth, depth_rule rule)
{
    float old[LOM_LANES], z[LOM_LANES];
    uint32_t pixel[LOM_LANES];
    lom_store(z, depth);
    lom_store_int((int32_t *)pixel, place);
    for (int i = 0; i < LOM_LANES; i++) {
        float *at = memory + pixel[i];
        old[i] = *at;
        *at = rule == DEPTH_LESSER    ? z[i] < old[i] ? z[i] : old[i]
                 : rule == DEPTH_GREATER ? z[i] > old[i] ? z[i] : old[i]
                                         : z[i];
    }
    return join_lanes(old);
}

/* The lanes that pass; lanes that are no entries repeat the last one that is, and change nothing. */
LOM_INLINE lom_mask test_depths(float *memory, lom_compare compare, lom_int place, lom_float units, depth_rule rule)
{
    lom_float old;
    if (rule == DEPTH_STAYS)
        old = lom_gather(memory, place);
    else
        old = exchange(memory, place, units, rule);
    return lom_compare_depth(compare, units, old);
}

LOM_INLINE void test_by_rule(struct lom_tile *tile, depth_rule rule)
{
    struct lom_list *list = &tile->list;
    float *memory = tile->depth;
    const float scale = (float)tile->pass->depth_scale;
    const lom_compare compare = tile->draw->compare;
    int passed = list->tested;
    for (int at = list->tested, step; at < list->count; at += step) {
        struct packed p = take(list, at, list->count);
        lom_float l[3];
        weigh(list, &p, l);
        lom_float units = lom_scale_depth(scale, find_depth_lanes(list, &p, l));
        lom_mask covered = test_depths(memory, compare, pixel_of(p.code), units, rule);
        covered &= lom_lane_index() < p.count;
        step = p.count;
        lom_int next = lom_load_int(list->code + at + step); /* the store of a whole packet may reach them */
        lom_compress((float *)list->code + passed, covered, lom_as_float(p.code));
        lom_store_int(list->code + at + step, next);
        passed += (int)lom_count(covered);
    }
    list->count = passed;
}

/* Leaves of the entries that are not tested yet those that pass. */
static void test_entries(struct lom_tile *tile)
{
    switch (rule_of(tile->draw)) {
    case DEPTH_STAYS:
        test_by_rule(tile, DEPTH_STAYS);
        break;
    case DEPTH_LESSER:
        test_by_rule(tile, DEPTH_LESSER);
        break;
    case DEPTH_GREATER:
        test_by_rule(tile, DEPTH_GREATER);
        break;
    case DEPTH_REPLACED:
        test_by_rule(tile, DEPTH_REPLACED);
        break;
    }
}

/* A packet of the entries from `at` on; `depth` holds those of its samples. */
static void fill_packet(const struct lom_tile *tile, const struct packed *p, int at, struct lom_packet *packet,
                        lom_float depth[LOM_MAX_SAMPLES])
{
    const struct lom_list *list = &tile->list;
    if (tile->pass->samples > 1)
        LOM_WIDE(lom_fill_entry_samples)(tile, p, at, packet, depth);
    else
        weigh(list, p, packet->l);
    packet->depth = (lom_float){ 0 };
    if (tile->draw->queues_depth)
        packet->depth = find_depth_lanes(list, p, packet->l);
    packet->which = p->which;
    packet->triangles = p->triangles;
    packet->covered = lom_lane_index() < p->count;
    packet->places.block = false;
    lom_store_int(packet->places.pixel, pixel_of(p->code));
}

static void shade(struct lom_tile *tile, const struct packed *p, struct lom_packet *packet, int count)
{
#if LOM_LANES > 4
    LOM_WIDE(lom_shade_slots)(tile, p, packet, count);
#else
    for (int k = 0; k < count; k++) {
        for (int i = 0; i < p[k].triangles; i++)
            packet[k].triangle[i] = (int32_t)tile->list.number[p[k].first + i];
        LOM_WIDE(lom_shade_packet)(tile, &packet[k]);
    }
#endif
}

/* How many packets are shaded before the first of them is written, in order: no shader can tell, since who reads depth
 * writes none. */
static int packets_together(const struct lom_tile *tile)
{
    const struct lom_draw *draw = tile->draw;
    bool alone = draw->sampled || draw->marks_edges || tile->chunk->parts != NULL;
    return alone ? 1 : ENTRY_PACKETS;
}

/* Turns to the call of the entry at `at`, and finds where its entries end, or the packet that begins there. */
static int end_of_call(struct lom_tile *tile, int at)
{
    const struct lom_list *list = &tile->list;
    int slot = slot_of(list->code[at]);
    if (list->number[slot] >= tile->call_end)
        LOM_WIDE(lom_turn_to_call)(tile, list->number[slot]);
    while (slot < list->triangles && list->number[slot] < tile->call_end)
        slot++;
    lom_mask others = (lom_int)((lom_uint)lom_load_int(list->code + at) >> CODE_TRIANGLE) >= slot;
    int end = lom_any(others) ? at + __builtin_ctz(lom_bits(others)) : at + LOM_LANES;
    return end < list->count ? end : list->count;
}

/* Shades the entries, the last ones only where they fill a packet or `all` are asked for; those that are left come first
 * then. */
static void shade_entries(struct lom_tile *tile, bool all)
{
    struct lom_list *list = &tile->list;
    struct packed p[ENTRY_PACKETS];
    struct lom_packet packet[ENTRY_PACKETS];
    lom_float depth[LOM_MAX_SAMPLES];
    const int most = packets_together(tile);
    int at = 0, count = 0;
    while (list->count - at >= LOM_LANES || (all && at < list->count)) {
        p[count] = take(list, at, tile->chunk->parts == NULL ? list->count : end_of_call(tile, at));
        fill_packet(tile, &p[count], at, &packet[count], depth);
        at += p[count++].count;
        if (count == most) {
            shade(tile, p, packet, count);
            count = 0;
        }
    }
    if (count > 0)
        shade(tile, p, packet, count);
    list->count -= at;
    lom_store_int(list->code, lom_load_int(list->code + at));
    if (tile->pass->samples > 1)
        lom_store_int(tile->sampled->list, lom_load_int(tile->sampled->list + at));
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

/* Entries of the slots from `slot` on, as far as the list has room; the next slot. */
static int cover_and_test(struct lom_tile *tile, int slot)
{
    struct lom_list *list = &tile->list;
    const int before = list->count;
    list->tested = before;
    slot = LOM_WIDE(lom_cover_slots)(tile, slot);
    if (tile->tests_early)
        test_entries(tile);
    tile->fragments += (uint64_t)(list->count - before);
    if (tile->rejects_early)
        test_entries(tile);
    return slot;
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
        slot = tile->pass->samples > 1 ? LOM_WIDE(lom_cover_samples)(tile, slot) : cover_and_test(tile, slot);
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
