/* Ear clipping: areas add up, every sampled point inside is in exactly one triangle and none outside is, and there are
 * n - 2 triangles whatever the polygon. */
#include "check.h"

#include "geometry/polygon.h"

#include <time.h>

struct outline {
    int count;
    double x[LOM_POLYGON_CORNERS], y[LOM_POLYGON_CORNERS];
};

static double side(const double *a, const double *b, const double *p)
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Even-odd, independent of triangles. */
static bool inside(const struct outline *o, const double *p)
{
    bool in = false;
    for (int i = 0, j = o->count - 1; i < o->count; j = i++)
        if ((o->y[i] > p[1]) != (o->y[j] > p[1]) &&
            p[0] < (o->x[j] - o->x[i]) * (p[1] - o->y[i]) / (o->y[j] - o->y[i]) + o->x[i])
            in = !in;
    return in;
}

/* Lays the outline into space by m, cuts it, and checks the triangles in the outline's own plane. */
static void check_outline(const char *name, const struct outline *o, const lom_mat4 *m, bool simple)
{
    struct lom_polygon *polygon = lom_allocate(1, sizeof *polygon, NULL);
    uint32_t *triangles = lom_allocate(3 * (size_t)o->count, sizeof *triangles, NULL);
    double area = 0, sum = 0, low[2] = { 1e9, 1e9 }, high[2] = { -1e9, -1e9 };
    polygon->count = o->count;
    for (int i = 0; i < o->count; i++) {
        lom_vec3 p = lom_transform_point(m, (lom_vec3){ o->x[i], o->y[i], 0 });
        polygon->point[i][0] = (float)p.x;
        polygon->point[i][1] = (float)p.y;
        polygon->point[i][2] = (float)p.z;
        int j = (i + 1) % o->count;
        area += o->x[i] * o->y[j] - o->x[j] * o->y[i];
        low[0] = o->x[i] < low[0] ? o->x[i] : low[0];
        low[1] = o->y[i] < low[1] ? o->y[i] : low[1];
        high[0] = o->x[i] > high[0] ? o->x[i] : high[0];
        high[1] = o->y[i] > high[1] ? o->y[i] : high[1];
    }
    triangles[3 * (o->count - 2)] = 12345; /* just behind the last */
    lom_polygon_triangulate(polygon, triangles);
    CHECK(triangles[3 * (o->count - 2)] == 12345, "%s: wrote too far", name);
    double(*corners)[3][2] = lom_allocate((size_t)o->count, sizeof *corners, NULL);
    int turned = 0, uses = 0;
    for (int k = 0; k < o->count - 2; k++) {
        for (int i = 0; i < 3; i++) {
            uint32_t c = triangles[3 * k + i];
            uses += c < (uint32_t)o->count;
            corners[k][i][0] = o->x[c % (uint32_t)o->count];
            corners[k][i][1] = o->y[c % (uint32_t)o->count];
        }
        double twice = side(corners[k][0], corners[k][1], corners[k][2]);
        sum += __builtin_fabs(twice);
        turned += twice * area < -1e-6 * area * area;
    }
    CHECK(uses == 3 * (o->count - 2), "%s: a corner out of range", name);
    if (simple) {
        CHECK(turned == 0, "%s: %d triangles face the other way", name, turned);
        CHECK(__builtin_fabs(sum - __builtin_fabs(area)) < 1e-5 * sum, "%s: area %g, triangles %g", name, area, sum);
        int wrong = 0;
        for (uint64_t s = 0; s < 500; s++) {
            double p[2] = { low[0] + (high[0] - low[0]) * lom_random_uniform(1, s),
                            low[1] + (high[1] - low[1]) * lom_random_uniform(2, s) };
            int hits = 0;
            for (int k = 0; k < o->count - 2; k++) {
                double a = side(corners[k][0], corners[k][1], p), b = side(corners[k][1], corners[k][2], p);
                double c = side(corners[k][2], corners[k][0], p);
                hits += (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
            }
            wrong += hits != inside(o, p);
        }
        CHECK(wrong == 0, "%s: %d of 500 points", name, wrong);
    }
    lom_release(corners);
    lom_release(triangles);
    lom_release(polygon);
}

static struct outline outline_of(const double (*points)[2], int count)
{
    struct outline o = { .count = count };
    for (int i = 0; i < count; i++) {
        o.x[i] = points[i][0];
        o.y[i] = points[i][1];
    }
    return o;
}

#define OUTLINE(points) outline_of(points, sizeof points / sizeof *points)

/* As it is, turned the other way round, starting elsewhere, and in tilted planes. */
static void check_everywhere(const char *name, const struct outline *o, bool simple)
{
    struct outline turned = { .count = o->count };
    for (uint64_t k = 0; k < 6; k++) {
        lom_mat4 m = lom_rotation((lom_vec3){ 1.1 * (double)k, 2.3 * (double)k, -.7 * (double)k });
        for (int i = 0; i < o->count; i++) {
            int from = (int)(((uint64_t)i + k * 5) % (uint64_t)o->count);
            from = k % 2 ? o->count - 1 - from : from;
            turned.x[i] = o->x[from];
            turned.y[i] = o->y[from];
        }
        check_outline(name, &turned, &m, simple);
    }
}

static void shapes(void)
{
    const double quad[][2] = { { 0, 0 }, { 4, 0 }, { 4, 3 }, { 0, 3 } };
    const double dart[][2] = { { 0, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 } };
    const double ell[][2] = { { 0, 0 }, { 4, 0 }, { 4, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
    const double u[][2] = { { 0, 0 }, { 5, 0 }, { 5, 4 }, { 4, 4 }, { 4, 1 }, { 1, 1 }, { 1, 4 }, { 0, 4 } };
    const double midpoints[][2] = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 3, 2 }, { 3, 3 }, { 1, 3 }, { 0, 3 } };
    const double keyhole[][2] = { { 0, 0 }, { 6, 0 }, { 6, 6 }, { 0, 6 }, { 0, 0 },
                                  { 2, 2 }, { 2, 4 }, { 4, 4 }, { 4, 2 }, { 2, 2 } };
    const double repeated[][2] = { { 0, 0 }, { 4, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 }, { 0, 4 } };
    struct outline o;
    check_everywhere("quad", (o = OUTLINE(quad), &o), true);
    check_everywhere("dart", (o = OUTLINE(dart), &o), true);
    check_everywhere("ell", (o = OUTLINE(ell), &o), true);
    check_everywhere("u", (o = OUTLINE(u), &o), true);
    check_everywhere("midpoints", (o = OUTLINE(midpoints), &o), true);
    check_everywhere("keyhole", (o = OUTLINE(keyhole), &o), true);
    check_everywhere("repeated corners", (o = OUTLINE(repeated), &o), true);
}

/* Appends a point. */
static void add_point(struct outline *o, double x, double y)
{
    o->x[o->count] = x;
    o->y[o->count++] = y;
}

/* Goes from (x, y) to a random point and back, by way of other needles. Odd keys: points of a grid, and a corner on the
 * way out that is none on the way back, which is exact only in the outline's own plane. */
static void add_needle(struct outline *o, double x, double y, uint64_t key, uint64_t *counter, int depth)
{
    double tip[2];
    for (int i = 0; i < 2; i++) {
        double uniform = 16 * lom_random_uniform(key, (*counter)++) - 4;
        tip[i] = key % 2 ? lom_double_floor(uniform) + .5 : uniform;
    }
    int repeats = 1 + (int)(lom_random_bits(key, (*counter)++) % 2);
    if (key % 2)
        add_point(o, x + (tip[0] - x) / 4, y + (tip[1] - y) / 4);
    for (int i = 0; i < repeats; i++)
        add_point(o, tip[0], tip[1]);
    for (int i = 0; i < (int)(lom_random_bits(key, (*counter)++) % 2) && depth < 3; i++)
        add_needle(o, tip[0], tip[1], key, counter, depth + 1);
    add_point(o, x, y);
}

/* Needles of no width, out of a corner or an edge of a simple outline or into it, slanting, doubled, branching: they
 * cover nothing, so areas and inside points are those of the outline without them. */
static void needles(void)
{
    static const double shapes[][8][2] = {
        { { 0, 0 }, { 2, 0 }, { 8, 0 }, { 8, 8 }, { 4, 8 }, { 2, 8 }, { 0, 8 }, { 0, 4 } },
        { { 0, 0 }, { 8, 0 }, { 8, 2 }, { 2, 2 }, { 2, 6 }, { 8, 6 }, { 8, 8 }, { 0, 8 } },
        { { 0, 0 }, { 4, 3 }, { 8, 0 }, { 5, 4 }, { 8, 8 }, { 4, 5 }, { 0, 8 }, { 3, 4 } },
    };
    lom_mat4 identity = lom_identity();
    for (uint64_t k = 0; k < 600; k++) {
        struct outline o = { .count = 0 };
        uint64_t counter = 0;
        for (int i = 0; i < 8; i++) {
            const double *p = shapes[k / 2 % 3][i];
            add_point(&o, p[0], p[1]);
            for (int n = (int)(lom_random_bits(k, counter++) % 8); n < 2; n++)
                add_needle(&o, p[0], p[1], k, &counter, 0);
        }
        check_outline("needles", &o, &identity, true);
        if (k % 2 == 0)
            check_everywhere("needles", &o, true);
    }
    /* beyond the end of an edge and back along it */
    const double overshoot[][2] = { { 0, 0 }, { 4, 0 }, { 4, 6 }, { 4, 4 }, { 0, 4 } };
    const double into_edge[][2] = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 2, 4 }, { 2, 9 }, { 2, 4 }, { 0, 4 } };
    struct outline o;
    check_outline("overshoot", (o = OUTLINE(overshoot), &o), &identity, true);
    check_everywhere("into an edge", (o = OUTLINE(into_edge), &o), true);
}

