/* Stage 5 of 7 where pixels have several samples. In: the triangles of a tile, in order. Out: fragments, each with the
 * samples of its pixel that are covered and pass the early depth test, to the queue. Windows of 4x4 pixels as in
 * raster.wide.c.
 *
 * Invariant: coverage, weights, clip distances and depth at a sample are those that raster.wide.c finds at the centre of a
 * pixel that lies where the sample lies: edge functions are exact integers there too, since samples lie on sixteenths. */
#include "pipeline/edges.h"
#include "pipeline/sample_depth.h"
#include "pipeline/sample_tests.h"

enum { CENTRE = LOM_MAX_SAMPLES, PLACES = LOM_MAX_SAMPLES + 1 }; /* the samples of a pixel, then its centre */

/* A triangle over one tile. The edge functions with the bias of the top-left rule are in int32: as they are where the
 * triangle is small, else >> 8, which steps by exact integers from pixel to pixel and keeps the sign. */
struct sampled {
    const lom_triangle *triangle;
    int32_t number;
    struct lom_bounds bounds;
    struct depth_plane depth;
    bool cut, large;
    int samples;
    int32_t dx[3], dy[3], start[3][PLACES]; /* at the places of the tile's first pixel */
    int32_t low[3], high[3];                /* of the starts */
    int bias[3];
    struct lom_edges edges;
    double place[2][PLACES];     /* edge functions 1 and 2 at the places of a pixel, less that at its centre */
    lom_double offset[2][PARTS]; /* of a window's pixels less that of its first; all exact, of large triangles */
    lom_int lanes[3][PARTS];     /* what the pixels of a window add */
};

/* An edge function's change from a pixel's centre to a place in it; steps are multiples of 256. */
static int64_t change(const struct lom_pass *pass, const struct lom_edges *e, int i, int place)
{
    return place == CENTRE ? 0 : e->dx[i] / 16 * pass->offset[place].x + e->dy[i] / 16 * pass->offset[place].y;
}

/* False where no place of the tile is inside. */
static bool find_edge(const struct lom_pass *pass, struct sampled *g, int i)
{
    const struct lom_edges *e = &g->edges;
    const int64_t span = pass->tile - 1, right = e->dx[i] * span, down = e->dy[i] * span;
    int64_t start[PLACES], least = INT64_MAX, most = INT64_MIN;
    int shift = g->large ? SUBPIXEL_BITS : 0;
    g->bias[i] = bias_of(e->dx[i], e->dy[i]);
    for (int s = 0; s < PLACES; s++) {
        int place = s < g->samples ? s : CENTRE;
        start[s] = e->start[i] + change(pass, e, i, place) + g->bias[i];
        least = start[s] < least ? start[s] : least;
        most = start[s] > most ? start[s] : most;
    }
    bool outside = most + (right > 0 ? right : 0) + (down > 0 ? down : 0) < 0;
    bool inside = least + (right < 0 ? right : 0) + (down < 0 ? down : 0) >= 0;
    bool constant = g->large && (inside || outside); /* what may not fit int32 does not matter then */
    g->dx[i] = constant ? 0 : (int32_t)(e->dx[i] >> shift);
    g->dy[i] = constant ? 0 : (int32_t)(e->dy[i] >> shift);
    for (int s = 0; s < PLACES; s++)
        g->start[i][s] = constant ? 0 : (int32_t)(start[s] >> shift);
    g->low[i] = constant ? 0 : (int32_t)(least >> shift);
    g->high[i] = constant ? 0 : (int32_t)(most >> shift);
    return !outside;
}

/* False where the tile has nothing of the triangle. */
static bool find_triangle(const struct lom_tile *tile, const lom_triangle *t, int32_t number, struct sampled *g)
{
    const struct lom_pass *pass = tile->pass;
    g->triangle = t;
    g->number = number;
    g->bounds = lom_bounds_of(&t->primitive);
    g->depth = find_depth(t);
    g->cut = t->primitive.state >> TRIANGLE_CUT & 1;
    g->large = lom_kind_of(&t->primitive) == TRIANGLE_LARGE;
    g->samples = pass->samples;
    g->edges = lom_find_edges(tile, t);
    for (int i = 0; i < 3; i++) {
        if (!find_edge(pass, g, i))
            return false;
        for (int part = 0; part < PARTS; part++)
            g->lanes[i][part] = lane_x(part) * g->dx[i] + lane_y(part) * g->dy[i];
    }
    for (int s = 0; s < PLACES; s++)
        for (int i = 0; i < 2 && (s < g->samples || s == CENTRE); i++)
            g->place[i][s] = (double)change(pass, &g->edges, i + 1, s);
    for (int part = 0; part < PARTS && g->large; part++) {
        const lom_double x = lom_to_double(lane_x(part)), y = lom_to_double(lane_y(part));
        for (int i = 0; i < 2; i++)
            g->offset[i][part] = x * (double)g->edges.dx[i + 1] + y * (double)g->edges.dy[i + 1];
    }
    return true;
}

