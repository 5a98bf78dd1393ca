/* Stage 5 of 7 for small triangles, its first half. In: the triangles of a tile that are drawn together. Out: their
 * slots, and a code for each pixel they cover, in order.
 *
 * Invariant: the pixels are those of raster.wide.c, which draws the same triangles one by one; Loops over triangles have
 * no branch that depends on a mask: it would be guessed wrong too often. */
#include "lanes/pair_products.h"
#include "pipeline/slots.h"

enum { PART_WIDTH = LOM_LANES > 4 ? 4 : 2, PART_HEIGHT = LOM_LANES > 8 ? 4 : 2 };

/* ---- slots ---- */

/* Where the parts of LOM_LANES pixels lie that cover what the tile has of a triangle's bounds. They begin at the
 * bounds, not at a multiple of their size, so that a small triangle has few; but end within the tile. */
LOM_INLINE lom_int find_parts(const struct lom_tile *tile, lom_int from, lom_int to, lom_int state, int width,
                              int height)
{
    lom_int left = (from & 0xffff) - tile->x, top = (from >> 16) - tile->y;
    lom_int end = lom_splat_int(tile->edge - 1), zero = { 0 };
    lom_int right = lom_min_int((to & 0xffff) - tile->x, end), bottom = lom_min_int((to >> 16) - tile->y, end);
    lom_int x = lom_max_int(left, zero) & ~1, y = lom_max_int(top, zero) & ~1;
    lom_int columns = (right - x) / width + 1, rows = (bottom - y) / height + 1;
    lom_mask moves = (state >> TRIANGLE_KIND & 3) != TRIANGLE_WINDOW; /* a window has its place */
    x = lom_select_int(moves, lom_min_int(x, tile->edge - columns * width), x);
    y = lom_select_int(moves, lom_min_int(y, tile->edge - rows * height), y);
    return x | y << 8 | columns << 16 | rows << 24;
}

/* The top-left rule, as bias_of. */
LOM_INLINE lom_int bias_lanes(lom_int dx, lom_int dy)
{
    return ~((dx > 0) | ((dx == 0) & (dy > 0)));
}

/* How far an edge function rises from the centre of a strip's first pixel to a sample of the strip; the steps over 256 are
 * pairs. */
LOM_INLINE lom_int reach_lanes(const struct lom_pass *pass, lom_int step)
{
    lom_int most = lom_dot_pairs(lom_splat_int(pass->offset_pair[1]), step), zero = { 0 };
    for (int s = 2; s <= pass->samples; s++)
        most = lom_max_int(most, lom_dot_pairs(lom_splat_int(pass->offset_pair[s]), step));
    lom_int pixel = lom_max_int(step << 16 >> 16, zero);
    if (LOM_LANES > 8)
        pixel += lom_max_int(step >> 16, zero);
    return (most << (SUBPIXEL_BITS - 4)) + (pixel << SUBPIXEL_BITS);
}

/* The vertices of LOM_LANES triangles: places less that of the tile's first pixel in units, depths. */
struct corners {
    lom_int x[3], y[3];
    lom_float depth[3];
};

/* Leaves 1/w where the fragment stage looks for it. */
LOM_INLINE struct corners load_corners(struct lom_tile *tile, const lom_int row[3], int first)
{
    const lom_rect *viewport = &tile->draw->desc.viewport;
    const int32_t x = (tile->x - viewport->x) * SUBPIXELS + SUBPIXELS / 2,
                  y = (tile->y - viewport->y) * SUBPIXELS + SUBPIXELS / 2;
    struct corners c;
    for (int k = 0; k < 3; k++) {
        lom_float4 header = lom_gather_rows(tile->chunk->rows, row[k]);
        c.x[k] = lom_as_int(header.x) - x;
        c.y[k] = lom_as_int(header.y) - y;
        c.depth[k] = header.z;
        if (SLOTS_BY_WORD)
            lom_store(tile->list.value + (LIST_ONE_OVER_W + k) * SLOT_PITCH + first, header.w);
    }
    return c;
}

