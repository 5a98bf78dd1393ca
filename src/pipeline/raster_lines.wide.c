/* Stage 5 of 7 for lines. In: the lines of a tile, in order. Out: covered fragments that pass the early depth test, in the
 * queue, by windows of 4x4 pixels as those of triangles. What a line covers is found along its major axis, one column (or
 * row) of pixels at a time, in whole numbers; its weights are those of line.c.
 *
 * A line of width 1 covers at most one pixel of a column: with a slope of at most 1 the segment's line meets the diamond
 * that holds its point (x0, y), x0 the middle of the column, and no other one of the column, since |u| + |v| >= 1/2 + (1 -
 * |slope|) |u| holds everywhere on it for those. Of the segment that pixel is covered where it does not end in the diamond and
 * ends behind x0, and begins before x0 or in the diamond.
 *
 * Invariant: the pixels of a column follow from the snapped ends alone, whatever tile they lie in. */
#include "pipeline/sample_depth.h"
#include "pipeline/sample_tests.h"

#include <lom/lanes_mathematics.h>

enum { MAJOR, MINOR, HALF = SUBPIXELS / 2 };

/* A line over one tile. */
struct line {
    const lom_triangle *record;
    int32_t number;
    struct lom_bounds bounds;
    struct depth_plane depth;
    bool steep; /* y-major */
    int width;
    int64_t a[2], b[2];         /* the ends along the axes, moved for its width, from the viewport's corner */
    int origin[2];              /* the viewport's corner */
    int64_t length;             /* |b - a| along the major axis */
    int64_t rise;               /* of the minor one over it, to the right or down */
    double start, dx, dy, area; /* E at the tile's first pixel, its steps, its range 0..area; exact */
};

static void find_line(const struct lom_tile *tile, const lom_triangle *t, int32_t number, struct line *g)
{
    const lom_rect *viewport = &tile->draw->desc.viewport;
    int32_t a[2], b[2];
    memcpy(a, tile->chunk->rows + t->primitive.row[0], sizeof a);
    memcpy(b, tile->chunk->rows + t->primitive.row[1], sizeof b);
    int64_t x = (int64_t)b[0] - a[0], y = (int64_t)b[1] - a[1];
    g->record = t;
    g->number = number;
    g->bounds = lom_bounds_of(&t->primitive);
    g->depth = find_depth(t);
    g->steep = (y < 0 ? -y : y) > (x < 0 ? -x : x);
    g->width = tile->draw->desc.line_width;
    const int major = g->steep, moved = (g->width - 1) * HALF;
    g->a[MAJOR] = a[major];
    g->b[MAJOR] = b[major];
    g->a[MINOR] = a[1 - major] - moved;
    g->b[MINOR] = b[1 - major] - moved;
    g->origin[MAJOR] = g->steep ? viewport->y : viewport->x;
    g->origin[MINOR] = g->steep ? viewport->x : viewport->y;
    const bool forward = g->b[MAJOR] > g->a[MAJOR];
    g->length = forward ? g->b[MAJOR] - g->a[MAJOR] : g->a[MAJOR] - g->b[MAJOR];
    g->rise = forward ? g->b[MINOR] - g->a[MINOR] : g->a[MINOR] - g->b[MINOR];
    int64_t px = (int64_t)(tile->x - viewport->x) * SUBPIXELS + HALF,
            py = (int64_t)(tile->y - viewport->y) * SUBPIXELS + HALF;
    g->start = (double)((px - a[0]) * x + (py - a[1]) * y);
    g->dx = (double)(x * SUBPIXELS);
    g->dy = (double)(y * SUBPIXELS);
    g->area = (double)(x * x + y * y);
}

/* Whether p, moved by (-e, -e^2), lies in the diamond about a centre: on its edge where the move along x leads inside. */
static bool is_in_diamond(const struct line *g, const int64_t p[2], const int64_t centre[2])
{
    int64_t u = p[MAJOR] - centre[MAJOR], v = p[MINOR] - centre[MINOR], x = g->steep ? v : u;
    int64_t sum = (u < 0 ? -u : u) + (v < 0 ? -v : v);
    return sum < HALF || (sum == HALF && x > 0);
}

/* The first pixel of column (or row) `at` that is covered, both from the viewport's corner; false where none is. The moved
 * line lies at y + slope e - e^2 there, or at x + slope e^2 - e. */
static bool find_first(const struct line *g, int64_t at, int64_t *first)
{
    const bool forward = g->b[MAJOR] > g->a[MAJOR], above = !g->steep && g->rise > 0;
    int64_t centre[2] = { at * SUBPIXELS + HALF, 0 }, divisor = g->length * SUBPIXELS;
    int64_t crossing = g->a[MINOR] * g->length + g->rise * (centre[MAJOR] - g->a[MAJOR]) - (above ? 0 : 1);
    *first = crossing / divisor - (crossing % divisor < 0);
    centre[MINOR] = *first * SUBPIXELS + HALF;
    bool begins = forward ? g->a[MAJOR] <= centre[MAJOR] : g->a[MAJOR] > centre[MAJOR];
    bool ends = forward ? g->b[MAJOR] > centre[MAJOR] : g->b[MAJOR] <= centre[MAJOR];
    return ends && (begins || is_in_diamond(g, g->a, centre)) && !is_in_diamond(g, g->b, centre);
}

/* Of four columns (or rows), from one of the tile on: the first and the last pixel of the tile that is covered. */
struct runs {
    int32_t first[4], last[4];
    int least, most;
};