static void random_stars(void)
{
    for (uint64_t k = 0; k < 60; k++) { /* a radius for each angle: simple, and as jagged as one likes */
        struct outline o = { .count = 4 + (int)(lom_random_bits(3, k) % 60) };
        for (int i = 0; i < o.count; i++) {
            double angle = 6.283185307179586 * i / o.count, radius = .1 + lom_random_uniform(k + 10, (uint64_t)i);
            o.x[i] = radius * lom_double_cos(angle);
            o.y[i] = radius * lom_double_sin(angle);
        }
        check_everywhere("star", &o, true);
    }
}

/* A band that winds inwards. */
static struct outline spiral(int half)
{
    struct outline o = { .count = 2 * half };
    for (int i = 0; i < half; i++) {
        double angle = .1 * i, radius = 10 + angle;
        o.x[i] = radius * lom_double_cos(angle);
        o.y[i] = radius * lom_double_sin(angle);
        o.x[2 * half - 1 - i] = (radius - 2) * lom_double_cos(angle);
        o.y[2 * half - 1 - i] = (radius - 2) * lom_double_sin(angle);
    }
    return o;
}

/* Teeth of a comb: every second corner is reflex. */
static struct outline comb(int teeth)
{
    struct outline o = { .count = 2 * teeth + 2 };
    for (int i = 0; i < 2 * teeth; i++) {
        o.x[i] = i;
        o.y[i] = i % 2 ? 1 : 50;
    }
    o.x[2 * teeth] = 2 * teeth;
    o.x[2 * teeth + 1] = -1;
    return o;
}

