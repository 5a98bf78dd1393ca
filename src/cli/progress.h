/* A progress bar on standard error, where that is a terminal. */
#ifndef LOM_CLI_PROGRESS_H
#define LOM_CLI_PROGRESS_H

#include <stdbool.h>

struct lom_progress {
    bool shown;
    const char *label;
    int total;
};

/* Shows an empty bar for `total` steps, unless quiet. */
struct lom_progress lom_begin_progress(const char *label, int total, bool quiet);
/* Shows how many are done, with the share of the one that is being drawn. */
void lom_show_progress(const struct lom_progress *progress, double done, const char *doing);
/* Removes the bar. */
void lom_end_progress(const struct lom_progress *progress);

#endif
