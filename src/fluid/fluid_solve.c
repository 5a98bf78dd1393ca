/* Conjugate gradients with the diagonal as preconditioner (M. Hestenes, E. Stiefel: Methods of conjugate gradients for
 * solving linear systems, J. Res. NBS 49, 1952). Compiled for speed. In: a system and a first guess in x. Out: x.
 * Invariant: sums are taken piece by piece, and the pieces' in their order: by whom makes no difference. */
#include "fluid/fluid.h"

/* ---- sums ---- */

/* The sum as far as it is taken: by one at a time. */
struct summing {
    const struct lom_fluid_sum *sum;
    atomic_size_t part; /* the next to be made: in their order, so that those to be added are there soon */
    atomic_flag is_taken;
    size_t next; /* term */
    double chain, whole;
};

static bool is_ready(const struct summing *s)
{
    const struct lom_fluid_sum *sum = s->sum;
    return s->next < sum->count && atomic_load(&sum->done[s->next / LOM_FLUID_PART]) != 0;
}

/* Whoever finds the sum taken has set a flag before, which the other one looks at once more when it has let go. */
static void take_parts(struct summing *s)
{
    const struct lom_fluid_sum *sum = s->sum;
    for (bool more = true; more && !atomic_flag_test_and_set(&s->is_taken);) {
        while (is_ready(s)) {
            const size_t end = s->next + LOM_FLUID_PART < sum->count ? s->next + LOM_FLUID_PART : sum->count;
            s->chain = sum->add(sum->context, s->next, end, s->chain);
            s->next = end;
            if (end % sum->chain == 0 || end == sum->count) {
                s->whole += s->chain;
                s->chain = 0;
            }
        }
        const size_t next = s->next;
        atomic_flag_clear(&s->is_taken);
        more = next < sum->count && atomic_load(&sum->done[next / LOM_FLUID_PART]) != 0;
    }
}

enum { MAKERS = 16 };

/* One of those who make parts, until there are no more. */
static void make_parts(void *context, size_t first, size_t end)
{
    struct summing *s = context;
    const struct lom_fluid_sum *sum = s->sum;
    (void)first;
    (void)end;
    for (;;) {
        const size_t part = atomic_fetch_add_explicit(&s->part, 1, memory_order_relaxed), at = part * LOM_FLUID_PART;
        if (at >= sum->count)
            return;
        sum->work(sum->context, at, sum->count - at < LOM_FLUID_PART ? sum->count : at + LOM_FLUID_PART);
        atomic_store(&sum->done[part], 1);
        take_parts(s);
    }
}

double lom_sum_fluid(const struct lom_fluid *f, const struct lom_fluid_sum *sum)
{
    struct summing s = { .sum = sum, .is_taken = ATOMIC_FLAG_INIT };
    const size_t parts = (sum->count + LOM_FLUID_PART - 1) / LOM_FLUID_PART;
    for (size_t i = 0; i < parts; i++)
        atomic_store_explicit(&sum->done[i], 0, memory_order_relaxed);
    lom_share_fluid(f, parts < MAKERS ? parts : MAKERS, 1, make_parts, &s);
    return s.whole;
}

/* ---- the solution ---- */

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
    for (size_t i = first; i < end; i++)
        s->product[i] = row_times(s, i, s->way);
}

static double add_steepness(const void *context, size_t first, size_t end, double sum)
{
    const struct solving *c = context;
    const struct lom_fluid_system *s = c->s;
    for (size_t i = first; i < end; i++)
        sum += s->way[i] * s->product[i];
    return sum;
}

/* The products become the errors that are left. */
static void advance(void *context, size_t first, size_t end)
{
    const struct solving *c = context;
    const struct lom_fluid_system *s = c->s;
    for (size_t i = first; i < end; i++) {
        s->x[i] += c->along * s->way[i];
        s->residual[i] -= c->along * s->product[i];
        s->product[i] = s->diagonal[i] > 0 ? s->residual[i] * s->residual[i] / s->diagonal[i] : 0;
    }
}

static double add_errors(const void *context, size_t first, size_t end, double sum)
{
    const struct solving *c = context;
    for (size_t i = first; i < end; i++)
        sum += c->s->product[i];
    return sum;
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
    const struct lom_fluid_sum steepness = { multiply, add_steepness, &c, s->count, LOM_FLUID_PIECE, s->done };
    const struct lom_fluid_sum errors = { advance, add_errors, &c, s->count, LOM_FLUID_PIECE, s->done };
    int round = 0;
    for (; round < most && error > enough && error > 1e-300; round++) {
        const double steep = lom_sum_fluid(f, &steepness);
        if (!(steep > 0))
            break;
        c.along = error / steep;
        const double next = lom_sum_fluid(f, &errors);
        c.along = next / error;
        error = next;
        lom_share_fluid(f, s->count, LOM_FLUID_PART, turn, &c);
    }
    return round;
}
