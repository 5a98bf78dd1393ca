/* `lom compare`. In: two pictures and what may differ. Out: how much they differ, and the exit status that says whether
 * that was accepted. Invariant: without limits a single differing sample is refused; with limits, all of them must
 * hold, and a measure that is no number holds none. Only measures that are printed or limited are computed. */
#include "compare.h"

#include "commands.h"
#include "compare_ignore.h"

#include "base/threads.h"

#include <stdatomic.h>
#include <string.h>

static const lom_option options[] = {
    { .name = "max-diff-pixels",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct lom_compare_values, max_diff_pixels),
      .value = "N",
      .maximum = 1e12,
      .help = "accept at most N pixels that differ (by more than D)" },
    { .name = "max-delta",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct lom_compare_values, max_delta),
      .value = "D",
      .maximum = 1e38,
      .help = "accept pixels that differ by at most D" },
    { .name = "min-psnr",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct lom_compare_values, min_psnr),
      .value = "DB",
      .minimum = -1000,
      .maximum = 1000,
      .help = "accept a PSNR of at least DB decibels" },
    { .name = "min-ssim",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct lom_compare_values, min_ssim),
      .value = "S",
      .minimum = -1,
      .maximum = 1,
      .help = "accept a mean SSIM of at least S" },
    { .name = "max-flip",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct lom_compare_values, max_flip),
      .value = "F",
      .maximum = 1,
      .help = "accept a mean FLIP of at most F" },
    { .name = "metrics",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct lom_compare_values, metrics),
      .help = "find SSIM and FLIP as well, which takes longer" },
    { .name = "ignore",
      .kind = LOM_OPTION_LIST,
      .field = offsetof(struct lom_compare_values, ignore),
      .value = "X,Y,W,H",
      .help = "leave out the pixels of a rectangle" },
    { .name = "mask",
      .kind = LOM_OPTION_TEXT,
      .field = offsetof(struct lom_compare_values, mask),
      .value = "PICTURE",
      .help = "leave out the pixels where that picture is black" },
    { .name = "any",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct lom_compare_values, any),
      .help = "A is compared with each of the others, and one of them is enough" },
    { .name = "diff",
      .kind = LOM_OPTION_TEXT,
      .field = offsetof(struct lom_compare_values, diff),
      .value = "OUT.png",
      .help = "write a picture of the differences; of folders: a folder of them" },
    { .name = "json",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct lom_compare_values, json),
      .help = "print one JSON object" },
    { .name = "quiet",
      .letter = 'q',
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct lom_compare_values, quiet),
      .help = "print nothing; only the exit status answers" },
};

static const lom_command_line line = {
    .name = "compare",
    .arguments = "A B...",
    .summary = "Says whether and how much two pictures differ",
    .details =
        "Exit status: 0 when accepted, 1 when not, 2 when the pictures could not be read. Without limits any "
        "differing\n"
        "sample is refused; with some, all of them must hold. Pictures of different sizes always differ.\n\n"
        "--max-diff-pixels N and --max-delta D are one limit: at most N pixels differ by more than D, a pixel by its\n"
        "largest sample, alpha included. N alone is with D 0, D alone with N 0: no pixel differs by more than D.\n\n"
        "SSIM and FLIP are found only by --metrics or where a limit names them, on all processors; in --json they are\n"
        "null otherwise (but for identical pictures, where they are 1 and 0).\n\n"
        "Pictures of different kinds are compared in the one that holds both: 8-bit n is 16-bit 257 n, gray is three\n"
        "equal colours, missing alpha is opaque. Deltas and the RMSE are in steps of that format (0..255, 0..65535), "
        "for\n"
        "floats plain numbers; alpha counts in the exact comparison alone. PSNR is over the colours, with a peak of "
        "the\n"
        "largest step or 1.0; SSIM follows Wang 2004 on luma without downsampling; FLIP is the mean of LDR FLIP at 67\n"
        "pixels a degree, which takes whole-number samples as sRGB-encoded and floats as linear light.\n\n"
        "Pixels that are left out are white and opaque in both pictures, so they are equal for every measure. With "
        "--any\n"
        "the first picture that is accepted is told of, or else the one with the fewest differing pixels.\n\n"
        "Two folders: pictures of the same name are compared, in folders within them, too; each is a line, or an "
        "object\n"
        "of JSON. A picture that only one of them has is refused. --diff is then a folder, of those that are.\n\n"
        "--diff shows a channel as 0 where equal, else 64 + 191 sqrt(difference / range); alpha in all channels. For\n"
        "pictures of different sizes it is as large as both, and 32 in all channels where only one has a pixel.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 2,
    .maximum_arguments = -1,
};

