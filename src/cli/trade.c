/* `lom trade`. In: a scene and a folder. Out: what each setting of each dial costs and how wrong it is, as CSV, a
 * table, a plot and a page. Invariant: bad input is found before anything is written; the files are written when all
 * is measured. */
#include "commands.h"
#include "page.h"
#include "paths.h"
#include "trade_options.h"

#include "measure/sweep.h"

#include <string.h>

struct values {
    struct lom_trade_values common; /* first: its rows are at the same places */
    lom_option_integers combine;
    bool cpu;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, common.output), "DIR", 0, 0,
      "the folder for what is found; made when it is not there" },
    { "pairs", 0, LOM_OPTION_INTEGER, offsetof(struct values, common.pairs), "N", 1, LOM_MAX_PAIRS,
      "frames of each setting, in turn with the default, 9 when not given" },
    { "cpu", 0, LOM_OPTION_FLAG, offsetof(struct values, cpu), NULL, 0, 0,
      "milliseconds of processor time, of all threads, instead of the clock's" },
    { "combine", 0, LOM_OPTION_INTEGER, offsetof(struct values, combine), "N", 0, 4,
      "combine the best N dials, 3 when not given" },
    LOM_TRADE_OPTIONS,
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, common.quiet), NULL, 0, 0, "no progress bar, no table" },
    LOM_SCENE_OPTIONS(struct lom_trade_values),
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
    struct lom_trade common;
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

/* The command that repeats it; paths as they were given. */
static void print_command(char text[600], const struct trade *t, const lom_sweep_desc *desc)
{
    const struct values *v = t->values;
    size_t length = (size_t)snprintf(text, 600, "lom trade %s -o DIR --size %dx%d --frame %d --pairs %d --combine %d",
                                     t->common.path, desc->subject.frame.width, desc->subject.frame.height,
                                     desc->subject.frame.frame, desc->pairs, desc->combined);
    if (v->common.reference != NULL && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --reference %s", v->common.reference);
    if (t->common.reference.samples > 0 && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --samples %d", t->common.reference.samples);
    if (v->common.dials != NULL && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --dials %s", v->common.dials);
    if (v->cpu && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --cpu");
    if (v->common.scene.threads.given && length < 600)
        length += (size_t)snprintf(text + length, 600 - length, " --threads %d", (int)v->common.scene.threads.value[0]);
    for (int i = 0; i < v->common.scene.set.count && length < 600; i++)
        length += (size_t)snprintf(text + length, 600 - length, " --set '%s'", v->common.scene.set.items[i]);
}

static bool report(const struct trade *t, const lom_sweep *sweep, bool *equal, lom_error *error)
{
    const lom_trial *first = NULL;
    char command[600], text[LOM_LONGEST_TRIAL];
    lom_device *device = lom_open_device(&t->sweep.subject.device);
    const lom_device_desc used = lom_describe_device(device);
    lom_close_device(device);
    print_command(command, t, &t->sweep);
    const lom_sweep_head head = { .scene = lom_path_file(t->common.path),
                                  .command = command,
                                  .width = t->sweep.subject.frame.width,
                                  .height = t->sweep.subject.frame.height,
                                  .frame = t->sweep.subject.frame.frame,
                                  .clock = t->values->cpu ? "processor time" : "clock time",
                                  .threads = used.threads,
                                  .lanes = used.lanes };
    const struct found found = { sweep, &head };
    if (!write_results(t->values->common.output, &found, error))
        return false;
    if (!t->values->common.quiet)
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
    t->sweep.progress = lom_show_trade;
    t->sweep.context = &t->common;
    bool done = lom_begin_trade(&t->common, "lom trade", &t->values->common, error);
    if (done) {
        t->sweep.reference = t->common.reference.picture;
        done = lom_run_sweep(&t->sweep, &sweep, error);
    }
    lom_end_progress(&t->common.bar);
    done = done && report(t, &sweep, equal, error);
    lom_free_sweep(&sweep);
    return done;
}

static bool prepare(struct trade *t, lom_error *error)
{
    const struct values *v = t->values;
    if (!lom_prepare_trade(&t->common, &v->common, v->cpu, v->common.output, error))
        return false;
    t->sweep = (lom_sweep_desc){ .subject = t->common.reference.subject,
                                 .whole = t->common.reference.whole,
                                 .reference_name = t->common.reference.name,
                                 .dials = t->common.chosen,
                                 .dial_count = t->common.count,
                                 .pairs = (int)lom_given_or(&v->common.pairs, 9),
                                 .combined = (int)lom_given_or(&v->combine, 3) };
    return true;
}

int lom_command_trade(int argc, char **argv)
{
    struct values values = { .cpu = false };
    struct trade trade = { .values = &values };
    lom_error error = { .code = LOM_OK };
    int status;
    bool equal = true;
    if (!lom_read_trade(&trade.common, &line, "the folder for what it finds: -o DIR.", argc, argv, &values, &status))
        return status;
    bool done = prepare(&trade, &error) && run(&trade, &equal, &error);
    lom_end_trade_reference(&trade.common.reference);
    if (!done)
        return lom_complain_error(&error);
    return equal ? LOM_EXIT_DONE : LOM_EXIT_DIFFERS;
}
