/* Stage 5 of 7 for small triangles, packed, where pixels have several samples. In: the slots of a tile's list. Out: entries for
 * the pixels of which a sample is covered and passes the early depth test, with its samples.
 *
 * The samples of two pixels side by side lie side by side in tile memory, so these strips of a triangle are tested in one
 * vector of samples, or a few, and nothing is gathered. First the strips are found of which a sample may be covered, then they
 * are tested one after the other, then their pixels become entries.
 *
 * Invariant: coverage, weights, depths and places are those of raster_samples.wide.c, which draws the same triangles one by
 * one; a triangle's samples are tested after those of the triangles before it. */
#include "pipeline/packed.h"

/* ---- strips that may be covered ---- */

/* A strip is a row of a block of 2x2 pixels, or, where four samples of a row do not fill a vector, the block. LOM_LANES of them
 * are a part (cover.wide.c). */
enum { STRIP_HEIGHT = LOM_LANES > 8 ? 2 : 1, STRIP_PIXELS = 2 * STRIP_HEIGHT };
enum { COLUMNS = STRIPS_WIDTH / 2, ROWS = STRIPS_HEIGHT / STRIP_HEIGHT };
_Static_assert(COLUMNS *ROWS == LOM_LANES, "a part has a lane a strip");

/* What a tile's parts have in common: the codes of their strips less that of their first, and the places of those as pairs in
 * 1/SUBPIXELS. */
struct frame {
    lom_int codes, pairs;
    int edge;
};

static struct frame find_frame(const struct lom_tile *tile)
{
    const lom_int x = (lom_lane_index() & (COLUMNS - 1)) * 2, y = lom_lane_index() / COLUMNS * STRIP_HEIGHT;
    const lom_int index = (y & ~1) * tile->edge + (y & 1) * 2 + x * 2;
    return (struct frame){ index + (x << CODE_X) + (y << CODE_Y), (x | y << 16) << SUBPIXEL_BITS, tile->edge };
}

/* The words of a slot. */
LOM_INLINE const float *find_slot(const struct lom_tile *tile, int slot)
{
    return tile->list.slots + slot_word(0, slot);
}

LOM_INLINE int32_t integer_of(const float *slot, int word)
{
    int32_t x;
    memcpy(&x, slot + slot_word(word, 0), sizeof x);
    return x;
}

LOM_INLINE float number_of(const float *slot, int word)
{
    return slot[slot_word(word, 0)];
}

/* The strips, from `at` on, of a slot's part at (x, y) of the tile; returns where the next ones go. */
LOM_INLINE int find_part(struct lom_strips *strips, const struct frame *frame, const float *slot, int number, int x,
                         int y, int at)
{
    const lom_int places = frame->pairs + ((x | y << 16) << SUBPIXEL_BITS);
    const lom_int e1 =
        lom_dot_pairs(places, lom_splat_int(integer_of(slot, SLOT_STEP1))) + integer_of(slot, SLOT_COVER1);
    const lom_int e2 =
        lom_dot_pairs(places, lom_splat_int(integer_of(slot, SLOT_STEP2))) + integer_of(slot, SLOT_COVER2);
    const lom_mask some = (e1 | e2 | (integer_of(slot, SLOT_COVER) - (e1 + e2))) >= 0;
    const uint32_t code =
        ((uint32_t)number << CODE_TRIANGLE) + (uint32_t)(y * frame->edge + x * 2 + (x << CODE_X) + (y << CODE_Y));
    lom_compress((float *)strips->code + at, some, lom_as_float(frame->codes + (int32_t)code));
    lom_compress((float *)strips->place + at, some, lom_as_float(places));
    return at + (int)lom_count(some);
}

/* Of a slot; most have one part. */
LOM_INLINE int find_strips(struct lom_strips *strips, const struct frame *frame, const float *slot, int number, int at)
{
    const uint32_t parts = (uint32_t)integer_of(slot, SLOT_PARTS);
    const int left = (int)(parts & 255), top = (int)(parts >> 8 & 255);
    if (parts >> 16 == 0x0101)
        return find_part(strips, frame, slot, number, left, top, at);
    const int right = left + (int)(parts >> 16 & 255) * STRIPS_WIDTH, bottom = top + (int)(parts >> 24) * STRIPS_HEIGHT;
    for (int y = top; y < bottom; y += STRIPS_HEIGHT)
        for (int x = left; x < right; x += STRIPS_WIDTH)
            at = find_part(strips, frame, slot, number, x, y, at);
    return at;
}

