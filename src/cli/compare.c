/* `lom compare`. In: two pictures and what may differ. Out: how much they differ, and the exit status that says whether
 * that was accepted. Invariant: without limits a single differing sample is refused; with limits, all of them must
 * hold, and a measure that is no number holds none. Only measures that are printed or limited are computed. */
#include "base/threads.h"

#include "commands.h"
#include "compare_ignore.h"
#include "json.h"
#include "options.h"

#include <lom/image.h>

#include <stdatomic.h>
#include <string.h>

struct values {
    lom_option_integers max_diff_pixels;
    lom_option_number max_delta, min_psnr, min_ssim, max_flip;
    const char *diff, *mask;
    lom_option_list ignore;
    bool metrics, any, json, quiet;
};

static const lom_option options[] = {
    { .name = "max-diff-pixels",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, max_diff_pixels),
      .value = "N",
      .maximum = 1e12,
      .help = "accept at most N pixels that differ (by more than D)" },
    { .name = "max-delta",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, max_delta),
      .value = "D",
      .maximum = 1e38,
      .help = "accept pixels that differ by at most D" },
    { .name = "min-psnr",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, min_psnr),
      .value = "DB",
      .minimum = -1000,
      .maximum = 1000,
      .help = "accept a PSNR of at least DB decibels" },
    { .name = "min-ssim",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, min_ssim),
      .value = "S",
      .minimum = -1,
      .maximum = 1,
      .help = "accept a mean SSIM of at least S" },
    { .name = "max-flip",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, max_flip),
      .value = "F",
      .maximum = 1,
      .help = "accept a mean FLIP of at most F" },
    { .name = "metrics",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, metrics),
      .help = "find SSIM and FLIP as well, which takes longer" },
    { .name = "ignore",
      .kind = LOM_OPTION_LIST,
      .field = offsetof(struct values, ignore),
      .value = "X,Y,W,H",
      .help = "leave out the pixels of a rectangle" },
    { .name = "mask",
      .kind = LOM_OPTION_TEXT,
      .field = offsetof(struct values, mask),
      .value = "PICTURE",
      .help = "leave out the pixels where that picture is black" },
    { .name = "any",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, any),
      .help = "A is compared with each of the others, and one of them is enough" },
    { .name = "diff",
      .kind = LOM_OPTION_TEXT,
      .field = offsetof(struct values, diff),
      .value = "OUT.png",
      .help = "write a picture of the differences" },
    { .name = "json",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, json),
      .help = "print one JSON object" },
    { .name = "quiet",
      .letter = 'q',
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, quiet),
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
        "--diff shows a channel as 0 where equal, else 64 + 191 sqrt(difference / range); alpha in all channels. For\n"
        "pictures of different sizes it is as large as both, and 32 in all channels where only one has a pixel.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 2,
    .maximum_arguments = -1,
};

/* Everything that is printed and judged. A measure that nobody asked for is NaN. */
struct measures {
    lom_comparison exact;
    size_t above; /* pixels that differ by more than --max-delta, or at all without it */
    double ssim, flip;
    char *paths[2];
    lom_image *pictures[2];
};

static void free_pictures(struct measures *measures)
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
    lom_run_pool(pool, read_next, &reading);
    lom_free_pool(pool);
    for (int i = 0; i < 2; i++)
        if (pictures[i] == NULL) {
            *error = reading.errors[i];
            return false;
        }
    return true;
}

static bool measure(struct measures *measures, const struct values *values, lom_error *error)
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

static bool accepted(const struct measures *measures, const struct values *values)
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
static bool measure_any(struct measures *best, const lom_arguments *arguments, const struct values *values,
                        lom_error *error)
{
    for (int i = 1; i < arguments->count; i++) {
        struct measures measures = { .paths = { arguments->items[0], arguments->items[i] } };
        if (!measure(&measures, values, error)) {
            free_pictures(&measures);
            return false;
        }
        bool accept = accepted(&measures, values);
        if (i == 1 || accept || nearer(&measures.exact, &best->exact)) {
            free_pictures(best);
            *best = measures;
        } else {
            free_pictures(&measures);
        }
        if (accept)
            break;
    }
    return true;
}

/* ---- telling ---- */

static void print_size(lom_json *json, const char *key, const lom_image *image)
{
    const int64_t size[3] = { image->width, image->height, image->depth };
    lom_json_integers(json, key, size, 3);
}

