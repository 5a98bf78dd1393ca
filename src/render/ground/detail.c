/* Level of detail of terrain. In: the whole frame's camera and an error in pixels. Out: a level for each block, the
 * order from near to far, and the triangles of a block.
 *
 * Seen from a distance d, a metre is at most scale / d pixels on the screen, so a level is good enough where error *
 * scale <= pixels * d, with d to the nearest point of the block's box, and 1 of parallel rays. Neighbours are kept
 * within one level of each other; the finer one leaves out every second vertex of the edge they share, which then has
 * the same vertices on both sides, so there are no cracks (Losasso and Hoppe, "Geometry clipmaps", SIGGRAPH 2004,
 * section 4, has the other ways). Compiled for speed. */
#include "base/reserve.h"
#include "render/ground/ground.h"

/* ---- levels ---- */

static double outside(double x, double low, double high)
{
    return x < low ? low - x : x > high ? x - high : 0;
}

static double distance_to(const lom_box *box, lom_vec3 p)
{
    return lom_vec3_length((lom_vec3){ outside(p.x, box->low.x, box->high.x), outside(p.y, box->low.y, box->high.y),
                                       outside(p.z, box->low.z, box->high.z) });
}

static int coarsest(const struct lom_ground_block *block, double distance, double scale, double pixels)
{
    int level = 0;
    while (level + 1 < LOM_GROUND_LEVELS && (double)block->error[level + 1] * scale <= pixels * distance)
        level++;
    return level;
}

static int finer(int a, int b)
{
    return a < b ? a : b;
}

/* Sweeps until no block is more than one level coarser than a neighbour: the largest such assignment below the wishes,
 * whatever the order of the sweeps. */
static void bind_neighbours(struct lom_ground *ground)
{
    const int across = ground->across, down = ground->down;
    for (bool changed = true; changed;) {
        changed = false;
        for (int y = 0; y < down; y++)
            for (int x = 0; x < across; x++) {
                int *level = &ground->level[y * across + x], finest = LOM_GROUND_LEVELS;
                finest = finer(finest, x > 0 ? level[-1] : finest);
                finest = finer(finest, x + 1 < across ? level[1] : finest);
                finest = finer(finest, y > 0 ? level[-across] : finest);
                finest = finer(finest, y + 1 < down ? level[across] : finest);
                if (*level > finest + 1) {
                    *level = finest + 1;
                    changed = true;
                }
            }
    }
}

/* From near to far in BUCKETS steps of distance; within a step the blocks keep their order. */
static void sort_blocks(struct lom_ground *ground)
{
    enum { BUCKETS = 256 };
    size_t count = (size_t)ground->across * (size_t)ground->down, next[BUCKETS + 1] = { 0 };
    double farthest = 0;
    for (size_t i = 0; i < count; i++)
        farthest = ground->distance[i] > farthest ? ground->distance[i] : farthest;
    for (size_t i = 0; i < count; i++) {
        double part = farthest > 0 ? ground->distance[i] / farthest : 0;
        const int bucket = lom_int_of(part * (BUCKETS - 1));
        ground->distance[i] = bucket;
        next[bucket + 1]++;
    }
    for (int i = 0; i < BUCKETS; i++)
        next[i + 1] += next[i];
    for (size_t i = 0; i < count; i++)
        ground->order[next[lom_int_of(ground->distance[i])]++] = (uint32_t)i;
}

/* ---- triangles ---- */

/* The vertex at (x, y) of the pattern, moved to the even one before it on an edge whose neighbour is coarser. */
static uint32_t vertex_at(const struct lom_ground_pattern *p, int x, int y)
{
    bool upright = (x == 0 && (p->edges & LOM_EDGE_LEFT) != 0) || (x == p->columns && (p->edges & LOM_EDGE_RIGHT) != 0);
    bool level = (y == 0 && (p->edges & LOM_EDGE_TOP) != 0) || (y == p->rows && (p->edges & LOM_EDGE_BOTTOM) != 0);
    if (upright && y < p->rows)
        y &= ~1;
    if (level && x < p->columns)
        x &= ~1;
    return (uint32_t)y * (uint32_t)(p->columns + 1) + (uint32_t)x;
}

static void add_triangle(struct lom_ground *ground, uint32_t a, uint32_t b, uint32_t c)
{
    if (a == b || b == c || c == a)
        return;
    uint32_t *next = ground->indices + ground->index_count;
    next[0] = a;
    next[1] = b;
    next[2] = c;
    ground->index_count += 3;
}