/* Edge functions 1 and 2, positive inside: their steps over SUBPIXELS as pairs, and they themselves at the tile's first
 * pixel. Both edges have vertex 0. A small triangle with pixels in the tile reaches less than 2^14 units beyond the first or
 * the last of them, so that all factors are below 2^15. */
struct slot_edges {
    lom_int area, pair1, pair2, start1, start2;
};

LOM_INLINE struct slot_edges find_slot_edges(const struct corners *c)
{
    lom_int ux = c->x[1] - c->x[0], uy = c->y[1] - c->y[0], vx = c->x[2] - c->x[0], vy = c->y[2] - c->y[0];
    lom_int area = lom_dot_pairs(lom_make_pair(ux, uy), lom_make_pair(vy, -vx)), turned = area >> 31;
    lom_int from = lom_make_pair(-c->x[0], -c->y[0]);
    struct slot_edges e = { .area = (area ^ turned) - turned,
                            .pair1 = lom_make_pair((vy ^ turned) - turned, (vx ^ ~turned) - ~turned),
                            .pair2 = lom_make_pair((uy ^ ~turned) - ~turned, (ux ^ turned) - turned) };
    e.start1 = lom_dot_pairs(from, e.pair1);
    e.start2 = lom_dot_pairs(from, e.pair2);
    return e;
}

/* What the top-left rule adds to the edge functions; the steps may be of any size. */
struct slot_biases {
    lom_int of[3];
};

LOM_INLINE struct slot_biases find_slot_biases(const struct slot_edges *e)
{
    lom_int dx1 = e->pair1 << 16, dx2 = e->pair2 << 16, dy1 = e->pair1 >> 16, dy2 = e->pair2 >> 16;
    return (struct slot_biases){ { bias_lanes(-(dx1 >> 16) - (dx2 >> 16), -dy1 - dy2), bias_lanes(dx1, dy1),
                                   bias_lanes(dx2, dy2) } };
}

/* The words that a slot has where pixels have several samples: pack_samples.wide.c. */
static void fill_block_words(struct lom_tile *tile, int number, const struct slot_edges *e, lom_float low,
                             lom_float high, lom_int parts)
{
    const lom_int half = lom_splat_int(SUBPIXELS / 2 * 0x10001);
    const lom_int third =
        lom_make_pair(-(e->pair1 << 16 >> 16) - (e->pair2 << 16 >> 16), -(e->pair1 >> 16) - (e->pair2 >> 16));
    float *slots = tile->list.slots;
    struct slot_biases bias = find_slot_biases(e);
    lom_int cover1 = e->start1 + bias.of[1] + reach_lanes(tile->pass, e->pair1);
    lom_int cover2 = e->start2 + bias.of[2] + reach_lanes(tile->pass, e->pair2);
    lom_int cover0 = e->area - e->start1 - e->start2 + bias.of[0] + reach_lanes(tile->pass, third);
    store_slots(slots, SLOT_COVER1, number,
                (lom_float4){ lom_as_float(cover1), lom_as_float(cover2), lom_as_float(cover0 + cover1 + cover2),
                              lom_as_float(parts) });
    store_slots(slots, SLOT_CORNER1, number,
                (lom_float4){ lom_as_float(e->start1 - lom_dot_pairs(half, e->pair1)),
                              lom_as_float(e->start2 - lom_dot_pairs(half, e->pair2)), lom_as_float(bias.of[1]),
                              lom_as_float(bias.of[2]) });
    const bool clamps = tile->pass->depth_scale != 0;
    store_slots(slots, SLOT_WHOLE, number,
                (lom_float4){ lom_as_float(e->area + bias.of[0]), clamps ? lom_saturate(low) : low,
                              clamps ? lom_saturate(high) : high, low });
}

