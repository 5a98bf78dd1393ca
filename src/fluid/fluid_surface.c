/* The surface of a liquid as a mesh. Compiled for speed. In: particles. Out: closed triangles. Invariant: a vertex is a
 * function of the particles around it, and vertices are numbered in the order of nodes.
 *
 * Nodes are half a cell apart, one more on each side than the basin has. A node's value is the distance to the mean of
 * the particles around it, weighted by (1 - (d / R)^2)^3 with R a cell, less the radius of one particle (Zhu, Bridson
 * 2005): below 0 within the liquid. It is looked up no nearer to a wall than particles at rest are, so that the surface
 * meets walls upright, and smoothed once. Of a cube of eight nodes with both signs the mean of the crossings of its
 * edges is a vertex, and each edge that crosses is a quad of the four cubes around it (Gibson 1998). */
#include "fluid/fluid.h"

#include "base/numbers.h"
#include "base/own_float_state.h"
#include "base/reserve.h"

static const double radius = 0.281; /* of a particle, cells: a level surface lies half a spacing above the uppermost */
static const double far_away = 0.5; /* cells: the value of what no particle is near */
static const double wall = 1e-3;    /* cells before a wall the surface ends */

struct field {
    const struct lom_fluid *f;
    size_t nodes[3], stride[3], count;
    float *value, *smooth;
    uint32_t *number; /* of a cube's vertex, by its lowest node; UINT32_MAX: none */
    struct slab {
        size_t vertices, quads; /* of a slab of nodes across z: how many, then how many are before them */
    } * slabs;
    size_t vertex_count, quad_count;
    lom_mesh *mesh;
    const double *origin;
};

/* ---- values ---- */

/* Whether the cell and all around it hold at least half of what they do at rest. */
static bool is_deep(const struct lom_fluid *f, const int cell[3])
{
    size_t n = 0;
    for (int i = 0; i < 3; i++) {
        if (cell[i] < 1 || cell[i] > f->cells[i] - 2)
            return false;
        n += (size_t)(cell[i] - 1) * f->stride[i];
    }
    for (size_t k = 0; k < 3; k++)
        for (size_t j = 0; j < 3; j++)
            for (size_t i = 0; i < 3; i++) {
                const size_t other = n + i + j * f->stride[1] + k * f->stride[2];
                if (f->first[other + 1] - f->first[other] < LOM_FLUID_REST / 2)
                    return false;
            }
    return true;
}

static double value_at(const struct lom_fluid *f, const double at[3])
{
    int cell[3], low[3], high[3];
    for (int i = 0; i < 3; i++) {
        cell[i] = lom_int_of(at[i]);
        low[i] = lom_larger_int(cell[i] - 1, 0);
        high[i] = lom_smaller_int(cell[i] + 1, f->cells[i] - 1);
    }
    if (is_deep(f, cell))
        return -radius;
    double sum = 0, mean[3] = { 0, 0, 0 };
    for (int k = low[2]; k <= high[2]; k++)
        for (int j = low[1]; j <= high[1]; j++) {
            const size_t row = (size_t)j * f->stride[1] + (size_t)k * f->stride[2];
            const uint32_t end = f->first[row + (size_t)high[0] + 1];
            for (uint32_t p = f->first[row + (size_t)low[0]]; p < end; p++) {
                const double *x = f->points[p].at, d[3] = { x[0] - at[0], x[1] - at[1], x[2] - at[2] };
                const double near = 1 - (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                if (!(near > 0))
                    continue;
                const double weight = near * near * near;
                sum += weight;
                for (int i = 0; i < 3; i++)
                    mean[i] += weight * d[i];
            }
        }
    if (!(sum > 0))
        return far_away;
    const double square = (mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]) / (sum * sum);
    return lom_smaller(lom_double_sqrt(square) - radius, far_away);
}

static void fill_slabs(void *context, size_t first, size_t end)
{
    struct field *field = context;
    const struct lom_fluid *f = field->f;
    for (size_t n = first * field->stride[2]; n < end * field->stride[2]; n++) {
        const size_t node[3] = { n % field->nodes[0], n / field->stride[1] % field->nodes[1], n / field->stride[2] };
        double at[3];
        for (int i = 0; i < 3; i++)
            at[i] = lom_larger(0.25, lom_smaller(((double)node[i] - 1) / 2, f->cells[i] - 0.25));
        field->value[n] = (float)value_at(f, at);
    }
}

/* How far beyond a wall a node is, cells. */
static float beyond_wall(const struct field *field, const size_t node[3])
{
    double most = -1e9;
    for (int i = 0; i < 3; i++) {
        const double at = ((double)node[i] - 1) / 2;
        most = lom_larger(most, lom_larger(-at, at - field->f->cells[i]));
    }
    return (float)(most + wall);
}

