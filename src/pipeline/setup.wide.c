/* Stage 3 of 7: setup. In: triangles of projected vertices, in order. Out: a record for each that may cover a pixel
 * centre. LOM_LANES triangles at a time, in exact integers (large areas in double, which holds them exactly).
 *
 * Invariant: the record is the same for every order of the three vertices; only facing and the provoking vertex
 * remember it. Triangles that fit a 4x4 window get their exact coverage here, and the empty ones end here. */
#include "lanes/pair_products.h"
#include "pipeline/record.h"
#include "pipeline/variants.h"

struct vertices { /* one corner of LOM_LANES triangles */
    lom_int x, y;
    lom_int row; /* where its row begins (a multiple of 4), plus 1 for the provoking vertex */
};

struct packet {
    struct vertices v[3];
    lom_int x0, y0, x1, y1; /* bounds of the vertices, in units */
    lom_int sign;           /* of the area of v[0], v[1], v[2] in their order: 1, -1, or 0 */
    lom_int left, top, right, bottom, kind, cut, clip;
    lom_mask alive, front, small, listed;
};

/* Edge functions 0, 1, 2 at a pixel, without the top-left rule; exact where the triangle is small. */
struct edge_lanes {
    lom_int start[3], dx[3], dy[3]; /* changes a pixel right and down */
    lom_int ex[3], ey[3];           /* along the edge, so that the inside is positive */
};

/* Where the rows of LOM_LANES triangles' corners begin, as the corners lie: three a triangle. */
LOM_INLINE void find_rows(const struct lom_chunk *chunk, const uint32_t *corners, uint32_t base,
                          int32_t rows[3 * LOM_LANES])
{
    for (int i = 0; i < 3 * LOM_LANES; i += LOM_LANES)
        lom_store_int(rows + i,
                      (lom_load_int((const int32_t *)corners + i) - (int32_t)base) * (int32_t)chunk->draw->row_floats);
}

/* Corner k of LOM_LANES triangles, without where its row is. */
LOM_INLINE void load_corner(const struct lom_chunk *chunk, const int32_t *row, int k, struct vertices *v)
{
    const float *rows[LOM_LANES];
    for (int i = 0; i < LOM_LANES; i++)
        rows[i] = chunk->rows + row[3 * i + k];
    lom_float4 header = lom_load_rows(rows, 0);
    v->x = lom_as_int(header.x);
    v->y = lom_as_int(header.y);
}

/* The bounds of the vertices in units, and which triangles have edge functions in int32. */
LOM_INLINE void measure(struct packet *p)
{
    const struct vertices *v = p->v;
    p->x0 = lom_min_int(v[0].x, lom_min_int(v[1].x, v[2].x));
    p->x1 = lom_max_int(v[0].x, lom_max_int(v[1].x, v[2].x));
    p->y0 = lom_min_int(v[0].y, lom_min_int(v[1].y, v[2].y));
    p->y1 = lom_max_int(v[0].y, lom_max_int(v[1].y, v[2].y));
    p->small = (p->x1 - p->x0 < SMALL_EXTENT) & (p->y1 - p->y0 < SMALL_EXTENT);
}

/* The sign of twice the area of v[0], v[1], v[2], positive clockwise on the screen (y down), of small triangles, whose
 * differences are below SMALL_EXTENT = 2^14. */
LOM_INLINE void find_sign(struct packet *p)
{
    const struct vertices *v = p->v;
    lom_int ax = v[1].x - v[0].x, ay = v[1].y - v[0].y, bx = v[2].x - v[0].x, by = v[2].y - v[0].y;
    lom_int area = lom_dot_pairs(lom_make_pair(ax, ay), lom_make_pair(by, -bx));
    p->sign = ((area > 0) & 1) | (area < 0);
}