static void long_polygons(void)
{
    struct outline o = spiral(300);
    check_everywhere("spiral", &o, true);
    o = comb(300);
    check_everywhere("comb", &o, true);
    lom_mat4 identity = lom_identity();
    clock_t start = clock();
    o = spiral(LOM_POLYGON_CORNERS / 2);
    check_outline("long spiral", &o, &identity, true);
    double spiral_time = (double)(clock() - start) / CLOCKS_PER_SEC;
    o = comb(LOM_POLYGON_CORNERS / 2 - 1);
    check_outline("long comb", &o, &identity, true);
    double comb_time = (double)(clock() - start) / CLOCKS_PER_SEC - spiral_time;
    printf("  4096 corners: spiral %.3f s, comb %.3f s\n", spiral_time, comb_time);
}

static void degenerate(void)
{
    const double point[][2] = { { 1, 1 }, { 1, 1 }, { 1, 1 }, { 1, 1 }, { 1, 1 } };
    const double line[][2] = { { 0, 0 }, { 1, 1 }, { 3, 3 }, { 2, 2 }, { -1, -1 } };
    const double bow[][2] = { { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 } };
    const double eight[][2] = { { 0, 0 }, { 3, 2 }, { 3, 0 }, { 0, 2 }, { -1, 1 } };
    struct outline o;
    check_everywhere("point", (o = OUTLINE(point), &o), false);
    check_everywhere("line", (o = OUTLINE(line), &o), false);
    check_everywhere("bow", (o = OUTLINE(bow), &o), false);
    check_everywhere("eight", (o = OUTLINE(eight), &o), false);
    for (uint64_t k = 0; k < 200; k++) { /* any corners in any order */
        o.count = 3 + (int)(lom_random_bits(4, k) % 50);
        for (int i = 0; i < o.count; i++) {
            o.x[i] = (double)(lom_random_bits(k, (uint64_t)i) % 7);
            o.y[i] = (double)(lom_random_bits(k, (uint64_t)i + 1000) % 7);
        }
        check_everywhere("random", &o, false);
    }
    lom_mat4 identity = lom_identity();
    o.count = LOM_POLYGON_CORNERS;
    for (int i = 0; i < o.count; i++) {
        o.x[i] = lom_random_uniform(6, (uint64_t)i);
        o.y[i] = lom_random_uniform(7, (uint64_t)i);
    }
    clock_t start = clock();
    check_outline("long random", &o, &identity, false);
    printf("  4096 random corners: %.3f s\n", (double)(clock() - start) / CLOCKS_PER_SEC);
}

/* A strictly convex polygon is a fan around its first corner. */
static void fans(void)
{
    struct lom_polygon *polygon = lom_allocate(1, sizeof *polygon, NULL);
    uint32_t triangles[12];
    polygon->count = 6;
    for (int i = 0; i < 6; i++) {
        polygon->point[i][0] = lom_double_cos(i * 1.0471975511965976);
        polygon->point[i][1] = lom_double_sin(i * 1.0471975511965976);
    }
    lom_polygon_triangulate(polygon, triangles);
    const uint32_t fan[12] = { 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5 };
    CHECK(memcmp(triangles, fan, sizeof fan) == 0);
    lom_release(polygon);
}

int main(int argc, char **argv)
{
    RUN(shapes);
    RUN(needles);
    RUN(random_stars);
    RUN(long_polygons);
    RUN(degenerate);
    RUN(fans);
    return check_result();
}
