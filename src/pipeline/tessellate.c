/* The generator of tessellation, between control and evaluation. In: the levels of a patch. Out: the places where it is
 * evaluated and the triangles, lines or points between them. Invariants: all is found in whole numbers; the places of an
 * outer edge follow from its own level, and place n - i is exactly as far from the one end as place i from the other;
 * triangles cover the domain exactly once, with their edges on one another, and none is empty.
 *
 * A level f becomes n segments with ends at 1/2 + (2 i - n) / (2 f) for 0 < i < n: n - 2 segments of the length 1 / f and
 * the two beside the ends of half of what is left, (f - n + 2) / (2 f) (OpenGL 4.6, 11.2.2). Equal spacing is the same with
 * f = n. f is counted in 1 / 65536, rounded up, so that the short segments are 0 nowhere.
 *
 * Inside a triangle the ring k has its corners where the perpendiculars from places k of two edges meet (11.2.2.1). Of an
 * equilateral triangle, moving from an edge by the weight 2 c of the opposite corner takes c from both others; the corner
 * has both weights alike, u_k - c = 2 c, so c = u_k / 3: the places of inner edges are rounded to whole multiples of 3. */
#include "pipeline/tessellate.h"

#include "base/reserve.h"

enum { LEVEL_ONE = 65536 };

struct division {
    uint32_t at[LOM_MAX_LEVEL + 2]; /* 0 .. DOMAIN_ONE */
    int segments;
};

/* A side of a ring: the places along it and how far along they are. */
struct side {
    uint32_t place[LOM_MAX_LEVEL + 2], at[LOM_MAX_LEVEL + 2];
    int segments;
};

/* ---- levels ---- */

static int most_of(const lom_tessellation *t)
{
    return t->most == 0 ? LOM_MAX_LEVEL : t->most;
}

/* In 1 / LEVEL_ONE, clamped and rounded up. */
static uint32_t round_level(lom_spacing spacing, int most, float level)
{
    int low = spacing == LOM_SPACING_FRACTIONAL_EVEN ? 2 : 1;
    if (spacing == LOM_SPACING_FRACTIONAL_EVEN)
        most = most < 2 ? 2 : most & ~1;
    if (spacing == LOM_SPACING_FRACTIONAL_ODD)
        most = (most - 1) | 1;
    double f = level >= (float)low ? (double)level : low; /* NaN, too */
    f = f < most ? f : most;
    double unit = spacing == LOM_SPACING_EQUAL ? 1 : LEVEL_ONE;
    int whole = lom_int_of(-lom_double_floor(-f * unit));
    return (uint32_t)whole * (spacing == LOM_SPACING_EQUAL ? LEVEL_ONE : 1);
}

static int count_segments(lom_spacing spacing, uint32_t level)
{
    uint32_t two = 2 * LEVEL_ONE;
    if (spacing == LOM_SPACING_EQUAL)
        return (int)(level / LEVEL_ONE);
    if (spacing == LOM_SPACING_FRACTIONAL_EVEN)
        return 2 * (int)((level + two - 1) / two);
    return 2 * (int)((level - LEVEL_ONE + two - 1) / two) + 1;
}

/* Where `multiple` is 3, to multiples of it below the middle. */
static void divide(lom_spacing spacing, uint32_t level, int64_t multiple, struct division *d)
{
    int n = d->segments = count_segments(spacing, level);
    const int64_t parts = 2 * (int64_t)level * multiple;
    for (int i = 0; 2 * i < n; i++) {
        int64_t along = DOMAIN_ONE * ((int64_t)level + (2 * i - n) * (int64_t)LEVEL_ONE);
        int64_t at = i == 0 ? 0 : multiple * ((along + parts / 2) / parts);
        d->at[i] = (uint32_t)at;
        d->at[n - i] = (uint32_t)(DOMAIN_ONE - at);
    }
    if (n % 2 == 0)
        d->at[n / 2] = DOMAIN_ONE / 2;
}

static int outer_count(lom_domain domain)
{
    return domain == LOM_DOMAIN_TRIANGLES ? 3 : domain == LOM_DOMAIN_QUADS ? 4 : 2;
}

static int inner_count(lom_domain domain)
{
    return domain == LOM_DOMAIN_TRIANGLES ? 1 : domain == LOM_DOMAIN_QUADS ? 2 : 0;
}

struct lom_pattern_key lom_pattern_key_of(const lom_tessellation *t, const float outer[4], const float inner[2])
{
    struct lom_pattern_key key = { { 0 } };
    static const struct lom_pattern_key none = { { 0 } };
    int edges = outer_count(t->domain), axes = inner_count(t->domain), most = most_of(t);
    bool one = true;
    for (int i = 0; i < edges; i++) {
        if (!(outer[i] > 0))
            return none;
        bool lines = t->domain == LOM_DOMAIN_ISOLINES && i == 0;
        key.level[i] = round_level(lines ? LOM_SPACING_EQUAL : t->spacing, most, outer[i]);
        one &= key.level[i] == LEVEL_ONE;
    }
    for (int i = 0; i < axes; i++) {
        key.level[4 + i] = round_level(t->spacing, most, inner[i]);
        one &= key.level[4 + i] == LEVEL_ONE;
    }
    uint32_t more = t->spacing == LOM_SPACING_EQUAL ? 2 * LEVEL_ONE : LEVEL_ONE + 1;
    for (int i = 0; i < axes; i++)
        if (!one && key.level[4 + i] == LEVEL_ONE)
            key.level[4 + i] = more;
    return key;
}

