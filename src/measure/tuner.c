/* The tuner. In: a scene, dials, a limit. Out: settings. Invariant: of ways that are as good, the one that was found
 * first stays; what is compared are whole numbers and errors that no machine computes differently, but for times. */
#include "measure/tuner.h"

#include "measure/work.h"

#include <string.h>

enum { MOST_ROUNDS = 4 };

struct tuner {
    const lom_tuner_desc *desc;
    lom_tuning *tuning;
    lom_drawer drawer, standard; /* standard: what times are paired with */
};

static bool keeps(const lom_tuner_desc *desc, const lom_tuned *way)
{
    switch (desc->goal) {
    case LOM_GOAL_FLIP:
        return way->error.flip <= desc->limit;
    case LOM_GOAL_PSNR:
        return way->error.psnr >= desc->limit;
    case LOM_GOAL_BUDGET:
        return way->cost <= desc->limit;
    }
    return false;
}

/* How far a way is from what is wanted of it once it keeps the limit, the less the better; and how far it is from
 * the limit. */
static double merit(const lom_tuner_desc *desc, const lom_tuned *way)
{
    return desc->goal == LOM_GOAL_BUDGET ? way->error.flip : way->cost;
}
static double excess(const lom_tuner_desc *desc, const lom_tuned *way)
{
    return desc->goal == LOM_GOAL_BUDGET ? way->cost : desc->goal == LOM_GOAL_FLIP ? way->error.flip : -way->error.psnr;
}

/* Both keep the limit, or neither: then the nearer one, and of those as near the better one. */
static bool is_better(const lom_tuner_desc *desc, const lom_tuned *way, const lom_tuned *than)
{
    const bool kept = keeps(desc, way);
    if (kept != keeps(desc, than))
        return kept;
    const double mine = merit(desc, way), its = merit(desc, than);
    if (kept)
        return mine < its || (mine == its && excess(desc, way) < excess(desc, than));
    return excess(desc, way) < excess(desc, than) || (excess(desc, way) == excess(desc, than) && mine < its);
}

static bool find_cost(struct tuner *tuner, lom_tuned *way, lom_error *error)
{
    lom_declared_work work;
    lom_pair_time time;
    lom_frame_desc after = tuner->desc->subject.frame; /* the frame after the one whose error is measured */
    if (tuner->desc->by_clock) {
        if (!lom_time_pairs(&tuner->drawer, &tuner->standard, &tuner->desc->subject, tuner->desc->pairs, &time, error))
            return false;
        if (tuner->tuning->tried == 0)
            tuner->tuning->standard.cost = time.other_ms;
        way->cost = time.ratio * tuner->tuning->standard.cost;
        return true;
    }
    after.frame++;
    if (!lom_count_work(tuner->drawer.renderer, tuner->drawer.scene, &after, &work, error))
        return false;
    way->cost = (double)lom_weigh_work(&work);
    return true;
}

/* Draws a way. *drawn: the scene takes these settings. */
static bool look_at(struct tuner *tuner, lom_tuned *way, bool *drawn, lom_error *error)
{
    lom_error refused = { .code = LOM_OK };
    *drawn = lom_set_drawer(&tuner->drawer, &tuner->desc->subject, &way->choices, &refused);
    if (!*drawn)
        return lom_is_refusal(&refused) || lom_fail(error, refused.code, "%s", refused.text);
    lom_image *picture = lom_draw_subject(&tuner->drawer, &tuner->desc->subject, error);
    const bool done = picture != NULL && lom_measure_error(tuner->desc->reference, picture, &way->error, error) &&
                      find_cost(tuner, way, error);
    lom_free_image(picture);
    tuner->tuning->tried++;
    return done;
}

/* ---- choices ---- */

static int find_choice(const lom_choices *choices, const lom_dial *dial)
{
    for (int i = 0; i < choices->count; i++)
        if (choices->choice[i].dial == dial)
            return i;
    return -1;
}

static bool choose(lom_choices *choices, const lom_dial *dial, const char setting[LOM_SCENE_VALUE])
{
    int i = find_choice(choices, dial);
    if (i < 0 && choices->count == LOM_MAX_CHOICES)
        return false;
    if (i < 0)
        i = choices->count++;
    choices->choice[i].dial = dial;
    memcpy(choices->choice[i].setting, setting, LOM_SCENE_VALUE);
    return true;
}

