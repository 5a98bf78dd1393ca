/* Shallow water between its steps. */
#ifndef LOM_WAVES_SHALLOW_STATE_H
#define LOM_WAVES_SHALLOW_STATE_H

#include "base/threads.h"

#include <lom/shallow.h>

enum { LOM_SHALLOW_LINES = 8 }; /* lines that are solved side by side */

struct lom_shallow {
    lom_shallow_desc desc; /* with its defaults; bed and depth are NULL */
    int64_t steps;
    double *ground, *bed;    /* without obstacles, and with them */
    double *depth;           /* a cell */
    double *flow_x, *flow_z; /* a face */
    double *scratch;         /* lom_shallow_scratch doubles a worker */
    double *through[2];      /* what came in and what went out through the ends of a line */
    double gained, lost;
    lom_pool *pool; /* whose workers share the lines; NULL: the caller alone */
};

/* From now on, and in copies, all workers of a pool that lasts as long take part in steps; the same bytes. */
bool lom_share_shallow(lom_shallow *shallow, lom_pool *pool, lom_error *error);
/* Doubles that the solver needs for lines of so many cells. */
size_t lom_shallow_scratch(int cells);
/* Water flows along x, then along z, for one step. */
void lom_move_shallow_lines(lom_shallow *shallow);

#endif
