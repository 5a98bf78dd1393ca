/* Where waves begin to break, carried along their rays, and how they plunge there. In: phases, fluxes and the cells
 * that break. Out: the curls of the map. Invariant: from the line where a wave reaches 0.78 of the depth, found
 * between cells, the phase there is that of all places before and behind it on the same ray; where rays of different
 * lines come together no wave plunges, so that what is drawn has no step.
 *
 * Waves plunge where the surf similarity, the Iribarren number tan b / sqrt(H0 / L0) of the bed's slope there and of
 * the wave in deep water, is between 0.5 and 3.3 (Battjes 1974). */
#include "base/numbers.h"
#include "waves/surf_work.h"

static const double gravity = 9.80665;
static const double steepest_step = 4;  /* of a phase since breaking from cell to cell, in wave numbers */
static const double longest_lead = 1.5; /* radians */
static const double earliest = -5.5;    /* radians: no front has begun to steepen half a wave ahead of there */

enum { NOWHERE, ON_THE_WAY, AHEAD }; /* of a cell's onset: none; on the ray to it; on the ray from it */
enum { VALUES = 3, MOST_SPREAD = 8 };
struct lom_surf_onset {
    double value[VALUES]; /* phase where the wave begins to break, Iribarren number there, lead */
    int known;
};

/* Of the depth smoothed, over two cells to each side, along the wave's way. */
static double bed_slope(const struct surf *s, int x, int y)
{
    const int at[2] = { x, y }, last[2] = { s->width - 1, s->height - 1 }, step[2] = { 1, s->width };
    const int i = y * s->width + x;
    double slope = 0;
    for (int a = 0; a < 2; a++) {
        const int before = at[a] < 2 ? at[a] : 2, after = last[a] - at[a] < 2 ? last[a] - at[a] : 2;
        const double fall = s->depth[i - before * step[a]] - s->depth[i + after * step[a]];
        slope += s->normal[i][a] * fall / ((before + after) * s->desc->spacing[a]);
    }
    return lom_larger(slope, 0.002);
}

/* A wave that begins to break in this cell: height over depth crosses the ratio between the cells before and this one,
 * where it is taken to be linear. */
static void begin_breaking(struct surf *s, int x, int y, const struct lom_surf_inflow *f)
{
    const int i = y * s->width + x;
    const double depth = lom_larger(s->depth[i], s->shallowest), ratio = lom_breaking_ratio;
    const double here = lom_double_sqrt(f->in / f->out / s->speed[i]) / (ratio * depth);
    double there = 0, phase = 0;
    for (int a = 0; a < 2; a++) {
        const int n = f->neighbour[a];
        const double share = f->part[a] / f->out;
        if (share > 0) {
            there +=
                share * lom_double_sqrt(s->flux[n] / s->speed[n]) / (ratio * lom_larger(s->depth[n], s->shallowest));
            phase += share * s->phase[n];
        }
    }
    double part = here - there > 1e-9 ? (1 - there) / (here - there) : 1;
    part = part < 0 ? 0 : part > 1 ? 1 : part;
    const double slope = bed_slope(s, x, y), period = s->desc->surf.period;
    const double deep_speed = gravity * period / (2 * lom_two_pi), length = gravity * period * period / lom_two_pi;
    const double deep_height = lom_double_sqrt(f->in / f->out / deep_speed);
    s->onset[i] =
        (struct lom_surf_onset){ { phase + part * (s->phase[i] - phase), slope / lom_double_sqrt(deep_height / length),
                                   lom_smaller(s->number[i] * depth / slope, longest_lead) },
                                 ON_THE_WAY };
}

static void mix_onsets(struct surf *s, int i, const int *neighbour, const double *share, int count, int known)
{
    struct lom_surf_onset mean = { .known = NOWHERE };
    double whole = 0;
    for (int n = 0; n < count; n++) {
        if (!(share[n] > 0) || s->onset[neighbour[n]].known == NOWHERE)
            continue;
        whole += share[n];
        for (int v = 0; v < VALUES; v++)
            mean.value[v] += share[n] * s->onset[neighbour[n]].value[v];
    }
    for (int v = 0; v < VALUES && whole > 0; v++)
        mean.value[v] /= whole;
    mean.known = whole > 0 ? known : NOWHERE;
    s->onset[i] = mean;
}

static bool are_same(const struct lom_surf_onset *a, const struct lom_surf_onset *b)
{
    bool same = a->known == b->known;
    for (int v = 0; same && v < VALUES; v++)
        same = a->value[v] == b->value[v];
    return same;
}

