/* The solution of viscosity. Compiled for speed. In: samples of strain between faces, velocities. Out: those a step later.
 * Invariant: what samples pull at a face is added up in their order, and sums over all faces in theirs: by whom makes no
 * difference. */
#include "fluid/fluid_strain.h"

/* ---- which samples an unknown is in ---- */

/* Calls for each sample that a face of the slab may be in, in their order: those of the cells there, before and behind. */
static void visit_samples(struct lom_fluid *f, size_t slab, bool lists)
{
    struct lom_fluid_strain *s = f->strain;
    const struct lom_fluid_slab *slabs = s->slabs;
    const size_t last = (size_t)f->cells[2];
    const uint32_t low = (uint32_t)slabs[slab].faces, high = (uint32_t)slabs[slab + 1].faces;
    uint32_t *touch = s->touch[0];
    for (size_t e = slabs[slab > 0 ? slab - 1 : 0].samples; e < slabs[slab < last ? slab + 2 : last + 1].samples; e++)
        for (uint32_t i = 0; i < 4; i++) {
            const uint32_t u = s->samples[e].number[i];
            if (u < low || u >= high)
                continue;
            if (lists)
                touch[s->first[u + 1]] = (uint32_t)e * 4 + i;
            s->first[u + 1]++;
        }
}

static void count_touches(void *context, size_t first, size_t end)
{
    for (size_t slab = first; slab < end; slab++)
        visit_samples(context, slab, false);
}

/* first[u + 1] is where the next of u goes, so that it ends where that of u + 1 begins. */
static void list_touches(void *context, size_t first, size_t end)
{
    for (size_t slab = first; slab < end; slab++)
        visit_samples(context, slab, true);
}

static void clear_touches(void *context, size_t first, size_t end)
{
    struct lom_fluid_strain *s = ((struct lom_fluid *)context)->strain;
    for (size_t i = first; i < end; i++)
        s->first[i] = 0;
}

static void find_touches(struct lom_fluid *f)
{
    struct lom_fluid_strain *s = f->strain;
    const size_t slabs = (size_t)f->cells[2] + 1;
    lom_share_fluid(f, s->count + 1, LOM_FLUID_PIECE, clear_touches, f);
    lom_share_fluid(f, slabs, 1, count_touches, f);
    uint32_t sum = 0;
    for (size_t i = 1; i <= s->count; i++) {
        const uint32_t counted = s->first[i];
        s->first[i] = sum;
        sum += counted;
    }
    lom_share_fluid(f, slabs, 1, list_touches, f);
}

static void find_diagonal(void *context, size_t first, size_t end)
{
    struct lom_fluid_strain *s = ((struct lom_fluid *)context)->strain;
    const uint32_t *touch = s->touch[0];
    for (size_t i = first; i < end; i++) {
        double sum = 1;
        for (uint32_t t = s->first[i]; t < s->first[i + 1]; t++)
            sum += s->samples[touch[t] / 4].k;
        s->diagonal[i] = sum;
    }
}

/* ---- conjugate gradients ---- */

struct solving {
    struct lom_fluid_strain *s;
    double *from;
    double along; /* how far along the way; or how much of the way before stays in the new one */
};

static void find_pulls(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const double *x = c->from;
    for (size_t i = first; i < end; i++) {
        const struct lom_fluid_sample *e = &c->s->samples[i];
        const uint32_t *n = e->number;
        c->s->pull[i] = e->k * ((x[n[1]] - x[n[0]]) + (x[n[3]] - x[n[2]]));
    }
}

/* A sample pulls at its faces 1 and 3, and pushes 0 and 2. */
static void pull_faces(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_strain *s = c->s;
    const uint32_t *touch = s->touch[0];
    for (size_t i = first; i < end; i++) {
        double out = c->from[i];
        for (uint32_t t = s->first[i]; t < s->first[i + 1]; t++) {
            const double pull = s->pull[touch[t] / 4];
            out = touch[t] & 1 ? out + pull : out - pull;
        }
        s->product[i] = out;
    }
}

static double add_steepness(const void *context, size_t first, size_t end, double sum)
{
    const struct lom_fluid_strain *s = ((const struct solving *)context)->s;
    for (size_t i = first; i < end; i++)
        sum += s->way[i] * s->product[i];
    return sum;
}

/* The products become the errors that are left. */
static void advance(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_strain *s = c->s;
    for (size_t i = first; i < end; i++) {
        s->x[i] += c->along * s->way[i];
        s->residual[i] -= c->along * s->product[i];
        s->product[i] = s->residual[i] * s->residual[i] / s->diagonal[i];
    }
}

static double add_errors(const void *context, size_t first, size_t end, double sum)
{
    const struct lom_fluid_strain *s = ((const struct solving *)context)->s;
    for (size_t i = first; i < end; i++)
        sum += s->product[i];
    return sum;
}

static void turn(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_strain *s = c->s;
    for (size_t i = first; i < end; i++)
        s->way[i] = s->residual[i] / s->diagonal[i] + c->along * s->way[i];
}

/* From x: what is left of it and the first way, as one worker sums both. */
static double begin(struct lom_fluid_strain *s, double *whole)
{
    double error = 0;
    *whole = 0;
    for (size_t i = 0; i < s->count; i++) {
        *whole += s->x[i] * s->x[i] / s->diagonal[i];
        s->residual[i] = s->x[i] - s->product[i];
        s->way[i] = s->residual[i] / s->diagonal[i];
        error += s->residual[i] * s->way[i];
    }
    return error;
}

int lom_solve_strain(struct lom_fluid *f)
{
    enum { MOST = 1000 };
    const double tolerance = 1e-5;
    struct lom_fluid_strain *s = f->strain;
    struct solving c = { .s = s, .from = s->x };
    const size_t chain = (s->count / LOM_FLUID_PART + 1) * LOM_FLUID_PART;
    const struct lom_fluid_sum steepness = { pull_faces, add_steepness, &c, s->count, chain, s->done };
    const struct lom_fluid_sum errors = { advance, add_errors, &c, s->count, chain, s->done };
    find_touches(f);
    lom_share_fluid(f, s->count, LOM_FLUID_PART, find_diagonal, f);
    s->x[s->count] = s->way[s->count] = 0;
    lom_share_fluid(f, s->sample_count, LOM_FLUID_PART, find_pulls, &c);
    lom_share_fluid(f, s->count, LOM_FLUID_PART, pull_faces, &c);
    double whole, error = begin(s, &whole);
    const double enough = tolerance * tolerance * whole;
    int round = 0;
    c.from = s->way;
    for (; round < MOST && error > enough && error > 1e-300; round++) {
        lom_share_fluid(f, s->sample_count, LOM_FLUID_PART, find_pulls, &c);
        c.along = error / lom_sum_fluid(f, &steepness);
        const double next = lom_sum_fluid(f, &errors);
        c.along = next / error;
        lom_share_fluid(f, s->count, LOM_FLUID_PART, turn, &c);
        error = next;
    }
    return round;
}
