/* Particles and the grid (the affine particle-in-cell method: lom/fluid.h). Compiled for speed. In: particles; faces
 * with velocities. Out: masses and momenta of faces, densities; particles that have moved. Invariant: what several
 * particles add to is added to in one order: slab after slab of cells, of each colour, and in it particle after
 * particle.
 *
 * A particle reaches the eight nodes around it with the products of tents. Beyond a wall of the basin lies what lies
 * before it where it lets the liquid slide: there the nearest node takes the whole weight. Where it holds the liquid
 * the opposite lies beyond it, so that the velocity is 0 at the wall. */
#include "fluid/fluid.h"

#include "base/numbers.h"

#include <string.h>

/* The nodes that a particle reaches: faces of an axis, or with axis 3 middles of cells. */
struct reach {
    size_t node;         /* the lowest of them */
    double weight[3][2]; /* along each axis of the lower and the higher one */
    double slope[3];     /* of the higher one's weight along the axis; the lower one's is minus that */
    double past[3];      /* how far beyond the last node, towards a wall that holds the liquid */
};

static inline void find_reach(const struct lom_fluid *f, const double at[3], int axis, struct reach *out)
{
    out->node = 0;
    for (int i = 0; i < 3; i++) {
        const double most = i == axis ? f->cells[i] : f->cells[i] - 1;
        const double place = i == axis ? at[i] : at[i] - 0.5;
        const double clamped = place < 0 ? 0 : place > most ? most : place;
        const int node = (int)lom_count_of(clamped, LOM_FLUID_CELLS);
        out->slope[i] = place > 0 && place < most ? 1 : 0;
        out->past[i] = axis < 3 && i != axis && f->strain != NULL && !f->desc.slides[i] ? place - clamped : 0;
        out->weight[i][1] = clamped - node;
        out->weight[i][0] = 1 - out->weight[i][1];
        out->node += (size_t)node * f->stride[i];
    }
}

/* Of node 0..7: its bits say along which axes it is the higher one. */
static inline size_t node_of(const struct lom_fluid *f, const struct reach *r, int corner)
{
    return r->node + ((size_t)corner & 1) + ((size_t)corner >> 1 & 1) * f->stride[1] +
           ((size_t)corner >> 2 & 1) * f->stride[2];
}

static inline double weight_of(const struct reach *r, int corner)
{
    return r->weight[0][corner & 1] * r->weight[1][corner >> 1 & 1] * r->weight[2][corner >> 2 & 1];
}

/* ---- sorting ---- */

static size_t cell_at(const struct lom_fluid *f, const double at[3])
{
    size_t n = 0;
    for (int i = 0; i < 3; i++)
        n += lom_count_of(at[i], (size_t)f->cells[i] - 1) * f->stride[i];
    return n;
}

static void find_cells(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (size_t i = first; i < end; i++)
        f->place[i] = (uint32_t)cell_at(f, f->points[i].at);
}

static void put_points(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (size_t i = first; i < end; i++)
        f->sorted[f->place[i]] = f->points[i];
}

/* By cell, of equal ones the first stays first. The counts are kept: they are where each cell's particles begin. One
 * worker counts; all find cells and move particles, which is most of it. */
void lom_sort_fluid(struct lom_fluid *f)
{
    uint32_t *first = f->first;
    lom_share_fluid(f, f->point_count, LOM_FLUID_PIECE / 4, find_cells, f);
    memset(first, 0, (f->count + 1) * sizeof *first);
    for (size_t i = 0; i < f->point_count; i++)
        first[f->place[i] + 1]++;
    for (size_t n = 0; n < f->count; n++)
        first[n + 1] += first[n];
    for (size_t i = 0; i < f->point_count; i++)
        f->place[i] = first[f->place[i]]++;
    memmove(first + 1, first, f->count * sizeof *first);
    first[0] = 0;
    lom_share_fluid(f, f->point_count, LOM_FLUID_PIECE / 4, put_points, f);
    struct lom_fluid_point *points = f->points;
    f->points = f->sorted;
    f->sorted = points;
}

/* ---- to the grid ---- */

static inline void add_point(struct lom_fluid *f, const struct lom_fluid_point *point)
{
    struct reach r;
    for (int axis = 0; axis < 3; axis++) {
        find_reach(f, point->at, axis, &r);
        const double *slope = point->affine[axis];
        double change[3][2];
        for (int i = 0; i < 3; i++) {
            change[i][0] = slope[i] * (-r.weight[i][1] * r.slope[i] - r.past[i]);
            change[i][1] = slope[i] * (r.weight[i][0] * r.slope[i] - r.past[i]);
        }
        for (int corner = 0; corner < 8; corner++) {
            struct lom_fluid_face *face = &f->face[axis][node_of(f, &r, corner)];
            const double weight = weight_of(&r, corner);
            face->mass += weight;
            face->velocity += weight * (point->velocity[axis] + (change[0][corner & 1] + change[1][corner >> 1 & 1] +
                                                                 change[2][corner >> 2 & 1]));
        }
    }
    find_reach(f, point->at, 3, &r);
    for (int corner = 0; corner < 8; corner++)
        f->density[node_of(f, &r, corner)] += weight_of(&r, corner);
}

