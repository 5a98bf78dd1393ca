/* Sweeps. In: a scene, dials, a reference. Out: a trial for each setting, then for combinations of those that are worth
 * having, with errors, times and the front. Invariant: every trial is timed in pairs with the default it belongs to. */
#include "measure/sweep.h"

#include "base/reserve.h"
#include "measure/sweep_front.h"

#include <string.h>

/* A subject with its default drawn. */
struct base {
    const lom_subject *subject;
    const lom_image *reference;
    const char *name;
    lom_drawer drawer, other; /* the default; what is tried */
    lom_image *picture;       /* the default's */
};

static bool begin_base(struct base *base, lom_error *error)
{
    const lom_choices none = { .count = 0 };
    if (!lom_set_drawer(&base->drawer, base->subject, &none, error))
        return false;
    base->picture = lom_draw_subject(&base->drawer, base->subject, error);
    return base->picture != NULL;
}

static void end_base(struct base *base)
{
    lom_end_drawer(&base->drawer);
    lom_end_drawer(&base->other);
    lom_free_image(base->picture);
}

static lom_trial *add_trial(lom_sweep *sweep, const lom_choices *choices, lom_error *error)
{
    if (!lom_reserve(&sweep->trial, &sweep->capacity, sweep->count + 1, sizeof *sweep->trial, error))
        return NULL;
    lom_trial *trial = &sweep->trial[sweep->count++];
    *trial = (lom_trial){ .choices = *choices };
    return trial;
}

/* ---- one trial ---- */

static bool measure(const struct base *base, const lom_sweep_desc *desc, lom_trial *trial, lom_error *error)
{
    const lom_image *reference = trial->is_equal ? base->picture : base->reference;
    trial->picture = lom_draw_subject(&base->other, base->subject, error);
    if (trial->picture == NULL || !lom_measure_error(reference, trial->picture, &trial->error, error) ||
        !lom_time_pairs(&base->other, &base->drawer, base->subject, desc->pairs, &trial->time, error))
        return false;
    trial->differs = trial->is_equal && trial->error.pixels > 0;
    return true;
}

/* What is refused is told in its trial; all else ends the sweep. */
static bool try_choices(struct base *base, const lom_sweep_desc *desc, lom_trial *trial, lom_error *error)
{
    lom_error refused = { .code = LOM_OK };
    trial->reference = trial->is_equal ? "default" : base->name;
    if (lom_set_drawer(&base->other, base->subject, &trial->choices, &refused))
        return measure(base, desc, trial, error);
    if (!lom_is_refusal(&refused))
        return lom_fail(error, refused.code, "%s", refused.text);
    snprintf(trial->failed, sizeof trial->failed, "%.*s", (int)sizeof trial->failed - 1, refused.text);
    return true;
}

static bool tell(const lom_sweep_desc *desc, double done, const char *doing, lom_error *error)
{
    return desc->progress == NULL || desc->progress(desc->context, done, doing) ||
           lom_fail(error, LOM_ERROR_ABANDONED, "The sweep was abandoned.");
}

static bool try_default(struct base *base, const lom_sweep_desc *desc, lom_sweep *sweep, lom_error *error)
{
    const lom_choices none = { .count = 0 };
    lom_trial *trial = add_trial(sweep, &none, error);
    if (trial == NULL)
        return false;
    trial->is_default = true;
    return try_choices(base, desc, trial, error);
}

/* ---- single dials ---- */

/* Whether a setting is what the scene has. */
static bool is_set(const lom_scene *scene, const lom_dial *dial, const char *setting)
{
    char value[LOM_SCENE_VALUE];
    return dial->key.key != NULL && strcmp(lom_print_scene_value(value, scene, &dial->key), setting) == 0;
}

static bool try_dial(struct base *base, const lom_sweep_desc *desc, const lom_dial *dial, lom_sweep *sweep,
                     lom_error *error)
{
    char setting[LOM_SCENE_VALUE];
    for (size_t i = 0; lom_dial_setting(dial, i, setting); i++) {
        if (is_set(base->drawer.scene, dial, setting))
            continue;
        lom_choices choices = { .count = 1, .choice = { { .dial = dial } } };
        memcpy(choices.choice[0].setting, setting, sizeof setting);
        lom_trial *trial = add_trial(sweep, &choices, error);
        if (trial == NULL)
            return false;
        trial->is_equal = dial->row.reference == LOM_DIAL_EQUAL;
        if (!try_choices(base, desc, trial, error))
            return false;
    }
    return true;
}