static void print_json(const struct measures *measures, bool accept)
{
    const lom_comparison *exact = &measures->exact;
    bool same = exact->same_size;
    lom_json json = lom_json_begin(stdout);
    lom_json_text(&json, "a", measures->paths[0]);
    lom_json_text(&json, "b", measures->paths[1]);
    lom_json_bool(&json, "identical", exact->identical);
    lom_json_bool(&json, "accepted", accept);
    lom_json_bool(&json, "same_size", same);
    lom_json_integer(&json, "width", measures->pictures[0]->width);
    lom_json_integer(&json, "height", measures->pictures[0]->height);
    print_size(&json, "size_a", measures->pictures[0]);
    print_size(&json, "size_b", measures->pictures[1]);
    const double unknown = __builtin_nan("");
    lom_json_number(&json, "pixels", same ? (double)exact->pixels : unknown);
    lom_json_number(&json, "pixels_above", same ? (double)measures->above : unknown);
    lom_json_number(&json, "max_delta", same ? exact->max_delta : unknown);
    lom_json_number(&json, "rmse", same ? exact->rmse : unknown);
    lom_json_number(&json, "psnr", same ? exact->psnr : unknown);
    lom_json_number(&json, "ssim", measures->ssim);
    lom_json_number(&json, "flip", measures->flip);
    if (same && !exact->identical) {
        const int64_t box[4] = { exact->box[0], exact->box[1], exact->box[2], exact->box[3] };
        const int64_t at[3] = { exact->max_at[0], exact->max_at[1], exact->max_channel };
        lom_json_integers(&json, "bbox", box, 4);
        lom_json_integers(&json, "max_at", at, 3);
    } else {
        lom_json_null(&json, "bbox");
        lom_json_null(&json, "max_at");
    }
    lom_json_integer(&json, "bits", exact->bits);
    lom_json_end(&json);
}

static const char *channel_name(const lom_comparison *exact)
{
    static const char *const names[5][4] = {
        { "" }, { "gray" }, { "gray", "alpha" }, { "red", "green", "blue" }, { "red", "green", "blue", "alpha" },
    };
    return names[exact->channels][exact->max_channel];
}

static void print_table(const struct measures *measures, const struct values *values)
{
    const lom_comparison *exact = &measures->exact;
    const lom_image *a = measures->pictures[0];
    if (values->any)
        printf("compared with    %s\n", measures->paths[1]);
    double total = (double)a->width * a->height * a->depth;
    if (exact->identical) {
        printf("identical        %d x %d\n", a->width, a->height);
        return;
    }
    printf("differing pixels %zu of %.0f (%.3g %%)\n", exact->pixels, total, 100 * (double)exact->pixels / total);
    if (values->max_delta.given)
        printf("above %-10.4g %zu\n", values->max_delta.value, measures->above);
    printf("bounding box     %d,%d,%d,%d\n", exact->box[0], exact->box[1], exact->box[2], exact->box[3]);
    double peak = exact->is_float ? 1 : (double)((UINT64_C(1) << exact->bits) - 1);
    printf("largest delta    %.6g of %.8g at %d,%d (%s)\n", exact->max_delta, peak, exact->max_at[0], exact->max_at[1],
           channel_name(exact));
    printf("RMSE             %.6g\n", exact->rmse);
    printf("PSNR             %.3f dB\n", exact->psnr);
    if (!__builtin_isnan(measures->ssim))
        printf("SSIM             %.6f\n", measures->ssim);
    if (!__builtin_isnan(measures->flip))
        printf("FLIP             %.6f\n", measures->flip);
}

static bool write_picture(const char *path, const struct measures *measures, lom_error *error)
{
    lom_image *picture = lom_compare_picture(measures->pictures[0], measures->pictures[1], error);
    const char *kind = strcmp(path, "-") == 0 ? "png" : NULL;
    bool done = picture != NULL && lom_write_image(path, kind, picture, error);
    lom_free_image(picture);
    return done;
}

static void complain_of_sizes(const struct measures *measures)
{
    char *const *paths = measures->paths;
    const lom_image *a = measures->pictures[0], *b = measures->pictures[1];
    if (a->depth == 1 && b->depth == 1)
        lom_complain("%s is %d x %d and %s is %d x %d: pictures of different sizes always differ.", paths[0], a->width,
                     a->height, paths[1], b->width, b->height);
    else
        lom_complain("%s is %d x %d x %d and %s is %d x %d x %d: pictures of different sizes always differ.", paths[0],
                     a->width, a->height, a->depth, paths[1], b->width, b->height, b->depth);
}

static int report(const struct measures *measures, const struct values *values)
{
    bool accept = accepted(measures, values);
    if (!values->quiet && values->json)
        print_json(measures, accept);
    if (!values->quiet && !measures->exact.same_size)
        complain_of_sizes(measures);
    else if (!values->quiet && !values->json)
        print_table(measures, values);
    lom_error error = { .code = LOM_OK };
    if (values->diff != NULL && !write_picture(values->diff, measures, &error))
        return lom_complain_error(&error);
    return accept ? LOM_EXIT_DONE : LOM_EXIT_DIFFERS;
}

int lom_command_compare(int argc, char **argv)
{
    struct values values = { .diff = NULL };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.diff != NULL && strcmp(values.diff, "-") == 0 && !values.quiet)
        return lom_complain("compare: --diff - writes to standard output, so it needs --quiet");
    if (arguments.count > 2 && !values.any)
        return lom_complain("compare: %d pictures are compared by --any alone", arguments.count);
    int streams = 0;
    for (int i = 0; i < arguments.count; i++)
        streams += strcmp(arguments.items[i], "-") == 0;
    if (streams > (arguments.count > 2 && strcmp(arguments.items[0], "-") == 0 ? 0 : 1))
        return lom_complain("compare: standard input can be one of the pictures, and be read once");
    struct measures measures = { .pictures = { NULL, NULL } };
    lom_error error = { .code = LOM_OK };
    if (measure_any(&measures, &arguments, &values, &error))
        status = report(&measures, &values);
    else
        status = lom_complain_error(&error);
    free_pictures(&measures);
    return status;
}