/* A part of a window at (x, y) of the tile. */
struct at {
    int x, y, part, index; /* index: of the window in tile memory */
    int32_t base[3];       /* what its window adds to the starts of the edge functions */
    double first[2];       /* of a large triangle: edge functions 1 and 2 at the window's first pixel */
};

/* Their places in tile memory. */
LOM_INLINE lom_int pixels_of(const struct lom_tile *tile, const struct at *at)
{
    return lom_load_int(tile->offset + at->part * LOM_LANES) + at->index;
}

/* The weights at a place of the pixels, as raster.wide.c and raster_large.wide.c find them. */
LOM_INLINE void weigh(const struct sampled *g, const struct at *at, int place, lom_float l[3])
{
    const float inverse = g->triangle->inverse_area;
    if (!g->large) {
        for (int i = 0; i < 3; i++)
            l[i] = lom_to_float(g->lanes[i][at->part] + (g->start[i][place] + at->base[i] - g->bias[i])) * inverse;
        return;
    }
    const struct lom_edges *e = &g->edges;
    const double area = (double)e->area;
    lom_double value[2];
    for (int i = 0; i < 2; i++) {
        value[i] = g->offset[i][at->part] + (at->first[i] + g->place[i][place]);
        l[i + 1] = __builtin_convertvector(value[i], lom_float) * inverse;
    }
    l[0] = __builtin_convertvector(area - value[0] - value[1], lom_float) * inverse;
}

/* What a part has of the triangle: for each place the lanes that are covered. */
struct coverage {
    lom_mask lanes[PLACES], any; /* any: of a sample */
};

LOM_INLINE lom_mask cover_place(const struct sampled *g, const struct at *at, int place)
{
    lom_int inside = { 0 };
    for (int i = 0; i < 3; i++)
        inside |= g->lanes[i][at->part] + (g->start[i][place] + at->base[i]);
    return inside >= 0;
}

LOM_INLINE void cover(const struct lom_tile *tile, const struct sampled *g, const struct at *at, bool full,
                      struct coverage *c)
{
    lom_mask allowed = g->cut ? inside_bounds(tile, &g->bounds, at->x, at->y, at->part) : lom_splat_int(-1);
    c->any = (lom_mask){ 0 };
    for (int s = 0; s < g->samples; s++) {
        c->lanes[s] = full ? allowed : cover_place(g, at, s) & allowed;
        c->any |= c->lanes[s];
    }
    c->lanes[CENTRE] = full ? allowed : cover_place(g, at, CENTRE) & allowed;
}

static void cut_by_distances(const struct lom_tile *tile, const struct sampled *g, const struct at *at,
                             struct coverage *c)
{
    c->any = (lom_mask){ 0 };
    for (int s = 0; s < PLACES; s++) {
        lom_float l[3];
        if (s >= g->samples && s != CENTRE)
            continue;
        weigh(g, at, s, l);
        LOM_WIDE(lom_test_distances)(tile, g->triangle, l, &c->lanes[s]);
        if (s != CENTRE)
            c->any |= c->lanes[s];
    }
}

static lom_float depth_of(const struct lom_tile *tile, const struct sampled *g, const lom_float l[3])
{
    lom_float z = interpolate_depth(&g->depth, l);
    if (tile->draw->biased) {
        lom_float moved = z;
        LOM_WIDE(lom_offset_depth)(tile, g->triangle, &moved);
        z = moved;
    }
    return z;
}

/* The early test of the depths at the samples. */
static void test_samples(struct lom_tile *tile, const struct sampled *g, const struct at *at, struct coverage *c,
                         const lom_float depth[LOM_MAX_SAMPLES])
{
    const lom_int pixel = pixels_of(tile, at);
    if (tile->tests_all)
        LOM_WIDE(lom_test_samples)(tile, &pixel, lom_faces_front(tile->draw, &g->triangle->primitive), c->lanes, depth);
    else
        lom_test_sample_depths(tile, pixel, c->lanes, depth);
    c->any = (lom_mask){ 0 };
    for (int s = 0; s < g->samples; s++)
        c->any |= c->lanes[s];
}

static void find_depths(const struct lom_tile *tile, const struct sampled *g, const struct at *at,
                        lom_float depth[LOM_MAX_SAMPLES])
{
    for (int s = 0; s < g->samples; s++) {
        lom_float l[3];
        weigh(g, at, s, l);
        depth[s] = depth_of(tile, g, l);
    }
}

/* Where fragments are shaded: at the centre where that is covered (in whole quads everywhere), else at the first sample that
 * is. In: the coverage before the depth test. */