void lom_add_density(struct lom_fluid *f, const double at[3], double weight)
{
    struct reach r;
    find_reach(f, at, 3, &r);
    for (int corner = 0; corner < 8; corner++)
        f->density[node_of(f, &r, corner)] += weight * weight_of(&r, corner);
}

/* Slabs of cells across z that are three apart share no face. */
struct gathering {
    struct lom_fluid *f;
    int colour;
};

static void gather_slabs(void *context, size_t first, size_t end)
{
    const struct gathering *g = context;
    struct lom_fluid *f = g->f;
    for (size_t slab = first; slab < end; slab++) {
        const size_t k = 3 * slab + (size_t)g->colour;
        const uint32_t last = f->first[(k + 1) * f->stride[2]];
        for (uint32_t i = f->first[k * f->stride[2]]; i < last; i++)
            add_point(f, &f->points[i]);
    }
}

static void clear_faces(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (int axis = 0; axis < 3; axis++)
        memset(f->face[axis] + first, 0, (end - first) * sizeof *f->face[axis]);
    memset(f->density + first, 0, (end - first) * sizeof *f->density);
}

void lom_gather_fluid(struct lom_fluid *f)
{
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, clear_faces, f);
    for (int colour = 0; colour < 3 && colour < f->cells[2]; colour++) {
        struct gathering g = { .f = f, .colour = colour };
        lom_share_fluid(f, ((size_t)(f->cells[2] - colour) + 2) / 3, 1, gather_slabs, &g);
    }
}

/* ---- from the grid ---- */

/* Beyond the last node before a wall that holds it, half a cell away, the velocity falls to 0: it and its slopes. */
static inline double hold(double slope[3], int axis, double past, double velocity)
{
    const double share = 1 - 2 * lom_magnitude(past);
    for (int i = 0; i < 3; i++)
        slope[i] *= share;
    slope[axis] = past < 0 ? 2 * velocity : -2 * velocity;
    return velocity * share;
}

/* Between the eight values: along x, then y, then z; and what it changes by along each of them. */
static inline double interpolate(const double v[8], const struct reach *r, double slope[3])
{
    const double x = r->weight[0][1], y = r->weight[1][1], z = r->weight[2][1];
    double a[4], dx[4], b[2], dbx[2], dby[2];
    for (int i = 0; i < 4; i++) {
        dx[i] = v[2 * i + 1] - v[2 * i];
        a[i] = v[2 * i] + x * dx[i];
    }
    for (int i = 0; i < 2; i++) {
        dby[i] = a[2 * i + 1] - a[2 * i];
        b[i] = a[2 * i] + y * dby[i];
        dbx[i] = dx[2 * i] + y * (dx[2 * i + 1] - dx[2 * i]);
    }
    slope[0] = dbx[0] + z * (dbx[1] - dbx[0]);
    slope[1] = dby[0] + z * (dby[1] - dby[0]);
    slope[2] = b[1] - b[0];
    return b[0] + z * slope[2];
}

/* Velocity and its gradient from the faces; and how far the potential of densities pushes along the axis. */
static inline double take_axis(const struct lom_fluid *f, struct lom_fluid_point *point, int axis, const double at[3])
{
    struct reach r;
    find_reach(f, at, axis, &r);
    double v[8], pushes[8], slope[3], unused[3];
    for (int corner = 0; corner < 8; corner++) {
        const struct lom_fluid_face *face = &f->face[axis][node_of(f, &r, corner)];
        v[corner] = face->velocity;
        pushes[corner] = face->push;
    }
    double velocity = interpolate(v, &r, slope);
    for (int i = 0; i < 3; i++)
        point->affine[axis][i] = slope[i] * r.slope[i];
    for (int i = 0; i < 3; i++)
        if (r.past[i] != 0)
            velocity = hold(point->affine[axis], i, r.past[i], velocity);
    point->velocity[axis] = velocity;
    return velocity * f->desc.step + interpolate(pushes, &r, unused);
}

/* Whether an obstacle is there; the ground is none, onto which particles are put. */
static inline bool is_obstacle(const struct lom_fluid *f, const double at[3])
{
    const size_t n = cell_at(f, at);
    return f->kind[n] == LOM_FLUID_SOLID && (f->floor == NULL || !lom_is_ground(f, n));
}

/* A particle that would be in a solid stays along the axes that lead there; one that would be in the ground comes onto
 * it, or stays. */
static inline void move_point(const struct lom_fluid *f, struct lom_fluid_point *point)
{
    const double edge = 1e-3;
    double at[3], way[3];
    memcpy(at, point->at, sizeof at);
    for (int axis = 0; axis < 3; axis++)
        way[axis] = take_axis(f, point, axis, at);
    for (int axis = 0; axis < 3; axis++) {
        const double from = point->at[axis], to = from + way[axis];
        point->at[axis] = lom_larger(edge, lom_smaller(to, f->cells[axis] - edge));
        if (is_obstacle(f, point->at))
            point->at[axis] = from;
    }
    if (f->floor != NULL && (!lom_put_on_ground(f, point->at) || is_obstacle(f, point->at)))
        memcpy(point->at, at, sizeof at);
}

static void move_points(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (size_t i = first; i < end; i++)
        move_point(f, &f->points[i]);
}

void lom_move_fluid(struct lom_fluid *f)
{
    lom_share_fluid(f, f->point_count, LOM_FLUID_PIECE / 4, move_points, f);
}
