/* What is said of two pictures. In: how much they differ. Out: words, JSON, a picture of the differences. Invariant: a
 * measure that was not found is told as unknown or not at all; nothing is measured or judged here. */
#include "compare.h"

#include "json.h"

#include <string.h>

static void print_size(lom_json *json, const char *key, const lom_image *image)
{
    const int64_t size[3] = { image->width, image->height, image->depth };
    lom_json_integers(json, key, size, 3);
}

void lom_print_compare_json(const struct lom_measures *measures, bool accept)
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

void lom_print_compare_table(const struct lom_measures *measures, const struct lom_compare_values *values)
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

bool lom_write_difference(const char *path, const struct lom_measures *measures, lom_error *error)
{
    lom_image *picture = lom_compare_picture(measures->pictures[0], measures->pictures[1], error);
    const char *kind = strcmp(path, "-") == 0 ? "png" : NULL;
    bool done = picture != NULL && lom_write_image(path, kind, picture, error);
    lom_free_image(picture);
    return done;
}

void lom_complain_of_sizes(const struct lom_measures *measures)
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

void lom_print_compare_line(FILE *out, const struct lom_measures *measures, bool accept)
{
    const lom_comparison *exact = &measures->exact;
    const lom_image *a = measures->pictures[0], *b = measures->pictures[1];
    if (exact->identical)
        fprintf(out, "identical");
    else if (!exact->same_size)
        fprintf(out, "differs: %d x %d and %d x %d", a->width, a->height, b->width, b->height);
    else
        fprintf(out, "%s: %zu of %.0f pixels, largest delta %.6g, PSNR %.3f dB", accept ? "accepted" : "differs",
                exact->pixels, (double)a->width * a->height * a->depth, exact->max_delta, exact->psnr);
    if (!exact->identical && !__builtin_isnan(measures->ssim))
        fprintf(out, ", SSIM %.6f", measures->ssim);
    if (!exact->identical && !__builtin_isnan(measures->flip))
        fprintf(out, ", FLIP %.6f", measures->flip);
    fputc('\n', out);
}
