/* A frame one of whose targets is tallied (lom/record.h). */
#ifndef LOM_RENDER_TALLIED_H
#define LOM_RENDER_TALLIED_H

#include "render/targets.h"

#include <lom/record.h>

/* Draws a frame while one of its targets is tallied, until lom_tally_target(NULL); a scene that has none of it draws
 * the frame alone. The targets are there before the frame is drawn, so that they can be tallied. False on failure,
 * also of a scene that the reference traces. */
bool lom_draw_tallied(lom_renderer *renderer, const lom_frame_desc *desc, lom_tally_desc tally, enum lom_target target,
                      lom_frame *frame, lom_error *error);

#endif