/* The same where it does not fit int32; exact in double. */
static __attribute__((noinline)) void find_large_sign(struct packet *p)
{
    const struct vertices *v = p->v;
    for (int i = 0; i < LOM_LANES; i++) {
        double area = (double)(v[1].x[i] - v[0].x[i]) * (v[2].y[i] - v[0].y[i]) -
                      (double)(v[1].y[i] - v[0].y[i]) * (v[2].x[i] - v[0].x[i]);
        p->sign[i] = (area > 0) - (area < 0);
    }
}

/* Facing and culling: positive areas are back faces for the usual counter-clockwise fronts. */
LOM_INLINE void cull(const struct lom_draw *draw, struct packet *p)
{
    if (lom_all(p->small))
        find_sign(p);
    else
        find_large_sign(p);
    p->front = draw->desc.front_clockwise ? p->sign > 0 : p->sign < 0;
    p->alive &= p->sign != 0;
    if (draw->desc.cull == LOM_CULL_BACK)
        p->alive &= p->front;
    if (draw->desc.cull == LOM_CULL_FRONT)
        p->alive &= ~p->front;
}

/* Two selects are more than this where the processor has no instruction for them. */
LOM_INLINE void exchange(lom_mask swap, lom_int *a, lom_int *b)
{
    lom_int difference = (*a ^ *b) & swap;
    *a ^= difference;
    *b ^= difference;
}

/* Vertices a and b in the order of (y, x); each exchange turns the sign of the area. */
LOM_INLINE void order(struct packet *p, int a, int b)
{
    struct vertices *u = &p->v[a], *v = &p->v[b];
    lom_mask swap = (v->y < u->y) | ((v->y == u->y) & (v->x < u->x));
    exchange(swap, &u->x, &v->x);
    exchange(swap, &u->y, &v->y);
    exchange(swap, &u->row, &v->row);
    p->sign = (p->sign ^ swap) - swap;
}

/* The pixels of which a sample may be inside, cut by the scissor. */
LOM_INLINE void bound(const struct lom_pass *pass, const struct lom_draw *draw, struct packet *p)
{
    const lom_rect *s = &draw->scissor, *viewport = &draw->desc.viewport;
    const int first = SUBPIXELS / 2 - 1 - pass->reach_high, last = SUBPIXELS / 2 + pass->reach_low;
    lom_int left = ((p->x0 + first) >> SUBPIXEL_BITS) + viewport->x;
    lom_int top = ((p->y0 + first) >> SUBPIXEL_BITS) + viewport->y;
    lom_int right = ((p->x1 - last) >> SUBPIXEL_BITS) + viewport->x;
    lom_int bottom = ((p->y1 - last) >> SUBPIXEL_BITS) + viewport->y;
    p->cut = (left < s->x) | (top < s->y) | (right > s->x + s->width - 1) | (bottom > s->y + s->height - 1);
    p->left = lom_max_int(left, lom_splat_int(s->x));
    p->top = lom_max_int(top, lom_splat_int(s->y));
    p->right = lom_min_int(right, lom_splat_int(s->x + s->width - 1));
    p->bottom = lom_min_int(bottom, lom_splat_int(s->y + s->height - 1));
    p->alive &= (p->left <= p->right) & (p->top <= p->bottom);
    int edge = pass->tile - 1;
    lom_int wx = p->left & ~1, wy = p->top & ~1;
    lom_mask window =
        (p->right - wx < 4) & (p->bottom - wy < 4) & ((wx & edge) <= edge - 3) & ((wy & edge) <= edge - 3);
    window &= lom_splat_int(pass->samples == 1 ? -1 : 0); /* masks are of centres */
    p->kind =
        lom_select_int(p->small, lom_select_int(window, lom_splat_int(TRIANGLE_WINDOW), lom_splat_int(TRIANGLE_SMALL)),
                       lom_splat_int(TRIANGLE_LARGE));
}

/* The edge functions at the centre of pixel (left & ~1, top & ~1), which lies within two pixels of the bounds: of small
 * triangles all factors are below 2^15, and of the others nobody reads the starts. */