/* ---- their samples ---- */

/* How a tile's strips are tested: with constants where that is usual. */
struct test {
    int shift; /* words of a pixel: 1 << shift */
    lom_compare compare;
    bool tests, writes;
    float scale; /* of depths that are whole numbers, else 0 */
    bool cuts;
    bool orders; /* the lesser or the greater of two is written: what comes next there waits for no comparison */
};

/* What a slot's triangle is made of, the same in all lanes. */
struct plane {
    lom_int step1, step2, corner1, corner2, bias1, bias2, whole;
    lom_float inverse, depth, by1, by2, low, high;
};

LOM_INLINE struct plane find_plane(const float *slot)
{
    return (struct plane){ .step1 = lom_splat_int(integer_of(slot, SLOT_STEP1)),
                           .step2 = lom_splat_int(integer_of(slot, SLOT_STEP2)),
                           .corner1 = lom_splat_int(integer_of(slot, SLOT_CORNER1)),
                           .corner2 = lom_splat_int(integer_of(slot, SLOT_CORNER2)),
                           .bias1 = lom_splat_int(integer_of(slot, SLOT_BIAS1)),
                           .bias2 = lom_splat_int(integer_of(slot, SLOT_BIAS2)),
                           .whole = lom_splat_int(integer_of(slot, SLOT_WHOLE)),
                           .inverse = lom_splat(number_of(slot, SLOT_INVERSE)),
                           .depth = lom_splat(number_of(slot, SLOT_DEPTH0)),
                           .by1 = lom_splat(number_of(slot, SLOT_DEPTH1)),
                           .by2 = lom_splat(number_of(slot, SLOT_DEPTH2)),
                           .low = lom_splat(number_of(slot, SLOT_LEAST)),
                           .high = lom_splat(number_of(slot, SLOT_MOST)) };
}

/* Samples of a vector, a bit each: those that pass and those that are not covered. */
struct bits {
    uint32_t passed, outside;
};

/* Of the samples at `places` of the tile in 1/SUBPIXELS, as far as they are allowed, whose depths are in memory. */
LOM_INLINE struct bits test_vector(const struct plane *p, const struct test *t, lom_int places, lom_mask allowed,
                                   float *memory)
{
    const lom_int e1 = lom_dot_pairs(places, p->step1) + p->corner1, e2 = lom_dot_pairs(places, p->step2) + p->corner2;
    lom_int signs = (e1 + p->bias1) | (e2 + p->bias2) | (p->whole - (e1 + e2));
    if (t->cuts)
        signs |= ~allowed;
    if (!t->tests)
        return (struct bits){ lom_bits(signs >= 0), lom_bits(signs < 0) };
    const lom_float l1 = lom_to_float(e1) * p->inverse, l2 = lom_to_float(e2) * p->inverse;
    lom_float z = lom_clamp(p->depth + l1 * p->by1 + l2 * p->by2, p->low, p->high);
    if (t->scale != 0)
        z = lom_to_float(lom_unorm_of_unit_lanes(z, t->scale));
    const uint32_t outside = lom_bits(signs >> 31);
    const lom_float before = lom_load(memory);
    if (t->orders) {
        const bool lesser = t->compare == LOM_COMPARE_LESS || t->compare == LOM_COMPARE_LESS_EQUAL;
        z = lom_select(signs >> 31, lom_splat(lesser ? __builtin_inff() : -__builtin_inff()), z);
        lom_store(memory, lesser ? lom_min(z, before) : lom_max(z, before));
        return (struct bits){ lom_bits(lom_compare_depth(t->compare, z, before)), outside };
    }
    const lom_mask passed = (signs >= 0) & lom_compare_depth(t->compare, z, before);
    if (t->writes)
        lom_store(memory, lom_select(passed, z, before));
    return (struct bits){ lom_bits(passed), outside };
}

/* A strip's words of strips->found: of up to sixteen samples each, those that pass below, those that are covered above. */
LOM_INLINE int found_words(int shift)
{
    return STRIP_PIXELS << shift > 16 ? STRIP_PIXELS << shift >> 4 : 1;
}