/* ---- places and triangles ---- */

static uint32_t add_place(struct lom_pattern *p, uint32_t u, uint32_t v)
{
    p->place[p->places][0] = u;
    p->place[p->places][1] = v;
    return (uint32_t)p->places++;
}

static void add_triangle(struct lom_pattern *p, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *corner = p->corner + p->corners;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
    p->corners += 3;
}

/* The strip between a side and the one inside it, from their first places to their last: whichever next segment has its
 * middle nearer to the start goes on; of two alike the outer one before the half and the inner one behind it, so that a
 * side that is turned round has the same strip turned round. */
static void bridge(struct lom_pattern *p, const struct side *outer, const struct side *inner)
{
    int i = 0, k = 0;
    while (i < outer->segments || k < inner->segments) {
        uint32_t out = i < outer->segments ? outer->at[i] + outer->at[i + 1] : UINT32_MAX;
        uint32_t in = k < inner->segments ? inner->at[k] + inner->at[k + 1] : UINT32_MAX;
        if (out < in || (out == in && out < DOMAIN_ONE)) {
            add_triangle(p, outer->place[i], outer->place[i + 1], inner->place[k]);
            i++;
        } else {
            add_triangle(p, outer->place[i], inner->place[k + 1], inner->place[k]);
            k++;
        }
    }
}

/* ---- triangles ---- */

/* The place with the weight 2 c of corner `side`, on the line from corner side + 1 to side + 2. */
static uint32_t add_weights(struct lom_pattern *p, int side, uint32_t at, uint32_t c)
{
    uint32_t weight[3];
    weight[side] = 2 * c;
    weight[(side + 1) % 3] = DOMAIN_ONE - at - c;
    weight[(side + 2) % 3] = at - c;
    return add_place(p, weight[0], weight[1]);
}

/* Ring k of what `d` cuts each side into: places k .. n - k of each; the ring of no segments is the centre. */
static void add_ring(struct lom_pattern *p, const struct division d[3], int k, struct side ring[3])
{
    uint32_t first = (uint32_t)p->places;
    for (int e = 0; e < 3; e++) {
        const struct division *along = &d[e];
        struct side *side = &ring[e];
        uint32_t c = along->at[k] / 3;
        side->segments = along->segments - 2 * k;
        for (int j = 0; j < side->segments; j++) {
            side->at[j] = along->at[k + j];
            side->place[j] = add_weights(p, e, side->at[j], c);
        }
        side->at[side->segments] = along->at[k + side->segments];
    }
    if (ring[0].segments == 0)
        add_place(p, DOMAIN_ONE / 3, DOMAIN_ONE / 3);
    for (int e = 0; e < 3; e++)
        ring[e].place[ring[e].segments] = e < 2 && ring[0].segments != 0 ? ring[e + 1].place[0] : first;
}

static void cut_triangle(const lom_tessellation *t, const struct lom_pattern_key *key, struct lom_pattern *p)
{
    struct division edge[3], inside[3];
    struct side ring[2][3];
    for (int e = 0; e < 3; e++) {
        divide(t->spacing, key->level[e], 1, &edge[e]);
        divide(t->spacing, key->level[4], 3, &inside[e]);
    }
    int n = inside[0].segments;
    add_ring(p, edge, 0, ring[0]);
    for (int k = 1; 2 * k <= n; k++) {
        add_ring(p, inside, k, ring[k & 1]);
        for (int e = 0; e < 3; e++)
            bridge(p, &ring[~k & 1][e], &ring[k & 1][e]);
    }
    const struct side *last = ring[n / 2 & 1];
    if (n % 2 == 1)
        add_triangle(p, last[0].place[0], last[1].place[0], last[2].place[0]);
}

/* ---- quads ---- */

/* Sides in the order counter-clockwise from (0, 0): v = 0, u = 1, v = 1, u = 0, each run through in that direction. */
static void add_border(struct lom_pattern *p, const struct division edge[4], struct side border[4])
{
    static const uint8_t which[4] = { 1, 2, 3, 0 };
    for (int e = 0; e < 4; e++) {
        const struct division *d = &edge[which[e]];
        border[e].segments = d->segments;
        for (int j = 0; j <= d->segments; j++) {
            uint32_t at = border[e].at[j] = d->at[j], back = DOMAIN_ONE - at;
            if (j < d->segments)
                border[e].place[j] = add_place(p,
                                               e == 0   ? at
                                               : e == 1 ? DOMAIN_ONE
                                               : e == 2 ? back
                                                        : 0,
                                               e == 0   ? 0
                                               : e == 1 ? at
                                               : e == 2 ? DOMAIN_ONE
                                                        : back);
        }
    }
    for (int e = 0; e < 4; e++)
        border[e].place[border[e].segments] = border[(e + 1) % 4].place[0];
}