/* What the drawer's scene has. */
static bool is_set(const struct tuner *tuner, const lom_dial *dial, const char *setting)
{
    char value[LOM_SCENE_VALUE];
    return strcmp(lom_print_scene_value(value, tuner->drawer.scene, &dial->key), setting) == 0;
}

static bool is_tuned(const lom_dial *dial)
{
    return dial->key.key != NULL && dial->row.reference == LOM_DIAL_TRACED;
}

static bool acts(const struct tuner *tuner, const lom_dial *dial)
{
    char why[LOM_DIAL_REASON];
    return lom_dial_acts(tuner->drawer.scene, &dial->row, why);
}

/* ---- the search ---- */

/* Tries every other setting of one dial on the best way so far. */
static bool improve(struct tuner *tuner, const lom_dial *dial, bool *improved, lom_error *error)
{
    const lom_tuned from = tuner->tuning->best;
    char setting[LOM_SCENE_VALUE], present[LOM_SCENE_VALUE];
    if (!lom_set_drawer(&tuner->drawer, &tuner->desc->subject, &from.choices, error))
        return false;
    if (!acts(tuner, dial))
        return true;
    lom_print_scene_value(present, tuner->drawer.scene, &dial->key);
    for (size_t i = 0; lom_dial_setting(dial, i, setting); i++) {
        lom_tuned way = { .choices = from.choices };
        bool drawn;
        if (strcmp(setting, present) == 0 || !choose(&way.choices, dial, setting))
            continue;
        if (!look_at(tuner, &way, &drawn, error))
            return false;
        if (drawn && is_better(tuner->desc, &way, &tuner->tuning->best)) {
            tuner->tuning->best = way;
            *improved = true;
        }
    }
    return true;
}

static bool tell(const lom_tuner_desc *desc, double done, const char *doing, lom_error *error)
{
    return desc->progress == NULL || desc->progress(desc->context, done, doing) ||
           lom_fail(error, LOM_ERROR_ABANDONED, "The tuning was abandoned.");
}

static bool search(struct tuner *tuner, lom_error *error)
{
    const lom_tuner_desc *desc = tuner->desc;
    bool improved = true;
    for (int round = 0; improved && round < MOST_ROUNDS; round++) {
        improved = false;
        for (size_t i = 0; i < desc->dial_count; i++) {
            const double done = (round + (double)i / (double)desc->dial_count) / MOST_ROUNDS;
            if (is_tuned(desc->dials[i]) &&
                (!tell(desc, done, desc->dials[i]->name, error) || !improve(tuner, desc->dials[i], &improved, error)))
                return false;
        }
    }
    return true;
}

/* Leaves out what does nothing, and what the scene says itself. */
static bool tidy(struct tuner *tuner, lom_error *error)
{
    lom_choices *choices = &tuner->tuning->best.choices;
    const lom_choices all = *choices, none = { .count = 0 };
    if (!lom_set_drawer(&tuner->drawer, &tuner->desc->subject, &all, error))
        return false;
    choices->count = 0;
    for (int i = 0; i < all.count; i++)
        if (acts(tuner, all.choice[i].dial))
            choices->choice[choices->count++] = all.choice[i];
    const lom_choices acting = *choices;
    if (!lom_set_drawer(&tuner->drawer, &tuner->desc->subject, &none, error))
        return false;
    choices->count = 0;
    for (int i = 0; i < acting.count; i++)
        if (!is_set(tuner, acting.choice[i].dial, acting.choice[i].setting))
            choices->choice[choices->count++] = acting.choice[i];
    return true;
}

bool lom_tune(const lom_tuner_desc *desc, lom_tuning *tuning, lom_error *error)
{
    lom_tuner_desc own = *desc;
    if (!own.by_clock)
        own.subject.device = lom_counting_device();
    struct tuner tuner = { .desc = &own, .tuning = tuning };
    bool drawn = false;
    *tuning = (lom_tuning){ .met = false };
    bool done = (!own.by_clock || lom_set_drawer(&tuner.standard, &own.subject, &tuning->best.choices, error)) &&
                look_at(&tuner, &tuning->best, &drawn, error);
    if (done && !drawn)
        done = lom_set_drawer(&tuner.drawer, &own.subject, &tuning->best.choices, error);
    tuning->standard = tuning->best;
    done = done && search(&tuner, error) && tidy(&tuner, error);
    tuning->met = done && keeps(&own, &tuning->best);
    lom_end_drawer(&tuner.drawer);
    lom_end_drawer(&tuner.standard);
    return done;
}
