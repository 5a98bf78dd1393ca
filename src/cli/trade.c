/* `lom trade`. In: a scene and a folder. Out: what each setting of each dial costs and how wrong it is, as CSV, a
 * table, a plot and a page. Invariant: bad input is found before anything is written; the files are written when all
 * is measured. */
#include "commands.h"
#include "page.h"
#include "paths.h"
#include "progress.h"
#include "scene_options.h"
#include "trade_reference.h"

#include "measure/sweep.h"

#include <string.h>

struct values {
    struct lom_scene_options scene;
    struct lom_trade_options common;
    const char *output;
    lom_option_integers combine;
    bool cpu, quiet;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "DIR", 0, 0,
      "the folder for what is found; made when it is not there" },
    { "pairs", 0, LOM_OPTION_INTEGER, offsetof(struct values, common.pairs), "N", 1, LOM_MAX_PAIRS,
      "frames of each setting, in turn with the default, 9 when not given" },
    { "cpu", 0, LOM_OPTION_FLAG, offsetof(struct values, cpu), NULL, 0, 0,
      "milliseconds of processor time, of all threads, instead of the clock's" },
    { "combine", 0, LOM_OPTION_INTEGER, offsetof(struct values, combine), "N", 0, 4,
      "combine the best N dials, 3 when not given" },
    LOM_TRADE_OPTIONS(struct values),
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, quiet), NULL, 0, 0, "no progress bar, no table" },
    LOM_SCENE_OPTIONS(struct values),
};

