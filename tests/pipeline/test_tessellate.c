/* Proves of the generator of tessellation: edges are cut as OpenGL 4.6, 11.2.2 says, by segments laid one after the other
 * in exact fractions, and the same read from either end; triangles of any levels cover the domain once and meet edge to
 * edge: none is empty, each inner edge has one triangle on either side, the border is the outer edges' places in
 * order, areas add up to the domain's exactly; a shared edge is cut alike by patches of any kind and inner level, and the
 * inside alike whatever the outer levels; places and strips are symmetric; isolines; which patches are discarded, how levels are clamped. */
#include "pipeline/tessellate.h"

#include "check.h"

static const char *const spacing_names[] = { "equal", "fractional even", "fractional odd" };

struct levels {
    float outer[4], inner[2];
};

static struct lom_pattern make(const lom_tessellation *t, struct levels l)
{
    struct lom_pattern p = { .places = 0 };
    struct lom_pattern_key key = lom_pattern_key_of(t, l.outer, l.inner);
    CHECK(lom_make_pattern(t, &key, &p));
    return p;
}

static void drop(struct lom_pattern *p)
{
    lom_release(p->place);
    lom_release(p->corner);
}

static struct levels all_of(float level)
{
    return (struct levels){ { level, level, level, level }, { level, level } };
}

static uint64_t draws;

static float random_level(void)
{
    uint64_t bits = lom_random_bits(2048, draws++);
    float level = 0.5f + (float)(bits >> 40) * 0x1p-24f * (bits & 1 ? 11.0f : 66.0f);
    return bits & 2 ? (float)(int)level + 1 : level;
}

static struct levels random_levels(void)
{
    struct levels l;
    for (int i = 0; i < 4; i++)
        l.outer[i] = random_level();
    for (int i = 0; i < 2; i++)
        l.inner[i] = random_level();
    return l;
}

/* ---- an edge by the words of the specification ---- */

/* Segments of level f, and the number of them. */
static int segments_of(lom_spacing spacing, double f, double most)
{
    double low = spacing == LOM_SPACING_FRACTIONAL_EVEN ? 2 : 1;
    int n = (int)low, step = spacing == LOM_SPACING_EQUAL ? 1 : 2;
    f = f > low ? f : low;
    while (n < f && n + step <= most)
        n += step;
    return n;
}

/* Place i: one segment after the other, in units of 1 / 2^24. */
static double place_of(lom_spacing spacing, double f, double most, int n, int i)
{
    double low = spacing == LOM_SPACING_FRACTIONAL_EVEN ? 2 : 1, clamped = f < low ? low : f > most ? most : f;
    double level = spacing == LOM_SPACING_EQUAL ? n : clamped;
    double full = 1 / level, rest = (1 - (n - 2) * full) / 2;
    if (n == 1)
        return i * 0x1p24;
    return 0x1p24 * (i == 0 ? 0 : i == n ? 1 : rest + (i - 1) * full);
}

/* Isolines of one line: level 1 cuts it as any edge is cut. */
static void edges_are_cut_as_specified(void)
{
    for (int s = 0; s < 3; s++)
        for (int most = 1; most <= 64; most += 7)
            for (int step = 1; step < 66 * 16; step++) {
                lom_tessellation t = { .domain = LOM_DOMAIN_ISOLINES, .spacing = (lom_spacing)s, .most = most };
                double f = step / 16.0, limit = s == 1   ? (most < 2 ? 2 : most / 2 * 2)
                                                : s == 2 ? (most - 1) / 2 * 2 + 1
                                                         : most;
                struct lom_pattern p = make(&t, (struct levels){ { 1, (float)f }, { 0 } });
                int n = segments_of((lom_spacing)s, f, limit);
                CHECK(p.places == (size_t)n + 1 && p.corners == 2 * (size_t)n, "%s %g: %zu places, not %d",
                      spacing_names[s], f, p.places, n + 1);
                for (int i = 0; i <= n && p.places == (size_t)n + 1; i++) {
                    double off = p.place[i][0] - place_of((lom_spacing)s, f, limit, n, i);
                    CHECK(off <= 0.5 && off >= -0.5, "%s %g: place %d is off by %g", spacing_names[s], f, i, off);
                    CHECK(p.place[i][0] + p.place[n - i][0] == DOMAIN_ONE, "%s %g: place %d", spacing_names[s], f, i);
                    CHECK(i == 0 || p.place[i][0] > p.place[i - 1][0], "%s %g: place %d", spacing_names[s], f, i);
                }
                drop(&p);
            }
}

