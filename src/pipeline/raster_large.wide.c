/* Stage 5 of 7 for large triangles: those whose edge functions need 64 bits. In: a triangle. Out: its windows of 4x4
 * pixels in the tile; or, while the tile is one colour and a draw of one colour covers all of it, that colour alone.
 *
 * Invariant: weights are fl(fl(E) * fl(1 / area)) of exact integers, here by double, which holds every edge function
 * exactly. */
#include "pipeline/edges.h"
#include "pipeline/window.h"

#include <lom/lanes_mathematics.h>

/* An edge of a large triangle over one tile in units of 256: (E + bias) >> 8 steps by exact integers, since E steps by
 * multiples of 256, and has the sign of E + bias. */
struct tile_edge {
    int32_t start, dx, dy;
};

typedef enum { EDGE_CROSSES, EDGE_INSIDE, EDGE_OUTSIDE } edge_class;

static edge_class reduce_edge(const struct lom_edges *e, int i, int edge, struct tile_edge *k)
{
    int bias = bias_of(e->dx[i], e->dy[i]);
    int64_t start = (e->start[i] + bias) >> SUBPIXEL_BITS, dx = e->dx[i] >> SUBPIXEL_BITS,
            dy = e->dy[i] >> SUBPIXEL_BITS, span = edge - 1;
    int64_t low = start + (dx < 0 ? dx * span : 0) + (dy < 0 ? dy * span : 0);
    int64_t high = start + (dx > 0 ? dx * span : 0) + (dy > 0 ? dy * span : 0);
    *k = (struct tile_edge){ 0, 0, 0 };
    if (high < 0)
        return EDGE_OUTSIDE;
    if (low >= 0)
        return EDGE_INSIDE;
    *k = (struct tile_edge){ (int32_t)start, (int32_t)dx, (int32_t)dy };
    return EDGE_CROSSES;
}

/* A large triangle over one tile. */
struct large {
    const lom_triangle *triangle;
    struct lom_bounds bounds;
    struct depth_plane depth;
    struct lom_edges edges;
    struct tile_edge k[3];
    lom_double offset[2][PARTS]; /* edge functions 1 and 2 of a window's pixels less that of its first, exact */
    lom_int steps[2][PARTS];     /* the same in int32, where that holds the area */
    bool narrow;
    bool needs_weights;
    bool shades; /* whole windows are packets of which nothing is tested */
    bool fills;  /* whole windows can be filled with the draw's constant colour */
    bool cut;
};

/* What of a strip of windows is covered, a bit a window: wholly, or perhaps in part. */
struct strip {
    uint32_t full, some;
};

static struct strip classify_strip(const struct lom_tile *tile, const struct large *g, int y)
{
    struct strip strip = { 0, 0 };
    for (int part = 0; part < PARTS; part++) {
        lom_int x = (lom_lane_index() + part * LOM_LANES) * 4;
        lom_int low = { 0 }, high = { 0 };
        for (int i = 0; i < 3; i++) {
            const struct tile_edge *k = &g->k[i];
            int32_t dx = 3 * k->dx, dy = 3 * k->dy;
            lom_int first = x * k->dx + (k->start + k->dy * y);
            low |= first + ((dx < 0 ? dx : 0) + (dy < 0 ? dy : 0));
            high |= first + ((dx > 0 ? dx : 0) + (dy > 0 ? dy : 0));
        }
        lom_mask full = low >= 0, some = high >= 0;
        if (g->cut) {
            lom_int px = x + tile->x;
            int py = tile->y + y;
            full &= (px >= g->bounds.left) & (px + 3 <= g->bounds.right);
            if (py < g->bounds.top || py + 3 > g->bounds.bottom)
                full = (lom_mask){ 0 };
        }
        strip.full |= lom_bits(full) << part * LOM_LANES;
        strip.some |= lom_bits(some) << part * LOM_LANES;
    }
    return strip;
}

LOM_INLINE lom_mask cover_large(const struct tile_edge k[3], int x, int y, int part)
{
    lom_int inside = { 0 };
    for (int i = 0; i < 3; i++)
        inside |= lane_x(part) * k[i].dx + lane_y(part) * k[i].dy + (k[i].start + k[i].dx * x + k[i].dy * y);
    return inside >= 0;
}

