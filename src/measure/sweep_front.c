/* The front of a sweep. In: trials with errors and times. Out: which of them no other beats, and combinations to try.
 * Invariant: which picture is more exact is decided by FLIP alone, which does not differ from run to run. */
#include "measure/sweep_front.h"

#include <string.h>

/* Pictures that nobody can tell apart; a gain that is worth a combination. */
static const double flip_step = 1e-5, least_gain = 0.02;

static bool counts(const lom_trial *trial)
{
    return trial->failed[0] == 0 && !trial->is_equal;
}

/* Times differ where the quartiles of their pairs lie apart. Of trials that nobody can tell apart the first is kept. */
static bool is_beaten_by(const lom_trial *trial, const lom_trial *other)
{
    const double flip = other->error.flip - trial->error.flip;
    const bool is_cheaper = other->time.high<trial->time.low, is_dearer = other->time.low> trial->time.high;
    if (flip > flip_step || is_dearer)
        return false;
    return is_cheaper || flip < -flip_step || other < trial;
}

static bool is_on_front(const lom_sweep *sweep, const lom_trial *trial)
{
    for (size_t i = 0; i < sweep->count; i++) {
        const lom_trial *other = &sweep->trial[i];
        if (other != trial && counts(other) && strcmp(other->reference, trial->reference) == 0 &&
            is_beaten_by(trial, other))
            return false;
    }
    return true;
}

/* The default that a trial was timed with: the last one before it with its reference. */
static const lom_trial *default_of(const lom_sweep *sweep, const lom_trial *trial)
{
    const lom_trial *found = &sweep->trial[0];
    for (const lom_trial *at = sweep->trial; at <= trial; at++)
        if (at->is_default && strcmp(at->reference, trial->reference) == 0)
            found = at;
    return found;
}

void lom_mark_front(lom_sweep *sweep)
{
    for (size_t i = 0; i < sweep->count; i++) {
        lom_trial *trial = &sweep->trial[i];
        if (!counts(trial))
            continue;
        trial->on_front = is_on_front(sweep, trial);
        trial->beats_default = !trial->is_default && trial->time.high < 1 &&
                               trial->error.flip <= default_of(sweep, trial)->error.flip + flip_step;
    }
}

double lom_trial_ms(const lom_sweep *sweep, const lom_trial *trial)
{
    return trial->time.ratio * default_of(sweep, trial)->time.other_ms;
}

/* ---- combinations ---- */

/* What a setting gains on the default: of the error as it is more exact, of the time as it is cheaper. */
static double gain_of(const lom_trial *trial, const lom_trial *standard)
{
    const double error = 1 - trial->error.flip / (standard->error.flip > 0 ? standard->error.flip : 1);
    const double time = 1 - trial->time.ratio;
    return error > time ? error : time;
}

static void add_setting(struct lom_mixture *mixture, const lom_choice *choice, int most)
{
    int i = 0;
    while (i < mixture->dials && mixture->dial[i].setting[0].dial != choice->dial)
        i++;
    if (i == most || i == LOM_MIXED_DIALS)
        return;
    struct lom_mixed_dial *dial = &mixture->dial[i];
    if (i == mixture->dials)
        mixture->dials++;
    if (dial->settings < LOM_MIXED_SETTINGS)
        dial->setting[dial->settings++] = *choice;
}

/* A setting of one dial that neither the default nor another setting of that dial beats. */
static bool is_candidate(const lom_sweep *sweep, const lom_trial *trial)
{
    if (!counts(trial) || trial->choices.count != 1 || strcmp(trial->reference, sweep->trial[0].reference) != 0)
        return false;
    for (size_t i = 0; i < sweep->count; i++) {
        const lom_trial *other = &sweep->trial[i];
        const bool is_rival =
            i == 0 || (other->choices.count == 1 && other->choices.choice[0].dial == trial->choices.choice[0].dial);
        if (is_rival && counts(other) && other != trial && is_beaten_by(trial, other))
            return false;
    }
    return true;
}

/* The best first; of equals the first. */
struct lom_mixture lom_choose_mixture(const lom_sweep *sweep, int most)
{
    struct lom_mixture mixture = { .dials = 0 };
    double above = __builtin_inf(); /* what has been taken */
    size_t taken = 0;
    for (;;) {
        const lom_trial *best = NULL;
        double gain = 0;
        for (size_t i = 0; i < sweep->count; i++) {
            const double own = gain_of(&sweep->trial[i], &sweep->trial[0]);
            const bool is_left = own < above || (own == above && i > taken);
            if (is_left && is_candidate(sweep, &sweep->trial[i]) && (best == NULL || own > gain)) {
                best = &sweep->trial[i];
                gain = own;
            }
        }
        if (best == NULL || gain <= least_gain)
            break;
        add_setting(&mixture, &best->choices.choice[0], most);
        above = gain;
        taken = (size_t)(best - sweep->trial);
    }
    mixture.count = mixture.dials > 1 ? 1 : 0;
    for (int i = 0; i < mixture.dials; i++)
        mixture.count *= (size_t)mixture.dial[i].settings + 1;
    return mixture;
}

bool lom_mixed_choices(const struct lom_mixture *mixture, size_t i, lom_choices *choices)
{
    if (i >= mixture->count)
        return false;
    choices->count = 0;
    for (int k = 0; k < mixture->dials; k++) {
        const struct lom_mixed_dial *dial = &mixture->dial[k];
        const size_t states = (size_t)dial->settings + 1, state = i % states;
        if (state > 0)
            choices->choice[choices->count++] = dial->setting[state - 1];
        i /= states;
    }
    return true;
}