/* LOM_LANES slots; the words are those of lom_primitive. */
static void fill_packet(struct lom_tile *tile, int number)
{
    float *slots = tile->list.slots;
    const float *words = (const float *)(const void *)tile->chunk->primitives;
    lom_int at = lom_load_int((const int32_t *)tile->list.number + number) * (int32_t)(sizeof(lom_primitive) / 4);
    lom_int first, last;
    lom_float4 head = lom_gather_rows(words, at);
    lom_gather_pairs((const int32_t *)words + 4, at, &first, &last);
    const lom_int row[3] = { lom_as_int(head.x), lom_as_int(head.y), lom_as_int(head.z) };
    struct corners c = load_corners(tile, row, number);
    struct slot_edges e = find_slot_edges(&c);
    const lom_float z0 = c.depth[0], z1 = z0 + (c.depth[1] - z0), z2 = z0 + (c.depth[2] - z0);
    const lom_float low = lom_min(lom_min(z0, z1), z2), high = lom_max(lom_max(z0, z1), z2);
    store_slots(
        slots, SLOT_STEP1, number,
        (lom_float4){ lom_as_float(e.pair1), lom_as_float(e.pair2), lom_as_float(e.start1), lom_as_float(e.start2) });
    store_slots(slots, SLOT_AREA, number, (lom_float4){ lom_as_float(e.area), 1.0f / lom_to_float(e.area), z0, low });
    store_slots(slots, SLOT_DEPTH1, number, (lom_float4){ c.depth[1] - z0, c.depth[2] - z0, high, head.w });
    if (tile->pass->samples > 1) {
        fill_block_words(tile, number, &e, low, high,
                         find_parts(tile, first, last, lom_as_int(head.w), STRIPS_WIDTH, STRIPS_HEIGHT));
        return;
    }
    lom_int parts = find_parts(tile, first, last, lom_as_int(head.w), PART_WIDTH, PART_HEIGHT);
    lom_int origin = (parts & 255) | (parts & 0xff00) << 8;
    struct slot_biases bias = find_slot_biases(&e);
    lom_int cover1 = e.start1 + (lom_dot_pairs(origin, e.pair1) << SUBPIXEL_BITS) + bias.of[1];
    lom_int cover2 = e.start2 + (lom_dot_pairs(origin, e.pair2) << SUBPIXEL_BITS) + bias.of[2];
    lom_int whole = e.area + bias.of[0] + bias.of[1] + bias.of[2];
    store_slots(slots, SLOT_COVER1, number,
                (lom_float4){ lom_as_float(cover1), lom_as_float(cover2), lom_as_float(whole), lom_as_float(parts) });
}

void LOM_WIDE(lom_fill_slots)(struct lom_tile *tile)
{
    struct lom_list *list = &tile->list;
    for (int i = 0; i < LOM_LANES; i++) /* the last packet reads on */
        list->number[list->triangles + i] = list->number[0];
    for (int first = 0; first < list->triangles; first += LOM_LANES)
        fill_packet(tile, first);
}

/* ---- coverage ---- */

/* The codes of the pixels of a 2x2 block whose bits are set, less that of its first. */
#define CODE(k) ((k) | ((k)&1) << CODE_X | ((k) >> 1) << CODE_Y)
static const int32_t block_codes[16][4] = {
    { 0 },
    { CODE(0) },
    { CODE(1) },
    { CODE(0), CODE(1) },
    { CODE(2) },
    { CODE(0), CODE(2) },
    { CODE(1), CODE(2) },
    { CODE(0), CODE(1), CODE(2) },
    { CODE(3) },
    { CODE(0), CODE(3) },
    { CODE(1), CODE(3) },
    { CODE(0), CODE(1), CODE(3) },
    { CODE(2), CODE(3) },
    { CODE(0), CODE(2), CODE(3) },
    { CODE(1), CODE(2), CODE(3) },
    { CODE(0), CODE(1), CODE(2), CODE(3) },
};

static const uint8_t block_counts[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };

/* Writes the codes of the lanes that are set, `codes` being those of all; returns where the next ones go. */
LOM_INLINE int32_t *list_part(int32_t *to, lom_mask covered, lom_int codes)
{
    uint32_t bits = lom_bits(covered);
    if (LOM_LANES > 4) {
        lom_compress((float *)to, covered, lom_as_float(codes));
        return to + lom_count_bits(bits);
    }
    /* A block, and the baseline has neither a permutation to compress by nor a count of bits. */
    lom_store_int(to, lom_load_int(block_codes[bits]) + codes[0]);
    return to + block_counts[bits];
}

/* What a tile's windows have in common: the codes of their pixels, less those of their first, and the tile's edge. */
struct frame {
    lom_int codes[PARTS];
    int edge;
};

