/* Stage 3 of 7: setup. In: triangles of projected vertices, in order. Out: a record for each that may cover a pixel
 * centre. LOM_LANES triangles at a time, in exact integers (areas in double, which holds them exactly).
 *
 * Invariant: the record is the same for every order of the three vertices; only facing and the provoking vertex
 * remember it. Triangles that fit a 4x4 window get their exact coverage here, and the empty ones end here. */
#include "pipeline/stages.h"

struct vertices { /* one corner of LOM_LANES triangles */
    lom_int x, y, row;
    lom_float depth;
};

struct packet {
    struct vertices v[3];
    lom_int provoking; /* 0, 1, 2 */
    lom_double area;   /* twice the area, exact; positive clockwise on the screen (y down) */
    lom_int left, top, right, bottom, kind, cut, sign, mask;
    lom_mask alive, front;
};

static void load_corner(const struct lom_chunk *chunk, const uint32_t (*corner)[3], int k, struct vertices *v)
{
    const float *rows[LOM_LANES];
    size_t pitch = (size_t)chunk->draw->row_floats;
    for (int i = 0; i < LOM_LANES; i++) {
        v->row[i] = (int32_t)corner[i][k];
        rows[i] = chunk->rows + corner[i][k] * pitch;
    }
    lom_float4 header = lom_load_rows(rows, 0);
    v->x = lom_as_int(header.x);
    v->y = lom_as_int(header.y);
    v->depth = header.z;
}

/* Vertices a and b in the order of (y, x); tracks where the provoking vertex goes. */
LOM_INLINE void order(struct packet *p, int a, int b)
{
    struct vertices *u = &p->v[a], *v = &p->v[b];
    lom_mask swap = (v->y < u->y) | ((v->y == u->y) & (v->x < u->x));
    struct vertices s = *u;
    u->x = lom_select_int(swap, v->x, u->x);
    u->y = lom_select_int(swap, v->y, u->y);
    u->row = lom_select_int(swap, v->row, u->row);
    u->depth = lom_select(swap, v->depth, u->depth);
    v->x = lom_select_int(swap, s.x, v->x);
    v->y = lom_select_int(swap, s.y, v->y);
    v->row = lom_select_int(swap, s.row, v->row);
    v->depth = lom_select(swap, s.depth, v->depth);
    lom_mask was_a = p->provoking == a, was_b = p->provoking == b;
    p->provoking =
        lom_select_int(swap & was_a, lom_splat_int(b), lom_select_int(swap & was_b, lom_splat_int(a), p->provoking));
}

static lom_double twice_area(const struct packet *p)
{
    lom_double ax = lom_to_double(p->v[1].x - p->v[0].x), ay = lom_to_double(p->v[1].y - p->v[0].y);
    lom_double bx = lom_to_double(p->v[2].x - p->v[0].x), by = lom_to_double(p->v[2].y - p->v[0].y);
    return ax * by - ay * bx;
}

/* A lane mask of a comparison in double. */
LOM_INLINE lom_mask is_positive(lom_double x)
{
    return __builtin_convertvector(x > 0.0, lom_int);
}

LOM_INLINE lom_mask is_negative(lom_double x)
{
    return __builtin_convertvector(x < 0.0, lom_int);
}

/* Facing, culling and orientation. Twice the area is positive clockwise on the screen, where y points down: so positive
 * is back for the usual counter-clockwise fronts. */
static void cull(const struct lom_draw *draw, struct packet *p)
{
    p->area = twice_area(p);
    lom_mask positive = is_positive(p->area), negative = is_negative(p->area);
    p->front = draw->desc.front_clockwise ? positive : negative;
    p->alive &= positive | negative;
    if (draw->desc.cull == LOM_CULL_BACK)
        p->alive &= p->front;
    if (draw->desc.cull == LOM_CULL_FRONT)
        p->alive &= ~p->front;
}