/* The grid of inner places, and its sides in the same order; of one column or row they run there and back. */
static void add_grid(struct lom_pattern *p, const struct division *u, const struct division *v, struct side side[4])
{
    int columns = u->segments - 1, rows = v->segments - 1;
    uint32_t first = (uint32_t)p->places, pitch = (uint32_t)columns;
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++)
            add_place(p, u->at[c + 1], v->at[r + 1]);
    uint32_t right = first + pitch - 1, top = (uint32_t)(rows - 1) * pitch;
    for (int e = 0; e < 4; e++) {
        const struct division *d = e % 2 == 0 ? u : v;
        side[e].segments = d->segments - 2;
        for (int j = 0; j < d->segments - 1; j++) {
            uint32_t at = (uint32_t)j;
            side[e].at[j] = d->at[j + 1];
            side[e].place[j] = e == 0   ? first + at
                               : e == 1 ? right + at * pitch
                               : e == 2 ? right + top - at
                                        : first + top - at * pitch;
        }
    }
    for (int r = 0; r + 1 < rows; r++)
        for (int c = 0; c + 1 < columns; c++) {
            uint32_t a = first + (uint32_t)r * pitch + (uint32_t)c;
            add_triangle(p, a, a + 1, a + pitch + 1);
            add_triangle(p, a, a + pitch + 1, a + pitch);
        }
}

static void cut_quad(const lom_tessellation *t, const struct lom_pattern_key *key, struct lom_pattern *p)
{
    struct division edge[4], u, v;
    struct side border[4], inside[4];
    for (int e = 0; e < 4; e++)
        divide(t->spacing, key->level[e], 1, &edge[e]);
    divide(t->spacing, key->level[4], 1, &u);
    divide(t->spacing, key->level[5], 1, &v);
    add_border(p, edge, border);
    if (u.segments == 1) { /* then all levels are 1 */
        add_triangle(p, border[0].place[0], border[1].place[0], border[2].place[0]);
        add_triangle(p, border[0].place[0], border[2].place[0], border[3].place[0]);
        return;
    }
    add_grid(p, &u, &v, inside);
    for (int e = 0; e < 4; e++)
        bridge(p, &border[e], &inside[e]);
}

static void cut_lines(const lom_tessellation *t, const struct lom_pattern_key *key, struct lom_pattern *p)
{
    struct division lines, along;
    divide(LOM_SPACING_EQUAL, key->level[0], 1, &lines);
    divide(t->spacing, key->level[1], 1, &along);
    for (int i = 0; i < lines.segments; i++)
        for (int j = 0; j <= along.segments; j++) {
            uint32_t place = add_place(p, along.at[j], lines.at[i]);
            if (j == 0)
                continue;
            p->corner[p->corners++] = place - 1;
            p->corner[p->corners++] = place;
        }
}

/* ---- a patch ---- */

int lom_piece_vertices(const lom_tessellation *t)
{
    return t->points ? 1 : t->domain == LOM_DOMAIN_ISOLINES ? 2 : 3;
}

/* Of a quad cut into n x n: 4 n places on its border and (n - 1)^2 inside it, 2 (n - 2)^2 + 4 (2 n - 2) = 2 n^2
 * triangles; the others have fewer. A spacing may ask for 2 or 3 segments at least. */
static size_t most_places(const lom_tessellation *t)
{
    size_t n = most_of(t) < 3 ? 3 : (size_t)most_of(t);
    return (n + 1) * (n + 1);
}

size_t lom_most_pieces(const lom_tessellation *t)
{
    return 2 * most_places(t);
}

bool lom_make_pattern(const lom_tessellation *t, const struct lom_pattern_key *key, struct lom_pattern *pattern)
{
    pattern->places = pattern->corners = 0;
    if (!lom_renew(&pattern->place, &pattern->place_capacity, most_places(t), sizeof *pattern->place, NULL) ||
        !lom_renew(&pattern->corner, &pattern->corner_capacity, 3 * lom_most_pieces(t), sizeof *pattern->corner, NULL))
        return false;
    if (key->level[0] == 0)
        return true;
    if (t->domain == LOM_DOMAIN_TRIANGLES)
        cut_triangle(t, key, pattern);
    else if (t->domain == LOM_DOMAIN_QUADS)
        cut_quad(t, key, pattern);
    else
        cut_lines(t, key, pattern);
    if (t->points) {
        pattern->corners = pattern->places;
        for (size_t i = 0; i < pattern->places; i++)
            pattern->corner[i] = (uint32_t)i;
    }
    for (size_t i = 0; t->clockwise && lom_piece_vertices(t) == 3 && i < pattern->corners; i += 3) {
        uint32_t swap = pattern->corner[i + 1];
        pattern->corner[i + 1] = pattern->corner[i + 2];
        pattern->corner[i + 2] = swap;
    }
    return true;
}
