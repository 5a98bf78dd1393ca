/* The stages between vertices and clipping (lom/stages.h): who runs them, checks them and keeps what feedback asks for. */
#ifndef LOM_PIPELINE_EXPAND_H
#define LOM_PIPELINE_EXPAND_H

#include "pipeline/device.h"
#include "pipeline/tessellate.h"

/* All but the vertices of a chunk whose draw has such stages: what it draws is in its rows and corners as it is of other
 * draws, and what feedback keeps in `captured`. False without memory. */
bool lom_expand_chunk(const struct lom_pass *pass, struct lom_chunk *chunk);
void lom_free_expansion(struct lom_expansion *expansion);

/* The vertices of pieces that feedback keeps, into the chunk; which of them the buffer has room for and where, chunk after
 * chunk in order; those to the buffer, chunks in any order. */
bool lom_capture(struct lom_chunk *chunk, const struct lom_stage_rows *rows, const struct lom_pieces *pieces);
void lom_place_feedback(struct lom_chunk *chunk);
void lom_copy_feedback(const struct lom_chunk *chunk);

/* Checks of a draw that names such stages, and what follows from them; for other draws nothing. */
bool lom_check_stages(lom_device *device, const lom_draw_desc *desc);
void lom_derive_stages(struct lom_pass *pass, struct lom_draw *draw);
/* Whether it names any; whether they and its shader were built for the variant. */
bool lom_has_stages(const lom_draw_desc *desc);
/* What goes to clipping: LOM_TRIANGLES, LOM_LINES, LOM_POINTS or LOM_SPRITES. */
lom_topology lom_drawn_topology(const lom_draw_desc *desc);
bool lom_has_variant(const lom_draw_desc *desc, int variant);

#endif
