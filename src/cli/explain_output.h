/* What `lom explain` prints: an explanation as text, as JSON and as a page. */
#ifndef LOM_CLI_EXPLAIN_OUTPUT_H
#define LOM_CLI_EXPLAIN_OUTPUT_H

#include <lom/inspect.h>

#include <stdio.h>

struct lom_explain_head {
    const char *scene;
    int frame;
    const lom_explanation *explanation;
};

void lom_print_explanation(FILE *out, const struct lom_explain_head *head);
/* One object on one line. */
void lom_write_explanation(FILE *out, const struct lom_explain_head *head);
/* A page by itself: the explanation, and the picture of the whole frame to look at. NULL on failure. */
lom_bytes lom_explanation_page(const struct lom_explain_head *head, const lom_image *picture, lom_error *error);

/* The place of a vertex in the world: what its shader names "offset", plus the eye; false: it names none. */
bool lom_world_place(const lom_explained *explained, const lom_vertex_record *vertex, double place[3]);
const char *lom_compare_text(lom_compare compare);
const char *lom_factor_text(lom_factor factor);
const char *lom_operation_text(lom_blend_operation operation);

/* Whether its primitives have two vertices. */
static inline bool lom_is_line(const lom_draw_record *draw)
{
    return draw->desc.topology == LOM_LINES || draw->desc.topology == LOM_LINE_STRIP;
}

#endif