/* ---- covering ---- */

static int64_t area_of(const struct lom_pattern *p, const uint32_t *corner)
{
    const uint32_t *a = p->place[corner[0]], *b = p->place[corner[1]], *c = p->place[corner[2]];
    return ((int64_t)b[0] - a[0]) * ((int64_t)c[1] - a[1]) - ((int64_t)b[1] - a[1]) * ((int64_t)c[0] - a[0]);
}

static int compare(const void *a, const void *b)
{
    uint64_t x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return x < y ? -1 : x > y;
}

/* How far around the border a place is: the side from 0 on in bits 25 and up, then along it; UINT64_MAX inside. */
static uint64_t border_of(lom_domain domain, const uint32_t *place)
{
    uint32_t u = place[0], v = place[1], w = DOMAIN_ONE - u - v;
    if (domain == LOM_DOMAIN_TRIANGLES) /* u to v, v to w, w to u */
        return w == 0 && v < DOMAIN_ONE   ? v
               : u == 0 && w < DOMAIN_ONE ? (UINT64_C(1) << 25) + w
               : v == 0                   ? (UINT64_C(2) << 25) + u
                                          : UINT64_MAX;
    return v == 0 && u < DOMAIN_ONE            ? u
           : u == DOMAIN_ONE && v < DOMAIN_ONE ? (UINT64_C(1) << 25) + v
           : v == DOMAIN_ONE && u > 0          ? (UINT64_C(2) << 25) + DOMAIN_ONE - u
           : u == 0                            ? (UINT64_C(3) << 25) + DOMAIN_ONE - v
                                               : UINT64_MAX;
}

/* Directed edges of which the opposite one is missing go once around the border. */
static void check_edges(const lom_tessellation *t, const struct lom_pattern *p, const char *what)
{
    size_t count = p->corners, open = 0, around = 0;
    uint64_t *edge = malloc(count * sizeof *edge), *border = malloc(p->places * sizeof *border);
    for (size_t i = 0; i < count; i++)
        edge[i] = (uint64_t)p->corner[i] << 32 | p->corner[i - i % 3 + (i + 1) % 3];
    qsort(edge, count, sizeof *edge, compare);
    for (size_t i = 0; i < p->places; i++) {
        border[around] = border_of(t->domain, p->place[i]);
        around += border[around] != UINT64_MAX;
    }
    qsort(border, around, sizeof *border, compare);
    for (size_t i = 0; i < count; i++) {
        CHECK(i == 0 || edge[i] != edge[i - 1], "%s: an edge has two triangles on one side", what);
        uint64_t back = edge[i] << 32 | edge[i] >> 32;
        if (bsearch(&back, edge, count, sizeof *edge, compare) != NULL)
            continue;
        uint64_t from = border_of(t->domain, p->place[edge[i] >> 32]),
                 to = border_of(t->domain, p->place[edge[i] & 0xffffffff]);
        const uint64_t *at = bsearch(&from, border, around, sizeof *border, compare);
        CHECK(at != NULL && border[(size_t)(at - border + 1) % around] == to, "%s: an edge inside has one triangle",
              what);
        open++;
    }
    CHECK(open == around, "%s: the border has %zu edges of %zu", what, open, around);
    free(edge);
    free(border);
}

static void check_cover(const lom_tessellation *t, struct levels l)
{
    char what[160];
    struct lom_pattern p = make(t, l);
    snprintf(what, sizeof what, "%s, %s, outer %a %a %a %a, inner %a %a", t->domain ? "quad" : "triangle",
             spacing_names[t->spacing], l.outer[0], l.outer[1], l.outer[2], l.outer[3], l.inner[0], l.inner[1]);
    int64_t sum = 0;
    for (size_t i = 0; i < p.corners; i += 3) {
        int64_t area = area_of(&p, p.corner + i);
        CHECK(area > 0, "%s: triangle %zu has the area %lld", what, i / 3, (long long)area);
        sum += area;
    }
    CHECK(sum == (INT64_C(1) << (t->domain == LOM_DOMAIN_QUADS ? 49 : 48)), "%s: areas add up to %lld", what,
          (long long)sum);
    CHECK(p.corners / 3 <= lom_most_pieces(t), "%s: %zu triangles", what, p.corners / 3);
    check_edges(t, &p, what);
    drop(&p);
}