/* Edge functions 1 and 2 at a window's first pixel, and the area. */
struct window_edges {
    lom_double start1, start2, area;
};

LOM_INLINE struct window_edges edges_of_window(const struct lom_edges *e, int x, int y)
{
    return (struct window_edges){ lom_splat_double((double)(e->start[1] + e->dx[1] * x + e->dy[1] * y)),
                                  lom_splat_double((double)(e->start[2] + e->dx[2] * x + e->dy[2] * y)),
                                  lom_splat_double((double)e->area) };
}

LOM_INLINE void weigh(const struct large *g, const struct window_edges *w, int part, lom_float l[3])
{
    lom_double e1 = g->offset[0][part] + w->start1, e2 = g->offset[1][part] + w->start2;
    l[0] = __builtin_convertvector(w->area - e1 - e2, lom_float) * g->triangle->inverse_area;
    l[1] = __builtin_convertvector(e1, lom_float) * g->triangle->inverse_area;
    l[2] = __builtin_convertvector(e2, lom_float) * g->triangle->inverse_area;
}

/* The same of a whole window of a narrow triangle: inside of it no edge function is above the area. Turned to float an
 * exact integer is rounded once, whether by int32 or by double. */
LOM_INLINE void weigh_narrow(const struct large *g, const lom_int start[2], int part, lom_float l[3])
{
    lom_int e1 = g->steps[0][part] + start[0], e2 = g->steps[1][part] + start[1];
    l[0] = lom_to_float((int32_t)g->edges.area - e1 - e2) * g->triangle->inverse_area;
    l[1] = lom_to_float(e1) * g->triangle->inverse_area;
    l[2] = lom_to_float(e2) * g->triangle->inverse_area;
}

/* The window at (x, y) of the tile. */
static void raster_large_window(struct lom_tile *tile, const struct large *g, int32_t number, int x, int y, bool full)
{
    struct part at = { g->triangle, number, memory_index(tile, x, y), 0, g->depth };
    struct window_edges w = edges_of_window(&g->edges, x, y);
    lom_float l[3];
    for (int i = 0; i < 3 && !g->needs_weights; i++)
        l[i] = (lom_float){ 0 };
    for (; at.part < PARTS; at.part++) {
        lom_mask covered = lom_splat_int(-1);
        if (!full) {
            covered = cover_large(g->k, x, y, at.part);
            if (g->cut)
                covered &= inside_bounds(tile, &g->bounds, x, y, at.part);
            if (!lom_any(covered))
                continue;
        }
        if (g->fills) {
            LOM_WIDE(lom_fill_part)(tile, at.base + tile->offset[at.part * LOM_LANES], &covered);
            continue;
        }
        if (g->needs_weights)
            weigh(g, &w, at.part, l);
        LOM_WIDE(lom_emit)(tile, &at, &covered, l, true);
    }
}

static void shade_windows(struct lom_tile *tile, struct lom_windows *windows)
{
    if (windows->count > 0)
        LOM_WIDE(lom_shade_windows)(tile, windows);
    windows->count = 0;
}

/* What raster_large_window does of a whole window with g->shades, once there are enough of them. */
static void add_large_window(struct lom_tile *tile, const struct large *g, struct lom_windows *windows, int x, int y)
{
    const struct lom_edges *e = &g->edges;
    const int first = windows->count, base = memory_index(tile, x, y);
    tile->fragments += 16;
    if (g->narrow) {
        const lom_int start[2] = { lom_splat_int((int32_t)(e->start[1] + e->dx[1] * x + e->dy[1] * y)),
                                   lom_splat_int((int32_t)(e->start[2] + e->dx[2] * x + e->dy[2] * y)) };
        for (int part = 0; part < PARTS; part++)
            weigh_narrow(g, start, part, windows->l[first + part]);
    } else {
        struct window_edges w = edges_of_window(e, x, y);
        for (int part = 0; part < PARTS; part++)
            weigh(g, &w, part, windows->l[first + part]);
    }
    for (int part = 0; part < PARTS; part++)
        windows->base[first + part] = base + tile->offset[part * LOM_LANES];
    windows->count += PARTS;
    if (windows->count == WINDOWS_PACKETS)
        shade_windows(tile, windows);
}

