/* Viscosity, with a value a cell. Compiled for speed. In: faces before their pressure. Out: faces that have rubbed
 * along each other for a step. Invariant: what one face loses another gains, but at walls.
 *
 * The implicit step u' makes
 *     1/2 sum over faces (u' - u)^2 + dt/2 sum over samples of strain k (sum of +-u')^2
 * least: k = 2 nu in the middle of a cell, where the strain along an axis is the difference of its two faces; k = nu in
 * the middle of an edge, where the shear is the differences of two pairs of faces (C. Batty, R. Bridson: Accurate
 * viscous free surfaces for buckling, coiling, and rotating liquids, SCA 2008). A sample that air touches is left
 * out: nothing pulls at a free surface. Along a wall of solids the shear is that to the face's mirror image, 2 u over
 * half the volume: k = 2 nu of the face alone. Turning and moving as a whole have no strain, so that nothing brakes
 * them; one viscosity for what melts and what has melted is M. Carlson, P. Mucha, R. Van Horn, G. Turk: Melting and
 * flowing, SCA 2002. The least is found by conjugate gradients (fluid_strain.c). Slabs of cells across z are counted, then
 * filled, each by one worker. */
#include "fluid/fluid_strain.h"

#include "base/numbers.h"
#include "base/reserve.h"

#include <string.h>

bool lom_open_strain(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain = lom_allocate(1, sizeof *s, error);
    if (s == NULL)
        return false;
    s->unknown = lom_allocate(3 * f->count, sizeof *s->unknown, error);
    s->viscosity = lom_allocate(f->count, sizeof *s->viscosity, error);
    s->slabs = lom_allocate((size_t)f->cells[2] + 2, sizeof *s->slabs, error);
    return s->unknown != NULL && s->viscosity != NULL && s->slabs != NULL;
}

void lom_close_strain(struct lom_fluid *f)
{
    struct lom_fluid_strain *s = f->strain;
    if (s == NULL)
        return;
    void *const arrays[] = { s->samples, s->face,      s->x,     s->residual, s->way,   s->product, s->diagonal,
                             s->unknown, s->viscosity, s->slabs, s->pull,     s->first, s->touch,   s->done };
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        lom_release(arrays[i]);
    lom_release(s);
}

/* ---- what there is ---- */

/* From the solid's to the liquid's through a smooth step of the share that has melted, in logarithms: so that
 * every tenth of the way divides it by the same. */
static double viscosity_at(const lom_fluid_desc *d, double heat)
{
    double t = lom_fluid_melted(d, heat);
    t = t * t * (3 - 2 * t);
    if (d->viscosity == 0 || d->solid_viscosity == 0)
        return d->solid_viscosity + t * (d->viscosity - d->solid_viscosity);
    return lom_double_exp(lom_double_log(d->solid_viscosity) * (1 - t) + lom_double_log(d->viscosity) * t);
}

static void find_viscosities(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const double scale = f->desc.step / (f->cell * f->cell);
    for (size_t i = first; i < end; i++) {
        const size_t n = f->cell_of[i];
        double sum = 0;
        for (uint32_t p = f->first[n]; p < f->first[n + 1]; p++)
            sum += f->points[p].heat;
        f->strain->viscosity[n] = scale * viscosity_at(&f->desc, sum / (f->first[n + 1] - f->first[n]));
    }
}

/* An array of a capacity that several share. */
struct shared_array {
    void *array;
    size_t size; /* of an element */
};

static bool reserve(const struct shared_array *arrays, size_t array_count, size_t *capacity, size_t count,
                    lom_error *error)
{
    size_t reached = *capacity;
    for (size_t i = 0; i < array_count; i++) {
        reached = *capacity;
        if (!lom_renew(arrays[i].array, &reached, count + 1, arrays[i].size, error))
            return false;
    }
    *capacity = reached;
    return true;
}

static bool reserve_unknowns(struct lom_fluid_strain *s, size_t count, lom_error *error)
{
    const struct shared_array arrays[] = {
        { &s->x, sizeof *s->x },         { &s->residual, sizeof *s->residual },
        { &s->way, sizeof *s->way },     { &s->product, sizeof *s->product },
        { &s->face, sizeof *s->face },   { &s->diagonal, sizeof *s->diagonal },
        { &s->first, sizeof *s->first }, { &s->done, sizeof *s->done },
    };
    return reserve(arrays, sizeof arrays / sizeof *arrays, &s->capacity, count, error);
}