static void triangles_cover_the_domain_once(void)
{
    for (int domain = 0; domain < 2; domain++)
        for (int s = 0; s < 3; s++) {
            lom_tessellation t = { .domain = (lom_domain)domain, .spacing = (lom_spacing)s };
            for (int n = 1; n <= 66; n++)
                check_cover(&t, all_of((float)n));
            for (int i = 0; i < 300; i++)
                check_cover(&t, random_levels());
            for (int i = 0; i < 64; i++) /* levels a little beside whole ones, each apart from the others */
                check_cover(&t, (struct levels){ { i & 1 ? 0x1.000002p5f : 1, i & 2 ? 0x1.fffffep4f : 1, i & 4 ? 64 : 1,
                                                   i & 8 ? 3 : 1 },
                                                 { i & 16 ? 0x1.000002p1f : 1, i & 32 ? 0x1.fffffep5f : 1 } });
        }
}

static void full_patches_have_known_counts(void)
{
    for (int n = 1; n <= 64; n++) {
        lom_tessellation quad = { .domain = LOM_DOMAIN_QUADS }, triangle = { .domain = LOM_DOMAIN_TRIANGLES };
        struct lom_pattern q = make(&quad, all_of((float)n)), t = make(&triangle, all_of((float)n));
        size_t size = (size_t)n, rings = 0;
        for (size_t k = size; k >= 1;
             k -= k < 2 ? k : 2) /* 3 k outer and 3 (k - 2) inner edges between two rings, at last 1 */
            rings += k == 1 ? 1 : 3 * k + 3 * (k - 2);
        CHECK(q.corners == 6 * size * size && q.places == (size + 1) * (size + 1), "%d: %zu", n, q.corners);
        CHECK(t.corners == 3 * rings, "%d: %zu triangles, not %zu", n, t.corners / 3, rings);
        drop(&q);
        drop(&t);
    }
}

/* ---- what follows from what ---- */

/* The places of an outer edge in order. */
static size_t list_edge(const lom_tessellation *t, struct levels l, int edge, uint32_t at[66])
{
    struct lom_pattern p = make(t, l);
    size_t count = 0;
    for (size_t i = 0; i < p.places && count < 66; i++) {
        uint32_t u = p.place[i][0], v = p.place[i][1], w = DOMAIN_ONE - u - v;
        const bool quad = t->domain == LOM_DOMAIN_QUADS;
        const bool on[4] = { u == 0, v == 0, quad ? u == DOMAIN_ONE : w == 0, quad && v == DOMAIN_ONE };
        if (on[edge])
            at[count++] = edge % 2 == 0 ? v : u;
    }
    for (size_t i = 0; i < count; i++) /* insertion sort */
        for (size_t k = i; k > 0 && at[k - 1] > at[k]; k--) {
            uint32_t swap = at[k];
            at[k] = at[k - 1];
            at[k - 1] = swap;
        }
    drop(&p);
    return count;
}

static void shared_edges_are_cut_alike(void)
{
    for (int i = 0; i < 400; i++) {
        lom_tessellation quad = { .domain = LOM_DOMAIN_QUADS, .spacing = (lom_spacing)(i % 3) };
        lom_tessellation triangle = { .domain = LOM_DOMAIN_TRIANGLES, .spacing = (lom_spacing)(i % 3) };
        struct levels a = random_levels(), b = random_levels();
        int on_a = i % 4, on_b = i % 5 % 3;
        uint32_t x[66], y[66];
        b.outer[on_b] = a.outer[on_a];
        size_t m = list_edge(&quad, a, on_a, x), n = list_edge(&triangle, b, on_b, y);
        CHECK(m == n && memcmp(x, y, m * sizeof *x) == 0, "%s, level %a, %zu and %zu places", spacing_names[i % 3],
              a.outer[on_a], m, n);
        for (size_t k = 0; k < m; k++)
            CHECK(x[k] + x[m - 1 - k] == DOMAIN_ONE, "level %a, place %zu", a.outer[on_a], k);
    }
}

