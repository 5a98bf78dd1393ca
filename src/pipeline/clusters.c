/* Clusters of a mesh: made once, looked at by every draw. In: positions and indices. Out: for each run of triangles the
 * box around its vertices and the ranges of their numbers; for a draw the clusters of which something may be seen.
 *
 * Invariant: a cluster that is left out has no fragment. All of its box lies outside one plane, by more than the
 * shader's arithmetic rounds: its vertices do, then, as the pipeline computes them, and so do the pixels of triangles
 * between them, whose centres are half a pixel inside the scissor; of samples on its edge the top-left rule gives none to
 * a triangle outside of it. */
#include "pipeline/clusters.h"
#include "pipeline/device.h"
#include "pipeline/variants.h"

/* ---- making ---- */

static float coordinate(const lom_attribute *positions, uint32_t vertex, size_t axis)
{
    float x;
    memcpy(&x, (const uint8_t *)positions->data + (size_t)vertex * positions->stride + 4 * axis, sizeof x);
    return x;
}

/* Numbers that are nearer than this are one range. */
enum { GAP = 32 };

/* Extends the range that the number is near to, or begins another one; without room for it, the last one. */
static void add_number(struct lom_cluster *cluster, uint32_t number)
{
    int i = 0;
    for (; i < cluster->ranges; i++)
        if ((uint64_t)number + GAP >= cluster->range[i][0] && number <= (uint64_t)cluster->range[i][1] + GAP)
            break;
    if (i == cluster->ranges && cluster->ranges < CLUSTER_RANGES) {
        cluster->range[i][0] = cluster->range[i][1] = number;
        cluster->ranges++;
        return;
    }
    i = i < CLUSTER_RANGES ? i : CLUSTER_RANGES - 1;
    cluster->range[i][0] = number < cluster->range[i][0] ? number : cluster->range[i][0];
    cluster->range[i][1] = number > cluster->range[i][1] ? number : cluster->range[i][1];
}

/* A coordinate that is no number moves no bound: the vertex stage drops its triangles. */
static void add_vertex(struct lom_cluster *cluster, const lom_attribute *positions, uint32_t number)
{
    add_number(cluster, number);
    for (size_t axis = 0; axis < 3; axis++) {
        float x = coordinate(positions, number, axis);
        cluster->low[axis] = x < cluster->low[axis] ? x : cluster->low[axis];
        cluster->high[axis] = x > cluster->high[axis] ? x : cluster->high[axis];
    }
}

static struct lom_cluster find_cluster(const lom_attribute *positions, const uint32_t *indices, size_t count)
{
    const float infinity = __builtin_inff();
    struct lom_cluster cluster = { .low = { infinity, infinity, infinity },
                                   .high = { -infinity, -infinity, -infinity } };
    for (size_t i = 0; i < count; i++)
        add_vertex(&cluster, positions, indices[i]);
    return cluster;
}

lom_clusters *lom_create_clusters(const lom_attribute *positions, const uint32_t *indices, size_t count,
                                  lom_error *error)
{
    if (positions == NULL || positions->data == NULL || positions->kind != LOM_ATTRIBUTE_FLOAT3 || indices == NULL ||
        count == 0 || count % 3 != 0 || count > UINT32_MAX) {
        lom_fail(error, LOM_ERROR_USAGE,
                 "Clusters are made of positions of three floats and of indices, three a triangle, at most 2^32 - 1.");
        return NULL;
    }
    uint32_t largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = indices[i] > largest ? indices[i] : largest;
    if (positions->size < 12 || (positions->stride != 0 && largest > (positions->size - 12) / positions->stride)) {
        lom_fail(error, LOM_ERROR_USAGE, "Clusters name the vertex %u, which their positions do not hold.", largest);
        return NULL;
    }
    lom_clusters *clusters = lom_allocate(1, sizeof *clusters, error);
    if (clusters == NULL)
        return NULL;
    size_t step = 3 * CLUSTER_TRIANGLES, number = (count + step - 1) / step;
    *clusters = (lom_clusters){ .count = number, .indices = count, .largest = largest };
    clusters->cluster = lom_allocate(number, sizeof *clusters->cluster, error);
    if (clusters->cluster == NULL) {
        lom_free_clusters(clusters);
        return NULL;
    }
    for (size_t i = 0; i < number; i++)
        clusters->cluster[i] =
            find_cluster(positions, indices + i * step, count - i * step < step ? count - i * step : step);
    return clusters;
}

