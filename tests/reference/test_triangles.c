/* Proves that the hierarchy of boxes answers like trying every triangle, that no ray passes between triangles that
 * share an edge or a corner, and that hits lie where the ray meets the triangle's plane, from its front side alone. */
#include "check.h"
#include "reference/triangles.h"

enum { MANY = 3000 };

static lom_vec3 points[3 * MANY];
static struct lom_ray_triangle triangles[MANY];

static double number(uint64_t key, uint64_t counter, double low, double high)
{
    return low + (high - low) * lom_random_uniform(key, counter);
}

static lom_vec3 place(uint64_t key, uint64_t counter, double size)
{
    return (lom_vec3){ number(key, 3 * counter, -size, size), number(key, 3 * counter + 1, -size, size),
                       number(key, 3 * counter + 2, -size, size) };
}

/* Triangles of one size, or of sizes over six orders of magnitude. */
static struct lom_ray_triangles random_triangles(uint64_t key, uint32_t count, bool varied)
{
    for (uint32_t i = 0; i < count; i++) {
        double size = varied ? lom_double_exp(number(key + 1, i, -9, 3)) : 1;
        lom_vec3 middle = place(key, i, 10);
        for (uint32_t k = 0; k < 3; k++) {
            points[3 * i + k] = sum(middle, place(key + 2, 3 * i + k, size));
            triangles[i].corner[k] = 3 * i + k;
        }
    }
    return (struct lom_ray_triangles){ .points = points, .triangles = triangles, .count = count };
}

static bool try_all(const struct lom_ray_triangles *set, const struct lom_ray *ray, double low, struct lom_ray_hit *hit)
{
    bool found = false;
    for (uint32_t i = 0; i < set->count; i++) {
        struct lom_ray_hit tried;
        if (lom_hit_triangle(set, ray, i, &tried) && tried.t > low && tried.t < hit->t) {
            *hit = tried;
            found = true;
        }
    }
    return found;
}

static int compare_all(uint64_t key, uint32_t count, bool varied, int rays)
{
    struct lom_ray_triangles set = random_triangles(key, count, varied);
    int hits = 0;
    CHECK(lom_build_ray_triangles(&set, NULL));
    for (int i = 0; i < rays; i++) {
        struct lom_ray ray = { place(key + 3, (uint64_t)i, 12), unit(place(key + 4, (uint64_t)i, 1)) };
        struct lom_ray_hit a = { .t = 1e300 }, b = { .t = 1e300 };
        if (i % 7 == 0) /* along an axis, through a corner's own coordinates */
            ray = (struct lom_ray){ { points[i % (int)count].x, points[i % (int)count].y, -20 }, { 0, 0, 1 } };
        bool by_boxes = lom_hit_triangles(&set, &ray, 0.5, &a), by_all = try_all(&set, &ray, 0.5, &b);
        CHECK(by_boxes == by_all && a.t == b.t && (!by_all || a.triangle == b.triangle), "ray %d: %g and %g", i, a.t,
              b.t);
        hits += by_all;
    }
    lom_free_ray_triangles(&set);
    return hits;
}

static void boxes_answer_like_trying_all(void)
{
    CHECK(compare_all(10, MANY, false, 1500) > 500);
    CHECK(compare_all(20, MANY, true, 1500) > 100);
    CHECK(compare_all(30, 1, false, 200) >= 0);
    CHECK(compare_all(40, 5, true, 200) >= 0);
}

/* Triangles at places 1.5^i, which no plane divides evenly: the tree is no deeper than the stack of a ray is long. */
static void uneven_triangles_make_no_deep_tree(void)
{
    double scale = 1e-200;
    for (uint32_t i = 0; i < 1200; i++, scale *= 1.5)
        for (uint32_t k = 0; k < 3; k++) {
            points[3 * i + k] = (lom_vec3){ scale, k == 1 ? 1 : -1, k == 2 ? 1 : -1 };
            triangles[i].corner[k] = 3 * i + k;
        }
    struct lom_ray_triangles set = { .points = points, .triangles = triangles, .count = 1200 };
    int deepest = 0;
    CHECK(lom_build_ray_triangles(&set, NULL));
    for (uint32_t i = 0; i < set.node_count; i++)
        deepest = set.nodes[i].depth > deepest ? set.nodes[i].depth : deepest;
    CHECK(deepest > 20 && deepest < 100, "%d", deepest);
    struct lom_ray ray = { { 3e11, -0.5, -0.5 }, { -1, 0, 0 } };
    struct lom_ray_hit a = { .t = 1e300 }, b = { .t = 1e300 };
    CHECK(lom_hit_triangles(&set, &ray, 0, &a) && try_all(&set, &ray, 0, &b) && a.triangle == b.triangle);
    lom_free_ray_triangles(&set);
}

