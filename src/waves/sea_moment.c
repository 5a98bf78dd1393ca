/* The sea in double, point by point. In: a sea and a time; out: the direct sum of its waves at any point. Invariant:
 * shares the amplitudes' definition with the sea's steps, and neither their tables nor a transform. */
#include "base/numbers.h"
#include "waves/sea_state.h"

struct wave {
    int n, m;
    double re, im; /* twice H(k, t): the waves k and -k together are the real part of its turn */
};

struct part {
    int size;
    double length;
    struct wave *waves;
    size_t count;
};

struct lom_sea_moment {
    int part_count;
    double choppiness;
    struct part part[LOM_MAX_CASCADES];
};

/* Half of the plane, n > 0 or n = 0 and m > 0. */
static void freeze_waves(const lom_sea *sea, int cascade, double time, struct part *part)
{
    double step = lom_two_pi / part->length;
    for (int n = 0; n < part->size / 2; n++)
        for (int m = n == 0 ? 1 : 1 - part->size / 2; m < part->size / 2; m++) {
            double there[2], back[2];
            lom_wave_amplitude(sea, cascade, n, m, there);
            lom_wave_amplitude(sea, cascade, -n, -m, back);
            if (there[0] == 0 && there[1] == 0 && back[0] == 0 && back[1] == 0)
                continue;
            double k = step * lom_double_sqrt((double)n * n + (double)m * m);
            double turns = lom_dispersion(k, sea->spectrum.depth, sea->spectrum.gravity) / lom_two_pi * time;
            double angle = lom_two_pi * (turns - lom_double_floor(turns));
            double c = lom_double_cos(angle), s = lom_double_sin(angle);
            part->waves[part->count++] = (struct wave){ n, m, 2 * ((there[0] + back[0]) * c + (there[1] + back[1]) * s),
                                                        2 * ((there[1] - back[1]) * c + (back[0] - there[0]) * s) };
        }
}

lom_sea_moment *lom_freeze_sea(const lom_sea *sea, double time, lom_error *error)
{
    if (!(time >= -1e9 && time <= 1e9)) {
        lom_fail(error, LOM_ERROR_USAGE, "The sea's time is not within -1e9..1e9 seconds.");
        return NULL;
    }
    lom_sea_moment *moment = lom_allocate(1, sizeof *moment, error);
    if (moment == NULL)
        return NULL;
    moment->part_count = sea->desc.cascade_count;
    moment->choppiness = sea->desc.choppiness;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool made = true;
    for (int i = 0; made && i < moment->part_count; i++) {
        struct part *part = &moment->part[i];
        *part = (struct part){ .size = sea->desc.cascade[i].size, .length = sea->desc.cascade[i].length };
        part->waves = lom_allocate((size_t)sea->cascade[i].view.waves, sizeof *part->waves, error);
        made = part->waves != NULL;
        if (made)
            freeze_waves(sea, i, time, part);
    }
    lom_leave_float_state(&state);
    if (made)
        return moment;
    lom_free_sea_moment(moment);
    return NULL;
}

void lom_free_sea_moment(lom_sea_moment *moment)
{
    for (int i = 0; moment != NULL && i < moment->part_count; i++)
        lom_release(moment->part[i].waves);
    lom_release(moment);
}

enum { MOST = 2048 };

/* cos and sin of i x / L turns: x is brought into the patch first, so that a far point loses nothing but x's own bits.
 */
static void fill_turns(double turns[][2], int count, double x, double length)
{
    double part = x / length;
    part -= lom_double_floor(part);
    for (int i = 0; i < count; i++) {
        double turn = part * i;
        turn = lom_two_pi * (turn - lom_double_floor(turn));
        turns[i][0] = lom_double_cos(turn);
        turns[i][1] = lom_double_sin(turn);
    }
}

static void add_part(const struct part *part, double x, double z, double choppiness, lom_sea_point *p)
{
    double along[MOST / 2][2], across[MOST / 2][2], step = lom_two_pi / part->length;
    fill_turns(along, part->size / 2, x, part->length);
    fill_turns(across, part->size / 2, z, part->length);
    for (size_t i = 0; i < part->count; i++) {
        const struct wave *w = &part->waves[i];
        const double *a = along[w->n], *b = across[w->m < 0 ? -w->m : w->m];
        double bs = w->m < 0 ? -b[1] : b[1];
        double c = a[0] * b[0] - a[1] * bs, s = a[0] * bs + a[1] * b[0];
        double real = w->re * c - w->im * s, turned = -(w->re * s + w->im * c); /* of H e, and of i H e */
        double kx = step * w->n, kz = step * w->m, chop = choppiness / lom_double_sqrt(kx * kx + kz * kz);
        p->h += real;
        p->sx += kx * turned;
        p->sz += kz * turned;
        p->dx += kx * chop * turned;
        p->dz += kz * chop * turned;
        p->xx -= kx * kx * chop * real;
        p->xz -= kx * kz * chop * real;
        p->zz -= kz * kz * chop * real;
    }
}

lom_sea_point lom_evaluate_sea(const lom_sea_moment *moment, int cascade, double x, double z)
{
    lom_sea_point p = { 0 };
    for (int i = 0; i < moment->part_count; i++)
        if (cascade == -1 || cascade == i)
            add_part(&moment->part[i], x, z, moment->choppiness, &p);
    p.jacobian = (1 + p.xx) * (1 + p.zz) - p.xz * p.xz;
    return p;
}