void lom_free_clusters(lom_clusters *clusters)
{
    if (clusters == NULL)
        return;
    lom_release(clusters->cluster);
    lom_release(clusters);
}

/* ---- what a draw sees ---- */

/* Inside where the sum of plane[i] p[i] and plane[3] is >= 0; reach: the absolute values that were added up in plane. */
struct plane {
    double plane[4], reach[4];
};

enum { MOST_PLANES = 8 };

struct view {
    struct plane plane[MOST_PLANES];
    int count;
};

/* a row of the matrix, and another one, times factors. */
static void add_plane(struct view *view, const float *a, double by_a, const float *b, double by_b)
{
    struct plane *p = &view->plane[view->count++];
    for (int i = 0; i < 4; i++) {
        p->plane[i] = by_a * (double)a[i] + by_b * (double)b[i];
        p->reach[i] = __builtin_fabs(by_a * (double)a[i]) + __builtin_fabs(by_b * (double)b[i]);
    }
}

/* The scissor's edges are the lines x = ratio w, where the viewport's are -1 and 1. */
static struct view find_view(const struct lom_pass *pass, const struct lom_draw *draw)
{
    const lom_culling *culling = &draw->desc.culling;
    const float(*m)[4] = culling->clip_from_position.m;
    const lom_rect *v = &draw->desc.viewport, *s = &draw->scissor;
    struct view view = { .count = 0 };
    double left = 2.0 * (s->x - v->x) / v->width - 1, right = 2.0 * (s->x + s->width - v->x) / v->width - 1;
    double top = 1 - 2.0 * (s->y - v->y) / v->height, bottom = 1 - 2.0 * (s->y + s->height - v->y) / v->height;
    bool centred = pass->desc.clip_range == LOM_CLIP_MINUS_W_TO_W;
    add_plane(&view, m[0], 1, m[3], -left);
    add_plane(&view, m[0], -1, m[3], right);
    add_plane(&view, m[1], -1, m[3], top);
    add_plane(&view, m[1], 1, m[3], -bottom);
    add_plane(&view, m[2], 1, m[3], centred ? 1 : 0);
    add_plane(&view, m[2], -1, m[3], 1);
    add_plane(&view, m[3], 1, m[3], 0);
    if (draw->desc.shader->clip_distances > 0)
        add_plane(&view, culling->distance, 1, culling->distance, 0);
    return view;
}

/* Sixteen roundings of a float: a shader's product has four, and the ratio of the scissor's edge a few more. */
static const double rounding = 0x1p-20;

static bool is_outside(const struct plane *p, const struct lom_cluster *cluster)
{
    double farthest = p->plane[3], size = p->reach[3];
    for (int i = 0; i < 3; i++) {
        double low = (double)cluster->low[i], high = (double)cluster->high[i];
        double a = p->plane[i] * low, b = p->plane[i] * high;
        double c = __builtin_fabs(low), d = __builtin_fabs(high);
        farthest += a > b ? a : b;
        size += p->reach[i] * (c > d ? c : d);
    }
    return farthest < -rounding * size;
}

static bool may_be_seen(const struct view *view, const struct lom_cluster *cluster)
{
    for (int i = 0; i < view->count; i++)
        if (is_outside(&view->plane[i], cluster))
            return false;
    return true;
}