static struct runs find_runs(const struct lom_tile *tile, const struct line *g, int at)
{
    const struct lom_bounds *b = &g->bounds;
    const int low[2] = { g->steep ? b->top : b->left, g->steep ? b->left : b->top };
    const int high[2] = { g->steep ? b->bottom : b->right, g->steep ? b->right : b->bottom };
    const int corner[2] = { g->steep ? tile->y : tile->x, g->steep ? tile->x : tile->y };
    struct runs r = { .least = tile->edge, .most = -1 };
    for (int i = 0; i < 4; i++) {
        int column = corner[MAJOR] + at + i;
        int64_t first;
        r.first[i] = tile->edge;
        r.last[i] = -1;
        if (column < low[MAJOR] || column > high[MAJOR] || !find_first(g, column - g->origin[MAJOR], &first))
            continue;
        first += g->origin[MINOR];
        int64_t last = first + g->width - 1, from = low[MINOR] > corner[MINOR] ? low[MINOR] : corner[MINOR],
                to = corner[MINOR] + tile->edge - 1;
        to = high[MINOR] < to ? high[MINOR] : to;
        if (first > to || last < from)
            continue;
        r.first[i] = (int32_t)((first > from ? first : from) - corner[MINOR]);
        r.last[i] = (int32_t)((last < to ? last : to) - corner[MINOR]);
        r.least = r.first[i] < r.least ? r.first[i] : r.least;
        r.most = r.last[i] > r.most ? r.last[i] : r.most;
    }
    return r;
}

static void weigh(const struct line *g, int x, int y, int part, lom_float l[3])
{
    lom_double e = lom_to_double(lane_x(part) + x) * g->dx + lom_to_double(lane_y(part) + y) * g->dy + g->start;
    const lom_double zero = { 0 }, area = lom_splat_double(g->area);
    e = lom_select_double(e > zero, lom_select_double(e < area, e, area), zero);
    l[0] = lom_narrow(area - e) * g->record->inverse_area;
    l[1] = lom_narrow(e) * g->record->inverse_area;
    l[2] = (lom_float){ 0 };
}

/* The same as lom_emit where pixels have several samples: all of them are covered, with the weights of the centre. */
static void emit_samples(struct lom_tile *tile, const struct part *at, lom_mask covered, const lom_float l[3])
{
    const struct lom_draw *draw = tile->draw;
    lom_mask lanes[LOM_MAX_SAMPLES];
    lom_float depth[LOM_MAX_SAMPLES];
    struct lom_fragments f = { .triangle = lom_splat_int(at->number), .l = { l[0], l[1], l[2] } };
    if (at->triangle->primitive.state >> TRIANGLE_CLIP != 0)
        LOM_WIDE(lom_test_distances)(tile, at->triangle, l, &covered);
    if (tile->depth != NULL || draw->queues_depth)
        f.depth = interpolate_depth(&at->depth, l);
    f.pixel = lom_load_int(tile->offset + at->part * LOM_LANES) + at->base;
    for (int s = 0; s < tile->pass->samples; s++) {
        lanes[s] = covered;
        depth[s] = f.depth;
    }
    if (tile->tests_early)
        lom_test_sample_depths(tile, f.pixel, lanes, depth);
    else if (tile->tests_all)
        LOM_WIDE(lom_test_samples)(tile, &f.pixel, true, lanes, depth);
    for (int s = 0; s < tile->pass->samples; s++)
        f.samples |= lanes[s] & 1 << s;
    f.covered = f.samples != 0;
    tile->fragments += lom_count(f.covered);
    if (!lom_any(f.covered) || draw->desc.shader->fragment[draw->variant] == NULL)
        return;
    f.sample_depth = depth;
    LOM_WIDE(lom_deliver)(tile, &f, false);
}

/* The window at (x, y) of the tile; across: the one of them along the minor axis. */
static void raster_window(struct lom_tile *tile, const struct line *g, const struct runs *r, int across, int x, int y)
{
    struct part at = { g->record, g->number, memory_index(tile, x, y), 0, g->depth };
    for (; at.part < PARTS; at.part++) {
        lom_int column = g->steep ? lane_y(at.part) : lane_x(at.part);
        lom_int pixel = (g->steep ? lane_x(at.part) : lane_y(at.part)) + across;
        lom_mask covered = (pixel >= lom_gather_int(r->first, column)) & (pixel <= lom_gather_int(r->last, column));
        lom_float l[3];
        if (!lom_any(covered))
            continue;
        weigh(g, x, y, at.part, l);
        if (tile->pass->samples > 1)
            emit_samples(tile, &at, covered, l);
        else
            LOM_WIDE(lom_emit)(tile, &at, &covered, l, false);
    }
}

void LOM_WIDE(lom_raster_lines)(struct lom_tile *tile, const uint32_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct line g;
        lom_triangle t;
        lom_find_line(tile->chunk, &tile->chunk->primitives[list[i]], &t);
        find_line(tile, &t, (int32_t)list[i], &g);
        struct window_range w = windows_of(tile, &g.bounds);
        int first = g.steep ? w.y0 : w.x0, last = g.steep ? w.y1 : w.x1;
        for (int along = first; along <= last; along += 4) {
            struct runs r = find_runs(tile, &g, along);
            for (int across = r.least & ~3; across <= r.most; across += 4)
                raster_window(tile, &g, &r, across, g.steep ? across : along, g.steep ? along : across);
        }
    }
}