/* The pixels whose centres may be inside, cut by the scissor. */
static void bound(const struct lom_pass *pass, const struct lom_draw *draw, struct packet *p)
{
    const lom_rect *s = &draw->scissor;
    lom_int x0 = lom_min_int(p->v[0].x, lom_min_int(p->v[1].x, p->v[2].x));
    lom_int x1 = lom_max_int(p->v[0].x, lom_max_int(p->v[1].x, p->v[2].x));
    lom_int y0 = p->v[0].y, y1 = p->v[2].y;
    lom_int left = ((x0 + (SUBPIXELS / 2 - 1)) >> SUBPIXEL_BITS) + pass->viewport.x;
    lom_int top = ((y0 + (SUBPIXELS / 2 - 1)) >> SUBPIXEL_BITS) + pass->viewport.y;
    lom_int right = ((x1 - SUBPIXELS / 2) >> SUBPIXEL_BITS) + pass->viewport.x;
    lom_int bottom = ((y1 - SUBPIXELS / 2) >> SUBPIXEL_BITS) + pass->viewport.y;
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
    lom_mask small = (x1 - x0 < SMALL_EXTENT) & (y1 - y0 < SMALL_EXTENT);
    p->kind =
        lom_select_int(small, lom_select_int(window, lom_splat_int(TRIANGLE_WINDOW), lom_splat_int(TRIANGLE_SMALL)),
                       lom_splat_int(TRIANGLE_LARGE));
}

/* Columns first..last of 4 as bits 0..3. */
LOM_INLINE lom_int span(lom_int first, lom_int last)
{
    return (lom_splat_int(2) << (last & 3)) - (lom_splat_int(1) << (first & 3));
}

/* Exact coverage of the even-aligned 4x4 window at (left & ~1, top & ~1), a bit a pixel, in the order of tile memory:
 * blocks of 2x2. Edge i of the ordered triangle runs so that the inside is positive; the top-left rule adds -1 to the
 * edges whose own points are outside. */