static void inside_follows_from_inner_levels(void)
{
    for (int i = 0; i < 200; i++) {
        lom_tessellation t = { .domain = (lom_domain)(i % 2), .spacing = (lom_spacing)(i % 3) };
        struct levels a = random_levels(), b = random_levels();
        a.inner[0] = 2 + a.inner[0];
        a.inner[1] = 2 + a.inner[1];
        memcpy(b.inner, a.inner, sizeof a.inner);
        struct lom_pattern p = make(&t, a), q = make(&t, b);
        size_t m = p.places, n = q.places; /* what is inside comes last, in one order */
        while (m > 0 && n > 0 && memcmp(p.place[m - 1], q.place[n - 1], sizeof *p.place) == 0) {
            m--;
            n--;
        }
        CHECK(m == 0 || border_of(t.domain, p.place[m - 1]) != UINT64_MAX, "levels %a", a.inner[0]);
        CHECK(n == 0 || border_of(t.domain, q.place[n - 1]) != UINT64_MAX, "levels %a", a.inner[0]);
        drop(&p);
        drop(&q);
    }
}

static bool has_place(const struct lom_pattern *p, uint32_t u, uint32_t v)
{
    for (size_t i = 0; i < p->places; i++)
        if (p->place[i][0] == u && p->place[i][1] == v)
            return true;
    return false;
}

/* With levels that are alike everywhere the places stay what they are when the corners change places; but the centre of a
 * triangle, which no multiple of 2^-24 is. */
static void places_are_symmetric(void)
{
    for (int i = 0; i < 60; i++) {
        lom_tessellation quad = { .domain = LOM_DOMAIN_QUADS, .spacing = (lom_spacing)(i % 3) };
        lom_tessellation triangle = { .domain = LOM_DOMAIN_TRIANGLES, .spacing = (lom_spacing)(i % 3) };
        struct levels l = all_of(random_level() / 4);
        struct lom_pattern q = make(&quad, l), t = make(&triangle, l);
        for (size_t k = 0; k < q.places; k++)
            CHECK(has_place(&q, DOMAIN_ONE - q.place[k][0], q.place[k][1]) &&
                      has_place(&q, q.place[k][1], q.place[k][0]),
                  "%s, level %a: place %zu of a quad", spacing_names[i % 3], l.inner[0], k);
        for (size_t k = 0; k < t.places; k++) {
            uint32_t u = t.place[k][0], v = t.place[k][1], w = DOMAIN_ONE - u - v;
            CHECK((u == DOMAIN_ONE / 3 && v == u) || (has_place(&t, v, u) && has_place(&t, v, w)),
                  "%s, level %a: place %zu of a triangle", spacing_names[i % 3], l.inner[0], k);
        }
        drop(&q);
        drop(&t);
    }
}

/* The place across from the border's edge that begins at u along v = 0. */
static const uint32_t *across(const struct lom_pattern *p, uint32_t u)
{
    for (size_t i = 0; i < p->corners; i++) {
        const uint32_t *corner = p->corner + i - i % 3;
        const uint32_t *from = p->place[p->corner[i]], *to = p->place[corner[(i + 1) % 3]];
        if (from[1] == 0 && to[1] == 0 && from[0] == u && to[0] > u)
            return p->place[corner[(i + 2) % 3]];
    }
    return NULL;
}

static void strips_are_symmetric(void)
{
    for (int i = 0; i < 200; i++) {
        lom_tessellation t = { .domain = LOM_DOMAIN_QUADS, .spacing = (lom_spacing)(i % 3) };
        struct levels l = random_levels();
        uint32_t at[66];
        if (i % 2 == 0)
            l.inner[0] = l.outer[1];
        size_t n = list_edge(&t, l, 1, at);
        struct lom_pattern p = make(&t, l);
        for (size_t k = 0; 2 * (k + 1) < n - 1; k++) { /* without the edge across the middle */
            const uint32_t *a = across(&p, at[k]), *b = across(&p, at[n - 2 - k]);
            CHECK(a != NULL && b != NULL && a[0] + b[0] == DOMAIN_ONE && a[1] == b[1], "%s, levels %a, %a: edge %zu",
                  spacing_names[i % 3], l.outer[1], l.inner[0], k);
        }
        drop(&p);
    }
}