/* The code of pixel (x, y) of the tile, both even. */
LOM_INLINE int32_t code_of(const struct frame *frame, int slot, int x, int y)
{
    return (int32_t)(((uint32_t)slot << CODE_TRIANGLE) +
                     (uint32_t)(y * frame->edge + x * 2 + (x << CODE_X) + (y << CODE_Y)));
}

LOM_INLINE int32_t *cover_window(const struct frame *frame, int slot, uint32_t mask, int x, int y, int32_t *to)
{
    int32_t code = code_of(frame, slot, x, y);
    for (int part = 0; part < PARTS; part++) {
        uint32_t bits = mask >> part * LOM_LANES & ((1u << LOM_LANES) - 1);
        to = list_part(to, lom_mask_of_bits(bits), frame->codes[part] + code);
    }
    return to;
}

/* What the early depth test needs of a slot. */
struct slot_depth {
    int bias1, bias2; /* that coverage has in edge functions 1 and 2 */
    float inverse, at, by1, by2, low, high;
};

static int bias_of_pair(int32_t pair)
{
    return bias_of((int16_t)(pair & 0xffff), pair >> 16);
}

static struct slot_depth find_slot_depth(const float *slots, int slot)
{
    const int32_t *words = (const int32_t *)(const void *)slots;
    return (struct slot_depth){
        .bias1 = bias_of_pair(words[slot_word(SLOT_STEP1, slot)]),
        .bias2 = bias_of_pair(words[slot_word(SLOT_STEP2, slot)]),
        .inverse = slots[slot_word(SLOT_INVERSE, slot)],
        .at = slots[slot_word(SLOT_DEPTH0, slot)],
        .by1 = slots[slot_word(SLOT_DEPTH1, slot)],
        .by2 = slots[slot_word(SLOT_DEPTH2, slot)],
        .low = slots[slot_word(SLOT_LOW, slot)],
        .high = slots[slot_word(SLOT_HIGH, slot)],
    };
}

/* The same depths and test as pack.wide.c's, of a part's pixels, which lie side by side in tile memory. */
LOM_INLINE lom_mask test_part(struct lom_tile *tile, const struct slot_depth *d, lom_int e1, lom_int e2,
                              lom_mask covered, int place)
{
    lom_float l1 = lom_to_float(e1 - d->bias1) * d->inverse, l2 = lom_to_float(e2 - d->bias2) * d->inverse;
    lom_float z = lom_clamp(d->at + l1 * d->by1 + l2 * d->by2, lom_splat(d->low), lom_splat(d->high));
    return lom_test_depth(tile, place, covered, z);
}

/* Edge functions 1 and 2 of a slot, biased, at the pixels of a part, and what they change from a part to the next one on its
 * right and below; the third one is what they leave of `whole`. */
struct part_edges {
    lom_int e1, e2, right1, right2, down1, down2, whole;
};

LOM_INLINE struct part_edges find_part_edges(const float *slots, int slot)
{
    const int32_t *words = (const int32_t *)(const void *)slots;
    enum { RIGHT = SUBPIXELS * PART_WIDTH, DOWN = SUBPIXELS * PART_HEIGHT };
    const lom_int pixels = lom_make_pair(lane_x(0), lane_y(0));
    const lom_int pair1 = lom_splat_int(words[slot_word(SLOT_STEP1, slot)]),
                  pair2 = lom_splat_int(words[slot_word(SLOT_STEP2, slot)]);
    return (
        struct part_edges){ .e1 = (lom_dot_pairs(pixels, pair1) << SUBPIXEL_BITS) + words[slot_word(SLOT_COVER1, slot)],
                            .e2 = (lom_dot_pairs(pixels, pair2) << SUBPIXEL_BITS) + words[slot_word(SLOT_COVER2, slot)],
                            .right1 = (pair1 << 16 >> 16) * RIGHT,
                            .right2 = (pair2 << 16 >> 16) * RIGHT,
                            .down1 = (pair1 >> 16) * DOWN,
                            .down2 = (pair2 >> 16) * DOWN,
                            .whole = lom_splat_int(words[slot_word(SLOT_COVER, slot)]) };
}