static void cover_window(const struct lom_pass *pass, struct packet *p)
{
    lom_int wx = p->left & ~1, wy = p->top & ~1;
    lom_int px = ((wx - pass->viewport.x) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    lom_int py = ((wy - pass->viewport.y) << SUBPIXEL_BITS) + SUBPIXELS / 2;
    lom_int start[3], dx[3], dy[3];
    for (int i = 0; i < 3; i++) {
        const struct vertices *a = &p->v[i == 2 ? 0 : i + 1], *b = &p->v[i == 0 ? 2 : i - 1];
        lom_int ex = (b->x - a->x) * p->sign, ey = (b->y - a->y) * p->sign;
        lom_mask inclusive = (ey < 0) | ((ey == 0) & (ex > 0));
        start[i] = ex * (py - a->y) - ey * (px - a->x) + (~inclusive & -1);
        dx[i] = -ey * SUBPIXELS;
        dy[i] = ex * SUBPIXELS;
    }
    lom_int mask = { 0 };
    for (int k = 0; k < 16; k++) {
        int x = (k & 1) + ((k >> 2) & 1) * 2, y = ((k >> 1) & 1) + (k >> 3) * 2;
        lom_int e0 = start[0] + dx[0] * x + dy[0] * y, e1 = start[1] + dx[1] * x + dy[1] * y,
                e2 = start[2] + dx[2] * x + dy[2] * y;
        mask |= ((e0 | e1 | e2) >= 0) & (1 << k);
    }
    lom_int columns = span(p->left - wx, p->right - wx), rows = span(p->top - wy, p->bottom - wy);
    lom_int left_half = columns & 3, right_half = columns >> 2;
    lom_int two_rows = left_half * 5 | right_half * 5 << 4; /* both rows of a pair of 2x2 blocks */
    lom_int top_rows = ((rows & 1) * 0x33) | ((rows >> 1 & 1) * 0xcc);
    lom_int low_rows = ((rows >> 2 & 1) * 0x33) | ((rows >> 3 & 1) * 0xcc);
    lom_int allowed = (two_rows & top_rows) | (two_rows & low_rows) << 8;
    p->mask = mask & allowed;
}

static uint8_t crossing_distances(const struct lom_chunk *chunk, uint32_t a, uint32_t b, uint32_t c)
{
    unsigned clips = (1u << chunk->draw->desc.shader->clip_distances) - 1;
    return (uint8_t)((chunk->codes[a] | chunk->codes[b] | chunk->codes[c]) & clips);
}

static void append(struct lom_chunk *chunk, const struct packet *p, lom_float inverse, int i)
{
    const float *rows = chunk->rows;
    size_t pitch = (size_t)chunk->draw->row_floats;
    lom_triangle *t = &chunk->triangles[chunk->triangle_count++];
    for (int k = 0; k < 3; k++) {
        t->x[k] = p->v[k].x[i];
        t->y[k] = p->v[k].y[i];
        t->row[k] = rows + (size_t)(uint32_t)p->v[k].row[i] * pitch;
    }
    t->inverse_area = inverse[i];
    t->sign = p->sign[i];
    t->depth[0] = p->v[0].depth[i];
    t->depth[1] = p->v[1].depth[i] - p->v[0].depth[i];
    t->depth[2] = p->v[2].depth[i] - p->v[0].depth[i];
    t->left = (int16_t)p->left[i];
    t->top = (int16_t)p->top[i];
    t->right = (int16_t)p->right[i];
    t->bottom = (int16_t)p->bottom[i];
    t->mask = (uint16_t)p->mask[i];
    t->kind = (uint8_t)p->kind[i];
    t->front = (uint8_t)(p->front[i] & 1);
    t->provoking = (uint8_t)p->provoking[i];
    t->cut = (uint8_t)(p->cut[i] & 1);
    t->clip = crossing_distances(chunk, (uint32_t)p->v[0].row[i], (uint32_t)p->v[1].row[i], (uint32_t)p->v[2].row[i]);
}

static void set_up_packet(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t (*corner)[3],
                          lom_mask alive)
{
    struct packet p;
    for (int k = 0; k < 3; k++)
        load_corner(chunk, corner, k, &p.v[k]);
    p.alive = alive;
    p.provoking = lom_splat_int(2);
    cull(chunk->draw, &p);
    order(&p, 0, 1);
    order(&p, 1, 2);
    order(&p, 0, 1);
    bound(pass, chunk->draw, &p);
    if (!lom_any(p.alive))
        return;
    p.area = twice_area(&p);
    p.sign = (is_positive(p.area) & 1) | is_negative(p.area);
    cover_window(pass, &p);
    p.alive &= (p.kind != TRIANGLE_WINDOW) | (p.mask != 0);
    lom_float area = lom_abs(__builtin_convertvector(p.area, lom_float));
    lom_float inverse = 1.0f / area;
    for (uint32_t bits = lom_bits(p.alive); bits != 0; bits &= bits - 1)
        append(chunk, &p, inverse, __builtin_ctz(bits));
}

void LOM_WIDE(lom_set_up)(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t (*corner)[3], int count)
{
    if (!lom_reserve((void **)&chunk->triangles, &chunk->triangles_capacity, chunk->triangle_count + (size_t)count,
                     sizeof(lom_triangle))) {
        chunk->failed = true;
        return;
    }
    uint32_t padded[LOM_LANES][3];
    for (int first = 0; first < count; first += LOM_LANES) {
        int live = count - first < LOM_LANES ? count - first : LOM_LANES;
        if (live == LOM_LANES) {
            set_up_packet(pass, chunk, corner + first, lom_splat_int(-1));
            continue;
        }
        for (int i = 0; i < LOM_LANES; i++)
            memcpy(padded[i], corner[first + (i < live ? i : 0)], sizeof padded[i]);
        set_up_packet(pass, chunk, (const uint32_t(*)[3])padded, lom_lane_index() < live);
    }
}