static const lom_command_line line = {
    .name = "trade",
    .arguments = "SCENE -o DIR",
    .summary = "say what each dial of a scene buys: error against a reference over milliseconds",
    .details =
        "The frame has 320x180 pixels when --size is not given. DIR gets trade.csv, trade.txt, trade.svg,\n"
        "trade.html (one file, with pictures), and the reference, which is drawn once. Exit status 1: a dial that\n"
        "only changes speed changed the picture. docs/trade.md says how to read it.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* What the command line asks for, resolved. */
struct trade {
    const struct values *values;
    const char *scene;
    struct lom_chosen_dials dials;
    struct lom_trade_reference reference;
    lom_sweep_desc sweep;
};

/* ---- what is found ---- */

struct found {
    const lom_sweep *sweep;
    const lom_sweep_head *head;
};

static bool print_csv(FILE *out, const struct found *found, lom_error *error)
{
    (void)error;
    lom_print_sweep_csv(out, found->sweep);
    return true;
}
static bool print_table(FILE *out, const struct found *found, lom_error *error)
{
    (void)error;
    lom_print_sweep_table(out, found->sweep, found->head);
    return true;
}
static bool print_plot(FILE *out, const struct found *found, lom_error *error)
{
    (void)error;
    lom_print_sweep_plot(out, found->sweep, found->head);
    return true;
}
static bool print_page(FILE *out, const struct found *found, lom_error *error)
{
    return lom_print_sweep_page(out, found->sweep, found->head, error);
}

static const struct result {
    const char *name;
    bool (*print)(FILE *out, const struct found *found, lom_error *error);
} results[] = {
    { "trade.csv", print_csv }, { "trade.txt", print_table }, { "trade.svg", print_plot }, { "trade.html", print_page }
};
enum { RESULTS = sizeof results / sizeof results[0] };

static lom_bytes make_result(const struct result *result, const struct found *found, lom_error *error)
{
    struct lom_page page;
    lom_begin_page(&page);
    const bool done = page.out == NULL || result->print(page.out, found, error);
    lom_bytes bytes = lom_end_page(&page, error);
    if (done)
        return bytes;
    lom_release(bytes.data);
    return (lom_bytes){ NULL, 0 };
}

/* All of them are made before the first is written. */
static bool write_results(const char *folder, const struct found *found, lom_error *error)
{
    lom_bytes made[RESULTS] = { { NULL, 0 } };
    bool done = true;
    for (int i = 0; done && i < RESULTS; i++) {
        made[i] = make_result(&results[i], found, error);
        done = made[i].data != NULL;
    }
    for (int i = 0; done && i < RESULTS; i++) {
        char *path = lom_path_print(error, "%s/%s", folder, results[i].name);
        done = path != NULL && lom_make_folders(path, strlen(folder), error) &&
               lom_write_file(path, made[i].data, made[i].size, error);
        lom_release(path);
    }
    for (int i = 0; i < RESULTS; i++)
        lom_release(made[i].data);
    return done;
}

/* ---- running ---- */

static bool move_bar(void *context, double done, const char *doing)
{
    lom_show_progress(context, 100 * done, doing);
    return true;
}

/* The command that repeats it; paths as they were given. */
static void print_command(char text[600], const struct trade *t, const lom_sweep_desc *desc)
{
    const struct values *v = t->values;
    size_t length = (size_t)snprintf(text, 600, "lom trade %s -o DIR --size %dx%d --frame %d --pairs %d --combine %d",
                                     t->scene, desc->subject.frame.width, desc->subject.frame.height,
                                     desc->subject.frame.frame, desc->pairs, desc->combined);
    if (v->common.reference != NULL && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --reference %s", v->common.reference);
    if (t->reference.samples > 0 && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --samples %d", t->reference.samples);
    if (v->common.dials != NULL && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --dials %s", v->common.dials);
    if (v->cpu && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --cpu");
    if (v->scene.threads.given && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --threads %d", (int)v->scene.threads.value[0]);
    for (int i = 0; i < v->scene.set.count && length < 600; i++)
        length += (size_t)snprintf(text + length, 600 - length, " --set '%s'", v->scene.set.items[i]);
}

static bool report(const struct trade *t, const lom_sweep *sweep, bool *equal, lom_error *error)
{
    const lom_trial *first = NULL;
    char command[600], text[LOM_LONGEST_TRIAL];
    lom_device *device = lom_open_device(&t->sweep.subject.device);
    const lom_device_desc used = lom_describe_device(device);
    lom_close_device(device);
    print_command(command, t, &t->sweep);
    const lom_sweep_head head = { .scene = lom_path_file(t->scene),
                                  .command = command,
                                  .width = t->sweep.subject.frame.width,
                                  .height = t->sweep.subject.frame.height,
                                  .frame = t->sweep.subject.frame.frame,
                                  .clock = t->values->cpu ? "processor time" : "clock time",
                                  .threads = used.threads,
                                  .lanes = used.lanes };
    const struct found found = { sweep, &head };
    if (!write_results(t->values->output, &found, error))
        return false;
    if (!t->values->quiet)
        lom_print_sweep_table(stdout, sweep, &head);
    const size_t unequal = lom_count_unequal(sweep, &first);
    *equal = unequal == 0;
    if (unequal > 0)
        fprintf(stderr,
                "lom: %zu setting%s of dials that only change speed changed the picture: %s differs in %zu pixels.\n",
                unequal, unequal == 1 ? "" : "s", lom_print_trial(text, first), first->error.pixels);
    return true;
}

static bool run(struct trade *t, bool *equal, lom_error *error)
{
    lom_sweep sweep = { .count = 0 };
    struct lom_progress bar = lom_begin_progress("lom trade", 100, t->values->quiet);
    t->sweep.progress = move_bar;
    t->sweep.context = &bar;
    move_bar(&bar, 0, "reference");
    bool done = lom_find_trade_reference(&t->reference, error);
    if (done) {
        t->sweep.reference = t->reference.picture;
        done = lom_run_sweep(&t->sweep, &sweep, error);
    }
    lom_end_progress(&bar);
    done = done && report(t, &sweep, equal, error);
    lom_free_sweep(&sweep);
    return done;
}

static bool prepare(struct trade *t, lom_error *error)
{
    const struct values *v = t->values;
    const lom_subject subject = { .path = t->scene, .of_processors = v->cpu };
    if (!lom_prepare_trade(&t->reference, &t->dials, &v->common, &v->scene, subject, v->output, error))
        return false;
    t->sweep = (lom_sweep_desc){ .subject = t->reference.subject,
                                 .whole = t->reference.whole,
                                 .reference_name = t->reference.name,
                                 .dials = t->dials.chosen,
                                 .dial_count = t->dials.count,
                                 .pairs = (int)lom_given_or(&v->common.pairs, 9),
                                 .combined = (int)lom_given_or(&v->combine, 3) };
    return true;
}

int lom_command_trade(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    bool equal = true;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.output == NULL || values.output[0] == '\0')
        return lom_complain("trade takes the folder for what it finds: -o DIR.");
    if (strcmp(arguments.items[0], "-") == 0)
        return lom_complain("trade reads the scene again for each setting, and no standard input.");
    struct trade trade = { .values = &values, .scene = arguments.items[0] };
    bool done = prepare(&trade, &error) && run(&trade, &equal, &error);
    lom_end_trade_reference(&trade.reference);
    if (!done)
        return lom_complain_error(&error);
    return equal ? LOM_EXIT_DONE : LOM_EXIT_DIFFERS;
}