static bool reserve_samples(struct lom_fluid_strain *s, size_t count, lom_error *error)
{
    const struct shared_array arrays[] = { { &s->pull, sizeof *s->pull },
                                           { &s->touch, sizeof *s->touch },
                                           { &s->samples, sizeof *s->samples } };
    return reserve(arrays, sizeof arrays / sizeof *arrays, &s->sample_capacity, count, error);
}

/* ---- faces ---- */

/* Numbers from 0 in each slab the faces that are no walls and have liquid on a side. */
static void count_faces(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_strain *s = f->strain;
    for (size_t slab = first; slab < end; slab++) {
        size_t count = 0;
        for (size_t n = slab * f->stride[2]; n < (slab + 1) * f->stride[2]; n++)
            for (int axis = 0; axis < 3; axis++) {
                const bool is_there =
                    (f->open[n] >> axis & 1) != 0 && f->face[axis][n].mass > 0 &&
                    (f->kind[n] == LOM_FLUID_LIQUID || f->kind[n - f->stride[axis]] == LOM_FLUID_LIQUID);
                s->unknown[3 * n + (size_t)axis] = is_there ? (uint32_t)count++ : UINT32_MAX;
            }
        s->slabs[slab].faces = count;
    }
}

static void number_faces(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_strain *s = f->strain;
    for (size_t i = 3 * first * f->stride[2]; i < 3 * end * f->stride[2]; i++)
        if (s->unknown[i] != UINT32_MAX) {
            s->unknown[i] += (uint32_t)s->slabs[i / (3 * f->stride[2])].faces;
            s->face[s->unknown[i]] = i;
        }
}

/* Counts of slabs become sums of those before them, and that of all the last one's. */
static size_t sum_counts(struct lom_fluid *f, size_t *(*of)(struct lom_fluid_slab *slab))
{
    size_t sum = 0;
    for (int k = 0; k <= f->cells[2] + 1; k++) {
        size_t *at = of(&f->strain->slabs[k]), counted = *at;
        *at = sum;
        sum += counted;
    }
    return sum;
}

static size_t *faces_of(struct lom_fluid_slab *slab)
{
    return &slab->faces;
}

static size_t *samples_of(struct lom_fluid_slab *slab)
{
    return &slab->samples;
}

static bool find_faces(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain;
    const size_t slabs = (size_t)f->cells[2] + 1;
    memset(s->slabs, 0, (slabs + 1) * sizeof *s->slabs);
    lom_share_fluid(f, slabs, 1, count_faces, f);
    s->count = sum_counts(f, faces_of);
    if (!reserve_unknowns(s, s->count, error))
        return false;
    lom_share_fluid(f, slabs, 1, number_faces, f);
    return true;
}

/* ---- samples ---- */

/* Where samples of a slab go; NULL: they are counted. */
struct listing {
    const struct lom_fluid *f;
    struct lom_fluid_sample *out;
    size_t count;
};

static void add_sample(struct listing *list, const uint32_t number[4], double k)
{
    if (!(k > 0))
        return;
    if (list->out != NULL) {
        struct lom_fluid_sample *sample = &list->out[list->count];
        sample->k = k;
        for (int i = 0; i < 4; i++)
            sample->number[i] = number[i] == UINT32_MAX ? (uint32_t)list->f->strain->count : number[i];
    }
    list->count++;
}

static enum lom_fluid_kind kind_at(const struct lom_fluid *f, const int at[3], size_t n)
{
    for (int i = 0; i < 3; i++)
        if (at[i] < 0)
            return LOM_FLUID_SOLID;
    return (enum lom_fluid_kind)f->kind[n];
}