static void no_triangles_are_never_hit(void)
{
    struct lom_ray_triangles set = { .count = 0 };
    struct lom_ray ray = { { 0, 0, 0 }, { 0, 0, 1 } };
    struct lom_ray_hit hit = { .t = 1e300 };
    CHECK(lom_build_ray_triangles(&set, NULL));
    CHECK(!lom_hit_triangles(&set, &ray, 0, &hit) && hit.t == 1e300);
    lom_free_ray_triangles(&set);
}

/* A rough sheet over a grid of random heights, seen from above. */
enum { GRID = 12 };

static struct lom_ray_triangles make_sheet(void)
{
    uint32_t count = 0;
    for (int j = 0; j <= GRID; j++)
        for (int i = 0; i <= GRID; i++) {
            uint64_t corner = (uint64_t)(j * 100 + i);
            points[j * (GRID + 1) + i] =
                (lom_vec3){ i + number(1, corner, -.3, .3), number(2, corner, -1, 1), j + number(3, corner, -.3, .3) };
        }
    for (uint32_t j = 0; j < GRID; j++)
        for (uint32_t i = 0; i < GRID; i++) {
            uint32_t a = j * (GRID + 1) + i, b = a + 1, c = a + GRID + 1, d = c + 1;
            triangles[count++] = (struct lom_ray_triangle){ .corner = { a, c, b } };
            triangles[count++] = (struct lom_ray_triangle){ .corner = { b, c, d } };
        }
    return (struct lom_ray_triangles){ .points = points, .triangles = triangles, .count = count };
}

/* Rays from many eyes through points of every inner edge and through every inner corner: each is stopped. */
static void no_ray_passes_an_edge_or_a_corner(void)
{
    struct lom_ray_triangles set = make_sheet();
    CHECK(lom_build_ray_triangles(&set, NULL));
    for (int round = 0; round < 40; round++) {
        lom_vec3 eye = sum((lom_vec3){ 6, 60, 6 }, place(7, (uint64_t)round, 4));
        for (uint32_t j = 1; j < GRID; j++)
            for (uint32_t i = 1; i < GRID; i++) {
                lom_vec3 a = points[j * (GRID + 1) + i];
                const lom_vec3 others[3] = { points[j * (GRID + 1) + i - 1], points[(j - 1) * (GRID + 1) + i],
                                             points[(j - 1) * (GRID + 1) + i + 1] };
                for (int k = 0; k < 3; k++) {
                    lom_vec3 on = along(a, difference(others[k], a), round / 40.0);
                    struct lom_ray ray = { eye, unit(difference(on, eye)) };
                    struct lom_ray_hit hit = { .t = 1e300 };
                    CHECK(lom_hit_triangles(&set, &ray, 0, &hit), "edge %d of corner %u, %u", k, i, j);
                }
            }
    }
    lom_free_ray_triangles(&set);
}

static void hits_lie_on_ray_and_triangle(void)
{
    struct lom_ray_triangles set = random_triangles(50, 500, true);
    int hits = 0;
    for (uint32_t i = 0; i < 500; i++) {
        lom_vec3 target =
            blended(points[3 * i], points[3 * i + 1], points[3 * i + 2], (const double[3]){ 0.5, 0.3, 0.2 });
        lom_vec3 eye = place(51, i, 30), normal = cross(difference(points[3 * i + 1], points[3 * i]),
                                                        difference(points[3 * i + 2], points[3 * i]));
        struct lom_ray ray = { eye, unit(difference(target, eye)) };
        struct lom_ray_hit hit = { .t = 1e300 };
        bool front = dot(normal, ray.direction) < 0;
        CHECK(lom_hit_triangle(&set, &ray, i, &hit) == front, "triangle %u", i);
        if (!front)
            continue;
        hits++;
        double size = length(difference(target, eye)), edge = lom_double_sqrt(length(normal));
        double tilt = -dot(unit(normal), ray.direction);
        CHECK(__builtin_fabs(hit.t - size) < 1e-12 * size / tilt, "t %g, not %g", hit.t, size);
        CHECK(__builtin_fabs(hit.weight[1] - 0.3) < 1e-11 * size / edge / tilt, "weight %.17g", hit.weight[1]);
        CHECK(__builtin_fabs(hit.weight[0] + hit.weight[1] + hit.weight[2] - 1) < 1e-15);
    }
    CHECK(hits > 100 && hits < 400);
}

int main(int argc, char **argv)
{
    RUN(boxes_answer_like_trying_all);
    RUN(uneven_triangles_make_no_deep_tree);
    RUN(no_triangles_are_never_hit);
    RUN(no_ray_passes_an_edge_or_a_corner);
    RUN(hits_lie_on_ray_and_triangle);
    return check_result();
}
