/* Stage 5 of 7 for small triangles, packed, where pixels have several samples. In: entries of a tile's list, pixels of which
 * a sample may be covered. Out: those of which one is, and passes the early depth test, with its samples and the place where
 * it is shaded.
 *
 * Invariant: coverage, weights, depths and places are those of raster_samples.wide.c, which draws the same triangles one by
 * one; fragments at one sample are tested in their order. */
#include "pipeline/packed.h"

/* -1 where the edge's own points are outside, as bias_of; the steps are pairs. */
LOM_INLINE lom_int bias_of_pair(lom_int step)
{
    lom_int dx = step << 16, dy = step >> 16;
    return ~((dx > 0) | ((dx == 0) & (dy > 0)));
}

/* What the top-left rule adds to the edge functions. */
struct biases {
    lom_int of[3];
};

LOM_INLINE struct biases find_biases(const struct entry_edges *e)
{
    lom_int dx = -(e->step1 << 16 >> 16) - (e->step2 << 16 >> 16), dy = -(e->step1 >> 16) - (e->step2 >> 16);
    return (struct biases){ { ~((dx > 0) | ((dx == 0) & (dy > 0))), bias_of_pair(e->step1), bias_of_pair(e->step2) } };
}

LOM_INLINE lom_mask covers(const struct entry_edges *e, const struct biases *b)
{
    return ((e->area - e->e1 - e->e2 + b->of[0]) | (e->e1 + b->of[1]) | (e->e2 + b->of[2])) >= 0;
}

/* A row of four samples. */
typedef float row __attribute__((vector_size(16), aligned(4), may_alias));
typedef int32_t row_mask __attribute__((vector_size(16)));

/* Leaves depths of rows of samples in memory, a lane after the other, since two may be of one pixel; gives what was there
 * before. Where a sample is not covered its depth is one that the rule leaves out, or taken is 0. */
LOM_INLINE lom_float4 exchange(float *memory, const int32_t *at, lom_float4 depth, lom_float4 taken, depth_rule rule)
{
    float new[4 * LOM_LANES], old[4 * LOM_LANES], mask[4 * LOM_LANES];
    const lom_int rows = lom_lane_index() * 4;
    lom_scatter_rows(new, rows, depth);
    if (rule == DEPTH_REPLACED)
        lom_scatter_rows(mask, rows, taken);
    for (int i = 0; i < LOM_LANES; i++) {
        row *to = (row *)(void *)(memory + at[i]);
        row before = *to, z = *(const row *)(const void *)(new + 4 * i);
        row_mask moves = rule == DEPTH_LESSER    ? (row_mask)(z < before)
                         : rule == DEPTH_GREATER ? (row_mask)(z > before)
                                                 : (row_mask)(*(const row *)(const void *)(mask + 4 * i));
        *(row *)(void *)(old + 4 * i) = before;
        *to = (row)(((row_mask)z & moves) | ((row_mask)before & ~moves));
    }
    return lom_gather_rows(old, rows);
}

/* Of `count` samples, from `first` on, those that are covered and pass; the others leave what is there. */
LOM_INLINE void test_row(struct lom_tile *tile, const struct packed *p, int first, int count, lom_mask *covered,
                         const lom_float *units)
{
    const struct lom_draw *draw = tile->draw;
    const depth_rule rule = rule_of(draw);
    const lom_float none = lom_splat(rule == DEPTH_LESSER ? __builtin_inff() : -__builtin_inff());
    lom_float z[4] = { none, none, none, none }, taken[4] = { { 0 }, { 0 }, { 0 }, { 0 } };
    int32_t at[LOM_LANES];
    lom_store_int(at, pixel_of(p->code) * tile->pass->sample_pitch + first);
    for (int k = 0; k < count; k++) {
        z[k] = lom_select(covered[k], units[k], none);
        taken[k] = lom_as_float(covered[k]);
    }
    const lom_float4 depth = { z[0], z[1], z[2], z[3] }, mask = { taken[0], taken[1], taken[2], taken[3] };
    lom_float4 old;
    switch (rule) {
    case DEPTH_LESSER:
        old = exchange(tile->depth, at, depth, mask, DEPTH_LESSER);
        break;
    case DEPTH_GREATER:
        old = exchange(tile->depth, at, depth, mask, DEPTH_GREATER);
        break;
    case DEPTH_REPLACED:
        old = exchange(tile->depth, at, depth, mask, DEPTH_REPLACED);
        break;
    default:
        old = lom_gather_rows(tile->depth, lom_load_int(at));
        break;
    }
    const lom_float before[4] = { old.x, old.y, old.z, old.w };
    for (int k = 0; k < count; k++)
        covered[k] &= lom_compare_depth(draw->compare, units[k], before[k]);
}

