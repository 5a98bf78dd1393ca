/* `lom compare`. In: two pictures and what may differ. Out: how much they differ, and the exit status that says whether
 * that was accepted. Invariant: without thresholds a single differing sample is refused; with thresholds, all of them
 * must hold, and a measure that is no number holds none. */
#include "commands.h"
#include "json.h"
#include "options.h"

#include <lom/image.h>

#include <string.h>

struct values {
    lom_option_integers max_diff_pixels;
    lom_option_number max_delta, min_psnr, max_flip;
    const char *diff;
    bool json, quiet;
};

static const lom_option options[] = {
    { .name = "max-diff-pixels",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, max_diff_pixels),
      .value = "N",
      .maximum = 1e12,
      .help = "accept at most N differing pixels" },
    { .name = "max-delta",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, max_delta),
      .value = "D",
      .maximum = 1e38,
      .help = "accept no sample that differs by more than D" },
    { .name = "min-psnr",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, min_psnr),
      .value = "DB",
      .minimum = -1000,
      .maximum = 1000,
      .help = "accept a PSNR of at least DB decibels" },
    { .name = "max-flip",
      .kind = LOM_OPTION_NUMBER,
      .field = offsetof(struct values, max_flip),
      .value = "F",
      .maximum = 1,
      .help = "accept a mean FLIP of at most F" },
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
    .arguments = "A B",
    .summary = "Says whether and how much two pictures differ",
    .details =
        "Exit status: 0 when accepted, 1 when not, 2 when the pictures could not be read. Without thresholds any\n"
        "differing sample is refused; with some, all of them must hold. Pictures of different sizes always differ.\n\n"
        "Pictures of different kinds are compared in the one that holds both: 8-bit n is 16-bit 257 n, gray is three\n"
        "equal colours, missing alpha is opaque. Deltas and the RMSE are in steps of that format (0..255, 0..65535), "
        "for\n"
        "floats plain numbers; alpha counts in the exact comparison alone. PSNR is over the colours, with a peak of "
        "the\n"
        "largest step or 1.0; SSIM follows Wang 2004 on luma without downsampling; FLIP is the mean of LDR FLIP at 67\n"
        "pixels a degree, which takes whole-number samples as sRGB-encoded and floats as linear light.\n\n"
        "--diff shows a channel as 0 where equal, else 64 + 191 sqrt(difference / range); alpha in all channels.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 2,
    .maximum_arguments = 2,
};

/* Everything that is printed and judged. */
struct measures {
    lom_comparison exact;
    double ssim, flip;
    lom_image *pictures[2];
};

static bool measure(struct measures *measures, char **paths, const struct values *values, lom_error *error)
{
    for (int i = 0; i < 2; i++) {
        measures->pictures[i] = lom_read_image(paths[i], error);
        if (measures->pictures[i] == NULL)
            return false;
    }
    const lom_image *a = measures->pictures[0], *b = measures->pictures[1];
    if (!lom_compare_images(a, b, &measures->exact, error))
        return false;
    measures->ssim = 1;
    measures->flip = 0;
    if (!measures->exact.same_size || measures->exact.identical) /* equal numbers: 1 and 0 without a look */
        return true;
    bool printed = !values->quiet;
    return (!printed || lom_compare_ssim(a, b, &measures->ssim, error)) &&
           ((!printed && !values->max_flip.given) || lom_compare_flip(a, b, &measures->flip, error));
}

static bool accepted(const struct measures *measures, const struct values *values)
{
    const lom_comparison *exact = &measures->exact;
    if (!exact->same_size)
        return false;
    if (!values->max_diff_pixels.given && !values->max_delta.given && !values->min_psnr.given &&
        !values->max_flip.given)
        return exact->identical;
    return (!values->max_diff_pixels.given || exact->pixels <= (uint64_t)values->max_diff_pixels.value[0]) &&
           (!values->max_delta.given || exact->max_delta <= values->max_delta.value) &&
           (!values->min_psnr.given || exact->psnr >= values->min_psnr.value) &&
           (!values->max_flip.given || measures->flip <= values->max_flip.value);
}

static void print_json(const struct measures *measures, char **paths, bool accept)
{
    const lom_comparison *exact = &measures->exact;
    bool same = exact->same_size;
    lom_json json = lom_json_begin(stdout);
    lom_json_text(&json, "a", paths[0]);
    lom_json_text(&json, "b", paths[1]);
    lom_json_bool(&json, "identical", exact->identical);
    lom_json_bool(&json, "accepted", accept);
    lom_json_bool(&json, "same_size", same);
    lom_json_integer(&json, "width", measures->pictures[0]->width);
    lom_json_integer(&json, "height", measures->pictures[0]->height);
    const double unknown = __builtin_nan("");
    lom_json_number(&json, "pixels", same ? (double)exact->pixels : unknown);
    lom_json_number(&json, "max_delta", same ? exact->max_delta : unknown);
    lom_json_number(&json, "rmse", same ? exact->rmse : unknown);
    lom_json_number(&json, "psnr", same ? exact->psnr : unknown);
    lom_json_number(&json, "ssim", same ? measures->ssim : unknown);
    lom_json_number(&json, "flip", same ? measures->flip : unknown);
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

static void print_table(const struct measures *measures)
{
    const lom_comparison *exact = &measures->exact;
    const lom_image *a = measures->pictures[0];
    double total = (double)a->width * a->height * a->depth;
    if (exact->identical) {
        printf("identical        %d x %d\n", a->width, a->height);
        return;
    }
    printf("differing pixels %zu of %.0f (%.3g %%)\n", exact->pixels, total, 100 * (double)exact->pixels / total);
    printf("bounding box     %d,%d,%d,%d\n", exact->box[0], exact->box[1], exact->box[2], exact->box[3]);
    double peak = exact->is_float ? 1 : (double)((UINT64_C(1) << exact->bits) - 1);
    printf("largest delta    %.6g of %.8g at %d,%d (%s)\n", exact->max_delta, peak, exact->max_at[0], exact->max_at[1],
           channel_name(exact));
    printf("RMSE             %.6g\n", exact->rmse);
    printf("PSNR             %.3f dB\n", exact->psnr);
    printf("SSIM             %.6f\n", measures->ssim);
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

static int report(const struct measures *measures, char **paths, const struct values *values)
{
    const lom_image *a = measures->pictures[0], *b = measures->pictures[1];
    bool accept = accepted(measures, values);
    if (!values->quiet && values->json)
        print_json(measures, paths, accept);
    if (!measures->exact.same_size) {
        if (!values->quiet)
            lom_complain("%s is %d x %d and %s is %d x %d: pictures of different sizes always differ.", paths[0],
                         a->width, a->height, paths[1], b->width, b->height);
        return LOM_EXIT_DIFFERS;
    }
    if (!values->quiet && !values->json)
        print_table(measures);
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
    struct measures measures = { .pictures = { NULL, NULL } };
    lom_error error = { .code = LOM_OK };
    if (measure(&measures, arguments.items, &values, &error))
        status = report(&measures, arguments.items, &values);
    else
        status = lom_complain_error(&error);
    lom_free_image(measures.pictures[0]);
    lom_free_image(measures.pictures[1]);
    return status;
}