/* The edge at the corner of low a and b of a cell. */
static void add_edge(struct listing *list, const int cell[3], size_t n, int a, int b)
{
    const struct lom_fluid *f = list->f;
    const struct lom_fluid_strain *s = f->strain;
    double viscosity = 0;
    int liquid = 0, solid = 0, solid_at[2][2];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            int at[3] = { cell[0], cell[1], cell[2] };
            at[a] -= 1 - i;
            at[b] -= 1 - j;
            const size_t other = n - (i == 0 ? f->stride[a] : 0) - (j == 0 ? f->stride[b] : 0);
            const enum lom_fluid_kind kind = kind_at(f, at, other);
            solid_at[i][j] = kind == LOM_FLUID_SOLID;
            solid += solid_at[i][j];
            liquid += kind == LOM_FLUID_LIQUID;
            viscosity += kind == LOM_FLUID_LIQUID ? s->viscosity[other] : 0;
        }
    const bool wall = solid == 2 && solid_at[0][0] != solid_at[1][1];
    if (wall ? liquid == 0 || f->desc.slides[solid_at[0][0] == solid_at[0][1] ? a : b]
             : liquid < 2 || liquid + solid < 4)
        return;
    if (solid == 2 && !wall)
        return;
    /* Faces of a lie below and above the edge along b, those of b before and behind it along a. */
    const size_t below = n - f->stride[b], before = n - f->stride[a];
    uint32_t number[4] = { UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX };
    const bool has[4] = { cell[b] > 0, true, cell[a] > 0, true };
    const size_t at[4] = { 3 * below + (size_t)a, 3 * n + (size_t)a, 3 * before + (size_t)b, 3 * n + (size_t)b };
    for (int i = 0; i < 4; i++)
        if (has[i])
            number[i] = s->unknown[at[i]];
    /* Half of a wall's edge that air touches has nothing that rubs. */
    add_sample(list, number, wall ? viscosity : viscosity / liquid);
}

/* Those of a slab, in the order of its cells. */
static void add_samples(struct listing *list, int slab)
{
    const struct lom_fluid *f = list->f;
    const struct lom_fluid_strain *s = f->strain;
    int cell[3] = { 0, 0, slab };
    for (cell[1] = 0; cell[1] <= f->cells[1]; cell[1]++)
        for (cell[0] = 0; cell[0] <= f->cells[0]; cell[0]++) {
            const size_t n = (size_t)cell[0] + (size_t)cell[1] * f->stride[1] + (size_t)cell[2] * f->stride[2];
            for (int axis = 0; axis < 3; axis++) {
                if (f->kind[n] == LOM_FLUID_LIQUID) {
                    const uint32_t along[4] = { s->unknown[3 * n + (size_t)axis],
                                                s->unknown[3 * (n + f->stride[axis]) + (size_t)axis], UINT32_MAX,
                                                UINT32_MAX };
                    add_sample(list, along, 2 * s->viscosity[n]);
                }
                add_edge(list, cell, n, axis, (axis + 1) % 3);
            }
        }
}

static void count_samples(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (size_t slab = first; slab < end; slab++) {
        struct listing list = { .f = f };
        add_samples(&list, (int)slab);
        f->strain->slabs[slab].samples = list.count;
    }
}

static void list_samples(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_strain *s = f->strain;
    for (size_t slab = first; slab < end; slab++) {
        struct listing list = { .f = f, .out = s->samples + s->slabs[slab].samples };
        add_samples(&list, (int)slab);
    }
}

static bool find_samples(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain;
    const size_t slabs = (size_t)f->cells[2] + 1;
    lom_share_fluid(f, slabs, 1, count_samples, f);
    s->sample_count = sum_counts(f, samples_of);
    if (!reserve_samples(s, s->sample_count, error))
        return false;
    lom_share_fluid(f, slabs, 1, list_samples, f);
    return true;
}

/* ---- a step ---- */

static void take_velocities(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    struct lom_fluid_strain *s = f->strain;
    for (size_t i = first; i < end; i++)
        s->x[i] = f->face[s->face[i] % 3][s->face[i] / 3].velocity;
}

static void return_velocities(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    const struct lom_fluid_strain *s = f->strain;
    for (size_t i = first; i < end; i++)
        f->face[s->face[i] % 3][s->face[i] / 3].velocity = s->x[i];
}

bool lom_shear_fluid(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain;
    lom_share_fluid(f, f->wet, LOM_FLUID_PART, find_viscosities, f);
    if (!find_faces(f, error) || !find_samples(f, error))
        return false;
    lom_share_fluid(f, s->count, LOM_FLUID_PART, take_velocities, f);
    f->rounds[2] = lom_solve_strain(f);
    lom_share_fluid(f, s->count, LOM_FLUID_PART, return_velocities, f);
    return true;
}
