/* `lom tune`. In: a scene and a limit. Out: a file of settings for `lom render --settings`. Invariant: without
 * --clock the same file on every machine; nothing is written where no settings keep the limit. */
#include "commands.h"
#include "page.h"
#include "paths.h"
#include "trade_options.h"

#include "measure/tuner.h"

#include <string.h>

struct values {
    struct lom_trade_values common; /* first: its rows are at the same places */
    lom_option_number max_flip, min_psnr, budget;
    bool clock;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, common.output), "OVERLAY.toml", 0, 0,
      "where the settings are written; - is stdout" },
    { "max-flip", 0, LOM_OPTION_NUMBER, offsetof(struct values, max_flip), "F", 0, 1,
      "the cheapest settings whose mean FLIP is at most F" },
    { "min-psnr", 0, LOM_OPTION_NUMBER, offsetof(struct values, min_psnr), "DB", 0, 1000,
      "the cheapest settings whose PSNR is at least DB" },
    { "budget", 0, LOM_OPTION_NUMBER, offsetof(struct values, budget), "WORK", 0, 1e18,
      "the most exact settings that cost at most WORK; milliseconds with --clock" },
    { "clock", 0, LOM_OPTION_FLAG, offsetof(struct values, clock), NULL, 0, 0,
      "cost is time by the clock, not declared work: another answer each time" },
    { "pairs", 0, LOM_OPTION_INTEGER, offsetof(struct values, common.pairs), "N", 1, LOM_MAX_PAIRS,
      "with --clock: frames of each way, in turn with the default, 9 when not given" },
    LOM_TRADE_OPTIONS,
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, common.quiet), NULL, 0, 0, "no progress bar, no report" },
    LOM_SCENE_OPTIONS(struct lom_trade_values),
};

static const lom_command_line line = {
    .name = "tune",
    .arguments = "SCENE --max-flip F | --min-psnr DB | --budget WORK -o OVERLAY.toml",
    .summary = "find the cheapest settings within an error, or the most exact within declared work",
    .details = "The frame has 320x180 pixels when --size is not given. Work is counted (vertices, fragments, lookups,\n"
               "steps ... by fixed weights, about a nanosecond each), so the answer is the same on every machine.\n"
               "Exit status 1: nothing was found that keeps the limit. docs/trade.md says how it searches.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

struct tune {
    const struct values *values;
    struct lom_trade common;
    lom_tuner_desc desc;
};

/* Which of the three limits was given. */
static bool find_goal(const struct values *v, lom_tuner_desc *desc)
{
    const lom_option_number *const limits[] = {
        [LOM_GOAL_FLIP] = &v->max_flip, [LOM_GOAL_PSNR] = &v->min_psnr, [LOM_GOAL_BUDGET] = &v->budget
    };
    int given = 0;
    for (int i = 0; i < 3; i++)
        if (limits[i]->given) {
            desc->goal = (lom_goal)i;
            desc->limit = limits[i]->value;
            given++;
        }
    return given == 1;
}

/* ---- what is found ---- */

static void print_way(FILE *out, const char *prefix, const lom_tuned *way, const struct values *v)
{
    fprintf(out, v->clock ? "%s%.2f ms" : "%swork %.0f", prefix, way->cost);
    fprintf(out, ", FLIP %.5f, PSNR %.2f dB, SSIM %.4f\n", way->error.flip, way->error.psnr, way->error.ssim);
}

static void print_setting(FILE *out, const lom_choice *choice)
{
    const bool is_word = choice->dial->key.key->type == LOM_KEY_CHOICE;
    fprintf(out, "%s = %s%s%s\n", choice->dial->key.path, is_word ? "\"" : "", choice->setting, is_word ? "\"" : "");
}

static void print_overlay(FILE *out, const struct tune *t, const lom_tuning *tuning)
{
    fprintf(out, "# settings for %s, made by `lom tune`%s; lom render SCENE --settings FILE takes them\n",
            lom_path_file(t->common.path), t->values->clock ? " by the clock" : "");
    fprintf(out, "# %dx%d, frame %d, against %s\n", t->desc.subject.frame.width, t->desc.subject.frame.height,
            t->desc.subject.frame.frame, t->common.reference.name);
    print_way(out, "# these:     ", &tuning->best, t->values);
    print_way(out, "# the scene: ", &tuning->standard, t->values);
    for (int i = 0; i < tuning->best.choices.count; i++)
        print_setting(out, &tuning->best.choices.choice[i]);
}

static bool write_overlay(const struct tune *t, const lom_tuning *tuning, lom_error *error)
{
    struct lom_page page;
    lom_begin_page(&page);
    if (page.out != NULL)
        print_overlay(page.out, t, tuning);
    lom_bytes text = lom_end_page(&page, error);
    const bool done = text.data != NULL && lom_write_file(t->values->common.output, text.data, text.size, error);
    if (done && !t->values->common.quiet && strcmp(t->values->common.output, "-") != 0)
        fwrite(text.data, 1, text.size, stdout);
    lom_release(text.data);
    return done;
}

/* ---- running ---- */

static bool run(struct tune *t, lom_tuning *tuning, lom_error *error)
{
    t->desc.progress = lom_show_trade;
    t->desc.context = &t->common;
    bool done = lom_begin_trade(&t->common, "lom tune", &t->values->common, error);
    t->desc.reference = t->common.reference.picture;
    done = done && lom_tune(&t->desc, tuning, error);
    lom_end_progress(&t->common.bar);
    return done && (!tuning->met || write_overlay(t, tuning, error));
}

static bool prepare(struct tune *t, lom_error *error)
{
    const struct values *v = t->values;
    if (!lom_prepare_trade(&t->common, &v->common, false, NULL, error))
        return false;
    t->desc.subject = t->common.reference.subject;
    t->desc.dials = t->common.chosen;
    t->desc.dial_count = t->common.count;
    t->desc.by_clock = v->clock;
    t->desc.pairs = (int)lom_given_or(&v->common.pairs, 9);
    return true;
}

int lom_command_tune(int argc, char **argv)
{
    struct values values = { .clock = false };
    struct tune tune = { .values = &values };
    lom_error error = { .code = LOM_OK };
    lom_tuning tuning;
    int status;
    if (!lom_read_trade(&tune.common, &line, "the file for its settings: -o OVERLAY.toml.", argc, argv, &values,
                        &status))
        return status;
    if (!find_goal(&values, &tune.desc))
        return lom_complain("tune takes one limit: --max-flip F, --min-psnr DB or --budget WORK.");
    const bool done = prepare(&tune, &error) && run(&tune, &tuning, &error);
    lom_end_trade_reference(&tune.common.reference);
    if (!done)
        return lom_complain_error(&error);
    if (tuning.met)
        return LOM_EXIT_DONE;
    fprintf(stderr, "lom: of %d ways that were tried none keeps the limit; ", tuning.tried);
    print_way(stderr, "the nearest has ", &tuning.best, &values);
    return LOM_EXIT_DIFFERS;
}