static void smooth_slabs(void *context, size_t first, size_t end)
{
    struct field *field = context;
    const float *v = field->value;
    for (size_t n = first * field->stride[2]; n < end * field->stride[2]; n++) {
        const size_t node[3] = { n % field->nodes[0], n / field->stride[1] % field->nodes[1], n / field->stride[2] };
        float sum = 0;
        for (int i = 0; i < 3; i++) {
            sum += node[i] > 0 ? v[n - field->stride[i]] : v[n];
            sum += node[i] + 1 < field->nodes[i] ? v[n + field->stride[i]] : v[n];
        }
        const float mean = 0.5f * v[n] + sum / 12, cut = beyond_wall(field, node);
        field->smooth[n] = mean > cut ? mean : cut;
    }
}

/* ---- vertices ---- */

static size_t corner_of(const struct field *field, size_t n, int corner)
{
    return n + ((size_t)corner & 1) + ((size_t)corner >> 1 & 1) * field->stride[1] +
           ((size_t)corner >> 2 & 1) * field->stride[2];
}

static bool is_inside(const struct field *field, size_t n)
{
    return field->smooth[n] < 0;
}

/* Numbers the cubes with both signs from 0 in each slab, and counts the edges that cross. */
static void count_slabs(void *context, size_t first, size_t end)
{
    struct field *field = context;
    for (size_t n = first * field->stride[2]; n < end * field->stride[2]; n++) {
        const size_t node[3] = { n % field->nodes[0], n / field->stride[1] % field->nodes[1], n / field->stride[2] };
        struct slab *slab = &field->slabs[node[2]];
        bool is_cube = true;
        for (int i = 0; i < 3; i++) {
            const bool has = node[i] + 1 < field->nodes[i];
            is_cube = is_cube && has;
            slab->quads += has && is_inside(field, n) != is_inside(field, n + field->stride[i]);
        }
        int inside = 0;
        for (int corner = 0; is_cube && corner < 8; corner++)
            inside += is_inside(field, corner_of(field, n, corner));
        field->number[n] = inside > 0 && inside < 8 ? (uint32_t)slab->vertices++ : UINT32_MAX;
    }
}

static void number_slabs(void *context, size_t first, size_t end)
{
    struct field *field = context;
    for (size_t k = first; k < end; k++)
        for (size_t n = k * field->stride[2]; n < (k + 1) * field->stride[2]; n++)
            if (field->number[n] != UINT32_MAX)
                field->number[n] += (uint32_t)field->slabs[k].vertices;
}

static void number_cubes(struct field *field)
{
    lom_share_fluid(field->f, field->nodes[2], 1, count_slabs, field);
    for (size_t k = 0; k < field->nodes[2]; k++) {
        const struct slab counted = field->slabs[k];
        field->slabs[k] = (struct slab){ field->vertex_count, field->quad_count };
        field->vertex_count += counted.vertices;
        field->quad_count += counted.quads;
    }
    lom_share_fluid(field->f, field->nodes[2], 1, number_slabs, field);
}

/* The field between nodes; places in nodes, within them. */
static double between(const struct field *field, const double place[3])
{
    size_t n = 0;
    double share[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        const double clamped = lom_larger(0, lom_smaller(place[i], (double)field->nodes[i] - 1));
        const size_t low = lom_count_of(clamped, field->nodes[i] - 2);
        share[i] = clamped - (double)low;
        n += low * field->stride[i];
    }
    for (int corner = 0; corner < 8; corner++) {
        double weight = 1;
        for (int i = 0; i < 3; i++)
            weight *= corner >> i & 1 ? share[i] : 1 - share[i];
        sum += weight * (double)field->smooth[corner_of(field, n, corner)];
    }
    return sum;
}

/* The mean of the places, less the cube's lowest node, where its edges cross. */
static void find_crossing(const struct field *field, size_t n, double mean[3])
{
    int count = 0;
    mean[0] = mean[1] = mean[2] = 0;
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 0; axis < 3; axis++) {
            if (corner >> axis & 1)
                continue;
            const double a = (double)field->smooth[corner_of(field, n, corner)],
                         b = (double)field->smooth[corner_of(field, n, corner | 1 << axis)];
            if ((a < 0) == (b < 0))
                continue;
            for (int i = 0; i < 3; i++)
                mean[i] += i == axis ? a / (a - b) : corner >> i & 1;
            count++;
        }
    for (int i = 0; i < 3; i++)
        mean[i] /= count;
}