/* Of a strip's pixels those inside its triangle's bounds, in the lanes of their samples from `word` on. */
static __attribute__((noinline)) void find_allowed(const struct lom_tile *tile, int32_t code, int shift, int word,
                                                   lom_mask *allowed)
{
    const struct lom_bounds b = lom_bounds_of(&tile->chunk->primitives[tile->list.number[slot_of(code)]]);
    const lom_int pixel = (lom_lane_index() + word) >> shift;
    const lom_int x = (pixel & 1) + (tile->x + (code >> CODE_X & 63)),
                  y = (pixel >> 1) + (tile->y + (code >> CODE_Y & 63));
    *allowed = (x >= b.left) & (x <= b.right) & (y >= b.top) & (y <= b.bottom);
}

LOM_INLINE void test_strip(struct lom_tile *tile, struct lom_strips *strips, const struct plane *p,
                           const struct test *t, int i)
{
    const int32_t *samples = tile->pass->strip_pair, code = strips->code[i];
    const lom_int place = lom_splat_int(strips->place[i]);
    const int words = STRIP_PIXELS << t->shift;
    float *memory = t->tests ? tile->depth + ((code & ((1 << CODE_X) - 1)) << t->shift) : NULL;
    int32_t *found = strips->found + i * found_words(t->shift);
    for (int first = 0; first < words; first += 16) {
        uint32_t passed = 0, outside = 0;
        for (int at = first; at < words && at < first + 16; at += LOM_LANES) {
            lom_mask allowed = { 0 };
            if (t->cuts)
                find_allowed(tile, code, t->shift, at, &allowed);
            const struct bits bits = test_vector(p, t, place + lom_load_int(samples + at), allowed, memory + at);
            passed |= bits.passed << (at - first);
            outside |= bits.outside << (at - first);
        }
        *found++ = (int32_t)(passed | ~outside << ENTRY_COVERED);
    }
}

/* How the draw's strips are tested. `cuts`: the scissor cuts their triangles' bounds. */
static struct test find_test(const struct lom_tile *tile, bool cuts)
{
    return (struct test){ .shift = __builtin_ctz((unsigned)tile->pass->sample_pitch),
                          .compare = tile->draw->compare,
                          .tests = tile->tests_early || tile->rejects_early,
                          .writes = tile->tests_early && tile->draw->depth_write,
                          .scale = (float)tile->pass->depth_scale,
                          .cuts = cuts };
}

/* Those of a slot, from strip i on. */
LOM_INLINE int test_slot(struct lom_tile *tile, int slot, int i, const struct test *t)
{
    struct lom_strips *strips = &tile->sampled->strips;
    const struct plane p = find_plane(find_slot(tile, slot));
    for (const int end = strips->end[slot]; i < end; i++)
        test_strip(tile, strips, &p, t, i);
    return i;
}

static __attribute__((noinline)) int test_cut_slot(struct lom_tile *tile, int slot, int i)
{
    const struct test t = find_test(tile, true);
    return test_slot(tile, slot, i, &t);
}

/* Those of the slots from `slot` on, one after the other. */
LOM_INLINE void test_strips(struct lom_tile *tile, int slot, int end, const struct test *t)
{
    for (int i = 0; slot < end; slot++) {
        const bool cut = integer_of(find_slot(tile, slot), SLOT_STATE) >> TRIANGLE_CUT & 1;
        i = cut ? test_cut_slot(tile, slot, i) : test_slot(tile, slot, i, t);
    }
}

/* With what most draws have as constants. */
static void test_all_strips(struct lom_tile *tile, int slot, int end)
{
    const struct test nearer = { 2, LOM_COMPARE_GREATER, true, true, 0, false, true },
                      less = { 2, LOM_COMPARE_LESS, true, true, 16777215, false, true },
                      not_greater = { 2, LOM_COMPARE_LESS_EQUAL, true, true, 16777215, false, true },
                      t = find_test(tile, false);
    const bool usual = t.shift == 2 && t.tests && t.writes;
    if (usual && t.compare == nearer.compare && t.scale == nearer.scale)
        test_strips(tile, slot, end, &nearer);
    else if (usual && t.compare == less.compare && t.scale == less.scale)
        test_strips(tile, slot, end, &less);
    else if (usual && t.compare == not_greater.compare && t.scale == not_greater.scale)
        test_strips(tile, slot, end, &not_greater);
    else
        test_strips(tile, slot, end, &t);
}

/* ---- entries ---- */

/* The pixels of the first `count` strips, of which a sample passed, to the list. Counts the fragments: what the early test
 * leaves, or, where it only spares the shader what fails after it, all. */