/* Adds a cluster to the device's runs; a chunk has at most so many. */
static bool add_to_runs(lom_device *device, struct lom_draw *draw, uint32_t cluster, uint32_t *left)
{
    if (*left == 0) {
        *left = (uint32_t)device->desc.chunk / CLUSTER_TRIANGLES;
        draw->chunk_count++;
    }
    --*left;
    struct lom_run *last = draw->run_count > 0 ? &device->runs[device->run_count - 1] : NULL;
    if (last != NULL && last->first + last->count == cluster && last->chunk + 1 == draw->chunk_count) {
        last->count++;
        return true;
    }
    if (!lom_reserve(&device->runs, &device->run_capacity, device->run_count + 1, sizeof *device->runs, NULL))
        return false;
    device->runs[device->run_count++] = (struct lom_run){ cluster, 1, (uint32_t)draw->chunk_count - 1 };
    draw->run_count++;
    return true;
}

bool lom_find_runs(lom_device *device, struct lom_draw *draw)
{
    const lom_clusters *clusters = draw->desc.culling.clusters;
    struct view view = find_view(&device->pass, draw);
    uint32_t left = 0;
    draw->first_run = device->run_count;
    draw->run_count = draw->chunk_count = 0;
    for (size_t i = 0; i < clusters->count; i++)
        if (may_be_seen(&view, &clusters->cluster[i]) && !add_to_runs(device, draw, (uint32_t)i, &left))
            return false;
    return true;
}

/* ---- a chunk of clusters ---- */

size_t lom_triangles_of_run(const lom_clusters *clusters, const struct lom_run *run)
{
    size_t end = (size_t)(run->first + run->count) * CLUSTER_TRIANGLES, all = clusters->indices / 3;
    return (end < all ? end : all) - (size_t)run->first * CLUSTER_TRIANGLES;
}

static void find_extremes(const struct lom_chunk *chunk, uint32_t *low, uint32_t *high)
{
    const struct lom_cluster *cluster = chunk->draw->desc.culling.clusters->cluster;
    *low = UINT32_MAX;
    *high = 0;
    for (size_t r = 0; r < chunk->run_count; r++)
        for (uint32_t i = chunk->runs[r].first; i < chunk->runs[r].first + chunk->runs[r].count; i++)
            for (int k = 0; k < cluster[i].ranges; k++) {
                *low = cluster[i].range[k][0] < *low ? cluster[i].range[k][0] : *low;
                *high = cluster[i].range[k][1] > *high ? cluster[i].range[k][1] : *high;
            }
}

/* Which packets of vertices the chunk's clusters need. */
static bool mark_packets(struct lom_chunk *chunk, uint32_t low, uint32_t high)
{
    struct lom_assembly *assembly = chunk->assembly;
    const struct lom_cluster *cluster = chunk->draw->desc.culling.clusters->cluster;
    size_t packets = (high - low) / NEEDED_VERTICES + 1;
    if (!lom_reserve(&assembly->needed, &assembly->needed_capacity, packets, 1, NULL))
        return false;
    memset(assembly->needed, 0, packets);
    for (size_t r = 0; r < chunk->run_count; r++)
        for (uint32_t i = chunk->runs[r].first; i < chunk->runs[r].first + chunk->runs[r].count; i++)
            for (int k = 0; k < cluster[i].ranges; k++) {
                size_t first = (cluster[i].range[k][0] - low) / NEEDED_VERTICES;
                memset(assembly->needed + first, 1, (cluster[i].range[k][1] - low) / NEEDED_VERTICES - first + 1);
            }
    chunk->needed = assembly->needed;
    return true;
}

bool lom_gather_clusters(struct lom_chunk *chunk, uint32_t *low, uint32_t *high)
{
    const lom_clusters *clusters = chunk->draw->desc.culling.clusters;
    const uint32_t *indices = chunk->draw->desc.indices;
    uint32_t *to = chunk->assembly->corners;
    find_extremes(chunk, low, high);
    bool is_list = (size_t)(*high - *low) + 1 > MOST_ROWS * chunk->count;
    for (size_t r = 0; r < chunk->run_count; r++) {
        size_t count = 3 * lom_triangles_of_run(clusters, &chunk->runs[r]);
        lom_stages_of(chunk->draw->variant)
            ->rebase_indices(indices + (size_t)chunk->runs[r].first * 3 * CLUSTER_TRIANGLES, count, is_list ? 0 : *low,
                             to);
        to += count;
    }
    return is_list || mark_packets(chunk, *low, *high);
}
