/* What a frame took, as a JSON line. */
#ifndef LOM_CLI_FRAME_STATS_H
#define LOM_CLI_FRAME_STATS_H

#include <lom/render.h>

/* Appends the line of a frame that was drawn in `elapsed` seconds. */
bool lom_append_stats(lom_writer *writer, const lom_renderer *renderer, const lom_frame *frame, int number,
                      double elapsed, lom_error *error);

#endif