LOM_INLINE struct edge_lanes find_edges(const lom_rect *viewport, const struct packet *p)
{
    struct edge_lanes e;
    lom_int px = (((p->left & ~1) - viewport->x) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    lom_int py = (((p->top & ~1) - viewport->y) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    lom_mask turned = p->sign < 0;
    for (int i = 0; i < 3; i++) {
        const struct vertices *a = &p->v[i == 2 ? 0 : i + 1], *b = &p->v[i == 0 ? 2 : i - 1];
        e.ex[i] = ((b->x - a->x) ^ turned) - turned;
        e.ey[i] = ((b->y - a->y) ^ turned) - turned;
        e.start[i] = lom_dot_pairs(lom_make_pair(e.ex[i], e.ey[i]), lom_make_pair(py - a->y, a->x - px));
        e.dx[i] = -e.ey[i] * SUBPIXELS;
        e.dy[i] = e.ex[i] * SUBPIXELS;
    }
    return e;
}

/* Columns first..last of 4 as bits 0..3. */
LOM_INLINE lom_int span(lom_int first, lom_int last)
{
    return (lom_splat_int(2) << (last & 3)) - (lom_splat_int(1) << (first & 3));
}

/* Exact coverage of the even-aligned 4x4 window at (left & ~1, top & ~1), a bit a pixel, in the order of tile memory:
 * blocks of 2x2. The top-left rule adds -1 to the edges whose own points are outside. */
LOM_INLINE lom_int cover_window(const struct packet *p, const struct edge_lanes *e)
{
    lom_int row[3], mask = { 0 };
    for (int i = 0; i < 3; i++)
        row[i] = e->start[i] + ~((e->ey[i] < 0) | ((e->ey[i] == 0) & (e->ex[i] > 0)));
    for (int y = 0; y < 4; y++) {
        lom_int at[3] = { row[0], row[1], row[2] };
        for (int x = 0; x < 4; x++) {
            int bit = (x & 1) | (y & 1) << 1 | (x >> 1) << 2 | (y >> 1) << 3;
            mask |= ((at[0] | at[1] | at[2]) >= 0) & (1 << bit);
            for (int i = 0; i < 3; i++)
                at[i] += e->dx[i];
        }
        for (int i = 0; i < 3; i++)
            row[i] += e->dy[i];
    }
    if (!lom_any(p->cut)) /* the edges let no pixel outside the vertices' bounds through */
        return mask;
    lom_int wx = p->left & ~1, wy = p->top & ~1;
    lom_int columns = span(p->left - wx, p->right - wx), rows = span(p->top - wy, p->bottom - wy);
    lom_int left_half = columns & 3, right_half = columns >> 2;
    lom_int two_rows = left_half * 5 | right_half * 5 << 4; /* both rows of a pair of 2x2 blocks */
    lom_int top_rows = ((rows & 1) * 0x33) | ((rows >> 1 & 1) * 0xcc);
    lom_int low_rows = ((rows >> 2 & 1) * 0x33) | ((rows >> 3 & 1) * 0xcc);
    lom_int allowed = (two_rows & top_rows) | (two_rows & low_rows) << 8;
    return mask & allowed;
}

/* Clip distances that change sign inside: the outcodes of the corners differ from 0 in their bits. */
static lom_int crossing_distances(const struct lom_chunk *chunk, const uint32_t *corners)
{
    unsigned clips = (1u << chunk->draw->desc.shader->clip_distances) - 1;
    int32_t crossing[LOM_LANES];
    for (int i = 0; i < LOM_LANES; i++, corners += 3)
        crossing[i] = (int32_t)((chunk->assembly->codes[corners[0]] | chunk->assembly->codes[corners[1]] |
                                 chunk->assembly->codes[corners[2]]) &
                                clips);
    return lom_load_int(crossing);
}

/* Whether triangles may be drawn with others: their windows are few, else they are mostly packets by themselves. The parts
 * that cover.wide.c makes of one are less than 4 pixels wider and higher than it is. */
LOM_INLINE lom_mask are_listed(const struct packet *p)
{
    lom_int width = (p->right - p->left + 1) & 127, height = (p->bottom - p->top + 1) & 127; /* of small triangles */
    lom_mask few = (lom_mask)(lom_dot_pairs(width + 4, height + 4) <= LIST_PIXELS);
    return ((p->kind == TRIANGLE_WINDOW) | ((p->kind == TRIANGLE_SMALL) & few)) & (p->clip == 0);
}

LOM_INLINE lom_int pack_state(const struct packet *p, lom_int mask)
{
    lom_int state = lom_select_int(p->kind == TRIANGLE_WINDOW, mask, (lom_int){ 0 });
    lom_int provoking = (p->v[1].row & 1) | (p->v[2].row & 1) << 1;
    return state | p->kind << TRIANGLE_KIND | (p->front & 1) << TRIANGLE_FRONT | (p->cut & 1) << TRIANGLE_CUT |
           provoking << TRIANGLE_PROVOKING | (p->listed & 1) << TRIANGLE_LISTED | p->clip << TRIANGLE_CLIP;
}

/* The tiles of the first and the last pixel. */
struct tiles {
    lom_int first, last;
};

LOM_INLINE struct tiles find_tiles(const struct lom_pass *pass, const struct packet *p)
{
    int shift = __builtin_ctz((unsigned)pass->tile);
    lom_int left = (p->left - pass->tile_x0) >> shift, right = (p->right - pass->tile_x0) >> shift;
    lom_int top = (p->top - pass->tile_y0) >> shift, bottom = (p->bottom - pass->tile_y0) >> shift;
    return (struct tiles){ top * pass->tiles_x + left, bottom * pass->tiles_x + right };
}

/* Where the lanes that are alive go, each with what it has; narrow lanes have no permutation, and leave gaps that the next
 * lane fills. */
struct order {
    lom_int which, place;
};

LOM_INLINE struct order find_order(lom_mask alive)
{
    int32_t lanes[LOM_LANES];
    if (LOM_LANES > 4) {
        lom_compress((float *)lanes, alive, lom_as_float(lom_lane_index()));
        return (struct order){ lom_load_int(lanes) & (LOM_LANES - 1), lom_lane_index() };
    }
    uint32_t bits = lom_bits(alive);
    for (int i = 0, next = 0; i < LOM_LANES; next += (int)(bits >> i & 1), i++)
        lanes[i] = next;
    return (struct order){ lom_lane_index(), lom_load_int(lanes) };
}

LOM_INLINE lom_float put(const struct order *order, lom_int x)
{
    return LOM_LANES > 4 ? lom_permute(lom_as_float(x), order->which) : lom_as_float(x);
}

/* Appends the lanes that are alive, and widens the range of tiles. Writes up to LOM_LANES records and half of another. */
static void append(const struct lom_pass *pass, struct lom_chunk *chunk, const struct packet *p, lom_int mask,
                   struct tiles *range)
{
    enum { WORDS = sizeof(lom_primitive) / sizeof(float) };
    int32_t *tile = chunk->assembly->tile + chunk->triangle_count;
    float *to = (float *)(void *)(chunk->primitives + chunk->triangle_count);
    struct tiles tiles = find_tiles(pass, p);
    chunk->all_listed &= !lom_any(p->alive & ~p->listed);
    range->first = lom_select_int(p->alive, lom_min_int(range->first, tiles.first), range->first);
    range->last = lom_select_int(p->alive, lom_max_int(range->last, tiles.last), range->last);
    lom_int only = lom_select_int(tiles.first == tiles.last, tiles.first, lom_splat_int(SEVERAL_TILES));
    struct order order = find_order(p->alive);
    lom_int at = order.place * WORDS;
    lom_float first = put(&order, p->left | p->top << 16), last = put(&order, p->right | p->bottom << 16);
    if (LOM_LANES > 4)
        lom_store((float *)tile, put(&order, only));
    for (int i = 0; i < LOM_LANES && LOM_LANES == 4; i++)
        tile[order.place[i]] = only[i];
    lom_scatter_rows(to + 4, at, (lom_float4){ first, last, first, last });
    lom_scatter_rows(to, at,
                     (lom_float4){ put(&order, p->v[0].row & ~3), put(&order, p->v[1].row & ~3),
                                   put(&order, p->v[2].row & ~3), put(&order, pack_state(p, mask)) });
    chunk->triangle_count += lom_count(p->alive);
}

static void set_up_packet(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t *corners, uint32_t base,
                          lom_mask alive, struct tiles *range)
{
    struct packet p;
    int32_t rows[3 * LOM_LANES];
    find_rows(chunk, corners, base, rows);
    for (int k = 0; k < 3; k++)
        load_corner(chunk, rows, k, &p.v[k]);
    p.alive = alive;
    LOM_RECORD_HOOK(lom_record_stage, chunk, corners, RECORD_SENT, &p.alive);
    measure(&p);
    cull(chunk->draw, &p);
    LOM_RECORD_HOOK(lom_record_stage, chunk, corners, RECORD_FACES, &p.alive);
    if (!lom_any(p.alive))
        return;
    for (int k = 0; k < 3; k++)
        p.v[k].row = lom_gather_int(rows + k, lom_lane_index() * 3) + (k == 2 ? 1 : 0);
    order(&p, 0, 1);
    order(&p, 1, 2);
    order(&p, 0, 1);
    bound(pass, chunk->draw, &p);
    if (!lom_any(p.alive))
        return;
    LOM_RECORD_HOOK(lom_record_stage, chunk, corners, RECORD_IN_BOUNDS, &p.alive);
    lom_int mask = { 0 };
    if (lom_any(p.alive & (p.kind == TRIANGLE_WINDOW))) {
        struct edge_lanes e = find_edges(&chunk->draw->desc.viewport, &p);
        mask = cover_window(&p, &e);
        p.alive &= (p.kind != TRIANGLE_WINDOW) | (mask != 0);
    }
    LOM_RECORD_HOOK(lom_record_stage, chunk, corners, RECORD_DONE, &p.alive);
    p.clip = (lom_int){ 0 };
    if (chunk->any_code != 0)
        p.clip = crossing_distances(chunk, corners);
    p.listed = are_listed(&p);
    if (lom_any(p.alive))
        append(pass, chunk, &p, mask, range);
}

static void widen_range(struct lom_chunk *chunk, const struct tiles *range)
{
    for (int i = 0; i < LOM_LANES; i++)
        lom_widen_tiles(chunk, range->first[i], range->last[i]);
}

void LOM_WIDE(lom_set_up)(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t *corners, uint32_t base,
                          size_t count)
{
    struct tiles range = { lom_splat_int(INT32_MAX), lom_splat_int(-1) };
    if (!lom_reserve_primitives(chunk, chunk->triangle_count + count))
        return;
    for (size_t first = 0; first < count; first += LOM_LANES, corners += 3 * LOM_LANES) {
        size_t live = count - first;
        if (live >= LOM_LANES) {
            set_up_packet(pass, chunk, corners, base, lom_splat_int(-1), &range);
            continue;
        }
        uint32_t padded[3 * LOM_LANES];
        for (size_t i = 0; i < LOM_LANES; i++)
            memcpy(padded + 3 * i, corners + 3 * (i < live ? i : 0), 3 * sizeof padded[0]);
        set_up_packet(pass, chunk, padded, base, lom_lane_index() < (int32_t)live, &range);
    }
    widen_range(chunk, &range);
}