static void list_pixels(struct lom_tile *tile, int count)
{
    struct lom_list *list = &tile->list;
    struct lom_strips *strips = &tile->sampled->strips;
    const int shift = __builtin_ctz((unsigned)tile->pass->sample_pitch), words = found_words(shift);
    const lom_int every = lom_splat_int(((1 << tile->pass->samples) - 1) * (1 + (1 << ENTRY_COVERED)));
    const lom_int strip = lom_lane_index() / STRIP_PIXELS, k = lom_lane_index() & (STRIP_PIXELS - 1),
                  pixels = k | (k & 1) << CODE_X | k >> 1 << CODE_Y, word = strip * words + (k << shift >> 4),
                  bit = k << shift & 15;
    int entries = list->count;
    uint32_t covered = 0;
    memset(strips->found + count * words, 0, LOM_LANES * sizeof *strips->found);
    for (int i = 0; i < count; i += LOM_LANES / STRIP_PIXELS) {
        const lom_int found = lom_as_int(lom_permute(lom_load((const float *)strips->found + i * words), word));
        const lom_int samples = (lom_int)((lom_uint)found >> (lom_uint)bit) & every;
        const lom_int first = lom_as_int(lom_permute(lom_load((const float *)strips->code + i), strip));
        const lom_mask left = (samples & ((1 << ENTRY_COVERED) - 1)) != 0;
        lom_compress((float *)list->code + entries, left, lom_as_float(first + pixels));
        lom_compress((float *)tile->sampled->list + entries, left, lom_as_float(samples));
        entries += (int)lom_count(left);
        if (tile->rejects_early)
            covered += lom_count(samples != 0);
    }
    tile->fragments += tile->rejects_early ? covered : (uint32_t)(entries - list->count);
    list->count = entries;
}

int LOM_WIDE(lom_cover_samples)(struct lom_tile *tile, int slot)
{
    const struct frame frame = find_frame(tile);
    const int first = slot;
    int count = 0;
    for (; slot < tile->list.triangles && count < STRIPS_SIZE; slot++) {
        count = find_strips(&tile->sampled->strips, &frame, find_slot(tile, slot), slot, count);
        tile->sampled->strips.end[slot] = count;
    }
    test_all_strips(tile, first, slot);
    list_pixels(tile, count);
    return slot;
}

/* ---- from entries to packets ---- */

/* Where the triangles cover the centres. */
LOM_INLINE lom_mask cover_centres(const struct lom_list *list, const struct packed *p, const struct entry_edges *e)
{
    const lom_float4 corner = load_slots(list->slots, SLOT_CORNER1, p->first, p->which),
                     more = load_slots(list->slots, SLOT_WHOLE, p->first, p->which);
    return ((e->e1 + lom_as_int(corner.z)) | (e->e2 + lom_as_int(corner.w)) | (lom_as_int(more.x) - (e->e1 + e->e2))) >=
           0;
}

/* The number of the lowest bit that is set, the first being 1; below 2^16. */
LOM_INLINE lom_int find_lowest(lom_int bits)
{
    return (lom_as_int(lom_to_float(bits & -bits)) >> 23) - 126;
}

/* Of places of shading, as pairs of sixteenths of a pixel; there are up to nine in most passes. */
LOM_INLINE lom_int find_offsets(const struct lom_pass *pass, lom_int place)
{
    if (pass->samples < LOM_LANES)
        return lom_as_int(lom_permute(lom_as_float(lom_load_int(pass->offset_pair)), place));
    return lom_gather_int(pass->offset_pair, place);
}

void LOM_WIDE(lom_fill_entry_samples)(const struct lom_tile *tile, const struct packed *p, int at,
                                      struct lom_packet *packet, lom_float depth[LOM_MAX_SAMPLES])
{
    const struct lom_list *list = &tile->list;
    const struct entry_edges centre = find_entry_edges(list, p);
    const lom_int none =
        lom_splat_int(1 << ENTRY_COVERED); /* of lanes that are no entries: the first, and written nowhere */
    const lom_int samples = lom_select_int(lom_lane_index() < p->count, lom_load_int(tile->sampled->list + at), none);
    packet->samples = samples & ((1 << ENTRY_COVERED) - 1);
    packet->place = lom_select_int(cover_centres(list, p, &centre), (lom_int){ 0 },
                                   find_lowest((lom_int)((lom_uint)samples >> ENTRY_COVERED)));
    struct entry_edges placed = move_entries(centre, find_offsets(tile->pass, packet->place));
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