/* Whether the draw's paint goes to every pixel that the triangle covers. */
static bool fills(const struct lom_tile *tile, const lom_primitive *p)
{
    return tile->draw->constant && tile->draw->paint.fills && !tile->tests_early && p->state >> TRIANGLE_CLIP == 0;
}

/* Whether a covered part goes to the fragment stage as it is. */
static bool shades(const struct lom_tile *tile, const lom_primitive *p)
{
    const struct lom_draw *draw = tile->draw;
    return !draw->constant && draw->desc.shader->fragment[draw->variant] != NULL && tile->depth == NULL &&
           !draw->queues_depth && !draw->biased && p->state >> TRIANGLE_CLIP == 0 && !draw->sampled &&
           !draw->marks_edges && !tile->pass->one_by_one;
}

/* Whether int32 holds the area and three steps, which a window has, of edge functions 1 and 2. */
static bool is_narrow(const struct lom_edges *e)
{
    bool fits = e->area <= INT32_MAX;
    for (int i = 1; i < 3; i++)
        fits &= e->dx[i] < 1 << 28 && e->dx[i] > -(1 << 28) && e->dy[i] < 1 << 28 && e->dy[i] > -(1 << 28);
    return fits;
}

/* False when the triangle does not touch the tile. */
static bool find_large(const struct lom_tile *tile, const lom_triangle *t, struct large *g)
{
    const struct lom_draw *draw = tile->draw;
    g->triangle = t;
    g->bounds = lom_bounds_of(&t->primitive);
    g->depth = find_depth(t);
    g->cut = t->primitive.state >> TRIANGLE_CUT & 1;
    g->edges = lom_find_edges(tile, t);
    for (int i = 0; i < 3; i++)
        if (reduce_edge(&g->edges, i, tile->edge, &g->k[i]) == EDGE_OUTSIDE)
            return false;
    g->needs_weights = t->primitive.state >> TRIANGLE_CLIP != 0 || tile->depth != NULL || !draw->constant;
    g->fills = fills(tile, &t->primitive);
    g->shades = shades(tile, &t->primitive);
    g->narrow = is_narrow(&g->edges);
    for (int part = 0; part < PARTS && g->needs_weights; part++) {
        lom_double x = lom_to_double(lane_x(part)), y = lom_to_double(lane_y(part));
        g->offset[0][part] = x * (double)g->edges.dx[1] + y * (double)g->edges.dy[1];
        g->offset[1][part] = x * (double)g->edges.dx[2] + y * (double)g->edges.dy[2];
        for (int i = 0; i < 2 && g->narrow; i++)
            g->steps[i][part] = lane_x(part) * (int32_t)g->edges.dx[i + 1] + lane_y(part) * (int32_t)g->edges.dy[i + 1];
    }
    return true;
}

void LOM_WIDE(lom_raster_large)(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    struct large g;
    struct lom_windows windows;
    windows.number = number;
    windows.count = 0;
    if (!find_large(tile, t, &g))
        return;
    if (tile->queue.count > 0 && !tile->draw->constant)
        LOM_WIDE(lom_flush)(tile);
    struct window_range r = windows_of(tile, &g.bounds);
    uint32_t columns = (UINT32_C(2) << (r.x1 >> 2)) - (UINT32_C(1) << (r.x0 >> 2));
    for (int y = r.y0; y <= r.y1; y += 4) {
        struct strip strip = classify_strip(tile, &g, y);
        for (uint32_t left = strip.some & columns; left != 0;) {
            int first = __builtin_ctz(left);
            int run = __builtin_ctz(~(strip.full & columns) >> first);
            if (run > 1 && g.fills) {
                LOM_WIDE(lom_fill_windows)(tile, memory_index(tile, first * 4, y), run);
                left &= ~(((UINT32_C(1) << run) - 1) << first);
                continue;
            }
            if (run > 0 && g.shades)
                add_large_window(tile, &g, &windows, first * 4, y);
            else
                raster_large_window(tile, &g, number, first * 4, y, run > 0);
            left &= left - 1;
        }
    }
    shade_windows(tile, &windows);
}