static void place_vertices(void *context, size_t first, size_t end)
{
    const struct field *field = context;
    const struct lom_fluid *f = field->f;
    for (size_t n = first; n < end; n++) {
        if (field->number[n] == UINT32_MAX)
            continue;
        lom_mesh_vertex *vertex = &field->mesh->vertices[field->number[n]];
        const size_t node[3] = { n % field->nodes[0], n / field->stride[1] % field->nodes[1], n / field->stride[2] };
        double place[3], slope[3], square = 0;
        find_crossing(field, n, place);
        for (int i = 0; i < 3; i++)
            place[i] += (double)node[i];
        for (int i = 0; i < 3; i++) {
            double low[3] = { place[0], place[1], place[2] }, high[3] = { place[0], place[1], place[2] };
            low[i] -= 1;
            high[i] += 1;
            slope[i] = between(field, high) - between(field, low);
            square += slope[i] * slope[i];
        }
        const double inverse = square > 0 ? 1 / lom_double_sqrt(square) : 0;
        for (int i = 0; i < 3; i++) {
            vertex->position[i] = (float)(f->desc.low[i] - field->origin[i] + (place[i] - 1) / 2 * f->cell);
            vertex->normal[i] = (float)(slope[i] * inverse);
        }
        for (int i = 0; i < 4; i++)
            vertex->color[i] = 1;
    }
}

/* Two triangles for the edge from a node along an axis: the vertices of the four cubes around it, seen from its outer
 * end in the order of front faces. */
static uint32_t *add_quad(const struct field *field, size_t n, int axis, uint32_t *out)
{
    const size_t a = field->stride[(axis + 1) % 3], b = field->stride[(axis + 2) % 3];
    const uint32_t around[4] = { field->number[n - a - b], field->number[n - b], field->number[n],
                                 field->number[n - a] };
    const bool along = is_inside(field, n);
    static const int order[2][6] = { { 0, 2, 1, 0, 3, 2 }, { 0, 1, 2, 0, 2, 3 } };
    for (int i = 0; i < 6; i++)
        *out++ = around[order[along][i]];
    return out;
}

static void add_quads(void *context, size_t first, size_t end)
{
    const struct field *field = context;
    uint32_t *out = field->mesh->indices + 6 * field->slabs[first].quads;
    for (size_t n = first * field->stride[2]; n < end * field->stride[2]; n++) {
        const size_t node[3] = { n % field->nodes[0], n / field->stride[1] % field->nodes[1], n / field->stride[2] };
        for (int axis = 0; axis < 3; axis++)
            if (node[axis] + 1 < field->nodes[axis] && is_inside(field, n) != is_inside(field, n + field->stride[axis]))
                out = add_quad(field, n, axis, out);
    }
}

static bool build(struct field *field, lom_error *error)
{
    lom_share_fluid(field->f, field->nodes[2], 1, fill_slabs, field);
    lom_share_fluid(field->f, field->nodes[2], 1, smooth_slabs, field);
    number_cubes(field);
    field->mesh = lom_create_mesh(field->vertex_count, 6 * field->quad_count, 1, 0, error);
    if (field->mesh == NULL)
        return false;
    field->mesh->parts[0] = (lom_mesh_part){ 0, (uint32_t)(6 * field->quad_count), -1 };
    field->mesh->source_triangles = 2 * field->quad_count;
    lom_share_fluid(field->f, field->count, LOM_FLUID_PIECE, place_vertices, field);
    lom_share_fluid(field->f, field->nodes[2], 1, add_quads, field);
    return true;
}

lom_mesh *lom_make_fluid_mesh(lom_fluid *f, const double origin[3], lom_device *device, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    struct field field = { .f = f, .stride = { 1 }, .count = 1, .origin = origin };
    for (int i = 0; i < 3; i++) {
        field.nodes[i] = 2 * (size_t)f->cells[i] + 3;
        field.stride[i] = field.count;
        field.count *= field.nodes[i];
    }
    field.value = lom_allocate_bare(field.count, sizeof *field.value, error);
    field.smooth = lom_allocate_bare(field.count, sizeof *field.smooth, error);
    field.number = lom_allocate_bare(field.count, sizeof *field.number, error);
    field.slabs = lom_allocate(field.nodes[2], sizeof *field.slabs, error);
    f->device = device;
    if (field.value != NULL && field.smooth != NULL && field.number != NULL && field.slabs != NULL) {
        lom_sort_fluid(f);
        build(&field, error);
    }
    f->device = NULL;
    lom_release(field.value);
    lom_release(field.smooth);
    lom_release(field.number);
    lom_release(field.slabs);
    return field.mesh;
}