static void place_shading(const struct lom_tile *tile, const struct sampled *g, const struct at *at,
                          const struct coverage *c, struct lom_fragments *f)
{
    lom_mask elsewhere = c->any & ~c->lanes[CENTRE];
    f->place = (lom_int){ 0 };
    weigh(g, at, CENTRE, f->l);
    if (tile->draw->desc.shader->quads || !lom_any(elsewhere))
        return;
    for (int s = g->samples - 1; s >= 0; s--) {
        lom_mask here = elsewhere & c->lanes[s];
        lom_float l[3];
        if (!lom_any(here))
            continue;
        weigh(g, at, s, l);
        for (int k = 0; k < 3; k++)
            f->l[k] = lom_select(here, l[k], f->l[k]);
        f->place = lom_select_int(here, lom_splat_int(s + 1), f->place);
    }
}

/* A fragment for each sample that is covered, shaded there. */
static void deliver_each(struct lom_tile *tile, const struct sampled *g, const struct at *at, const struct coverage *c,
                         const lom_float *depth, struct lom_fragments *f)
{
    for (int s = 0; s < g->samples; s++) {
        if (!lom_any(c->lanes[s]))
            continue;
        weigh(g, at, s, f->l);
        f->covered = c->lanes[s];
        f->samples = f->covered & 1 << s;
        f->place = lom_splat_int(s + 1);
        f->depth = depth[s];
        tile->fragments += lom_count(f->covered);
        LOM_WIDE(lom_deliver)(tile, f, g->large);
    }
}

static void deliver(struct lom_tile *tile, const struct sampled *g, const struct coverage *c, struct lom_fragments *f)
{
    f->covered = c->any;
    f->samples = (lom_int){ 0 };
    for (int s = 0; s < g->samples; s++)
        f->samples |= c->lanes[s] & 1 << s;
    f->depth = depth_of(tile, g, f->l);
    LOM_WIDE(lom_deliver)(tile, f, g->large);
}

static void raster_part(struct lom_tile *tile, const struct sampled *g, const struct at *at, bool full)
{
    const struct lom_draw *draw = tile->draw;
    struct coverage c;
    struct lom_fragments f;
    lom_float depth[LOM_MAX_SAMPLES];
    cover(tile, g, at, full, &c);
    if (g->triangle->primitive.state >> TRIANGLE_CLIP != 0)
        cut_by_distances(tile, g, at, &c);
    if (!lom_any(c.any))
        return;
    bool each = draw->desc.per_sample, shades = draw->desc.shader->fragment[draw->variant] != NULL;
    if (shades && !each)
        place_shading(tile, g, at, &c, &f);
    if (tile->depth != NULL || draw->queues_depth)
        find_depths(tile, g, at, depth);
    if (tile->tests_early || tile->tests_all)
        test_samples(tile, g, at, &c, depth);
    if (!each || !shades)
        tile->fragments += lom_count(c.any);
    if (tile->rejects_early)
        test_samples(tile, g, at, &c, depth);
    if (!shades || !lom_any(c.any))
        return;
    f.triangle = lom_splat_int(g->number);
    f.pixel = pixels_of(tile, at);
    f.sample_depth = depth;
    if (each)
        deliver_each(tile, g, at, &c, depth, &f);
    else
        deliver(tile, g, &c, &f);
}

/* How a window at (x, y) of the tile lies to the edges. */
enum { NONE, SOME, ALL };

static int classify(const struct sampled *g, int x, int y)
{
    int kind = ALL;
    for (int i = 0; i < 3; i++) {
        int32_t base = g->dx[i] * x + g->dy[i] * y, right = 3 * g->dx[i], down = 3 * g->dy[i];
        int32_t low = g->low[i] + base + (right < 0 ? right : 0) + (down < 0 ? down : 0);
        int32_t high = g->high[i] + base + (right > 0 ? right : 0) + (down > 0 ? down : 0);
        if (high < 0)
            return NONE;
        if (low < 0)
            kind = SOME;
    }
    return kind;
}

void LOM_WIDE(lom_raster_sampled)(struct lom_tile *tile, const lom_triangle *t, int32_t number)
{
    struct sampled g;
    if (!find_triangle(tile, t, number, &g))
        return;
    if (g.large && tile->queue.count > 0)
        LOM_WIDE(lom_flush)(tile);
    struct window_range r = windows_of(tile, &g.bounds);
    for (int y = r.y0; y <= r.y1; y += 4)
        for (int x = r.x0; x <= r.x1; x += 4) {
            int kind = classify(&g, x, y);
            struct at at = { .x = x, .y = y };
            for (int i = 0; i < 3; i++)
                at.base[i] = g.dx[i] * x + g.dy[i] * y;
            for (int i = 0; i < 2 && g.large; i++)
                at.first[i] = (double)(g.edges.start[i + 1] + g.edges.dx[i + 1] * x + g.edges.dy[i + 1] * y);
            at.index = memory_index(tile, x, y);
            for (; kind != NONE && at.part < PARTS; at.part++)
                raster_part(tile, &g, &at, kind == ALL);
        }
}