static bool fill_pattern(struct lom_ground *ground, struct lom_ground_pattern *p, lom_error *error)
{
    const size_t most = (size_t)p->columns * (size_t)p->rows * 6;
    if (!lom_reserve(&ground->indices, &ground->index_capacity, ground->index_count + most, sizeof *ground->indices,
                     error))
        return false;
    p->first = ground->index_count;
    for (int y = 0; y < p->rows; y++)
        for (int x = 0; x < p->columns; x++) {
            uint32_t a = vertex_at(p, x, y), b = vertex_at(p, x + 1, y);
            uint32_t c = vertex_at(p, x, y + 1), d = vertex_at(p, x + 1, y + 1);
            add_triangle(ground, a, c, b);
            add_triangle(ground, b, c, d);
        }
    p->count = ground->index_count - p->first;
    return true;
}

/* The number of a pattern; of none: how many there are. */
static size_t find_pattern(const struct lom_ground *ground, int columns, int rows, int edges)
{
    size_t i = 0;
    for (; i < ground->pattern_count; i++) {
        const struct lom_ground_pattern *p = &ground->patterns[i];
        if (p->columns == columns && p->rows == rows && p->edges == edges)
            break;
    }
    return i;
}

/* Quads along an edge of a level of a block. */
static int joined_quads(int quads, int level)
{
    return (quads + (1 << level) - 1) >> level;
}

static bool add_patterns(struct lom_ground *ground, const struct lom_ground_block *block, int level, int *number,
                         lom_error *error)
{
    int columns = joined_quads(block->columns, level), rows = joined_quads(block->rows, level);
    int sets = level + 1 < LOM_GROUND_LEVELS ? LOM_EDGE_SETS : 1; /* nothing is coarser than the coarsest */
    for (int edges = 0; edges < sets; edges++) {
        size_t i = find_pattern(ground, columns, rows, edges);
        number[edges] = (int)i;
        if (i < ground->pattern_count)
            continue;
        ground->patterns[i] = (struct lom_ground_pattern){ .columns = columns, .rows = rows, .edges = edges };
        if (!fill_pattern(ground, &ground->patterns[i], error))
            return false;
        ground->pattern_count++;
    }
    return true;
}

/* One for each size of a block (those at the far borders may be smaller), level and set of edges. */
bool lom_make_ground_patterns(struct lom_ground *ground, lom_error *error)
{
    const int last[LOM_BLOCK_SIZES] = { 0, ground->across - 1, (ground->down - 1) * ground->across,
                                        ground->down * ground->across - 1 };
    for (int i = 0; i < LOM_BLOCK_SIZES; i++)
        for (int level = 0; level < LOM_GROUND_LEVELS; level++)
            if (!add_patterns(ground, &ground->blocks[last[i]], level, ground->pattern_of[i][level], error))
                return false;
    return true;
}

static int choose_pattern(const struct lom_ground *ground, int x, int y)
{
    const int across = ground->across, *level = &ground->level[y * across + x];
    const bool is_last = x + 1 == across, is_lowest = y + 1 == ground->down;
    int edges = 0;
    if (x > 0 && level[-1] > *level)
        edges |= LOM_EDGE_LEFT;
    if (!is_last && level[1] > *level)
        edges |= LOM_EDGE_RIGHT;
    if (y > 0 && level[-across] > *level)
        edges |= LOM_EDGE_TOP;
    if (!is_lowest && level[across] > *level)
        edges |= LOM_EDGE_BOTTOM;
    return ground->pattern_of[is_last + 2 * is_lowest][*level][edges];
}

void lom_choose_ground(struct lom_ground *ground, lom_vec3 eye, double scale, double pixels, bool parallel)
{
    int count = ground->across * ground->down;
    for (int i = 0; i < count; i++) {
        const struct lom_ground_block *block = &ground->blocks[i];
        ground->distance[i] = distance_to(&block->bounds, eye);
        ground->level[i] = pixels > 0 ? coarsest(block, parallel ? 1 : ground->distance[i], scale, pixels) : 0;
    }
    bind_neighbours(ground);
    sort_blocks(ground);
    for (int y = 0, i = 0; y < ground->down; y++)
        for (int x = 0; x < ground->across; x++, i++)
            ground->pattern[i] = choose_pattern(ground, x, y);
}
