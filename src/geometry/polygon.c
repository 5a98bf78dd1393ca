/* Ear clipping (Meisters 1975; Eberly, Triangulation by Ear Clipping) in the plane of the polygon. In: corners in
 * order. Out: count - 2 triangles whose areas add up to the polygon's when it is simple, needles of no width that go
 * out or in aside. A polygon that crosses itself or has no area still gives that many triangles, by rules that are
 * weakened only when no corner keeps the strict one. Compiled for speed. */
#include "polygon.h"

lom_vec3 lom_polygon_area(const struct lom_polygon *polygon)
{
    const double *origin = polygon->point[0];
    lom_vec3 sum = { 0, 0, 0 }, a = { 0, 0, 0 };
    for (int i = 1; i < polygon->count; i++) {
        const double *p = polygon->point[i];
        lom_vec3 b = { p[0] - origin[0], p[1] - origin[1], p[2] - origin[2] };
        if (i > 1)
            sum = lom_vec3_add(sum, lom_vec3_cross(a, b));
        a = b;
    }
    return sum;
}

/* Drops the axis along which the normal is longest; the other two in the order that makes the polygon turn left. */
static bool project(struct lom_polygon *polygon)
{
    lom_vec3 area = lom_polygon_area(polygon);
    double normal[3] = { area.x, area.y, area.z };
    int axis = 0;
    for (int i = 1; i < 3; i++)
        axis = __builtin_fabs(normal[i]) > __builtin_fabs(normal[axis]) ? i : axis;
    if (normal[axis] == 0)
        return false;
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < polygon->count; i++) {
        polygon->x[i] = polygon->point[i][normal[axis] > 0 ? u : v];
        polygon->y[i] = polygon->point[i][normal[axis] > 0 ? v : u];
    }
    return true;
}

/* Twice the signed area of a, b, c: positive when they turn left. Differences and products of floats of like size are
 * exact in double, so the sign is right where it matters. */
static double turn(const struct lom_polygon *p, int a, int b, int c)
{
    return (p->x[b] - p->x[a]) * (p->y[c] - p->y[a]) - (p->x[c] - p->x[a]) * (p->y[b] - p->y[a]);
}

static void update_turn(struct lom_polygon *p, int corner)
{
    p->turn[corner] = turn(p, p->previous[corner], corner, p->next[corner]);
    p->witness[corner] = -1;
}

/* Do its two sides go back on one another, or has one of them no length? The corner is the tip of a needle, and its
 * triangle has no area: cutting it off changes nothing. */
static bool is_spike(const struct lom_polygon *p, int b)
{
    int a = p->previous[b], c = p->next[b];
    return p->turn[b] == 0 &&
           (p->x[a] - p->x[b]) * (p->x[c] - p->x[b]) + (p->y[a] - p->y[b]) * (p->y[c] - p->y[b]) >= 0;
}

static bool same_place(const struct lom_polygon *p, int a, int b)
{
    return p->x[a] == p->x[b] && p->y[a] == p->y[b];
}

/* Is the corner convex, and its triangle free of other corners? Only corners that do not turn left can be the first to
 * enter a triangle; those on its border count as inside, so that no triangle passes over a corner on its edge. Corners
 * at the place of one of the triangle's own (a polygon that touches itself) do not. The corner that was found inside is
 * remembered: while it stays and still does not turn left, the answer is no at once. */
static bool is_ear(struct lom_polygon *p, int b)
{
    int a = p->previous[b], c = p->next[b], witness = p->witness[b];
    if (!(p->turn[b] > 0) || (witness >= 0 && !(p->turn[witness] > 0)))
        return false;
    p->witness[b] = -1;
    for (int q = p->next[c]; q != a; q = p->next[q])
        if (!(p->turn[q] > 0) && turn(p, a, b, q) >= 0 && turn(p, b, c, q) >= 0 && turn(p, c, a, q) >= 0 &&
            !same_place(p, q, a) && !same_place(p, q, b) && !same_place(p, q, c)) {
            p->witness[b] = q;
            return false;
        }
    return true;
}

/* The rules in the order in which they are given up: an ear; a corner without area; a convex corner; any. */
enum rule { RULE_EAR, RULE_FLAT, RULE_CONVEX, RULE_ANY };

static bool may_clip(struct lom_polygon *p, int corner, enum rule rule)
{
    switch (rule) {
    case RULE_EAR:
        return is_ear(p, corner);
    case RULE_FLAT:
        return p->turn[corner] == 0;
    case RULE_CONVEX:
        return p->turn[corner] > 0;
    default:
        return true;
    }
}

static uint32_t *emit(uint32_t *triangle, int a, int b, int c)
{
    triangle[0] = (uint32_t)a;
    triangle[1] = (uint32_t)b;
    triangle[2] = (uint32_t)c;
    return triangle + 3;
}

/* Cuts a corner off; gives the end of the triangles. */
static uint32_t *clip(struct lom_polygon *p, int corner, uint32_t *triangle)
{
    int before = p->previous[corner], after = p->next[corner];
    p->next[before] = after;
    p->previous[after] = before;
    p->turn[corner] = __builtin_inf(); /* no witness any more */
    update_turn(p, before);
    update_turn(p, after);
    return emit(triangle, before, corner, after);
}

/* Cuts off the spikes from `corner` on, as far as `count` corners; those before a spike are looked at again, since
 * their sides have changed. Gives a corner that is left. */
static int clip_spikes(struct lom_polygon *p, int corner, int count, int *left, uint32_t **triangle)
{
    while (count > 0 && *left > 3) {
        int before = p->previous[corner], after = p->next[corner];
        if (is_spike(p, corner)) {
            *triangle = clip(p, corner, *triangle);
            --*left;
            count += 1;
            corner = before;
        } else {
            count--;
            corner = after;
        }
    }
    return corner;
}

static void clip_ears(struct lom_polygon *p, uint32_t *triangle)
{
    int left = p->count, misses = 0, corner = p->next[clip_spikes(p, 0, left, &left, &triangle)];
    enum rule rule = RULE_EAR;
    while (left > 3) {
        if (!may_clip(p, corner, rule)) {
            corner = p->next[corner];
            if (++misses == left) {
                rule++;
                misses = 0;
            }
            continue;
        }
        int before = p->previous[corner], after = p->next[corner];
        triangle = clip(p, corner, triangle);
        left--;
        misses = 0;
        rule = RULE_EAR;
        corner = p->next[after]; /* leaving one out keeps the triangles rounder */
        if (left > 3 && (is_spike(p, before) || is_spike(p, after)))
            corner = clip_spikes(p, before, 2, &left, &triangle);
    }
    emit(triangle, p->previous[corner], corner, p->next[corner]);
}

void lom_polygon_triangulate(struct lom_polygon *polygon, uint32_t *triangles)
{
    int count = polygon->count;
    bool convex = true;
    if (count > 3 && project(polygon)) {
        for (int i = 0; i < count; i++) {
            polygon->next[i] = i + 1 < count ? i + 1 : 0;
            polygon->previous[i] = i > 0 ? i - 1 : count - 1;
        }
        for (int i = 0; i < count; i++) {
            update_turn(polygon, i);
            convex = convex && polygon->turn[i] > 0;
        }
    }
    if (!convex) {
        clip_ears(polygon, triangles);
        return;
    }
    for (int i = 1; i + 1 < count; i++)
        triangles = emit(triangles, 0, i, i + 1);
}