/* Samples and place of LOM_LANES entries, as list_samples holds them. Of `count` samples, which the callers know. Counts the
 * fragments: what the early test leaves, or, where it only spares the shader what fails after it, all. */
LOM_INLINE lom_int find_samples(struct lom_tile *tile, const struct packed *p, int count)
{
    const struct entry_edges centre = find_entry_edges(&tile->list, p);
    const struct entry_depth plane = find_entry_depth(&tile->list, p);
    const struct biases biases = find_biases(&centre);
    lom_mask entries = lom_lane_index() < p->count, placed = covers(&centre, &biases), covered[LOM_MAX_SAMPLES];
    lom_float units[LOM_MAX_SAMPLES];
    lom_int samples = { 0 }, place = { 0 };
    for (int s = 0; s < count; s++) {
        struct entry_edges e = move_entries(centre, lom_splat_int(tile->pass->offset_pair[s + 1]));
        lom_float l[3];
        covered[s] = entries & covers(&e, &biases);
        place = lom_select_int(covered[s] & ~placed, lom_splat_int(s + 1), place);
        placed |= covered[s];
        weigh_entries(&e, l);
        units[s] = lom_depth_units(tile->pass, interpolate_entries(&plane, l));
    }
    lom_mask counted = { 0 };
    for (int s = 0; s < count && tile->rejects_early; s++)
        counted |= covered[s];
    for (int first = 0; first < count && (tile->tests_early || tile->rejects_early); first += 4)
        test_row(tile, p, first, count - first < 4 ? count - first : 4, covered + first, units + first);
    for (int s = 0; s < count; s++)
        samples |= covered[s] & 1 << s;
    tile->fragments += lom_count(tile->rejects_early ? counted : samples != 0);
    return samples | place << ENTRY_PLACE;
}

LOM_INLINE void test_entries(struct lom_tile *tile, int from, int count)
{
    struct lom_list *list = &tile->list;
    int passed = from;
    for (int at = from, step; at < list->count; at += step) {
        struct packed p = take(list, at, list->count);
        lom_int samples = find_samples(tile, &p, count);
        lom_mask left = (samples & ((1 << ENTRY_PLACE) - 1)) != 0;
        step = p.count;
        lom_int next = lom_load_int(list->code + at + step); /* the store of a whole packet may reach them */
        lom_compress((float *)list->code + passed, left, lom_as_float(p.code));
        lom_store_int(list->code + at + step, next);
        lom_compress((float *)tile->list_samples + passed, left, lom_as_float(samples));
        passed += (int)lom_count(left);
    }
    list->count = passed;
}

void LOM_WIDE(lom_test_entry_samples)(struct lom_tile *tile, int from)
{
    switch (tile->pass->samples) {
    case 2:
        test_entries(tile, from, 2);
        break;
    case 4:
        test_entries(tile, from, 4);
        break;
    default:
        test_entries(tile, from, tile->pass->samples);
        break;
    }
}

void LOM_WIDE(lom_fill_entry_samples)(const struct lom_tile *tile, const struct packed *p, int at,
                                      struct lom_packet *packet, lom_float depth[LOM_MAX_SAMPLES])
{
    const struct lom_list *list = &tile->list;
    const struct entry_edges centre = find_entry_edges(list, p);
    lom_int samples =
        lom_select_int(lom_lane_index() < p->count, lom_load_int(tile->list_samples + at), (lom_int){ 0 });
    packet->samples = samples & ((1 << ENTRY_PLACE) - 1);
    packet->place = samples >> ENTRY_PLACE;
    struct entry_edges placed = move_entries(centre, lom_gather_int(tile->pass->offset_pair, packet->place));
    weigh_entries(&placed, packet->l);
    packet->sample_depth = (const float *)depth;
    packet->depth_pitch = LOM_LANES;
    for (int s = 0; tile->draw->late_depth && s < tile->pass->samples; s++) {
        struct entry_edges e = move_entries(centre, lom_splat_int(tile->pass->offset_pair[s + 1]));
        lom_float l[3];
        weigh_entries(&e, l);
        depth[s] = find_depth_lanes(list, p, l);
    }
}
