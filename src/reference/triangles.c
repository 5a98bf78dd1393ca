/* The nearest triangle of a ray. In: triangles in the world. Out: a hierarchy of boxes; hits with barycentric
 * coordinates. Invariant: the hierarchy only leaves out what cannot be hit, so the answer is that of trying them all.
 */
#include "base/numbers.h"
#include "reference/triangles.h"

/* Below depth HALVING the triangles are halved by number, so that no tree is deeper than HALVING + 32. */
enum { STACK = 128, HALVING = 64, BINS = 16, LEAF = 4 };

/* ---- building ---- */

struct box {
    double low[3], high[3];
};

static const struct box empty_box = { { 1e300, 1e300, 1e300 }, { -1e300, -1e300, -1e300 } };

struct builder {
    struct lom_ray_triangles *set;
    struct box *bounds; /* of each triangle */
};

static void widen(struct box *box, const struct box *other)
{
    for (int i = 0; i < 3; i++) {
        box->low[i] = lom_smaller(other->low[i], box->low[i]);
        box->high[i] = lom_larger(other->high[i], box->high[i]);
    }
}

static double area(const struct box *box)
{
    double x = box->high[0] - box->low[0], y = box->high[1] - box->low[1], z = box->high[2] - box->low[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

static struct box bounds_of(const struct lom_ray_triangles *set, uint32_t triangle)
{
    struct box box = empty_box;
    for (int i = 0; i < 3; i++) {
        lom_vec3 p = set->points[set->triangles[triangle].corner[i]];
        struct box point = { { p.x, p.y, p.z }, { p.x, p.y, p.z } };
        widen(&box, &point);
    }
    return box;
}

/* Twice the centre of a box along an axis: only its order counts. */
static double center(const struct box *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

struct split {
    int axis;
    double low, scale; /* bin = (center - low) scale */
    int bin;           /* the first of the right side; 0: no split */
};

static int bin_of(const struct split *split, const struct box *box)
{
    int bin = lom_int_of((center(box, split->axis) - split->low) * split->scale);
    return bin < BINS ? bin : BINS - 1;
}

/* The boundary of bins with the least area x count on both sides. */
static int find_boundary(const struct builder *b, const struct split *split, uint32_t first, uint32_t count)
{
    struct box box[BINS], left = empty_box, right = empty_box;
    uint32_t in[BINS] = { 0 }, on_left = 0, on_right = 0;
    double cost[BINS] = { 0 };
    for (int i = 0; i < BINS; i++)
        box[i] = empty_box;
    for (uint32_t i = first; i < first + count; i++) {
        const struct box *bounds = &b->bounds[b->set->order[i]];
        int bin = bin_of(split, bounds);
        in[bin]++;
        widen(&box[bin], bounds);
    }
    for (int i = 1; i < BINS; i++) {
        widen(&left, &box[i - 1]);
        on_left += in[i - 1];
        cost[i] = area(&left) * on_left;
    }
    int best = 0;
    for (int i = BINS - 1; i > 0; i--) {
        widen(&right, &box[i]);
        on_right += in[i];
        cost[i] += area(&right) * on_right;
        if (on_right > 0 && on_right < count && (best == 0 || cost[i] < cost[best]))
            best = i;
    }
    return best;
}

static struct split find_split(const struct builder *b, uint32_t first, uint32_t count)
{
    struct box centers = empty_box;
    for (uint32_t i = first; i < first + count; i++) {
        const struct box *bounds = &b->bounds[b->set->order[i]];
        double c[3] = { center(bounds, 0), center(bounds, 1), center(bounds, 2) };
        widen(&centers, &(struct box){ { c[0], c[1], c[2] }, { c[0], c[1], c[2] } });
    }
    struct split split = { .axis = 0 };
    double widest = 0;
    for (int axis = 0; axis < 3; axis++)
        if (centers.high[axis] - centers.low[axis] > widest) {
            split.axis = axis;
            widest = centers.high[axis] - centers.low[axis];
        }
    if (!(widest > 1e-300))
        return split;
    split.low = centers.low[split.axis];
    split.scale = BINS / widest;
    split.bin = find_boundary(b, &split, first, count);
    return split;
}

/* Moves the triangles of the left side to the front, by swapping from both ends; returns how many they are. */
static uint32_t partition(const struct builder *b, const struct split *split, uint32_t first, uint32_t count)
{
    uint32_t *order = b->set->order, low = first, high = first + count;
    if (split->bin == 0)
        return count / 2;
    while (low < high) {
        if (bin_of(split, &b->bounds[order[low]]) < split->bin) {
            low++;
            continue;
        }
        uint32_t moved = order[--high];
        order[high] = order[low];
        order[low] = moved;
    }
    return low - first;
}

/* Makes a node of order[first, first + count). */
static void begin_node(const struct builder *b, uint32_t node, uint32_t first, uint32_t count, int32_t depth)
{
    struct box box = empty_box;
    struct lom_ray_node *n = &b->set->nodes[node];
    for (uint32_t i = first; i < first + count; i++)
        widen(&box, &b->bounds[b->set->order[i]]);
    for (int i = 0; i < 3; i++) {
        n->low[i] = box.low[i];
        n->high[i] = box.high[i];
    }
    n->first = first;
    n->count = count;
    n->depth = depth;
}

/* Splits node after node until leaves are small; children are always appended, so the order of work is a queue. */
static void split_nodes(const struct builder *b)
{
    struct lom_ray_triangles *set = b->set;
    begin_node(b, 0, 0, set->count, 0);
    set->node_count = 1;
    for (uint32_t node = 0; node < set->node_count; node++) {
        struct lom_ray_node *n = &set->nodes[node];
        uint32_t first = n->first, count = n->count, child = set->node_count;
        if (count <= LEAF)
            continue;
        struct split split = { .bin = 0 };
        if (n->depth < HALVING)
            split = find_split(b, first, count);
        uint32_t left = partition(b, &split, first, count);
        begin_node(b, child, first, left, n->depth + 1);
        begin_node(b, child + 1, first + left, count - left, n->depth + 1);
        n->first = child;
        n->count = 0;
        n->axis = split.axis;
        set->node_count += 2;
    }
}

bool lom_build_ray_triangles(struct lom_ray_triangles *set, lom_error *error)
{
    struct builder b = { .set = set };
    size_t count = set->count;
    set->order = lom_allocate(count, sizeof *set->order, error);
    set->nodes = lom_allocate(2 * count + 1, sizeof *set->nodes, error);
    b.bounds = lom_allocate(count, sizeof *b.bounds, error);
    bool done = set->order != NULL && set->nodes != NULL && b.bounds != NULL;
    for (uint32_t i = 0; done && i < set->count; i++) {
        set->order[i] = i;
        b.bounds[i] = bounds_of(set, i);
    }
    if (done)
        split_nodes(&b);
    lom_release(b.bounds);
    if (!done)
        lom_free_ray_triangles(set);
    return done;
}

void lom_free_ray_triangles(struct lom_ray_triangles *set)
{
    lom_release(set->order);
    lom_release(set->nodes);
    set->order = NULL;
    set->nodes = NULL;
    set->node_count = 0;
}

/* ---- one triangle ---- */

/* The axes of a ray's own space: z is the one along which it goes farthest, x and y such that turning round keeps the
 * triangles' sense; points are sheared so that the ray runs along z. */
struct shear {
    int x, y, z;
    double along_x, along_y, along_z;
};

static double component(lom_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static struct shear shear_of(lom_vec3 d)
{
    double x = __builtin_fabs(d.x), y = __builtin_fabs(d.y), z = __builtin_fabs(d.z);
    struct shear s = { .z = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2) };
    s.x = (s.z + 1) % 3;
    s.y = (s.z + 2) % 3;
    double forward = component(d, s.z);
    if (forward < 0) {
        int swapped = s.x;
        s.x = s.y;
        s.y = swapped;
    }
    s.along_x = component(d, s.x) / forward;
    s.along_y = component(d, s.y) / forward;
    s.along_z = 1 / forward;
    return s;
}

static bool hit_sheared(const struct lom_ray_triangles *set, const struct lom_ray *ray, const struct shear *s,
                        uint32_t triangle, struct lom_ray_hit *hit)
{
    double x[3], y[3], z[3];
    for (int i = 0; i < 3; i++) {
        lom_vec3 p = difference(set->points[set->triangles[triangle].corner[i]], ray->origin);
        z[i] = component(p, s->z);
        x[i] = component(p, s->x) - s->along_x * z[i];
        y[i] = component(p, s->y) - s->along_y * z[i];
    }
    /* Signed areas as seen against z: positive for a triangle that is clockwise along the ray, which is its front. */
    double u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2], w = x[1] * y[0] - y[1] * x[0];
    if (set->inside_out) {
        u = -u;
        v = -v;
        w = -w;
    }
    if (u < 0 || v < 0 || w < 0)
        return false;
    double area = u + v + w;
    if (!(area > 0))
        return false;
    double b[3] = { u / area, v / area, w / area };
    hit->t = (b[0] * z[0] + b[1] * z[1] + b[2] * z[2]) * s->along_z;
    hit->triangle = triangle;
    for (int i = 0; i < 3; i++)
        hit->weight[i] = b[i];
    return true;
}

bool lom_hit_triangle(const struct lom_ray_triangles *set, const struct lom_ray *ray, uint32_t triangle,
                      struct lom_ray_hit *hit)
{
    struct shear s = shear_of(ray->direction);
    return hit_sheared(set, ray, &s, triangle, hit);
}

/* ---- all of them ---- */

struct slabs {
    double origin[3], inverse[3];
    bool backward[3];
};

/* Whether the ray may meet the box before `far`. A direction of 0 gives infinities, and NaN where the origin lies in a
 * face: comparisons with NaN are false and leave the interval as it is. The factor covers the rounding of three
 * operations (T. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013). */
static bool meets_box(const struct slabs *r, const struct lom_ray_node *node, double low, double far)
{
    double near = low;
    for (int i = 0; i < 3; i++) {
        double enter = ((r->backward[i] ? node->high[i] : node->low[i]) - r->origin[i]) * r->inverse[i];
        double leave = ((r->backward[i] ? node->low[i] : node->high[i]) - r->origin[i]) * r->inverse[i];
        leave *= 1 + 0x1p-50;
        near = enter > near ? enter : near;
        far = leave < far ? leave : far;
    }
    return near <= far;
}

static struct slabs slabs_of(const struct lom_ray *ray)
{
    const double d[3] = { ray->direction.x, ray->direction.y, ray->direction.z };
    struct slabs r = { .origin = { ray->origin.x, ray->origin.y, ray->origin.z } };
    for (int i = 0; i < 3; i++) {
        r.inverse[i] = 1 / d[i];
        r.backward[i] = r.inverse[i] < 0;
    }
    return r;
}

bool lom_hit_triangles(const struct lom_ray_triangles *set, const struct lom_ray *ray, double low,
                       struct lom_ray_hit *hit)
{
    if (set->count == 0)
        return false;
    struct slabs r = slabs_of(ray);
    struct shear s = shear_of(ray->direction);
    struct lom_ray_hit tried;
    uint32_t stack[STACK] = { 0 };
    bool found = false;
    for (int top = 1; top > 0;) {
        const struct lom_ray_node *node = &set->nodes[stack[--top]];
        if (!meets_box(&r, node, low, hit->t))
            continue;
        if (node->count == 0) {
            bool upper_first = r.backward[node->axis]; /* the order decides nothing but the time */
            stack[top++] = node->first + !upper_first;
            stack[top++] = node->first + upper_first;
            continue;
        }
        for (uint32_t i = node->first; i < node->first + node->count; i++)
            if (hit_sheared(set, ray, &s, set->order[i], &tried) && tried.t > low &&
                (tried.t < hit->t || (found && tried.t == hit->t && tried.triangle < hit->triangle))) {
                *hit = tried;
                found = true;
            }
    }
    return found;
}