/* Its finest setting draws the reference. */
static bool try_against_finest(const lom_sweep_desc *desc, const lom_dial *dial, lom_sweep *sweep, lom_error *error)
{
    struct base base = { .subject = &desc->whole, .name = dial->name };
    lom_choices finest = { .count = 1, .choice = { { .dial = dial } } };
    lom_image *reference = NULL;
    char setting[LOM_SCENE_VALUE];
    for (size_t i = 0; lom_dial_setting(dial, i, setting); i++)
        memcpy(finest.choice[0].setting, setting, sizeof setting);
    bool done = begin_base(&base, error) && lom_set_drawer(&base.other, base.subject, &finest, error);
    if (done)
        base.reference = reference = lom_draw_subject(&base.other, base.subject, error);
    done = done && reference != NULL && try_default(&base, desc, sweep, error) &&
           try_dial(&base, desc, dial, sweep, error);
    end_base(&base);
    lom_free_image(reference);
    return done;
}

/* Whether the dial acts in the scene that it would be tried in. */
static bool acts(const lom_scene *scene, const lom_dial *dial)
{
    char why[LOM_DIAL_REASON];
    return lom_dial_acts(scene, &dial->row, why);
}

/* The dials of one kind of reference. */
static bool try_dials(struct base *base, const lom_sweep_desc *desc, lom_dial_reference kind, lom_sweep *sweep,
                      lom_error *error)
{
    for (size_t i = 0; i < desc->dial_count; i++) {
        const lom_dial *dial = desc->dials[i];
        if (dial->row.reference != kind || !acts(base->drawer.scene, dial))
            continue;
        if (!tell(desc,
                  (kind == LOM_DIAL_EQUAL ? 0.8 : 0) +
                      (kind == LOM_DIAL_EQUAL ? 0.15 : 0.5) * (double)i / (double)desc->dial_count,
                  dial->name, error) ||
            !try_dial(base, desc, dial, sweep, error))
            return false;
    }
    return true;
}

static bool try_finest(const lom_sweep_desc *desc, lom_sweep *sweep, lom_error *error)
{
    lom_scene *scene = lom_read_scene(desc->whole.path, desc->whole.changes, desc->whole.change_count, error);
    bool done = scene != NULL;
    for (size_t i = 0; done && i < desc->dial_count; i++)
        if (desc->dials[i]->row.reference == LOM_DIAL_FINEST && acts(scene, desc->dials[i]))
            done =
                tell(desc, 0.95, desc->dials[i]->name, error) && try_against_finest(desc, desc->dials[i], sweep, error);
    lom_free_scene(scene);
    return done;
}

/* ---- combinations ---- */

static bool try_mixed(struct base *base, const lom_sweep_desc *desc, lom_sweep *sweep, lom_error *error)
{
    lom_choices choices;
    const struct lom_mixture mixture = lom_choose_mixture(sweep, desc->combined);
    for (size_t i = 0; lom_mixed_choices(&mixture, i, &choices); i++) {
        if (choices.count < 2)
            continue;
        lom_trial *trial = add_trial(sweep, &choices, error);
        if (trial == NULL)
            return false;
        trial->is_mixed = true;
        if (!tell(desc, 0.5 + 0.3 * (double)i / (double)mixture.count, "combinations", error) ||
            !try_choices(base, desc, trial, error))
            return false;
    }
    return true;
}

/* ---- the whole ---- */

bool lom_run_sweep(const lom_sweep_desc *desc, lom_sweep *sweep, lom_error *error)
{
    struct base base = { .subject = &desc->subject, .reference = desc->reference, .name = desc->reference_name };
    *sweep = (lom_sweep){ .reference = desc->reference };
    bool done = begin_base(&base, error) && try_default(&base, desc, sweep, error) &&
                try_dials(&base, desc, LOM_DIAL_TRACED, sweep, error) && try_mixed(&base, desc, sweep, error) &&
                try_dials(&base, desc, LOM_DIAL_EQUAL, sweep, error) && try_finest(desc, sweep, error);
    end_base(&base);
    if (done)
        lom_mark_front(sweep);
    return done;
}

void lom_free_sweep(lom_sweep *sweep)
{
    for (size_t i = 0; i < sweep->count; i++)
        lom_free_image(sweep->trial[i].picture);
    lom_release(sweep->trial);
    *sweep = (lom_sweep){ .count = 0 };
}

const char *lom_print_trial(char text[LOM_LONGEST_TRIAL], const lom_trial *trial)
{
    size_t length = 0;
    snprintf(text, LOM_LONGEST_TRIAL, "default");
    for (int i = 0; i < trial->choices.count && length < LOM_LONGEST_TRIAL; i++)
        length += (size_t)snprintf(text + length, LOM_LONGEST_TRIAL - length, "%s%s=%s", i > 0 ? " " : "",
                                   trial->choices.choice[i].dial->name, trial->choices.choice[i].setting);
    return text;
}

size_t lom_count_unequal(const lom_sweep *sweep, const lom_trial **first)
{
    size_t count = 0;
    for (size_t i = 0; i < sweep->count; i++)
        if (sweep->trial[i].differs && count++ == 0)
            *first = &sweep->trial[i];
    return count;
}