static void turned_patches_are_turned(void)
{
    for (int i = 0; i < 50; i++) {
        lom_tessellation t = { .domain = (lom_domain)(i % 2) }, other = t, points = t;
        struct levels l = random_levels();
        other.clockwise = points.points = true;
        struct lom_pattern p = make(&t, l), q = make(&other, l), r = make(&points, l);
        CHECK(p.corners == q.corners);
        for (size_t k = 0; k < p.corners; k += 3)
            CHECK(area_of(&p, p.corner + k) == -area_of(&q, q.corner + k), "triangle %zu", k / 3);
        CHECK(r.corners == p.places && memcmp(r.place, p.place, p.places * sizeof *p.place) == 0);
        for (size_t k = 0; k < r.corners; k++)
            CHECK(r.corner[k] == k);
        drop(&p);
        drop(&q);
        drop(&r);
    }
}

static void lines_lie_at_equal_heights(void)
{
    for (int n = 1; n <= 64; n++) {
        lom_tessellation t = { .domain = LOM_DOMAIN_ISOLINES, .spacing = LOM_SPACING_FRACTIONAL_ODD };
        struct lom_pattern p = make(&t, (struct levels){ { (float)n - 0.25f, 2.5f }, { 0 } });
        CHECK(p.places == 4 * (size_t)n && p.corners == 6 * (size_t)n, "%d: %zu places", n, p.places);
        for (size_t i = 0; i < p.places; i++) {
            int64_t off = (int64_t)p.place[i][1] * n - (int64_t)(i / 4) * DOMAIN_ONE;
            CHECK(2 * off <= n && -2 * off <= n, "%d: place %zu", n, i);
        }
        for (size_t i = 0; i < p.corners; i++)
            CHECK(p.corner[i] == i / 6 * 4 + i % 6 / 2 + i % 2, "%d: corner %zu", n, i);
        drop(&p);
    }
}

/* ---- levels that are none ---- */

static void levels_are_clamped_or_discard(void)
{
    const float none[] = { 0, -0.0f, -1, -__builtin_inff(), __builtin_nanf("") };
    for (int domain = 0; domain < 3; domain++)
        for (int s = 0; s < 3; s++) {
            lom_tessellation t = { .domain = (lom_domain)domain, .spacing = (lom_spacing)s };
            const int edges = domain == 0 ? 3 : domain == 1 ? 4 : 2;
            for (int e = 0; e < 4; e++)
                for (size_t k = 0; k < sizeof none / sizeof *none; k++) {
                    struct levels l = all_of(3);
                    l.outer[e] = none[k];
                    struct lom_pattern p = make(&t, l);
                    CHECK((p.corners == 0) == (e < edges), "domain %d, level %d is %g", domain, e, none[k]);
                    drop(&p);
                }
            const float high[] = { 64, 65, 1e30f, __builtin_inff() }, low[] = { 1, 0, -5, 1e-40f, __builtin_nanf("") };
            for (size_t k = 0; k < 5; k++) {
                struct levels l = all_of(5), same = l;
                l.inner[0] = l.inner[1] = low[k];
                same.inner[0] = same.inner[1] = 1;
                struct lom_pattern p = make(&t, l), q = make(&t, same), r = make(&t, all_of(k < 4 ? high[k] : 64)),
                                   most = make(&t, all_of(64));
                CHECK(p.corners == q.corners && memcmp(p.place, q.place, p.places * sizeof *p.place) == 0, "inner %g",
                      low[k]);
                CHECK(r.corners == most.corners && r.places == most.places, "domain %d, level %g", domain, high[k % 4]);
                drop(&p);
                drop(&q);
                drop(&r);
                drop(&most);
            }
        }
}

int main(int argc, char **argv)
{
    RUN(edges_are_cut_as_specified);
    RUN(triangles_cover_the_domain_once);
    RUN(full_patches_have_known_counts);
    RUN(shared_edges_are_cut_alike);
    RUN(inside_follows_from_inner_levels);
    RUN(places_are_symmetric);
    RUN(strips_are_symmetric);
    RUN(turned_patches_are_turned);
    RUN(lines_lie_at_equal_heights);
    RUN(levels_are_clamped_or_discard);
    return check_failed_tests != 0;
}
