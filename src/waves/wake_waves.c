/* Wakes: foam that bodies leave on the water they move through. In: a site, whose entities' ways are functions of the time.
 * Out: where the bow of each was at moments before, and how much of what it made there is left.
 *
 * Foam is made by Froude's number of the speed over the body's length, all of it from 0.3 on, where a hull begins to climb
 * its own bow wave, and fades by 1/e in `window`. The wake of what drives itself, which takes no momentum from the water,
 * spreads with the fourth root of the way (H. Tennekes, J. Lumley, A First Course in Turbulence, 1972, 4.3): wake_lanes.h.
 *
 * Invariant: moments are whole multiples of a step and the time itself, so any frame alone is that of a run, and foam
 * stays where it was made. */
#include "base/numbers.h"
#include "waves/wave_field.h"

#include <stdio.h>

enum { STEPS = LOM_WAKE_RUNS * LOM_WAKE_STEPS };
static const double windows = 4;   /* that a wake is followed for: e^-4 is left then, and taken off everywhere */
static const double full = 0.3;    /* Froude's number */
static const double beside = 1.25; /* the foam at a hull's sides, in parts of the hull's width */
static const double gravity = 9.80665;

struct state {
    const struct lom_wave_site *site;
    struct lom_wake_track *tracks;
    size_t count;
};

static bool exists(const struct lom_wave_source *source)
{
    return source->site->wake_count > 0 && source->site->foam->amount > 0;
}

static bool load(void *memory, const struct lom_wave_source *source, lom_error *error)
{
    struct state *state = memory;
    state->site = source->site;
    state->count = source->site->wake_count;
    state->tracks = lom_allocate(state->count, sizeof *state->tracks, error);
    return state->tracks != NULL;
}

static void unload(void *memory)
{
    lom_release(((struct state *)memory)->tracks);
}

static void bound(const void *memory, struct lom_waves_uniform *out, double time)
{
    (void)memory;
    (void)time;
    out->wakes.count = 0;
}

/* A moment of a body's way: where its bow was, metres from the water's origin. */
struct moment {
    double time, bow[2], way;
};

static void find_bow(const struct lom_wave_site *site, const lom_water_wake *wake, const double origin[3],
                     struct moment *at)
{
    double ahead;
    site->follow(site->scene, wake->followed, at->time, at->bow, &ahead);
    const double heading = ahead + (wake->heading + lom_pi / 2);
    at->bow[0] += wake->half[0] * lom_double_cos(heading) - origin[0];
    at->bow[1] += wake->half[0] * lom_double_sin(heading) - origin[2];
}

static double foam_left(double age, double window)
{
    const double last = lom_double_exp(-windows);
    return lom_larger(lom_double_exp(-age / window) - last, 0) / (1 - last);
}

static double way_between(const struct moment *a, const struct moment *b)
{
    const double x = a->bow[0] - b->bow[0], z = a->bow[1] - b->bow[1];
    return lom_double_sqrt(x * x + z * z);
}

/* How much a body foams at a moment, by its speed in the step before it, which mostly begins at the moment that is known. */
static double made_at(const struct lom_wave_site *site, const lom_water_wake *wake, const double origin[3],
                      const struct moment *now, const struct moment *known, double step)
{
    struct moment before = { .time = now->time - step };
    if (before.time == known->time)
        before = *known;
    else
        find_bow(site, wake, origin, &before);
    const double froude = way_between(now, &before) / step / lom_double_sqrt(gravity * 2 * wake->half[0]);
    return lom_smaller(froude / full, 1);
}

/* Foam widens with the fourth root of the way, which lies above its chords: between two places it is within the reach of the
 * wider around both. */
static void grow_box(struct lom_wake_run *run, const struct lom_wake_place *at, float reach)
{
    const float place[2] = { at->x, at->z };
    for (int i = 0; i < 2; i++) {
        run->low[i] = place[i] - reach < run->low[i] ? place[i] - reach : run->low[i];
        run->high[i] = place[i] + reach > run->high[i] ? place[i] + reach : run->high[i];
    }
}

/* Runs share the place where one ends and the next begins. */
static void store_place(struct lom_wake_track *track, int step, const struct lom_wake_place *place, float reach)
{
    const int run = step / LOM_WAKE_STEPS, at = step % LOM_WAKE_STEPS;
    if (run < LOM_WAKE_RUNS) {
        struct lom_wake_run *own = &track->run[run];
        if (at == 0)
            *own = (struct lom_wake_run){ .low = { place->x, place->z }, .high = { place->x, place->z } };
        own->place[at] = *place;
        grow_box(own, place, reach);
        if (at > 0)
            grow_box(own, &own->place[at - 1], reach);
    }
    if (at == 0 && run > 0) {
        struct lom_wake_run *ended = &track->run[run - 1];
        ended->place[LOM_WAKE_STEPS] = *place;
        grow_box(ended, place, reach);
        grow_box(ended, &ended->place[LOM_WAKE_STEPS - 1], reach);
    }
}

static void follow_body(struct lom_wake_track *track, const struct lom_wave_site *site, const lom_water_wake *wake,
                        const double origin[3], double time)
{
    const double window = site->foam->window, step = windows * window / STEPS;
    const double newest = lom_double_floor(time / step);
    const double half = wake->half[1] * beside, length = 2 * wake->half[0];
    struct moment now = { .time = time }, before;
    track->half[0] = (float)wake->half[0];
    track->half[1] = (float)half;
    find_bow(site, wake, origin, &now);
    for (int i = 0; i <= STEPS; i++, now = before) {
        before = (struct moment){ .time = (newest - i) * step };
        find_bow(site, wake, origin, &before);
        before.way = now.way + way_between(&now, &before);
        const double spread = lom_double_sqrt(lom_double_sqrt(lom_larger(before.way / length, 1)));
        const double foam = made_at(site, wake, origin, &now, &before, step) * foam_left(time - now.time, window);
        const struct lom_wake_place place = { (float)now.bow[0], (float)now.bow[1], (float)now.way, (float)foam };
        store_place(track, i, &place, (float)(half * spread * 1.0001));
    }
}

static bool fill(void *memory, struct lom_waves_uniform *out, double time, lom_error *error)
{
    (void)error;
    struct state *state = memory;
    for (size_t i = 0; i < state->count; i++)
        follow_body(&state->tracks[i], state->site, &state->site->wakes[i], out->origin, time);
    out->wakes = (struct lom_wakes_uniform){ .tracks = state->tracks,
                                             .count = (int)state->count,
                                             .is_carried = state->site->foam->carried };
    return true;
}

static void report(const void *memory, const struct lom_wave_moment *moment, struct lom_wave_report *out)
{
    const struct state *state = memory;
    out->says = true;
    out->runs = moment->known == LOM_WAVES_FILLED;
    if (out->runs)
        snprintf(out->text, sizeof out->text, "the foam that %zu bodies left in %g s", state->count,
                 windows * state->site->foam->window);
    else
        snprintf(out->text, sizeof out->text, "%s: no body is followed", moment->why);
}

const struct lom_wave_kind lom_wakes = { .step = "wakes",
                                         .size = sizeof(struct state),
                                         .exists = exists,
                                         .load = load,
                                         .free = unload,
                                         .bound = bound,
                                         .fill = fill,
                                         .stage = LOM_WAVES_AT_DRAWING,
                                         .report = report };