void lom_drop_measures(struct lom_measures *measures)
{
    for (int i = 0; i < 2; i++)
        lom_free_image(measures->pictures[i]);
}

/* ---- measuring ---- */

struct reading {
    char **paths;
    lom_image **pictures;
    lom_error errors[2];
    atomic_int next;
};

static void read_next(void *context, int worker)
{
    struct reading *reading = context;
    (void)worker;
    for (int i; (i = atomic_fetch_add(&reading->next, 1)) < 2;)
        reading->pictures[i] = lom_read_image(reading->paths[i], &reading->errors[i]);
}

/* Both at the same time; when both fail, the first one's error is told. */
static bool read_pictures(lom_image *pictures[2], char **paths, lom_error *error)
{
    struct reading reading = { .paths = paths, .pictures = pictures };
    lom_pool *pool = lom_create_pool(2, error);
    if (pool == NULL)
        return false;
    lom_offer_work(pool, read_next, &reading);
    lom_free_pool(pool);
    for (int i = 0; i < 2; i++)
        if (pictures[i] == NULL) {
            *error = reading.errors[i];
            return false;
        }
    return true;
}

bool lom_measure_pictures(struct lom_measures *measures, const struct lom_compare_values *values, lom_error *error)
{
    if (!read_pictures(measures->pictures, measures->paths, error) ||
        !lom_ignore_pixels(measures->pictures, &values->ignore, values->mask, error))
        return false;
    const lom_image *a = measures->pictures[0], *b = measures->pictures[1];
    lom_comparison *exact = &measures->exact;
    if (!lom_compare_images(a, b, exact, error))
        return false;
    measures->ssim = measures->flip = __builtin_nan("");
    if (!exact->same_size)
        return true;
    measures->above = exact->pixels;
    if (exact->identical) { /* known without a look */
        measures->ssim = 1;
        measures->flip = 0;
        return true;
    }
    bool metrics = values->metrics && !values->quiet;
    bool counted =
        !values->max_delta.given || lom_count_differing_pixels(a, b, values->max_delta.value, &measures->above, error);
    return counted && ((!metrics && !values->min_ssim.given) || lom_compare_ssim(a, b, &measures->ssim, error)) &&
           ((!metrics && !values->max_flip.given) || lom_compare_flip(a, b, &measures->flip, error));
}

bool lom_accepts(const struct lom_measures *measures, const struct lom_compare_values *values)
{
    const lom_comparison *exact = &measures->exact;
    if (!exact->same_size)
        return false;
    bool pixels_limited = values->max_diff_pixels.given || values->max_delta.given;
    if (!pixels_limited && !values->min_psnr.given && !values->min_ssim.given && !values->max_flip.given)
        return exact->identical;
    uint64_t allowed = values->max_diff_pixels.given ? (uint64_t)values->max_diff_pixels.value[0] : 0;
    return (!pixels_limited || measures->above <= allowed) &&
           (!values->min_psnr.given || exact->psnr >= values->min_psnr.value) &&
           (!values->min_ssim.given || measures->ssim >= values->min_ssim.value) &&
           (!values->max_flip.given || measures->flip <= values->max_flip.value);
}

