/* The bar: "lake [######....] 3/5 reflection". */
#include "progress.h"

#include <lom/base.h>

#include <stdio.h>
#include <unistd.h>

enum { BAR = 30 };

struct lom_progress lom_begin_progress(const char *label, int total, bool quiet)
{
    struct lom_progress progress = { !quiet && isatty(2) == 1, label, total < 1 ? 1 : total };
    lom_show_progress(&progress, 0, "");
    return progress;
}

void lom_show_progress(const struct lom_progress *progress, double done, const char *doing)
{
    static const char full[] = "##############################", empty[] = "..............................";
    if (!progress->shown)
        return;
    int filled = lom_int_of(done * BAR / progress->total);
    fprintf(stderr, "\r%s [%.*s%.*s] %d/%d %s\033[K", progress->label, filled, full, BAR - filled, empty,
            lom_int_of(done), progress->total, doing);
}

void lom_end_progress(const struct lom_progress *progress)
{
    if (progress->shown)
        fprintf(stderr, "\r\033[K");
}