/* On from where waves begin to break, the way they go. */
static bool solve_after(struct surf *s, int x, int y)
{
    const int i = y * s->width + x;
    const struct lom_surf_onset before = s->onset[i];
    const struct lom_surf_inflow f = lom_surf_inflow_of(s, i);
    const int most = f.neighbour[f.part[1] > f.part[0] ? 1 : 0];
    if (s->breaks[i] && !f.breaks && f.out > 0 && f.in > 0)
        begin_breaking(s, x, y, &f);
    else if (s->onset[most].known == ON_THE_WAY) /* what breaks beside a ray does not break on it */
        mix_onsets(s, i, f.neighbour, f.part, 2, ON_THE_WAY);
    return !are_same(&before, &s->onset[i]);
}

/* And back from there: from the neighbours to which a wave goes. */
static bool solve_before(struct surf *s, int x, int y)
{
    const struct lom_surf_onset before = s->onset[y * s->width + x];
    const int i = y * s->width + x, at[2] = { x, y }, last[2] = { s->width - 1, s->height - 1 };
    const int step[2] = { 1, s->width };
    int neighbour[4], count = 0;
    double share[4];
    if (s->onset[i].known == ON_THE_WAY)
        return false;
    for (int a = 0; a < 2; a++)
        for (int side = -1; side <= 1; side += 2) {
            if (at[a] + side < 0 || at[a] + side > last[a])
                continue;
            neighbour[count] = i + side * step[a];
            const bool goes_there = s->from[neighbour[count]][a] == -side;
            share[count] = goes_there ? lom_magnitude(s->normal[neighbour[count]][a]) / s->desc->spacing[a] : 0;
            count++;
        }
    mix_onsets(s, i, neighbour, share, count, AHEAD);
    return !are_same(&before, &s->onset[i]);
}

/* ---- how much they plunge ---- */