/* Whether fewer pixels differ than in what was best until then. */
static bool nearer(const lom_comparison *a, const lom_comparison *best)
{
    return a->same_size && (!best->same_size || a->pixels < best->pixels);
}

/* A with each of the others until one is accepted: best is that, or the nearest. */
static bool measure_any(struct lom_measures *best, const lom_arguments *arguments,
                        const struct lom_compare_values *values, lom_error *error)
{
    for (int i = 1; i < arguments->count; i++) {
        struct lom_measures measures = { .paths = { arguments->items[0], arguments->items[i] } };
        if (!lom_measure_pictures(&measures, values, error)) {
            lom_drop_measures(&measures);
            return false;
        }
        bool accept = lom_accepts(&measures, values);
        if (i == 1 || accept || nearer(&measures.exact, &best->exact)) {
            lom_drop_measures(best);
            *best = measures;
        } else {
            lom_drop_measures(&measures);
        }
        if (accept)
            break;
    }
    return true;
}

/* ---- the command ---- */

static int report(const struct lom_measures *measures, const struct lom_compare_values *values)
{
    bool accept = lom_accepts(measures, values);
    if (!values->quiet && values->json)
        lom_print_compare_json(measures, accept);
    if (!values->quiet && !measures->exact.same_size)
        lom_complain_of_sizes(measures);
    else if (!values->quiet && !values->json)
        lom_print_compare_table(measures, values);
    lom_error error = { .code = LOM_OK };
    if (values->diff != NULL && !lom_write_difference(values->diff, measures, &error))
        return lom_complain_error(&error);
    return accept ? LOM_EXIT_DONE : LOM_EXIT_DIFFERS;
}

static int streams_of(const lom_arguments *arguments)
{
    int streams = 0;
    for (int i = 0; i < arguments->count; i++)
        streams += strcmp(arguments->items[i], "-") == 0;
    return streams;
}

/* Two folders, or pictures alone; false, having said why. */
static bool check_folders(const lom_arguments *arguments, const struct lom_compare_values *values, bool *are_folders)
{
    int folders = 0;
    for (int i = 0; i < arguments->count; i++)
        folders += lom_is_folder(arguments->items[i]);
    *are_folders = folders == 2 && arguments->count == 2 && !values->any;
    if (folders > 0 && !*are_folders)
        return lom_complain("compare: a folder is compared with one other folder, and without --any") == LOM_EXIT_DONE;
    return true;
}

static bool check_arguments(const lom_arguments *arguments, const struct lom_compare_values *values)
{
    int streams = streams_of(arguments);
    bool is_first = strcmp(arguments->items[0], "-") == 0;
    if (values->diff != NULL && strcmp(values->diff, "-") == 0 && !values->quiet)
        return lom_complain("compare: --diff - writes to standard output, so it needs --quiet") == LOM_EXIT_DONE;
    if (arguments->count > 2 && !values->any)
        return lom_complain("compare: %d pictures are compared by --any alone", arguments->count) == LOM_EXIT_DONE;
    if (streams > (arguments->count > 2 && is_first ? 0 : 1))
        return lom_complain("compare: standard input can be one of the pictures, and be read once") == LOM_EXIT_DONE;
    return true;
}

int lom_command_compare(int argc, char **argv)
{
    struct lom_compare_values values = { .diff = NULL };
    lom_arguments arguments;
    bool are_folders;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (!check_arguments(&arguments, &values) || !check_folders(&arguments, &values, &are_folders))
        return LOM_EXIT_FAILED;
    if (are_folders)
        return lom_compare_folders((const char *const[]){ arguments.items[0], arguments.items[1] }, &values);
    struct lom_measures measures = { .pictures = { NULL, NULL } };
    lom_error error = { .code = LOM_OK };
    if (measure_any(&measures, &arguments, &values, &error))
        status = report(&measures, &values);
    else
        status = lom_complain_error(&error);
    lom_drop_measures(&measures);
    return status;
}
