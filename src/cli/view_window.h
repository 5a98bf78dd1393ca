/* The window of `lom view`: where this program has been built with one. */
#ifndef LOM_CLI_VIEW_WINDOW_H
#define LOM_CLI_VIEW_WINDOW_H

#include "view_script.h"

/* Whether there can be one; false, with the reason, in a program that was built without SDL2,
 * and where its library is missing. */
bool lom_check_window(lom_error *error);
/* Shows a view in a window of its size until it ends; events come from the window, or, of a script, from there. times: how
 * long drawing, painting and showing took is said on standard error at the end. False on failure. */
bool lom_show_window(struct lom_view *view, struct lom_script *script, bool times, lom_error *error);

#endif
