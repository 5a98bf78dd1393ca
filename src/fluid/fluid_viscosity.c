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
 * flowing, SCA 2002. The least is found by conjugate gradients with the diagonal as preconditioner. */
#include "fluid/fluid.h"

#include "base/numbers.h"
#include "base/reserve.h"

/* Differences of faces: number[1] - number[0] + number[3] - number[2]; unknown `count` is always 0. */
struct sample {
    uint32_t number[4];
    double k; /* times dt over the cell's side squared */
};

struct lom_fluid_strain {
    struct sample *samples;
    size_t sample_count, sample_capacity;
    size_t count, capacity; /* of unknowns: faces */
    size_t *face;           /* count each: 3 times the number, and the axis */
    double *x, *residual, *way, *product, *diagonal;
    uint32_t *unknown; /* of a face, 3 times the number, and the axis; UINT32_MAX: none */
    double *viscosity; /* of a cell, times dt over the side squared */
};

bool lom_open_strain(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain = lom_allocate(1, sizeof *s, error);
    if (s == NULL)
        return false;
    s->unknown = lom_allocate(3 * f->count, sizeof *s->unknown, error);
    s->viscosity = lom_allocate(f->count, sizeof *s->viscosity, error);
    return s->unknown != NULL && s->viscosity != NULL;
}

void lom_close_strain(struct lom_fluid *f)
{
    struct lom_fluid_strain *s = f->strain;
    if (s == NULL)
        return;
    void *const arrays[] = { s->samples, s->face,     s->x,       s->residual, s->way,
                             s->product, s->diagonal, s->unknown, s->viscosity };
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

static bool reserve_unknowns(struct lom_fluid_strain *s, size_t count, lom_error *error)
{
    double **const arrays[] = { &s->x, &s->residual, &s->way, &s->product, &s->diagonal };
    size_t capacity = s->capacity;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        size_t own = s->capacity;
        if (!lom_renew(arrays[i], &own, count + 1, sizeof **arrays[i], error))
            return false;
    }
    if (!lom_renew(&s->face, &capacity, count + 1, sizeof *s->face, error))
        return false;
    s->capacity = capacity;
    return true;
}

/* Faces that are no walls and have liquid on a side. */
static bool number_faces(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain;
    size_t count = 0;
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1 && !reserve_unknowns(s, count, error))
            return false;
        count = 0;
        for (size_t n = 0; n < f->count; n++)
            for (int axis = 0; axis < 3; axis++) {
                const size_t number = 3 * n + (size_t)axis;
                const bool is_there =
                    (f->open[n] >> axis & 1) != 0 && f->face[axis][n].mass > 0 &&
                    (f->kind[n] == LOM_FLUID_LIQUID || f->kind[n - f->stride[axis]] == LOM_FLUID_LIQUID);
                s->unknown[number] = is_there ? (uint32_t)count : UINT32_MAX;
                if (is_there && pass == 1)
                    s->face[count] = number;
                count += is_there;
            }
    }
    s->count = count;
    return true;
}

/* ---- samples ---- */

static bool add_sample(struct lom_fluid_strain *s, const uint32_t number[4], double k, lom_error *error)
{
    if (!(k > 0))
        return true;
    if (!lom_reserve(&s->samples, &s->sample_capacity, s->sample_count + 1, sizeof *s->samples, error))
        return false;
    struct sample *sample = &s->samples[s->sample_count++];
    sample->k = k;
    for (int i = 0; i < 4; i++) {
        sample->number[i] = number[i] == UINT32_MAX ? (uint32_t)s->count : number[i];
        if (number[i] != UINT32_MAX)
            s->diagonal[number[i]] += k;
    }
    return true;
}

static enum lom_fluid_kind kind_at(const struct lom_fluid *f, const int at[3], size_t n)
{
    for (int i = 0; i < 3; i++)
        if (at[i] < 0)
            return LOM_FLUID_SOLID;
    return (enum lom_fluid_kind)f->kind[n];
}