/* ---- a tile that is one colour ---- */

/* The pixels of the tile that lie in the attachments. */
static struct lom_bounds inside_attachments(const struct lom_tile *tile)
{
    const struct lom_pass *pass = tile->pass;
    int left = pass->desc.origin_x, top = pass->desc.origin_y, last = tile->edge - 1;
    int right = left + pass->width - 1, bottom = top + pass->height - 1;
    return (struct lom_bounds){ left > tile->x ? left : tile->x, top > tile->y ? top : tile->y,
                                right < tile->x + last ? right : tile->x + last,
                                bottom < tile->y + last ? bottom : tile->y + last };
}

/* Whether the bounds, cut by the scissor, hold all of b. */
static bool holds(const lom_primitive *p, const struct lom_bounds *b)
{
    struct lom_bounds outer = lom_bounds_of(p);
    return outer.left <= b->left && outer.top <= b->top && outer.right >= b->right && outer.bottom >= b->bottom;
}

/* Which edges have all pixels of b on their inside, and which have none, a bit an edge. */
struct sides {
    unsigned whole, empty;
};

static struct sides find_sides(const struct lom_tile *tile, const struct lom_edges *e, const struct lom_bounds *b)
{
    struct sides sides = { 0, 0 };
    int64_t x = b->left - tile->x, y = b->top - tile->y, width = b->right - b->left, height = b->bottom - b->top;
    for (int i = 0; i < 3; i++) {
        int64_t first = e->start[i] + e->dx[i] * x + e->dy[i] * y + bias_of(e->dx[i], e->dy[i]);
        int64_t right = e->dx[i] * width, down = e->dy[i] * height;
        sides.whole |= (unsigned)(first + (right < 0 ? right : 0) + (down < 0 ? down : 0) >= 0) << i;
        sides.empty |= (unsigned)(first + (right > 0 ? right : 0) + (down > 0 ? down : 0) < 0) << i;
    }
    return sides;
}

static struct lom_edges find_edges(const struct lom_tile *tile, const lom_primitive *p)
{
    lom_triangle t;
    lom_find_triangle(tile->chunk, p, &t);
    return lom_find_edges(tile, &t);
}

/* Whether two triangles share an edge, each on its side of it, and have all pixels of b inside their other edges. Their
 * functions of that edge are each other's negative, so a pixel is inside one of them exactly: every pixel of b is
 * covered once. */
static bool cover_together(const struct lom_tile *tile, const struct lom_edges *e, unsigned whole,
                           const lom_primitive *u, const struct lom_bounds *b)
{
    struct lom_edges f = find_edges(tile, u);
    unsigned others = find_sides(tile, &f, b).whole;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (e->start[i] == -f.start[j] && e->dx[i] == -f.dx[j] && e->dy[i] == -f.dy[j] && (whole | 1u << i) == 7 &&
                (others | 1u << j) == 7)
                return true;
    return false;
}

static bool is_foldable(const struct lom_tile *tile, const lom_primitive *p, const struct lom_bounds *b)
{
    return lom_kind_of(p) == TRIANGLE_LARGE && fills(tile, p) && holds(p, b);
}

size_t LOM_WIDE(lom_fold)(struct lom_tile *tile, const uint32_t *list, size_t count)
{
    const lom_primitive *primitives = tile->chunk->primitives;
    struct lom_bounds b = inside_attachments(tile);
    int pixels = (b.right - b.left + 1) * (b.bottom - b.top + 1);
    size_t done = 0;
    while (done < count && is_foldable(tile, &primitives[list[done]], &b)) {
        struct lom_edges e = find_edges(tile, &primitives[list[done]]);
        struct sides sides = find_sides(tile, &e, &b);
        bool pair = sides.whole != 7 && sides.empty == 0;
        if (pair && (done + 1 == count || !is_foldable(tile, &primitives[list[done + 1]], &b) ||
                     !cover_together(tile, &e, sides.whole, &primitives[list[done + 1]], &b)))
            break;
        if (sides.empty == 0)
            LOM_WIDE(lom_fill_tile)(tile, pixels);
        done += pair ? 2 : 1;
    }
    return done;
}
