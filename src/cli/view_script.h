/* Events from a file, and questions: `lom view --script`. */
#ifndef LOM_CLI_VIEW_SCRIPT_H
#define LOM_CLI_VIEW_SCRIPT_H

#include "view.h"

struct lom_script;

/* Reads and checks a script ("-": standard input); NULL on failure. Freed with lom_free_script. */
struct lom_script *lom_read_script(const char *path, lom_error *error);
void lom_free_script(struct lom_script *script); /* NULL is allowed */
/* Plays the next frame of a view, a sixtieth of a second after the one before: its events, a step, a drawing, then its
 * questions, whose answers are printed. Behind the last line the view ends. False on failure. */
bool lom_play_script(struct lom_script *script, struct lom_view *view, lom_error *error);
/* What a script can say, a line each. */
void lom_print_script_help(FILE *out);

#endif