/* The edge at the corner of low a and b of a cell. */
static bool add_edge(struct lom_fluid *f, const int cell[3], size_t n, int a, int b, lom_error *error)
{
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
        return true;
    if (solid == 2 && !wall)
        return true;
    /* Faces of a lie below and above the edge along b, those of b before and behind it along a. */
    const size_t below = n - f->stride[b], before = n - f->stride[a];
    uint32_t number[4] = { UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX };
    const bool has[4] = { cell[b] > 0, true, cell[a] > 0, true };
    const size_t at[4] = { 3 * below + (size_t)a, 3 * n + (size_t)a, 3 * before + (size_t)b, 3 * n + (size_t)b };
    for (int i = 0; i < 4; i++)
        if (has[i])
            number[i] = s->unknown[at[i]];
    /* Half of a wall's edge that air touches has nothing that rubs. */
    return add_sample(f->strain, number, wall ? viscosity : viscosity / liquid, error);
}

static bool add_samples(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain;
    s->sample_count = 0;
    for (size_t i = 0; i < s->count; i++)
        s->diagonal[i] = 1;
    int cell[3];
    for (cell[2] = 0; cell[2] <= f->cells[2]; cell[2]++)
        for (cell[1] = 0; cell[1] <= f->cells[1]; cell[1]++)
            for (cell[0] = 0; cell[0] <= f->cells[0]; cell[0]++) {
                const size_t n = (size_t)cell[0] + (size_t)cell[1] * f->stride[1] + (size_t)cell[2] * f->stride[2];
                for (int axis = 0; axis < 3; axis++) {
                    if (f->kind[n] == LOM_FLUID_LIQUID) {
                        const uint32_t along[4] = { s->unknown[3 * n + (size_t)axis],
                                                    s->unknown[3 * (n + f->stride[axis]) + (size_t)axis], UINT32_MAX,
                                                    UINT32_MAX };
                        if (!add_sample(s, along, 2 * s->viscosity[n], error))
                            return false;
                    }
                    if (!add_edge(f, cell, n, axis, (axis + 1) % 3, error))
                        return false;
                }
            }
    return true;
}

/* ---- the solution ---- */

static void multiply(const struct lom_fluid_strain *s, double *x, double *out)
{
    x[s->count] = 0;
    for (size_t i = 0; i < s->count; i++)
        out[i] = x[i];
    for (size_t i = 0; i < s->sample_count; i++) {
        const struct sample *e = &s->samples[i];
        const uint32_t *n = e->number;
        const double pull = e->k * ((x[n[1]] - x[n[0]]) + (x[n[3]] - x[n[2]]));
        out[n[0]] -= pull;
        out[n[1]] += pull;
        out[n[2]] -= pull;
        out[n[3]] += pull;
    }
}

static int solve(struct lom_fluid_strain *s)
{
    enum { MOST = 1000 };
    const double tolerance = 1e-5;
    double error = 0, whole = 0;
    multiply(s, s->x, s->product);
    for (size_t i = 0; i < s->count; i++) {
        whole += s->x[i] * s->x[i] / s->diagonal[i];
        s->residual[i] = s->x[i] - s->product[i];
        s->way[i] = s->residual[i] / s->diagonal[i];
        error += s->residual[i] * s->way[i];
    }
    const double enough = tolerance * tolerance * whole;
    int round = 0;
    for (; round < MOST && error > enough && error > 1e-300; round++) {
        double steep = 0, next = 0;
        multiply(s, s->way, s->product);
        for (size_t i = 0; i < s->count; i++)
            steep += s->way[i] * s->product[i];
        const double along = error / steep;
        for (size_t i = 0; i < s->count; i++) {
            s->x[i] += along * s->way[i];
            s->residual[i] -= along * s->product[i];
            next += s->residual[i] * s->residual[i] / s->diagonal[i];
        }
        for (size_t i = 0; i < s->count; i++)
            s->way[i] = s->residual[i] / s->diagonal[i] + next / error * s->way[i];
        error = next;
    }
    return round;
}

bool lom_shear_fluid(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_strain *s = f->strain;
    lom_share_fluid(f, f->wet, LOM_FLUID_PIECE, find_viscosities, f);
    if (!number_faces(f, error) || !add_samples(f, error))
        return false;
    for (size_t i = 0; i < s->count; i++)
        s->x[i] = f->face[s->face[i] % 3][s->face[i] / 3].velocity;
    f->rounds[2] = solve(s);
    for (size_t i = 0; i < s->count; i++)
        f->face[s->face[i] % 3][s->face[i] / 3].velocity = s->x[i];
    return true;
}