static double smooth_step(double t)
{
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

/* Half at 0.5 and at 3.3. */
static double share_of_slope(double iribarren)
{
    return smooth_step((iribarren - 0.35) / 0.3) * (1 - smooth_step((iribarren - 2.8) / 1.0));
}

/* The length of waves that break, on the mean; 0: none does. */
static double find_length(const struct surf *s)
{
    double number = 0, count = 0;
    for (int i = 0; i < s->width * s->height; i++)
        if (s->breaks[i]) {
            number += s->number[i];
            count++;
        }
    return count > 0 ? lom_two_pi * count / number : 0;
}

/* The mean about each place of what is known there, `times` over; `known` becomes how much of it there is. */
static void spread_values(const struct surf *s, double *value[VALUES], double *known, double *scratch, int times)
{
    const int count = s->width * s->height;
    for (int i = 0; i < count; i++) {
        known[i] = s->onset[i].known != NOWHERE && s->flux[i] > 0 ? 1 : 0;
        for (int v = 0; v < VALUES; v++)
            value[v][i] = known[i] * s->onset[i].value[v];
    }
    for (int n = 0; n < times; n++) {
        lom_smooth_surf(s, known, scratch);
        for (int v = 0; v < VALUES; v++)
            lom_smooth_surf(s, value[v], scratch);
    }
    for (int i = 0; i < count; i++)
        for (int v = 0; v < VALUES; v++)
            value[v][i] = known[i] > 1e-6 ? value[v][i] / known[i] : 0;
}

/* Whether a place and the one before it along an axis are of one line, and enough of it is known. */
static bool is_whole(const struct surf *s, const double *onset, const double *known, int i, int a)
{
    const int j = i - (a == 0 ? 1 : s->width);
    const double change = (s->phase[i] - onset[i]) - (s->phase[j] - onset[j]);
    return known[i] > 0.5 && known[j] > 0.5 &&
           lom_magnitude(change) < steepest_step * s->desc->spacing[a] * (s->number[i] + s->number[j]) / 2;
}

static void find_strengths(const struct surf *s, double *value[VALUES], const double *known, double *strength,
                           double *scratch, int times)
{
    for (int i = 0; i < s->width * s->height; i++) {
        bool whole = known[i] > 0.5;
        whole = whole && (i % s->width == 0 || is_whole(s, value[0], known, i, 0));
        whole = whole && (i < s->width || is_whole(s, value[0], known, i, 1));
        strength[i] = whole ? s->desc->surf.plunging : 0;
        if (s->desc->surf.breaking == LOM_SURF_AUTO)
            strength[i] *= share_of_slope(value[1][i]);
    }
    for (int n = 0; n < times; n++)
        lom_smooth_surf(s, strength, scratch);
}

/* The angles of the crest and of the trough ahead of eta (wave_lanes.wide.c, find_surf), where its derivative is 0:
 * with q = r sin f / (1 + s), cos t (1 - q r sin f) - sin t q r cos f = r cos f. */
static void set_crest(struct lom_surf_curl_cell *curl, double skew, double lean)
{
    const double root = lom_double_sqrt(1 - skew * skew - lean * lean), q = lean / (1 + root);
    const double a = 1 - q * lean, b = q * skew, length = lom_double_sqrt(a * a + b * b);
    const double middle = -lom_double_atan2(b, a);
    const double half = lom_double_atan2(lom_double_sqrt(lom_larger(length * length - skew * skew, 1e-6)), skew);
    double height[2];
    for (int i = 0; i < 2; i++) {
        const double t = middle + (i == 0 ? half : -half), sine = lom_double_sin(t), cosine = lom_double_cos(t);
        height[i] = root * (sine + q) / (1 - skew * cosine + lean * sine);
    }
    curl->crest = (float)(middle + half);
    curl->span = (float)(2 * half);
    curl->top = (float)height[0];
    curl->drop = (float)(height[0] - height[1]);
}

/* Lines on which waves begin to break are ragged where the bed is: they are smoothed over a tenth of the length of the
 * waves there, which is how far a curl reaches along a crest. A smoothing spreads by a cell. */
static void fill_curls(struct surf *s, struct lom_surf_map *map, double *work)
{
    const size_t count = (size_t)s->width * (size_t)s->height;
    double *known = work, *strength = work + count, *scratch = work + 2 * count;
    double *value[VALUES] = { work + 3 * count, work + 4 * count, work + 5 * count };
    const double spread = 0.2 * find_length(s) / (s->desc->spacing[0] + s->desc->spacing[1]);
    const int times = spread < 1 ? 1 : spread > MOST_SPREAD ? MOST_SPREAD * MOST_SPREAD : lom_int_of(spread * spread);
    spread_values(s, value, known, scratch, times);
    find_strengths(s, value, known, strength, scratch, times);
    for (size_t i = 0; i < count; i++) {
        const double since = s->phase[i] - value[0][i], slope = value[1][i];
        map->curls[i] = (struct lom_surf_curl_cell){ .since = (float)since,
                                                     .strength = (float)strength[i],
                                                     .lead = (float)value[2][i] };
        if (strength[i] > 0.01 && lom_magnitude(since) < 1) {
            map->plunging_slope[0] = map->plunging_slope[1] > 0 ? lom_smaller(map->plunging_slope[0], slope) : slope;
            map->plunging_slope[1] = lom_larger(map->plunging_slope[1], slope);
        }
    }
}

bool lom_fill_surf_curls(struct surf *s, struct lom_surf_map *map, lom_error *error)
{
    const size_t count = (size_t)s->width * (size_t)s->height;
    double *work = lom_allocate(count, (3 + VALUES) * sizeof *work, error);
    s->onset = lom_allocate(count, sizeof *s->onset, error);
    map->curls = lom_allocate(count, sizeof *map->curls, error);
    const bool done = work != NULL && s->onset != NULL && map->curls != NULL;
    if (done) {
        lom_sweep_surf(s, solve_after);
        lom_sweep_surf(s, solve_before);
        fill_curls(s, map, work);
    }
    lom_release(s->onset);
    s->onset = NULL;
    lom_release(work);
    return done;
}

void lom_shape_surf_curls(struct lom_surf_map *map, double frequency)
{
    const size_t count = (size_t)map->width * (size_t)map->height;
    for (size_t i = 0; i < count; i++) {
        const struct lom_surf_cell *cell = &map->cells[i];
        struct lom_surf_curl_cell *curl = &map->curls[i];
        set_crest(curl, (double)cell->skew, (double)cell->lean);
        if (!(curl->strength > 0) || (double)curl->since < earliest)
            continue;
        const double kx = (double)cell->kx, kz = (double)cell->kz, number = lom_double_sqrt(kx * kx + kz * kz);
        const double flight = lom_double_sqrt(2 * (double)(cell->amplitude * curl->drop) / gravity);
        map->farthest = lom_larger(map->farthest, (double)curl->span / number + frequency / number * flight);
    }
}
