/* `lom compare`: what two pictures differ by (compare.c), what is said of it (compare_report.c), folders of them
 * (compare_folders.c). */
#ifndef LOM_CLI_COMPARE_H
#define LOM_CLI_COMPARE_H

#include "options.h"

#include <lom/image.h>

struct lom_compare_values {
    lom_option_integers max_diff_pixels;
    lom_option_number max_delta, min_psnr, min_ssim, max_flip;
    const char *diff, *mask;
    lom_option_list ignore;
    bool metrics, any, json, quiet;
};

/* Everything that is printed and judged. A measure that nobody asked for is NaN. */
struct lom_measures {
    lom_comparison exact;
    size_t above; /* pixels that differ by more than --max-delta, or at all without it */
    double ssim, flip;
    char *paths[2];
    lom_image *pictures[2];
};

/* Reads the two pictures of measures->paths and measures them. Ended by lom_drop_measures, also after a failure. */
bool lom_measure_pictures(struct lom_measures *measures, const struct lom_compare_values *values, lom_error *error);
void lom_drop_measures(struct lom_measures *measures);
/* Whether the limits hold; without limits, whether nothing differs. */
bool lom_accepts(const struct lom_measures *measures, const struct lom_compare_values *values);

/* An object of JSON; a table of what differs; one line of it. */
void lom_print_compare_json(const struct lom_measures *measures, bool accept);
void lom_print_compare_table(const struct lom_measures *measures, const struct lom_compare_values *values);
void lom_print_compare_line(FILE *out, const struct lom_measures *measures, bool accept);
/* The picture of the differences. */
bool lom_write_difference(const char *path, const struct lom_measures *measures, lom_error *error);
/* A sentence, where the sizes differ. */
void lom_complain_of_sizes(const struct lom_measures *measures);

/* Compares the pictures of two folders, by their names in them; the exit status. */
int lom_compare_folders(const char *const folders[2], const struct lom_compare_values *values);
/* Whether the path is a folder. */
bool lom_is_folder(const char *path);

#endif