/* Of a slot; `cut` to bounds, or NULL; the early depth test done, or, with `depth` NULL, not. */
LOM_INLINE int32_t *cover_parts(struct lom_tile *tile, const struct frame *frame, int slot,
                                const struct lom_bounds *cut, const struct slot_depth *depth, int32_t *to)
{
    const int32_t *words = (const int32_t *)(const void *)tile->list.slots;
    uint32_t parts = (uint32_t)words[slot_word(SLOT_PARTS, slot)];
    int left = (int)(parts & 255), top = (int)(parts >> 8 & 255);
    int right = left + (int)(parts >> 16 & 255) * PART_WIDTH, bottom = top + (int)(parts >> 24) * PART_HEIGHT;
    struct part_edges at = find_part_edges(tile->list.slots, slot);
    for (int y = top; y < bottom; y += PART_HEIGHT, at.e1 += at.down1, at.e2 += at.down2) {
        lom_int e1 = at.e1, e2 = at.e2, codes = frame->codes[0] + code_of(frame, slot, left, y);
        for (int x = left; x < right; x += PART_WIDTH, e1 += at.right1, e2 += at.right2) {
            lom_mask covered = (e1 | e2 | (at.whole - e1 - e2)) >= 0;
            if (cut != NULL)
                covered &= inside_bounds(tile, cut, x, y, 0);
            if (depth != NULL && lom_any(covered))
                covered = test_part(tile, depth, e1, e2, covered, memory_index(tile, x, y));
            to = list_part(to, covered, codes);
            codes += PART_WIDTH * 2 + (PART_WIDTH << CODE_X);
        }
    }
    return to;
}

static int32_t *cover_cut(struct lom_tile *tile, const struct frame *frame, int slot, bool tests, int32_t *to)
{
    struct lom_bounds bounds = lom_bounds_of(&tile->chunk->primitives[tile->list.number[slot]]);
    struct slot_depth depth = find_slot_depth(tile->list.slots, slot);
    return cover_parts(tile, frame, slot, &bounds, tests ? &depth : NULL, to);
}

static int32_t *cover_tested(struct lom_tile *tile, const struct frame *frame, int slot, int32_t *to)
{
    struct slot_depth depth = find_slot_depth(tile->list.slots, slot);
    return cover_parts(tile, frame, slot, NULL, &depth, to);
}

/* Triangles of so many parts have them full enough for the early depth test to be made there. */
enum { TESTED_PARTS = 20 };

int LOM_WIDE(lom_cover_slots)(struct lom_tile *tile, int from)
{
    struct lom_list *list = &tile->list;
    const int32_t *words = (const int32_t *)(const void *)list->slots;
    struct frame frame = { .edge = tile->edge };
    for (int part = 0; part < PARTS; part++)
        frame.codes[part] =
            lom_load_int(tile->offset + part * LOM_LANES) + (lane_x(part) << CODE_X) + (lane_y(part) << CODE_Y);
    int32_t *to = list->code + list->count, *end = list->code + LIST_SIZE;
    int slot = from, triangles = list->triangles;
    const uint32_t fewest = tile->tests_early ? TESTED_PARTS : UINT32_MAX;
    for (; slot < triangles && to < end; slot++) {
        uint32_t state = (uint32_t)words[slot_word(SLOT_STATE, slot)];
        uint32_t parts = (uint32_t)words[slot_word(SLOT_PARTS, slot)];
        if ((state >> TRIANGLE_KIND & 3) == TRIANGLE_WINDOW) {
            to = cover_window(&frame, slot, state & 0xffff, (int)(parts & 255), (int)(parts >> 8 & 255), to);
            continue;
        }
        bool tested = (parts >> 16 & 255) * (parts >> 24) >= fewest;
        if (tested && to > list->code + list->tested)
            break;
        if (state >> TRIANGLE_CUT & 1)
            to = cover_cut(tile, &frame, slot, tested, to);
        else
            to = tested ? cover_tested(tile, &frame, slot, to) : cover_parts(tile, &frame, slot, NULL, NULL, to);
        if (tested)
            list->tested = (int)(to - list->code);
    }
    list->count = (int)(to - list->code);
    return slot;
}
