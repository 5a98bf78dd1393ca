/* Conjugate gradients with the diagonal as preconditioner (M. Hestenes, E. Stiefel: Methods of conjugate gradients for
 * solving linear systems, J. Res. NBS 49, 1952). Compiled for speed. In: a system and a first guess in x. Out: x.
 * Invariant: sums are taken piece by piece, and the pieces' in their order: by whom makes no difference. */
#include "fluid/fluid.h"

struct solving {
    const struct lom_fluid *f;
    const struct lom_fluid_system *s;
    double along; /* how far along the way; or how much of the way before stays in the new one */
};

/* Of both sums of pieces. */
static void add_pieces(const struct lom_fluid_system *s, double sum[2])
{
    sum[0] = sum[1] = 0;
    for (size_t piece = 0; piece * LOM_FLUID_PIECE < s->count; piece++)
        for (int i = 0; i < 2; i++)
            sum[i] += s->partial[2 * piece + (size_t)i];
}

static inline double row_times(const struct lom_fluid_system *s, size_t i, const double *x)
{
    const uint32_t *n = s->neighbour[i];
    if (s->share != NULL) {
        const double *k = s->share[i];
        return s->diagonal[i] * x[i] - (((k[0] * x[n[0]] + k[1] * x[n[1]]) + (k[2] * x[n[2]] + k[3] * x[n[3]])) +
                                        (k[4] * x[n[4]] + k[5] * x[n[5]]));
    }
    return s->diagonal[i] * x[i] - (((x[n[0]] + x[n[1]]) + (x[n[2]] + x[n[3]])) + (x[n[4]] + x[n[5]]));
}

/* The residual and the first way; sums: residual times its preconditioned self, right side times the same of it. */
static void begin(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_system *s = c->s;
    double sum[2] = { 0, 0 };
    for (size_t i = first; i < end; i++) {
        const double d = s->diagonal[i];
        if (!(d > 0)) { /* no way out of the cell: any potential is right */
            s->x[i] = s->residual[i] = s->way[i] = 0;
            continue;
        }
        s->residual[i] = s->right[i] - row_times(s, i, s->x);
        s->way[i] = s->residual[i] / d;
        sum[0] += s->residual[i] * s->way[i];
        sum[1] += s->right[i] * s->right[i] / d;
    }
    s->partial[2 * (first / LOM_FLUID_PIECE)] = sum[0];
    s->partial[2 * (first / LOM_FLUID_PIECE) + 1] = sum[1];
}

static void multiply(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_system *s = c->s;
    double sum = 0;
    for (size_t i = first; i < end; i++) {
        s->product[i] = row_times(s, i, s->way);
        sum += s->way[i] * s->product[i];
    }
    s->partial[2 * (first / LOM_FLUID_PIECE)] = sum;
    s->partial[2 * (first / LOM_FLUID_PIECE) + 1] = 0;
}

static void advance(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_system *s = c->s;
    double sum = 0;
    for (size_t i = first; i < end; i++) {
        s->x[i] += c->along * s->way[i];
        s->residual[i] -= c->along * s->product[i];
        sum += s->diagonal[i] > 0 ? s->residual[i] * s->residual[i] / s->diagonal[i] : 0;
    }
    s->partial[2 * (first / LOM_FLUID_PIECE)] = sum;
    s->partial[2 * (first / LOM_FLUID_PIECE) + 1] = 0;
}

static void turn(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_system *s = c->s;
    for (size_t i = first; i < end; i++)
        s->way[i] = (s->diagonal[i] > 0 ? s->residual[i] / s->diagonal[i] : 0) + c->along * s->way[i];
}

int lom_solve_fluid(const struct lom_fluid *f, double tolerance, int most)
{
    const struct lom_fluid_system *s = &f->system;
    struct solving c = { .f = f, .s = s };
    double sum[2];
    if (s->count == 0)
        return 0;
    s->x[s->count] = s->way[s->count] = 0;
    lom_share_fluid(f, s->count, LOM_FLUID_PIECE, begin, &c);
    add_pieces(s, sum);
    const double enough = tolerance * tolerance * sum[1];
    double error = sum[0];
    int round = 0;
    for (; round < most && error > enough && error > 1e-300; round++) {
        lom_share_fluid(f, s->count, LOM_FLUID_PIECE, multiply, &c);
        add_pieces(s, sum);
        if (!(sum[0] > 0))
            break;
        c.along = error / sum[0];
        lom_share_fluid(f, s->count, LOM_FLUID_PIECE, advance, &c);
        add_pieces(s, sum);
        c.along = sum[0] / error;
        error = sum[0];
        lom_share_fluid(f, s->count, LOM_FLUID_PIECE, turn, &c);
    }
    return round;
}
